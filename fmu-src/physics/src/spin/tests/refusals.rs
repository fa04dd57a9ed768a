//! What cannot be simulated is refused with the name of what is wrong.

use nalgebra::Vector3;

use super::{ACE, ace, directions, paper_start, request};
use crate::spin::{
    burn_request::BurnRequest,
    forecast::Timing,
    plant::{Commands, Directions, Plant},
    spinner::Spinner,
    train::Shape,
};
use crate::toml::Problem;

fn refusal(request: BurnRequest) -> String {
    let mut start = paper_start(1.483);
    start.burn = Some(request);
    Plant::start(&ace(), &start, directions(), Commands::default(), 0.0).unwrap_err().to_string()
}

fn assert_names(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing from: {text}");
    }
}

#[test]
fn burns_that_cannot_be_simulated_say_why() {
    for (request, parts) in [
        (BurnRequest { thruster: 11, ..request() }, "burn.thruster|11|1 to 10"),
        (BurnRequest { thruster: 0, ..request() }, "burn.thruster|1 to 10"),
        (BurnRequest { opposite_thruster: 12, ..request() }, "burn.oppositeThruster|12|1 to 10"),
        (BurnRequest { group: "west".into(), ..request() }, "burn.group|west|spin up"),
        (BurnRequest { pulse_width_s: 6.5, ..request() }, "burn.pulseWidth|6.5|half a turn"),
        (BurnRequest { turns_per_pulse: 0.5, opposite_thruster: 0, ..request() }, "0.5 turns|opposite"),
        (BurnRequest { turns_per_pulse: 0.5, opposite_thruster: 8, ..request() }, "0.5 turns|opposite"),
        (BurnRequest { turns_per_pulse: 0.3, ..request() }, "0.3 turns"),
        (BurnRequest { count: -4, ..request() }, "burn.count|-4"),
        (BurnRequest { target_inertial: Vector3::zeros(), ..request() }, "burn.targetDirection|direction"),
        (BurnRequest { max_duration_s: 600.0, ..request() }, "duration|1356.032|burn.maxDuration = 600"),
        (BurnRequest { max_nutation_rad: 1e-4, ..request() }, "nutation|deg|burn.maxNutation"),
        (BurnRequest { group: "thrust along +Z".into(), ..request() }, "burn.thruster|without torque"),
        (BurnRequest { shape: Shape::Split, count: 5, ..request() }, "even number|5 pulses"),
    ] {
        assert_names(&refusal(request), &parts.split('|').collect::<Vec<_>>());
    }
}

#[test]
fn a_burn_goes_no_farther_than_its_target() {
    // The momentum is along +Z: 90 deg from the target (0.8, 0.6, 0).
    let aimed = |angle_deg: f64, target: [f64; 3]| {
        let burn =
            BurnRequest { angle_rad: angle_deg.to_radians(), target_inertial: target.into(), ..request() };
        let mut start = paper_start(1.483);
        start.burn = Some(burn);
        Plant::start(&ace(), &start, directions(), Commands::default(), 0.0)
            .map_err(|error| error.to_string())
    };
    let beyond = ["burn.angle", "100.0000 deg", "burn.targetDirection is 90.0000 deg", "momentum"];
    assert_names(&aimed(100.0, [0.8, 0.6, 0.0]).unwrap_err(), &beyond);
    assert!(aimed(90.0, [0.8, 0.6, 0.0]).is_ok());
    assert!(aimed(100.0, [0.8, 0.0, -0.6]).is_ok());
    assert!(aimed(37.0, [0.6, 0.0, 0.8]).unwrap_err().contains("36.8699 deg"));
    for along in [[0.0, 0.0, 1.0], [0.0, 0.0, -3.0], [5e-7, 0.0, 1.0]] {
        assert_names(
            &aimed(2.0, along).unwrap_err(),
            &["burn.targetDirection", "across the angular momentum"],
        );
    }
    assert!(aimed(1e-6, [3e-6, 0.0, 1.0]).is_ok());
    // It is the momentum that counts, not the spin axis.
    let mut start = paper_start(1.483);
    (start.nutation_rad, start.nutation_phase_rad) = (0.1, 0.0);
    start.burn =
        Some(BurnRequest { target_inertial: Vector3::new(0.1_f64.sin(), 0.0, 0.1_f64.cos()), ..request() });
    let text = Plant::start(&ace(), &start, directions(), Commands::default(), 0.0).unwrap_err().to_string();
    assert_names(&text, &["burn.targetDirection", "across the angular momentum"]);
}

