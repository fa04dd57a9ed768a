//! What an FMI 2.0 co-simulation FMU must do: one list of probes.
//!
//! `heliotorque check` runs each probe on a foreign FMU in a process of its own, the tests run all of them on this
//! project's FMUs through their shared library.

mod experiment;
mod finding;
mod probe;
mod probes;
mod static_checks;
mod verdict;

use loader::{Error, Fmu};

pub use finding::{Finding, Verdict};
pub use probe::{Findings, Probe, Trial};
pub use static_checks::{archive, description};

use probes::{calls, host, library, reference as reference_flight, state, stepping, times, values};

/// Every trial of every probe.
pub fn trials() -> impl Iterator<Item = &'static Trial> {
    times::TRIALS.iter().chain(host::TRIALS)
}

/// Every probe, in the order of the report.
pub const PROBES: &[Probe] = &[
    Probe { name: "library", title: "loads, exports every function", run: library::probe },
    Probe { name: "simulation", title: "runs its default experiment", run: stepping::simulation },
    Probe {
        name: "reference",
        title: "meets the reference flights it carries",
        run: reference_flight::flights,
    },
    Probe {
        name: "values",
        title: "start values read back, limits and references are kept",
        run: values::probe,
    },
    Probe {
        name: "calls",
        title: "answers every function in every state as FMI 2.0 requires",
        run: calls::probe,
    },
    Probe { name: "times", title: "takes jittered, uneven and refuses wrong times", run: times::probe },
    Probe { name: "states", title: "saves, restores, serialises and resets to the bit", run: state::probe },
    Probe {
        name: "derivatives",
        title: "input, output and directional derivatives",
        run: values::derivatives,
    },
    Probe {
        name: "callbacks",
        title: "works without memory functions and without the callbacks' struct",
        run: host::callbacks,
    },
    Probe { name: "nulls", title: "takes NULL for vectors of no length", run: host::nulls },
    Probe { name: "paths", title: "finds its resources under strange paths", run: host::paths },
    Probe {
        name: "identity",
        title: "refuses a wrong GUID, takes strange instance names",
        run: host::identity,
    },
    Probe { name: "locale", title: "runs alike under a comma locale", run: host::locale },
    Probe {
        name: "threads",
        title: "two instances on two threads do not disturb each other",
        run: host::threads,
    },
    Probe { name: "instances", title: "many instances come and go", run: host::instances },
];

/// Runs the probe or trial of this name; `None` where there is none. An FMU that fails in it is a finding.
pub fn run(fmu: &Fmu, name: &str) -> Option<Vec<Finding>> {
    let findings = if let Some(probe) = PROBES.iter().find(|probe| probe.name == name) {
        (probe.run)(fmu)
    } else {
        let trial = trials().find(|trial| trial.name() == name)?;
        (trial.run)(fmu, trial)
    };
    Some(findings.unwrap_or_else(|error| vec![Finding::bad(Error::chain(&error))]))
}
