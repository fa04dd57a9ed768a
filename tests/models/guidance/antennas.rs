//! Antennas and gimbals of other spacecraft than MESSENGER, and of one that has neither.

use models::{Guidance, MomentumPlant};
use nalgebra::Vector3;

use super::super::named_model::NamedModel;
use super::{FREE, PLACED, to_inertial, with};

const MESSENGER: &str = include_str!("../../../fmu-src/resources/messenger.toml");
const DISH: &str = "\n[[antennas]]\nname = \"dish\"\naxis = [0.0, 0.6, 0.8]\nbeam_deg = [3.0, 3.0]\n";
const TILTED: &str = "\n[[instruments]]\nname = \"tilted\"\nboresight = [1.0, 0.0, 0.0]\n\
                      gimbal = { axis = [0.0, 0.0, -1.0], minimum_deg = -10.0, maximum_deg = 70.0 }\n";
const WINDOWS: &str = "\n[downlinks]\nstart = \"2 h\"\nstop = \"10 h\"\nevery = 2\n";
const DOWNLINK: &[(&str, f64)] = &[("pointing.scenario", 6.0)];

/// MESSENGER without antennas, downlinks and gimbal, and with what is written here in their stead.
fn other(tables: &str) -> String {
    let kept = |paragraph: &&str| !paragraph.contains("[[antennas]]") && !paragraph.contains("gimbal = ");
    let (parts, start) = MESSENGER.split_once("\n[start]").unwrap();
    let parts: Vec<&str> = parts.split("\n\n").filter(kept).collect();
    let kept = |line: &&str| !line.starts_with("\"guided.downlink");
    let start: Vec<&str> = start.split('\n').filter(kept).collect();
    format!("{}\n{tables}\n[start]{}", parts.join("\n\n"), start.join("\n"))
}

#[test]
fn a_fixed_antenna_is_turned_to_the_earth_and_the_sun_as_near_to_minus_y_as_that_allows() {
    let named = NamedModel::<Guidance>::with("dish.toml", &other(DISH));
    let flight = named.initialize(0.0, &with(&[PLACED, FREE, DOWNLINK])).unwrap();
    let place = Vector3::new(3e6, 1e6, 2e6);
    let toward = |body: Vector3<f64>| to_inertial(&flight).inverse() * (body - place).normalize();
    let (axis, sun) = (Vector3::new(0.0, 0.6, 0.8), toward(Vector3::new(3e10, -4e10, 2e9)));
    assert!((toward(Vector3::new(-9e10, 5e10, -3e9)) - axis).norm() < 1e-12);
    let nearest_rad = (0..36_000)
        .map(|k| nalgebra::Rotation3::new(axis * (f64::from(k) * 1e-2).to_radians()) * sun)
        .map(|turned| turned.angle(&-Vector3::y()))
        .fold(f64::INFINITY, f64::min);
    assert!(sun.angle(&-Vector3::y()) < nearest_rad + 1e-9);
    assert_eq!(flight.integer("antenna.select"), 1);
    assert!(flight.boolean("link.available") && flight.boolean("target.reachable"));
    assert!((flight.real("antenna.azimuth").abs() - core::f64::consts::PI).abs() < 1e-12);
    // The zone turns the antenna off the Earth: the beam stays where it is.
    let flight = named.initialize(0.0, &with(&[PLACED, &[("hotPole.enabled", 0.0)], DOWNLINK])).unwrap();
    assert!(flight.boolean("constraint.sunKeepIn") && !flight.boolean("link.available"));
    assert_eq!(flight.integer("antenna.select"), 1);
}

