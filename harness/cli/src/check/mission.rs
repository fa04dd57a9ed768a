//! `heliotorque check mission.toml`: whether a mission can be simulated; its first step is simulated.

use campaign::run::{Prepared, Run, Settings, long_step};
use fmi::Collector;
use inputs::{epoch, kind::FileKind};
use packing::{carried, check::Judged};

use super::options::Check;

/// Reads the file, packs what it names, finds every name and value in it and opens what it writes, as `run` does; then simulates
/// the first step in this process.
pub(super) fn judged(arguments: &Check, file: &str) -> Judged {
    match summary(arguments) {
        Ok((summary, warnings)) => Judged::Taken { summary: format!("{file}: ok: {summary}"), warnings },
        Err(error) => Judged::Refused {
            problems: fmi::Error::chain(error.as_ref()),
            kind: FileKind::Mission.to_string(),
        },
    }
}

fn summary(arguments: &Check) -> Result<(String, Vec<String>), Box<dyn std::error::Error>> {
    let run = Run { fmu: arguments.subject.clone(), template: arguments.template.clone(), ..Run::default() };
    let Prepared { simulated, subject, settings, .. } = &Prepared::new(&run)?;
    let Settings { times, requested, limits, sets, positions, inputs, .. } = settings;
    let mut rows = Collector::new(subject.description(), positions);
    let mut end_after_first_step = |_| false;
    let (_, messages) =
        settings.simulate_into(subject, &simulated.run, (&mut end_after_first_step, None), &mut rows)?;
    let short = terminal::short;
    let begin = simulated.mission.as_ref().and_then(|mission| epoch::date(mission.epoch_s()?.it));
    let begin = begin.unwrap_or_else(|| format!("{} s", short(times.start_s)));
    let mut warnings = carried::timeline::warnings(subject.description(), sets, &subject.parts());
    warnings.extend(long_step(times));
    warnings.extend(inputs.iter().flat_map(|it| it.warnings(subject.description(), times)));
    warnings.extend(fmi::warnings(&messages).into_iter().map(str::to_owned));
    let count = |count: usize, of: &str| format!("{count} {of}{}", if count == 1 { "" } else { "s" });
    let summary = format!(
        "{} runs from {begin} for {} in {} of {} s; {} recorded, {}, {}",
        subject.name(),
        span(times.stop_s - times.start_s),
        count(usize::try_from(times.steps()).unwrap_or(usize::MAX), "step"),
        short(times.step_s),
        count(requested.columns, "variable"),
        count(requested.plots.len(), "picture"),
        count(limits.len(), "limit"),
    );
    Ok((summary, warnings))
}

/// A duration in the largest unit that it has more than one of.
fn span(span_s: f64) -> String {
    const UNITS: [(f64, &str); 3] = [(86_400.0, "d"), (3600.0, "h"), (60.0, "min")];
    let unit = UNITS.into_iter().find(|(unit_s, _)| span_s >= 2.0 * unit_s);
    let (unit_s, unit) = unit.unwrap_or((1.0, "s"));
    format!("{} {unit}", terminal::short(span_s / unit_s))
}
