//! The strategies where guidance is sampled: momentum comes from outside, the span of the downlink from its windows.
//!
//! Momentum along the body axes, where it stays in EME2000, is turned there by the estimated attitude. The forecast knows no more
//! than a sample and its own windows.
//!
//! Assumptions: the orbit ahead is [`PredictedOrbit`]; science and downlink follow the windows of the orbit phase in its attitudes,
//! whatever is commanded; direct sunlight without shadows is all that acts.
//! Method: torque by Gauss-Legendre quadrature of order 6 on intervals that end where a window or a slew does.
//! Error measure: none at run time; where sunlight alone acts, choices differ from a plant's by less than 3e-5 rad (tested).

use core::convert::Infallible;

use nalgebra::Vector3;

use super::prediction::{Forecast, ForecastTerms, Prediction};
use super::strategy::{Manager, Strategy};
use super::targeting::{DownlinkState, ScienceUnload};
use crate::attitude::angle_between_rad;
use crate::guidance::downlink::default_downlink::DefaultDownlink;
use crate::guidance::geometry::moving::value;
use crate::guidance::{
    Activity, ArcPoint, EphemerisAtTime, Guided, GuidedAttitude, OrbitPhaseLaw, PredictedOrbit, ScienceArc,
    ScienceRule, SelectedSunDirection, WindowStart,
};
use crate::momentum::{Convention, DumpPolicy, Totals};
use crate::numerics::intervals::sampled_range;
use crate::numerics::quadrature::GAUSS_3;
use crate::plant::{ForecastMomentum, StartMomentum, SunLight, SunlitConfiguration};

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
        let at = ephemeris_ahead(start);
        let separation_rad =
            |it: EphemerisAtTime| angle_between_rad(&value(&it.to_sun()), &value(&it.to_earth()));
        let state = DownlinkState {
            to_sun: to_sun_m.try_normalize(0.0)?,
            to_earth: to_earth_m.try_normalize(0.0)?,
            separations_rad: sampled_range(|fraction| separation_rad(at(fraction))),
            momentum: StartMomentum::from_totals(&totals, self.convention),
            span_s: science.as_ref().map_or(start.span_s, ScienceArc::light_s),
            torque_body_n_m: &torque,
            pressure_pa,
            linear: self.manager.linear(spacecraft.solar.materials(), &spacecraft.center_of_mass_body_m()),
            science: science.as_ref().map(|arc| ScienceUnload { arc, convention: self.convention }),
        };
        self.manager.place(state, self.predict(start, totals).as_ref())
    }
}

/// Ephemeris at a fraction of the window; that at its begin where the spacecraft is on no ellipse about its planet.
fn ephemeris_ahead(start: &WindowStart<'_>) -> impl Fn(f64) -> EphemerisAtTime {
    let (now, span_s, orbit) = (start.ephemeris, start.span_s, PredictedOrbit::new(start.ephemeris));
    move |fraction| orbit.map_or(*now, |orbit| orbit.at(now.epoch_s + span_s * fraction))
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
        let at = ephemeris_ahead(start);
        Some(ScienceArc::new(gimbal, start.span_s, |fraction| {
            let then = at(fraction);
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
            manager: self,
            orbit,
            law: OrbitPhaseLaw {
                guided: Guided { schedule, ..start.law },
                default_downlink: self.default_downlink,
            },
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

/// Momentum ahead by sunlight alone.
#[derive(Clone, Copy, Debug)]
struct SampledForecast<'a> {
    /// Spacecraft, sunlight and antennas.
    manager: &'a SampledManager<'a>,
    /// Orbits of spacecraft and bodies ahead.
    orbit: PredictedOrbit<'a>,
    /// Windows and attitudes, the Sun on -Y in downlink and in science that unloads.
    law: OrbitPhaseLaw<'a>,
    /// Momentum at the begin.
    totals: Totals,
    /// Its terms, the begin in s past J2000 TDB.
    terms: ForecastTerms,
}

impl SampledForecast<'_> {
    fn attitude(&self, now: &EphemerisAtTime) -> GuidedAttitude {
        let sight_at = |at_s: f64| if at_s == now.epoch_s { *now } else { self.orbit.at(at_s) };
        self.law.at(now.epoch_s, sight_at)
    }

    /// Adds the torque at a time, for `span_s`.
    fn add(&self, totals: &mut Totals, epoch_s: f64, span_s: f64) {
        let ephemeris = self.orbit.at(epoch_s);
        let inertial_from_body = self.attitude(&ephemeris).frame.inertial_from_body;
        let to_sun_m = ephemeris.to_sun().map(|it| it.re);
        let distance_m = to_sun_m.norm();
        let sun_body = inertial_from_body.inverse() * (to_sun_m / distance_m);
        let SampledManager { spacecraft, light, .. } = self.manager;
        let torque_body = spacecraft.torque_body_n_m(&sun_body, light.pressure_pa(distance_m));
        totals.torque_integral_body_n_m_s += torque_body * span_s;
        totals.momentum_inertial_n_m_s += inertial_from_body * torque_body * span_s;
    }
}

impl Forecast for SampledForecast<'_> {
    type Error = Infallible;

    fn terms(&self) -> ForecastTerms {
        self.terms
    }

    fn simulated(
        &mut self,
        times_s: impl Iterator<Item = f64>,
        step_s: f64,
        mut visit: impl FnMut(ForecastMomentum),
    ) -> Result<(), Infallible> {
        let (mut at_s, mut totals) = (self.terms.begin_s, self.totals);
        let mut ephemeris = self.orbit.at(at_s);
        let mut attitude = self.attitude(&ephemeris);
        for end_s in times_s {
            while at_s < end_s {
                let step_end_s = end_s.min(at_s + step_s);
                let next_s =
                    if attitude.until_s > at_s { step_end_s.min(attitude.until_s) } else { step_end_s };
                for (node, weight) in GAUSS_3 {
                    self.add(&mut totals, at_s + node * (next_s - at_s), weight * (next_s - at_s));
                }
                at_s = next_s;
                ephemeris = self.orbit.at(at_s);
                attitude = self.attitude(&ephemeris);
            }
            let inertial_from_body = attitude.frame.inertial_from_body;
            let to_sun_m = value(&ephemeris.to_sun());
            visit(ForecastMomentum {
                time_s: at_s,
                to_sun: to_sun_m.try_normalize(0.0).unwrap_or(Vector3::x()),
                to_earth: value(&ephemeris.to_earth()).try_normalize(0.0),
                pressure_pa: self.manager.light.pressure_pa(to_sun_m.norm()),
                downlink: attitude.window.activity == Activity::Downlink,
                momentum_body_n_m_s: totals.momentum_body_n_m_s(self.terms.convention, &inertial_from_body),
                momentum_inertial_n_m_s: totals.momentum_inertial_n_m_s,
                body_from_inertial: inertial_from_body.inverse(),
            });
        }
        Ok(())
    }
}
