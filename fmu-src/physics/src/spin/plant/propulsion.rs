//! Thrusters and tank of a spinner: propellant, delta-v, inertia, predicted nutation.

use std::sync::LazyLock;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::start::{MassSource, Start};
use super::valves::Valves;
use crate::attitude::{Inertia, JetDamping};
use crate::math;
use crate::numerics::quadrature::Rule;
use crate::propulsion::ThrustLaw;
use crate::spin::{
    motion::Motion,
    nutation::{LinearNutation, Spin},
    series::BodyTorque,
    spinner::Spinner,
    work::{Work, WorkExceeded, WorkKind},
};

/// A turning force is summed over intervals of this much turn.
const IMPULSE_PANEL_RAD: f64 = 2.0;

/// And over intervals in which the mass falls by this factor, its logarithm.
const IMPULSE_PANEL_MASS: f64 = 0.25;

/// Rounding of the edges of many pulses by a time, as a fraction of it and of the time a full tank lasts.
const EDGE_ROUNDING: f64 = 1e-11;

/// Quadrature of the impulse of a turning thruster.
const _: () = assert!(!core::mem::needs_drop::<Rule<8>>());
static IMPULSE_RULE: LazyLock<Rule<8>> = LazyLock::new(Rule::gauss_legendre);

/// Thrusters, tank and what they did so far.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Propulsion {
    mass_source: MassSource,
    /// Propellant at the start, in kg.
    pub initial_propellant_kg: f64,
    /// Valves, and what the thrusters exert.
    pub valves: Valves,
    used_kg: f64,
    delta_v_inertial_m_s: Vector3<f64>,
    /// Up to when delta-v is summed, in s.
    delta_v_until_s: f64,
    predicted: LinearNutation,
}

impl Propulsion {
    /// No thruster on, and nothing used.
    pub(super) fn new(start: &Start, start_s: f64) -> Self {
        Self {
            mass_source: start.mass_source,
            initial_propellant_kg: start.propellant_kg,
            valves: Valves::new(start.execution, start.seed, start_s),
            used_kg: 0.0,
            delta_v_inertial_m_s: Vector3::zeros(),
            delta_v_until_s: start_s,
            predicted: LinearNutation::default(),
        }
    }

    /// Nutation by the linear theory after the last pulse, in rad.
    pub fn predicted_nutation_rad(&self) -> f64 {
        self.predicted.angle_rad()
    }

    /// Whether the tank is empty: nothing fires any more.
    pub fn is_dry(&self) -> bool {
        self.used_kg >= self.initial_propellant_kg
    }

    /// An outside torque with that of the thrusters, and with jet damping where the inertia follows the propellant.
    pub(super) fn with_thrusters(&self, spinner: &Spinner, applied: &BodyTorque) -> BodyTorque {
        let law = &self.valves.law;
        if law.is_none() {
            return *applied;
        }
        let jet_damping = match self.mass_source {
            MassSource::Fixed => JetDamping::default(),
            MassSource::Propellant => self.valves.jet_damping(spinner),
        };
        applied.plus_linear(&law.torque_body_n_m, jet_damping, law.since_s)
    }

    /// Accumulates what the thrusters used and did since the last call; whether they did anything.
    pub(super) fn accumulate(
        &mut self,
        spinner: &Spinner,
        motion: &Motion,
        theory: &Spin,
        now_s: f64,
    ) -> bool {
        if self.valves.law.is_none() {
            return false;
        }
        self.delta_v_inertial_m_s = self.delta_v_at(spinner, motion, now_s);
        let ThrustLaw { since_s, torque_body_n_m, .. } = &self.valves.law;
        let inertia = &motion.inertia;
        let across = torque_body_n_m.map(|it| inertia.spin_frame_from_body(&it).xy().into());
        self.predicted.pulse(theory, across, *since_s, now_s);
        self.used_kg = self.used_at(now_s);
        true
    }

    /// Empties the tank at `now_s`; the flow up to there was accumulated before.
    pub(super) fn empty(&mut self, now_s: f64) {
        self.used_kg = self.initial_propellant_kg;
        self.valves.shut(now_s);
    }

    /// When the thrusters that are on empty the tank, in s; infinite while none is.
    pub(super) fn depletion_time_s(&self) -> f64 {
        let law = &self.valves.law;
        if law.is_none() {
            return f64::INFINITY;
        }
        let lasts_s = law.lasts_s(self.initial_propellant_kg - self.used_kg);
        // Edges are known to rounding: a pulse that takes the last drop ends by its own.
        let late_s = law.since_s.abs() + law.lasts_s(self.initial_propellant_kg);
        // What lasts for ever is not rounded.
        let rounding_s = if lasts_s.is_finite() && late_s.is_finite() { EDGE_ROUNDING * late_s } else { 0.0 };
        law.since_s + lasts_s + rounding_s
    }

