//! Check of a system: that it can be read, fits its FMUs, and has their libraries.

use std::path::Path;

use crate::system::System;
use fmi::conformance::Finding;

/// Returns the findings of a system; its FMUs are checked one by one by themselves.
pub fn findings(path: &Path) -> Vec<Finding> {
    let system = match System::open(path) {
        Ok(system) => system,
        Err(error) => return vec![Finding::bad(fmi::Error::chain(&error))],
    };
    let (parts, open) = (system.parts(), system.open_inputs());
    let mut findings = vec![Finding::good(format!(
        "{} components and {} connections fit their FMUs, {} inputs are open",
        parts.len(),
        system.structure().connections.len(),
        open.len()
    ))];
    findings.extend(system.unread(&[]).iter().map(|unread| Finding::note(unread.to_string())));
    for part in parts {
        findings.push(match part.fmu.binary_path() {
            Ok(_) => Finding::good(format!("component {} has a library for this computer", part.name)),
            Err(error) => Finding::bad(format!("component {}: {error}", part.name)),
        });
    }
    findings
}
