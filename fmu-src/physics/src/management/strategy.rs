//! Strategies of paper 000: dumps alone, reactive targets, predictive targets.
//!
//! Reactive: every downlink aims at the same momentum. Predictive: every downlink aims at the momentum from which the coming
//! cycles, forecast in their default attitudes, keep its components smallest; without a cycle to come it is reactive. Components
//! that are integrated on their own are looked at one by one over the whole horizon ([`super::profile`]); the physical
//! momentum, under which the body turns, over the next science ([`super::turning`]).

use nalgebra::{Rotation3, Vector3};

use super::linear::LinearTorque;
use super::profile::{Reach, Swing, best_target};
use super::targeting::{Aim, Targeted, Targeting};
use super::turning::{Turned, best_turned};
use crate::guidance::ChosenPlace;
use crate::momentum::Convention;
use crate::plant::{Outlook, PlantError, StartMomentum, SunPlanner};
use crate::radiation::TorquePolynomial;
use crate::spacecraft::{Sunshade, SunshadeModel};

/// What sunlight is used for.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Strategy {
    /// Nothing: downlinks have the Sun on -Y.
    #[default]
    DumpsOnly,
    /// To bring the momentum to one target.
    Reactive,
    /// To bring it where the coming cycles keep it smallest.
    Predictive,
}

/// A strategy with all it needs of parameters and spacecraft.
#[derive(Clone, Copy, Debug)]
pub struct Manager<'a> {
    /// Strategy.
    pub strategy: Strategy,
    /// Axes, formula, limits.
    pub targeting: Targeting,
    /// Momentum a reactive downlink aims at, body frame, in N m s.
    pub target_body_n_m_s: Vector3<f64>,
    /// How many cycles ahead predictive targets look.
    pub horizon: u32,
    /// The shade, for the linear formula.
    pub sunshade: Option<(&'a Sunshade, SunshadeModel)>,
}

/// Samples of a forecast a cycle.
const SAMPLES: f64 = 96.0;

impl SunPlanner for Manager<'_> {
    fn choose(&self, outlook: &mut Outlook<'_>) -> Result<Option<ChosenPlace>, PlantError> {
        let Some(to_earth) = outlook.to_earth.filter(|_| self.strategy != Strategy::DumpsOnly) else {
            return Ok(None);
        };
        let is_predictive = self.strategy == Strategy::Predictive;
        let turns = outlook.convention() == Convention::Inertial;
        let swings = if is_predictive && !turns { self.swings(outlook)? } else { Vec::new() };
        let science = if is_predictive && turns { science_ahead(outlook)? } else { None };
        let linear = self.linear(&outlook.center_of_mass_body_m());
        let threshold = outlook.threshold_body_n_m_s();
        let torque = |sun_body: &Vector3<f64>| outlook.torque_body_n_m(sun_body);
        let mut aim = Aim {
            to_sun: outlook.to_sun,
            to_earth,
            momentum: outlook.momentum,
            span_s: outlook.span_s,
            torque_body_n_m: &torque,
            linear: linear.map(|formula| (formula, outlook.pressure_pa)),
        };
        let target = match (&science, aim.momentum) {
            (Some(science), StartMomentum::Inertial(momentum)) => {
                // A target in the body would be another one under the other antenna: what is off it in space is brought to zero.
                self.turned(&aim, science, &threshold).map(|end_body| {
                    let end = science.inertial_from_body * end_body;
                    aim.momentum = StartMomentum::Inertial(momentum - end);
                    Vector3::zeros()
                })
            }
            _ => self.predicted(&aim, &swings, &threshold),
        };
        Ok(self.place(&aim, target))
    }
}

