//! The controller on a rigid body with wheels that fourth-order Runge-Kutta integrates.

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Vector3, Vector4};

use super::{random_attitude, random_unit};
use crate::attitude::Attitude;
use crate::attitude::control::{ControlTarget, ControllerSettings, ControllerState, Estimate, GainError};

const DT_S: f64 = 0.02;

fn settings() -> ControllerSettings {
    ControllerSettings {
        rate_hz: 50.0,
        bandwidth_rad_s: 0.1,
        damping: 0.8,
        integral: 0.1,
        slew_rate_rad_s: 8e-3,
        slew_acceleration_rad_s2: 1e-4,
    }
}

fn inertia() -> Matrix3<f64> {
    Matrix3::new(430.0, 12.0, -8.0, 12.0, 320.0, 5.0, -8.0, 5.0, 510.0)
}

/// A rigid body whose wheels exert a torque: J w' = T + external - w x (J w + h), h' = -T.
struct Body {
    inertia: Matrix3<f64>,
    /// Hamilton's quaternion, inertial from body, scalar last.
    q: Vector4<f64>,
    rate: Vector3<f64>,
    wheels: Vector3<f64>,
    external: Vector3<f64>,
}

impl Body {
    fn new(attitude: &Attitude, rate: Vector3<f64>) -> Self {
        let q = Vector4::from(attitude.quaternion(None));
        let wheels = Vector3::new(2.0, -5.0, 3.0);
        Self { inertia: inertia(), q, rate, wheels, external: Vector3::zeros() }
    }

    fn attitude(&self) -> Attitude {
        Attitude::from_quaternion(self.q.into()).unwrap()
    }

    fn estimate(&self) -> Estimate {
        Estimate { attitude: self.attitude(), is_valid: true, rate_body_rad_s: Some(self.rate) }
    }

    fn slopes(
        &self,
        q: &Vector4<f64>,
        rate: &Vector3<f64>,
        wheels: &Vector3<f64>,
        torque: &Vector3<f64>,
    ) -> (Vector4<f64>, Vector3<f64>, Vector3<f64>) {
        let v = q.xyz();
        let vector = rate * q.w + v.cross(rate);
        let q_slope = Vector4::new(vector.x, vector.y, vector.z, -v.dot(rate)) * 0.5;
        let momentum = self.inertia * rate + wheels;
        let sum = torque + self.external - rate.cross(&momentum);
        (q_slope, self.inertia.try_inverse().unwrap() * sum, -torque)
    }

    fn go_on(&mut self, torque: &Vector3<f64>) {
        let h = DT_S;
        let (q, w, m) = (self.q, self.rate, self.wheels);
        let k1 = self.slopes(&q, &w, &m, torque);
        let k2 =
            self.slopes(&(q + k1.0 * (h / 2.0)), &(w + k1.1 * (h / 2.0)), &(m + k1.2 * (h / 2.0)), torque);
        let k3 =
            self.slopes(&(q + k2.0 * (h / 2.0)), &(w + k2.1 * (h / 2.0)), &(m + k2.2 * (h / 2.0)), torque);
        let k4 = self.slopes(&(q + k3.0 * h), &(w + k3.1 * h), &(m + k3.2 * h), torque);
        self.q = (q + (k1.0 + k2.0 * 2.0 + k3.0 * 2.0 + k4.0) * (h / 6.0)).normalize();
        self.rate = w + (k1.1 + k2.1 * 2.0 + k3.1 * 2.0 + k4.1) * (h / 6.0);
        self.wheels = m + (k1.2 + k2.2 * 2.0 + k3.2 * 2.0 + k4.2) * (h / 6.0);
    }
}

/// One spacecraft with its controller, in a loop.
struct Loop {
    body: Body,
    state: ControllerState,
    settings: ControllerSettings,
    target: ControlTarget,
}

impl Loop {
    fn new(settings: ControllerSettings, start: Attitude, target: ControlTarget) -> Self {
        let state = ControllerState::new(start, Vector3::zeros());
        Self { body: Body::new(&start, Vector3::zeros()), state, settings, target }
    }

    fn sample(&mut self) -> Vector3<f64> {
        self.sample_with(&self.body.estimate(), &Vector3::zeros())
    }

    fn sample_with(&mut self, estimate: &Estimate, external: &Vector3<f64>) -> Vector3<f64> {
        let (body, settings) = (&self.body, &self.settings);
        let torque =
            self.state.sample(settings, &body.inertia, &self.target, estimate, &body.wheels, external);
        assert!(self.state.is_sound());
        torque
    }

