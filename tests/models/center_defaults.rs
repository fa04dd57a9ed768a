//! Start values that follow the centre of a spacecraft's orbit by its own file, and those that another centre leaves at them.

use fmi_export::fmi2::entry;
use fmi_export::{Library, Model};
use model_description::{Description, VariableKind};
use models::{DisturbanceTorque, Guidance, MomentumPlant};
use physics::bodies::Body;

use super::named_model::NamedModel;

static LIBRARY: Library =
    Library { entries: &[entry::<MomentumPlant>(), entry::<DisturbanceTorque>(), entry::<Guidance>()] };

const SAILER: &str = include_str!("../../fmu-src/resources/examples/solar-sailer.toml");

/// The sailer on the orbit that follows its centre.
fn sailer() -> String {
    SAILER.replace("\"orbit.eccentricity\" = 0.3\n", "")
}

/// The sailer about a body.
fn about(center: &str) -> String {
    format!("{}\"orbit.center\" = \"{center}\"\n", sailer())
}

fn described<M: Model>(text: &str) -> Description {
    LIBRARY.describe(LIBRARY.find(M::NAME).unwrap(), Some("my.toml"), Some(text)).unwrap()
}

fn start(description: &Description, name: &str) -> f64 {
    let variable = description.variables.iter().find(|variable| variable.name == name).unwrap();
    match &variable.kind {
        VariableKind::Real { start, .. } => start.unwrap(),
        VariableKind::Enumeration { start, .. } => f64::from(start.unwrap()),
        VariableKind::Boolean { start, .. } => f64::from(u8::from(start.unwrap())),
        _ => panic!("{name}"),
    }
}

#[test]
fn start_values_are_those_of_the_center_in_the_file() {
    let plant = described::<MomentumPlant>(&about("sun"));
    for (name, expected) in [
        ("orbit.semiMajorAxis", 149_597_870_700.0),
        ("orbit.eccentricity", 0.0),
        ("orbit.inclination", 0.0),
        ("orbit.ascendingNode", 0.0),
        ("orbit.periapsisArgument", 0.0),
        // The ecliptic.
        ("orbit.frame", 4.0),
        ("planet.radius", 695_700e3),
    ] {
        assert_eq!(start(&plant, name), expected, "{name}");
    }
    // 1 AU in a year of 365.25 days (Kepler's third law).
    let gm = start(&plant, "planet.gravitationalParameter");
    let year_s = core::f64::consts::TAU * (149_597_870_700.0_f64.powi(3) / gm).sqrt();
    assert!((year_s / 86_400.0 - 365.256_9).abs() < 1e-3, "{year_s}");
    assert_eq!(start(&described::<DisturbanceTorque>(&about("sun")), "planet.present"), 0.0);
    assert_eq!(start(&described::<Guidance>(&about("sun")), "target.planet"), 2.0);

    for (center, item, radius_m) in
        [("venus", 3.0, 6_051.8e3), ("earth", 4.0, 6_371.0e3), ("jupiter", 7.0, 69_911e3)]
    {
        let text = about(center);
        let (plant, torque, guidance) = (
            described::<MomentumPlant>(&text),
            described::<DisturbanceTorque>(&text),
            described::<Guidance>(&text),
        );
        let radius = start(&plant, "planet.radius");
        assert!((radius / radius_m - 1.0).abs() < 0.03, "{center} {radius}");
        assert_eq!(start(&plant, "orbit.semiMajorAxis"), 3.0 * radius);
        assert_eq!((start(&plant, "orbit.eccentricity"), start(&plant, "orbit.frame")), (0.0, 2.0));
        assert_eq!(start(&torque, "planet.radius"), radius);
        assert_eq!((start(&guidance, "target.planet"), start(&guidance, "planet.radii[1]")), (item, radius));
        for name in ["planet.gravitationalParameter", "planet.poleDeclination", "ephemeris.semiMajorAxis"] {
            assert_eq!(start(&plant, name), start(&guidance, name), "{name}");
        }
        assert_eq!(start(&plant, "planet.emissivity"), start(&torque, "planet.emissivity"));
        // Outside the planet: it initializes.
        NamedModel::<DisturbanceTorque>::with("my.toml", &text).initialize(0.0, &[]).unwrap();
    }
    // What the file sets besides stays.
    let set = format!("{}\"orbit.eccentricity\" = 0.3\n", about("sun"));
    assert_eq!(start(&described::<MomentumPlant>(&set), "orbit.eccentricity"), 0.3);
}