#[test]
fn a_fan_of_another_range_has_the_sun_on_minus_y_where_it_reaches_the_earth_and_else_stands_at_its_bound() {
    let place = Vector3::new(3e6, 1e6, 2e6);
    let [sun, earth]: [Vector3<f64>; 2] =
        [Vector3::new(3e10, -4e10, 2e9), Vector3::new(-9e10, 5e10, -3e9)].map(|it| it - place);
    let separation_deg = sun.angle(&earth).to_degrees();
    for (range_deg, azimuth_deg, is_in_range) in [
        ([140, 175], separation_deg, true),
        ([-175, -140], -separation_deg, true),
        ([185, 220], -separation_deg, true),
        ([20, 60], 60.0, false),
        ([-30, 10], -30.0, false),
    ] {
        let fan =
            format!("\n[[antennas]]\nname = \"fan\"\nazimuth_deg = {range_deg:?}\nbeam_deg = [4, 15]\n");
        let named = NamedModel::<Guidance>::with("fan.toml", &other(&fan));
        let flight = named.initialize(0.0, &with(&[PLACED, FREE, DOWNLINK])).unwrap();
        let toward = |line: Vector3<f64>| to_inertial(&flight).inverse() * line.normalize();
        let (sine, cosine) = azimuth_deg.to_radians().sin_cos();
        let beam = Vector3::new(sine, -cosine, 0.0);
        assert!((toward(earth) - beam).norm() < 1e-12, "{range_deg:?}: {}", toward(earth));
        let off_rad = toward(sun).angle(&-Vector3::y());
        let nearest_rad = (0..36_000)
            .map(|k| nalgebra::Rotation3::new(beam * (f64::from(k) * 1e-2).to_radians()) * toward(sun))
            .map(|turned| turned.angle(&-Vector3::y()))
            .fold(f64::INFINITY, f64::min);
        assert!(off_rad < nearest_rad + 1e-9 && (off_rad < 1e-7) == is_in_range, "{range_deg:?}: {off_rad}");
        assert!((flight.real("antenna.azimuth").to_degrees() - azimuth_deg).abs() < 1e-10);
        assert_eq!((flight.integer("antenna.select"), flight.boolean("link.available")), (1, true));
        assert_eq!(flight.boolean("constraint.clamped"), !is_in_range, "{range_deg:?}");
    }
}

#[test]
fn the_plant_points_a_fixed_antenna_at_the_earth_in_its_windows() {
    let named = NamedModel::<MomentumPlant>::with("dish.toml", &other(&[DISH, WINDOWS].concat()));
    let mut flight = named.initialize(0.0, &[]).unwrap();
    for hours in [3.0, 9.0] {
        flight.step_to(hours * 3600.0).unwrap();
        let (azimuth_rad, elevation_rad) = (flight.real("earth.azimuth"), flight.real("earth.elevation"));
        let (sine, cosine) = azimuth_rad.sin_cos();
        let earth =
            Vector3::new(sine, -cosine, 0.0) * elevation_rad.cos() - Vector3::z() * elevation_rad.sin();
        assert!((earth - Vector3::new(0.0, 0.6, 0.8)).norm() < 1e-9, "{hours} h: {earth}");
    }
}

