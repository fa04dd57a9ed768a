//! Campaign resolved for the FMU that it simulates: the values of its runs, and the recorded variables.

use std::{error::Error, ops::Range, path::Path};

use files::outcome::Refusal;
use fmi::{RecordedPoints, Value, csv};
use inputs::{
    campaign::{
        file::{CampaignFile, WrittenDistribution},
        keys::SamplingWord,
    },
    epoch::Dates,
    mission::in_file,
    values::Instant,
};
use model_description::{BaseType, Description, ScalarVariable, value};

use super::recorded_columns::RecordedColumns;
use crate::{
    Correlation, Design, DesignPart, Distribution, Sampling, Varied,
    run::{Run, Settings, Simulated, Subject},
};

/// Numbers that percentiles are made of at most.
const MAX_NUMBERS: u64 = 100_000_000;

/// A campaign for the FMU that it simulates.
pub(super) struct Campaign {
    /// The arguments of a run.
    pub simulated: Simulated,
    /// Times, values and inputs that all runs have.
    pub settings: Settings,
    /// The values of the runs.
    pub design: Design,
    /// Positions of the variables that vary.
    pub varied: Vec<usize>,
    /// Recorded variables.
    pub kept: RecordedColumns,
    /// Points at which percentiles have a row.
    pub percentile_points: RecordedPoints,
    /// Points at which histories have one.
    pub history_points: RecordedPoints,
}

/// The run that the runs of a campaign are like.
pub(super) fn simulated(campaign: &CampaignFile, template: Option<&Path>) -> Result<Simulated, Refusal> {
    Simulated::new(&Run {
        fmu: campaign.simulated().to_owned(),
        start: campaign.start_s,
        stop: campaign.stop_s.map(Instant::Time),
        step: campaign.step_s,
        template: template.map(Path::to_owned),
        quiet: true,
        ..Run::default()
    })
}

impl Campaign {
    /// Finds every name and reads every value.
    ///
    /// # Errors
    /// Everything that the FMU does not have or take, by its line.
    pub(super) fn resolve(
        file: &CampaignFile,
        simulated: Simulated,
        subject: &Subject,
    ) -> Result<Self, Box<dyn Error>> {
        let described = subject.description();
        let settings = Settings::new(subject, &simulated, None)?;
        let written = simulated.mission.iter().flat_map(|mission| mission.settings(described));
        let written: Vec<String> = written.map(|(_, setting)| setting).collect();
        let dates = Dates::new(described, written.iter().map(String::as_str), Some(settings.times.start_s));
        let reader = Reader { file, described, dates: &dates };
        let (varied, sampling) = reader.varied()?;
        let names = varied.iter().map(|it| reader.position(&it.name));
        let positions: Vec<usize> = names.collect::<Option<_>>().unwrap_or_default();
        let design = reader.design(varied, sampling)?;
        let kept = RecordedColumns::new(file, described, (&simulated, &settings))?;
        let points = |every_s: Option<f64>| RecordedPoints::new(&settings.times, every_s);
        let percentile_points = points(file.keep.as_ref().and_then(|keep| keep.every_s))?;
        let history_points = points(simulated.run.every)?;
        Ok(Self { settings, design, varied: positions, kept, percentile_points, history_points, simulated })
    }

    /// The values that a run sets, by name.
    pub(super) fn sets(&self, described: &Description, run: u64) -> Vec<(String, Value)> {
        let values = self.varied.iter().zip(self.design.values(run));
        values
            .map(|(position, number)| {
                let variable = &described.variables[*position];
                (variable.name.clone(), Value::of_f64(variable.kind.base_type(), number))
            })
            .collect()
    }

    /// Numbers that the percentiles are made of, of one run.
    pub(super) fn numbers_per_run(&self) -> usize {
        let points = usize::try_from(self.percentile_points.count()).unwrap_or(usize::MAX);
        points.saturating_mul(self.kept.percentiles.len())
    }

    /// The header of a run's table over time.
    pub(super) fn history_header(&self, described: &Description) -> String {
        let names = self.kept.positions.iter().take(self.kept.histories);
        let names = names.map(|position| csv::field(&described.variables[*position].name));
        names.fold("time".to_owned(), |header, name| header + "," + &name) + "\n"
    }

