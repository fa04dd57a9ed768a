//! Whether the shared library loads and exports what it must.

use crate::Fmu;
use model_description::call_table::Function;

use crate::conformance::{Finding, probe::Findings};

/// Loads the library in this process.
pub(crate) fn probe(fmu: &Fmu) -> Findings {
    let binary = fmu.binary()?;
    let mut findings = vec![Finding::good("loads")];
    let missing = binary.missing();
    if missing.is_empty() {
        findings.push(Finding::good(format!("exports all {} functions", Function::ALL.len())));
    } else {
        let names = missing.join(", ");
        findings.push(Finding::bad(format!("does not export {names}; every function must exist (2.3)")));
    }
    let (version, platform) = binary.versions();
    for (function, found, right) in
        [("fmi2GetVersion", version, "2.0"), ("fmi2GetTypesPlatform", platform, "default")]
    {
        findings.push(match found {
            Some(found) if found == right => Finding::good(format!("{function} answers {right:?}")),
            Some(found) => Finding::bad(format!("{function} answers {found:?}; {right:?} is right")),
            None => Finding::bad(format!("{function} answers nothing; {right:?} is right")),
        });
    }
    Ok(findings)
}
