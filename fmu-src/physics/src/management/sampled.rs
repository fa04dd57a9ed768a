//! The strategies where guidance is sampled: momentum comes from outside, the span of the downlink from its windows.
//!
//! Momentum along the body axes, where it stays in EME2000, is turned there by the estimated attitude.

use nalgebra::Vector3;

use super::ahead::Ahead;
use super::sampled_forecast::SampledForecast;
use super::strategy::{Manager, Strategy};
use super::targeting::Aim;
use crate::attitude::angle_between_rad;
use crate::guidance::geometry::moving::value;
use crate::guidance::{ChosenPlace, DownlinkStart, Guided, OrbitAhead, Schedule, SunChooser};
use crate::momentum::{Convention, DumpPolicy, Totals};
use crate::numerics::intervals::sampled_range;
use crate::plant::{StartMomentum, SunLight, SunlitCraft};

/// A manager with what a sample knows.
#[derive(Clone, Copy, Debug)]
pub struct SampledManager<'a> {
    /// Strategy and target.
    pub manager: Manager<'a>,
    /// What the light meets.
    pub craft: SunlitCraft<'a>,
    /// Sunlight.
    pub light: SunLight,
    /// What the momentum means.
    pub convention: Convention,
    /// When thrusters dump, and what they leave.
    pub policy: DumpPolicy,
    /// Along the body axes, in N m s.
    pub momentum_body_n_m_s: Vector3<f64>,
}

impl SunChooser for SampledManager<'_> {
    fn choose(&self, start: &DownlinkStart<'_>) -> Option<ChosenPlace> {
        if self.manager.strategy == Strategy::DumpsOnly {
            return None;
        }
        let craft = &self.craft;
        let [to_sun_m, to_earth_m] =
            [start.surroundings.to_sun(), start.surroundings.to_earth()].map(|it| value(&it));
        let pressure_pa = self.light.pressure_pa(to_sun_m.norm());
        let totals = Totals::at_start(self.momentum_body_n_m_s, &start.attitude.inertial_from_body());
        let torque = |sun_body: &Vector3<f64>| craft.torque_body_n_m(sun_body, pressure_pa);
        let aim = Aim {
            to_sun: to_sun_m.try_normalize(0.0)?,
            to_earth: to_earth_m.try_normalize(0.0)?,
            momentum: StartMomentum::of(&totals, self.convention),
            span_s: start.span_s,
            torque_body_n_m: &torque,
            pressure_pa,
            linear: self.manager.linear(&craft.center_of_mass_body_m()),
        };
        let separations_rad = separations_rad(start);
        self.manager.place(aim, self.ahead(start, totals).as_ref(), separations_rad)
    }
}

/// Least and greatest angle between Sun and Earth while the downlink lasts, in rad; that at its begin where the spacecraft is on
/// no ellipse about its planet.
fn separations_rad(start: &DownlinkStart<'_>) -> [f64; 2] {
    let orbit = OrbitAhead::of(start.surroundings);
    let at = |share: f64| {
        let epoch_s = start.surroundings.epoch_s + start.span_s * share;
        let then = orbit.map_or(*start.surroundings, |orbit| orbit.at(epoch_s));
        angle_between_rad(&value(&then.to_sun()), &value(&then.to_earth()))
    };
    sampled_range(at)
}

/// Units of about a microsecond that targeting takes at most.
const TARGETING_WORK: u32 = 5_000;
/// Units that a cycle of a forecast takes at most.
const CYCLE_WORK: u32 = 2_000;

impl SampledManager<'_> {
    /// Units of about a microsecond that a choice takes at most.
    pub fn work(&self) -> u32 {
        match self.manager.strategy {
            Strategy::DumpsOnly => 0,
            Strategy::Reactive => TARGETING_WORK,
            Strategy::Predictive => TARGETING_WORK + self.manager.horizon.saturating_mul(CYCLE_WORK),
        }
    }

    /// What lies ahead; nothing where the spacecraft is on no ellipse about its planet.
    fn ahead(&self, start: &DownlinkStart<'_>, totals: Totals) -> Option<Ahead> {
        if self.manager.strategy != Strategy::Predictive {
            return None;
        }
        let orbit = OrbitAhead::of(start.surroundings)?;
        let schedule = Schedule { period_s: orbit.period_s(), ..start.law.schedule };
        let mut forecast = SampledForecast {
            orbit,
            law: Guided { schedule, ..start.law },
            craft: self.craft,
            light: self.light,
            convention: self.convention,
            policy: self.policy,
            totals,
            begin_s: start.surroundings.epoch_s,
            span_s: start.span_s,
        };
        let Ok(ahead) = self.manager.ahead(&mut forecast);
        ahead
    }
}
