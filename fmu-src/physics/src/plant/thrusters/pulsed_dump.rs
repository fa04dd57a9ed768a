//! Dump by pulses: which thrusters open for how long, from one decision to the next.
//!
//! Method: what is left of the impulse is shared out by the selection, as much at a time as the mean torque allows. A thruster
//! whose share is less than its valve's shortest pulse owes it until it is not. At the end, where all is shared out, the pulses are
//! taken one after another that come nearest to the residual, a few times, as pulses scatter and the body turns under them.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::Quaternion;
use crate::propulsion::ThrusterSelection;
use crate::spacecraft::MOST_THRUSTERS;

use super::thruster_load::ThrusterTotals;
use crate::plant::settings::reaction_control_settings::Feed;

/// A pulse at the end of a dump leaves less than this share of what was left.
const NEARER: f64 = 0.7;
/// How often the end of a dump is corrected: pulses scatter, and the body turns under them.
const MOST_CORRECTIONS: u8 = 4;

/// The current dump by pulses, or the last one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct PulsedDump {
    /// Target of the total momentum, EME2000, in N m s.
    pub(crate) target_inertial_n_m_s: Vector3<f64>,
    pub(crate) attitude_at_start: Quaternion,
    pub(crate) before: ThrusterTotals,
    /// Totals when it ended; absent while it lasts.
    pub(crate) after: Option<ThrusterTotals>,
    /// When pulses are next decided, in s.
    pub(crate) next_s: f64,
    /// Time that each thruster owes of its decided pulses, in s of full thrust: less than its shortest pulse.
    pub(crate) residual_s: [f64; MOST_THRUSTERS],
    /// How often the end was corrected.
    pub(crate) corrections: u8,
    /// Whether the current pulses are the last.
    pub(crate) is_last: bool,
    /// Mean torque of the current pulses, body frame, in N m.
    pub(crate) mean_torque_body_n_m: Vector3<f64>,
}

impl PulsedDump {
    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        let norm: f64 = self.attitude_at_start.0.iter().map(|x| x * x).sum();
        (norm - 1.0).abs() < 1e-9 && self.residual_s.iter().all(|residual_s| *residual_s >= 0.0)
    }

    /// Decides the pulses now: for how long each thruster opens, where this is left to give, body frame, in N m s.
    pub(crate) fn decide(
        &mut self,
        feed: &Feed<'_>,
        selection: &ThrusterSelection,
        left_body_n_m_s: &Vector3<f64>,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> [f64; MOST_THRUSTERS] {
        let Feed { settings, time_s, .. } = *feed;
        let torque = |k: usize| settings.thrusters[k].torque_about_n_m(center_of_mass_body_m);
        let shortest_s = |k: usize| settings.thrusters[k].valve.min_on_s;
        let most_n_m_s = settings.dump_torque_n_m * settings.dump_period_s;
        // A thruster that is no longer fed leaves what it owes to the others.
        for (k, residual_s) in self.residual_s.iter_mut().enumerate().take(settings.thrusters.len()) {
            *residual_s = if feed.feeds(k) { *residual_s } else { 0.0 };
        }
        let residual_n_m_s = |residual_s: &[f64; MOST_THRUSTERS]| -> Vector3<f64> {
            (0..settings.thrusters.len()).map(|k| torque(k) * residual_s[k]).sum()
        };
        let new_body_n_m_s = left_body_n_m_s - residual_n_m_s(&self.residual_s);
        let part = (most_n_m_s / new_body_n_m_s.amax()).min(1.0);
        let mut opened_s = [0.0; MOST_THRUSTERS];
        let mut given_body_n_m_s = Vector3::zeros();
        for (k, full_s) in selection.on_times_s(&new_body_n_m_s).enumerate() {
            self.residual_s[k] += full_s * part;
            let on_s = feed.opens_for_s(k, self.residual_s[k]);
            if on_s > 0.0 && on_s >= shortest_s(k) {
                given_body_n_m_s += torque(k) * self.residual_s[k];
                (opened_s[k], self.residual_s[k]) = (on_s, 0.0);
            }
        }
        if part == 1.0 {
            // All that is left is residual, each thruster less than its shortest pulse: those that come nearest.
            let shortest = |k: usize| {
                let full_s = settings.thrusters[k].valve.full_thrust_s(shortest_s(k));
                torque(k) * (full_s * feed.pressure_ratio(k))
            };
            let mut left = residual_n_m_s(&self.residual_s);
            let pulses = (0..settings.thrusters.len()).filter(|k| selection.uses(*k) && shortest_s(*k) > 0.0);
            loop {
                let free = pulses.clone().filter(|k| opened_s[*k] == 0.0);
                let nearest = free
                    .map(|k| (k, (left - shortest(k)).norm()))
                    .min_by(|(_, one), (_, other)| one.total_cmp(other));
                let Some((k, _)) = nearest.filter(|(_, distance)| *distance < NEARER * left.norm()) else {
                    break;
                };
                opened_s[k] = shortest_s(k);
                left -= shortest(k);
                given_body_n_m_s += shortest(k);
            }
            self.residual_s = [0.0; MOST_THRUSTERS];
            self.corrections += 1;
            // Valves without a shortest pulse leave nothing over, others what no pulse brings nearer.
            let is_exact = pulses.count() == 0;
            let is_done = given_body_n_m_s == Vector3::zeros() || self.corrections >= MOST_CORRECTIONS;
            self.is_last = is_exact || is_done;
        }
        // A pulse that gives more than the mean torque allows is followed by a longer pause.
        let pause_s = settings.dump_period_s.max(given_body_n_m_s.amax() / settings.dump_torque_n_m);
        self.mean_torque_body_n_m = given_body_n_m_s / pause_s;
        self.next_s = time_s + pause_s;
        opened_s
    }
}
