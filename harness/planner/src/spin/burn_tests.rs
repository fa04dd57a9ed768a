//! A simulated plan agrees with the theory it was found by, its tables with each other, and its limits are named.

use physics::attitude::angle_between_rad;
use physics::spin::spinner::Spinner;

use super::tests::{ace, request};
use super::{ACE, PlannedBurn};
use crate::plans::spin::text::plan;

const TURN: &str = "--from 240deg,-20deg --sun 237deg,-12deg --target 246deg,-19deg";

fn planned(arguments: &str) -> PlannedBurn {
    plan(&request(arguments)).unwrap().burn.unwrap()
}

fn text(arguments: &str) -> String {
    plan(&request(arguments)).unwrap().text
}

#[test]
fn what_is_simulated_is_what_was_planned() {
    for arguments in [
        "--angle 2deg",
        TURN,
        "--angle 5deg --timing phase --thruster IA",
        "--angle 3deg --timing clock",
        "--angle 2deg --thruster axial&couple&I-IV",
    ] {
        let mut request = request(arguments);
        request.thruster = request.thruster.map(|name| name.replace('&', " "));
        let burn = plan(&request).unwrap().burn.unwrap();
        let (task, row, flight) = (&burn.task, &burn.row, &burn.flight);
        assert_eq!(flight.pulses.len() as u32, row.train.count, "{arguments}");
        let moved_rad = angle_between_rad(&flight.start_axis_inertial, &flight.end_axis_inertial());
        assert!((moved_rad / row.moved_rad - 1.0).abs() < 2e-3, "{arguments}: {moved_rad} {}", row.moved_rad);
        // The pulses' granularity, and what nutation does to Sun crossings.
        let granularity_rad = (task.angle_rad - row.moved_rad).abs();
        assert!(
            flight.miss_rad(task) < granularity_rad + 4.0 * row.peak_rad,
            "{arguments}: {}",
            flight.miss_rad(task)
        );
        let on_s: f64 = flight.pulses.iter().map(|pulse| pulse.on_time_s).sum();
        assert!((on_s * task.actuator.flow_kg_s / row.propellant_kg - 1.0).abs() < 1e-9, "{arguments}");
        let (first, last) = (&flight.pulses[0], flight.pulses.last().unwrap());
        let lasted_s = last.time_s + last.on_time_s - first.time_s;
        assert!(
            (lasted_s - row.duration_s).abs() < 0.01 * task.case.spin.period_s(),
            "{arguments}: {lasted_s}"
        );
        let peak_rad = flight.samples.iter().map(|sample| sample.nutation_rad).fold(0.0, f64::max);
        assert!(peak_rad < 1.02 * row.peak_rad && peak_rad > 0.9 * row.peak_rad, "{arguments}: {peak_rad}");
        assert!(
            flight
                .pulses
                .iter()
                .all(|pulse| task.actuator.name.contains(&pulse.thruster) || row.train.alternates())
        );
    }
}

/// Sun crossing and pulse of a great circle: on a clock of Sun pulses the delay is the phase at the assumed rate.
#[test]
fn the_phase_is_the_turn_since_the_sun_crossing() {
    for arguments in ["--angle 2deg --timing sun", "--angle 2deg --timing phase", TURN] {
        let burn = planned(arguments);
        for pulse in burn.flight.pulses.iter().skip(1) {
            let since_s = pulse.after_sun_s.unwrap() + 0.5 * pulse.on_time_s;
            let turned_rad = (since_s * burn.task.case.spin.rate_rad_s).rem_euclid(core::f64::consts::TAU);
            let off_rad = (turned_rad - pulse.phase_rad).abs();
            // Nutation moves the crossing by its angle over the tangent of the Sun's.
            let sun_rad = angle_between_rad(&pulse.axis_inertial, &burn.task.geometry.sun_inertial);
            assert!(off_rad < 3.0 * burn.row.peak_rad / sun_rad.tan() + 1e-6, "{arguments}: {off_rad}");
        }
    }
}

