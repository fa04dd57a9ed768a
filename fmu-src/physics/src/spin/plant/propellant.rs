//! What the thrusters use and do: propellant, delta-v, inertia, foreseen nutation.

use nalgebra::Vector3;

use super::state::{MassSource, Plant, SpinPlantError};
use crate::attitude::Inertia;
use crate::spin::{
    spinner::Spinner,
    tracker::NutationEstimator,
    work::{Cost, Work},
};

/// A turning force is summed over intervals of this much turn.
const IMPULSE_PANEL_RAD: f64 = 2.0;

/// And over intervals in which the mass falls by this factor, its logarithm.
const IMPULSE_PANEL_MASS: f64 = 0.25;

/// What the edges of many pulses have lost to rounding by a time, as a share of it and of the time a full tank lasts.
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
        let flow_kg_s = spinner.thrust(self.mask).flow_kg_s;
        let left_s = (self.initial_propellant_kg - self.used_kg) / flow_kg_s;
        // Edges are known to rounding: a pulse that takes the last drop ends by its own.
        let late_s = self.mask_since_s.abs() + self.initial_propellant_kg / flow_kg_s;
        self.mask_since_s + left_s + EDGE_ROUNDING * late_s
    }

    /// Empties the tank at `now_s`; the burn ends with the pulse it cut.
    pub(super) fn run_dry(
        &mut self,
        spinner: &Spinner,
        now_s: f64,
        work: &mut Work,
    ) -> Result<(), SpinPlantError> {
        self.reach(spinner, now_s, work)?;
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

    /// Mass at `time_s`, in kg.
    pub(super) fn mass_at_kg(&self, spinner: &Spinner, time_s: f64) -> f64 {
        let left_kg = self.initial_propellant_kg - self.used_at(spinner, time_s);
        spinner.mass_properties.dry_mass_kg + left_kg.max(0.0)
    }

    /// Goes on to the next segment, summing delta-v as the present one is left.
    pub(super) fn next_segment(&mut self, spinner: &Spinner, work: &mut Work) -> Result<(), SpinPlantError> {
        self.motion.check()?;
        let end_s = self.motion.segment_end_s();
        work.spend_segment(self.motion.damper());
        if self.mask != 0 {
            work.spend(Cost::Impulse);
            self.delta_v_inertial_m_s = self.delta_v_at(spinner, end_s);
            self.delta_v_until_s = end_s;
        }
        self.motion.next_segment();
        self.sun.forget(end_s);
        self.star.forget(end_s);
        Ok(())
    }

    /// Goes on through segments until the present one holds `time_s`.
    pub(super) fn reach(
        &mut self,
        spinner: &Spinner,
        time_s: f64,
        work: &mut Work,
    ) -> Result<(), SpinPlantError> {
        while self.motion.segment_end_s() < time_s {
            work.check(self.motion.anchor_s())?;
            self.next_segment(spinner, work)?;
        }
        if self.mask != 0 && self.motion.segment_end_s().is_infinite() {
            // Thrusters without torque: whole panels of the closed form, counted from when they went on.
            let rate = self.motion.at(self.motion.anchor_s()).rate_rad_s(self.motion.inertia()).norm();
            loop {
                let panel_end_s = self.delta_v_until_s.max(self.mask_since_s) + IMPULSE_PANEL_RAD / rate;
                if panel_end_s.is_nan() || panel_end_s > time_s {
                    break;
                }
                work.check(self.delta_v_until_s)?;
                work.spend(Cost::Impulse);
                self.delta_v_inertial_m_s = self.delta_v_at(spinner, panel_end_s);
                self.delta_v_until_s = panel_end_s;
            }
        }
        Ok(())
    }

    /// Delta-v until `time_s` in the present segment, inertial, in m/s: the turning force over the mass left at each instant.
    pub(super) fn delta_v_at(&self, spinner: &Spinner, time_s: f64) -> Vector3<f64> {
        if self.mask == 0 {
            return self.delta_v_inertial_m_s;
        }
        let from_s = self.delta_v_until_s.max(self.mask_since_s);
        let thrust = spinner.thrust(self.mask);
        let mass_kg = self.mass_at_kg(spinner, from_s);
        let fall = (mass_kg / self.mass_at_kg(spinner, time_s)).ln();
        // Panels in which the mass falls by one factor, so that its reciprocal is smooth in each.
        let panels = (fall / IMPULSE_PANEL_MASS).ceil().max(1.0);
        let mut delta_v = self.delta_v_inertial_m_s;
        let mut start_s = from_s;
        for panel in 1..=panels as u32 {
            let burnt_kg = -mass_kg * (-fall * f64::from(panel) / panels).exp_m1();
            let is_last = f64::from(panel) >= panels;
            let end_s = if is_last { time_s } else { from_s + burnt_kg / thrust.flow_kg_s };
            let half_s = 0.5 * (end_s - start_s);
            for (node, weight) in NODES {
                let at_s = start_s + half_s * (1.0 + node);
                let force_n = self.motion.at(at_s).attitude.inertial_from_body(&thrust.force_body_n);
                delta_v += force_n * (weight * half_s / self.mass_at_kg(spinner, at_s));
            }
            start_s = end_s;
        }
        delta_v
    }
}