/// The same orbit, whether the file names the centre or the master does; the master is warned.
#[test]
fn a_center_set_later_gives_the_same_orbit_and_a_warning() {
    for (body, center) in
        [(Body::Sun, "sun"), (Body::Venus, "venus"), (Body::Earth, "earth"), (Body::Jupiter, "jupiter")]
    {
        let by_file = NamedModel::<MomentumPlant>::with("my.toml", &about(center));
        let by_master = NamedModel::<MomentumPlant>::with("my.toml", &sailer());
        let item = start(&described::<MomentumPlant>(&about(center)), "orbit.center");
        let mut a = by_file.initialize(0.0, &[]).unwrap();
        let mut b = by_master.initialize(0.0, &[("orbit.center", item)]).unwrap();
        a.step_to(86_400.0).unwrap();
        b.step_to(86_400.0).unwrap();
        for name in ["position", "velocity", "torque.total", "sun.direction"] {
            assert_eq!(a.vector(name), b.vector(name), "{body:?} {name}");
        }
        assert_eq!(by_file.warnings(), [""; 0]);
        let reported = by_master.warnings();
        let names = [
            "orbit.center is",
            center,
            "orbit.semiMajorAxis = ",
            "orbit.eccentricity = 0",
            "orbit.inclination = ",
        ];
        assert!(reported.len() == 1 && names.iter().all(|name| reported[0].contains(name)), "{reported:?}");
        assert_eq!(reported[0].contains("orbit.frame = ecliptic"), body == Body::Sun, "{reported:?}");
    }
}

/// About the Sun an eccentricity that happens to be the one of the default about Mercury is simulated by a file about the Sun.
#[test]
fn values_that_are_set_are_simulated() {
    let set = format!(
        "{}\"orbit.eccentricity\" = 0.74\n\"orbit.trueAnomaly\" = 0\n\"orbit.frame\" = \"planetEquator\"\n",
        about("sun")
    );
    let named = NamedModel::<MomentumPlant>::with("my.toml", &set);
    let flight = named.initialize(0.0, &[]).unwrap();
    let position_m = flight.vector("position");
    assert!((position_m.norm() / (0.26 * 149_597_870_700.0) - 1.0).abs() < 1e-12, "{position_m}");
    // Right ascension of the Sun's equator's node on that of the Earth: 90 deg beyond that of its pole, 286.13 deg.
    let node_rad = position_m.y.atan2(position_m.x);
    assert!((node_rad - 16.13_f64.to_radians()).abs() < 1e-9, "{node_rad}");
    assert_eq!(named.warnings(), [""; 0]);
    // Nothing to tell where every element is set, or none counts.
    let plant = NamedModel::<MomentumPlant>::shipped();
    let elements = [
        ("orbit.center", 2.0),
        ("orbit.frame", 4.0),
        ("orbit.semiMajorAxis", 1.5e11),
        ("orbit.eccentricity", 0.1),
        ("orbit.inclination", 0.2),
        ("orbit.ascendingNode", 0.3),
        ("orbit.periapsisArgument", 0.4),
    ];
    plant.initialize(0.0, &elements).unwrap();
    let given = [
        ("orbit.center", 2.0),
        ("orbit.source", 2.0),
        ("orbit.position[1]", 1e11),
        ("orbit.velocity[2]", 3e4),
    ];
    plant.initialize(0.0, &given).unwrap();
    assert_eq!(plant.warnings(), [""; 0]);
}

const VENUS: (&str, f64) = ("orbit.center", 3.0);

/// The values that orbit, planet and ephemeris start with in the shipped plant.
fn start_values_of_groups(description: &Description) -> Vec<(&str, f64)> {
    let of_group = |name: &str| ["orbit.", "planet.", "ephemeris."].iter().any(|it| name.starts_with(it));
    let parameters = description.variables.iter().filter(|variable| {
        variable.causality == fmi_export::model_description::Causality::Parameter && of_group(&variable.name)
    });
    let names = parameters.map(|variable| variable.name.as_str());
    names.filter(|name| *name != VENUS.0).map(|name| (name, start(description, name))).collect()
}