#[test]
fn csv_and_json_agree() {
    for arguments in ["--angle 2deg", &format!("{TURN} --earth 55deg,20deg")] {
        let burn = planned(arguments);
        let json: serde_json::Value = serde_json::from_str(&burn.to_json().unwrap()).unwrap();
        let csv = burn.to_csv().unwrap();
        let mut reader = csv::Reader::from_reader(csv.as_bytes());
        let header = reader.headers().unwrap().clone();
        let pulses = json["pulses"].as_array().unwrap();
        let records: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
        assert_eq!((records.len(), pulses.len()), (burn.flight.pulses.len(), burn.flight.pulses.len()));
        for (record, pulse) in records.iter().zip(pulses) {
            for (name, field) in header.iter().zip(record) {
                let value = &pulse[name];
                match value.as_f64() {
                    // The reader of JSON rounds to the next number or the one beside it.
                    Some(number) => {
                        let written: f64 = field.parse().unwrap();
                        assert!((written - number).abs() <= f64::EPSILON * number.abs(), "{name}");
                    }
                    None => assert_eq!(field, value.as_str().unwrap_or_default(), "{name}"),
                }
            }
        }
        assert_eq!(pulses[0]["earth_angle_deg"].is_null(), burn.task.geometry.earth_inertial.is_none());
        let table: toml::Table = super::start_values::toml(&burn.start_values()).parse().unwrap();
        let in_json = json["start_values"].as_object().unwrap();
        assert_eq!(in_json.len(), table["start"].as_table().unwrap().len());
        for (name, value) in burn.start_values() {
            let in_file = serde_json::to_value(&table["start"][name]).unwrap();
            assert_eq!(in_file, serde_json::to_value(value).unwrap(), "{name}");
            assert!(in_json.contains_key(name), "{name}");
        }
    }
}

