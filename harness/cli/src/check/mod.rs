//! `heliotorque check`: everything that can be wrong with an FMU, found and named.
//!
//! Archive, description and exported symbols are read here. Probes run in a process of their own each, so that an FMU that crashes or hangs
//! is a finding and not the end.

mod files;
mod options;

use std::path::Path;

use fmi::{
    Fmu,
    conformance::{Finding, PROBES, Probe as Probed, Report, Section},
};
use isolation::probes;
use packing::{carried, check::Judged, pointing};

use ::files::outcome::{self, Answer, Outcome};
pub(crate) use options::Check;

/// Checks an FMU, a system or a spacecraft and prints the report.
pub(crate) fn run(arguments: &Check) -> Outcome {
    if arguments.is_file() {
        return match (arguments.is_static, &arguments.probe) {
            (false, None) => {
                let file = arguments.subject.display().to_string();
                print_judged(arguments, &file, &files::judged(arguments, &file)?)
            }
            (true, _) => Err("--static is for an FMU: a spacecraft is only read".into()),
            (false, Some(_)) => Err("--probe is for an FMU: a spacecraft has no probes".into()),
        };
    }
    if systems::is_system(&arguments.subject) {
        if arguments.probe.is_some() || arguments.template.is_some() {
            return Err("--probe and --template are for an FMU or a spacecraft, and this is a system".into());
        }
        check_there(&arguments.subject)?;
        return report(arguments, &[Section::new("system", systems::findings(&arguments.subject))]);
    }
    if arguments.template.is_some() {
        return Err("--template is for a spacecraft (.toml): an FMU is checked by its own library".into());
    }
    if let Some(text) = &arguments.probe
        && !PROBES.iter().any(|probe| is_selected(arguments, probe))
    {
        let names: Vec<&str> = PROBES.iter().map(|probe| probe.name).collect();
        return Err(
            format!("no probe's name contains {text:?}, allowed: {}: see --probe", names.join(", ")).into()
        );
    }
    check_there(&arguments.subject)?;
    let fmu = match Fmu::open(&arguments.subject) {
        Ok(fmu) => fmu,
        Err(error) => {
            let finding = Finding::bad(fmi::Error::chain(&error));
            return report(arguments, &[Section::new("archive", vec![finding])]);
        }
    };
    let mut sections = vec![
        Section::new("archive", fmi::conformance::archive(&fmu)),
        Section::new("modelDescription.xml", fmi::conformance::description(&fmu)),
    ];
    let folder = [(String::new(), fmu.folder().to_owned())];
    let windows = pointing::warnings(fmu.description(), &[], &pointing::windows_in(&folder));
    if !windows.is_empty() {
        sections.push(Section::new("orbit", windows.into_iter().map(Finding::note)));
    }
    let panels = carried::timeline::warnings(fmu.description(), &[], &folder);
    if !panels.is_empty() {
        sections.push(Section::new("panels", panels.into_iter().map(Finding::note)));
    }
    sections.extend(carried::summaries(&fmu).into_iter().map(|(file, read)| match read {
        Ok(summary) => Section::new(file, vec![Finding::good(summary)]),
        Err(problems) => Section::new(file, problems.text.lines().map(Finding::bad)),
    }));
    if !arguments.is_static && fmu.co_simulation().is_ok() {
        sections.extend(probes::sections(&fmu, |probe| is_selected(arguments, probe), arguments.deadline()));
    }
    report(arguments, &sections)
}

/// Refuses a file that is not there.
fn check_there(path: &Path) -> Result<(), String> {
    path.metadata().map(drop).map_err(|error| format!("{}: {error}", path.display()))
}

/// Whether `--probe` leaves a probe in.
fn is_selected(arguments: &Check, probe: &Probed) -> bool {
    arguments.probe.as_ref().is_none_or(|text| probe.name.contains(text.as_str()))
}

/// Prints the report.
fn report(arguments: &Check, sections: &[Section]) -> Outcome {
    let file = arguments.subject.display().to_string();
    let report = Report::new(&file, sections);
    let text = if arguments.json { report.json()? } else { report.text(arguments.verbose) };
    let [.., failed] = report.counts();
    outcome::printed(&text).map(|_| Answer::from(failed == 0))
}

/// Prints the verdict on a file.
fn print_judged(arguments: &Check, file: &str, judged: &Judged) -> Outcome {
    match judged {
        _ if arguments.json => report(arguments, &[judged.section()]),
        Judged::Taken { summary, warnings } => {
            let warnings: String = warnings.iter().map(|warning| format!("\nwarning: {warning}")).collect();
            outcome::printed(&format!("{summary}{warnings}"))
        }
        Judged::Refused { problems, kind } => problems.print(file, kind),
    }
}
