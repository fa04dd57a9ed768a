//! Every option against positions and angles known by other means.
use super::*;
use crate::guidance::geometry::moving::matrix_value;
use crate::guidance::scenario::scenario_tests::aimpoint as command;
use crate::guidance::tests::orbit::TestOrbit;
use approx::assert_relative_eq;
use core::f64::consts::FRAC_PI_2;
use nalgebra::Vector3;

#[test]
fn every_option_has_a_direction_and_the_points_are_where_they_are_said_to_be() {
    use AimpointOption as Option;
    let s = TestOrbit::new(12.0).ephemeris(700.0);
    let spacecraft = value(&s.position);
    let toward = |option| {
        let aimpoint = aimpoint(&command(option), &s, SubsolarMethod::Line).unwrap();
        assert!(aimpoint.reachable);
        value(&aimpoint.toward)
    };
    let c = command(Option::Vector);
    let place = |option| toward(option) + spacecraft;
    let near = |found: Vector3<f64>, expected: Vector3<f64>| {
        assert_relative_eq!(found, expected, max_relative = 1e-13, epsilon = 1e-13);
    };
    near(toward(Option::Vector), c.vector);
    let star = toward(Option::RightAscensionDeclination);
    near(Vector3::new(star.y.atan2(star.x), star.z.asin(), star.norm()), Vector3::new(1.1, -0.4, 1.0));
    let from = |option| command(option).position_m;
    let (earth, sun) = (value(&s.earth), value(&s.sun));
    assert_relative_eq!(place(Option::EarthCentered), earth + from(Option::EarthCentered), epsilon = 1e-4);
    assert_relative_eq!(place(Option::SunCentered), sun + from(Option::SunCentered), epsilon = 1e-4);
    assert_relative_eq!(place(Option::PlanetCentered), from(Option::PlanetCentered), epsilon = 1e-8);
    let to_planet = matrix_value(&s.planet.planet_from_inertial(s.epoch_s));
    assert_relative_eq!(to_planet * place(Option::PlanetFixed), from(Option::PlanetFixed), epsilon = 1e-8);
    let ground = to_planet * place(Option::LatitudeLongitude);
    assert_relative_eq!(ground.z.atan2(ground.x.hypot(ground.y)), 0.3, epsilon = 1e-14);
    assert_relative_eq!(ground.y.atan2(ground.x), -2.0, epsilon = 1e-14);
    let up = spacecraft.normalize();
    for option in [Option::LvlhDowntrack, Option::LvlhSun] {
        assert_relative_eq!(toward(option).dot(&up), (-0.6_f64).sin(), epsilon = 1e-14);
    }
    assert_relative_eq!(place(Option::Sun), value(&s.sun), epsilon = 1e-4);
    assert_relative_eq!(place(Option::Earth), value(&s.earth), epsilon = 1e-4);
    assert_relative_eq!(place(Option::Nadir), Vector3::zeros(), epsilon = 1e-8);
    assert_relative_eq!(place(Option::Subsolar).normalize(), value(&s.sun).normalize(), epsilon = 1e-14);
    assert_relative_eq!(place(Option::OptimalLighting).norm(), s.planet.radii_m.x, epsilon = 1e-8);
    assert_relative_eq!(place(Option::Body), value(&s.bodies[Body::Venus as usize].unwrap()), epsilon = 1e-4);
}

#[test]
fn an_aim_without_direction_is_none() {
    let s = TestOrbit::new(12.0).ephemeris(700.0);
    let none = |command: AimpointCommand, s: &EphemerisAtTime| {
        assert!(aimpoint(&command, s, SubsolarMethod::Normal).is_none(), "{:?}", command.option);
    };
    none(AimpointCommand::default(), &s);
    none(AimpointCommand { option: Some(AimpointOption::Vector), ..AimpointCommand::default() }, &s);
    none(
        AimpointCommand { body: Some(Body::Mars), ..command(AimpointOption::Body) },
        &EphemerisAtTime { bodies: [None; Body::COUNT], ..s },
    );
    none(AimpointCommand { vector: Vector3::repeat(f64::NAN), ..command(AimpointOption::Vector) }, &s);
    let mut flat = s;
    flat.planet.radii_m = Vector3::zeros();
    for option in [AimpointOption::Subsolar, AimpointOption::OptimalLighting] {
        none(command(option), &flat);
    }
    let without_position = EphemerisAtTime { position: MovingVector::zeros(), ..s };
    for option in [AimpointOption::Nadir, AimpointOption::LvlhSun, AimpointOption::OptimalLighting] {
        none(command(option), &without_position);
    }
}

#[test]
fn body_roll_is_minus_y_unless_commanded() {
    let roll = |option| {
        value(&body_roll(&BodyRollCommand {
            option,
            vector: Vector3::new(3.0, 1.0, 0.0),
            azimuth_rad: FRAC_PI_2,
            elevation_rad: 0.0,
        }))
    };
    assert_eq!(roll(None), -Vector3::y());
    assert_eq!(roll(Some(BodyRollOption::Vector)), Vector3::new(3.0, 1.0, 0.0));
    assert_relative_eq!(roll(Some(BodyRollOption::AzimuthElevation)), Vector3::x(), epsilon = 1e-15);
}

#[test]
fn the_external_reference_is_the_sun_unless_commanded() {
    let s = TestOrbit::new(12.0).ephemeris(60.0);
    let roll = |option| {
        let command = ExternalRollCommand {
            option,
            vector: Vector3::new(3.0, 1.0, 0.0),
            right_ascension_rad: FRAC_PI_2,
            declination_rad: 0.0,
        };
        value(&external_roll(&command, &s))
    };
    assert_eq!(roll(None), value(&s.sun) - value(&s.position));
    assert_eq!(roll(Some(ExternalRollOption::Sun)), roll(None));
    assert_eq!(roll(Some(ExternalRollOption::Earth)), value(&s.earth) - value(&s.position));
    assert_eq!(roll(Some(ExternalRollOption::Planet)), -value(&s.position));
    assert_eq!(roll(Some(ExternalRollOption::Velocity)), value(&s.velocity));
    let momentum = value(&s.position).cross(&value(&s.velocity));
    assert_eq!(roll(Some(ExternalRollOption::OrbitNormal)), momentum);
    let north = Vector3::new(0.0, -0.397_777_155_931_914, 0.917_482_062_069_182);
    assert_relative_eq!(roll(Some(ExternalRollOption::EclipticNorth)), north, epsilon = 1e-14);
    assert_eq!(roll(Some(ExternalRollOption::Vector)), Vector3::new(3.0, 1.0, 0.0));
    let star = roll(Some(ExternalRollOption::RightAscensionDeclination));
    assert_relative_eq!(star, Vector3::y(), epsilon = 1e-15);
}
