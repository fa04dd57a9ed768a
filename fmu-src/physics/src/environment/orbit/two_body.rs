//! An undisturbed orbit as a function of time.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::{
    elements::{Elements, OrbitError, check, check_mu},
    kepler::{eccentric_anomaly_rad, hyperbolic_anomaly},
};
use crate::environment::CartesianState;

/// Motion about one centre under its gravity alone, elliptic or hyperbolic, in closed form.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TwoBodyOrbit {
    elements: Elements,
    mu_m3_s2: f64,
    mean_motion_rad_s: f64,
    /// Epoch of the periapsis passage nearest to the epoch of the elements.
    periapsis_epoch_s: f64,
    to_periapsis: Vector3<f64>,
    to_latus: Vector3<f64>,
}

impl TwoBodyOrbit {
    /// The orbit that has `elements` at `epoch_s`, about a centre of gravitational parameter `mu_m3_s2`.
    ///
    /// # Errors
    /// See [`Elements::check`].
    pub fn from_elements(elements: Elements, mu_m3_s2: f64, epoch_s: f64) -> Result<Self, OrbitError> {
        elements.check()?;
        check_mu(mu_m3_s2)?;
        check("epoch in s", epoch_s, epoch_s.is_finite(), "a finite number")?;
        let axis_m = elements.semi_major_axis_m.abs();
        let mean_motion_rad_s = (mu_m3_s2 / axis_m).sqrt() / axis_m;
        let e = elements.eccentricity;
        let (sin_half, cos_half) = (0.5 * elements.true_anomaly_rad).sin_cos();
        let mean_anomaly_rad = if e < 1.0 {
            let anomaly = 2.0 * ((1.0 - e).sqrt() * sin_half).atan2((1.0 + e).sqrt() * cos_half);
            // The nearest periapsis: within half a turn.
            let mean = anomaly - e * anomaly.sin();
            mean - (mean / TAU).round() * TAU
        } else {
            let anomaly = 2.0 * (((e - 1.0) / (e + 1.0)).sqrt() * sin_half / cos_half).atanh();
            e * anomaly.sinh() - anomaly
        };
        let [to_periapsis, to_latus] = elements.in_plane_axes();
        Ok(Self {
            elements,
            mu_m3_s2,
            mean_motion_rad_s,
            periapsis_epoch_s: epoch_s - mean_anomaly_rad / mean_motion_rad_s,
            to_periapsis,
            to_latus,
        })
    }

    /// The orbit through `state` at `epoch_s`.
    ///
    /// # Errors
    /// See [`Elements::from_state`].
    pub fn from_state(state: &CartesianState, mu_m3_s2: f64, epoch_s: f64) -> Result<Self, OrbitError> {
        Self::from_elements(Elements::from_state(state, mu_m3_s2)?, mu_m3_s2, epoch_s)
    }

    /// Position and velocity at an epoch, in the frame of the elements.
    pub fn state_at(&self, epoch_s: f64) -> CartesianState {
        let (a, e) = (self.elements.semi_major_axis_m, self.elements.eccentricity);
        let mean_anomaly = self.mean_motion_rad_s * (epoch_s - self.periapsis_epoch_s);
        // Coordinates in the plane over |a|, their derivative by the anomaly, and r / |a|.
        let (along, across, d_along, d_across, distance) = if e < 1.0 {
            let minor = ((1.0 - e) * (1.0 + e)).sqrt();
            let (sin, cos) = eccentric_anomaly_rad(mean_anomaly, e).sin_cos();
            (cos - e, minor * sin, -sin, minor * cos, 1.0 - e * cos)
        } else {
            let minor = ((e - 1.0) * (e + 1.0)).sqrt();
            let anomaly = hyperbolic_anomaly(mean_anomaly, e);
            let (sinh, cosh) = (anomaly.sinh(), anomaly.cosh());
            (e - cosh, minor * sinh, -sinh, minor * cosh, e * cosh - 1.0)
        };
        let length_m = a.abs();
        let speed_m_s = length_m * self.mean_motion_rad_s / distance;
        CartesianState {
            position_m: (self.to_periapsis * along + self.to_latus * across) * length_m,
            velocity_m_s: (self.to_periapsis * d_along + self.to_latus * d_across) * speed_m_s,
        }
    }

