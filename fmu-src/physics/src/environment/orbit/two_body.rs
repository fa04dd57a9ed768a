//! An undisturbed orbit as a function of time.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::{
    elements::{Elements, OrbitError, check, check_mu},
    kepler::{EccentricAnomaly, eccentric_anomaly, hyperbolic_anomaly},
};
use crate::environment::CartesianState;
use crate::math;

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
        let (sin_half, cos_half) = math::sin_cos(0.5 * elements.true_anomaly_rad);
        let mean_anomaly_rad = if e < 1.0 {
            let anomaly = 2.0 * math::atan2((1.0 - e).sqrt() * sin_half, (1.0 + e).sqrt() * cos_half);
            // The nearest periapsis: within half a turn.
            let mean = anomaly - e * math::sin(anomaly);
            mean - (mean / TAU).round() * TAU
        } else {
            let anomaly = 2.0 * math::atanh(((e - 1.0) / (e + 1.0)).sqrt() * sin_half / cos_half);
            e * math::sinh(anomaly) - anomaly
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

    /// Rejects decoded orbits that no computation can produce.
    pub fn is_valid(&self) -> bool {
        let axes = [self.to_periapsis, self.to_latus];
        self.elements.check().is_ok()
            && check_mu(self.mu_m3_s2).is_ok()
            && self.mean_motion_rad_s.is_normal()
            && self.mean_motion_rad_s > 0.0
            && self.periapsis_epoch_s.is_finite()
            && axes.iter().all(|axis| (axis.norm() - 1.0).abs() < 1e-9)
    }

    /// Position and velocity at an epoch, in the frame of the elements.
    pub fn state_at(&self, epoch_s: f64) -> CartesianState {
        let (a, e) = (self.elements.semi_major_axis_m, self.elements.eccentricity);
        let mean_anomaly = self.mean_motion_rad_s * (epoch_s - self.periapsis_epoch_s);
        // Coordinates in the plane over |a|, their derivative by the anomaly, and r / |a|.
        let (along, across, d_along, d_across, distance) = if e < 1.0 {
            let minor = ((1.0 - e) * (1.0 + e)).sqrt();
            let EccentricAnomaly { sin, cos, .. } = eccentric_anomaly(mean_anomaly, e);
            (cos - e, minor * sin, -sin, minor * cos, 1.0 - e * cos)
        } else {
            let minor = ((e - 1.0) * (e + 1.0)).sqrt();
            let anomaly = hyperbolic_anomaly(mean_anomaly, e);
            let (sinh, cosh) = (math::sinh(anomaly), math::cosh(anomaly));
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
mod tests;
