//! The strategies where guidance is sampled: momentum comes from outside, the span of the downlink from its windows.
//!
//! Momentum along the body axes, where it stays in EME2000, is turned there by the estimated attitude. A sample has no forecast:
//! every downlink aims at the one target.

use nalgebra::Vector3;

use super::strategy::{Manager, Strategy};
use super::targeting::Aim;
use crate::guidance::{ChosenPlace, DownlinkStart, SunChooser};
use crate::momentum::Convention;
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
    /// Along the body axes, in N m s.
    pub momentum_body_n_m_s: Vector3<f64>,
}

impl SunChooser for SampledManager<'_> {
    fn choose(&self, start: &DownlinkStart) -> Option<ChosenPlace> {
        if self.manager.strategy == Strategy::DumpsOnly {
            return None;
        }
        let craft = &self.craft;
        let pressure_pa = self.light.pressure_pa(start.to_sun_m.norm());
        let momentum = match self.convention {
            Convention::Inertial => {
                StartMomentum::Inertial(start.attitude.inertial_from_body() * self.momentum_body_n_m_s)
            }
            Convention::BodyIntegral => StartMomentum::Body(self.momentum_body_n_m_s),
        };
        let torque = |sun_body: &Vector3<f64>| craft.torque_body_n_m(sun_body, pressure_pa);
        let aim = Aim {
            to_sun: start.to_sun_m.try_normalize(0.0)?,
            to_earth: start.to_earth_m.try_normalize(0.0)?,
            momentum,
            span_s: start.span_s,
            torque_body_n_m: &torque,
            linear: self.manager.linear(&craft.center_of_mass_body_m()).map(|formula| (formula, pressure_pa)),
        };
        self.manager.place(&aim, None)
    }
}
