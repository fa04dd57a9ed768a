//! Momentum of constant torques in closed form, what a flight corrects, what a covariance leaves.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Matrix4};

use super::*;
use crate::momentum::{
    controls::Control,
    test_spacecraft::{DAY_S, simulated, sunlit, task},
    torque::Attitude,
    windows::ControlBounds,
};

fn lit() -> SunlitSpacecraft {
    sunlit([0.01, 0.02, 0.03])
}

fn model(sunlit: &SunlitSpacecraft, control_bounds: ControlBounds, limit: Limit) -> Model<'_> {
    let simulated = simulated(sunlit, 10, 0.4);
    let (windows, _) = task(5.0, control_bounds).layout.windows(sunlit, &simulated).unwrap();
    Model::new(sunlit, simulated, windows, limit)
}

fn limit() -> Limit {
    task(5.0, ControlBounds::default()).limit
}

#[test]
fn a_constant_torque_is_time_times_torque() {
    let sunlit = lit();
    let model = model(&sunlit, ControlBounds::default(), limit());
    let torque = sunlit.torque_n_m(&model.simulated.rows[0], Attitude::Downlink, &model.windows[0].controls);
    let end = *model.momentum_n_m_s().last().unwrap();
    assert_relative_eq!(end, torque * (10.0 * DAY_S), max_relative = 1e-12);
    assert!(end.norm() > 0.1);
}

/// Equal parts of both attitudes leave what is along the Sun line.
#[test]
fn alternation_leaves_the_sun_line() {
    let sunlit = lit();
    let bounds = ControlBounds { alternate: 0.5, ..ControlBounds::default() };
    let mut model = model(&sunlit, bounds, limit());
    for window in &mut model.windows {
        window.controls = window.controls.with(Control::Alternate, 0.5);
    }
    model.linearise();
    let end = *model.momentum_n_m_s().last().unwrap();
    let sun = model.simulated.rows[0].to_sun_m.normalize();
    assert!(end.cross(&sun).norm() < 1e-12);
    let torque = sunlit.torque_n_m(&model.simulated.rows[0], Attitude::Downlink, &model.windows[0].controls);
    assert_relative_eq!(end.dot(&sun), torque.dot(&sun) * 10.0 * DAY_S, epsilon = 1e-9);
}

#[test]
fn a_flight_that_gains_more_is_believed() {
    let sunlit = lit();
    let mut model = model(&sunlit, ControlBounds::default(), limit());
    let more = Vector3::new(1e-6, -2e-6, 3e-6);
    let planned = model.momentum_n_m_s();
    let mut flight = model.simulated.clone();
    for (row, planned) in flight.rows.iter_mut().zip(&planned) {
        row.momentum_n_m_s = planned + more * row.time_s;
    }
    model.take(&flight, 1.0);
    for (row, found) in flight.rows.iter().zip(model.momentum_n_m_s()) {
        assert_relative_eq!(row.momentum_n_m_s, found, epsilon = 1e-12);
    }
}

/// Of the scale alone three sigma are 3 s |T| t; of the centre of mass the share across the force, 3 s |F| t at most.
#[test]
fn a_covariance_leaves_three_sigma() {
    let sunlit = lit();
    let covariance = |diagonal: [f64; 4]| {
        let covariance = Some(Matrix4::from_diagonal(&nalgebra::Vector4::from(diagonal)));
        model(&sunlit, ControlBounds::default(), Limit { covariance, ..limit() })
    };
    let of_scale = covariance([0.0, 0.0, 0.0, 0.1 * 0.1]);
    let row = &of_scale.simulated.rows[0];
    let torque = sunlit.torque_n_m(row, Attitude::Downlink, &of_scale.windows[0].controls);
    let allowed = of_scale.allowed_n_m_s();
    assert_relative_eq!(allowed[0], 5.0);
    assert_relative_eq!(*allowed.last().unwrap(), 5.0 - 0.3 * torque.norm() * 10.0 * DAY_S, epsilon = 1e-9);
    let of_center = covariance([1e-6, 1e-6, 1e-6, 0.0]);
    // F by the torque of a centre of mass moved across it.
    let moved = |axis: usize| {
        let mut other = sunlit.clone();
        other.current_mass_panels_stowed.center_of_mass_body_m[axis] += 1.0;
        let at = |sunlit: &SunlitSpacecraft| {
            sunlit.torque_n_m(
                &of_center.simulated.rows[0],
                Attitude::Downlink,
                &of_center.windows[0].controls,
            )
        };
        at(&other) - at(&sunlit)
    };
    let columns = Matrix3::from_columns(&[moved(0), moved(1), moved(2)]);
    let force = columns.singular_values().max();
    let left = 5.0 - of_center.allowed_n_m_s().last().unwrap();
    assert_relative_eq!(left, 3e-3 * force * 10.0 * DAY_S, max_relative = 1e-6);
}