    fn fly(&mut self, duration_s: f64) {
        for _ in 0..(duration_s / DT_S).round() as u64 {
            let torque = self.sample();
            self.body.go_on(&torque);
        }
    }

    fn error_to(&self, attitude: &Attitude) -> f64 {
        attitude.rotation_vector_to(&self.body.attitude()).norm()
    }
}

fn hold(attitude: Attitude) -> ControlTarget {
    ControlTarget::Attitude { attitude, rate_body_rad_s: Vector3::zeros() }
}

#[test]
fn a_slew_of_60_deg_settles_without_overshoot() {
    let (start, axis) = (random_attitude(1), random_unit(2));
    let end = start.turned(axis * 60.0_f64.to_radians());
    let mut flight = Loop::new(settings(), start, hold(end));
    let (mut settled_s, mut overshoot, mut torque_n_m): (Option<f64>, f64, f64) = (None, 0.0, 0.0);
    for sample in 0..20_000_u32 {
        let torque = flight.sample();
        torque_n_m = torque_n_m.max(torque.norm());
        flight.body.go_on(&torque);
        overshoot = overshoot.max(end.rotation_vector_to(&flight.body.attitude()).dot(&axis));
        if flight.state.is_settled() && settled_s.is_none() {
            settled_s = Some(f64::from(sample) * DT_S);
        }
        if settled_s.is_some() {
            assert!(flight.state.attitude_error_rad() < 5e-9, "{}", flight.state.attitude_error_rad());
        }
    }
    // Trapezoid: angle over rate plus rate over acceleration; torque: acceleration, and rate x momentum.
    let trapezoid_s = 60.0_f64.to_radians() / 8e-3 + 80.0;
    assert!((settled_s.unwrap() - trapezoid_s).abs() < 2.0, "{settled_s:?} {trapezoid_s}");
    assert!(overshoot < 1e-7, "{overshoot}");
    assert!(torque_n_m < 515.0 * 1e-4 + 8e-3 * 11.0, "{torque_n_m}");
    assert!(flight.error_to(&end) < 3e-10, "{}", flight.error_to(&end));
    assert!(flight.body.rate.norm() < 1e-11);
}

#[test]
fn a_turning_command_is_followed_without_lag() {
    let (start, rate) = (random_attitude(3), Vector3::new(1e-3, -6e-4, 8e-4));
    let end = start.turned(Vector3::new(0.2, 0.5, -0.1));
    let mut flight = Loop::new(settings(), start, hold(end));
    for sample in 0..15_000_u32 {
        let attitude = end.propagated(rate, f64::from(sample) * DT_S);
        flight.target = ControlTarget::Attitude { attitude, rate_body_rad_s: rate };
        flight.fly(DT_S);
        if sample > 12_000 {
            assert!(flight.state.is_settled());
            assert!(flight.state.attitude_error_rad() < 1e-9, "{}", flight.state.attitude_error_rad());
        }
    }
}

#[test]
fn a_small_step_without_limits_answers_as_the_continuous_loop() {
    // theta'' + 2 d w theta' + w^2 theta = 0 from theta0; sampling at 50 Hz delays by half a sample, w dt / 2.
    let unlimited = ControllerSettings {
        integral: 0.0,
        slew_rate_rad_s: 0.0,
        slew_acceleration_rad_s2: 0.0,
        ..settings()
    };
    let (start, axis, angle) = (random_attitude(5), random_unit(6), 1e-3);
    let end = start.turned(axis * angle);
    let mut flight = Loop::new(unlimited, start, hold(end));
    let (w, d) = (unlimited.bandwidth_rad_s, unlimited.damping);
    let damped = w * (1.0 - d * d).sqrt();
    for second in 1..100 {
        flight.fly(1.0);
        let t = f64::from(second);
        let expected =
            angle * (-d * w * t).exp() * ((damped * t).cos() + d * w / damped * (damped * t).sin());
        let found = -end.rotation_vector_to(&flight.body.attitude()).dot(&axis);
        assert!((found - expected).abs() < angle * w * DT_S, "{t}: {found} {expected}");
    }
}

