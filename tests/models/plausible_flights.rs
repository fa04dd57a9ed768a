//! Each warning of a flight by a file or a setting that raises it alone; what is shipped raises none.

use models::{Guidance, MomentumPlant};

use super::named_model::{NamedModel, described};
use fmi_export::model_description::VariableKind;

const LEO: &str = include_str!("../../fmu-src/resources/examples/leo-500kg.toml");
const SAILER: &str = include_str!("../../fmu-src/resources/examples/solar-sailer.toml");
const TELESCOPE: &str = include_str!("../../fmu-src/resources/examples/sunshield-telescope.toml");
const MESSENGER: &str = include_str!("../../fmu-src/resources/messenger.toml");

/// The warnings of a flight over these seconds.
fn warned(text: &str, sets: &[(&str, f64)], end_s: f64) -> Vec<String> {
    let named = NamedModel::<MomentumPlant>::with("my.toml", text);
    let mut flight = named.initialize(0.0, sets).unwrap();
    flight.simulate_to(end_s, 600.0).unwrap();
    named.warnings()
}

/// The text with one part replaced, which is there.
fn with(text: &str, part: &str, by: &str) -> String {
    assert!(text.contains(part), "{part}");
    text.replace(part, by)
}

const AXIS: &str = "axis = [1.0, 0.0, 0.0]\nzero_normal = [0.0, -1.0, 0.0]";
const CLOSED: &str = "\"orbit.dynamics\" = \"disturbed\"\n";

/// Names of variables and what they are set to.
type Settings = &'static [(&'static str, f64)];

#[test]
fn each_setting_that_is_hardly_meant_raises_its_warning_alone() {
    let along_z = with(LEO, AXIS, "axis = [0.0, 0.0, 1.0]\nzero_normal = [0.0, -1.0, 0.0]");
    // The Sun in the plane of the orbit.
    let along_z = with(&along_z, "\"337.5 deg\"", "\"0 deg\"");
    let along_z = with(&along_z, "sun_offset_deg = 0.0", "sun_offset_deg = 90.0");
    let off_x = with(LEO, AXIS, "axis = [0.8660, 0.0, 0.5]\nzero_normal = [0.0, -1.0, 0.0]");
    let high = with(&with(LEO, CLOSED, ""), "6878.137 km", "20000 km");
    let dish = with(
        LEO,
        "[start]",
        "[[antennas]]\nname = \"dish\"\naxis = [0, 0, -1]\nbeam_deg = [10, 10]\n[start]",
    );
    let eclipse = with(LEO, "2024-03-20 UTC", "2024-04-08T17:45:00 UTC");
    let plate = |name: &str, normal: &str, y: f64, x: [f64; 2], half: f64, more: &str| {
        let [a, b] = x;
        let corners = match normal {
            "[-1, 0, 0]" => format!(
                "[{a}, -{half}, -{half}], [{a}, {half}, -{half}], [{a}, {half}, {half}], [{a}, -{half}, {half}]"
            ),
            _ => format!("[{a}, {y}, -{half}], [{b}, {y}, -{half}], [{b}, {y}, {half}], [{a}, {y}, {half}]"),
        };
        format!(
            "[[plates]]\nname = \"{name}\"\nnormal = {normal}\npolygon_m = [{corners}]\noptics = \"mli\"\n{more}"
        )
    };
    let deck = plate("deck", "[-1, 0, 0]", 0.0, [0.6, 0.6], 0.6, "");
    let open = with(
        LEO,
        "optics = \"mli\"\n\n[[cylinders]]",
        "optics = \"mli\"\nopen_faces = [\"+X\"]\n\n[[cylinders]]",
    );
    let open = with(&open, "[start]", &format!("{deck}[start]"));
    let screens: String = [-3.0, -4.0]
        .map(|y| plate(&format!("screen {y}"), "[0, -1, 0]", y, [-2.5, 2.5], 2.5, "rear_optics = \"mli\"\n"))
        .concat();
    let screened = with(LEO, "[start]", &format!("{screens}[start]"));
    let rows: &[(&str, Settings, f64, &str)] = &[
        (LEO, &[("orbit.ascendingNode", 97.4)], 0.0, "orbit.ascendingNode is 97.4 rad, more than a turn"),
        (
            LEO,
            &[("start.epoch", 2_451_545.0)],
            0.0,
            "start.epoch is 2451545 s past J2000 TDB, which is 2000-01-29",
        ),
        (LEO, &[("orbit.semiMajorAxis", 1.2e9)], 0.0, "from the Earth, whose sphere of influence ends at 92"),
        (
            &high,
            &[("orbit.semiMajorAxis", 6.878e6)],
            0.0,
            "orbit.dynamics is twoBody, the default of this FMU",
        ),
        (LEO, &[("aerodynamics.enabled", 0.0)], 0.0, "atmosphere.method is set and without effect"),
        (LEO, &[("spaceWeather.f107", 15.0)], 0.0, "spaceWeather.f107 is 15"),
        (&screened, &[], 0.0, "shadows of the surfaces on one another are off"),
        (LEO, &[("dipole.residual[1]", 60.0)], 0.0, "A.m2 is 0.120 A.m2/kg"),
        (
            LEO,
            &[("wheel[2].capacity", 600.0)],
            0.0,
            "wheel[2].capacity of 600 N.m.s is 1.200 N.m.s for each kg",
        ),
        (LEO, &[("wheel[3].inertia", 40.0)], 0.0, "wheel[3].inertia of 40 kg.m2 is 0.14"),
        (SAILER, &[("orbit.dynamics", 1.0)], 7200.0, "the force of light is "),
        (LEO, &[("orbit.dynamics", 1.0), ("orbit.semiMajorAxis", 6.52e6)], 0.0, "the force of air is "),
        (&along_z, &[], 0.0, "panel[1]: the Sun is within 10 deg of the axis of `+X` for "),
        (&off_x, &[], 6000.0, "panel[1].sunOffset of 0.0 deg is out of reach at "),
        (&eclipse, &[], 7200.0, "the Moon stands before the Sun on 2024-04-08"),
        (&dish, &[], 0.0, "antenna `dish` has the Earth in its beam for 0.0 % of the time"),
        (&open, &[], 0.0, "`deck` faces inward: before it stands the rear of `bus.-X`"),
    ];
    for (text, sets, end_s, part) in rows {
        let found = warned(text, sets, *end_s);
        assert!(found.iter().any(|it| it.contains(part)), "{part}: {found:#?}");
        // Both panels have the one slip.
        let others: Vec<&String> = found
            .iter()
            .filter(|it| {
                !it.contains(part)
                    && !it.contains(&part.replace("panel[1]", "panel[2]").replace("`+X`", "`-X`"))
            })
            .collect();
        assert_eq!(others, [""; 0], "{part}");
    }
}

