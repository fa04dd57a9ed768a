//! The forecast of a sampled guidance, which knows no more than a sample and its own windows.
//!
//! Assumptions: the orbit ahead is [`PredictedOrbit`]; science and downlink follow the windows of the orbit phase in its attitudes,
//! whatever is commanded; direct sunlight without shadows is all that acts.
//! Method: torque by Gauss-Legendre quadrature of order 6 on intervals that end where a window or a slew does.
//! Error measure: none at run time; where sunlight alone acts, choices differ from a plant's by less than 3e-5 rad (tested).

use core::convert::Infallible;

use nalgebra::Vector3;

use super::prediction::{Forecast, ForecastTerms};
use crate::guidance::downlink::default_downlink::DefaultDownlink;
use crate::guidance::geometry::moving::value;
use crate::guidance::{Activity, Guided, GuidedAttitude, PredictedOrbit};
use crate::momentum::Totals;
use crate::numerics::quadrature::GAUSS_3;
use crate::plant::{ForecastMomentum, SunLight, SunlitConfiguration};

/// Momentum ahead by sunlight alone.
#[derive(Clone, Copy, Debug)]
pub struct SampledForecast<'a> {
    /// Orbits of spacecraft and bodies ahead.
    pub orbit: PredictedOrbit<'a>,
    /// Windows and attitudes, the Sun on -Y in downlink and in science that unloads.
    pub law: Guided,
    /// The default downlink of the spacecraft's antennas.
    pub default_downlink: &'a DefaultDownlink,
    /// Spacecraft in sunlight.
    pub spacecraft: SunlitConfiguration<'a>,
    /// Sunlight.
    pub light: SunLight,
    /// Momentum at the begin.
    pub totals: Totals,
    /// Its terms, the begin in s past J2000 TDB.
    pub terms: ForecastTerms,
}

impl SampledForecast<'_> {
    fn attitude(&self, epoch_s: f64) -> GuidedAttitude {
        self.law.at(epoch_s, self.default_downlink, |at_s| self.orbit.at(at_s))
    }

    /// Adds the torque at a time, for `span_s`.
    fn add(&self, totals: &mut Totals, epoch_s: f64, span_s: f64) {
        let ephemeris = self.orbit.at(epoch_s);
        let sight_at = |at_s: f64| if at_s == epoch_s { ephemeris } else { self.orbit.at(at_s) };
        let attitude = self.law.at(epoch_s, self.default_downlink, sight_at);
        let inertial_from_body = attitude.frame.inertial_from_body;
        let to_sun_m = ephemeris.to_sun().map(|it| it.re);
        let distance_m = to_sun_m.norm();
        let sun_body = inertial_from_body.inverse() * (to_sun_m / distance_m);
        let torque_body = self.spacecraft.torque_body_n_m(&sun_body, self.light.pressure_pa(distance_m));
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
        let mut attitude = self.attitude(at_s);
        for end_s in times_s {
            while at_s < end_s {
                let step_end_s = end_s.min(at_s + step_s);
                let next_s =
                    if attitude.until_s > at_s { step_end_s.min(attitude.until_s) } else { step_end_s };
                for (node, weight) in GAUSS_3 {
                    self.add(&mut totals, at_s + node * (next_s - at_s), weight * (next_s - at_s));
                }
                at_s = next_s;
                attitude = self.attitude(at_s);
            }
            let inertial_from_body = attitude.frame.inertial_from_body;
            let ephemeris = self.orbit.at(at_s);
            let to_sun_m = value(&ephemeris.to_sun());
            visit(ForecastMomentum {
                time_s: at_s,
                to_sun: to_sun_m.try_normalize(0.0).unwrap_or(Vector3::x()),
                to_earth: value(&ephemeris.to_earth()).try_normalize(0.0),
                pressure_pa: self.light.pressure_pa(to_sun_m.norm()),
                downlink: attitude.window.activity == Activity::Downlink,
                momentum_body_n_m_s: totals.momentum_body_n_m_s(self.terms.convention, &inertial_from_body),
                momentum_inertial_n_m_s: totals.momentum_inertial_n_m_s,
                body_from_inertial: inertial_from_body.inverse(),
            });
        }
        Ok(())
    }
}
