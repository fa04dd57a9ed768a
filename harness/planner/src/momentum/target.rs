//! Target of a plan beside its momentum: B-plane and time of arrival, linear in the force of sunlight.
//!
//! Equation: a change of velocity dv at t moves the encounter by L(t) dv, so that a change of the force by dF moves it by the integral
//! of L dF / m dt. Rows are B.T (m), B.R (m), arrival (s). The miss of the last flight is known; that of other controls is it, plus
//! the difference of both integrals.

use core::ops::AddAssign;

use nalgebra::{Matrix3, Vector3};

use super::{
    controls::CONTROLS,
    encountered::Encountered,
    program::{GUARD, TargetRow},
    simulated::FlightRow,
    torque::SunlitSpacecraft,
};

/// B.T in m, B.R in m, arrival in s.
pub const QUANTITIES: usize = 3;
/// Share of a tolerance that programmes allow; the rest is for what is not linear, as [`GUARD`] is of the momentum's limit.
const ALLOWED: f64 = 0.5;

/// How near a plan comes to its aimpoint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Greatest miss either way; `None`: it is free.
    pub tolerance: [Option<f64>; QUANTITIES],
}

impl Target {
    /// Whether a miss is within the tolerances.
    pub fn is_met(&self, miss: &Vector3<f64>) -> bool {
        let mut all = self.tolerance.iter().zip(miss);
        all.all(|(tolerance, miss)| tolerance.is_none_or(|tolerance| miss.abs() <= tolerance))
    }

    /// Rows of a programme for a miss that is linear in the controls; `limit_n_m_s` is that of the momentum.
    pub(super) fn rows(
        &self,
        LinearMiss { constant, terms }: &LinearMiss,
        limit_n_m_s: f64,
    ) -> Vec<TargetRow> {
        let bounded = (0..QUANTITIES).filter_map(|row| Some((row, self.tolerance[row]?)));
        bounded
            .map(|(row, tolerance)| TargetRow {
                constant: constant[row],
                terms: terms.iter().map(|(index, by)| (*index, by[row])).collect(),
                within: ALLOWED * tolerance,
                per_excess: (1.0 - ALLOWED) * tolerance / (GUARD * limit_n_m_s),
            })
            .collect()
    }

    /// By how much a miss exceeds its tolerance, as the excess of a programme, in N m s.
    pub(super) fn excess_n_m_s(&self, miss: &Vector3<f64>, limit_n_m_s: f64) -> f64 {
        let linear = LinearMiss { constant: *miss, terms: Vec::new() };
        let rows = self.rows(&linear, limit_n_m_s);
        let of_programme = rows.iter().map(|row| row.excess(&[])).fold(f64::NEG_INFINITY, f64::max);
        of_programme - GUARD * limit_n_m_s
    }
}

/// A miss that is linear in controls: with all of them at 0, and by unit of a control by its index.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct LinearMiss {
    /// With all of them at 0.
    pub constant: Vector3<f64>,
    /// By unit of those that move it.
    pub terms: Vec<(usize, Vector3<f64>)>,
}

/// Effect of the windows of a flight on its target.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Targeting {
    /// The target.
    pub target: Target,
    /// The last flight.
    pub encountered: Encountered,
    /// Sum of the model's cells with that flight's controls.
    pub simulated: Vector3<f64>,
}

impl Targeting {
    /// Partials of the encounter by force times time at a row.
    pub(super) fn by_impulse(&self, sunlit: &SunlitSpacecraft, row: &FlightRow) -> Matrix3<f64> {
        let mass_kg = row.motion.map_or(sunlit.current_mass_panels_stowed.mass_kg, |motion| motion.mass_kg);
        self.encountered.by_velocity_at(row.time_s) / mass_kg
    }
}

/// Change of the encounter by sunlight over a time: B.T (m), B.R (m), arrival (s).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moves {
    /// At the present controls.
    pub at: Vector3<f64>,
    /// By rad or share of each control; nothing where its bounds leave no choice.
    pub by_control: [Vector3<f64>; CONTROLS],
}

impl AddAssign for Moves {
    fn add_assign(&mut self, other: Self) {
        self.at += other.at;
        self.by_control.iter_mut().zip(other.by_control).for_each(|(sum, by)| *sum += by);
    }
}

#[cfg(test)]
mod tests {
    //! Programmes leave the same of the target's tolerance and of the momentum's limit, by one excess.
    use approx::assert_relative_eq;

    use super::*;

    const LIMIT_N_M_S: f64 = 5.0;

    #[test]
    fn an_excess_that_reaches_the_limit_of_the_momentum_reaches_the_tolerance() {
        let target = Target { tolerance: [Some(700.0), Some(400.0), None] };
        let of = |miss: [f64; 3]| target.excess_n_m_s(&Vector3::from(miss), LIMIT_N_M_S);
        assert_relative_eq!(of([-700.0, 100.0, 1e9]), 0.0, epsilon = 1e-12);
        assert_relative_eq!(of([100.0, 400.0, 1e9]), 0.0, epsilon = 1e-12);
        let linear = LinearMiss { constant: Vector3::new(-700.0, 0.0, 0.0), terms: Vec::new() };
        let found = target.rows(&linear, LIMIT_N_M_S).iter().map(|row| row.excess(&[])).fold(0.0, f64::max);
        assert_relative_eq!(found, GUARD * LIMIT_N_M_S, epsilon = 1e-12);
    }

    #[test]
    fn a_programme_at_its_bound_is_within_the_tolerance() {
        let target = Target { tolerance: [Some(700.0), None, None] };
        let found = target.excess_n_m_s(&Vector3::new(ALLOWED * 700.0, 0.0, 0.0), LIMIT_N_M_S);
        assert_relative_eq!(found, -GUARD * LIMIT_N_M_S, epsilon = 1e-12);
    }
}
