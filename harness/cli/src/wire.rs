//! `heliotorque wire`: a system of FMUs, connected by the names and units of their variables.

use std::{
    collections::BTreeMap,
    io::IsTerminal,
    path::{Path, PathBuf},
    process::ExitCode,
};

use files::{Destination, Entries};
use loader::Fmu;
use systems::{Experiment, SSD_FILE, Wired, Wiring};

use crate::{args::Wire, home, outcome::Outcome};

/// The system's name where no file gives one.
const DEFAULT_NAME: &str = "System";

/// Writes the SSP.
pub fn run(arguments: &Wire) -> Outcome {
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from("-"));
    if path == Path::new("-") && std::io::stdout().is_terminal() {
        return Err("an SSP is a ZIP archive, which is not written to a terminal: see --output".into());
    }
    let named: Vec<(String, PathBuf)> = arguments.fmus.iter().map(|text| named(text)).collect();
    let named = named.into_iter().map(|(name, file)| (name, home::found(file)));
    let named: Vec<(String, PathBuf)> = named.collect();
    let mut components = Vec::with_capacity(named.len());
    for (name, file) in &named {
        let fmu = Fmu::open(file)?;
        if file.is_dir() {
            return Err(format!("{}: found a folder, allowed: an .fmu file", file.display()).into());
        }
        components.push((name.clone(), fmu));
    }
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let name = arguments.name.clone().or(stem.filter(|stem| stem != "-"));
    let experiment = Experiment { start_s: None, stop_s: arguments.stop, step_s: arguments.step };
    let name = name.unwrap_or_else(|| DEFAULT_NAME.to_owned());
    let wiring = Wiring {
        outputs: arguments.outputs.clone(),
        exports: arguments.export.clone(),
        without_enumerations: arguments.without_enumerations,
        sets: arguments.set.clone(),
    };
    let wired = systems::wire(&name, &components, experiment, &wiring)?;

    let mut entries = Entries::default();
    entries.add(SSD_FILE, systems::to_xml(&wired.structure).into_bytes())?;
    for ((_, file), component) in named.iter().zip(&wired.structure.components) {
        let bytes = files::read(file).map_err(|error| format!("{}: {error}", file.display()))?;
        entries.add(&component.source, bytes)?;
        for binding in &component.bindings {
            if let (Some(file), [set]) = (&binding.source, binding.sets.as_slice()) {
                entries.add(file, systems::to_parameter_set(set).into_bytes())?;
            }
        }
    }
    let bytes = entries.to_zip()?;
    let inputs: Vec<&Path> = named.iter().map(|(_, file)| file.as_path()).collect();
    Destination::open(&path, "--output", &inputs)?.fill(|file| file.write_all(&bytes))?;
    if !arguments.quiet {
        terminal::note(&report(&wired));
    }
    Ok(ExitCode::SUCCESS)
}

/// `name=path`, or a path whose file gives the name.
fn named(text: &str) -> (String, PathBuf) {
    match text.split_once('=') {
        Some((name, path)) if !name.contains(['/', '\\', '.']) => (name.to_owned(), PathBuf::from(path)),
        _ => (systems::component_name(Path::new(text)), PathBuf::from(text)),
    }
}

/// What was connected between which components, and what was left open and why.
fn report(wired: &Wired) -> String {
    let mut lines = vec![format!("{} connections", wired.structure.connections.len())];
    for ((from, to), names) in grouped(wired.structure.connections.iter().map(|connection| {
        let component = |end: &systems::End| end.component.clone().unwrap_or_else(|| "the system".to_owned());
        let (start, end) = (&connection.start, &connection.end);
        let name = if start.connector == end.connector {
            vector(&end.connector)
        } else {
            format!("{} to {}", vector(&start.connector), vector(&end.connector))
        };
        ((component(start), component(end)), name)
    })) {
        lines.push(format!("  {from} to {to}:{}", wrapped(&names)));
    }
    lines.push(format!("{} inputs left open", wired.left.len()));
    for ((component, why), names) in grouped(
        wired.left.iter().map(|left| ((left.component.clone(), left.why.clone()), vector(&left.input))),
    ) {
        lines.push(format!("  {component}, {why}:{}", wrapped(&names)));
    }
    lines.join("\n")
}

/// Names in lines that a terminal shows whole.
pub fn wrapped(names: &[String]) -> String {
    const WIDTH: usize = 110;
    let mut lines = vec![String::new()];
    for (number, name) in names.iter().enumerate() {
        let comma = if number + 1 < names.len() { "," } else { "" };
        let line = lines.len() - 1;
        if !lines[line].is_empty() && lines[line].len() + name.len() > WIDTH {
            lines.push(format!("{name}{comma}"));
        } else {
            let space = if lines[line].is_empty() { "" } else { " " };
            lines[line].push_str(&format!("{space}{name}{comma}"));
        }
    }
    lines.iter().map(|line| format!("\n    {line}")).collect()
}

/// Names by what they have in common, each once, in their order.
pub fn grouped<K: Ord>(all: impl Iterator<Item = (K, String)>) -> BTreeMap<K, Vec<String>> {
    let mut groups: BTreeMap<K, Vec<String>> = BTreeMap::new();
    for (key, name) in all {
        let names = groups.entry(key).or_default();
        if !names.contains(&name) {
            names.push(name);
        }
    }
    groups
}

/// The vector that an element is of; of any other variable its name.
pub fn vector(name: &str) -> String {
    let split = name.strip_suffix(']').and_then(|name| name.rsplit_once('['));
    split.map_or_else(|| name.to_owned(), |(vector, _)| vector.to_owned())
}
