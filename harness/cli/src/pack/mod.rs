//! `heliotorque pack`: an FMU from a shared library and a spacecraft.
//!
//! The description comes from the library itself, so it cannot disagree with it. The same input gives the same
//! archive, byte for byte.

use std::path::{Path, PathBuf};

use clap::Args;
use drawing::scenes;
use files::{
    Destination,
    outcome::{self, Outcome},
};
use inputs::{ending::check_ending, kind::FileKind, mission::Mission, variables};
use packing::{
    assembly::{Assembled, Parts, Source, assemble, defaults_at_bounds, reference_flight, unused_map},
    carried::timeline::panels_without_effect,
    pointing,
};

use crate::patience::Reader;

/// Shown with the help.
const EXAMPLE: &str = "\
Example:
  heliotorque check my.toml                                  what is wrong with it, by line
  heliotorque pack my.toml --name MyCraft                    writes MyCraft.fmu
  heliotorque pack mission.toml                              with its files, start values and times";

/// `heliotorque pack`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Pack {
    /// The spacecraft, or a mission whose spacecraft, model, timeline, ephemeris, start values and times are taken where no option
    /// gives others; a TOML file (see `heliotorque new` and `heliotorque check`). Otherwise the spacecraft compiled into the library
    pub file: Option<PathBuf>,
    /// The spacecraft, by an earlier option
    #[arg(long, value_name = "TOML", hide = true)]
    pub spacecraft: Option<PathBuf>,
    /// Commands, positions of panels and events over time, a TOML file (see `heliotorque new timeline`), for models that take
    /// one: MomentumPlant, Guidance; the GUID stays
    #[arg(long, value_name = "TOML")]
    pub timeline: Option<PathBuf>,
    /// Positions of Sun, Earth and planets over time, a TOML file (see `heliotorque ephemeris`), for models that take one;
    /// read where ephemeris.source is chebyshev or coarse; the GUID stays
    #[arg(long, value_name = "TOML")]
    pub ephemeris: Option<PathBuf>,
    /// The mission, by an earlier option
    #[arg(long, value_name = "TOML", hide = true)]
    pub mission: Option<PathBuf>,
    /// Add outputs of every plate: plate[k].temperature and plate[k].force[i], as with `per_plate_outputs = true` in the
    /// spacecraft's file; for models that have them: MomentumPlant, DisturbanceTorque
    #[arg(long)]
    pub per_plate: bool,
    /// Give a parameter or input another start value, in the `[start]` of the packed file; repeatable, written as for
    /// `run`: attitude.source=commanded, dump.threshold=4,4,4
    #[arg(long, value_name = "NAME=VALUE")]
    pub set: Vec<String>,
    /// Make a parameter or input a local constant of this FMU, in the `[fixed]` of the packed file; repeatable, written as for
    /// --set. Dependencies are those of that choice: attitude.source=controlled
    #[arg(long, value_name = "NAME=VALUE")]
    pub fix: Vec<String>,
    /// Name of the new FMU, a C identifier; otherwise the model's
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Take this shared library, just built, instead of a template's; repeatable, one per platform, the host's first
    #[arg(long, value_name = "FILE", conflicts_with = "template", requires = "model")]
    pub library: Vec<PathBuf>,
    /// The model: MomentumPlant, ...; otherwise the template's or MomentumPlant, where it takes the file, or the one that does:
    /// SpinPlant for a spinner's
    #[arg(long, value_name = "MODEL")]
    pub model: Option<String>,
    /// The FMU to write; otherwise its name with .fmu, in this folder; - is the standard output
    #[arg(long, short, value_name = "FMU")]
    pub output: Option<PathBuf>,
    /// The library that reads the file
    #[command(flatten)]
    pub reader: Reader,
}

impl Pack {
    /// Spacecraft and mission, told apart by what stands in the file.
    ///
    /// # Errors
    /// A file that cannot be read, and one beside an option for its kind.
    fn files(&self) -> Result<(Option<&Path>, Option<&Path>), String> {
        let (spacecraft, mission) = (self.spacecraft.as_deref(), self.mission.as_deref());
        let Some(file) = self.file.as_deref() else { return Ok((spacecraft, mission)) };
        let is_mission = FileKind::recognize(&files::read_text(file)?) == Some(FileKind::Mission);
        match (is_mission, spacecraft, mission) {
            (true, _, None) => Ok((spacecraft, Some(file))),
            (false, None, _) => Ok((Some(file), mission)),
            _ => {
                let option = if is_mission { "--mission" } else { "--spacecraft" };
                Err(format!("{}: found it beside {option}, allowed: one of them", file.display()))
            }
        }
    }
}

/// Packs the FMU.
pub(crate) fn run(arguments: &Pack) -> Outcome {
    variables::warn_of_repeated("--set", &arguments.set);
    variables::warn_of_repeated("--fix", &arguments.fix);
    let (spacecraft, mission_file) = arguments.files()?;
    let mission = mission_file.map(Mission::read).transpose()?;
    let given = Parts {
        spacecraft,
        model: arguments.model.as_deref(),
        timeline: arguments.timeline.as_deref(),
        ephemeris: arguments.ephemeris.as_deref(),
        origin: None,
        mission: mission.as_ref(),
        sets: &arguments.set,
        fixes: &arguments.fix,
        per_plate: arguments.per_plate,
        name: arguments.name.as_deref(),
    };
    let parts = match &mission {
        Some(mission) => given.with_files_of(mission)?,
        None => given,
    };
    let source = Source::open(arguments.reader.template(), &arguments.library)?;
    let Assembled { mut entries, identifier, described, description, setup } = assemble(&source, &parts)?;
    source.add_licenses(&mut entries)?;
    let drawing = scenes::svg(&setup);
    let page = packing::manual::html(&description, &described, &setup, drawing.as_deref());
    entries.add("documentation/index.html", page.into_bytes())?;
    if let Some(png) = scenes::png(&setup) {
        entries.add("model.png", png)?;
    }
    let (flight, _) = reference_flight(&entries, &described.reference_inputs)
        .map_err(|error| format!("the FMU is not written: {error}"))?;
    for (path, content) in flight {
        entries.add(&path, content)?;
    }

    let bytes = entries.to_zip()?;
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{identifier}.fmu")));
    check_ending(&path, "fmu")?;
    if source.is_at(&path) {
        return Err(format!("{} is the template itself: see --name and --output", path.display()).into());
    }
    let files = [parts.spacecraft, parts.timeline, parts.ephemeris].into_iter().flatten();
    let inputs: Vec<&Path> = source.paths().into_iter().chain(files).chain(mission_file).collect();
    let windows = pointing::warnings(&description, &[], pointing::windows_of(&setup).as_slice());
    let timeline = parts.timeline.map(files::read_text).transpose()?;
    let panels = timeline.and_then(|text| panels_without_effect(&text, &description, &[], ""));
    let bounds = defaults_at_bounds(&setup);
    let map = unused_map(&setup, &described.model, &description);
    for warning in map.iter().chain(&windows).chain(&panels).chain(&bounds) {
        terminal::note(&format!("warning: {warning}"));
    }
    let destination = Destination::open(&path, "--output", &inputs)?;
    let packed = format!(
        "{}: {identifier}, {} variables, GUID {}, {} kB",
        path.display(),
        description.variables.len(),
        description.guid,
        bytes.len().div_ceil(1000)
    );
    outcome::written(destination, &bytes, &packed)
}