impl Manager<'_> {
    /// The shade's linear formula about this centre of mass; `None` without a shade.
    pub(super) fn linear(&self, center_of_mass_body_m: &Vector3<f64>) -> Option<LinearTorque> {
        let (shade, model) = self.sunshade?;
        let polynomial = TorquePolynomial::of_sunshade(shade, model, center_of_mass_body_m).ok()?;
        Some(LinearTorque::new(&polynomial, shade.dcm_body_from_shade))
    }

    /// Where the Sun is to stand for a predicted target, or else the one target; `None` where no place is admissible.
    pub(super) fn place(&self, aim: &Aim<'_>, predicted: Option<Vector3<f64>>) -> Option<ChosenPlace> {
        let targeted = self.targeting.sun_place(aim, &predicted.unwrap_or(self.target_body_n_m_s));
        targeted.map(|Targeted { place, clamped }| ChosenPlace { place, clamped })
    }

    /// What each coming span of science does to the momentum, by component.
    fn swings(&self, outlook: &mut Outlook<'_>) -> Result<Vec<[Swing; 3]>, PlantError> {
        let cycle_s = outlook.cycle_s();
        let mut swings: Vec<[Swing; 3]> = Vec::new();
        if !cycle_s.is_finite() || cycle_s <= 0.0 {
            return Ok(swings);
        }
        let until_s = outlook.time_s + f64::from(self.horizon) * cycle_s;
        let (mut base, mut was_downlink) = (Vector3::zeros(), true);
        outlook.forecast(until_s, cycle_s / SAMPLES, |at| {
            if at.downlink {
                base = at.momentum_body_n_m_s;
            } else {
                if was_downlink {
                    swings.push([Swing::default(); 3]);
                }
                if let Some(last) = swings.last_mut() {
                    for (axis, swing) in last.iter_mut().enumerate() {
                        swing.note(at.momentum_body_n_m_s[axis] - base[axis]);
                    }
                }
            }
            was_downlink = at.downlink;
        })?;
        Ok(swings)
    }

    /// The target that keeps the momentum of the coming cycles smallest; `None` without such a cycle.
    fn predicted(
        &self,
        aim: &Aim<'_>,
        swings: &[[Swing; 3]],
        threshold: &Vector3<f64>,
    ) -> Option<Vector3<f64>> {
        if swings.is_empty() {
            return None;
        }
        let now = self.targeting.default_momentum(aim)?;
        let [along_x, along_z] = self.targeting.reach(aim)?;
        let best = |axis: usize, reach: Reach| {
            let along: Vec<Swing> = swings.iter().map(|swing| swing[axis]).collect();
            best_target(now[axis], reach, &along, threshold[axis])
        };
        Some(Vector3::new(best(0, along_x), 0.0, best(2, along_z)))
    }

    /// The target that keeps the momentum of the next science smallest.
    fn turned(
        &self,
        aim: &Aim<'_>,
        science: &ScienceAhead,
        threshold: &Vector3<f64>,
    ) -> Option<Vector3<f64>> {
        let now = self.targeting.default_momentum(aim)?;
        let reach = self.targeting.reach(aim)?;
        let end = science.end_body_n_m_s;
        let range = |axis: usize, reach: Reach, asked: bool| {
            // Under the other antenna the body stands half a turn about the Sun line away.
            let [least, most] = [reach[0].min(-reach[1]), reach[1].max(-reach[0])];
            if asked { [now[axis] + least, now[axis] + most] } else { [end[axis]; 2] }
        };
        let [by_x, by_z] = self.targeting.axes.asked();
        let ranges = [range(0, reach[0], by_x), range(2, reach[1], by_z)];
        Some(best_turned(&science.along, ranges, end.y, threshold))
    }
}

/// The science after a downlink in its default attitude.
struct ScienceAhead {
    /// Momentum at the downlink's end, body frame, in N m s.
    end_body_n_m_s: Vector3<f64>,
    inertial_from_body: Rotation3<f64>,
    along: Vec<Turned>,
}

/// The next science; `None` where none follows.
fn science_ahead(outlook: &mut Outlook<'_>) -> Result<Option<ScienceAhead>, PlantError> {
    let cycle_s = outlook.cycle_s();
    if !cycle_s.is_finite() || cycle_s <= 0.0 {
        return Ok(None);
    }
    let until_s = outlook.time_s + cycle_s;
    let (mut left, mut has_ended) = (None, false);
    let mut along = Vec::new();
    outlook.forecast(until_s, cycle_s / SAMPLES, |at| {
        if at.downlink {
            has_ended |= !along.is_empty();
            if !has_ended {
                left = Some(at);
            }
        } else if let Some(left) = left.filter(|_| !has_ended) {
            let turn = at.body_from_inertial * left.body_from_inertial.inverse();
            let added = at.momentum_inertial_n_m_s - left.momentum_inertial_n_m_s;
            let added_body_n_m_s = at.body_from_inertial * added;
            along.push(Turned { turn: turn.into_inner(), added_body_n_m_s });
        }
    })?;
    let left = left.filter(|_| !along.is_empty());
    Ok(left.map(|left| ScienceAhead {
        end_body_n_m_s: left.momentum_body_n_m_s,
        inertial_from_body: left.body_from_inertial.inverse(),
        along,
    }))
}
