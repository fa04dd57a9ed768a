//! What a degree is worth against the published numbers, derivatives against the physics at other values.

use approx::assert_relative_eq;

use super::*;
use crate::momentum::test_spacecraft::{DAY_S, row, sunlit};

const DEG: f64 = core::f64::consts::PI / 180.0;

/// Torque by a control in the body frame, in N m s a day and deg, at 0.35 AU.
fn worth(offset_deg: f64, control: Control) -> Vector3<f64> {
    let sunlit = sunlit([0.0; 3]);
    let row = row(&sunlit, 0.0, 0.35, 0.3);
    let controls = Controls::default().with(Control::Offset, offset_deg * DEG);
    let linear = sunlit.linearised(&row, Attitude::Downlink, &controls);
    row.inertial_from_body.inverse() * linear.normal.by_angle[control as usize] * (DAY_S * DEG)
}

/// Paper 003's authority at 0.35 AU and 1358 W/m2.
#[test]
fn a_degree_is_worth_what_was_published() {
    for (offset_deg, worth_y) in [(0.0, -0.691), (30.0, -0.158), (50.0, 0.328), (60.0, 0.428)] {
        assert_relative_eq!(worth(offset_deg, Control::Windmill).y, worth_y, max_relative = 0.01);
    }
    assert!(worth(35.6, Control::Windmill).y.abs() < 2e-3);
    // The attitude turns under the Sun: the torque that comes with a tilt is what counts, about X and Z.
    assert_relative_eq!(worth(0.0, Control::Elevation).x.abs(), 0.176, max_relative = 0.15);
    assert_relative_eq!(worth(0.0, Control::Azimuth).z.abs(), 0.101, max_relative = 0.15);
}

#[test]
fn a_centimetre_is_worth_its_torque() {
    let at = |center: [f64; 3]| {
        let sunlit = sunlit(center);
        let row = row(&sunlit, 0.0, 0.35, 0.3);
        let controls = Controls::default().with(Control::Offset, 60.0 * DEG);
        sunlit.linearised(&row, Attitude::Downlink, &controls)
    };
    let here = at([0.01, 0.02, 0.03]);
    for axis in 0..3 {
        let mut moved = [0.01, 0.02, 0.03];
        moved[axis] += 0.01;
        let change = (at(moved).normal.torque - here.normal.torque) / 0.01;
        assert_relative_eq!(change, here.normal.by_center.column(axis).into_owned(), epsilon = 1e-12);
    }
}

/// Against the torque of the attitude that is really turned.
#[test]
fn the_alternate_attitude_is_a_half_turn() {
    let sunlit = sunlit([0.01, 0.02, 0.03]);
    let mut row = row(&sunlit, 0.0, 0.4, 0.3);
    let controls = Controls([60.0 * DEG, 1.0 * DEG, 2.0 * DEG, -3.0 * DEG, 0.0, -4.0 * DEG, 1.0 * DEG]);
    let linear = sunlit.linearised(&row, Attitude::Downlink, &controls);
    let attitude = sunlit.downlink_attitude(&row, 2.0 * DEG, -3.0 * DEG).unwrap();
    let about = nalgebra::Unit::new_normalize(row.to_sun_m);
    row.inertial_from_body = Rotation3::from_axis_angle(&about, core::f64::consts::PI) * attitude;
    let turned = sunlit.torque_n_m(&row, Attitude::SimulatedFlight, &controls);
    assert_relative_eq!(linear.half_turn * linear.normal.torque, turned, epsilon = 1e-14);
    // In equal parts nothing is left across the Sun line.
    let (mean, _) = linear.mean(0.5);
    assert!(mean.cross(&about).norm() < 1e-12 * linear.normal.torque.norm());
    let (_, by) = linear.mean(0.2);
    let difference = (linear.mean(0.3).0 - linear.mean(0.2).0) / 0.1;
    assert_relative_eq!(by[Control::Alternate as usize], difference, epsilon = 1e-12);
    // With a place of its own.
    let attitude = sunlit.downlink_attitude(&row, -4.0 * DEG, 1.0 * DEG).unwrap();
    row.inertial_from_body = Rotation3::from_axis_angle(&about, core::f64::consts::PI) * attitude;
    let own = sunlit.torque_n_m(&row, Attitude::SimulatedFlight, &controls);
    let apart = sunlit.linearised_apart(&row, &controls);
    assert_relative_eq!(apart.mean(1.0).0, own, epsilon = 1e-14);
    assert_relative_eq!(apart.mean(0.3).0, linear.normal.torque * 0.7 + own * 0.3, epsilon = 1e-14);
}
