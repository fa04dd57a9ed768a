//! Coverage of six sensors, failures, shadow, and the spread of noise.

use nalgebra::Vector3;

use super::random_unit;
use crate::attitude::control::{SunSensor, sensed_sun};

/// Sensors along +X, -X, +Y, -Y, +Z, -Z with half a field of view of 60 deg, without noise.
fn six() -> [SunSensor; 6] {
    let half_field_of_view_rad = core::f64::consts::FRAC_PI_3;
    let sensor = |axis_body| SunSensor { axis_body, half_field_of_view_rad, noise_rad: 0.0 };
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    [x, -x, y, -y, z, -z].map(sensor)
}

#[test]
fn six_sensors_see_the_sun_wherever_it_is() {
    let sensors = six();
    for number in 0..2000 {
        let sun = random_unit(number);
        let found = sensed_sun(&sensors, |_| false, &sun, 1.0, (1, number)).unwrap();
        assert!((found - sun).norm() < 4e-16);
        assert_eq!(sensed_sun(&sensors, |_| true, &sun, 1.0, (1, number)), None);
        assert_eq!(sensed_sun(&sensors, |_| false, &sun, 0.0, (1, number)), None);
    }
    // Half a field of view just under that of a cube's corner leaves the corner out.
    let corner = Vector3::repeat(1.0 / 3.0_f64.sqrt());
    let corner_rad = (1.0 / 3.0_f64.sqrt()).acos();
    for (half, is_seen) in [(corner_rad + 1e-9, true), (corner_rad - 1e-9, false)] {
        let sensors = six().map(|sensor| SunSensor { half_field_of_view_rad: half, ..sensor });
        assert_eq!(sensed_sun(&sensors, |_| false, &corner, 1.0, (1, 0)).is_some(), is_seen);
    }
}

#[test]
fn only_sensors_that_see_the_sun_count() {
    let sensors = six();
    let along = |degrees: f64| {
        let angle = degrees.to_radians();
        Vector3::new(angle.cos(), angle.sin() * 0.6, angle.sin() * 0.8)
    };
    let is_seen =
        |sun: &Vector3<f64>, only: usize| sensed_sun(&sensors, |k| k != only, sun, 0.3, (1, 0)).is_some();
    assert!(is_seen(&along(59.9), 0) && !is_seen(&along(60.1), 0) && !is_seen(&along(10.0), 1));
    assert!(is_seen(&along(130.0), 1) && !is_seen(&along(20.0), 4));
}

#[test]
fn noise_spreads_as_set_and_less_where_two_sensors_see_the_sun() {
    let noise_rad = 2e-3;
    let sensors = six().map(|sensor| SunSensor { noise_rad, ..sensor });
    let draws = 20_000_u32;
    for (sun, count) in [(Vector3::new(1.0, 0.02, 0.03).normalize(), 1.0), (Vector3::new(0.6, 0.8, 0.0), 2.0)]
    {
        let mut square = 0.0;
        for sample in 0..draws {
            let found = sensed_sun(&sensors, |_| false, &sun, 1.0, (9, u64::from(sample))).unwrap();
            assert!((found.norm() - 1.0).abs() < 1e-15);
            square += (found - sun).norm_squared() / f64::from(draws);
        }
        // Two axes; the mean of `count` sensors. Four standard errors of a sum of squares of 2 draws each.
        let expected = 2.0 * noise_rad * noise_rad / count;
        assert!(
            (square / expected - 1.0).abs() < 4.0 / f64::from(draws).sqrt() + 1e-4,
            "{square} {expected}"
        );
    }
}

#[test]
fn a_sensors_noise_does_not_depend_on_the_others() {
    let sensors = six().map(|sensor| SunSensor { noise_rad: 1e-2, ..sensor });
    let sun = Vector3::new(0.6, 0.8, 0.0);
    let all = sensed_sun(&sensors, |_| false, &sun, 1.0, (3, 77)).unwrap();
    let [first, second] = [0, 2].map(|only| sensed_sun(&sensors, |k| k != only, &sun, 1.0, (3, 77)).unwrap());
    assert!((all - (first + second).normalize()).norm() < 1e-15);
    assert!((first - second).norm() > 1e-4);
}