#[test]
fn what_is_shipped_raises_no_warning() {
    let files = [
        MESSENGER,
        include_str!("../../fmu-src/resources/messenger-thermal.toml"),
        include_str!("../../fmu-src/resources/messenger-full.toml"),
        include_str!("../../fmu-src/resources/examples/cubesat-12u.toml"),
        include_str!("../../fmu-src/resources/examples/flexible-craft.toml"),
        include_str!("../../fmu-src/resources/examples/mercury-orbiter.toml"),
        LEO,
        SAILER,
        TELESCOPE,
        include_str!("../../docs/src/tutorial/leo.toml"),
    ];
    let warned = |text: &&str| {
        let found = warned(text, &[], 43_200.0);
        (!found.is_empty()).then(|| (text.lines().next().unwrap().to_owned(), found))
    };
    let found: Vec<(String, Vec<String>)> = files.iter().filter_map(warned).collect();
    assert!(found.is_empty(), "{found:#?}");
}

#[test]
fn gravity_that_no_body_of_this_size_has_is_refused() {
    let plant = NamedModel::<MomentumPlant>::shipped();
    let found = plant.refusal(&[("planet.gravitationalParameter", 22_031.868_551)]);
    let expected = "planet.gravitationalParameter, planet.radius: found 22031.868551 m3/s2 and 2439400.0 m, a mean density of \
                    5.429e-6 kg/m3, allowed: 100 to 30000 kg/m3";
    assert!(found.starts_with(expected), "{found}");
    let rock = |gm: &str| {
        let body = format!(
            "[body]\nname = \"Rock\"\ngravitational_parameter_m3_s2 = {gm}\nradii_m = [245, 245, 245]\n[start]"
        );
        described::<MomentumPlant>("my.toml", &with(SAILER, "[start]", &body))
    };
    let found = rock("4.9e-9").unwrap_err();
    assert!(
        found.contains(
            "body.gravitational_parameter_m3_s2: found 4.9e-9, with radii_m a mean density of 1.192e-6"
        ),
        "{found}"
    );
    assert!(
        found.contains("allowed: a mean density of 100 to 30000 kg/m3 (1 km3/s2 is 1e9 m3/s2)"),
        "{found}"
    );
    assert!(rock("4.9").is_ok());
}

