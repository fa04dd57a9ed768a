//! `heliotorque pack`: an FMU from a shared library and a spacecraft.
//!
//! The description comes from the library itself, so it cannot disagree with it. The same input gives the same
//! archive, byte for byte.

pub mod assemble;
mod manual;
mod per_plate;
mod schedule;
pub mod source;
pub mod start;
pub mod without_effect;

use std::{
    error::Error,
    path::{Path, PathBuf},
    process::ExitCode,
};

use files::{Destination, Entries, Scratch};
use loader::Fmu;

use crate::{args::Pack, draw, mission::Mission, outcome::Outcome};
use assemble::{Assembled, Parts, assemble};
use source::Source;

/// Paths within an archive with what stands there.
type Contents = Vec<(String, Vec<u8>)>;

/// The files of the reference flight of the FMU that these files make; an error where it cannot fly it.
pub fn reference_flight(entries: &Entries, inputs: &str) -> Result<Contents, Box<dyn Error>> {
    let folder = Scratch::new()?;
    entries.write_below(folder.path())?;
    let fmu = Fmu::open(folder.path())?;
    Ok(reference::record(&fmu, inputs).map_err(|error| loader::Error::chain(&error))?)
}

/// Packs the FMU.
pub fn run(arguments: &Pack) -> Outcome {
    let mission = arguments.mission.as_deref().map(Mission::read).transpose()?;
    let given = Parts {
        spacecraft: arguments.spacecraft.as_deref(),
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
    let source = Source::open(arguments.template.as_deref(), arguments.library.as_deref())?;
    let Assembled { mut entries, identifier, described, description, setup } = assemble(&source, &parts)?;
    source.add_licenses(&mut entries)?;
    let drawing = draw::svg(&setup);
    let page = manual::html(&description, &described, &setup, drawing.as_deref());
    entries.add("documentation/index.html", page.into_bytes())?;
    if let Some(png) = draw::png(&setup) {
        entries.add("model.png", png)?;
    }
    let flight = reference_flight(&entries, &described.reference_inputs)
        .map_err(|error| format!("the FMU is not written: {error}"))?;
    for (path, content) in flight {
        entries.add(&path, content)?;
    }

    let bytes = entries.to_zip()?;
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{identifier}.fmu")));
    if source.is_at(&path) {
        return Err(format!("{} is the template itself: see --name and --output", path.display()).into());
    }
    let files = [parts.spacecraft, parts.timeline, parts.ephemeris].into_iter().flatten();
    let of_mission = arguments.mission.as_deref();
    let inputs: Vec<&Path> = [source.path()].into_iter().chain(files).chain(of_mission).collect();
    if let Some(warning) = without_effect::unused_map(&setup, &described.model, &description) {
        terminal::note(&format!("warning: {warning}"));
    }
    let destination = Destination::open(&path, "--output", &inputs)?;
    let is_stdout = destination.is_stdout();
    destination.fill(|file| file.write_all(&bytes))?;
    let packed = format!(
        "{}: {identifier}, {} variables, GUID {}, {} kB",
        path.display(),
        description.variables.len(),
        description.guid,
        bytes.len().div_ceil(1000)
    );
    if is_stdout {
        terminal::note(&packed)
    } else {
        terminal::print(&packed)?
    }
    Ok(ExitCode::SUCCESS)
}
