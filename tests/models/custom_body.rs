//! A body of the user's own, described by the spacecraft's file, against closed forms.

use core::f64::consts::TAU;

use models::{DisturbanceTorque, Guidance, MomentumPlant};
use nalgebra::Vector3;

use super::named_model::NamedModel;

const SAILER: &str = include_str!("../../fmu-src/resources/examples/solar-sailer.toml");

/// 5 km radius, 2000 kg/m3.
const GM_M3_S2: f64 = 69_886.0;
const AXIS_M: f64 = 4e11;
const GM_SUN_M3_S2: f64 = 1.327_124_400_41e20;
/// Obliquity of the ecliptic of J2000.
const OBLIQUITY_RAD: f64 = 84_381.448 / 3600.0 * TAU / 360.0;
/// The item `custom`.
const CUSTOM: f64 = 100.0;

const ON_A_CIRCLE: &str = "elements = { semi_major_axis_m = 4e11, eccentricity = 0.0, inclination_deg = 0, ascending_node_deg = 0, \
     periapsis_argument_deg = 0, true_anomaly_deg = 0 }\nepoch = \"2030-01-01 TDB\"\n";

/// The sailer about an asteroid, with what is reported of its motion.
fn about_an_asteroid(motion: &str, start: &str) -> String {
    let sailer = SAILER.split("[start]").next().unwrap();
    format!(
        "{sailer}\n[body]\nname = \"Rock\"\ngravitational_parameter_m3_s2 = {GM_M3_S2}\nradii_m = [5000, 5000, 5000]\n\
         {motion}\n[start]\n\"start.epoch\" = \"2030-01-01 TDB\"\n\"orbit.semiMajorAxis\" = 6500\n\
         \"orbit.dynamics\" = \"twoBody\"\n{start}"
    )
}

/// Along the ecliptic's own axes, in EME2000.
fn from_ecliptic(x: f64, y: f64) -> Vector3<f64> {
    Vector3::new(x, y * OBLIQUITY_RAD.cos(), y * OBLIQUITY_RAD.sin())
}

#[test]
fn an_orbit_about_it_has_keplers_period_and_it_goes_round_the_sun() {
    let plant = NamedModel::<MomentumPlant>::with("my.toml", &about_an_asteroid(ON_A_CIRCLE, ""));
    let mut flight = plant.initialize(0.0, &[]).unwrap();
    let start_m = flight.vector("position");
    assert!((start_m.norm() - 6500.0).abs() < 1e-9);
    let sun_m = flight.vector("sun.positionInertial");
    assert!((sun_m + from_ecliptic(AXIS_M, 0.0)).norm() < 1e-9 * AXIS_M, "{sun_m}");
    let period_s = TAU * (6500.0_f64.powi(3) / GM_M3_S2).sqrt();
    assert!((period_s / 3600.0 - 3.46).abs() < 0.01);
    flight.step_to(period_s).unwrap();
    assert!((flight.vector("position") - start_m).norm() < 1e-6);
    // A fortieth of its year later the asteroid is a fortieth of its orbit further.
    let angle_rad = TAU / 40.0;
    flight.step_to(angle_rad * (AXIS_M.powi(3) / GM_SUN_M3_S2).sqrt()).unwrap();
    let sun_m = flight.vector("sun.positionInertial");
    let expected_m = -from_ecliptic(AXIS_M * angle_rad.cos(), AXIS_M * angle_rad.sin());
    assert!((sun_m - expected_m).norm() < 1e-8 * AXIS_M, "{sun_m}");
}

#[test]
fn a_state_in_either_frame_is_as_good_as_elements() {
    let speed_m_s = (GM_SUN_M3_S2 / AXIS_M).sqrt();
    let [x, y, z] = from_ecliptic(0.0, speed_m_s).into();
    let states = [
        format!(
            "position_m = [4e11, 0, 0]\nvelocity_m_s = [0, {speed_m_s}, 0]\nepoch = \"2030-01-01 TDB\"\n"
        ),
        format!(
            "position_m = [4e11, 0, 0]\nvelocity_m_s = [{x}, {y}, {z}]\nframe = \"eme2000\"\nepoch = \"2030-01-01 TDB\"\n"
        ),
    ];
    let sun_m = |motion: &str| {
        let guidance = NamedModel::<MomentumPlant>::with("my.toml", &about_an_asteroid(motion, ""));
        let mut flight = guidance.initialize(0.0, &[]).unwrap();
        flight.step_to(30.0 * 86_400.0).unwrap();
        flight.vector("sun.positionInertial")
    };
    let expected_m = sun_m(ON_A_CIRCLE);
    for state in &states {
        assert!((sun_m(state) - expected_m).norm() < 1e-8 * AXIS_M, "{state}");
    }
}