/// 0.74 is the eccentricity of the start values, about Mercury.
#[test]
fn a_value_that_is_set_counts_also_where_it_is_the_start_value() {
    let plant = NamedModel::<MomentumPlant>::shipped();
    let axis = ("orbit.semiMajorAxis", 6e7);
    let (left, set) =
        (plant.initialize(0.0, &[VENUS, axis]).unwrap(), [VENUS, axis, ("orbit.eccentricity", 0.74)]);
    assert!((left.vector("position").norm() / 6e7 - 1.0).abs() < 1e-12);
    let set = plant.initialize(0.0, &set).unwrap();
    // From periapsis, at a (1 - e).
    assert!((set.vector("position").norm() / (6e7 * 0.26) - 1.0).abs() < 1e-12);
    let reported = plant.warnings();
    assert!(
        reported[0].contains("orbit.eccentricity") && !reported[1].contains("orbit.eccentricity"),
        "{reported:?}"
    );
}

/// Tools that write every parameter write start values; the centre is what somebody chose.
#[test]
fn a_group_of_which_everything_is_written_follows_the_center_still() {
    let description = described::<MomentumPlant>(MomentumPlant::DEFAULT_SETUP);
    let everything = start_values_of_groups(&description);
    assert!(everything.len() > 25, "{everything:?}");
    let plant = NamedModel::<MomentumPlant>::shipped();
    let mut alone = plant.initialize(0.0, &[VENUS]).unwrap();
    let mut written = plant.initialize(0.0, &[&everything[..], &[VENUS]].concat()).unwrap();
    alone.step_to(7_200.0).unwrap();
    written.step_to(7_200.0).unwrap();
    for name in ["position", "velocity", "torque.total"] {
        assert_eq!(alone.vector(name), written.vector(name), "{name}");
    }
    // One of them another than its start value: what is written of its group counts, of others not.
    let other: Vec<_> = everything
        .iter()
        .map(|&(name, value)| (name, if name == "planet.radius" { 6e6 } else { value }))
        .collect();
    let other = plant.initialize(0.0, &[&other[..], &[VENUS]].concat()).unwrap();
    assert_eq!(other.real("planet.j2"), start(&description, "planet.j2"));
    assert_eq!(other.real("orbit.eccentricity"), 0.0);
}

/// Values that act read back, for every body, within the limits of settings.
#[test]
fn what_follows_the_center_reads_back() {
    let text = sailer();
    let sailer = NamedModel::<MomentumPlant>::with("my.toml", &text);
    let guidance = NamedModel::<Guidance>::with("my.toml", &text);
    for center in ["sun", "mercury", "venus", "earth", "mars", "jupiter"] {
        let (plant, target) =
            (described::<MomentumPlant>(&about(center)), described::<Guidance>(&about(center)));
        let flight = sailer.initialize(0.0, &[("orbit.center", start(&plant, "orbit.center"))]).unwrap();
        let of_center = start_values_of_groups(&plant);
        for (name, expected) in of_center.iter().filter(|(name, _)| *name != "orbit.source") {
            let is_real = !["orbit.frame", "planet.dayTemperature"].contains(name);
            let limits = sailer.given().into_iter().find(|it| it.0 == *name).unwrap();
            if limits.2 {
                assert!(is_real || f64::from(flight.integer(name)) == *expected, "{center} {name}");
            } else {
                assert_eq!(flight.real(name), *expected, "{center} {name}");
                assert!((limits.1.0..=limits.1.1).contains(expected), "{center} {name} {expected}");
            }
        }
        if center == "sun" {
            continue;
        }
        let seen = guidance.initialize(0.0, &[("target.planet", start(&target, "target.planet"))]).unwrap();
        for name in
            ["planet.radii[3]", "planet.primeMeridian", "planet.rotationRate", "ephemeris.semiMajorAxis"]
        {
            assert_eq!(seen.real(name), start(&target, name), "{center} {name}");
        }
    }
}
