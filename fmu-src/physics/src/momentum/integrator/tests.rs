//! Against torques whose integrals and threshold crossings are known in closed form.
use super::*;
use crate::loads::ByEffect;
use crate::momentum::Convention;
use crate::momentum::dump::{DUMP_WINDOW_S, DumpPolicy, Reinitialise, TooManyDumps};
use crate::momentum::torque_model::{EventValues, TorqueSample, WorkKind};
use approx::assert_relative_eq;
use nalgebra::Rotation3;

/// Torque a cos(w t) about body X on a body that spins about its X axis, and a step in acceleration at 1000 s.
struct Known;

const AMPLITUDE_N_M: f64 = 1e-5;
const FREQUENCY_RAD_S: f64 = 2e-4;

impl TorqueModel for Known {
    type Failure = TooManyDumps;

    fn prepare(&mut self, start_s: f64, _: f64) -> Result<(f64, Rotation3<f64>), Self::Failure> {
        Ok((f64::INFINITY, self.inertial_from_body(start_s)))
    }

    fn sample(&mut self, time_s: f64) -> TorqueSample {
        TorqueSample {
            inertial_from_body: self.inertial_from_body(time_s),
            rate_body_rad_s: Vector3::new(1e-3, 0.0, 0.0),
            structure_body_n_m_s: None,
            torque_body_n_m: Vector3::new(AMPLITUDE_N_M * (FREQUENCY_RAD_S * time_s).cos(), 0.0, 1e-6),
            by_source_body_n_m: ByEffect::default(),
            acceleration_inertial_m_s2: Vector3::new(if time_s < 1000.0 { 1e-7 } else { 2e-7 }, 0.0, 0.0),
            events: self.events(time_s),
        }
    }

    fn inertial_from_body(&mut self, time_s: f64) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&Vector3::x_axis(), 1e-3 * time_s)
    }

    fn events(&mut self, time_s: f64) -> EventValues {
        EventValues::new(time_s - 1000.0, f64::INFINITY, f64::INFINITY, f64::INFINITY)
    }
}

fn settings(threshold_n_m_s: f64, convention: Convention) -> Settings {
    Settings {
        grid_s: 300.0,
        tolerance: 1e-10,
        convention,
        policy: DumpPolicy {
            threshold_body_n_m_s: Vector3::new(threshold_n_m_s, f64::INFINITY, f64::INFINITY),
            bias_body_n_m_s: Vector3::zeros(),
            reinitialise: Reinitialise::Opposite { fraction: 1.0 },
        },
    }
}

/// Advances until the current segment covers `time_s`, dumping where a threshold is exceeded.
fn advance(
    integrator: &mut MomentumIntegrator,
    settings: &Settings,
    time_s: f64,
    mut report: impl FnMut(&DumpEvent),
) -> Result<(), TooManyDumps> {
    let mut dumped_s = None;
    while integrator.ends_by(time_s) {
        let prepared = integrator.prepare(&mut Known, settings, f64::INFINITY)?;
        if let Some(event) = prepared.due.filter(|due| dumped_s != Some(due.time_s)) {
            Known.spend(WorkKind::Dump, event.time_s)?;
            integrator.dump(&mut Known, &event);
            integrator.dumps.check()?;
            report(&event);
            dumped_s = Some(event.time_s);
        } else {
            integrator.advance_segment(&mut Known, settings, &prepared)?;
        }
    }
    Ok(())
}

#[test]
fn totals_are_the_closed_form_integrals() {
    let mut integrator = MomentumIntegrator::new(-70.0, Totals::default());
    let setting = settings(f64::INFINITY, Convention::Inertial);
    for time_s in [-70.0, 0.0, 999.0, 1000.0, 1000.5, 5000.0, 86_400.0] {
        advance(&mut integrator, &setting, time_s, |_| {}).unwrap();
        let totals = integrator.totals(time_s);
        let sine = |t: f64| (FREQUENCY_RAD_S * t).sin() / FREQUENCY_RAD_S;
        let x = AMPLITUDE_N_M * (sine(time_s) - sine(-70.0));
        // Body Z turns to inertial (0, -sin, cos) of the spin angle.
        let y = 1e-6 * ((1e-3 * time_s).cos() - (-0.07f64).cos()) / 1e-3;
        let z = 1e-6 * ((1e-3 * time_s).sin() - (-0.07f64).sin()) / 1e-3;
        assert_relative_eq!(totals.momentum_inertial_n_m_s, Vector3::new(x, y, z), epsilon = 1e-9);
        assert_relative_eq!(
            totals.torque_integral_body_n_m_s,
            Vector3::new(x, 0.0, 1e-6 * (time_s + 70.0)),
            epsilon = 1e-9
        );
        let delta_v = 1e-7 * (time_s.min(1000.0) + 70.0) + 2e-7 * (time_s - 1000.0).max(0.0);
        assert_relative_eq!(totals.delta_v_inertial_m_s.x, delta_v, epsilon = 1e-12);
    }
}

