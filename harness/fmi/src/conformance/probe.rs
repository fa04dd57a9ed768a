//! What a probe is.

use crate::{Error, Fmu};

use crate::conformance::Finding;

/// What a probe gives; an error is a finding too.
pub type Findings = Result<Vec<Finding>, Error>;

/// One probe.
pub struct Probe {
    /// Short name.
    pub name: &'static str,
    /// What it tests.
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
    /// What the process runs.
    pub fn name(&self) -> String {
        format!("{}: {}", self.probe, self.what)
    }
}
