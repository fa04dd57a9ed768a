//! This project's FMUs pass every probe of `heliotorque check`, run here through their shared library.

use fmi::Fmu;
use fmi::conformance::{Finding, PROBES, Verdict, archive, description, run, trials};

use crate::support::{SHIPPED, built};

/// Everything that is worse than good or skipped, by probe.
fn shortcomings(fmu: &Fmu) -> Vec<String> {
    let names = PROBES.iter().map(|probe| probe.name.to_owned()).chain(trials().map(|trial| trial.name()));
    let mut shortcomings = Vec::new();
    for name in names {
        let findings = run(fmu, &name).unwrap();
        assert!(!findings.is_empty(), "{name} found nothing, not even what is good");
        let bad = findings.into_iter().filter(|finding| finding.verdict > Verdict::Skipped);
        shortcomings.extend(bad.map(|finding| format!("{name}: {}", finding.text)));
    }
    shortcomings
}

#[test]
fn every_shipped_fmu_passes_every_probe() {
    let Some(dist) = built("HELIOTORQUE_DIST") else { return };
    for model in SHIPPED {
        let fmu = Fmu::open(dist.join(format!("{model}.fmu"))).unwrap();
        let is_good = |finding: &Finding| finding.verdict == Verdict::Good;
        assert!(archive(&fmu).iter().chain(&description(&fmu)).all(is_good), "{model}");
        assert_eq!(shortcomings(&fmu), Vec::<String>::new(), "{model}");
    }
}

#[test]
fn the_probe_models_pass_every_probe() {
    let Some(library) = built("HELIOTORQUE_PROBE_LIBRARY") else { return };
    let base = tempfile::tempdir().unwrap();
    for model in ["Empty", "AllTypes", "RigidBody"] {
        let fmu = crate::shared_library::folder(base.path(), model, &library);
        assert_eq!(shortcomings(&fmu), Vec::<String>::new(), "{model}");
    }
}

#[test]
fn a_probe_that_is_not_there_is_none() {
    let Some(library) = built("HELIOTORQUE_PROBE_LIBRARY") else { return };
    let base = tempfile::tempdir().unwrap();
    let fmu = crate::shared_library::folder(base.path(), "Empty", &library);
    assert!(run(&fmu, "no such probe").is_none());
}