#[test]
fn all_models_have_its_numbers() {
    let motion =
        format!("{ON_A_CIRCLE}j2 = 0.02\npole_deg = [30, 60]\nrotation_rate_rad_s = 3e-4\nalbedo = 0.2\n");
    let text = about_an_asteroid(&motion, "").replace("[5000, 5000, 5000]", "[6000, 5000, 4000]");
    let plant = NamedModel::<MomentumPlant>::with("my.toml", &text);
    let flight = plant.initialize(0.0, &[]).unwrap();
    for (name, expected) in [
        ("planet.gravitationalParameter", GM_M3_S2),
        ("planet.radius", 5000.0),
        ("planet.j2", 0.02),
        ("planet.j2Radius", 6000.0),
        ("planet.poleDeclination", 60.0_f64.to_radians()),
        ("planet.diffuseReflectivity", 0.2),
        ("planet.absorptivity", 0.8),
        ("ephemeris.semiMajorAxis", AXIS_M),
    ] {
        assert_eq!(flight.real(name), expected, "{name}");
    }
    let torque = NamedModel::<DisturbanceTorque>::with("my.toml", &text);
    assert_eq!(torque.initialize(0.0, &[]).unwrap().real("planet.radius"), 5000.0);
    let guidance = NamedModel::<Guidance>::with("my.toml", &text);
    let flight = guidance.initialize(0.0, &[("position[1]", 7e3), ("velocity[2]", 3.0)]).unwrap();
    assert_eq!(flight.vector("planet.radii"), Vector3::new(6000.0, 5000.0, 4000.0));
    assert_eq!(flight.real("planet.rotationRate"), 3e-4);
}

#[test]
fn it_is_aimed_at_from_elsewhere() {
    let text = about_an_asteroid(ON_A_CIRCLE, "");
    let guidance = NamedModel::<Guidance>::with("my.toml", &text);
    // At 1 AU; the scenario nadir's +Z, aimed at a body.
    // 10,957.5 days past J2000.
    let place = [
        ("start.epoch", 946_728_000.0),
        ("target.planet", 2.0),
        ("position[2]", 1.5e11),
        ("velocity[1]", -3e4),
    ];
    let scenario = [("pointing.scenario", 2.0), ("aimpoint.option", 15.0), ("aimpoint.body", CUSTOM)];
    let sets: Vec<_> = place.into_iter().chain(scenario).collect();
    let flight = guidance.initialize(0.0, &sets).unwrap();
    let toward = (from_ecliptic(AXIS_M, 0.0) - Vector3::new(0.0, 1.5e11, 0.0)).normalize();
    let z_inertial = flight.to_inertial("command.q") * Vector3::z();
    assert!(z_inertial.angle(&toward) < 1e-9, "{z_inertial} {toward}");
}

#[test]
fn where_the_file_does_not_place_it_something_else_must() {
    let plant = NamedModel::<MomentumPlant>::with("my.toml", &about_an_asteroid("", ""));
    let message = plant.refusal(&[]);
    assert!(message.contains("neither `elements` nor `position_m`"), "{message}");
    let inputs = [("ephemeris.source", 3.0), ("sun.position[1]", 2e11), ("earth.position[1]", 3e11)];
    let mut flight = plant.initialize(0.0, &inputs).unwrap();
    flight.step_to(60.0).unwrap();
    assert!((flight.real("sun.distance") / 2e11 - 1.0).abs() < 1e-6);
    let message = plant.refusal(&[("ephemeris.source", 2.0)]);
    assert!(message.contains("found kepler"), "{message}");
    let given =
        [("ephemeris.source", 2.0), ("ephemeris.semiMajorAxis", 3e11), ("ephemeris.eccentricity", 0.1)];
    // At perihelion.
    let distance_m = plant.initialize(0.0, &given).unwrap().real("sun.distance");
    assert!((distance_m / 2.7e11 - 1.0).abs() < 1e-6, "{distance_m}");
}

#[test]
fn the_source_kepler_takes_the_files_elements_at_their_own_time() {
    let plant = NamedModel::<MomentumPlant>::with("my.toml", &about_an_asteroid(ON_A_CIRCLE, ""));
    // A quarter of its year after the file's epoch, 10,957.5 days past J2000.
    let quarter_s = 0.25 * TAU * (AXIS_M.powi(3) / GM_SUN_M3_S2).sqrt();
    let later = [("ephemeris.source", 2.0), ("start.epoch", 946_728_000.0 + quarter_s)];
    let sun_m = plant.initialize(0.0, &later).unwrap().vector("sun.positionInertial");
    assert!((sun_m + from_ecliptic(0.0, AXIS_M)).norm() < 1e-8 * AXIS_M, "{sun_m}");
}
