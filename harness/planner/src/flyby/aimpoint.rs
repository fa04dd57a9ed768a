//! Aimpoint in the B-plane of an encounter, and by how much a flight misses it.
//!
//! Equation: B = r_p sqrt(1 + 2 mu / (r_p v^2)), r_p the periapsis of the hyperbola, v the speed far from the planet.

use nalgebra::Vector3;

use super::{encounter::Encounter, sensitivity::Sensitivity};
use crate::momentum::{encountered::Encountered, simulated::FlightRow};

/// Aim in the B-plane of the hyperbola that osculates some time before the closest approach.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BPlaneAimpoint {
    /// B along T and R, in m.
    pub b_m: [f64; 2],
    /// Time of closest approach, in s of the flight, where it is a goal.
    pub arrival_s: Option<f64>,
}

impl BPlaneAimpoint {
    /// Returns the encounter less the aim: B.T and B.R in m, arrival in s (0 where it is free).
    pub fn miss(&self, encounter: &Encounter) -> Vector3<f64> {
        Vector3::new(
            encounter.plane.b_t_m - self.b_m[0],
            encounter.plane.b_r_m - self.b_m[1],
            self.arrival_s.map_or(0.0, |arrival_s| encounter.time_s - arrival_s),
        )
    }

    /// How a flight with these sensitivities misses it, and what moves that, at the times of its rows.
    pub fn encountered(&self, sensitivity: &Sensitivity, rows: &[FlightRow]) -> Encountered {
        let epoch_s = sensitivity.encounter.epoch_s;
        let times = rows.iter().map(|row| row.time_s).filter(|time_s| *time_s < epoch_s).chain([epoch_s]);
        Encountered {
            miss: self.miss(&sensitivity.encounter),
            by_velocity: times.map(|time_s| (time_s, sensitivity.by_velocity(time_s))).collect(),
        }
    }
}

/// Length of B whose hyperbola has this radius of periapsis, both in m.
pub fn b_of_periapsis_m(radius_m: f64, gm_m3_s2: f64, excess_speed_m_s: f64) -> f64 {
    radius_m * (1.0 + 2.0 * gm_m3_s2 / (radius_m * excess_speed_m_s.powi(2))).sqrt()
}

/// Radius of periapsis of the hyperbola with this length of B, both in m.
pub fn periapsis_of_b_m(b_m: f64, gm_m3_s2: f64, excess_speed_m_s: f64) -> f64 {
    let semi_axis_m = gm_m3_s2 / excess_speed_m_s.powi(2);
    b_m.hypot(semi_axis_m) - semi_axis_m
}

#[cfg(test)]
mod tests {
    //! Energy and angular momentum of the hyperbola at periapsis.
    use super::*;

    #[test]
    fn periapsis_has_the_energy_and_the_momentum_of_the_asymptote() {
        let (radius_m, gm_m3_s2, excess_m_s): (f64, f64, f64) = (2.64e6, 2.203e13, 5.2e3);
        let b_m = b_of_periapsis_m(radius_m, gm_m3_s2, excess_m_s);
        let speed_m_s = b_m * excess_m_s / radius_m;
        let energy = 0.5 * speed_m_s.powi(2) - gm_m3_s2 / radius_m;
        assert!((energy / (0.5 * excess_m_s.powi(2)) - 1.0).abs() < 1e-12);
        assert!((periapsis_of_b_m(b_m, gm_m3_s2, excess_m_s) / radius_m - 1.0).abs() < 1e-12);
    }
}
