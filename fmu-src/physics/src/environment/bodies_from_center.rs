//! Sun, Earth and planets as seen from the centre of a flight.

use nalgebra::Vector3;

use super::CartesianState;
use super::ephemeris::Ephemeris;
use super::kepler_planet::KeplerPlanet;
use crate::bodies::Body;

/// Bodies from a centre: VSOP87, the centre itself possibly on an ellipse instead.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodiesFromCenter {
    /// The body in the centre.
    pub center: Body,
    /// Its ellipse about the Sun, if it moves on one.
    pub ellipse: Option<KeplerPlanet>,
    /// The orbit of the body that the spacecraft's file describes, if that tells it.
    pub custom: Option<KeplerPlanet>,
}

impl BodiesFromCenter {
    /// Sun and Earth at `epoch_s` past J2000 TDB, from the centre, in EME2000.
    pub fn sun_and_earth(&self, ephemeris: &mut Ephemeris, epoch_s: f64) -> (CartesianState, CartesianState) {
        if self.center == Body::Sun {
            return (CartesianState::default(), ephemeris.state(Body::Earth, epoch_s));
        }
        let center = self.center_state(ephemeris, epoch_s);
        // About the Earth there is one Earth, on whatever orbit.
        let earth = if self.center == Body::Earth { center } else { ephemeris.state(Body::Earth, epoch_s) };
        (CartesianState::default() - center, earth - center)
    }

    /// Any body at `epoch_s`, from the centre, in EME2000.
    pub fn body(&self, body: Body, ephemeris: &mut Ephemeris, epoch_s: f64) -> CartesianState {
        if body == self.center {
            return CartesianState::default();
        }
        self.heliocentric(body, ephemeris, epoch_s) - self.center_state(ephemeris, epoch_s)
    }

    fn center_state(&self, ephemeris: &mut Ephemeris, epoch_s: f64) -> CartesianState {
        let ellipse = self.ellipse.map(|planet| planet.state(epoch_s));
        ellipse.unwrap_or_else(|| self.heliocentric(self.center, ephemeris, epoch_s))
    }

    fn heliocentric(&self, body: Body, ephemeris: &mut Ephemeris, epoch_s: f64) -> CartesianState {
        let custom = self.custom.filter(|_| body == Body::Custom);
        custom.map_or_else(|| ephemeris.state(body, epoch_s), |custom| custom.state(epoch_s))
    }
}

/// A body that stays where it is, in m.
pub fn fixed(position_m: Vector3<f64>) -> CartesianState {
    CartesianState { position_m, velocity_m_s: Vector3::zeros() }
}