    /// Inertia with the remaining propellant, of the body in `motion`.
    pub(super) fn inertia(&self, spinner: &Spinner, motion: &Motion) -> Inertia {
        if self.mass_source == MassSource::Fixed {
            return motion.inertia;
        }
        let remaining_kg = (self.initial_propellant_kg - self.used_kg).max(0.0);
        // The table was checked when it was read; the present body is the answer that cannot be refused.
        spinner.mass_properties.inertia(remaining_kg).unwrap_or(motion.inertia)
    }

    /// Propellant used until `time_s`, in kg.
    pub fn used_at(&self, time_s: f64) -> f64 {
        let law = &self.valves.law;
        if law.is_none() {
            return self.used_kg;
        }
        (self.used_kg + law.burnt_kg(time_s)).min(self.initial_propellant_kg)
    }

    /// Propellant on board at `time_s`, in kg.
    pub fn remaining_at(&self, time_s: f64) -> f64 {
        (self.initial_propellant_kg - self.used_at(time_s)).max(0.0)
    }

    /// Mass at `time_s`, in kg.
    pub fn mass_at_kg(&self, spinner: &Spinner, time_s: f64) -> f64 {
        spinner.mass_properties.dry_mass_kg + self.remaining_at(time_s)
    }

    /// Sums delta-v to the end of the motion's present segment.
    pub(super) fn close_segment(&mut self, spinner: &Spinner, motion: &Motion, work: &mut Work) {
        if !self.valves.law.is_none() {
            work.spend(WorkKind::Impulse);
            let end_s = motion.segment_end_s();
            self.delta_v_inertial_m_s = self.delta_v_at(spinner, motion, end_s);
            self.delta_v_until_s = end_s;
        }
    }

    /// Sums delta-v over the whole panels before `time_s` in a segment without end.
    ///
    /// # Errors
    /// More panels than the work allows.
    pub(super) fn sum_panels(
        &mut self,
        spinner: &Spinner,
        motion: &Motion,
        time_s: f64,
        work: &mut Work,
    ) -> Result<(), WorkExceeded> {
        let law = self.valves.law;
        if law.is_none() || !motion.segment_end_s().is_infinite() {
            return Ok(());
        }
        // Thrusters without torque: whole panels of the closed form, counted from when they continued.
        let rate = motion.at(motion.anchor_s()).rate_rad_s(&motion.inertia).norm();
        loop {
            let panel_end_s = self.delta_v_until_s.max(law.since_s) + IMPULSE_PANEL_RAD / rate;
            if panel_end_s.is_nan() || panel_end_s > time_s {
                return Ok(());
            }
            work.check(self.delta_v_until_s)?;
            work.spend(WorkKind::Impulse);
            self.delta_v_inertial_m_s = self.delta_v_at(spinner, motion, panel_end_s);
            self.delta_v_until_s = panel_end_s;
        }
    }

    /// Delta-v until `time_s` in the present segment, inertial, in m/s: the turning force over the mass at each instant.
    pub fn delta_v_at(&self, spinner: &Spinner, motion: &Motion, time_s: f64) -> Vector3<f64> {
        let law = &self.valves.law;
        if law.is_none() {
            return self.delta_v_inertial_m_s;
        }
        let from_s = self.delta_v_until_s.max(law.since_s);
        let mass_kg = self.mass_at_kg(spinner, from_s);
        let fall = math::ln(mass_kg / self.mass_at_kg(spinner, time_s));
        // Panels in which the mass falls by one factor, so that its reciprocal is smooth in each.
        let panels = (fall / IMPULSE_PANEL_MASS).ceil().max(1.0);
        let mut delta_v = self.delta_v_inertial_m_s;
        let mut start_s = from_s;
        for panel in 1..=panels as u32 {
            let fraction = f64::from(panel) / panels;
            let end_s = if fraction >= 1.0 {
                time_s
            } else if law.flow_kg_s[1] == 0.0 {
                from_s - mass_kg * math::exp_m1(-fall * fraction) / law.flow_kg_s[0]
            } else {
                from_s + (time_s - from_s) * fraction
            };
            for (at_s, weight_s) in IMPULSE_RULE.on(start_s, end_s) {
                let force_n = motion.at(at_s).attitude.inertial_from_body(&law.force_at_n(at_s));
                delta_v += force_n * (weight_s / self.mass_at_kg(spinner, at_s));
            }
            start_s = end_s;
        }
        delta_v
    }

    /// Rejects decoded thrusters and a tank that no simulation can produce by `latest_s`.
    pub(super) fn is_valid(&self, spinner: &Spinner, latest_s: f64) -> bool {
        // A tank that is never empty and holds nothing would be emptied without end.
        (0.0..=spinner.mass_properties.most_propellant_kg()).contains(&self.initial_propellant_kg)
            && (0.0..=self.initial_propellant_kg).contains(&self.used_kg)
            && self.delta_v_until_s <= latest_s
            && self.valves.is_valid(spinner, latest_s)
    }
}
