//! A plan is simulated again through the shipped FMU where there is one, and the text names it.

use crate::{heliotorque, library, run, shown, text};

#[test]
fn a_plan_is_simulated_through_the_fmu_in_dist() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let plan = |arguments: &[&str]| {
        let output = heliotorque(&[&["plan", "spin", "--angle", "2"], arguments].concat())
            .current_dir(scratch.path())
            .output()
            .unwrap();
        (output.status.code(), text(&output))
    };
    let (status, text) = plan(&[]);
    assert!(status == Some(0) && text.contains("Not re-simulated: no dist/SpinPlant.fmu"), "{text}");
    std::fs::create_dir(scratch.path().join("dist")).unwrap();
    let fmu = scratch.path().join("dist").join("SpinPlant.fmu");
    run(&["pack", "--library", shown(&library), "--model", "SpinPlant", "--output", shown(&fmu)], 0);
    let (status, text) = plan(&["--max-nutation", "0.02"]);
    let line = text.lines().find(|line| line.starts_with("Re-simulated")).unwrap_or_else(|| panic!("{text}"));
    assert!(status == Some(0) && line.contains("dist/SpinPlant.fmu: 24 ratios"), "{line}");
    assert!(line.ends_with("limits kept"), "{line}");
    // The plan's own figures and the simulation's: 0.1 % of a pulse's nutation apart at most.
    let degrees = |before: &str| -> f64 {
        let rest = line.split_once(before).unwrap().1;
        rest.split([' ', ')']).next().unwrap().parse().unwrap()
    };
    let (simulated, foreseen) = (degrees("worst final "), degrees("deg (foreseen "));
    assert!(simulated > 0.9 * foreseen && simulated < foreseen + 1.8e-5, "{line}");
    // What is no FMU of this machine does not stop a plan that did not name it, but one that did.
    std::fs::write(&fmu, "not an archive").unwrap();
    let (status, text) = plan(&[]);
    assert!(status == Some(0) && text.contains("Not re-simulated: ") && text.contains("archive"), "{text}");
    let (status, text) = plan(&["--fmu", "dist/SpinPlant.fmu"]);
    assert!(status == Some(1) && text.contains("archive"), "{text}");
}
