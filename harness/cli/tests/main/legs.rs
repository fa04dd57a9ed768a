//! `heliotorque plan` of a leg: the shipped missions come from it, what it writes meets its aimpoint as it is simulated, and what cannot be is refused.

use std::{fs, path::Path};

use crate::{momentum_plans::columns, run, says, shown, template};

const RESOURCES: &str = "../../fmu-src/resources";
const AU_M: f64 = 149_597_870_700.0;
const LEAD_S: f64 = 21_600.0;
/// Of the second flyby, in s: it has points at the closest approach and the lead time before.
const STEP: &str = "2400";

/// An ephemeris of ten days in the year 2000.
fn short_ephemeris() -> String {
    let body = |name: &str, x_m: f64| {
        format!(
            "[[body]]\nbody = \"{name}\"\ncenter = \"sun\"\ndegree = 0\nerror_m = 1.0\nerror_m_s = 0.1\n\
             segment = [{{ start_s = 0.0, end_s = 864000.0, x_m = [{x_m:e}], y_m = [0], z_m = [0] }}]\n"
        )
    };
    format!("frame = \"EME2000\"\n{}{}", body("mercury", 5e10), body("earth", 1.5e11))
}

/// A leg and its mission in a folder, edited.
pub(crate) fn flyby(folder: &Path, number: u32, edits: &[(&str, &str)]) {
    let read = |name: &str| fs::read_to_string(Path::new(RESOURCES).join(name)).unwrap();
    let name = format!("messenger-flyby{number}.toml");
    fs::write(folder.join("messenger.toml"), read("messenger.toml")).unwrap();
    let mut mission = read(&format!("examples/missions/{name}"));
    mission = mission.replace("../../messenger.toml", "messenger.toml");
    let mut leg = read(&format!("examples/legs/{name}"));
    leg = leg.replace(&format!("../missions/{name}"), "flyby.toml");
    for (old, new) in edits {
        assert!(mission.contains(old) || leg.contains(old), "{old}");
        (mission, leg) = (mission.replace(old, new), leg.replace(old, new));
    }
    fs::write(folder.join("short.toml"), short_ephemeris()).unwrap();
    fs::write(folder.join("flyby.toml"), mission).unwrap();
    fs::write(folder.join("leg.toml"), leg).unwrap();
}

/// Plans a leg file; what is said.
#[track_caller]
fn plan(leg: &Path, output: &Path, template: &Path, status: i32) -> String {
    run(&["plan", shown(leg), "--output", shown(output), "--template", shown(template)], status)
}

/// Simulates a mission with steps of a time in s and gives columns of it.
fn simulated(
    mission: &Path,
    template: &Path,
    (step, more): (&str, &[&str]),
    names: &[&str],
) -> Vec<Vec<f64>> {
    let output = mission.with_extension("csv");
    let columns_of = ["time"].into_iter().chain(names.iter().copied()).collect::<Vec<_>>();
    let arguments = [
        &["run", shown(mission), "--template", shown(template), "--step", step, "--every", step, "--quiet"][..],
        &["--record", &names.join(","), "--output", shown(&output)],
        more,
    ];
    run(&arguments.concat(), 0);
    columns(&output, &columns_of)
}

/// B along T and R at a time, between the two rows about it.
fn b_km(rows: &[Vec<f64>], time_s: f64) -> [f64; 2] {
    let after = rows.partition_point(|row| row[0] < time_s);
    let [before, next] = [&rows[after - 1], &rows[after]];
    let share = (time_s - before[0]) / (next[0] - before[0]);
    [1, 2].map(|column| 1e-3 * (before[column] + share * (next[column] - before[column])))
}

fn numbers(line: &str) -> Option<Vec<f64>> {
    let list = line.split_once("= [")?.1.strip_suffix(']')?;
    list.split(',').map(|number| number.trim().parse().ok()).collect()
}

/// The missions of the flybys are what their leg files give, word for word, velocities to 1e-9.
#[test]
fn the_shipped_missions_are_those_of_their_legs() {
    let Some((scratch, template)) = template() else { return };
    for number in [1, 2] {
        let at = |kind: &str| {
            let name = format!("examples/{kind}/messenger-flyby{number}.toml");
            Path::new(RESOURCES).join(name)
        };
        let output = scratch.path().join(format!("flyby{number}"));
        let printed = plan(&at("legs"), &output, &template, 0);
        says(
            &printed,
            &["altitude 200.000 km", "6 h before", "flights without the planet's gravity", "plan.json"],
        );
        let written = fs::read_to_string(output.join("mission.toml")).unwrap();
        let (head, written) = written.split_once('\n').unwrap();
        assert!(head.starts_with("# Written by `heliotorque plan`"), "{head}");
        let path = written.lines().find_map(|line| line.strip_prefix("spacecraft = ")).unwrap();
        let written = written.replace(path, "\"../../messenger.toml\"");
        if std::env::var_os("HELIOTORQUE_BLESS").is_some() {
            fs::write(at("missions"), &written).unwrap();
        }
        let mission = fs::read_to_string(at("missions")).unwrap();
        assert_eq!(written.lines().count(), mission.lines().count());
        for (found, expected) in written.lines().zip(mission.lines()) {
            if found == expected {
                continue;
            }
            assert!(found.starts_with("\"orbit.velocity\" = "), "{found}");
            let [found, expected] = [found, expected].map(|line| numbers(line).unwrap());
            let apart = found.iter().zip(&expected).map(|(a, b)| (a - b).abs() / b.abs()).fold(0.0, f64::max);
            assert!(apart < 1e-9, "{found:?} {expected:?}");
        }
        let picture = fs::read_to_string(output.join("plan.svg")).unwrap();
        says(&picture, &["MESSENGER: leg to Mercury", "departure", "B-plane, 6 h before", "aim"]);
    }
}