#[test]
fn downlinks_and_targets_without_an_antenna_are_refused_by_name() {
    let text = other("");
    let named = NamedModel::<Guidance>::with("bare.toml", &text);
    for (sets, words) in [
        (&[("pointing.scenario", 6.0)][..], &["pointing.scenario: found downlink", "[[antennas]]"][..]),
        (
            &[("pointing.scenario", 10.0), ("guided.downlinkEvery", 2.0), ("guided.downlinkEnd", 3600.0)],
            &["guided.downlinkEvery: found 2", "[[antennas]]"],
        ),
        (
            &[("pointing.scenario", 10.0), ("guided.downlinkReference", 2.0), ("guided.downlinkEnd", 3600.0)],
            &["guided.downlinkReference: found start", "[[antennas]]"],
        ),
        (
            &[("pointing.scenario", 1.0), ("boresight.option", 4.0)],
            &["boresight.option: found phasedArray", "azimuth_deg"],
        ),
        (&[("momentum.strategy", 2.0)], &["momentum.strategy: found reactive", "[[antennas]]"]),
    ] {
        let found = named.refusal(&with(&[PLACED, sets]));
        assert!(words.iter().all(|word| found.contains(word)), "{words:?}: {found}");
    }
    // Left alone there is no downlink, and Safe Hold has an attitude.
    named.initialize(0.0, &with(&[PLACED, &[("pointing.scenario", 10.0)]])).unwrap().step_to(60.0).unwrap();
    let mut flight = named
        .initialize(0.0, &with(&[PLACED, &[("pointing.scenario", 3.0), ("mode.request", 2.0)]]))
        .unwrap();
    flight.step_to(5.0).unwrap();
    assert_eq!((flight.integer("mode.active"), flight.integer("antenna.select")), (2, 0));
    assert!(flight.real("sun.azimuth").abs() < 1e-9 && !flight.boolean("link.available"));
    let named = NamedModel::<MomentumPlant>::with("bare.toml", &text);
    let windows = named.refusal(&[("guided.downlinkEvery", 1.0), ("guided.downlinkEnd", 3600.0)]);
    assert!(
        windows.contains("guided.downlinkEvery: found 1, allowed: 0") && windows.contains("[[antennas]]"),
        "{windows}"
    );
    // Windows that never open need none.
    for every in [0.0, 1.0] {
        named.initialize(0.0, &[("guided.downlinkEvery", every)]).unwrap().step_to(86_400.0).unwrap();
    }
    let dish = NamedModel::<MomentumPlant>::with("dish.toml", &other(DISH));
    let strategy = dish.refusal(&[("momentum.strategy", 3.0)]);
    assert!(
        strategy.contains("momentum.strategy: found predictive") && strategy.contains("azimuth_deg"),
        "{strategy}"
    );
}

#[test]
fn a_gimbal_of_another_axis_follows_its_target_and_without_one_it_is_refused() {
    let named = NamedModel::<Guidance>::with("tilted.toml", &other(TILTED));
    for (requested_deg, found_deg) in [(40.0_f64, 40.0_f64), (80.0, 70.0), (-20.0, -10.0)] {
        let command = [
            ("pointing.scenario", 4.0),
            ("aimpoint.option", 12.0),
            ("boresight.angle", requested_deg.to_radians()),
        ];
        let flight = named.initialize(0.0, &with(&[PLACED, FREE, &command])).unwrap();
        assert!((flight.real("gimbal.angle").to_degrees() - found_deg).abs() < 1e-12);
        assert_eq!(flight.boolean("gimbal.inRange"), requested_deg == found_deg);
        // From +X toward -Y.
        let (sine, cosine) = found_deg.to_radians().sin_cos();
        let nadir = to_inertial(&flight).inverse() * -Vector3::new(3e6, 1e6, 2e6).normalize();
        assert!((nadir - Vector3::new(cosine, -sine, 0.0)).norm() < 1e-12, "{nadir}");
    }
    let named = NamedModel::<Guidance>::with("bare.toml", &other(""));
    for (sets, found) in [
        (&[("pointing.scenario", 4.0)][..], "pointing.scenario: found gimbal"),
        (&[("pointing.scenario", 5.0)], "pointing.scenario: found doubleTarget"),
        (&[("pointing.scenario", 1.0), ("boresight.option", 3.0)], "boresight.option: found gimbal"),
        (&[("gimbal.maximum", 0.5)], "gimbal.minimum, gimbal.maximum: found 0.0 and 0.5 rad"),
    ] {
        let text = named.refusal(&with(&[PLACED, sets]));
        assert!(text.contains(found) && text.contains("[[instruments]] gimbal"), "{text}");
    }
    let named = NamedModel::<MomentumPlant>::with(
        "fans.toml",
        &other("\n[[antennas]]\nname = \"front\"\nazimuth_deg = [-90, 0]\nbeam_deg = [4, 15]\n"),
    );
    let unload = named.refusal(&[("guided.scienceUnload", 1.0), ("momentum.strategy", 2.0)]);
    assert!(unload.contains("guided.scienceUnload: found true") && unload.contains("gimbal"), "{unload}");
}