    /// The elements the orbit was made from.
    pub fn elements(&self) -> &Elements {
        &self.elements
    }

    /// Gravitational parameter of the centre, m3/s2.
    pub fn mu_m3_s2(&self) -> f64 {
        self.mu_m3_s2
    }

    /// Time of one revolution, s; infinite for a hyperbola.
    pub fn period_s(&self) -> f64 {
        if self.elements.eccentricity < 1.0 { TAU / self.mean_motion_rad_s } else { f64::INFINITY }
    }

    /// Epoch of a periapsis; number 0 is the one nearest to the epoch the orbit was made from. A hyperbola has only
    /// that one.
    pub fn periapsis_epoch_s(&self, number: i64) -> f64 {
        if number == 0 || self.elements.eccentricity >= 1.0 {
            return self.periapsis_epoch_s;
        }
        self.periapsis_epoch_s + number as f64 * self.period_s()
    }

    /// The number of the last periapsis at or before an epoch; always 0 for a hyperbola.
    pub fn orbit_number(&self, epoch_s: f64) -> i64 {
        if self.elements.eccentricity >= 1.0 {
            return 0;
        }
        let number = ((epoch_s - self.periapsis_epoch_s) / self.period_s()).floor() as i64;
        // Rounding can put the quotient on the wrong side of a periapsis.
        if self.periapsis_epoch_s(number) > epoch_s {
            number - 1
        } else if self.periapsis_epoch_s(number + 1) <= epoch_s {
            number + 1
        } else {
            number
        }
    }

    /// Time since the last periapsis, s, in `[0, period)`; negative before a hyperbola's periapsis.
    pub fn time_since_periapsis_s(&self, epoch_s: f64) -> f64 {
        epoch_s - self.periapsis_epoch_s(self.orbit_number(epoch_s))
    }
}

#[cfg(test)]
mod tests {
    //! The closed form obeys Newton's law: it agrees with integrating the acceleration, keeps energy and momentum,
    //! and sweeps equal areas.

    use proptest::prelude::*;

    use super::*;
    use crate::constants::GM_MERCURY_M3_S2 as MU;

    fn messenger() -> Elements {
        // Paper 004 Table 3.
        Elements {
            semi_major_axis_m: 10_175_000.0,
            eccentricity: 0.74,
            inclination_rad: 82.52_f64.to_radians(),
            ascending_node_rad: 350.17_f64.to_radians(),
            periapsis_argument_rad: 119.16_f64.to_radians(),
            true_anomaly_rad: 1.0,
        }
    }

    /// Classical Runge-Kutta on Newton's law, nothing of the orbit module in it.
    fn runge_kutta(mut state: CartesianState, mu: f64, duration_s: f64, steps: u32) -> CartesianState {
        let gravity = |r: Vector3<f64>| -r * (mu / r.norm().powi(3));
        let h = duration_s / f64::from(steps);
        for _ in 0..steps {
            let (r, v) = (state.position_m, state.velocity_m_s);
            let (k1r, k1v) = (v, gravity(r));
            let (k2r, k2v) = (v + k1v * (h / 2.0), gravity(r + k1r * (h / 2.0)));
            let (k3r, k3v) = (v + k2v * (h / 2.0), gravity(r + k2r * (h / 2.0)));
            let (k4r, k4v) = (v + k3v * h, gravity(r + k3r * h));
            state.position_m += (k1r + k2r * 2.0 + k3r * 2.0 + k4r) * (h / 6.0);
            state.velocity_m_s += (k1v + k2v * 2.0 + k3v * 2.0 + k4v) * (h / 6.0);
        }
        state
    }

    #[test]
    fn agrees_with_integrating_newtons_law() {
        let hyperbola =
            Elements { semi_major_axis_m: -8e6, eccentricity: 1.6, true_anomaly_rad: -1.2, ..messenger() };
        for elements in [messenger(), hyperbola] {
            let orbit = TwoBodyOrbit::from_elements(elements, MU, 1000.0).unwrap();
            let start = orbit.state_at(1000.0);
            let given = elements.state(MU).unwrap();
            assert!((start.position_m - given.position_m).norm() < 1e-6);
            assert!((start.velocity_m_s - given.velocity_m_s).norm() < 1e-9);
            let integrated = runge_kutta(start, MU, 20_000.0, 80_000);
            let closed = orbit.state_at(21_000.0);
            assert!((integrated.position_m - closed.position_m).norm() < 1e-3);
            assert!((integrated.velocity_m_s - closed.velocity_m_s).norm() < 1e-6);
        }
    }