    /// Refuses values that the FMU does not take, and more numbers than percentiles may be made of.
    ///
    /// # Errors
    /// The first run that has one.
    pub(super) fn check(
        &self,
        file: &CampaignFile,
        described: &Description,
        runs: &Range<u64>,
    ) -> Result<(), String> {
        let numbers = (runs.end - runs.start).saturating_mul(self.numbers_per_run() as u64);
        if numbers > MAX_NUMBERS {
            return Err(format!(
                "{}: keep.percentiles: found {numbers} numbers, allowed: up to {MAX_NUMBERS}: a larger `every`, fewer names or runs",
                file.file.display()
            ));
        }
        for run in runs.clone() {
            for (variable, number) in self.varied.iter().zip(self.design.values(run)) {
                let variable = &described.variables[*variable];
                if let Err(misfit) =
                    value::check(described, variable, &Value::of_f64(variable.kind.base_type(), number))
                {
                    let at = file.distributions().find(|at| at.it.name == variable.name);
                    let place = at.map_or_else(
                        || format!("{}: {}", file.file.display(), variable.name),
                        |at| at.place(&file.file),
                    );
                    return Err(format!("{place}: run {run}: {misfit}"));
                }
            }
        }
        Ok(())
    }
}

struct Reader<'a> {
    file: &'a CampaignFile,
    described: &'a Description,
    dates: &'a Dates<'a>,
}

