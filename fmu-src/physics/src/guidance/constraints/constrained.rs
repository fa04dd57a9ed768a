//! Constraints on any pointing: the Sun first, the hot pole within what remains (paper 001, "Constrained pointing").

use nalgebra::Vector3;

use super::hot_pole::{HotPole, TurnSide};
use super::keep_in::KeepIn;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::pointing::law::{Pointing, PointingVectors};

/// Constraints in force in a mode.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Constraints {
    /// Zone that keeps the Sun; `None` is off.
    pub keep_in: Option<KeepIn>,
    /// Hot-pole keep-out; `None` is off.
    pub hot_pole: Option<HotPole>,
}

/// A pointing that keeps the constraints, and what they did to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConstrainedPointing {
    /// The attitude.
    pub pointing: Pointing,
    /// Whether the vectors were exchanged to keep the Sun in (Table 6).
    pub sun_keep_in: bool,
    /// Side on which a turn about the Sun line ends; `None`: the attitude was not turned.
    pub hot_pole: Option<TurnSide>,
    /// Whether the hot-pole cone is kept; where no turn about the Sun line reaches its boundary the attitude is the best.
    pub hot_pole_reached: bool,
}

/// By how much directions of Sun and planet in the body frame exceed the constraints, in rad; negative where they are kept,
/// minus infinity where nothing is watched.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// The Sun, over the keep-in zone.
    pub sun_rad: f64,
    /// The planet, over the hot pole's cone.
    pub planet_rad: f64,
}

impl Excess {
    /// Excess without any constraint.
    pub const NONE: Self = Self { sun_rad: f64::NEG_INFINITY, planet_rad: f64::NEG_INFINITY };

    /// The greater of both.
    pub fn greatest_rad(&self) -> f64 {
        self.sun_rad.max(self.planet_rad)
    }
}

impl Constraints {
    /// The attitude of `vectors`, constrained; `None` where boresight, aimpoint, zone axis or Sun has no direction.
    /// `last_turn` is the side of a turn away from the hot pole that lasts.
    pub fn applied(
        &self,
        vectors: &PointingVectors,
        ephemeris: &EphemerisAtTime,
        last_turn: Option<TurnSide>,
    ) -> Option<ConstrainedPointing> {
        let (pointing, sun_keep_in) = match &self.keep_in {
            Some(zone) => {
                let kept = zone.constrained(vectors, &ephemeris.to_sun())?;
                (kept.pointing, kept.in_force)
            }
            None => (vectors.pointing()?, false),
        };
        let kept = self.hot_pole.as_ref().map(|cone| cone.constrained(&pointing, ephemeris, last_turn));
        Some(ConstrainedPointing {
            pointing: kept.map_or(pointing, |kept| kept.pointing),
            sun_keep_in,
            hot_pole: kept.and_then(|kept| kept.side),
            hot_pole_reached: kept.is_none_or(|kept| kept.reached),
        })
    }

    /// By how much the directions of Sun and planet in the body frame exceed the constraints. `in_region`: whether the hot
    /// pole counts.
    pub fn excess(&self, sun_body: &Vector3<f64>, planet_body: &Vector3<f64>, in_region: bool) -> Excess {
        let sun_rad = self.keep_in.as_ref().and_then(|zone| zone.excess_rad(sun_body));
        let cone = self.hot_pole.as_ref().filter(|_| in_region);
        Excess {
            sun_rad: sun_rad.unwrap_or(Excess::NONE.sun_rad),
            planet_rad: cone.map_or(Excess::NONE.planet_rad, |cone| cone.excess_rad(planet_body)),
        }
    }
}
