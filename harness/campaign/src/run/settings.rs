//! Arguments of `heliotorque run` resolved for an FMU or a system.

use std::path::Path;

use files::Scratch;
use fmi::{Ended, Fmu, InputTable, InstanceOptions, LogMessage, Options, Rows, Times, Watcher};
use inputs::{
    ending::{OPTION, by_ending},
    epoch::Dates,
    mission::{self, Limit, Resolved},
    values::all_names,
    variables::{assigned_by, selected},
};
use model_description::{Description, VariableRole};
use systems::{FirstExchange, Master};
use tables::output::{OutputFile, Plot, Requested};

use super::{
    options::{FORMATS, Run},
    simulated::Simulated,
    subject::Subject,
};

/// Arguments resolved for an FMU or a system.
pub struct Settings {
    /// Start, stop and step.
    pub times: Times,
    /// Values set before the run.
    pub sets: Vec<(String, fmi::Value)>,
    /// Inputs over time.
    pub inputs: Option<InputTable>,
    /// Recorded variables, by their positions.
    pub positions: Vec<usize>,
    /// Requested outputs.
    pub requested: Requested,
    /// Limits by which the run is judged.
    pub limits: Vec<Limit>,
}

impl Settings {
    /// Resolves the arguments and the mission; the error names the flag or the line. The file of `--input` may stand in a copy.
    pub fn new(
        subject: &Subject,
        simulated: &Simulated,
        input_copy: Option<&Path>,
    ) -> Result<Self, Box<dyn std::error::Error>> {
        let Simulated { run: arguments, mission } = simulated;
        let described = subject.description();
        let resolved = match mission {
            Some(mission) => mission.resolve(described, &arguments.set, arguments.start)?,
            None => Resolved::default(),
        };
        let in_mission = mission.as_ref().map_or_else(Vec::new, |mission| mission.settings(described));
        let together = in_mission.iter().map(|(_, setting)| setting).chain(&arguments.set);
        let dates = Dates::new(described, together.map(String::as_str), arguments.start);
        let times = subject.times(arguments, &dates)?;
        let sets = [resolved.sets, assigned_by(&dates, described, &arguments.set)?].concat();
        let inputs = arguments.input.as_deref();
        let inputs =
            inputs.map(|path| read_table(described, path, input_copy.unwrap_or(path))).transpose()?;
        let named = |positions: &[usize]| -> Vec<String> {
            positions.iter().map(|&position| described.variables[position].name.clone()).collect()
        };
        // What a mission's file names stays beside it; who names it on the command line may put it anywhere.
        let of_mission = |path: &Path, option: &'static str| OutputFile {
            path: path.to_owned(),
            option,
            home: mission.as_ref().map(|mission| mission.path.parent().unwrap_or(Path::new("")).to_owned()),
        };
        let given = by_ending(&arguments.output, FORMATS)?;
        let [table, picture] = given.map(|path| path.map(|path| OutputFile::of_option(path, OPTION)));
        let table = table
            .or_else(|| Some(of_mission(mission.as_ref()?.output.as_deref()?, "`output` in the mission")));
        let mut plots: Vec<Plot> = match picture {
            Some(file) => vec![Plot { file, names: None }],
            None => {
                let plots = mission.iter().flat_map(|mission| &mission.plots).zip(&resolved.plots);
                let plot = |(plot, shown): (&mission::Plot, &Option<Vec<usize>>)| Plot {
                    file: of_mission(&plot.file, "`plot` in the mission"),
                    names: shown.as_deref().map(named),
                };
                plots.map(plot).collect()
            }
        };
        let mut positions = match (&arguments.record[..], resolved.record) {
            ([], Some(positions)) => positions,
            ([], None) => fmi::outputs(described),
            (names, _) => selected(described, &all_names(names), fmi::select_outputs)?,
        };
        // What is drawn or judged is recorded too.
        let requested = plots.iter().flat_map(|plot| plot.names.iter().flatten());
        let requested = requested.chain(resolved.limits.iter().map(|limit| &limit.name));
        for name in requested {
            let position = described.variables.iter().position(|variable| variable.name == *name);
            positions.extend(position.filter(|position| !positions.contains(position)));
        }
        let columns = positions.len();
        // Pictures shade eclipses, whatever they show.
        let lit: Vec<usize> = fmi::outputs(described)
            .into_iter()
            .filter(|position| described.variables[*position].role() == Some(VariableRole::LitFraction))
            .filter(|position| !positions.contains(position))
            .collect();
        if !plots.is_empty() && !lit.is_empty() {
            let shown = named(&positions);
            plots.iter_mut().for_each(|plot| {
                plot.names.get_or_insert_with(|| shown.clone());
            });
            positions.extend(lit);
        }
        Ok(Self {
            times,
            sets,
            inputs: inputs.or(resolved.inputs),
            positions,
            requested: Requested { table, plots, columns, is_quiet: arguments.quiet },
            limits: resolved.limits,
        })
    }

    /// The same with the FMU, and the folder that it was packed in, as long as it is in use.
    ///
    /// # Errors
    /// A system too; `allowed` is said instead.
    pub fn of_fmu(
        simulated: &Simulated,
        allowed: &str,
    ) -> Result<(Fmu, Self, Option<Scratch>), Box<dyn std::error::Error>> {
        let (subject, folder) = simulated.open()?;
        let settings = Self::new(&subject, simulated, None)?;
        let Subject::Fmu(fmu) = subject else {
            let file = simulated.run.fmu.display();
            return Err(format!("{file}: found a system, allowed: {allowed}").into());
        };
        Ok((fmu, settings, folder))
    }

    /// Returns the names of the variables that are given a value, once or over time.
    pub fn given<'a>(&'a self, described: &'a Description) -> impl Iterator<Item = &'a String> {
        let positions = self.inputs.iter().flat_map(|table| table.positions());
        let inputs = positions.map(|position| &described.variables[position].name);
        self.sets.iter().map(|(name, _)| name).chain(inputs)
    }

    /// Runs it in this process as long as `progress` answers so, which is given the time in s after every step; an FMU is watched.
    pub fn simulate_into<'a>(
        &'a self,
        subject: &Subject,
        arguments: &Run,
        (progress, watcher): (&'a mut dyn FnMut(f64) -> bool, Option<&'a mut dyn Watcher>),
        rows: &mut dyn Rows,
    ) -> Result<(Ended, Vec<LogMessage>), fmi::Error> {
        let options = Options {
            start_s: arguments.start,
            stop_s: Some(self.times.stop_s),
            step_s: arguments.step,
            tolerance: arguments.tolerance,
            record_every_s: arguments.every,
            sets: self.sets.clone(),
            inputs: self.inputs.as_ref(),
            input_derivatives: arguments.slopes,
            record: Some(self.positions.clone()),
            instance: InstanceOptions { logging: arguments.log, ..InstanceOptions::default() },
            progress: Some(progress),
            watcher,
            ..Options::default()
        };
        match subject {
            Subject::Fmu(fmu) => fmi::simulate_into(fmu, options, rows),
            Subject::System(system) => {
                let master = arguments.master.unwrap_or(Master::Jacobi);
                let first = arguments.first_exchange.unwrap_or(FirstExchange::Initial);
                systems::simulate_into(system, (master, first), options, rows)
            }
        }
    }
}

/// Reads the input table of a path, from where it stands.
fn read_table(
    described: &Description,
    path: &Path,
    at: &Path,
) -> Result<InputTable, Box<dyn std::error::Error>> {
    let in_file = |error: &dyn std::error::Error| format!("{}: {}", path.display(), fmi::Error::chain(error));
    let file = files::open_at_most(at, files::MAX_TABLE_BYTES)
        .map_err(|error| format!("{}: see --input", in_file(&error)))?;
    let mut rows = fmi::csv::read_rows(file).map_err(|error| in_file(&error))?;
    let header = if rows.is_empty() { Vec::new() } else { rows.remove(0) };
    Ok(InputTable::parse(described, &header, &rows).map_err(|error| in_file(&error))?)
}
