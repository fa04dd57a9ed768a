//! The wheels together hold exactly what they were given, by the pyramid's closed form.
use super::*;
use approx::assert_relative_eq;

use crate::spacecraft::{MESSENGER_TOML, Spacecraft};

fn pyramid() -> Vec<Vector3<f64>> {
    let c = (1.0f64 / 3.0).sqrt();
    [(c, c), (c, -c), (-c, -c), (-c, c)].iter().map(|&(x, z)| Vector3::new(x, c, z)).collect()
}

#[test]
fn two_wheels_or_wheels_in_a_plane_hold_no_momentum_together() {
    let skew = [Vector3::new(0.36, 0.48, 0.8), Vector3::new(-0.6, 0.64, 0.48)];
    let between = (skew[0] * 0.3 + skew[1] * 0.7).normalize();
    assert!(WheelArray::new(&skew).is_none());
    assert!(WheelArray::new(&[skew[0], skew[1], between]).is_none());
    let off_the_plane = (between + skew[0].cross(&skew[1]) * 1e-3).normalize();
    assert!(WheelArray::new(&[skew[0], skew[1], off_the_plane]).is_some());
}

#[test]
fn wheels_sum_to_the_momentum() {
    let array = WheelArray::new(&pyramid()).unwrap();
    let momentum = Vector3::new(1.0, -2.0, 0.5);
    let sum: Vector3<f64> =
        pyramid().iter().enumerate().map(|(k, axis)| axis * array.momentum_n_m_s(k, &momentum)).sum();
    assert_relative_eq!(sum, momentum, epsilon = 1e-14);
}

#[test]
fn the_most_that_any_sharing_holds_is_that_of_the_closed_form() {
    // Across the normal (-2, 2, 0)/3 of two neighbours the other two reach 4 sqrt 3/9 each, and its size is 4/3.
    let held = WheelCapacity::new(&pyramid(), &[8.0; 4]).unwrap();
    assert_relative_eq!(held.box_n_m_s, 16.0 / 3.0_f64.sqrt(), max_relative = 1e-14);
    // By the smallest norm each wheel takes 3/4 of what lies along its axis, and the corner of the cube lies along one.
    assert_relative_eq!(held.least_norm_box_n_m_s, 8.0 / (0.75 * 3.0_f64.sqrt()), max_relative = 1e-14);
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()];
    let held = WheelCapacity::new(&axes, &[2.0, 3.0, 4.0]).unwrap();
    assert_eq!([held.sphere_n_m_s, held.box_n_m_s, held.least_norm_box_n_m_s], [2.0; 3]);
    // In a plane, along a line, none.
    assert_eq!(WheelCapacity::new(&axes[..2], &[2.0; 2]), None);
    assert_eq!(WheelCapacity::new(&[Vector3::x(), Vector3::x()], &[2.0; 2]), None);
    assert_eq!(WheelCapacity::new(&[], &[]), None);
}

#[test]
fn the_sphere_is_the_least_reach_over_all_directions() {
    let askew = [
        Vector3::new(0.6, 0.8, 0.0),
        Vector3::new(0.0, 0.6, 0.8),
        Vector3::z(),
        Vector3::new(0.8, 0.0, -0.6),
    ];
    let capacities = [2.0, 3.0, 1.0, 5.0];
    // Every wheel at its capacity, whichever way reaches farther along a direction.
    let reach = (0..400_000).map(|k| {
        let (z, azimuth) = (1.0 - (f64::from(k) + 0.5) / 200_000.0, 2.399_963 * f64::from(k));
        let across = (1.0 - z * z).sqrt();
        let direction = Vector3::new(across * azimuth.cos(), across * azimuth.sin(), z);
        (0..4).map(|wheel| capacities[wheel] * askew[wheel].dot(&direction).abs()).sum::<f64>()
    });
    let least = reach.fold(f64::INFINITY, f64::min);
    let held = WheelCapacity::new(&askew, &capacities).unwrap();
    // The least is a kink, and samples are 0.006 rad apart.
    assert_relative_eq!(held.sphere_n_m_s, least, max_relative = 1e-2);
    assert!(held.sphere_n_m_s <= least);
    assert!(held.box_n_m_s <= held.sphere_n_m_s && held.least_norm_box_n_m_s <= held.box_n_m_s);
}

#[test]
fn a_symmetric_pyramid_shares_equally() {
    let array = WheelArray::new(&pyramid()).unwrap();
    for wheel in 0..array.rows.len() {
        assert_relative_eq!(array.momentum_n_m_s(wheel, &Vector3::y()), 3.0f64.sqrt() / 4.0, epsilon = 1e-14);
    }
}