#[test]
fn a_dump_falls_where_the_threshold_is_crossed() {
    for convention in [Convention::Inertial, Convention::BodyIntegral] {
        let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
        let mut events = Vec::new();
        advance(&mut integrator, &settings(0.02, convention), 5000.0, |event| events.push(*event)).unwrap();
        // 0.02 = (a / w) sin(w t)
        let expected_s = (0.02 * FREQUENCY_RAD_S / AMPLITUDE_N_M).asin() / FREQUENCY_RAD_S;
        assert_eq!(events.len(), 1);
        assert_relative_eq!(events[0].time_s, expected_s, epsilon = 1e-3);
        assert_relative_eq!(events[0].after_body_n_m_s.x, -0.02, epsilon = 1e-15);
        let total = integrator.totals(5000.0).torque_integral_body_n_m_s.x;
        assert_relative_eq!(total, 0.05 * 1.0f64.sin() - 0.04, epsilon = 2e-9);
    }
}

/// A body that spins about its Z axis, in a torque along inertial X or none.
struct Spinning {
    rate_rad_s: f64,
    torque_inertial_n_m: f64,
}

impl TorqueModel for Spinning {
    type Failure = TooManyDumps;

    fn prepare(&mut self, start_s: f64, _: f64) -> Result<(f64, Rotation3<f64>), Self::Failure> {
        Ok((f64::INFINITY, self.inertial_from_body(start_s)))
    }

    fn sample(&mut self, time_s: f64) -> TorqueSample {
        let inertial_from_body = self.inertial_from_body(time_s);
        let torque_body_n_m = inertial_from_body.inverse() * Vector3::x() * self.torque_inertial_n_m;
        TorqueSample {
            inertial_from_body,
            rate_body_rad_s: Vector3::z() * self.rate_rad_s,
            structure_body_n_m_s: None,
            torque_body_n_m,
            by_source_body_n_m: ByEffect::default(),
            acceleration_inertial_m_s2: Vector3::zeros(),
            events: self.events(time_s),
        }
    }

    fn inertial_from_body(&mut self, time_s: f64) -> Rotation3<f64> {
        Rotation3::from_axis_angle(&Vector3::z_axis(), self.rate_rad_s * time_s)
    }

    fn events(&mut self, _: f64) -> EventValues {
        EventValues::repeat(f64::INFINITY)
    }
}

/// The first dump of a momentum of 3.5 N m s along body X and Y each, under a threshold.
fn first_dump_s(flight: &mut Spinning, threshold_n_m_s: f64) -> f64 {
    let totals = Totals { momentum_inertial_n_m_s: Vector3::new(3.5, 3.5, 0.0), ..Totals::default() };
    let policy = DumpPolicy {
        threshold_body_n_m_s: Vector3::repeat(threshold_n_m_s),
        bias_body_n_m_s: Vector3::zeros(),
        reinitialise: Reinitialise::Opposite { fraction: 0.0 },
    };
    let setting = Settings { grid_s: 600.0, policy, ..settings(1.0, Convention::Inertial) };
    let mut integrator = MomentumIntegrator::new(0.0, totals);
    loop {
        let prepared = integrator.prepare(flight, &setting, f64::INFINITY).unwrap();
        if let Some(due) = prepared.due {
            return due.time_s;
        }
        integrator.advance_segment(flight, &setting, &prepared).unwrap();
    }
}

#[test]
fn a_momentum_that_turns_in_the_body_is_dumped_where_it_comes_to_the_threshold() {
    let size = 3.5 * 2.0_f64.sqrt();
    for rate_rad_s in [1e-3, 0.01, 0.02, 0.05, 1.0, 30.0] {
        // Toward body X: size cos(pi / 4 - rate t) = 4.
        let expected_s = (core::f64::consts::FRAC_PI_4 - (4.0 / size).acos()) / rate_rad_s;
        let found_s = first_dump_s(&mut Spinning { rate_rad_s, torque_inertial_n_m: 0.0 }, 4.0);
        assert!((found_s - expected_s).abs() < 1e-9, "{rate_rad_s} rad/s: {found_s} {expected_s}");
    }
}