/// The item that `orbit.dynamics` starts with.
fn dynamics(text: &str) -> i32 {
    let description = described::<MomentumPlant>("my.toml", text).unwrap();
    let variable = description.variables.iter().find(|it| it.name == "orbit.dynamics").unwrap();
    let VariableKind::Enumeration { start, .. } = variable.kind else { panic!("{variable:?}") };
    start.unwrap()
}

#[test]
fn an_orbit_is_disturbed_by_default_in_air_and_about_the_file_s_own_body() {
    let open = with(LEO, CLOSED, "");
    assert_eq!(dynamics(&open), 2);
    assert_eq!(dynamics(&with(&open, "6878.137 km", "8400 km")), 1, "a periapsis of 2014 km");
    assert_eq!(dynamics(&with(&with(&open, "6878.137 km", "9000 km"), "= 0.001", "= 0.1")), 2);
    assert_eq!(dynamics(&format!("{open}\"aerodynamics.enabled\" = false\n")), 1);
    assert_eq!(dynamics(&format!("{open}\"orbit.dynamics\" = \"twoBody\"\n")), 1);
    assert_eq!(dynamics(&format!("{open}\"orbit.source\" = \"held\"\n")), 1);
    for text in [MESSENGER, TELESCOPE] {
        assert_eq!(dynamics(text), 1);
    }
    let rock = "[body]\nname = \"Rock\"\ngravitational_parameter_m3_s2 = 4.9\nradii_m = [245, 245, 245]\n";
    let sailer = SAILER.split("[start]").next().unwrap();
    assert_eq!(dynamics(sailer), 1);
    assert_eq!(dynamics(&format!("{sailer}{rock}")), 2);
}

#[test]
fn panels_tell_where_they_stand_and_whether_that_is_where_they_are_to_stand() {
    let axis = "axis = [0.8, 0.0, 0.6]\nzero_normal = [0.0, -1.0, 0.0]";
    for (offset, reached) in [("0.0", false), ("60.0", true)] {
        let text =
            with(&with(LEO, AXIS, axis), "sun_offset_deg = 0.0", &format!("sun_offset_deg = {offset}"));
        let plant = NamedModel::<MomentumPlant>::with("my.toml", &text);
        let mut flight = plant.initialize(0.0, &[]).unwrap();
        flight.step_to(1000.0).unwrap();
        // The nearest angle to the Sun leaves what the Sun stands off the plane across the axis.
        let off_rad = flight.vector("sun.direction").dot(&nalgebra::Vector3::new(0.8, 0.0, 0.6)).asin().abs();
        let expected_rad = if reached { 60.0_f64.to_radians() } else { off_rad };
        assert!(off_rad > 0.1 && off_rad < 1.0, "{off_rad}");
        assert!((flight.real("panel[1].sunOffsetActual") - expected_rad).abs() < 1e-12);
        assert_eq!(flight.boolean("panel[1].sunOffsetReached"), reached);
    }
}

const ROLLED: &str = "[[command]]\nat = 0\nscenario = \"generic\"\nboresight = { option = \"vector\", vector = [0, -2, 0] }\n\
                      externalRoll = { option = \"sun\" }\n\
                      aimpoint = { option = \"nadir\" }\n";

#[test]
fn a_roll_axis_along_the_boresight_is_warned_of_once() {
    let part = "the command in line 1 of the timeline has its body roll axis along the boresight";
    for (roll, count) in [("[0, 1, 0]", 1), ("[0, 0, 1]", 0)] {
        let timeline = &format!("{ROLLED}bodyRoll = {{ option = \"vector\", vector = {roll} }}\n");
        let plant = NamedModel::<MomentumPlant>::shipped().with_schedule("timeline.toml", timeline);
        plant.initialize(0.0, &[]).unwrap().step_to(10.0).unwrap();
        let guidance = NamedModel::<Guidance>::shipped().with_schedule("timeline.toml", timeline);
        let sets = [("position[1]", 3e6), ("velocity[2]", 2.7e3)];
        guidance.initialize(0.0, &sets).unwrap().step_to(10.0).unwrap();
        for found in [plant.warnings(), guidance.warnings()] {
            assert_eq!(found.iter().filter(|it| it.starts_with(part)).count(), count, "{found:?}");
        }
    }
}