/// Wheels along X and (0.6, 0.8, 0): h2 = y / 0.8 and h1 = x - 0.6 h2 by the two components; two on a line take half each.
#[test]
fn wheels_in_a_plane_or_a_line_hold_what_lies_in_it() {
    let oblique = WheelArray::from_axes(&[Vector3::x(), Vector3::new(0.6, 0.8, 0.0)]);
    let momentum = Vector3::new(1.0, 2.0, 5.0);
    assert_relative_eq!(oblique.momentum_n_m_s(0, &momentum), -0.5, epsilon = 1e-14);
    assert_relative_eq!(oblique.momentum_n_m_s(1, &momentum), 2.5, epsilon = 1e-14);
    assert_eq!(oblique.spanned(), [true, true, false]);
    // |x| + 0.75 |y| and 1.25 |y| at the corner of the square.
    let threshold = oblique.spanned_threshold_n_m_s([2.0, 2.0].into_iter());
    assert_relative_eq!(threshold.x, 2.0 / 1.75, max_relative = 1e-14);
    assert_eq!((threshold.y, threshold.z), (threshold.x, f64::INFINITY));
    assert_eq!(oblique.guaranteed_threshold_n_m_s([2.0, 2.0].into_iter()), 0.0);
    let line = WheelArray::from_axes(&[Vector3::zeros(), Vector3::z(), -Vector3::z()]);
    let each = [0, 1, 2].map(|k| line.momentum_n_m_s(k, &momentum));
    assert_relative_eq!(Vector3::from(each), Vector3::new(0.0, 2.5, -2.5), epsilon = 1e-14);
    assert_eq!(line.spanned(), [false, false, true]);
    // Across a slanted line no body axis is spanned.
    let slanted = WheelArray::from_axes(&[Vector3::new(0.6, 0.0, 0.8)]);
    assert_relative_eq!(slanted.momentum_n_m_s(0, &momentum), 4.6, epsilon = 1e-14);
    assert_eq!(slanted.spanned(), [false; 3]);
    assert_eq!(WheelArray::from_axes(&[]).spanned(), [false; 3]);
}

fn shipped(text: &str) -> (Spacecraft, f64) {
    let spacecraft = Spacecraft::from_toml("shipped.toml", text).unwrap();
    let axes: Vec<Vector3<f64>> = spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect();
    let array = WheelArray::new(&axes).unwrap();
    let threshold_n_m_s =
        array.guaranteed_threshold_n_m_s(spacecraft.wheels.iter().map(|wheel| wheel.capacity_n_m_s));
    // Any corner of the cube can be held, one a little beyond cannot.
    let loads = |scale: f64| {
        let corners = (0..8_u32).map(move |corner| {
            Vector3::from_fn(|i, _| if corner >> i & 1 == 0 { scale } else { -scale } * threshold_n_m_s)
        });
        let share = |corner: Vector3<f64>| {
            let wheels = spacecraft.wheels.iter().enumerate();
            wheels
                .map(|(k, wheel)| array.momentum_n_m_s(k, &corner).abs() / wheel.capacity_n_m_s)
                .fold(0.0, f64::max)
        };
        corners.map(share).fold(0.0, f64::max)
    };
    assert!(loads(1.0 - 1e-9) <= 1.0 && loads(1.0 + 1e-9) > 1.0);
    (spacecraft, threshold_n_m_s)
}

#[test]
fn shipped_thresholds_are_guaranteed() {
    // MESSENGER's corner along a wheel's axis loads it by sqrt 3 x 3/4.
    let (spacecraft, guaranteed) = shipped(MESSENGER_TOML);
    assert_relative_eq!(guaranteed, 8.0 / (0.75 * 3.0_f64.sqrt()), max_relative = 1e-5);
    assert!(spacecraft.dump_threshold_n_m_s.unwrap().max() <= guaranteed);
    assert_eq!(spacecraft.dump_threshold_n_m_s, Some(Vector3::repeat(5.5)));
    // Three wheels along the axes hold their own capacity.
    let (spacecraft, guaranteed) = shipped(include_str!("../../../../resources/examples/solar-sailer.toml"));
    assert_relative_eq!(guaranteed, 2.0, epsilon = 1e-12);
    assert!(spacecraft.dump_threshold_n_m_s.unwrap().max() <= guaranteed);
}

#[test]
fn a_plane_of_wheels_is_no_array() {
    assert!(WheelArray::new(&[Vector3::x(), Vector3::y(), Vector3::new(0.6, 0.8, 0.0)]).is_none());
    assert!(WheelArray::new(&[]).is_none());
}
