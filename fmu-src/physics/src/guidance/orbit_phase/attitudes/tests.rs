//! What the paper demands of each attitude: where the Sun, the planet and the Earth stand in the body frame.
use super::*;
use crate::guidance::scenario::scenario_tests::camera;
use approx::assert_relative_eq;

const LIMIT_RAD: f64 = 13.0 * std::f64::consts::PI / 180.0;

fn unit(x: f64, y: f64, z: f64) -> MovingUnit {
    MovingUnit::from_vector(Vector3::new(x, y, z), Vector3::new(0.1 * y, -0.2 * z, 0.3 * x)).unwrap()
}

fn many() -> impl Iterator<Item = LinesOfSight> {
    (0..200).map(|i| {
        let t = f64::from(i) * 0.37;
        LinesOfSight {
            sun: unit(t.cos(), t.sin(), 0.4 * (2.0 * t).sin()),
            planet: Some(unit((3.0 * t).sin(), 0.7, (1.7 * t).cos())),
            earth: unit((0.9 * t).cos(), (1.3 * t).sin(), 0.2),
            sun_from_planet: Some(CartesianState {
                position_m: Vector3::new(t.cos(), t.sin(), 0.1 * t.sin()) * 5e10,
                velocity_m_s: Vector3::new(-t.sin(), t.cos(), 0.1 * t.cos()) * 4e4,
            }),
        }
    })
}

fn in_body(requested: &AttitudeCommand, unit: &MovingUnit) -> Vector3<f64> {
    requested.frame.inertial_from_body.inverse() * unit.direction
}

/// Science by directions alone, or the fallback.
fn science(lines: &LinesOfSight, rule: ScienceRule, limit_rad: f64) -> AttitudeCommand {
    super::science(lines, || None, rule, limit_rad).unwrap_or_else(|| sun_pointing(lines))
}

/// The default downlink, or the fallback.
fn downlink(lines: &LinesOfSight, law: &DefaultDownlink) -> AttitudeCommand {
    super::downlink(lines, law).unwrap_or_else(|| sun_pointing(lines))
}

#[test]
fn a_downlink_off_the_sun_has_sun_and_earth_where_they_are_requested() {
    let mut checked = 0;
    for (i, lines) in many().enumerate() {
        let k = i as f64;
        let angles = SunAngles { azimuth_rad: 0.26 * (0.7 * k).sin(), elevation_rad: 0.22 * (1.3 * k).cos() };
        let theta_rad = angle_between_rad(&lines.sun.direction, &lines.earth.direction);
        if angles.elevation_rad.abs() > theta_rad.min(std::f64::consts::PI - theta_rad) - 1e-3 {
            continue;
        }
        checked += 1;
        for earth_ahead in [false, true] {
            let frame = downlink_toward(&lines, &DownlinkSunDirection { angles, earth_ahead }).unwrap().frame;
            let body = |direction: &Vector3<f64>| frame.inertial_from_body.inverse() * direction;
            let sun = SunAngles::from_direction(&body(&lines.sun.direction));
            let earth = body(&lines.earth.direction);
            assert_relative_eq!(sun.azimuth_rad, angles.azimuth_rad, epsilon = 1e-12);
            assert_relative_eq!(sun.elevation_rad, angles.elevation_rad, epsilon = 1e-12);
            assert_relative_eq!(earth.z, 0.0, epsilon = 1e-12);
            // Ahead of the Sun's azimuth about -Z, by less than half a turn.
            let ahead = (SunAngles::from_direction(&earth).azimuth_rad - sun.azimuth_rad).sin();
            assert!(theta_rad > 3.0 || (ahead > 0.0) == earth_ahead, "{ahead} {earth_ahead}");
        }
    }
    assert!(checked > 100, "{checked}");
}