/// From 0.315 to 0.70 AU, 5.2 km/s, at 200 km on the day; paper 003 has a delta-v of 2452 m/s.
#[test]
fn the_second_flyby_is_that_of_its_mission() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    flyby(folder, 2, &[]);
    let names = [
        "encounter.bT",
        "encounter.bR",
        "encounter.excessSpeed",
        "encounter.count",
        "encounter.lastTime",
        "encounter.lastAltitude",
        "sun.distance",
    ];
    let mission = folder.join("flyby.toml");
    let rows = simulated(&mission, &template, (STEP, &[]), &names);
    let last = rows.last().unwrap();
    let arrival_s = last[5];
    // 2008-03-19T00:00 to 2008-10-06T08:40.
    assert!(last[4] == 1.0 && (arrival_s - 17_397_600.0).abs() < 0.01, "{arrival_s}");
    assert!((last[6] - 2e5).abs() < 1.0, "{}", last[6]);
    let distances = rows.iter().filter(|row| row[0] <= arrival_s).map(|row| row[7] / AU_M);
    let [least, most] = distances.fold([f64::INFINITY, 0.0], |[a, b], it| [a.min(it), b.max(it)]);
    assert!((least - 0.315).abs() < 5e-4 && (most - 0.70).abs() < 5e-4, "{least} {most}");
    // Six hours before it and at it B.T differs by the tide of the Sun, 25 km.
    let [before, there] = [17_376_000.0, 17_397_600.0].map(|at_s| b_km(&rows, at_s));
    assert!((there[0] - before[0] - 25.0).abs() < 2.0, "{there:?} {before:?}");
    // Light switched off moves B by 3471 km.
    let dark = simulated(&mission, &template, (STEP, &["--set", "solar.scale=0"]), &names);
    let moved = b_km(&dark, dark.last().unwrap()[5] - LEAD_S);
    let moved_km = (moved[0] - before[0]).hypot(moved[1] - before[1]);
    assert!((moved_km / 3471.0 - 1.0).abs() < 0.005, "{moved_km}");
    let printed = plan(&folder.join("leg.toml"), &folder.join("out"), &template, 0);
    let number = |before: &str, unit: &str| -> f64 {
        let after = printed.split_once(before).unwrap().1;
        after.split_once(unit).unwrap().0.parse().unwrap()
    };
    let delta_v_m_s = number("delta-v ", " m/s");
    assert!((delta_v_m_s / 2442.0 - 1.0).abs() < 0.002, "{delta_v_m_s}");
    // The hyperbola six hours before passes lower than the flight.
    let osculating_km = number("its altitude ", " km");
    assert!((200.0 - osculating_km - 25.0).abs() < 2.0, "{osculating_km}");
}

/// An aimpoint by components is met by the hyperbola six hours before the flyby, on a mission with other values and another start.
#[test]
fn components_of_b_are_met_where_the_mission_that_was_written_passes() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    let edits = [
        ("altitude = \"200 km\"\nangle = \"12 deg\"", "bT = \"-4000 km\"\nbR = \"1500 km\""),
        ("start = \"2007-12-19T00:00:00 UTC\"", "start = \"2007-12-01T00:00:00 UTC\""),
        ("stop = \"28 d\"", "stop = \"2 d\""),
        ("\"orbit.source\" = \"inputs\"\n", "\"orbit.semiMajorAxis\" = \"0.5 AU\"\n"),
        ("\"900 kg\"", "\"500 kg\""),
    ];
    flyby(folder, 1, &edits);
    let printed = plan(&folder.join("leg.toml"), &folder.join("out"), &template, 0);
    says(&printed, &["B.T -4000.000 km, B.R 1500.000 km", "delta-v of the departure"]);
    let mission = folder.join("out/mission.toml");
    let text = fs::read_to_string(&mission).unwrap();
    says(&text, &["start = \"2007-12-19T00:00:00 UTC\"", "stop = \"28 d\"", "\"500 kg\""]);
    assert!(!text.contains("semiMajorAxis"), "{text}");
    let names = ["encounter.bT", "encounter.bR", "encounter.count", "encounter.lastTime"];
    let rows = simulated(&mission, &template, ("480", &[]), &names);
    let last = rows.last().unwrap();
    // 26 d 19 h 4 min.
    assert!(last[3] == 1.0 && (last[4] - 2_315_040.0).abs() < 0.01, "{last:?}");
    let found = b_km(&rows, 2_315_040.0 - LEAD_S);
    assert!((found[0] + 4000.0).hypot(found[1] - 1500.0) < 2e-3, "{found:?}");
}

/// A path through the Sun ends there, whatever the aimpoint.
#[test]
fn a_path_into_a_body_is_named_with_time_and_speed() {
    let Some((scratch, template)) = template() else { return };
    let folder = scratch.path();
    // Two degrees ahead of where Mercury will be, so 358 deg before it, eight days before: in to the Sun and out again.
    let place = "\"-76517191 km\", \"-63545736 km\", \"-26010518 km\"";
    let ahead = "\"39776902 km\", \"9917828 km\", \"395292 km\"";
    let edits = [
        (place, ahead),
        ("at = \"2008-03-19T00:00:00 UTC\"", "at = \"2008-09-28T00:00:00 UTC\""),
        ("revolutions = 1\nbranch = \"left\"\n", ""),
    ];
    flyby(folder, 2, &edits);
    let printed = plan(&folder.join("leg.toml"), &folder.join("out"), &template, 2);
    says(&printed, &["leg.toml:", "the Sun", "m/s"]);
    assert!(!folder.join("out/plan.json").exists());
}
