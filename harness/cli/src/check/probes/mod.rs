//! The probes: what they are called and what they ask of an FMU.

mod bench;
mod calls;
mod host;
mod library;
mod state;
mod stepping;
mod times;
mod values;

use loader::{Error, Fmu};

use super::Finding;

/// What a probe gives; an error is a finding too.
pub type Findings = Result<Vec<Finding>, Error>;

/// One probe.
pub struct Probe {
    /// Short name.
    pub name: &'static str,
    /// What it asks.
    pub title: &'static str,
    /// Runs it, in a process of its own.
    pub run: fn(&Fmu) -> Findings,
}

/// One call that even a good FMU may not come back from, tried in a process of its own.
pub struct Trial {
    /// The probe it belongs to.
    pub probe: &'static str,
    /// The function it calls.
    pub call: &'static str,
    /// What it tries.
    pub what: &'static str,
    /// Whether the call is senseless by any reading of the standard: then a hang is worth a note, and a short wait.
    pub senseless: bool,
    /// Whether the standard can be read as asking nothing here: then what goes wrong is worth a note.
    pub disputed: bool,
    /// Runs it.
    pub run: fn(&Fmu, &Trial) -> Findings,
}

impl Trial {
    /// What the process is told to run.
    pub fn name(&self) -> String {
        format!("{}: {}", self.probe, self.what)
    }
}

/// Every trial of every probe.
pub fn trials() -> impl Iterator<Item = &'static Trial> {
    times::TRIALS.iter().chain(host::TRIALS)
}

/// Every probe, in the order of the report.
pub const ALL: &[Probe] = &[
    Probe { name: "library", title: "loads, exports every function", run: library::probe },
    Probe { name: "simulation", title: "runs as its default experiment says", run: stepping::simulation },
    Probe {
        name: "values",
        title: "start values read back, limits and references are kept",
        run: values::probe,
    },
    Probe {
        name: "calls",
        title: "answers every function in every state as FMI 2.0 says",
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
        title: "lives without memory functions and without the callbacks' struct",
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