#[test]
fn nadir_rule_points_z_at_the_planet_inside_the_zone() {
    let mut free = 0;
    for lines in many() {
        let requested = science(&lines, ScienceRule::Nadir, LIMIT_RAD);
        let sun = SunAngles::from_direction(&in_body(&requested, &lines.sun));
        let planet = in_body(&requested, lines.planet.as_ref().unwrap());
        assert_relative_eq!(sun.azimuth_rad, 0.0, epsilon = 1e-12);
        assert!(sun.elevation_rad.abs() <= LIMIT_RAD + 1e-12);
        assert!(planet.z > 0.0, "the instruments are on the planet's side");
        assert_relative_eq!(planet.x, 0.0, epsilon = 1e-12);
        if requested.margins.iter().all(|margin| *margin >= 0.0) {
            free += 1;
            assert_relative_eq!(planet.z, 1.0, epsilon = 1e-12);
        }
    }
    assert!(free > 10);
}

#[test]
fn scaled_rule_shows_the_sun_at_a_quarter_of_the_angle() {
    for lines in many() {
        let requested = science(&lines, ScienceRule::Scaled { gain: 0.25 }, LIMIT_RAD);
        let angle_rad = lines.sun.direction.angle(&lines.planet.unwrap().direction);
        let expected = (0.25 * (angle_rad - std::f64::consts::FRAC_PI_2)).clamp(-LIMIT_RAD, LIMIT_RAD);
        let sun = SunAngles::from_direction(&in_body(&requested, &lines.sun));
        assert_relative_eq!(sun.elevation_rad, expected, epsilon = 1e-12);
    }
}

#[test]
fn unloading_has_the_sun_in_its_place_and_the_camera_as_near_to_nadir_as_it_comes() {
    let gimbal = camera();
    let (mut kept, mut at_bound) = (0, 0);
    for (i, lines) in many().enumerate() {
        let k = i as f64;
        let sun = SunAngles { azimuth_rad: 0.26 * (0.7 * k).sin(), elevation_rad: 0.22 * (1.3 * k).cos() };
        let requested = science(&lines, ScienceRule::Unloading { sun, gimbal }, 0.0);
        let found = SunAngles::from_direction(&in_body(&requested, &lines.sun));
        assert_relative_eq!(found.azimuth_rad, sun.azimuth_rad, epsilon = 1e-12);
        assert_relative_eq!(found.elevation_rad, sun.elevation_rad, epsilon = 1e-12);
        let planet = in_body(&requested, lines.planet.as_ref().unwrap());
        let angle = gimbal.toward(&planet);
        let off_rad = angle_between_rad(&gimbal.boresight(angle.angle_rad), &planet);
        assert_eq!(angle.in_range, requested.margins.iter().all(|margin| *margin > 0.0));
        if angle.in_range {
            kept += 1;
            assert_relative_eq!(planet.x, 0.0, epsilon = 1e-12);
            assert!(off_rad < 1e-12 && planet.z > 0.0, "{off_rad:e}");
            continue;
        }
        at_bound += 1;
        // No turn about the Sun line and no angle of the camera comes nearer.
        let axis = nalgebra::Unit::new_normalize(in_body(&requested, &lines.sun));
        for turn in -90..90 {
            let turned = nalgebra::Rotation3::from_axis_angle(&axis, 0.035 * f64::from(turn)) * planet;
            for degree in -50..=40 {
                let look = gimbal.boresight(f64::from(degree).to_radians());
                assert!(angle_between_rad(&look, &turned) > off_rad - 1e-9, "{i}: {off_rad}");
            }
        }
    }
    assert!(kept > 50 && at_bound > 20, "{kept} {at_bound}");
}

#[test]
fn paper_004_shows_the_sun_on_minus_y_and_north_on_minus_z() {
    for lines in many() {
        let sun = lines.sun_from_planet.unwrap();
        let to_body = science(&lines, ScienceRule::PlanetOrbit, 0.0).frame.inertial_from_body.inverse();
        assert_relative_eq!(to_body * sun.position_m.normalize(), -Vector3::y(), epsilon = 1e-12);
        // Seen from the planet the Sun moves toward north x Sun, which is -Z x -Y = -X.
        let velocity = to_body * sun.velocity_m_s.normalize();
        assert!(velocity.x < -0.99 && velocity.z.abs() < 1e-12, "{velocity}");
    }
}