#[test]
fn thrusters_that_alternate_have_one_torque() {
    // IIIR turns with 0.40 m, IIIA with 0.69 m, both across the spin axis and opposite.
    let text = refusal(BurnRequest { turns_per_pulse: 0.5, opposite_thruster: 7, ..request() });
    assert_names(&text, &["burn.oppositeThruster", "1.779200", "3.069120", "0.1 %"]);
    let uneven = ACE.replacen("position_m = [-0.69, 0.0, -0.40]", "position_m = [-0.75, 0.0, -0.40]", 1);
    let mut start = paper_start(1.483);
    start.burn = Some(BurnRequest { turns_per_pulse: 1.5, group: "axial couple I-IV".into(), ..request() });
    let spinner = Spinner::parse("my.toml", &uneven).unwrap();
    let text =
        Plant::start(&spinner, &start, directions(), Commands::default(), 0.0).unwrap_err().to_string();
    assert_names(&text, &["burn.group", "N m", "0.1 %"]);
    // Once a turn the opposite has no part in it.
    start.burn = Some(BurnRequest { opposite_thruster: 7, ..request() });
    assert!(Plant::start(&ace(), &start, directions(), Commands::default(), 0.0).is_ok());
}

#[test]
fn starts_that_make_no_sense_say_why() {
    let refuse = |change: &dyn Fn(&mut crate::spin::plant::Start)| {
        let mut start = paper_start(1.483);
        change(&mut start);
        Plant::start(&ace(), &start, directions(), Commands::default(), 0.0).unwrap_err().to_string()
    };
    assert_names(&refuse(&|s| s.inertia_kg_m2[1] = -2.0), &["inertia[2]", "-2", "positive"]);
    for axis in 0..3 {
        let refused = refuse(&|s| {
            s.inertia_kg_m2 = [10.0; 3];
            s.inertia_kg_m2[axis] = 30.0;
        });
        assert_names(&refused, &[&format!("inertia[{}]", axis + 1), "triangle"]);
    }
    assert_names(&refuse(&|s| s.spin_rate_rad_s = 0.0), &["spin.initialRate"]);
    assert_names(&refuse(&|s| s.attitude = [0.0, 0.0, 0.0, 2.0]), &["start.q", "norm"]);
    assert_names(&refuse(&|s| s.nutation_rad = 2.0), &["start.nutation"]);
    assert_names(&refuse(&|s| s.propellant_kg = -1.0), &["propellant.loaded", "-1 kg", "0 to 195 kg"]);
    assert_names(&refuse(&|s| s.propellant_kg = 195.1), &["propellant.loaded", "195.1 kg", "0 to 195 kg"]);
    assert_names(
        &refuse(&|s| s.burn = Some(BurnRequest { ratio_error: 0.6, ..request() })),
        &["burn.ratioError", "0.6"],
    );
    assert_names(&refuse(&|s| s.damper_time_constant_s = -1.0), &["damper.timeConstant"]);
    let mut start = paper_start(1.483);
    start.burn = Some(BurnRequest { timing: Timing::SunCrossing, ..request() });
    let on_axis = Directions { sun_inertial: Vector3::z(), ..directions() };
    let text = Plant::start(&ace(), &start, on_axis, Commands::default(), 0.0).unwrap_err().to_string();
    assert_names(&text, &["burn.timing", "off the axis"]);
}

fn changed(from: &str, to: &str) -> String {
    let text = ACE.replacen(from, to, 1);
    assert_ne!(text, ACE, "{from}");
    text
}

/// What is wrong with a setup.
fn problems(text: &str) -> Vec<Problem> {
    Spinner::parse("my.toml", text).unwrap_err().problems
}

