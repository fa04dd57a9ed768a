//! `refit`: a shift of the centre of mass comes back from noisy momentum through the FMU; what is no history or mission is refused by name.

use std::{fs, path::Path};

use nalgebra::Vector3;
use physics::numerics::noise::{Channel, normal_vector};
use serde_json::Value;

use crate::{heliotorque, run, says, shown, template, text};

const NOISE_N_M_S: f64 = 0.01;
/// From the mission's place, in m.
const SHIFT_M: [f64; 3] = [0.006, -0.006, 0.005];
const CENTER_M: [f64; 3] = [0.0, 0.0, -0.0254];

/// Ten days at 0.4 AU, the panels at 60 deg, then at another offset; without values of what is fitted.
fn mission(then_deg: u32) -> String {
    let rows = format!(
        "[[0, \"60 deg\"], [432000, \"60 deg\"], [432000, \"{then_deg} deg\"], [864000, \"{then_deg} deg\"]]"
    );
    format!(
        "spacecraft = {:?}\nstart = \"2008-05-01T00:00:00 UTC\"\nstop = \"10 d\"\nstep = \"10 min\"\n\
         record = [\"momentum.inertial\", \"dump.count\"]\n\
         [inputs]\n\"panel[1].sunOffsetCommand\" = {rows}\n\"panel[2].sunOffsetCommand\" = {rows}\n\
         [set]\n\"orbit.center\" = \"sun\"\n\"orbit.frame\" = \"ecliptic\"\n\"orbit.semiMajorAxis\" = \"0.4 AU\"\n\
         \"orbit.eccentricity\" = 0.0\n\"orbit.inclination\" = \"3 deg\"\n\"solar.flux\" = 1358\n\
         \"panel[1].control\" = \"command\"\n\"panel[2].control\" = \"command\"\n",
        fs::canonicalize("../../fmu-src/resources/messenger.toml").unwrap()
    )
}

/// The same with the panels by a timeline, which also dumps.
fn by_timeline(mission: &str) -> String {
    let kept = |line: &&str| !line.starts_with("[inputs]") && !line.contains("sunOffsetCommand");
    let lines: Vec<&str> = mission.lines().filter(kept).collect();
    let text = lines.join("\n").replace("\"command\"", "\"timeline\"");
    format!("timeline = \"panels.toml\"\n{text}\n")
}

const TIMELINE: &str = r#"
[[panels]]
at = "2008-05-01T00:00:00 UTC"
sunOffset = "60 deg"

[[panels]]
at = "2008-05-06T00:00:00 UTC"
sunOffset = "40 deg"

[[event]]
at = "2008-05-03T00:05:00 UTC"
dump = true
"#;

fn with_center(mission: &str, center_m: [f64; 3]) -> String {
    format!("{mission}\"spacecraft.centerOfMass\" = {center_m:?}\n")
}

/// Simulates a mission and gives its momentum with noise, in which dumps are as they fall.
fn telemetry(mission: &Path, template: &Path, seed: u64, more: &[&str]) -> String {
    let output = mission.with_extension("flown.csv");
    let arguments =
        ["run", shown(mission), "--template", shown(template), "--output", shown(&output), "--quiet"];
    run(&[&arguments[..], more].concat(), 0);
    let text = fs::read_to_string(output).unwrap();
    let mut lines = text.lines();
    let mut noisy = lines.next().unwrap().to_owned() + "\n";
    for (row, line) in lines.enumerate() {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let noise = NOISE_N_M_S * normal_vector(seed, Channel::StarTracker, row as u64);
        let [x, y, z] = [0, 1, 2].map(|axis| cells[axis + 1] + noise[axis]);
        noisy += &format!("{},{x},{y},{z},{}\n", cells[0], cells[4]);
    }
    noisy
}

fn numbers<const N: usize>(value: &Value) -> [f64; N] {
    let list = value.as_array().unwrap();
    assert_eq!(list.len(), N);
    std::array::from_fn(|at| list[at].as_f64().unwrap())
}