#[test]
fn a_constant_disturbance_leaves_an_error_without_the_integral_and_none_with_it() {
    let attitude = random_attitude(7);
    let torque = Vector3::new(2e-3, -1e-3, 3e-3);
    for integral in [0.0, 0.1, 0.3] {
        let mut flight = Loop::new(ControllerSettings { integral, ..settings() }, attitude, hold(attitude));
        flight.body.external = torque;
        flight.fly(600.0);
        let first = flight.error_to(&attitude);
        flight.fly(1400.0);
        let found = attitude.rotation_vector_to(&flight.body.attitude());
        if integral == 0.0 {
            let expected = inertia().try_inverse().unwrap() * torque / 0.01;
            assert_relative_eq!(found, expected, max_relative = 1e-4);
        } else {
            // exp(-c w t) of the slowest pole.
            assert!(found.norm() < 3.0 * (-integral * 0.1 * 1400.0).exp() * first + 1e-13, "{found} {first}");
        }
    }
}

#[test]
fn a_known_torque_is_fed_forward() {
    let attitude = random_attitude(8);
    let mut flight = Loop::new(settings(), attitude, hold(attitude));
    flight.body.external = Vector3::new(0.05, -0.02, 0.03);
    for _ in 0..5000 {
        let torque = flight.sample_with(&flight.body.estimate(), &flight.body.external.clone());
        flight.body.go_on(&torque);
    }
    assert!(flight.error_to(&attitude) < 1e-10, "{}", flight.error_to(&attitude));
}

#[test]
fn at_the_bound_of_stability_the_loop_turns_from_decay_to_growth() {
    for (damping, integral) in [(0.3, 0.0), (0.7, 0.0), (0.7, 0.1), (1.2, 0.5)] {
        let with = |bandwidth_rad_s| ControllerSettings {
            bandwidth_rad_s,
            damping,
            integral,
            slew_rate_rad_s: 0.0,
            slew_acceleration_rad_s2: 0.0,
            ..settings()
        };
        let Err(GainError::Unstable { allowed_rad_s, .. }) = with(1e3).check() else { panic!("{damping}") };
        for (factor, is_stable) in [(0.98, true), (1.02, false)] {
            let tried = with(allowed_rad_s * factor);
            assert_eq!(tried.check().is_ok(), is_stable);
            let (start, angle) = (Attitude::default(), 1e-9);
            let mut flight = Loop::new(tried, start, hold(start.turned(Vector3::x() * angle)));
            // A body without coupling of its axes.
            flight.body.inertia = Matrix3::from_diagonal(&Vector3::new(400.0, 300.0, 500.0));
            flight.body.wheels = Vector3::zeros();
            flight.fly(40.0);
            let error = flight.state.attitude_error_rad();
            if is_stable {
                assert!(error < 1e-3 * angle, "{tried:?} {error}");
            } else {
                assert!(error > 1e3 * angle, "{tried:?} {error}");
            }
        }
    }
}

#[test]
fn torque_that_is_missing_winds_nothing_up() {
    // A disturbance above what the wheels can give, for a minute; then it ends.
    let attitude = random_attitude(9);
    let slow = ControllerSettings { slew_acceleration_rad_s2: 2e-5, ..settings() };
    let mut flight = Loop::new(slow, attitude, hold(attitude));
    flight.body.wheels = Vector3::zeros();
    let greatest_n_m = 0.02;
    let direction = random_unit(10);
    let (mut overshoot, mut most): (f64, f64) = (0.0, 0.0);
    for sample in 0..40_000_u32 {
        flight.body.external = if sample < 3000 { direction * 0.04 } else { Vector3::zeros() };
        let mut torque = flight.sample();
        if torque.norm() > greatest_n_m {
            torque *= greatest_n_m / torque.norm();
            flight.state.limited(&torque);
        }
        flight.body.go_on(&torque);
        let along = attitude.rotation_vector_to(&flight.body.attitude()).dot(&direction);
        overshoot = overshoot.max(-along);
        most = most.max(along);
    }
    assert!(most > 0.05, "{most}");
    assert!(overshoot < 0.15 * most, "{overshoot} {most}");
    assert!(flight.error_to(&attitude) < 1e-6, "{}", flight.error_to(&attitude));
}

