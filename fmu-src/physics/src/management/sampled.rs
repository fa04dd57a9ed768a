//! The strategies where guidance is sampled: momentum comes from outside, the span of the downlink from its windows.
//!
//! Momentum along the body axes, where it stays in EME2000, is turned there by the estimated attitude.

use nalgebra::Vector3;

use super::prediction::{ForecastTerms, Prediction};
use super::sampled_forecast::SampledForecast;
use super::strategy::{Manager, Strategy};
use super::targeting::{DownlinkState, ScienceUnload};
use crate::attitude::angle_between_rad;
use crate::guidance::downlink::default_downlink::DefaultDownlink;
use crate::guidance::geometry::moving::value;
use crate::guidance::{
    Activity, ArcPoint, Guided, PredictedOrbit, ScienceArc, ScienceRule, SelectedSunDirection, WindowStart,
};
use crate::momentum::{Convention, DumpPolicy, Totals};
use crate::numerics::intervals::sampled_range;
use crate::plant::{StartMomentum, SunLight, SunlitConfiguration};

/// A manager with what a sample knows.
#[derive(Clone, Copy, Debug)]
pub struct SampledManager<'a> {
    /// Strategy and target.
    pub manager: Manager<'a>,
    /// The default downlink of the spacecraft's antennas.
    pub default_downlink: &'a DefaultDownlink,
    /// Spacecraft in sunlight.
    pub spacecraft: SunlitConfiguration<'a>,
    /// Sunlight.
    pub light: SunLight,
    /// Convention of the momentum.
    pub convention: Convention,
    /// When thrusters dump, and what they leave.
    pub policy: DumpPolicy,
    /// Along the body axes, in N m s.
    pub momentum_body_n_m_s: Vector3<f64>,
}

impl SampledManager<'_> {
    /// The Sun's place where a downlink begins, or science that unloads; `None` where it is to stand on -Y.
    pub fn choose(&self, start: &WindowStart<'_>) -> Option<SelectedSunDirection> {
        if self.manager.strategy == Strategy::DumpsOnly {
            return None;
        }
        let spacecraft = &self.spacecraft;
        let [to_sun_m, to_earth_m] =
            [start.ephemeris.to_sun(), start.ephemeris.to_earth()].map(|it| value(&it));
        let pressure_pa = self.light.pressure_pa(to_sun_m.norm());
        let totals = Totals::at_start(self.momentum_body_n_m_s, &start.attitude.inertial_from_body());
        let torque = |sun_body: &Vector3<f64>| spacecraft.torque_body_n_m(sun_body, pressure_pa);
        let science = self.science_arc(start);
        let state = DownlinkState {
            to_sun: to_sun_m.try_normalize(0.0)?,
            to_earth: to_earth_m.try_normalize(0.0)?,
            momentum: StartMomentum::from_totals(&totals, self.convention),
            span_s: science.as_ref().map_or(start.span_s, ScienceArc::light_s),
            torque_body_n_m: &torque,
            pressure_pa,
            linear: self.manager.linear(spacecraft.solar.materials(), &spacecraft.center_of_mass_body_m()),
            science: science.as_ref().map(|arc| ScienceUnload { arc, convention: self.convention }),
        };
        let separations_rad = separations_rad(start);
        self.manager.place(state, self.predict(start, totals).as_ref(), separations_rad)
    }
}

/// Least and greatest angle between Sun and Earth while the downlink lasts, in rad; that at its begin where the spacecraft is on
/// no ellipse about its planet.
fn separations_rad(start: &WindowStart<'_>) -> [f64; 2] {
    let orbit = PredictedOrbit::new(start.ephemeris);
    let at = |share: f64| {
        let epoch_s = start.ephemeris.epoch_s + start.span_s * share;
        let then = orbit.map_or(*start.ephemeris, |orbit| orbit.at(epoch_s));
        angle_between_rad(&value(&then.to_sun()), &value(&then.to_earth()))
    };
    sampled_range(at)
}

/// Units of about a microsecond that targeting takes at most.
const TARGETING_WORK: u32 = 5_000;
/// Units that targeting takes at most in science that unloads: each of its trials goes through all of it.
const SCIENCE_WORK: u32 = 100_000;
/// Units that a cycle of a forecast takes at most.
const CYCLE_WORK: u32 = 2_000;

impl SampledManager<'_> {
    /// Units of about a microsecond that a choice takes at most, where science unloads or not.
    pub fn work(&self, unloads: bool) -> u32 {
        let targeting = if unloads { SCIENCE_WORK } else { TARGETING_WORK };
        match self.manager.strategy {
            Strategy::DumpsOnly => 0,
            Strategy::Reactive => targeting,
            Strategy::Predictive => targeting + self.manager.horizon.saturating_mul(CYCLE_WORK),
        }
    }

    /// The science that begins; `None` where a downlink does.
    fn science_arc(&self, start: &WindowStart<'_>) -> Option<ScienceArc> {
        let ScienceRule::Unloading { gimbal, .. } = start.law.science else { return None };
        if start.activity == Activity::Downlink {
            return None;
        }
        let orbit = PredictedOrbit::new(start.ephemeris);
        Some(ScienceArc::new(gimbal, start.span_s, |share| {
            let epoch_s = start.ephemeris.epoch_s + start.span_s * share;
            let then = orbit.map_or(*start.ephemeris, |orbit| orbit.at(epoch_s));
            let to_sun_m = value(&then.to_sun());
            ArcPoint {
                to_sun_m,
                to_planet_m: value(&then.to_planet()),
                pressure_pa: self.light.pressure_pa(to_sun_m.norm()),
            }
        }))
    }

    /// Forecast of the coming cycles; `None` where the spacecraft is on no ellipse about its planet.
    fn predict(&self, start: &WindowStart<'_>, totals: Totals) -> Option<Prediction> {
        if self.manager.strategy != Strategy::Predictive {
            return None;
        }
        let orbit = PredictedOrbit::new(start.ephemeris)?;
        let schedule = start.law.schedule.in_orbit(orbit.period_s());
        let mut forecast = SampledForecast {
            orbit,
            law: Guided { schedule, ..start.law },
            default_downlink: self.default_downlink,
            spacecraft: self.spacecraft,
            light: self.light,
            totals,
            terms: ForecastTerms {
                begin_s: start.ephemeris.epoch_s,
                cycle_s: schedule.cycle_s(),
                span_s: start.span_s,
                begins_in_science: start.activity == Activity::Science,
                downlink_s: schedule.downlink_s(),
                convention: self.convention,
                policy: self.policy,
            },
        };
        let Ok(prediction) = self.manager.predict(&mut forecast);
        prediction
    }
}