#[test]
fn a_shift_comes_back_through_the_fmu() {
    let Some((scratch, template)) = template() else { return };
    let file = |name: &str| scratch.path().join(name);
    let truth_m = [0, 1, 2].map(|axis| CENTER_M[axis] + SHIFT_M[axis]);
    fs::write(file("panels.toml"), TIMELINE).unwrap();
    // Dumps at 0.7 N m s in a history, none in the flights that it is fitted by; one of the timeline in both.
    let dumping = &["--set", "dump.threshold=0.7,0.7,0.7"];
    for (mission, more, arcs) in [
        (mission(60), &[][..], 1),
        (mission(40), &[], 1),
        (mission(40), dumping, 5),
        (by_timeline(&mission(40)), &[], 2),
    ] {
        let (truth, prior, rows) = (file("truth.toml"), file("mission.toml"), file("momentum.csv"));
        fs::write(&truth, with_center(&mission, truth_m)).unwrap();
        fs::write(&prior, with_center(&mission, CENTER_M)).unwrap();
        fs::write(&rows, telemetry(&truth, &template, 1, more)).unwrap();
        let output = file("refit.toml");
        let arguments =
            ["refit", shown(&prior), "--telemetry", shown(&rows), "--output", shown(&output), "--template"];
        let text = run(&[&arguments[..], &[shown(&template)]].concat(), 0);
        says(&text, &[&format!("1441 rows in {arcs} arc"), "by 9 flights", "degrees of freedom"]);
        assert!(!text.contains("warning"), "{text}");
        assert!(fs::read_to_string(file("refit.svg")).unwrap().starts_with("<svg"));

        let json: Value = serde_json::from_str(&fs::read_to_string(file("refit.json")).unwrap()).unwrap();
        let found_m: [f64; 3] = numbers(&json["centerOfMass_m"]);
        let error_m = Vector3::from(found_m) - Vector3::from(truth_m);
        let chi_square = json["chiSquare"].as_f64().unwrap() / json["degreesOfFreedom"].as_f64().unwrap();
        assert!((chi_square - 1.0).abs() < 0.1, "{chi_square}");
        let undetermined: Vec<[f64; 4]> = json["directions"]
            .as_array()
            .unwrap()
            .iter()
            .filter(|it| it["observable"] == false)
            .map(|it| numbers(&it["vector"]))
            .collect();
        if undetermined.len() == 2 {
            let of_center = undetermined.iter().find(|vector| vector[3].abs() < 1e-6).unwrap();
            let along = Vector3::new(of_center[0], of_center[1], of_center[2]);
            assert!(along.angle(&Vector3::new(0.0, 0.987, 0.160)).to_degrees() < 1.0, "{along:?}");
            says(&text, &["mission's values: the centre of mass along (0.000, 0.987, 0.160)"]);
            assert!((Vector3::from(found_m) - Vector3::from(CENTER_M)).dot(&along).abs() < 1e-9);
            assert!(mission == self::mission(60));
            continue;
        }
        assert!(
            error_m.x.abs() < 0.5e-3 && error_m.y.abs() < 2e-3 && error_m.z.abs() < 0.5e-3,
            "{error_m:?}"
        );
        assert_eq!(undetermined.len(), 1, "{undetermined:?}");
        // A mission takes what was written, and ends within the noise of the truth.
        let refitted = file("refitted.toml");
        let set = fs::read_to_string(&output).unwrap();
        fs::write(&refitted, mission.replace("[set]\n", &set)).unwrap();
        let [simulated, expected] = [&refitted, &truth].map(|mission| {
            let rows = telemetry(mission, &template, 2, &[]);
            let last = rows.lines().last().unwrap().to_owned();
            let cells: Vec<f64> = last.split(',').map(|cell| cell.parse().unwrap()).collect();
            Vector3::new(cells[1], cells[2], cells[3])
        });
        assert!((simulated - expected).norm() < NOISE_N_M_S, "{simulated:?}, {expected:?}");
    }
}

