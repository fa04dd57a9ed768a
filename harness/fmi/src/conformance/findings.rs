//! Findings that a probe gathers about an FMU.

use crate::{Error, Fmu, Instance, Status};

use crate::conformance::{Finding, experiment};

/// Outcome of a probe; the error of one that cannot go on is its only finding.
pub(crate) type Outcome = Result<(), Error>;

/// An FMU that is probed, and what was found so far.
pub(crate) struct Findings<'f> {
    /// The FMU.
    pub(crate) fmu: &'f Fmu,
    found: Vec<Finding>,
}

impl<'f> Findings<'f> {
    /// Probes an FMU; an error is a finding too.
    pub(crate) fn gathered(fmu: &'f Fmu, probe: impl FnOnce(&mut Self) -> Outcome) -> Vec<Finding> {
        let mut findings = Self { fmu, found: Vec::new() };
        match probe(&mut findings) {
            Ok(()) => findings.found,
            Err(error) => vec![Finding::bad(Error::chain(&error))],
        }
    }

    /// Adds a finding.
    pub(crate) fn push(&mut self, finding: Finding) {
        self.found.push(finding);
    }

    /// Adds that something is as it should be.
    pub(crate) fn good(&mut self, text: impl Into<String>) {
        self.push(Finding::good(text));
    }

    /// Adds that something is not applicable.
    pub(crate) fn skipped(&mut self, text: impl Into<String>) {
        self.push(Finding::skipped(text));
    }

    /// Adds something odd.
    pub(crate) fn note(&mut self, text: impl Into<String>) {
        self.push(Finding::note(text));
    }

    /// Adds a fault.
    pub(crate) fn bad(&mut self, text: impl Into<String>) {
        self.push(Finding::bad(text));
    }

    /// Adds what should be so: good if it is, else bad.
    pub(crate) fn expect(&mut self, right: bool, text: impl Into<String>) {
        self.push(if right { Finding::good(text) } else { Finding::bad(text) });
    }

    /// Adds what should have been done.
    pub(crate) fn done(&mut self, what: &str, outcome: Outcome) {
        match outcome {
            Ok(()) => self.good(what),
            Err(error) => self.bad(format!("not so: {what}\n{error}")),
        }
    }

    /// Adds the outcome of a call that breaks the rules: good if it was refused with a status, a note if it was let through.
    pub(crate) fn refused(&mut self, what: &str, outcome: Outcome) {
        match outcome {
            Err(error) => match error.status() {
                Some(Status::Error | Status::Discard) => self.good(format!("refuses {what}")),
                Some(Status::Fatal) => {
                    self.bad(format!("condemns all its instances by fmi2Fatal for {what}"));
                }
                _ => self.note(format!("{what}: {error}")),
            },
            Ok(()) => self.note(format!("lets through {what}")),
        }
    }

    /// Makes such a call to an instance of its own between steps.
    pub(crate) fn try_refused(&mut self, what: &str, call: impl FnOnce(&mut Instance) -> Outcome) -> Outcome {
        let outcome = call(&mut experiment::ready(self.fmu, &experiment::unchecked())?);
        self.refused(what, outcome);
        Ok(())
    }
}