impl Reader<'_> {
    fn position(&self, name: &str) -> Option<usize> {
        self.described.variables.iter().position(|variable| variable.name == name)
    }

    /// Varied values, by the names that the FMU has.
    fn varied(&self) -> Result<(Vec<Varied>, Sampling), Refusal> {
        let sampling = match self.file.sampling {
            SamplingWord::Random => Sampling::Random,
            SamplingWord::LatinHypercube => Sampling::LatinHypercube,
            SamplingWord::Sobol => Sampling::Sobol,
            SamplingWord::Grid => Sampling::Grid,
            SamplingWord::OneAtATime => Sampling::OneAtATime,
            SamplingWord::File => return Ok(self.table()?),
        };
        let (mut varied, mut problems) = (Vec::new(), Vec::new());
        for at in self.file.distributions() {
            match self.one(&at.it) {
                Ok(one) => varied.push(one),
                Err(what) => problems.push(self.file.problem(&at, &what)),
            }
        }
        Refusal::of_all(&problems).map_or(Ok((varied, sampling)), Err)
    }

    /// The variable of a name; vectors are named by element.
    fn variable(&self, name: &str) -> Result<&ScalarVariable, String> {
        let found = fmi::select(self.described, name).map_err(|error| in_file(name, error))?;
        let [position] = found[..] else {
            let first = &self.described.variables[found[0]].name;
            return Err(format!(
                "found {name:?}, {} variables, allowed: one of them: {first:?}",
                found.len()
            ));
        };
        let variable = &self.described.variables[position];
        fmi::set_early(variable).map_err(|error| in_file(name, error))?;
        if variable.kind.base_type() == BaseType::String {
            return Err(format!("found the text {name:?}, allowed: a number, an option or a Boolean"));
        }
        Ok(variable)
    }

    /// A value as `--set` takes it, as a number.
    fn number(&self, variable: &ScalarVariable, written: &str) -> Result<f64, String> {
        let setting = format!("{}={written}", variable.name);
        let read = self
            .dates
            .in_seconds(&setting)
            .and_then(|setting| fmi::parse_assignment(self.described, &setting))
            .map_err(|error| in_file(&variable.name, error))?;
        read.first()
            .map(|(_, value)| value.to_f64())
            .ok_or_else(|| format!("found {written:?}, allowed: a value"))
    }

    fn one(&self, written: &WrittenDistribution<'_>) -> Result<Varied, String> {
        let WrittenDistribution { name, key, values } = *written;
        let variable = self.variable(name)?;
        let is_real = variable.kind.base_type() == BaseType::Real;
        if !is_real && !matches!(key, "values" | "steps") {
            return Err(format!("found {key} of a variable that is no Real, allowed: values"));
        }
        // The last one of `steps` is a count.
        let numbers = if key == "steps" { &values[..2] } else { values };
        let numbers: Vec<f64> =
            numbers.iter().map(|it| self.number(variable, it)).collect::<Result<_, _>>()?;
        let ordered = |from: usize, to: usize| {
            let is = numbers[from] < numbers[to];
            is.then_some(()).ok_or_else(|| {
                format!("found {} and {}, allowed: the smaller one first", values[from], values[to])
            })
        };
        let distribution = match key {
            "normal" => {
                if numbers[1] <= 0.0 {
                    return Err(format!("found the standard deviation {}, allowed: above 0", values[1]));
                }
                Distribution::Normal { mean: numbers[0], sigma: numbers[1] }
            }
            "uniform" => {
                ordered(0, 1)?;
                Distribution::Uniform { from: numbers[0], to: numbers[1] }
            }
            "logUniform" => {
                ordered(0, 1)?;
                if numbers[0] <= 0.0 {
                    return Err(format!("found {}, allowed: above 0, for its logarithm", values[0]));
                }
                Distribution::LogUniform { from: numbers[0], to: numbers[1] }
            }
            "triangular" => {
                ordered(0, 2)?;
                if !(numbers[0]..=numbers[2]).contains(&numbers[1]) {
                    let [from, mode, to] = [&values[0], &values[1], &values[2]];
                    return Err(format!("found the most likely value {mode}, allowed: from {from} to {to}"));
                }
                Distribution::Triangular { from: numbers[0], mode: numbers[1], to: numbers[2] }
            }
            "steps" => {
                let count = values[2].parse::<usize>().ok().filter(|count| (1..=1_000_000).contains(count));
                let count = count.ok_or_else(|| {
                    format!("found {} steps, allowed: a whole number from 1 to 1000000", values[2])
                })?;
                Distribution::steps(numbers[0], numbers[1], count)
            }
            _ => Distribution::Values(numbers),
        };
        if let (false, Some(list)) = (is_real, distribution.listed())
            && let Some(broken) = list.iter().find(|it| it.fract() != 0.0)
        {
            return Err(format!("found {broken} for {}, allowed: whole numbers", variable.name));
        }
        Ok(Varied { name: variable.name.clone(), distribution })
    }

    /// The rows of the campaign's table; a column `run` is that of `--dry-run`.
    fn table(&self) -> Result<(Vec<Varied>, Sampling), String> {
        let path = self.file.table.as_deref().unwrap_or(Path::new(""));
        let shown = path.display();
        let open =
            files::open_at_most(path, files::MAX_TABLE_BYTES).map_err(|error| format!("{shown}: {error}"))?;
        let mut rows = fmi::csv::read_rows(open).map_err(|error| format!("{shown}: {error}"))?;
        if rows.len() < 2 {
            let allowed = "a header with names of variables and a row a run";
            return Err(format!("{shown}: found {} rows, allowed: {allowed}", rows.len()));
        }
        let header = rows.remove(0);
        let columns: Vec<(usize, &ScalarVariable)> = header
            .iter()
            .enumerate()
            .filter(|(_, name)| *name != "run")
            .map(|(column, name)| Ok((column, self.variable(name)?)))
            .collect::<Result<_, String>>()
            .map_err(|what| format!("{shown}: {what}"))?;
        let name = |at: usize| &columns[at].1.name;
        if let Some(twice) = (1..columns.len()).find(|at| (0..*at).any(|other| name(other) == name(*at))) {
            return Err(format!("{shown}: found the column {:?} twice, allowed: once", name(twice)));
        }
        let mut table = Vec::with_capacity(rows.len());
        for (number, row) in rows.iter().enumerate() {
            let cell = |(column, variable): &(usize, &ScalarVariable)| {
                let text = row.get(*column).map_or("", String::as_str);
                self.number(variable, text)
                    .map_err(|what| format!("{shown}: run {number}: {}: {what}", variable.name))
            };
            table.push(columns.iter().map(cell).collect::<Result<Vec<f64>, String>>()?);
        }
        let varied = columns.iter().enumerate().map(|(k, (_, variable))| Varied {
            name: variable.name.clone(),
            distribution: Distribution::Values(table.iter().map(|row| row[k]).collect()),
        });
        Ok((varied.collect(), Sampling::File(table)))
    }

    fn design(&self, varied: Vec<Varied>, sampling: Sampling) -> Result<Design, String> {
        let file = self.file;
        let mut correlations = Vec::new();
        for at in &file.correlations {
            let (names, coefficient) = &at.it;
            let found = names.each_ref().map(|name| self.variable(name).map(|it| it.name.clone()));
            let [one, other] = found;
            let names = [
                one.map_err(|what| file.problem(at, &what))?,
                other.map_err(|what| file.problem(at, &what))?,
            ];
            correlations.push(Correlation { names, coefficient: *coefficient });
        }
        let runs = file.runs.as_ref().map(|at| at.it);
        Design::new(varied, (sampling, runs), &correlations, file.seed).map_err(|error| {
            let (what, shown) = (error.to_string(), file.file.display());
            let at_place = match &error.part {
                DesignPart::Runs => file.runs.as_ref().map(|at| file.problem(at, &what)),
                DesignPart::Variable(name) => {
                    let at = file.distributions().find(|at| name.starts_with(at.it.name));
                    at.map(|at| file.problem(&at, &what))
                }
                DesignPart::Correlations => {
                    file.correlations.first().map(|at| format!("{shown}:{}: correlation: {what}", at.line))
                }
                DesignPart::Campaign => None,
            };
            at_place.unwrap_or_else(|| format!("{shown}: {what}"))
        })
    }
}

/// Runs that are simulated.
pub(super) fn range(runs: Option<&Range<u64>>, campaign: &Campaign) -> Result<Range<u64>, String> {
    let all = campaign.design.runs();
    match runs {
        None => Ok(0..all),
        Some(range) if range.end <= all => Ok(range.clone()),
        Some(range) => Err(format!(
            "--runs: found {}..{}, allowed: within 0..{all}, the campaign's runs",
            range.start, range.end
        )),
    }
}
