//! Motion of panels with a mass: how they turn over an interval, and how the body gives way to them.
//!
//! Equations: H = J w + h + what rotors hold, h the momentum of the panels relative to the body ([`crate::attitude::HingedMass`]).
//! Over an interval of the disturbance grid each panel turns from where it stands, at the rate of its law, to where its law has it
//! at the end, the body turning on as it does: quadratic in time, where its angle is set linear; h and J follow exactly ([`crate::attitude::InternalMotion`]). Where the law has it elsewhere
//! at an edge, because it was set anew or the body turned otherwise, all panels go there at once: with f the angles,
//! d(attitude) = -J(f)^-1 h(f) df along the straight way, H unchanged.
//! Method: the turn at once by the commutator-free part and commutator of Magnus at two Gauss nodes, in steps of a fixed size;
//! where the Sun gives an angle, which the turn of the body changes, by fixed-point iteration.
//! Order: 4 in the step.
//! Reference: Hairer, Lubich, Wanner, Geometric Numerical Integration, IV.7.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::{Attitude, Gyrostat, GyrostatMotion, HingedMass, InternalMotion, Quaternion};
use crate::numerics::quadrature::GAUSS_2;
use crate::spacecraft::{MassProperties, Panel, hinged_masses, with_panels};

use super::panel_turns::nearest_turns_rad;
use crate::numerics::scalar::Dual64;
use crate::plant::settings::panel_setting::{PanelSetting, SunAt};

/// Largest step along the way of a panel, in rad.
const STEP_RAD: f64 = 0.02;
/// Gauss nodes of a step.
const NODES: [f64; 2] = [GAUSS_2[0].0, GAUSS_2[1].0];
/// Greatest departure of a law from its rate at the start of an interval, in rad; beyond it the panel turns evenly.
const GREATEST_BEND_RAD: f64 = 0.5;
/// Rounds until angles that the Sun gives and the body's turn agree; each gains a share of the panels in the inertia.
const ROUNDS: usize = 40;
/// An attitude that changes by less counts as the same.
const SAME: f64 = 1e-15;

/// Panels by their laws.
#[derive(Clone, Copy)]
pub(crate) struct PanelLaws<'a> {
    pub settings: &'a [PanelSetting],
    pub panels: &'a [Panel],
    /// Mass properties of the whole with every panel at angle 0.
    pub stowed: &'a MassProperties,
}

/// One panel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
struct PanelTurn {
    /// At the start of the interval, in rad.
    angle_rad: f64,
    /// In rad/s.
    rate_rad_s: f64,
    /// In rad/s2.
    acceleration_rad_s2: f64,
    /// Angle by which it turned at once at the start of the interval, in rad.
    travel_rad: f64,
}

/// The panels over an interval.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PanelMotion {
    since_s: f64,
    turns: Vec<PanelTurn>,
}

