//! A plan is simulated again through the shipped FMU where there is one, and what it prints and writes is simulated there.

use std::{
    path::Path,
    process::{Command, Stdio},
};

use crate::{heliotorque, library, run, shown, text, words};

#[test]
fn a_plan_is_simulated_through_the_fmu_in_dist() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let plan = |arguments: &[&str]| {
        let output = heliotorque(&[&["plan", "spin", "--angle", "2deg"], arguments].concat())
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
    let (status, text) = plan(&["--max-nutation", "0.02deg"]);
    let line = text.lines().find(|line| line.starts_with("Re-simulated")).unwrap_or_else(|| panic!("{text}"));
    assert!(status == Some(0) && line.contains("dist/SpinPlant.fmu: 24 ratios"), "{line}");
    assert!(line.ends_with("the flags' limits kept"), "{line}");
    // The plan's own figures and the simulation's: 0.1 % of a pulse's nutation apart at most.
    let degrees = |before: &str| -> f64 {
        let rest = line.split_once(before).unwrap().1;
        rest.split([' ', ')']).next().unwrap().parse().unwrap()
    };
    let (simulated, predicted) = (degrees("worst final "), degrees("deg (predicted "));
    assert!(simulated > 0.9 * predicted && simulated < predicted + 1.8e-5, "{line}");
    // What is no FMU of this machine does not stop a plan that did not name it, but one that did.
    std::fs::write(&fmu, "not an archive").unwrap();
    let (status, text) = plan(&[]);
    assert!(status == Some(0) && text.contains("Not re-simulated: ") && text.contains("archive"), "{text}");
    let (status, text) = plan(&["--template", "dist/SpinPlant.fmu"]);
    assert!(status == Some(2) && text.contains("archive"), "{text}");
}

/// The last row of a recording, by column.
fn last_row(csv: &Path) -> Vec<(String, f64)> {
    let text = std::fs::read_to_string(csv).unwrap();
    let mut lines = text.lines();
    let names = lines.next().unwrap().split(',').map(str::to_owned);
    names.zip(lines.next_back().unwrap().split(',').map(|field| field.parse().unwrap())).collect()
}

/// Right ascension and declination of the momentum, in deg, and nutation, in deg.
fn axis_deg(csv: &Path) -> [f64; 3] {
    let row = last_row(csv);
    let value = |name: &str| row.iter().find(|(column, _)| column == name).unwrap().1;
    let [x, y, z] = [1, 2, 3].map(|k| value(&format!("momentum.inertial[{k}]")));
    assert_eq!(value("burn.done"), 1.0);
    let declination_deg = z.atan2((x * x + y * y).sqrt()).to_degrees();
    [y.atan2(x).to_degrees().rem_euclid(360.0), declination_deg, value("nutation.angle").to_degrees()]
}

