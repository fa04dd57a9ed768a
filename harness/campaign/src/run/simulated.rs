//! Subject of a run: the arguments of `heliotorque run` over those of a mission, and the FMU packed from its files.

use std::{error::Error, path::Path};

use files::{
    Scratch,
    outcome::{Answer, Outcome, Refusal},
};
use fmi::Fmu;
use inputs::{
    kind,
    mission::{Inputs, Mission},
    values::Instant,
};
use isolation::{Bounds, Relayed, Request, SMALL};
use packing::assembly::{Parts, Source, assemble};

use super::{options::Run, subject::Subject};

/// Longest time in s that a call may take in which a library reads a mission's files, where --timeout says nothing.
const PACKING_S: f64 = 60.0;

/// A run as it is meant.
pub struct Simulated {
    /// The arguments, a mission's where none are given.
    pub run: Run,
    /// The mission, if the arguments name one.
    pub mission: Option<Mission>,
}

impl Simulated {
    /// Reads the mission if the arguments name one.
    pub fn new(arguments: &Run) -> Result<Self, Refusal> {
        let is_toml = |path: &Path| path.extension().is_some_and(|extension| extension == "toml");
        if !is_toml(&arguments.fmu) {
            if arguments.template.is_some() {
                return Err("--template is for a mission (.toml): an FMU has its own library"
                    .to_owned()
                    .into());
            }
            return Ok(Self { run: arguments.clone(), mission: None });
        }
        let mission = Mission::read_as(&arguments.fmu, arguments.origin.as_ref().unwrap_or(&arguments.fmu))?;
        let mut run = arguments.clone();
        run.start = run.start.or(mission.start_s());
        run.stop = run.stop.or(mission.stop_s().map(Instant::Time));
        run.step = run.step.or(mission.step_s);
        run.every = run.every.or(mission.every_s);
        if let (None, Some(Inputs::File(path))) = (&run.input, &mission.inputs) {
            run.input = Some(path.clone());
        }
        Ok(Self { run, mission: Some(mission) })
    }

    /// The epoch of time 0 in s past J2000 TDB, where the mission begins at a date.
    pub fn zero_epoch_s(&self, start_s: f64) -> Option<f64> {
        Some(self.mission.as_ref()?.epoch_s()?.it - start_s)
    }

    /// Opens the FMU; a mission's files are packed into a temporary FMU.
    pub fn open(&self) -> Result<(Subject, Option<Scratch>), Box<dyn Error>> {
        let Some(mission) = &self.mission else { return Ok((Subject::open(&self.run.fmu)?, None)) };
        if let Some(path) = &mission.fmu {
            if self.run.template.is_some() {
                return Err(
                    "--template is for a mission with a spacecraft: its FMU has its own library".into()
                );
            }
            kind::check_archive(path)?;
            return Ok((Subject::open(path)?, None));
        }
        let folder = self.packed(mission)?;
        Ok((Subject::Fmu(Fmu::open(folder.path())?), Some(folder)))
    }

    /// The FMU of the mission's files, in a temporary folder.
    fn packed(&self, mission: &Mission) -> Result<Scratch, Box<dyn Error>> {
        let failed = |error: std::io::Error| format!("{}: {error}", std::env::temp_dir().display());
        let folder = Scratch::new().map_err(failed)?;
        let template = self.run.template.as_deref();
        if terminal::is_relayed() {
            assemble_files(mission, template, folder.path())?;
            return Ok(folder);
        }
        let name = template.map_or_else(|| "the library".to_owned(), |path| path.display().to_string());
        let bounds = Bounds::of_calls(self.run.timeout.unwrap_or(PACKING_S));
        let [file, mission, into] = [&mission.file, &mission.path, folder.path()].map(Into::into);
        let request = Request::Assemble { mission, file, template: template.map(Into::into), into };
        Relayed { name, bounds, limits: SMALL }.run(request)?;
        Ok(folder)
    }

    /// The files that are read, so not written over.
    pub fn reads(&self) -> Vec<&Path> {
        let of_mission = self.mission.iter().flat_map(Mission::reads);
        of_mission.chain([self.run.fmu.as_path()]).chain(self.run.input.as_deref()).collect()
    }
}

/// Puts the FMU of a mission's files together in a folder; messages name the mission by `file`.
///
/// # Errors
/// Whatever the mission or the library refuses.
pub fn assemble_into([mission, file]: [&Path; 2], template: Option<&Path>, into: &Path) -> Outcome {
    assemble_files(&Mission::read_as(mission, file)?, template, into)?;
    Ok(Answer::Yes)
}

fn assemble_files(mission: &Mission, template: Option<&Path>, into: &Path) -> Result<(), Box<dyn Error>> {
    let name = identifier(&mission.path);
    let parts = Parts { name: name.as_deref(), ..Parts::default() }.with_files_of(mission)?;
    let assembled = assemble(&Source::open(template, &[])?, &parts)?;
    assembled.entries.write_below(into).map_err(|error| format!("{}: {error}", into.display()))?;
    Ok(())
}

/// A name for the FMU, from its mission's file.
fn identifier(file: &Path) -> Option<String> {
    let stem = file.file_stem()?.to_str()?;
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    model_description::names::is_c_identifier(&name).then_some(name)
}