/// The threshold is come to after many turns, at the first maximum of body X or Y above it.
#[test]
fn a_threshold_just_reached_after_many_turns_is_not_passed_over() {
    let torque_inertial_n_m = 1e-3;
    for rate_rad_s in [0.01, 0.02, 0.05, 1.0, 30.0] {
        // H = (3.5 + T t, 3.5): the components in the body are |H| cos and -|H| sin of an angle.
        let body = |at_s: f64| {
            let inertial = Vector3::new(3.5 + torque_inertial_n_m * at_s, 3.5, 0.0);
            let [sin, cos] = [(rate_rad_s * at_s).sin(), (rate_rad_s * at_s).cos()];
            [inertial.x * cos + inertial.y * sin, inertial.y * cos - inertial.x * sin]
        };
        let size = 3.5 * 2.0_f64.sqrt();
        let threshold = size + 0.5;
        let found_s = first_dump_s(&mut Spinning { rate_rad_s, torque_inertial_n_m }, threshold);
        let step_s = 1e-3 / rate_rad_s;
        let exceeds = |at_s: f64| body(at_s).iter().any(|h| h.abs() > threshold);
        let mut at_s = 0.0;
        while !exceeds(at_s) {
            at_s += step_s;
        }
        let (mut below_s, mut above_s) = (at_s - step_s, at_s);
        while above_s - below_s > 1e-11 {
            let middle_s = 0.5 * (above_s + below_s);
            *(if exceeds(middle_s) { &mut above_s } else { &mut below_s }) = middle_s;
        }
        assert!((found_s - above_s).abs() < 1e-9, "{rate_rad_s} rad/s: {found_s} {above_s}");
    }
}

#[test]
fn a_dump_turns_with_the_body() {
    let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
    let setting = settings(f64::INFINITY, Convention::Inertial);
    advance(&mut integrator, &setting, 500.0, |_| {}).unwrap();
    integrator.cut(500.0);
    let target = Vector3::new(0.1, -0.2, 0.3);
    let event = integrator.request(&mut Known, &setting, 500.0, target);
    integrator.dump(&mut Known, &event);
    let rotation = Known.sample(500.0).inertial_from_body;
    assert_relative_eq!(integrator.totals(500.0).momentum_inertial_n_m_s, rotation * target, epsilon = 1e-15);
    assert_eq!(integrator.dumps().count, 1);
}

#[test]
fn how_the_flight_is_cut_changes_no_bit() {
    let setting = settings(0.01, Convention::Inertial);
    let simulate = |step_s: f64| {
        let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
        let mut k = 0.0;
        while k * step_s < 50_400.0 {
            k += 1.0;
            advance(&mut integrator, &setting, k * step_s, |_| {}).unwrap();
        }
        (integrator.totals(50_400.0), *integrator.dumps())
    };
    let reference = simulate(50_400.0);
    assert!(reference.1.count > 3);
    for step_s in [7.0, 60.0, 300.0, 700.0] {
        assert_eq!(simulate(step_s), reference);
    }
}

#[test]
fn dumps_without_end_are_refused_wherever_the_steps_are_cut() {
    let policy = DumpPolicy {
        threshold_body_n_m_s: Vector3::new(2e-9, f64::INFINITY, f64::INFINITY),
        bias_body_n_m_s: Vector3::zeros(),
        reinitialise: Reinitialise::Opposite { fraction: 0.5 },
    };
    let setting = Settings { policy, ..settings(1.0, Convention::Inertial) };
    let refused = |step_s: f64| {
        let mut integrator = MomentumIntegrator::new(0.0, Totals::default());
        let mut k = 0.0;
        loop {
            k += 1.0;
            if let Err(failure) = advance(&mut integrator, &setting, k * step_s, |_| {}) {
                return failure;
            }
        }
    };
    let failure = refused(100.0);
    assert_eq!(failure, refused(0.01));
    assert!(failure.to_s - failure.from_s < DUMP_WINDOW_S, "{failure}");
}

#[test]
fn an_excess_that_is_there_from_the_start_is_dumped_at_once() {
    let totals = Totals { momentum_inertial_n_m_s: Vector3::new(3.0, 0.0, 0.0), ..Totals::default() };
    let mut integrator = MomentumIntegrator::new(0.0, totals);
    advance(&mut integrator, &settings(1.0, Convention::Inertial), 0.0, |_| {}).unwrap();
    assert_eq!(integrator.dumps().last.unwrap().time_s, 0.0);
    assert_relative_eq!(integrator.totals(0.0).momentum_inertial_n_m_s.x, -1.0, epsilon = 1e-15);
}
