//! Probes of an FMU.

use crate::conformance::findings::{Findings, Outcome};

/// One probe.
pub struct Probe {
    /// Short name.
    pub name: &'static str,
    /// Subject of its test.
    pub title: &'static str,
    /// Runs it, in a process of its own.
    pub(crate) run: fn(&mut Findings<'_>) -> Outcome,
}

/// One call that even a good FMU may not come back from, tried in a process of its own.
pub struct Trial {
    /// The probe it belongs to.
    pub probe: &'static str,
    /// The function it calls.
    pub call: &'static str,
    /// Call that it tries.
    pub what: &'static str,
    /// Whether the call is senseless by any reading of the standard: then a hang is worth a note, and a short wait.
    pub senseless: bool,
    /// Whether the standard can be read as asking nothing here: then what goes wrong is worth a note.
    pub disputed: bool,
    /// Runs it.
    pub(crate) run: fn(&mut Findings<'_>, &Trial) -> Outcome,
}

impl Trial {
    /// Name of the trial, by which the process runs it.
    pub fn name(&self) -> String {
        format!("{}: {}", self.probe, self.what)
    }
}
