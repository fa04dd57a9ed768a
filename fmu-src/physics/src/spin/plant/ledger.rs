//! What the thrusters use and do: propellant, delta-v, inertia, foreseen nutation.

use nalgebra::Vector3;

use super::{MassSource, Plant};
use crate::spin::{inertia::Inertia, motion::Runaway, spinner::Spinner, tracker::NutationEstimator};

/// A turning force is summed over stretches of this much turn.
const IMPULSE_PANEL_RAD: f64 = 2.0;

/// What the edges of many pulses have lost to rounding by a time, as a share of it.
const EDGE_ROUNDING: f64 = 1e-11;

/// Gauss-Legendre nodes and weights on -1..1 for the impulse of a turning thruster.
const NODES: [(f64, f64); 8] = [
    (-0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
    (-0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (-0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (-0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];

impl Plant {
    /// Books what the thrusters that were on since `mask_since_s` used and did.
    pub(super) fn settle_pulse(&mut self, spinner: &Spinner, now_s: f64) {
        if self.mask == 0 {
            return;
        }
        self.delta_v_inertial_m_s = self.delta_v_at(spinner, now_s);
        let thrust = spinner.thrust(self.mask);
        let across = [thrust.torque_body_n_m.x, thrust.torque_body_n_m.y];
        self.predicted.pulse(&self.theory, across, self.mask_since_s, now_s);
        self.used_kg = self.used_at(spinner, now_s);
        self.mask = 0;
        self.estimator = NutationEstimator::default();
        self.estimator_since_s = now_s;
    }

    /// Whether the tank is empty: nothing fires any more.
    pub fn is_dry(&self) -> bool {
        self.used_kg >= self.initial_propellant_kg
    }

    /// When the thrusters that are on empty the tank, in s; infinite while none is.
    pub(super) fn dry_s(&self, spinner: &Spinner) -> f64 {
        if self.mask == 0 {
            return f64::INFINITY;
        }
        let left_s = (self.initial_propellant_kg - self.used_kg) / spinner.thrust(self.mask).flow_kg_s;
        // Edges are known to rounding: a pulse that takes the last drop ends by its own.
        self.mask_since_s + left_s + EDGE_ROUNDING * self.mask_since_s.abs().max(1.0)
    }

    /// Empties the tank at `now_s`; the burn ends with the pulse it cut.
    pub(super) fn run_dry(&mut self, spinner: &Spinner, now_s: f64) -> Result<(), Runaway> {
        self.reach(spinner, now_s)?;
        self.settle_pulse(spinner, now_s);
        self.used_kg = self.initial_propellant_kg;
        if let Some(sequencer) = &mut self.sequencer {
            sequencer.stop();
        }
        Ok(())
    }

    pub(super) fn inertia_now(&self, spinner: &Spinner) -> Inertia {
        if self.mass_source == MassSource::Fixed {
            return *self.motion.inertia();
        }
        let left_kg = (self.initial_propellant_kg - self.used_kg).max(0.0);
        // The table was checked when it was read; the present body is the answer that cannot be refused.
        spinner.mass_properties.inertia(left_kg).unwrap_or(*self.motion.inertia())
    }

    /// Propellant used until `time_s`, in kg.
    pub(super) fn used_at(&self, spinner: &Spinner, time_s: f64) -> f64 {
        if self.mask == 0 {
            return self.used_kg;
        }
        let more_kg = spinner.thrust(self.mask).flow_kg_s * (time_s - self.mask_since_s);
        (self.used_kg + more_kg).min(self.initial_propellant_kg)
    }

    pub(super) fn mass_kg(&self, spinner: &Spinner) -> f64 {
        spinner.mass_properties.dry_mass_kg + (self.initial_propellant_kg - self.used_kg).max(0.0)
    }

    /// Goes on to the next cell, summing delta-v as the present one is left.
    pub(super) fn next_cell(&mut self, spinner: &Spinner) -> Result<(), Runaway> {
        self.motion.check()?;
        let end_s = self.motion.cell_end_s();
        if self.mask != 0 {
            self.delta_v_inertial_m_s = self.delta_v_at(spinner, end_s);
            self.delta_v_until_s = end_s;
        }
        self.motion.next_cell();
        self.sun.forget(end_s);
        self.star.forget(end_s);
        Ok(())
    }

    /// Goes on through cells until the present one holds `time_s`.
    pub(super) fn reach(&mut self, spinner: &Spinner, time_s: f64) -> Result<(), Runaway> {
        while self.motion.cell_end_s() < time_s {
            self.next_cell(spinner)?;
        }
        if self.mask != 0 && self.motion.cell_end_s().is_infinite() {
            // Thrusters without torque: whole panels of the closed form, counted from when they went on.
            let rate = self.motion.at(self.motion.anchor_s()).rate_rad_s(self.motion.inertia()).norm();
            loop {
                let panel_end_s = self.delta_v_until_s.max(self.mask_since_s) + IMPULSE_PANEL_RAD / rate;
                if panel_end_s.is_nan() || panel_end_s > time_s {
                    break;
                }
                self.delta_v_inertial_m_s = self.delta_v_at(spinner, panel_end_s);
                self.delta_v_until_s = panel_end_s;
            }
        }
        Ok(())
    }

    /// Delta-v until `time_s` in the present cell, inertial, in m/s.
    pub(super) fn delta_v_at(&self, spinner: &Spinner, time_s: f64) -> Vector3<f64> {
        if self.mask == 0 {
            return self.delta_v_inertial_m_s;
        }
        let from_s = self.delta_v_until_s.max(self.mask_since_s);
        let force = spinner.thrust(self.mask).force_body_n;
        let half_s = 0.5 * (time_s - from_s);
        let mut impulse = Vector3::zeros();
        for (node, weight) in NODES {
            let attitude = self.motion.at(from_s + half_s * (1.0 + node)).attitude;
            impulse += attitude.inertial_from_body(&force) * weight;
        }
        self.delta_v_inertial_m_s + impulse * (half_s / self.mass_kg(spinner))
    }
}
