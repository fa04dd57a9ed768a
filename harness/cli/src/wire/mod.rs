//! `heliotorque wire`: a system of FMUs, connected by the names and units of their variables.

use std::{
    collections::BTreeMap,
    io::IsTerminal,
    path::{Path, PathBuf},
};

use clap::Args;
use files::{
    Destination, Entries,
    outcome::{Answer, Outcome},
};
use fmi::Fmu;
use inputs::{
    ending::check_ending,
    home, kind,
    values::{all_names, duration, span},
    variables,
};
use model_description::{Code, DefaultExperiment, Finding};
use systems::{SSD_FILE, Wired, Wiring};

/// Shown with the help.
const EXAMPLE: &str = "\
Example:
  heliotorque wire guidance=dist/Guidance.fmu plant=MyCraft.fmu > loop.ssp
  heliotorque run loop.ssp --stop 1d --set guidance.pointing.scenario=nadir";

/// `heliotorque wire`.
#[derive(Debug, Args)]
#[command(after_help = EXAMPLE)]
pub(crate) struct Wire {
    /// The FMUs, in the order in which they step: A.fmu is component a, or name=A.fmu
    #[arg(required = true, num_args = 1.., value_name = "FMU")]
    pub fmus: Vec<String>,
    /// List these outputs too, for tools that show only connectors: component.variable, vectors, patterns with *
    #[arg(long, value_name = "NAMES")]
    pub outputs: Vec<String>,
    /// Make these connectors of the system too, by names such as attitude_q_1: outputs, open inputs, parameters. FMPy sets connected
    /// inputs to 0 where it is given nothing; libcosim refuses systems with such connectors
    #[arg(long, value_name = "NAMES")]
    pub export: Vec<String>,
    /// Leave enumerations open, for tools that cannot connect them, and say what each stands at
    #[arg(long)]
    pub without_enumerations: bool,
    /// Give a parameter of a component a value, in a parameter set of the component; repeatable, written as for `run`:
    /// plant.dump.threshold=4,4,4
    #[arg(long, value_name = "COMPONENT.NAME=VALUE")]
    pub set: Vec<String>,
    /// Name of the system; otherwise the file's
    #[arg(long, value_name = "NAME")]
    pub name: Option<String>,
    /// Stop time of the default experiment, in s or with a unit: 1d; otherwise the earliest of the FMUs
    #[arg(long, value_name = "TIME", value_parser = duration, allow_hyphen_values = true)]
    pub stop: Option<f64>,
    /// Communication step of the default experiment, in s or with a unit; otherwise the smallest of the FMUs
    #[arg(long, value_name = "TIME", value_parser = span, allow_hyphen_values = true)]
    pub step: Option<f64>,
    /// The SSP to write; otherwise, and for -, the standard output, where that is no terminal
    #[arg(long, short, value_name = "SSP")]
    pub output: Option<PathBuf>,
    /// Say nothing of what was connected and left open
    #[arg(long, short)]
    pub quiet: bool,
}

/// The system's name where no file gives one.
const DEFAULT_NAME: &str = "System";

/// Writes the SSP.
pub(crate) fn run(arguments: &Wire) -> Outcome {
    let path = arguments.output.clone().unwrap_or_else(|| PathBuf::from("-"));
    if path == Path::new("-") && std::io::stdout().is_terminal() {
        return Err("an SSP is a ZIP archive, which is not written to a terminal: see --output".into());
    }
    check_ending(&path, "ssp")?;
    let named: Vec<(String, PathBuf)> = arguments.fmus.iter().map(|text| named(text)).collect();
    let mut components = Vec::with_capacity(named.len());
    for (name, file) in &named {
        kind::check_archive(file)?;
        let fmu = Fmu::open(file)?;
        if file.is_dir() {
            return Err(format!("{}: found a folder, allowed: an .fmu file", file.display()).into());
        }
        components.push((name.clone(), fmu));
    }
    let stem = path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let name = arguments.name.clone().or(stem.filter(|stem| stem != "-"));
    let (stop_time, step_size) = (arguments.stop, arguments.step);
    let experiment = DefaultExperiment { stop_time, step_size, ..DefaultExperiment::default() };
    let name = name.unwrap_or_else(|| DEFAULT_NAME.to_owned());
    let wiring = Wiring {
        outputs: all_names(&arguments.outputs),
        exports: all_names(&arguments.export),
        without_enumerations: arguments.without_enumerations,
        sets: arguments.set.clone(),
    };
    variables::warn_of_repeated("--set", &arguments.set);
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
        components.iter().flat_map(|(_, fmu)| misfits(fmu)).for_each(|line| terminal::note(&line));
    }
    Ok(Answer::Yes)
}

/// `name=path`, or a path whose file gives the name.
fn named(text: &str) -> (String, PathBuf) {
    let (name, path) = match text.split_once('=') {
        Some((name, path)) if !name.contains(['/', '\\', '.']) => (name.to_owned(), path),
        _ => (systems::component_name(Path::new(text)), text),
    };
    (name, home::found(PathBuf::from(path)))
}

/// Annotations that an FMU cannot be connected by.
fn misfits(fmu: &Fmu) -> impl Iterator<Item = String> {
    let findings = fmu.parsed().findings().into_iter().filter(|it| it.code == Code::Annotation);
    findings.map(|Finding { subject, line, message, .. }| {
        let (file, line) = (fmu.source().display(), line.unwrap_or_default());
        format!("warning: {file}: modelDescription.xml, line {line}: {subject}: {message}")
    })
}

/// Report of the connections between components, and of inputs left open with the reason.
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
    if !wired.implied.is_empty() {
        lines.push(
            "set because the inputs are connected (FMPy reads no parameter sets: see `pack --set`)"
                .to_owned(),
        );
        lines.extend(wired.implied.iter().map(|set| format!("  {set}")));
    }
    lines.push(format!("{} inputs left open", wired.left.len()));
    for ((component, why), names) in grouped(
        wired.left.iter().map(|left| ((left.component.clone(), left.why.clone()), vector(&left.input))),
    ) {
        lines.push(format!("  {component}, {why}:{}", wrapped(&names)));
    }
    lines.extend(wired.unread.iter().map(|unread| format!("warning: {unread}")));
    lines.join("\n")
}

/// Names in lines that a terminal shows whole.
pub(crate) fn wrapped(names: &[String]) -> String {
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
pub(crate) fn grouped<K: Ord>(all: impl Iterator<Item = (K, String)>) -> BTreeMap<K, Vec<String>> {
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
pub(crate) fn vector(name: &str) -> String {
    variables::vector(name).unwrap_or(name).to_owned()
}
