//! What a run flies: the arguments of `heliotorque run` over those of a mission, and the FMU packed from its files.

use std::{
    error::Error,
    path::{Path, PathBuf},
};

use files::Scratch;
use loader::Fmu;

use crate::{
    args::Run,
    mission::{Craft, Inputs, Mission},
    pack::{
        assemble::{Assembled, Parts, assemble},
        source::Source,
    },
};

use super::subject::Subject;

/// A run as it is meant.
pub struct Flown {
    /// The arguments, a mission's where none are given.
    pub run: Run,
    /// The mission, if the arguments name one.
    pub mission: Option<Mission>,
}

impl Flown {
    /// Reads the mission if the arguments name one.
    pub fn of(arguments: &Run) -> Result<Self, String> {
        let is_toml = |path: &Path| path.extension().is_some_and(|extension| extension == "toml");
        if !is_toml(&arguments.fmu) {
            if arguments.template.is_some() {
                return Err("--template is for a mission (.toml): an FMU has its own library".to_owned());
            }
            return Ok(Self { run: arguments.clone(), mission: None });
        }
        let mission = Mission::read(&arguments.fmu)?;
        let mut run = arguments.clone();
        run.start = run.start.or(mission.start_s);
        run.stop = run.stop.or(mission.stop_s);
        run.step = run.step.or(mission.step_s);
        run.every = run.every.or(mission.every_s);
        run.output = run.output.or_else(|| mission.output.clone());
        if let (None, Some(Inputs::File(path))) = (&run.input, &mission.inputs) {
            run.input = Some(path.clone());
        }
        Ok(Self { run, mission: Some(mission) })
    }

    /// Opens what flies; a mission's files are packed into a temporary FMU.
    pub fn open(&self) -> Result<(Subject, Option<Scratch>), Box<dyn Error>> {
        let Some(mission) = &self.mission else { return Ok((Subject::open(&self.run.fmu)?, None)) };
        if let Craft::Fmu(path) = &mission.craft {
            if self.run.template.is_some() {
                return Err(
                    "--template is for a mission with a spacecraft: its FMU has its own library".into()
                );
            }
            return Ok((Subject::open(path)?, None));
        }
        let (folder, _) = packed(mission, self.run.template.as_deref())?;
        Ok((Subject::Fmu(Fmu::open(folder.path())?), Some(folder)))
    }

    /// The files that are read, so not written over.
    pub fn reads(&self) -> Vec<&Path> {
        let of_mission = self.mission.iter().flat_map(Mission::reads);
        of_mission.chain([self.run.fmu.as_path()]).chain(self.run.input.as_deref()).collect()
    }
}

/// The FMU of a mission's files, in a temporary folder.
pub fn packed(mission: &Mission, template: Option<&Path>) -> Result<(Scratch, Assembled), Box<dyn Error>> {
    let name = identifier(&mission.file);
    let parts = Parts { name: name.as_deref(), ..Parts::default() }.with_files_of(mission)?;
    let source = Source::open(template, None)?;
    let assembled = assemble(&source, &parts)?;
    let failed = |path: PathBuf, error: std::io::Error| format!("{}: {error}", path.display());
    let folder = Scratch::new("heliotorque-").map_err(|error| failed(std::env::temp_dir(), error))?;
    assembled.entries.write_below(folder.path()).map_err(|error| failed(folder.path().to_owned(), error))?;
    Ok((folder, assembled))
}

/// A name for the FMU, from its mission's file.
fn identifier(file: &Path) -> Option<String> {
    let stem = file.file_stem()?.to_str()?;
    let name: String = stem.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    model_description::names::is_c_identifier(&name).then_some(name)
}
