//! A full file in SI, and every mistake with its line.

use nalgebra::Vector3;
use physics::environment::dates;

use super::*;
use crate::values::Instant;

fn parsed(text: &str) -> Result<LegFile, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("mission.toml"), "stop = 1\n").unwrap();
    let file = folder.path().join("leg.toml");
    reading::parse([&file; 2], text.to_owned(), judge).map_err(String::from)
}

const FULL: &str = "mission = \"mission.toml\"
[depart]
at = \"2008-03-19 TDB\"
position = [\"0.5 AU\", 2e10, \"-3 km\"]
velocity = [\"1 km/s\", 0, -2.5]
[arrive]
body = \"mercury\"
at = \"2008-10-06T08:40:00 UTC\"
altitude = \"200 km\"
angle = \"90 deg\"
revolutions = 1
branch = \"right\"
";

#[test]
fn units_are_read() {
    let leg = parsed(FULL).unwrap();
    assert_eq!(leg.depart.position_m.it, Vector3::new(0.5 * 149_597_870_700.0, 2e10, -3e3));
    assert_eq!(leg.depart.velocity_before_m_s, Some(Vector3::new(1e3, 0.0, -2.5)));
    let (epoch_s, text) = leg.depart.at.clone().unwrap().it;
    assert_eq!((epoch_s, text.as_str()), (dates::epoch_s("2008-03-19 TDB").unwrap(), "2008-03-19 TDB"));
    assert_eq!(leg.arrive.at.it, Instant::Epoch(dates::epoch_s("2008-10-06T08:40:00 UTC").unwrap()));
    assert_eq!(
        (leg.arrive.body.it.word(), leg.arrive.revolutions()),
        ("mercury", Some((1, ArcBranch::Right)))
    );
    let FlybyAimpoint::Altitude { altitude_m, angle_rad } = leg.aimpoint().it else {
        panic!("{:?}", leg.aimpoint())
    };
    assert_eq!(altitude_m, 2e5);
    assert!((angle_rad - core::f64::consts::FRAC_PI_2).abs() < 1e-15);
    let components = FULL.replace("altitude = \"200 km\"\nangle = \"90 deg\"", "bT = \"-3100 km\"\nbR = 5e5");
    assert_eq!(
        parsed(&components).unwrap().aimpoint().it,
        FlybyAimpoint::Plane { b_t_m: -3.1e6, b_r_m: 5e5 }
    );
}

#[test]
fn every_mistake_is_reported_with_its_line() {
    for (old, new, expected) in [
        ("\"mission.toml\"", "\"none.toml\"", ":1: mission: found "),
        ("2008-03-19 TDB", "2008-03-19", ":3: depart.at: found \"2008-03-19\""),
        (
            "[\"0.5 AU\", 2e10, \"-3 km\"]",
            "[1, 2]",
            ":4: depart.position: found [1, 2], allowed: a list of three",
        ),
        ("\"-3 km\"]", "\"-3 kg\"]", "found [\"0.5 AU\", 20000000000, \"-3 kg\"]"),
        ("mercury", "pluto", ":7: arrive.body: found the unknown word `pluto`"),
        ("\"2008-10-06T08:40:00 UTC\"", "true", ":8: arrive.at: found true"),
        ("\"200 km\"", "\"-5 km\"", ":9: arrive.altitude: found \"-5 km\", inside the planet"),
        (
            "\"90 deg\"",
            "\"500 deg\"",
            ":10: arrive.angle: found \"500 deg\", allowed: an angle from -360 to 360 deg",
        ),
        ("angle = \"90 deg\"", "bT = 3e6", "found altitude, bT, allowed: altitude and angle, or bT and bR"),
        ("revolutions = 1", "revolutions = -1", ":11: arrive.revolutions: found -1, allowed: a whole number"),
        ("revolutions = 1", "revolutions = 0", ":12: arrive.branch: found it without revolutions"),
        ("branch = \"right\"", "", "found no key `branch`, allowed: branch = \"left\" or \"right\""),
        ("branch", "barnch", "found the unknown key `barnch` (did you mean `branch`?)"),
    ] {
        assert!(FULL.contains(old), "{old}");
        let refused = parsed(&FULL.replace(old, new)).unwrap_err();
        assert!(refused.contains(expected), "{expected}: {refused}");
    }
}