#[test]
fn downlink_puts_the_earth_in_an_antenna_quadrant() {
    for lines in many() {
        let requested = downlink(&lines, &DefaultDownlink::default());
        assert_relative_eq!(in_body(&requested, &lines.sun), -Vector3::y(), epsilon = 1e-12);
        let earth = in_body(&requested, &lines.earth);
        assert_relative_eq!(earth.z, 0.0, epsilon = 1e-12);
        let behind = lines.sun.direction.dot(&lines.earth.direction) <= 0.0;
        if behind {
            assert!(earth.x > 0.0 && earth.y >= 0.0);
        } else {
            assert!(earth.x < 0.0 && earth.y < 0.0);
        }
    }
}

#[test]
fn every_law_gives_a_proper_rotation_even_when_degenerate() {
    let mut all: Vec<AttitudeCommand> = Vec::new();
    for lines in many() {
        all.push(science(&lines, ScienceRule::Nadir, LIMIT_RAD));
        all.push(downlink(&lines, &DefaultDownlink::default()));
        let blind = LinesOfSight {
            planet: Some(lines.sun),
            earth: lines.sun,
            sun_from_planet: Some(CartesianState::default()),
            ..lines
        };
        all.push(science(&blind, ScienceRule::Nadir, LIMIT_RAD));
        all.push(science(&blind, ScienceRule::PlanetOrbit, LIMIT_RAD));
        let sun = SunAngles { azimuth_rad: 0.2, elevation_rad: -0.1 };
        let unloading = ScienceRule::Unloading { sun, gimbal: camera() };
        all.push(science(&blind, unloading, LIMIT_RAD));
        all.push(science(&LinesOfSight { planet: None, ..lines }, unloading, LIMIT_RAD));
        all.push(downlink(&blind, &DefaultDownlink::default()));
    }
    let pole = MovingUnit { direction: Vector3::z(), rate_1_s: Vector3::zeros() };
    all.push(sun_pointing(&LinesOfSight { sun: pole, planet: None, earth: pole, sun_from_planet: None }));
    for requested in all {
        let matrix = requested.frame.inertial_from_body.matrix();
        assert_relative_eq!(matrix.determinant(), 1.0, epsilon = 1e-12);
        assert_relative_eq!(matrix * matrix.transpose(), nalgebra::Matrix3::identity(), epsilon = 1e-12);
    }
}

#[test]
fn the_default_downlink_is_that_of_the_scenario_with_any_antennas() {
    use crate::guidance::downlink::sun_direction::{DownlinkRequest, downlink as by_scenario};
    use crate::guidance::pointing::antenna::tests::{antennas, fan, fixed_along, quadrants};
    use crate::guidance::tests::geometry::Random;
    let mut random = Random(27);
    for _ in 0..200 {
        let axis = fixed_along(random.direction());
        let from_deg = random.within(-180.0, 180.0);
        for all in [
            quadrants(),
            antennas(&[axis]),
            antennas(&[fan(from_deg, from_deg + 60.0)]),
            antennas(&[fan(from_deg, from_deg + 30.0), axis]),
        ] {
            let law = DefaultDownlink::new(&all);
            for lines in many().take(20) {
                let found = downlink(&lines, &law);
                let [to_sun, to_earth] =
                    [&lines.sun, &lines.earth].map(|to| moving(to.direction, to.rate_1_s));
                let expected = by_scenario(&to_sun, &to_earth, &all, &DownlinkRequest::default()).unwrap();
                let expected = expected.vectors.pointing().unwrap().frame();
                let (found, expected_axes) = (found.frame, expected.inertial_from_body);
                let off = (found.inertial_from_body.matrix() - expected_axes.matrix()).amax();
                assert!(off < 1e-12, "{off:e} {all:?}");
                let rate_off = (found.rate_body_rad_s - expected.rate_body_rad_s).amax();
                assert!(rate_off < 1e-9 * (1.0 + expected.rate_body_rad_s.amax()), "{rate_off:e} {all:?}");
            }
        }
    }
}
