//! A plan is flown again through the shipped FMU where there is one, and says so.

use crate::{heliotorque, library, run, shown, text};

#[test]
fn a_plan_is_flown_through_the_fmu_in_dist() {
    let Some(library) = library() else { return };
    let room = tempfile::tempdir().unwrap();
    let plan = |arguments: &[&str]| {
        let output = heliotorque(&[&["plan", "spin", "--angle", "2"], arguments].concat())
            .current_dir(room.path())
            .output()
            .unwrap();
        (output.status.code(), text(&output))
    };
    let (status, text) = plan(&[]);
    assert!(status == Some(0) && text.contains("Not re-flown: no dist/SpinPlant.fmu"), "{text}");
    std::fs::create_dir(room.path().join("dist")).unwrap();
    let fmu = room.path().join("dist").join("SpinPlant.fmu");
    run(&["pack", "--library", shown(&library), "--model", "SpinPlant", "--output", shown(&fmu)], 0);
    let (status, text) = plan(&["--max-nutation", "0.02"]);
    let line = text.lines().find(|line| line.starts_with("Re-flown")).unwrap_or_else(|| panic!("{text}"));
    assert!(status == Some(0) && line.contains("dist/SpinPlant.fmu: 24 ratios"), "{line}");
    assert!(line.ends_with("limits kept"), "{line}");
    // The plan's own figures and the flight's: 0.1 % of a pulse's nutation apart at most.
    let degrees = |before: &str| -> f64 {
        let rest = line.split_once(before).unwrap().1;
        rest.split([' ', ')']).next().unwrap().parse().unwrap()
    };
    let (flown, foreseen) = (degrees("worst final "), degrees("deg (foreseen "));
    assert!(flown > 0.9 * foreseen && flown < foreseen + 1.8e-5, "{line}");
    // What is no FMU of this machine does not stop a plan that did not ask for it, but one that did.
    std::fs::write(&fmu, "not an archive").unwrap();
    let (status, text) = plan(&[]);
    assert!(status == Some(0) && text.contains("Not re-flown: ") && text.contains("archive"), "{text}");
    let (status, text) = plan(&["--fmu", "dist/SpinPlant.fmu"]);
    assert!(status == Some(1) && text.contains("archive"), "{text}");
}
