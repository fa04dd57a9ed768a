//! A controller in a loop with a rigid body and wheels that fourth-order Runge-Kutta integrates.

use nalgebra::{Matrix3, Vector3, Vector4};

use crate::attitude::Attitude;
use crate::attitude::control::{ControlTarget, ControllerSettings, ControllerState, Estimate};

pub(super) const DT_S: f64 = 0.02;

pub(super) fn settings() -> ControllerSettings {
    ControllerSettings {
        rate_hz: 50.0,
        bandwidth_rad_s: 0.1,
        damping: 0.8,
        integral: 0.1,
        slew_rate_rad_s: 8e-3,
        slew_acceleration_rad_s2: 1e-4,
        keeps_reference: false,
    }
}

pub(super) fn inertia() -> Matrix3<f64> {
    Matrix3::new(430.0, 12.0, -8.0, 12.0, 320.0, 5.0, -8.0, 5.0, 510.0)
}

/// A rigid body whose wheels exert a torque: J w' = T + external - w x (J w + h), h' = -T.
pub(super) struct Body {
    pub(super) inertia: Matrix3<f64>,
    /// Hamilton's quaternion, inertial from body, scalar last.
    pub(super) q: Vector4<f64>,
    pub(super) rate: Vector3<f64>,
    pub(super) wheels: Vector3<f64>,
    pub(super) external: Vector3<f64>,
}

impl Body {
    pub(super) fn new(attitude: &Attitude, rate: Vector3<f64>) -> Self {
        let q = Vector4::from(attitude.quaternion(None));
        let wheels = Vector3::new(2.0, -5.0, 3.0);
        Self { inertia: inertia(), q, rate, wheels, external: Vector3::zeros() }
    }

    pub(super) fn attitude(&self) -> Attitude {
        Attitude::from_quaternion(self.q.into()).unwrap()
    }

    pub(super) fn estimate(&self) -> Estimate {
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

    pub(super) fn advance(&mut self, torque: &Vector3<f64>) {
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
pub(super) struct Loop {
    pub(super) body: Body,
    pub(super) state: ControllerState,
    pub(super) settings: ControllerSettings,
    pub(super) target: ControlTarget,
}

impl Loop {
    pub(super) fn new(settings: ControllerSettings, start: Attitude, target: ControlTarget) -> Self {
        let state = ControllerState::new(start, Vector3::zeros());
        Self { body: Body::new(&start, Vector3::zeros()), state, settings, target }
    }

    pub(super) fn sample(&mut self) -> Vector3<f64> {
        self.sample_with(&self.body.estimate(), &Vector3::zeros())
    }

    pub(super) fn sample_with(&mut self, estimate: &Estimate, external: &Vector3<f64>) -> Vector3<f64> {
        let (body, settings) = (&self.body, &self.settings);
        let torque =
            self.state.sample(settings, &body.inertia, &self.target, estimate, &body.wheels, external);
        self.state.measure_error(&self.target, &estimate.attitude);
        assert!(self.state.is_valid());
        torque
    }

    pub(super) fn simulate(&mut self, duration_s: f64) {
        for _ in 0..(duration_s / DT_S).round() as u64 {
            let torque = self.sample();
            self.body.advance(&torque);
        }
    }

    pub(super) fn error_to(&self, attitude: &Attitude) -> f64 {
        attitude.rotation_vector_to(&self.body.attitude()).norm()
    }
}

pub(super) fn hold(attitude: Attitude) -> ControlTarget {
    ControlTarget::Attitude { attitude, rate_body_rad_s: Vector3::zeros() }
}
