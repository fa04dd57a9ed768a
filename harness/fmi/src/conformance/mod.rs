//! Conformance of a co-simulation FMU with FMI 2.0: one list of probes.
//!
//! `heliotorque check` runs each probe on a foreign FMU in a process of its own, the tests run all of them on this
//! project's FMUs through their shared library.

mod experiment;
mod finding;
mod findings;
mod probe;
mod probes;
mod report;
mod static_checks;

use crate::Fmu;

pub use finding::{Finding, Verdict};
pub use probe::{Probe, Trial};
pub use probes::state::resets;
pub use report::{Listed, Report, Section};
pub use static_checks::{archive, description};

use findings::{Findings, Outcome};
use probes::{calls, host, library, reference as reference_flight, state, stepping, times, values};

/// Every trial of every probe.
pub fn trials() -> impl Iterator<Item = &'static Trial> {
    times::TRIALS.iter().chain(host::TRIALS)
}

/// Every probe, in the order of the report.
pub const PROBES: &[Probe] = &[
    probe("library", "loads, exports every function", library::probe),
    probe("simulation", "runs its default experiment", stepping::simulation),
    probe("reference", "meets the reference flights it carries", reference_flight::flights),
    probe("values", "start values read back, limits and references are kept", values::probe),
    probe("calls", "answers every function in every state as FMI 2.0 requires", calls::probe),
    probe("times", "takes jittered, uneven and refuses wrong times", times::probe),
    probe("states", "saves, restores, serialises and resets to the bit", state::probe),
    probe("derivatives", "input, output and directional derivatives", values::derivatives),
    probe("callbacks", "works without memory functions and without the callbacks' struct", host::callbacks),
    probe("nulls", "takes NULL for vectors of no length", host::nulls),
    probe("paths", "finds its resources under strange paths", host::paths),
    probe("identity", "refuses a wrong GUID, takes strange instance names", host::identity),
    probe("locale", "runs alike under a comma locale", host::locale),
    probe("threads", "two instances on two threads do not disturb each other", host::threads),
    probe("instances", "many instances come and go", host::instances),
];

const fn probe(name: &'static str, title: &'static str, run: fn(&mut Findings<'_>) -> Outcome) -> Probe {
    Probe { name, title, run }
}

/// Runs the probe or trial of this name; `None` where there is none. An FMU that fails in it is a finding.
pub fn run(fmu: &Fmu, name: &str) -> Option<Vec<Finding>> {
    if let Some(probe) = PROBES.iter().find(|probe| probe.name == name) {
        return Some(Findings::gathered(fmu, probe.run));
    }
    let trial = trials().find(|trial| trial.name() == name)?;
    Some(Findings::gathered(fmu, |findings| (trial.run)(findings, trial)))
}
