//! `heliotorque pack`: an FMU from a shared library and a spacecraft.
//!
//! The description comes from the library itself, so it cannot disagree with it. The same input gives the same
//! archive, byte for byte.

mod documentation;
mod per_plate;
mod picture;
mod schedule;
pub mod source;
pub mod start;

use std::{
    error::Error,
    path::{Path, PathBuf},
    process::ExitCode,
};

use loader::{Binary, Described, Fmu};
use model_description::Description;

use files::{Destination, Entries, Scratch};

use crate::{args::Pack, draw, outcome::Outcome};
use source::Source;

/// A refusal, with the model that takes the file if there is another.
fn with_hint(
    binary: &Binary,
    model: &str,
    file: Option<&str>,
    text: Option<&str>,
    refusal: String,
) -> String {
    let takes = |other: &Described| {
        let reads_files = other.model != model && other.setup_file.is_some() && text.is_some();
        reads_files && binary.describe(&other.model, file, text).is_ok()
    };
    match binary.models().unwrap_or_default().into_iter().find(takes) {
        Some(other) => format!("{refusal}\nthis is a file of {}: see --model", other.model),
        None => refusal,
    }
}

/// Adds the reference flight of the FMU that these files make. An FMU that cannot fly it is not written.
fn add_reference_flight(entries: &mut Entries, inputs: &str) -> Result<(), Box<dyn Error>> {
    let folder = Scratch::new("heliotorque-")?;
    entries.write_below(folder.path())?;
    let fmu = Fmu::open(folder.path())?;
    let flight = reference::record(&fmu, inputs)
        .map_err(|error| format!("the FMU is not written: {}", loader::Error::chain(&error)))?;
    for (path, content) in flight {
        entries.add(&path, content)?;
    }
    Ok(())
}

/// Packs the FMU.
pub fn run(arguments: &Pack) -> Outcome {
    let source = Source::open(arguments.template.as_deref(), arguments.library.as_deref())?;
    let spacecraft = arguments.spacecraft.as_deref().map(files::read_text).transpose()?;
    let file = arguments.spacecraft.as_deref().map(|path| path.display().to_string());
    let model = match &arguments.model {
        Some(model) => model.clone(),
        None => source.model_for(file.as_deref(), spacecraft.as_deref())?,
    };
    let described =
        source.binary().describe(&model, file.as_deref(), spacecraft.as_deref()).map_err(|refusal| {
            with_hint(source.binary(), &model, file.as_deref(), spacecraft.as_deref(), refusal)
        })?;
    let mut description = model_description::parse(described.xml.as_bytes())?.description;
    let mut setup = spacecraft.unwrap_or_else(|| described.default_setup.clone());
    if !arguments.set.is_empty() {
        if described.setup_file.is_none() {
            return Err(format!("--set: {model} reads no file that start values could stand in").into());
        }
        setup = start::with_start_values(&setup, &model, &description, &arguments.set)?;
        let again = source.binary().describe(&model, file.as_deref(), Some(&setup))?;
        description = model_description::parse(again.xml.as_bytes())?.description;
    }
    if arguments.per_plate {
        // After the user's own text was read as it stands, so that errors name its lines.
        setup = per_plate::asking(&setup)?;
        description = per_plate::describe(source.binary(), &model, file.as_deref(), &setup)?;
    }
    let mut schedules = Vec::new();
    for (kind, path) in
        [(schedule::TIMELINE, &arguments.timeline), (schedule::EPHEMERIS, &arguments.ephemeris)]
    {
        let Some(path) = path else { continue };
        let (shown, text) = (path.display().to_string(), files::read_text(path)?);
        let given = (shown.as_str(), text.as_str());
        let name = kind.checked(source.binary(), &described, file.as_deref(), &setup, given)?;
        schedules.push((name, text));
    }
    let identifier = arguments.name.as_deref().unwrap_or(&model);
    rename(&mut description, identifier)?;

    let mut entries = Entries::default();
    entries.add("modelDescription.xml", model_description::to_xml(&description).into_bytes())?;
    source.add_libraries(&mut entries, identifier)?;
    source.add_licenses(&mut entries)?;
    if let Some(name) = &described.setup_file {
        entries.add(&format!("resources/{name}"), setup.clone().into_bytes())?;
    }
    for (name, text) in schedules {
        entries.add(&format!("resources/{name}"), text.into_bytes())?;
    }
    let drawing = draw::svg(&setup);
    let page = documentation::html(&description, &described.sources, drawing.as_deref());
    entries.add("documentation/index.html", page.into_bytes())?;
    if let Some(png) = picture::png(&setup) {
        entries.add("model.png", png)?;
    }

    add_reference_flight(&mut entries, &described.reference_inputs)?;

    let bytes = entries.to_zip()?;
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from(format!("{identifier}.fmu")));
    if source.is_at(&path) {
        return Err(format!("{} is the template itself: see --name and --output", path.display()).into());
    }
    let files = [&arguments.spacecraft, &arguments.timeline, &arguments.ephemeris].into_iter().flatten();
    let inputs: Vec<&Path> = [source.path()].into_iter().chain(files.map(PathBuf::as_path)).collect();
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

/// Gives the FMU its own name. The library finds its model by the GUID, which stays.
fn rename(description: &mut Description, identifier: &str) -> Result<(), String> {
    if !model_description::names::is_c_identifier(identifier) {
        return Err(format!(
            "--name {identifier:?} is no C identifier: letters, digits and _, not starting with a digit"
        ));
    }
    identifier.clone_into(&mut description.model_name);
    if let Some(co_simulation) = &mut description.co_simulation {
        identifier.clone_into(&mut co_simulation.model_identifier);
    }
    Ok(())
}
