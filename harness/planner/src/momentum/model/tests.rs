//! Momentum of constant torques in closed form, what a flight corrects, what a covariance leaves.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Matrix4, Rotation3};

use super::*;
use crate::momentum::{
    as_it_is::own_windows,
    controls::{Control, Controls},
    encountered::Encountered,
    in_force::ActiveControls,
    planned::PlanProblem,
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

/// Effect of a change of velocity, in s, and a miss.
const BY_VELOCITY_S: f64 = 2e6;
const MISS_M: Vector3<f64> = Vector3::new(1e4, -2e3, 0.0);

/// Miss of a flight of ten days whose mission gives the Sun another place or attitude at a time, with the Sun left where it was: by the
/// mission's own windows, by the rows alone, and in closed form, for light is constant before and behind the jump.
fn misses_without_jump_m(jump_s: f64, jump: &dyn Fn(Controls) -> Controls) -> [Vector3<f64>; 3] {
    let (sunlit, mut task) = (sunlit([0.01, 0.02, 0.03]), task(5.0, ControlBounds::default()));
    let mut simulated = simulated(&sunlit, 10, 0.4);
    let still = task.layout.windows(&sunlit, &simulated).unwrap().0[0].controls;
    let moved = jump(still);
    let own = [(0.0, still), (jump_s, moved)];
    task.layout.own = own.map(|(at_s, controls)| ActiveControls { at_s, controls }).to_vec();
    let moved = if moved.get(Control::Alternate) > 0.0 { moved.alternate() } else { moved };
    let first = simulated.rows[0].clone();
    let before = sunlit.linearised(&first, Attitude::Downlink, &still);
    let behind = sunlit.linearised(&first, Attitude::Downlink, &moved);
    for row in &mut simulated.rows {
        let controls = if row.time_s >= jump_s { &moved } else { &still };
        row.inertial_from_body = sunlit.inertial_from_body(row, Attitude::Downlink, controls);
        let sun_body = row.inertial_from_body.inverse() * row.to_sun_m.normalize();
        let panels = sunlit.spacecraft.panels.iter().zip(&sunlit.panels);
        let offset_rad = controls.get(Control::Offset);
        row.panel_angles_rad = panels
            .map(|(panel, own)| panel.angle_for_sun_offset(&sun_body, offset_rad, own.tilt.sign))
            .collect();
        if controls.get(Control::Alternate) > 0.0 {
            let half_turn = Rotation3::from_matrix_unchecked(behind.half_turn);
            row.inertial_from_body = half_turn * row.inertial_from_body;
        }
    }
    let by_velocity = Matrix3::identity() * BY_VELOCITY_S;
    let by_velocity = [0.0, 10.0 * DAY_S].map(|at_s| (at_s, by_velocity)).to_vec();
    simulated.encountered = Some(Encountered { miss: MISS_M, by_velocity });
    let (windows, _) = task.layout.windows(&sunlit, &simulated).unwrap();
    let problem = PlanProblem { task: &task, sunlit: &sunlit, simulated: &simulated };
    let mut model = problem.model(windows);
    let target = Some(Target { tolerance: [None; 3] });
    let own = own_windows(&problem);
    let [found, by_rows] = [own, None].map(|own| {
        model.set_target(target, own);
        model.miss().unwrap()
    });
    let more_n = before.normal.force_n - behind.mean_force_n(moved.get(Control::Alternate)).0;
    let mass_kg = sunlit.current_mass_panels_stowed.mass_kg;
    [found, by_rows, MISS_M + more_n * (BY_VELOCITY_S / mass_kg * (10.0 * DAY_S - jump_s))]
}

/// By rows alone, which have what follows a jump, it counts from the middle of its cell on, or of the one before.
#[test]
fn a_jump_of_the_mission_counts_from_its_time_on() {
    let tilted = |still: Controls| still.with_place([0.1, -0.05]);
    let turned = |still: Controls| {
        let place = [(Control::AlternateAzimuth, -0.08), (Control::AlternateElevation, 0.1)];
        let controls = still.with(Control::Alternate, 1.0);
        place.into_iter().fold(controls, |all, (control, value)| all.with(control, value))
    };
    for (jump_s, early_s) in [(3.0 * DAY_S, 3600.0), (3.0 * DAY_S + 2000.0, -1600.0)] {
        for jump in [&tilted as &dyn Fn(Controls) -> Controls, &turned] {
            let [found, by_rows, expected] = misses_without_jump_m(jump_s, jump);
            let early = (expected - MISS_M) * (early_s / (10.0 * DAY_S - jump_s));
            println!("{:.3} {:.3} {:.3}", found.transpose(), by_rows.transpose(), expected.transpose());
            assert_relative_eq!(found, expected, epsilon = 1e-3);
            assert_relative_eq!(by_rows, expected + early, epsilon = 1e-3);
            assert!(early.norm() > 30.0);
        }
    }
}
