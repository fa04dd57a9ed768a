//! Windows and hot pole of a spacecraft file: what a file without them gets, and shares of the period that follow the orbit.

use model_description::{Description, VariableKind};
use models::{Guidance, MomentumPlant};

use fmi_export::Model;

use super::named_model::{NamedModel, described};

/// MESSENGER's shape with a file's own lines in the place of its start values and hot pole.
fn text(lines: &str) -> String {
    let shape = MomentumPlant::DEFAULT_SETUP.split("\n[start]").next().unwrap();
    let shape = shape.split("\n[hot_pole]").next().unwrap();
    format!("{shape}\n{lines}\n")
}

/// The start value of a number, an item or a flag.
fn start(description: &Description, name: &str) -> f64 {
    let variable = description.variables.iter().find(|variable| variable.name == name).unwrap();
    match &variable.kind {
        VariableKind::Real { start, .. } => start.unwrap(),
        VariableKind::Integer { start, .. } | VariableKind::Enumeration { start, .. } => {
            start.unwrap().into()
        }
        VariableKind::Boolean { start, .. } => f64::from(u8::from(start.unwrap())),
        VariableKind::String { .. } => panic!("{name}"),
    }
}

#[test]
fn a_file_without_settings_points_at_nadir_without_downlinks_or_hot_pole() {
    let plant = described::<MomentumPlant>("my.toml", &text("")).unwrap();
    let guidance = described::<Guidance>("my.toml", &text("")).unwrap();
    for (description, name, expected) in [
        (&plant, "guided.scienceRule", 2.0),
        (&plant, "guided.downlinkEvery", 0.0),
        (&guidance, "guided.scienceRule", 2.0),
        (&guidance, "guided.downlinkEvery", 0.0),
        (&guidance, "hotPole.enabled", 0.0),
    ] {
        assert_eq!(start(description, name), expected, "{name}");
    }
    let hot_pole = "[hot_pole]\naltitude_km = 100\nangle_deg = 180\ncone_deg = 0";
    let guidance = described::<Guidance>("my.toml", &text(hot_pole)).unwrap();
    let found =
        ["enabled", "altitude", "angle", "cone"].map(|name| start(&guidance, &format!("hotPole.{name}")));
    assert_eq!(found, [1.0, 1e5, core::f64::consts::PI, 0.0]);
}

#[test]
fn shares_of_the_period_follow_the_orbit_unless_a_time_is_set() {
    // Kepler's third law for this axis about Mercury.
    let (axis_m, gm_m3_s2) = (8e6_f64, 2.203_186_855e13);
    let period_s = core::f64::consts::TAU * (axis_m.powi(3) / gm_m3_s2).sqrt();
    let windows = "[downlinks]\nstart = \"20 %\"\nstop = \"40 %\"\nevery = 1";
    let in_shares = NamedModel::<MomentumPlant>::with("my.toml", &text(windows));
    let in_seconds = NamedModel::<MomentumPlant>::with("my.toml", &text(""));
    let gm = ("planet.gravitationalParameter", gm_m3_s2);
    let orbit = [("orbit.semiMajorAxis", axis_m), ("orbit.eccentricity", 0.1), gm];
    let times = [("guided.downlinkStart", 0.2 * period_s), ("guided.downlinkEnd", 0.4 * period_s)];
    let every = [("guided.downlinkEvery", 1.0)];
    let mut by_shares = in_shares.initialize(0.0, &orbit).unwrap();
    let mut by_seconds = in_seconds.initialize(0.0, &[&orbit[..], &times, &every].concat()).unwrap();
    let mut never = in_seconds.initialize(0.0, &orbit).unwrap();
    let mut set =
        in_shares.initialize(0.0, &[&orbit[..], &[("guided.downlinkEnd", 0.3 * period_s)]].concat()).unwrap();
    for (share, is_open, is_open_where_set) in [
        (0.1, false, false),
        (0.25, true, true),
        (0.35, true, false),
        (0.45, false, false),
        (1.25, true, true),
    ] {
        let [shares, seconds, nadir, shorter] =
            [&mut by_shares, &mut by_seconds, &mut never, &mut set].map(|it| {
                it.step_to(share * period_s).unwrap();
                it.quaternion("attitude.q")
            });
        let apart = |a: [f64; 4], b: [f64; 4]| a.iter().zip(b).any(|(a, b)| (a - b).abs() > 1e-9);
        assert!(!apart(shares, seconds), "{share}");
        assert_eq!([apart(shares, nadir), apart(shorter, nadir)], [is_open, is_open_where_set], "{share}");
    }
}

#[test]
fn a_window_as_long_as_the_cycle_is_warned_of_whatever_the_strategy() {
    for (stop, words) in [("\"110 %\"", Some("always open")), ("\"90 %\"", None)] {
        let windows = format!("[downlinks]\nstart = \"5 %\"\nstop = {stop}\nevery = 1");
        let named = NamedModel::<MomentumPlant>::with("my.toml", &text(&windows));
        named.initialize(0.0, &[]).unwrap();
        let warnings = named.warnings();
        assert_eq!(warnings.len(), usize::from(words.is_some()), "{warnings:?}");
        assert!(words.is_none_or(|words| warnings[0].contains(words)), "{warnings:?}");
    }
}

/// Greatest elevation of the Sun in deg, and of the planet off +Z; dumps; of ten days of the tutorial's spacecraft with these lines.
fn of_tutorial(lines: &str, sets: &[(&str, f64)]) -> ([f64; 2], f64, Vec<String>) {
    let text = include_str!("../../docs/src/tutorial/venus.toml");
    let named = NamedModel::<MomentumPlant>::with("venus.toml", &format!("{text}\n{lines}"));
    let mut flight = named.initialize(0.0, sets).unwrap();
    let mut greatest_deg = [0.0_f64; 2];
    for step in 1..=1440 {
        flight.step_to(f64::from(step) * 600.0).unwrap();
        let off_nadir = flight.vector("planet.positionBody").angle(&nalgebra::Vector3::z());
        for (greatest, angle) in greatest_deg.iter_mut().zip([flight.real("sun.elevation").abs(), off_nadir])
        {
            *greatest = greatest.max(angle.to_degrees());
        }
    }
    (greatest_deg, f64::from(flight.integer("dump.count")), named.warnings())
}

#[test]
fn the_tutorials_orbiter_looks_at_venus_and_in_a_downlink_for_ever_it_would_not() {
    let ([elevation_deg, off_nadir_deg], dumps, warnings) = of_tutorial("", &[]);
    assert!(elevation_deg > 60.0 && off_nadir_deg < 1e-5, "{elevation_deg} {off_nadir_deg}");
    assert!(dumps == 0.0 && warnings.is_empty(), "{dumps} {warnings:?}");
    let windows =
        [("guided.downlinkStart", 7200.0), ("guided.downlinkEnd", 36_000.0), ("guided.downlinkEvery", 2.0)];
    let antenna = "[[antennas]]\nname = \"dish\"\nazimuth_deg = [-180, 180]\nbeam_deg = [3, 3]";
    let ([elevation_deg, off_nadir_deg], dumps, warnings) = of_tutorial(antenna, &windows);
    assert!(elevation_deg < 1e-6 && off_nadir_deg > 60.0, "{elevation_deg} {off_nadir_deg}");
    assert!(
        dumps >= 5.0 && warnings.len() == 1 && warnings[0].contains("always open"),
        "{dumps} {warnings:?}"
    );
}
