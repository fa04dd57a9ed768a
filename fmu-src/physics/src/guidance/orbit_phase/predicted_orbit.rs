//! Predicted orbit after a sample: the spacecraft on its present orbit, Sun and Earth by the planet's and the Earth's orbits about
//! the Sun.
//!
//! Equation: two-body motion through position and velocity at the sample, about the target planet and about the Sun. What is
//! on no ellipse about the Sun, such as a Sun that is given without a velocity, moves evenly.
//! Error measure: the planets' pull on one another is left out; Sun and Earth stand off by less than 3e-5 rad after four days
//! about Mercury, Venus and Mars (tested).

use crate::constants::GM_SUN_M3_S2;
use crate::environment::CartesianState;
use crate::environment::orbit::TwoBodyOrbit;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::{state, value};

/// Spacecraft, Sun and Earth about the planet, predicted from a sample for other epochs.
#[derive(Clone, Copy, Debug)]
pub struct PredictedOrbit<'a> {
    present: &'a EphemerisAtTime,
    spacecraft: TwoBodyOrbit,
    planet_from_sun: PredictedBody,
    earth_from_sun: PredictedBody,
}

/// Motion of a body about the Sun.
#[derive(Clone, Copy, Debug)]
struct PredictedBody {
    epoch_s: f64,
    state: CartesianState,
    ellipse: Option<TwoBodyOrbit>,
}

impl<'a> PredictedOrbit<'a> {
    /// From where everything is now; `None` where the spacecraft is on no ellipse about the planet.
    pub fn new(present: &'a EphemerisAtTime) -> Option<Self> {
        Some(Self {
            present,
            spacecraft: ellipse_of(present)?,
            planet_from_sun: PredictedBody::new(state(&-present.sun), present.epoch_s),
            earth_from_sun: PredictedBody::new(state(&(present.earth - present.sun)), present.epoch_s),
        })
    }

    /// Period of the spacecraft's orbit, in s.
    pub fn period_s(&self) -> f64 {
        self.spacecraft.period_s()
    }

    /// Spacecraft, Sun and Earth at an epoch.
    pub fn at(&self, epoch_s: f64) -> EphemerisAtTime {
        let spacecraft = self.spacecraft.state_at(epoch_s);
        let planet = self.planet_from_sun.at(epoch_s);
        let earth = self.earth_from_sun.at(epoch_s) - planet;
        let sun = CartesianState::default() - planet;
        EphemerisAtTime::new(epoch_s, self.present.planet, &spacecraft, &sun, &earth)
    }
}

impl PredictedBody {
    fn new(state: CartesianState, epoch_s: f64) -> Self {
        let ellipse = TwoBodyOrbit::from_state(&state, GM_SUN_M3_S2, epoch_s).ok();
        Self { epoch_s, state, ellipse: ellipse.filter(|orbit| orbit.period_s().is_finite()) }
    }

    fn at(&self, epoch_s: f64) -> CartesianState {
        let evenly = || self.state.moved_evenly(epoch_s - self.epoch_s);
        self.ellipse.map_or_else(evenly, |ellipse| ellipse.state_at(epoch_s))
    }
}

/// The present orbit about the planet, if it is an ellipse.
pub fn ellipse_of(ephemeris: &EphemerisAtTime) -> Option<TwoBodyOrbit> {
    let state =
        CartesianState { position_m: value(&ephemeris.position), velocity_m_s: value(&ephemeris.velocity) };
    let orbit = TwoBodyOrbit::from_state(&state, ephemeris.planet.gm_m3_s2, ephemeris.epoch_s).ok();
    orbit.filter(|orbit| orbit.period_s().is_finite())
}

#[cfg(test)]
mod tests;