/// What is written in ACE's file, what in its place, the key that is reported, parts of what is found there and of what is allowed.
const WRONG: &str = r#"force_n = 4.448 | force_n = -1.0 | thruster[1].force_n | -1 | above 0 and at most 1e12
direction = [0.0, 0.0, -1.0] | direction = [0.0, 0.1, -1.0] | thruster[1].direction | 1.00498 | unit vector
name = "IVR" | name = "IA" | thruster[10].name | "IA" | a name of its own
name = "spin up" | name = "IVR" | group[5].name | "IVR" | a name of its own
["IR+", "IR-"] | ["IR+", "IIR+++"] | group[1].thrusters[2] | mean "IIR+"? | [[thruster]]: IA, IR+
["IR+", "IR-"] | [] | group[1].thrusters | an empty list | at least one
opposite = "upper radial II" | opposite = "west" | group[1].opposite | "west" | upper radial I,
force_n = 4.448 | force_n = 4.448\ncolour = 3 | thruster[1].colour | the unknown key | force_n
[1.471, 1.483, 1.494] | [1.471, 1.483] | mass_properties.inertia_ratio | a list of 2 | 3 of them
[1.471, 1.483, 1.494] | [1.471, 0.0, 1.494] | mass_properties.inertia_ratio[2] | 0 | above 0
[1.471, 1.483, 1.494] | [1.471, 1.483, 2.1] | mass_properties.inertia_ratio[3] | triangle | a body
[0.0, 97.5, 195.0] | [0.0, 97.5, 97.5] | mass_properties.propellant_kg | 97.5, 97.5 | rising
initial_propellant_kg = 97.5 | initial_propellant_kg = 200 | mass_properties.initial_propellant_kg | 200 | 0 to 195
dry_mass_kg = 562.0 |  | mass_properties | no key `dry_mass_kg` | dry_mass_kg
resolution_s = 0.032 | resolution_s = nan | thrusters.resolution_s | NaN | above 0
resolution_s = 0.032 | resolution_s = "1 s" | thrusters.resolution_s | string "1 s" | a number
time_constant_s = 34200.0 | time_constant_s = -1 | damper.time_constant_s | -1 | from 0 to 1e12
pickets = 900 | pickets = 902 | star_tracker.pickets | 902 | a multiple of 4
every = 8 | every = 0 | star_tracker.every | 0 | at least 1
every = 8 | every = -8 | star_tracker.every | integer `-8` | a whole number from 0
field_of_view_deg = 20.0 | field_of_view_deg = 181 | star_tracker.field_of_view_deg | 181 | at most 180 deg
sectors = 16384 | sectors = 1.5 | sun_sensor.sectors | floating point `1.5` | a whole number
sun_angle_deg = 20.0 | sun_angle_deg = 0 | limits.sun_angle_deg | 0 | above 0
[8.1755e7, | [2e9, | l1_orbit.amplitude_m[1] | 2000000000 | less than earth_l1_distance_m
earth_l1_distance_m = 1.5e9 | earth_l1_distance_m = 1e14 | l1_orbit.earth_l1_distance_m | 1 | at most 1e13 m
[damper] | [dampers] | dampers | (did you mean `damper`?) | name"#;

#[test]
fn a_setup_that_cannot_be_used_names_line_key_found_and_allowed() {
    for row in WRONG.lines() {
        let row: Vec<String> = row.split(" | ").map(|part| part.replace("\\n", "\n")).collect();
        let [from, to, key, found, allowed] = row.as_slice() else { panic!("{row:?}") };
        let text = changed(from, to);
        let problems = problems(&text);
        let [problem] = problems.as_slice() else { panic!("{to}: {problems:?}") };
        assert_eq!(&problem.key, key, "{problem:?}");
        assert!(problem.found.contains(found) && problem.allowed.contains(allowed), "{problem:?}");
        // The line of what was changed; of what is missing, that of its table.
        let at = ACE.find(if to.is_empty() { "[mass_properties]" } else { from.as_str() }).unwrap();
        let added = if to.contains('\n') { 1 } else { 0 };
        assert_eq!(problem.line, Some(1 + added + text[..at].matches('\n').count()), "{problem:?}");
    }
    assert!(
        Spinner::parse("my.toml", "[[[")
            .unwrap_err()
            .to_string()
            .starts_with("my.toml:1: found text that is not TOML")
    );
}

#[test]
fn all_that_is_wrong_with_a_setup_is_reported_at_once() {
    let text =
        changed("force_n = 4.448", "force_n = -1.0").replace("pickets = 900", "pickets = 902\nzoom = 3");
    let text =
        text.replace("dry_mass_kg = 562.0", "dry_mass_kg = 0").replace("spin_rate_tolerance_rpm = 0.1", "");
    let keys: Vec<String> = problems(&text).into_iter().map(|problem| problem.key).collect();
    let expected = [
        "mass_properties.dry_mass_kg",
        "thruster[1].force_n",
        "star_tracker.pickets",
        "star_tracker.zoom",
        "limits",
    ];
    assert_eq!(keys, expected);
    // Groups are not judged by thrusters that nobody could read.
    let text = ACE.replace("[[thruster]]", "[[thrustr]]");
    assert!(problems(&text).iter().all(|problem| problem.key == "thrustr"), "{:?}", problems(&text));
}

#[test]
fn a_repeated_name_is_refused_by_both_its_places() {
    let refusal =
        |from: &str, to: &str| Spinner::parse("ace.toml", &changed(from, to)).unwrap_err().to_string();
    // The fourth thruster takes the first one's name.
    let text = refusal("name = \"IIA\"", "name = \"IA\"");
    assert_names(&text, &["thruster[4].name", "\"IA\"", "thruster[1] too", "a name of its own"]);
    // A group that is called like a thruster.
    let text = refusal("name = \"spin up\"", "name = \"IA\"");
    assert_names(&text, &["group[", "\"IA\"", "thruster[1] too"]);
}