    #[test]
    fn energy_momentum_and_eccentricity_vector_are_constant() {
        let orbit = TwoBodyOrbit::from_elements(messenger(), MU, 0.0).unwrap();
        let invariants = |s: CartesianState| {
            let momentum = s.position_m.cross(&s.velocity_m_s);
            let energy = s.velocity_m_s.norm_squared() / 2.0 - MU / s.position_m.norm();
            (energy, momentum, s.velocity_m_s.cross(&momentum) / MU - s.position_m.normalize())
        };
        let (energy, momentum, vector) = invariants(orbit.state_at(0.0));
        for i in 0..500 {
            let (e, h, v) = invariants(orbit.state_at(f64::from(i) * 15_551.3));
            assert!((e / energy - 1.0).abs() < 2e-13);
            assert!((h - momentum).norm() < 1e-14 * momentum.norm());
            assert!((v - vector).norm() < 1e-13);
        }
    }

    #[test]
    fn messenger_period_and_numbering() {
        // 12.07 h, not the 12 h of the paper's text.
        let orbit = TwoBodyOrbit::from_elements(messenger(), MU, 5e8).unwrap();
        assert!((orbit.period_s() / 3600.0 - 12.07).abs() < 0.005);
        for number in -3..400 {
            let epoch_s = orbit.periapsis_epoch_s(number);
            assert_eq!(orbit.orbit_number(epoch_s), number);
            assert_eq!(orbit.time_since_periapsis_s(epoch_s), 0.0);
            assert_eq!(orbit.orbit_number(epoch_s.next_down()), number - 1);
            assert!(orbit.time_since_periapsis_s(epoch_s.next_down()) < orbit.period_s() + 1e-6);
            let distance = orbit.state_at(epoch_s).position_m.norm();
            assert!((distance / messenger().periapsis_distance_m() - 1.0).abs() < 1e-12);
        }
        assert!(orbit.periapsis_epoch_s(0) < 5e8 && orbit.periapsis_epoch_s(1) > 5e8);
    }

    #[test]
    fn a_period_brings_it_back() {
        let orbit = TwoBodyOrbit::from_elements(messenger(), MU, 0.0).unwrap();
        let (now, later) = (orbit.state_at(100.0), orbit.state_at(100.0 + orbit.period_s()));
        assert!((now.position_m - later.position_m).norm() < 1e-4);
        assert!(TwoBodyOrbit::from_elements(messenger(), MU, f64::NAN).is_err());
    }

    proptest! {
        #[test]
        fn velocity_is_the_derivative_of_position(
            a in 3e6..5e7f64, e in 0.0..0.9f64, anomaly in 0.0..TAU, t in -1e6..1e6f64,
        ) {
            let elements = Elements { semi_major_axis_m: a, eccentricity: e, true_anomaly_rad: anomaly, ..messenger() };
            let orbit = TwoBodyOrbit::from_elements(elements, MU, 0.0).unwrap();
            let state = orbit.state_at(t);
            // Fourth-order central difference on a hundred-thousandth of the local time scale.
            let h = 3e-3 * state.position_m.norm() / state.velocity_m_s.norm();
            let p = |k: f64| orbit.state_at(t + k * h).position_m;
            let slope = ((p(1.0) - p(-1.0)) * 8.0 - (p(2.0) - p(-2.0))) / (12.0 * h);
            prop_assert!((slope - state.velocity_m_s).norm() < 1e-8 * state.velocity_m_s.norm());
        }

        #[test]
        fn state_and_orbit_are_one(t in -1e5..1e5f64, later in -1e5..1e5f64) {
            let orbit = TwoBodyOrbit::from_elements(messenger(), MU, 0.0).unwrap();
            let again = TwoBodyOrbit::from_state(&orbit.state_at(t), MU, t).unwrap();
            let (a, b) = (orbit.state_at(later), again.state_at(later));
            prop_assert!((a.position_m - b.position_m).norm() < 1e-3);
        }
    }
}