#[test]
fn a_rate_alone_is_reached_and_held_against_a_disturbance() {
    let (start, rate) = (random_attitude(11), Vector3::new(3e-3, -1e-3, 2e-3));
    let mut flight = Loop::new(settings(), start, ControlTarget::RateOnly { rate_body_rad_s: rate });
    flight.body.external = Vector3::new(1e-3, 2e-3, -1e-3);
    let mut jump = Attitude::default();
    for sample in 0..50_000_u32 {
        // The attitude is not known in EME2000 and may jump: it must not matter.
        if sample % 1000 == 0 {
            jump = random_attitude(u64::from(sample));
        }
        let estimate = Estimate {
            attitude: jump.then(&flight.body.attitude()),
            is_valid: false,
            ..flight.body.estimate()
        };
        let torque = flight.sample_with(&estimate, &Vector3::zeros());
        assert!(torque.norm() < 0.12, "{torque}");
        flight.body.go_on(&torque);
    }
    assert!((flight.body.rate - rate).norm() < 1e-8, "{}", flight.body.rate - rate);
    assert!(flight.state.is_settled());
    // An attitude is then taken up from where the body is.
    let end = flight.body.attitude().turned(Vector3::new(0.3, 0.1, -0.2));
    flight.target = hold(end);
    flight.body.external = Vector3::zeros();
    for _ in 0..60_000 {
        let torque = flight.sample();
        assert!(torque.norm() < 0.15, "{torque}");
        flight.body.go_on(&torque);
    }
    assert!(flight.error_to(&end) < 1e-6);
}

#[test]
fn without_a_rate_there_is_no_torque_and_control_is_taken_up_again() {
    let attitude = random_attitude(12);
    let mut flight = Loop::new(settings(), attitude, hold(attitude));
    flight.body.external = Vector3::new(2e-3, 0.0, -1e-3);
    flight.fly(1000.0);
    for _ in 0..3000 {
        let estimate = Estimate { rate_body_rad_s: None, is_valid: false, ..flight.body.estimate() };
        let torque = flight.sample_with(&estimate, &Vector3::zeros());
        assert_eq!(torque, Vector3::zeros());
        flight.body.go_on(&torque);
    }
    assert!(flight.error_to(&attitude) > 1e-3);
    for _ in 0..60_000 {
        let torque = flight.sample();
        assert!(torque.norm() < 0.1, "{torque}");
        flight.body.go_on(&torque);
    }
    assert!(flight.error_to(&attitude) < 1e-7, "{}", flight.error_to(&attitude));
}

#[test]
fn a_regained_attitude_that_jumps_is_slewed_to_within_the_limits() {
    let attitude = random_attitude(13);
    let mut flight = Loop::new(settings(), attitude, hold(attitude));
    let drift = Attitude::default().turned(Vector3::new(0.05, -0.1, 0.02));
    for sample in 0..20_000_u32 {
        let is_valid = sample > 2000;
        let mut estimate = Estimate { is_valid, ..flight.body.estimate() };
        if !is_valid {
            estimate.attitude = drift.then(&estimate.attitude);
        }
        let torque = flight.sample_with(&estimate, &Vector3::zeros());
        assert!(torque.norm() < 0.15, "{sample} {torque}");
        flight.body.go_on(&torque);
    }
    assert!(flight.error_to(&attitude) < 1e-7);
}

#[test]
fn the_signs_of_quaternions_do_not_matter() {
    let (start, end) = (random_attitude(14), random_attitude(15));
    let minus =
        |attitude: &Attitude| Attitude::from_quaternion(attitude.quaternion(None).map(|x| -x)).unwrap();
    let torques = |target: Attitude, flip: bool| {
        let mut flight = Loop::new(settings(), start, hold(target));
        let mut torques = Vec::new();
        for sample in 0..3000 {
            let mut estimate = flight.body.estimate();
            if flip && sample % 2 == 0 {
                estimate.attitude = minus(&estimate.attitude);
            }
            let torque = flight.sample_with(&estimate, &Vector3::zeros());
            flight.body.go_on(&torque);
            torques.push(torque);
        }
        torques
    };
    let (first, second) = (torques(end, false), torques(minus(&end), true));
    for (a, b) in first.iter().zip(&second) {
        assert!((a - b).norm() < 1e-12, "{a} {b}");
    }
}

#[test]
fn a_restored_controller_goes_on_to_the_bit() {
    let (start, end) = (random_attitude(16), random_attitude(17));
    let mut flight = Loop::new(settings(), start, hold(end));
    flight.fly(50.0);
    let mut restored: ControllerState = toml::from_str(&toml::to_string(&flight.state).unwrap()).unwrap();
    let inertia = inertia();
    for _ in 0..1000 {
        let estimate = flight.body.estimate();
        let wheels = flight.body.wheels;
        let torque = flight.sample();
        let settings = settings();
        let other = restored.sample(&settings, &inertia, &hold(end), &estimate, &wheels, &Vector3::zeros());
        assert_eq!(torque, other);
        flight.body.go_on(&torque);
    }
}
