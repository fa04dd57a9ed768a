//! Attitude motion of a rigid body under a constant torque: Euler's equations by the classical Runge-Kutta method.
//!
//! Cells of fixed size are counted from where the torque last changed, so that cutting a step changes no bit. The error
//! of a cell is of fifth order in the angle that the body turns in it.

use serde::{Deserialize, Serialize};

/// Largest cell of the integration, s.
const CELL_S: f64 = 1.0;

/// Quaternion (EME2000 to body, scalar last) and rate in body axes, rad/s.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Attitude {
    /// The quaternion.
    pub q: [f64; 4],
    /// The rate.
    pub rate_rad_s: [f64; 3],
}

/// The motion since the torque last changed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    since_s: f64,
    cells: u64,
    attitude: Attitude,
    torque_body_n_m: [f64; 3],
}

impl Motion {
    /// From an attitude at a time.
    pub fn new(time_s: f64, attitude: Attitude, torque_body_n_m: [f64; 3]) -> Self {
        Self { since_s: time_s, cells: 0, attitude, torque_body_n_m }
    }

    /// Sets the torque from a time on, to which the motion is advanced.
    pub fn set_torque(&mut self, inertia_kg_m2: [f64; 3], time_s: f64, torque_body_n_m: [f64; 3]) {
        if torque_body_n_m != self.torque_body_n_m {
            *self = Self::new(time_s, self.advance(inertia_kg_m2, time_s), torque_body_n_m);
        }
    }

    /// The attitude at a time not before the last one; whole cells until then are kept.
    pub fn advance(&mut self, inertia_kg_m2: [f64; 3], time_s: f64) -> Attitude {
        let whole = ((time_s - self.since_s) / CELL_S).floor().max(0.0) as u64;
        while self.cells < whole {
            self.attitude = step(inertia_kg_m2, self.torque_body_n_m, self.attitude, CELL_S);
            self.cells += 1;
        }
        let rest_s = time_s - (self.since_s + self.cells as f64 * CELL_S);
        if rest_s > 0.0 {
            step(inertia_kg_m2, self.torque_body_n_m, self.attitude, rest_s)
        } else {
            self.attitude
        }
    }
}

fn step(inertia: [f64; 3], torque: [f64; 3], from: Attitude, step_s: f64) -> Attitude {
    let k1 = slope(inertia, torque, from);
    let k2 = slope(inertia, torque, moved(from, k1, 0.5 * step_s));
    let k3 = slope(inertia, torque, moved(from, k2, 0.5 * step_s));
    let k4 = slope(inertia, torque, moved(from, k3, step_s));
    let mut to = from;
    for (slope, weight) in [(k1, 1.0), (k2, 2.0), (k3, 2.0), (k4, 1.0)] {
        to = moved(to, slope, step_s * weight / 6.0);
    }
    let norm = to.q.iter().map(|part| part * part).sum::<f64>().sqrt();
    to.q.iter_mut().for_each(|part| *part /= norm);
    to
}

/// J dw/dt = torque - w x J w; dq/dt = (w x components of the quaternion) / 2.
fn slope(inertia: [f64; 3], torque: [f64; 3], at: Attitude) -> Attitude {
    let w = at.rate_rad_s;
    let momentum: [f64; 3] = std::array::from_fn(|i| inertia[i] * w[i]);
    let gyroscopic = cross(w, momentum);
    let [x, y, z, s] = at.q;
    let turned = cross([x, y, z], w);
    let vector: [f64; 3] = std::array::from_fn(|i| 0.5 * (s * w[i] + turned[i]));
    Attitude {
        q: [vector[0], vector[1], vector[2], -0.5 * (x * w[0] + y * w[1] + z * w[2])],
        rate_rad_s: std::array::from_fn(|i| (torque[i] - gyroscopic[i]) / inertia[i]),
    }
}

fn moved(from: Attitude, slope: Attitude, time_s: f64) -> Attitude {
    Attitude {
        q: std::array::from_fn(|i| from.q[i] + time_s * slope.q[i]),
        rate_rad_s: std::array::from_fn(|i| from.rate_rad_s[i] + time_s * slope.rate_rad_s[i]),
    }
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// A vector in body axes: A(q) = (s2 - v.v) 1 + 2 v vT - 2 s [v x].
pub(super) fn to_body(q: [f64; 4], vector: [f64; 3]) -> [f64; 3] {
    let [x, y, z, s] = q;
    let v = [x, y, z];
    let along = 2.0 * (0..3).map(|i| v[i] * vector[i]).sum::<f64>();
    let turned = cross(v, vector);
    let own = s * s - (x * x + y * y + z * z);
    std::array::from_fn(|i| own * vector[i] + along * v[i] - 2.0 * s * turned[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    const INERTIA: [f64; 3] = [300.0, 400.0, 500.0];

    #[test]
    fn free_motion_keeps_momentum_and_energy() {
        let start = Attitude { q: [0.1, 0.2, -0.3, 0.9273618495495703], rate_rad_s: [0.002, 0.01, -0.003] };
        let conserved = |at: Attitude| {
            let momentum: [f64; 3] = std::array::from_fn(|i| INERTIA[i] * at.rate_rad_s[i]);
            let back = [-at.q[0], -at.q[1], -at.q[2], at.q[3]];
            let energy: f64 = (0..3).map(|i| momentum[i] * at.rate_rad_s[i]).sum();
            (to_body(back, momentum), energy)
        };
        let mut motion = Motion::new(0.0, start, [0.0; 3]);
        let end = motion.advance(INERTIA, 3600.0);
        assert!((end.rate_rad_s[0] - start.rate_rad_s[0]).abs() > 1e-4, "it nutates");
        let ((before, energy_before), (after, energy_after)) = (conserved(start), conserved(end));
        for i in 0..3 {
            assert!((before[i] - after[i]).abs() < 1e-9, "{before:?} {after:?}");
        }
        assert!((energy_before / energy_after - 1.0).abs() < 1e-10);
    }

    #[test]
    fn a_torque_about_a_principal_axis_turns_by_half_its_acceleration_times_time_squared() {
        let still = Attitude { q: [0.0, 0.0, 0.0, 1.0], rate_rad_s: [0.0; 3] };
        let mut motion = Motion::new(0.0, still, [0.0, 0.0, 0.05]);
        let end = motion.advance(INERTIA, 100.0);
        let angle: f64 = 0.5 * 0.05 / 500.0 * 100.0 * 100.0;
        assert!(
            (end.q[2] - (angle / 2.0).sin()).abs() < 1e-12 && (end.q[3] - (angle / 2.0).cos()).abs() < 1e-12
        );
        // The body turned left, so what stood still turns right.
        let seen = to_body(end.q, [1.0, 0.0, 0.0]);
        assert!((seen[0] - angle.cos()).abs() < 1e-12 && (seen[1] + angle.sin()).abs() < 1e-12);
    }

    #[test]
    fn cutting_changes_no_bit() {
        let start = Attitude { q: [0.0, 0.0, 0.0, 1.0], rate_rad_s: [0.01, 0.02, 0.03] };
        let mut whole = Motion::new(0.25, start, [1e-3, 0.0, -2e-3]);
        let mut cut = whole;
        for k in 1..40 {
            cut.advance(INERTIA, 0.25 + f64::from(k) * 0.3);
        }
        assert_eq!(whole.advance(INERTIA, 12.25), cut.advance(INERTIA, 12.25));
    }
}
