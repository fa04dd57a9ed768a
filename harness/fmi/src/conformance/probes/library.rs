//! Whether the shared library loads and exports what it must.

use model_description::call_table::Function;

use crate::conformance::findings::{Findings, Outcome};

/// Loads the library in this process.
pub(crate) fn probe(findings: &mut Findings<'_>) -> Outcome {
    let binary = findings.fmu.binary()?;
    findings.good("loads");
    let missing = binary.missing();
    if missing.is_empty() {
        findings.good(format!("exports all {} functions", Function::ALL.len()));
    } else {
        let names = missing.join(", ");
        findings.bad(format!("does not export {names}; every function must exist (2.3)"));
    }
    let (version, platform) = binary.versions();
    for (function, found, right) in
        [("fmi2GetVersion", version, "2.0"), ("fmi2GetTypesPlatform", platform, "default")]
    {
        match found {
            Some(found) if found == right => findings.good(format!("{function} answers {right:?}")),
            Some(found) => findings.bad(format!("{function} answers {found:?}; {right:?} is right")),
            None => findings.bad(format!("{function} answers nothing; {right:?} is right")),
        }
    }
    Ok(())
}