/// A history with a dump that it does not say: the fit is told from a good one in words, files and plans.
#[test]
fn a_fit_that_is_not_trusted_says_so_and_no_plan_takes_it() {
    let Some((scratch, template)) = template() else { return };
    let file = |name: &str| scratch.path().join(name);
    let truth_m = [0, 1, 2].map(|axis| CENTER_M[axis] + SHIFT_M[axis]);
    let (truth, prior, rows, output) =
        (file("truth.toml"), file("mission.toml"), file("momentum.csv"), file("refit.toml"));
    fs::write(&truth, with_center(&mission(40), truth_m)).unwrap();
    fs::write(&prior, with_center(&mission(40), CENTER_M)).unwrap();
    let history = telemetry(&truth, &template, 1, &[]);
    // In row 700 three N m s are lost and found.
    let lines = history.lines().enumerate().map(|(row, line)| {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if row == 700 {
            cells[1] = "3".to_owned();
        }
        cells.join(",") + "\n"
    });
    fs::write(&rows, lines.collect::<String>()).unwrap();
    let arguments =
        ["refit", shown(&prior), "--telemetry", shown(&rows), "--output", shown(&output), "--template"];
    let quiet = run(&[&arguments[..], &[shown(&template), "--quiet"]].concat(), 0);
    says(&quiet, &["warning: more than noise is left", "momentum.csv:701", "trusted = false"]);
    assert!(fs::read_to_string(&output).unwrap().contains("# trusted = false"));
    let json: Value = serde_json::from_str(&fs::read_to_string(file("refit.json")).unwrap()).unwrap();
    assert_eq!(json["trusted"], false);
    let plan = file("plan.toml");
    fs::write(&plan, "mission = \"mission.toml\"\n[momentum]\nlimit = 5\nrefit = \"refit.toml\"\n").unwrap();
    let out = file("out");
    let arguments = ["plan", shown(&plan), "--output", shown(&out), "--template", shown(&template)];
    says(
        &run(&arguments, 2),
        &["plan.toml:4: momentum.refit: found ", "a fit that is not trusted, chi square "],
    );
    // A prior that excludes what the history says.
    fs::write(&rows, history).unwrap();
    let arguments =
        ["refit", shown(&prior), "--telemetry", shown(&rows), "--output", shown(&output), "--template"];
    let arguments = [&arguments[..], &[shown(&template), "--prior-center", "0.0005"]].concat();
    let refused = text(&heliotorque(&arguments).output().unwrap());
    says(&refused, &["deviations of its prior off the mission's", "allowed: 6"]);
}

#[test]
fn what_cannot_be_fitted_is_refused_by_name() {
    let Some((scratch, template)) = template() else { return };
    let file = |name: &str| scratch.path().join(name);
    let rows = file("momentum.csv");
    let header = "time,momentum.inertial[1],momentum.inertial[2],momentum.inertial[3]\n";
    fs::write(&rows, format!("{header}0,0,0,0\n600,0,0,0\n900000,0,0,0\n")).unwrap();
    let refused = |mission: &str, more: &[&str], part: &str| {
        let path = file("mission.toml");
        fs::write(&path, mission).unwrap();
        let output = file("refit.toml");
        let arguments = ["refit", shown(&path), "--telemetry", shown(&rows), "--output", shown(&output)];
        let arguments = [&arguments[..], &["--template", shown(&template)], more].concat();
        let output = heliotorque(&arguments).output().unwrap();
        let text = text(&output);
        assert!(!output.status.success(), "{text}");
        assert!(text.contains(part), "{text} lacks {part}");
        assert!(!file("refit.json").exists(), "{text}");
    };
    let plain = mission(40);
    let controlled = format!("{plain}\"attitude.source\" = \"controlled\"\n");
    refused(
        &plain,
        &[],
        "momentum.csv:4: time: found 900000 s, allowed: times of the mission, from 0 s to 864000 s",
    );
    refused(&controlled, &[], "attitude.source: found controlled, allowed: guided, commanded");
    let predictive = format!("{plain}\"momentum.strategy\" = \"predictive\"\n");
    refused(&predictive, &[], "momentum.strategy: found predictive, allowed: dumpsOnly");
    let guidance = "model = \"Guidance\"\nstop = \"10 d\"\n";
    refused(guidance, &[], "mission has no variable attitude.source, allowed: a MomentumPlant");
    let over_time = plain.replace("[inputs]", "[inputs]\n\"solar.scale\" = [[0, 1.0], [600, 1.1]]");
    refused(&over_time, &[], "inputs: found solar.scale over time, allowed: one value");
    refused(&plain, &["--prior-center", "0"], "'--prior-center <M>': allowed is a number of m above 0");
    refused(&plain, &["--prior-scale", "0"], "'--prior-scale <S>': allowed is a number above 0");
    refused(&plain, &["--noise", "-1"], "'--noise <N.m.s>': allowed is a number of N.m.s above 0");
    fs::write(&rows, format!("{header}0,0,0,0\n600,,0,0\n")).unwrap();
    refused(
        &plain,
        &[],
        "momentum.csv:3: momentum.inertial[1]: found nothing, allowed: a number in every row",
    );
}