impl PanelMotion {
    /// At the start of a flight, where the Sun moves like this.
    pub(crate) fn at_start(laws: PanelLaws<'_>, sun: &SunAt<Dual64>) -> Self {
        let turns = laws.settings.iter().zip(laws.panels).map(|(setting, panel)| {
            let [angle_rad, rate_rad_s] = setting.turn_rad(panel, sun);
            let rate_rad_s = if panel.mass.is_some() { rate_rad_s } else { 0.0 };
            PanelTurn { angle_rad, rate_rad_s, ..PanelTurn::default() }
        });
        Self { since_s: sun.time_s.re, turns: turns.collect() }
    }

    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self, panels: usize) -> bool {
        self.turns.len() == panels
    }

    /// Whether a panel turns.
    pub(crate) fn is_turning(&self) -> bool {
        self.turns.iter().any(|it| it.rate_rad_s != 0.0 || it.acceleration_rad_s2 != 0.0)
    }

    /// Angle of panel `index` at `time_s` in rad, its rate in rad/s and the change of that in rad/s2.
    fn turn_at(&self, index: usize, time_s: f64) -> [f64; 3] {
        let PanelTurn { angle_rad, rate_rad_s, acceleration_rad_s2, .. } =
            self.turns.get(index).copied().unwrap_or_default();
        let elapsed_s = time_s - self.since_s;
        let now_rad_s = rate_rad_s + acceleration_rad_s2 * elapsed_s;
        [angle_rad + 0.5 * (rate_rad_s + now_rad_s) * elapsed_s, now_rad_s, acceleration_rad_s2]
    }

    /// Mass properties at `time_s` of a whole that has `at_zero` with every panel at angle 0.
    pub(crate) fn mass_properties(
        &self,
        at_zero: &MassProperties,
        panels: &[Panel],
        time_s: f64,
    ) -> MassProperties {
        with_panels(at_zero, panels, |index| self.turn_at(index, time_s)[0])
    }

    /// Motion of the panels inside a body of these mass properties from `time_s` on; `None` where none turns.
    pub(crate) fn internal(
        &self,
        panels: &[Panel],
        mass: &MassProperties,
        time_s: f64,
    ) -> Option<InternalMotion> {
        let masses = hinged_masses(panels, |index| self.turn_at(index, time_s));
        self.is_turning().then(|| InternalMotion::new(masses, mass.mass_kg, &mass.center_of_mass_body_m))
    }

    /// At the end of `motion` all panels go at once to where their laws have them, the Sun being there (EME2000, in m), and the body
    /// gives way: its attitude then, or `None` where all are there already. The body of `motion` has the mass properties there.
    pub(crate) fn track_law(
        &mut self,
        laws: PanelLaws<'_>,
        gyrostat: &mut Gyrostat,
        motion: &GyrostatMotion,
        to_sun_m: &Vector3<f64>,
    ) -> Option<Quaternion> {
        let time_s = motion.end_s();
        let start = motion.attitude_at(time_s);
        for index in 0..self.turns.len() {
            let [angle_rad, rate_rad_s, _] = self.turn_at(index, time_s);
            if let Some(turn) = self.turns.get_mut(index) {
                (turn.angle_rad, turn.rate_rad_s) = (angle_rad, rate_rad_s);
            }
        }
        self.since_s = time_s;
        let mut attitude = start;
        let (to_sun, distance_m) = (to_sun_m.normalize(), to_sun_m.norm());
        let sun = |attitude: &Quaternion| SunAt {
            time_s,
            direction_body: attitude.body_from_inertial(&to_sun),
            distance_m,
        };
        for _ in 0..ROUNDS {
            if !self.point_at(laws, &sun(&attitude)) {
                break;
            }
            let before = core::mem::replace(&mut attitude, self.body_reaction(laws, gyrostat, motion, start));
            let change = before.0.iter().zip(&attitude.0).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let by_sun = laws.settings.iter().any(|setting| setting.is_by_sun());
            if !by_sun || change < SAME {
                break;
            }
        }
        let moved = self.turns.iter().any(|it| it.travel_rad != 0.0);
        self.snap_to_law(laws, &sun(&attitude));
        moved.then_some(attitude)
    }

    /// From the `sun` of now to that of the `end` the panels turn to where their laws have them then.
    pub(crate) fn turn_until(&mut self, laws: PanelLaws<'_>, sun: &SunAt<Dual64>, end: &SunAt) {
        let span_s = end.time_s - self.since_s;
        for (turn, (setting, panel)) in self.turns.iter_mut().zip(laws.settings.iter().zip(laws.panels)) {
            (turn.rate_rad_s, turn.acceleration_rad_s2) = (0.0, 0.0);
            if panel.mass.is_none() || span_s <= 0.0 {
                continue;
            }
            [_, turn.rate_rad_s] = setting.turn_rad(panel, sun);
            if setting.is_by_sun() {
                let to_rad = setting.angle_rad(panel, end).unwrap_or(0.0);
                let travel_rad = shorter_travel_rad(turn.angle_rad, to_rad);
                let bend_rad = travel_rad - turn.rate_rad_s * span_s;
                if bend_rad.abs() < GREATEST_BEND_RAD {
                    turn.acceleration_rad_s2 = 2.0 * bend_rad / (span_s * span_s);
                } else {
                    turn.rate_rad_s = travel_rad / span_s;
                }
            }
        }
    }

    /// Looks how far each panel has to go; whether one has to at all.
    fn point_at(&mut self, laws: PanelLaws<'_>, sun: &SunAt) -> bool {
        for (turn, (setting, panel)) in self.turns.iter_mut().zip(laws.settings.iter().zip(laws.panels)) {
            let to_rad = setting.angle_rad(panel, sun).unwrap_or(0.0);
            turn.travel_rad =
                if panel.mass.is_some() { shorter_travel_rad(turn.angle_rad, to_rad) } else { 0.0 };
        }
        self.turns.iter().any(|it| it.travel_rad != 0.0)
    }

    /// All panels stand where their laws have them.
    fn snap_to_law(&mut self, laws: PanelLaws<'_>, sun: &SunAt) {
        for (turn, (setting, panel)) in self.turns.iter_mut().zip(laws.settings.iter().zip(laws.panels)) {
            if turn.travel_rad != 0.0 {
                turn.angle_rad = setting.angle_rad(panel, sun).unwrap_or(0.0);
            }
        }
    }

    /// The attitude after all panels went their way at once.
    fn body_reaction(
        &self,
        laws: PanelLaws<'_>,
        gyrostat: &mut Gyrostat,
        motion: &GyrostatMotion,
        start: Quaternion,
    ) -> Quaternion {
        let longest_rad = self.turns.iter().map(|it| it.travel_rad.abs()).fold(0.0, f64::max);
        let steps = (longest_rad / STEP_RAD).ceil().max(1.0);
        let count = steps as u32;
        let PanelLaws { panels, stowed, .. } = laws;
        let mut turn_rate_rad = |share: f64| {
            let part = |index: usize| self.turns.get(index).copied().unwrap_or_default();
            let angle_rad = |index: usize| part(index).angle_rad + share * part(index).travel_rad;
            let mass = with_panels(stowed, panels, angle_rad);
            gyrostat.set_mass_properties(mass.inertia_body_kg_m2, mass.center_of_mass_body_m);
            let masses = hinged_masses(panels, |index| [angle_rad(index), part(index).travel_rad, 0.0]);
            let momentum: Vector3<f64> =
                masses.map(|it: HingedMass| it.momentum_body_n_m_s(&mass.center_of_mass_body_m)).sum();
            -(motion.inverse_inertia_of(gyrostat) * momentum) / steps
        };
        let mut attitude = Attitude::from_unit(start);
        for step in 0..count {
            let [a, b] = NODES.map(|node| turn_rate_rad((f64::from(step) + node) / steps));
            attitude = attitude.turned((a + b) * 0.5 + a.cross(&b) * (3.0_f64.sqrt() / 12.0));
        }
        attitude.unit_quaternion().normalized()
    }
}

/// The way between two angles, which say nothing of whole turns, in rad: the shorter one.
fn shorter_travel_rad(from_rad: f64, to_rad: f64) -> f64 {
    let travel_rad = to_rad - from_rad;
    travel_rad - nearest_turns_rad(travel_rad)
}