/// What the plan states of where it ends is where the FMU ends, by the printed options and by the `[start]` table.
#[test]
fn the_printed_start_values_lead_to_where_the_plan_says() {
    let Some(library) = library() else { return };
    let scratch = tempfile::tempdir().unwrap();
    let at = |name: &str| scratch.path().join(name);
    let ace = concat!(env!("CARGO_MANIFEST_DIR"), "/../../fmu-src/resources/ace.toml");
    let (fmu, csv) = (at("ace.fmu"), at("flown.csv"));
    let pack = ["pack", "--library", shown(&library), "--model", "SpinPlant", "--output"];
    run(&[&pack[..], &[shown(&fmu), "--spacecraft", ace]].concat(), 0);
    let date = "2026-11-22T12:00:00 UTC";
    for (k, (status, arguments)) in [
        (
            0,
            vec![
                "--date",
                date,
                "--earth",
                "70deg,20deg",
                "--from",
                "251.5deg,-21.5deg",
                "--target",
                "248.8deg,-18.5deg",
            ],
        ),
        // The Earth stands beyond the file's 3 deg, so strong a thruster nutates too much, 4 rpm are below its 4.9 rpm.
        (
            1,
            vec![
                "--date",
                date,
                "--from",
                "245deg,-22deg",
                "--target",
                "249deg,-18deg",
                "--max-nutation",
                "0.04deg",
            ],
        ),
        (
            1,
            [
                words("--sun 237deg,-20deg --from 240deg,-5deg --angle 3deg --direction 70deg --thruster"),
                vec!["upper radial I"],
            ]
            .concat(),
        ),
        (1, words("--angle 2deg --ratio 1.5 --propellant 40 --rate 4rpm --timing phase")),
    ]
    .into_iter()
    .enumerate()
    {
        let folder = at(&format!("plan{k}"));
        let plan = [&["plan", "spin", "--output", shown(&folder)], arguments.as_slice()].concat();
        let printed = run(&plan, status);
        let json = std::fs::read_to_string(folder.join("burn.json")).unwrap();
        let number = |after: &str, key: &str| -> f64 {
            let rest = &json[json.find(&format!("\"{after}\"")).unwrap()..];
            let rest = rest.split_once(&format!("\"{key}\": ")).unwrap().1;
            rest.split([',', '\n']).next().unwrap().parse().unwrap()
        };
        let stated = [number("end", "right_ascension_deg"), number("end", "declination_deg")];
        let miss_deg = number("end", "miss_deg");
        let target = [number("target", "right_ascension_deg"), number("target", "declination_deg")];
        // Nutation is left; the plan's figure holds without it.
        let check = |found: [f64; 3]| {
            let apart_deg = |to: [f64; 2]| {
                let [east, north] = [(found[0] - to[0]) * to[1].to_radians().cos(), found[1] - to[1]];
                (east * east + north * north).sqrt()
            };
            assert!(apart_deg(stated) < 1e-6, "{arguments:?}: {found:?} {stated:?}");
            assert!(
                apart_deg(target) < miss_deg + 1e-3 && miss_deg < 0.2,
                "{arguments:?}: {found:?} {target:?}"
            );
        };
        // The shell reads the line as it was printed.
        let settings = printed.lines().find(|line| line.starts_with("--set ")).unwrap();
        let stop = number("pulses", "time_s") + 1500.0;
        let record = "momentum.inertial,nutation.angle,burn.done";
        let line = format!(
            "exec \"$0\" run '{}' --stop {stop} --step 12.5 --record {record} --output '{}' {settings}",
            shown(&fmu),
            shown(&csv)
        );
        let second = Command::new("sh")
            .args(["-c", &line, env!("CARGO_BIN_EXE_heliotorque")])
            .stdin(Stdio::null())
            .output()
            .unwrap();
        assert!(second.status.success(), "{}", text(&second));
        check(axis_deg(&csv));
        // The same as a file's `[start]`.
        let with_start = at("with_start.toml");
        let start = std::fs::read_to_string(folder.join("start.toml")).unwrap();
        std::fs::write(&with_start, std::fs::read_to_string(ace).unwrap() + "\n" + &start).unwrap();
        let own = at("own.fmu");
        run(&[&pack[..], &[shown(&own), "--spacecraft", shown(&with_start)]].concat(), 0);
        run(
            &words(&format!(
                "run {} --stop {stop} --step 12.5 --record {record} --output {}",
                shown(&own),
                shown(&csv)
            )),
            0,
        );
        check(axis_deg(&csv));
        // Pulse by pulse, and the picture.
        let pulses = std::fs::read_to_string(folder.join("burn.csv")).unwrap().lines().count() - 1;
        assert_eq!(pulses, json.matches("\"pulse\": ").count());
        let svg = std::fs::read_to_string(folder.join("burn.svg")).unwrap();
        for part in
            ["axis after each pulse", "great circle", "rhumb line about the Sun", "nutation [deg]", "Sun"]
        {
            assert!(svg.contains(part), "{part}");
        }
        assert_eq!(svg.contains("Earth"), arguments.contains(&"--date"));
    }
}

#[test]
fn a_plan_that_breaks_a_limit_of_the_file_ends_with_status_1() {
    let scratch = tempfile::tempdir().unwrap();
    let (file, folder) = (scratch.path().join("s.toml"), scratch.path().join("turn"));
    run(&["new", "spinner", shown(&file)], 0);
    let plan = ["plan", "spin", "--spacecraft", shown(&file), "--output", shown(&folder)];
    for turn in [
        &["--angle", "2deg"][..],
        &["--angle", "10deg", "--sun-angle", "15deg"],
        &["--date", "2026-11-22 UTC", "--from", "245deg,-22deg", "--target", "240deg,-18deg"],
    ] {
        let reported = run(&[&plan[..], turn].concat(), 0);
        assert!(
            reported.contains("within the limits") && !reported.contains("BROKEN"),
            "{turn:?}: {reported}"
        );
    }
    let template = std::fs::read_to_string(&file).unwrap();
    let tight = template.replace("period_variation_s = 0.05", "period_variation_s = 0.01");
    assert_ne!(tight, template);
    std::fs::write(&file, tight).unwrap();
    let reported = run(&[&plan[..], &["--angle", "2deg"]].concat(), 1);
    assert!(reported.contains("limits broken: spin period varies"), "{reported}");
    assert!(!reported.contains("limits kept") && !reported.contains("within the limits"), "{reported}");
    assert!(folder.join("burn.csv").exists());
}

#[test]
fn a_plan_never_writes_over_the_spacecrafts_file() {
    let scratch = tempfile::tempdir().unwrap();
    let file = scratch.path().join("start.toml");
    let ace = include_str!("../../../../fmu-src/resources/ace.toml");
    std::fs::write(&file, ace).unwrap();
    let folder = shown(scratch.path());
    let text = run(&["plan", "spin", "--spacecraft", shown(&file), "--output", folder], 2);
    assert!(text.contains("it is an input too") && text.contains("--output"), "{text}");
    assert_eq!(std::fs::read_to_string(&file).unwrap(), ace);
    assert_eq!(std::fs::read_dir(scratch.path()).unwrap().count(), 1, "nothing else is written");
}