#[test]
fn limits_are_named_and_checked() {
    let verdicts = |arguments: &str| -> Vec<(&'static str, Option<bool>)> {
        planned(arguments).checks.iter().map(|check| (check.limit, check.kept)).collect()
    };
    let kept = |arguments: &str, limit: &str| {
        let all = verdicts(arguments);
        all.iter().find(|(name, _)| *name == limit).unwrap_or_else(|| panic!("{limit}: {all:?}")).1
    };
    assert_eq!(kept("--angle 2deg", "Earth angle"), None);
    assert_eq!(kept("--angle 2deg", "Sun angle"), Some(true));
    // 17 deg from the Sun, 5 away from it.
    let away = "--from 0deg,17deg --sun 0deg,0deg --direction 180deg --angle 5deg --earth 180deg,0deg";
    assert_eq!(kept(away, "Sun angle"), Some(false));
    assert_eq!(kept(away, "Earth angle"), Some(false));
    assert_eq!(
        kept(
            "--from 0deg,2deg --sun 0deg,10deg --earth 180deg,0deg --angle 1deg --direction 180deg",
            "Earth angle"
        ),
        Some(true)
    );
    assert_eq!(kept("--angle 2deg --rate 5.2rpm", "spin rate"), Some(false));
    // A peak of 0.02 deg is a Sun-crossing period that varies by 2 x 0.02 deg / (30 deg/s tan 10 deg) = 7.56 ms; the file allows 7.
    // Within 8 min no train stays below it.
    assert_eq!(kept("--angle 2deg --max-duration 8min", "spin period varies"), Some(false));
    assert_eq!(kept("--angle 2deg --max-nutation 0.02deg", "spin period varies"), Some(true));
    let beyond = planned(away);
    let sun = beyond.checks.iter().find(|check| check.limit == "Sun angle").unwrap();
    assert!((sun.found - 22.0).abs() < 0.3 && sun.verdict().starts_with("BROKEN: from "), "{sun:?}");
    // Only what was given is checked, and called kept.
    let names: Vec<&str> = verdicts("--angle 2deg").iter().map(|(name, _)| *name).collect();
    assert_eq!(names, ["Sun angle", "Earth angle", "spin rate", "spin period varies", "propellant"]);
    let given = verdicts("--angle 2deg --max-nutation 0.2deg --max-final 0.1deg --max-duration 30min");
    let flags: Vec<_> = given[4..].iter().map(|(name, kept)| (*name, kept.unwrap())).collect();
    assert_eq!(
        flags,
        [("worst nutation", true), ("worst nutation left", true), ("time", true), ("propellant", true)]
    );
    let checked_in_table = |arguments: &str| {
        let text = text(arguments);
        let line = text.lines().find(|line| line.starts_with("limits: ")).unwrap();
        line.strip_prefix("limits: ").unwrap().split(", ").map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(
        checked_in_table("--angle 2deg"),
        ["Sun angle", "spin rate", "spin period varies", "propellant"]
    );
    let with_earth = checked_in_table(
        "--from 0deg,2deg --sun 0deg,10deg --earth 180deg,0deg --angle 1deg --max-nutation 0.02deg",
    );
    assert!(with_earth.contains(&"Earth angle".to_owned()), "{with_earth:?}");
    assert!(with_earth.contains(&"worst nutation".to_owned()), "{with_earth:?}");
}

/// At 10 deg from the Sun and 5 rpm the period varies by 2 x nutation / (30 deg/s tan 10 deg), whatever the train.
#[test]
fn the_plan_is_the_best_that_keeps_the_files_limits() {
    let task = super::tests::task("--angle 2deg");
    let rows = super::trade(&task).unwrap();
    let varies_s =
        |row: &super::TrainForecast| 2.0 * row.peak_rad.to_degrees() / (30.0 * 10_f64.to_radians().tan());
    for limit_s in [0.007, 0.01, 0.02, 0.05] {
        let file = ACE.replace("period_variation_s = 0.007", &format!("period_variation_s = {limit_s}"));
        let spinner = Spinner::parse("my.toml", &file).unwrap();
        let chosen = super::choice::by_all_limits(&spinner, &task, &rows, 1).unwrap()[0];
        let place = rows.iter().position(|row| row.train == chosen.train).unwrap();
        // The flight has one ratio, the forecast the worst of the range.
        assert!(varies_s(chosen) < 1.1 * limit_s, "{limit_s}: {chosen:?}");
        assert!(rows[..place].iter().all(|row| varies_s(row) > 0.9 * limit_s), "{limit_s}");
        assert!(place > 0, "{limit_s}");
    }
    let kept = plan(&request("--angle 2deg")).unwrap();
    assert!(kept.broken.is_empty() && kept.text.contains("Least final nutation within the limits: "));
    assert!(!kept.text.contains("No train keeps"));
}

#[test]
fn a_plan_that_breaks_a_limit_says_so() {
    for (arguments, broken) in [
        ("--angle 2deg --max-duration 8min", vec!["spin period varies"]),
        ("--angle 2deg --rate 5.2rpm", vec!["spin rate"]),
        // 17 deg from the Sun, 5 away from it; the train is still chosen by what can be kept.
        (
            "--from 0deg,17deg --sun 0deg,0deg --direction 180deg --angle 5deg --earth 180deg,0deg",
            vec!["Sun angle", "Earth angle"],
        ),
    ] {
        let answer = plan(&request(arguments)).unwrap();
        assert_eq!(answer.broken, broken, "{arguments}");
        let reported = format!("this one breaks: {}\n", broken.join(", "));
        assert!(answer.text.contains(&reported), "{arguments}: {}", answer.text);
        assert!(!answer.text.contains("within the limits") && !answer.text.contains("limits kept"));
        let table = answer.text.split("\nOf ").next().unwrap();
        assert!(table.contains("broken") && !table.contains(" kept"), "{table}");
    }
}

#[test]
fn rows_are_counted_and_fit_a_terminal() {
    let rows = |arguments: &str| {
        let text = text(arguments);
        let shapes = ["uniform /", "taper ", "split /"];
        text.lines().filter(|line| shapes.iter().any(|shape| line.starts_with(shape))).count()
    };
    for count in [0, 1, 2, 5, 12] {
        assert_eq!(rows(&format!("--angle 2deg --rows {count}")), count);
    }
    let text =
        text(&format!("{TURN} --max-nutation 0.2deg --rows 15 --timing clock --rate-uncertainty 0.01rpm"));
    let campaign = plan(&request("--campaign 20d")).unwrap().text;
    for text in [text, campaign] {
        let tables: Vec<&str> = text.lines().skip_while(|line| !line.starts_with('─')).collect();
        let tables = tables.split(|line| line.starts_with('─')).skip(1).step_by(2).flatten();
        let lines: Vec<usize> = tables.map(|line| line.trim_end().chars().count()).collect();
        assert!(lines.len() > 5 && lines.iter().all(|width| *width <= 80), "{lines:?}\n{text}");
    }
}

#[test]
fn the_thruster_is_the_files_own() {
    let renamed = ACE.replace("\"IIIR\"", "\"lower +X\"");
    let spinner = Spinner::parse("my.toml", &renamed).unwrap();
    assert_eq!(super::Task::new(&request("--angle 2deg"), &spinner).unwrap().actuator.name, "lower +X");
    let slower = ACE.replace("spin_rate_rpm = 5.0", "spin_rate_rpm = 3.0");
    let spinner = Spinner::parse("my.toml", &slower).unwrap();
    let rate = super::Task::new(&request("--angle 2deg"), &spinner).unwrap().case.spin.rate_rad_s;
    assert!((rate - 0.1 * core::f64::consts::PI).abs() < 1e-15);
    assert_eq!(super::Task::new(&request("--angle 2deg"), &ace()).unwrap().actuator.name, "IIIR");
}
