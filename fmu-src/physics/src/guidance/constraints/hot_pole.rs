//! Hot-pole keep-out: low above the subsolar point the top deck (-Z) looks away from the planet (paper 001).
//!
//! The attitude is turned about the Sun line, which leaves the Sun where the keep-in zone has it. With s the Sun, n the
//! planet's centre and v = -Z, unit vectors in the body frame, a turn by phi has
//! cos(v, n) = (s.v)(s.n) + a cos phi + b sin phi, a = v.n - (s.v)(s.n), b = (s x v).n,
//! so that the boundary lies at phi = atan2(b, a) +- acos(c / m), c = cos(cone) - (s.v)(s.n), m = hypot(a, b). Where the turn
//! begins the smaller of both is taken; while it lasts it stays on its side, though the other turn becomes the smaller one.
//! Where c < -m none reaches the boundary and the best is atan2(b, a) +- pi, where both sides meet.

use nalgebra::{ComplexField, Vector3};
use serde::{Deserialize, Serialize};

use crate::attitude::angle_between_rad;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::{Moving, PARALLEL_RAD, fixed, unit, value};
use crate::guidance::pointing::law::Pointing;
use crate::math;
use crate::numerics::scalar::Scalar;

/// The axis that must not look at the planet, body frame.
const TOP_DECK_BODY: Vector3<f64> = Vector3::new(0.0, 0.0, -1.0);

/// When and how far the top deck looks away.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HotPole {
    /// Below this height above the ellipsoid along the radius, in m.
    pub altitude_m: f64,
    /// Nearer than this to the subsolar direction, seen from the planet's centre, in rad.
    pub angle_rad: f64,
    /// Least angle between -Z and the direction to the planet's centre, 0 to pi, in rad.
    pub cone_rad: f64,
}

/// On which side of the top deck's nearest approach to the planet a turn about the Sun line ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum TurnSide {
    /// At atan2(b, a) + acos(c / m).
    Ahead,
    /// At atan2(b, a) - acos(c / m).
    Behind,
}

/// An attitude that keeps the cone, or comes as near to it as turning about the Sun line allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeptOut {
    /// The attitude.
    pub pointing: Pointing,
    /// Side on which the turn ends; `None`: the cone would not have been violated.
    pub side: Option<TurnSide>,
    /// Whether the cone is kept.
    pub reached: bool,
}

impl HotPole {
    /// Whether the spacecraft is where the constraint counts.
    pub fn in_region(&self, ephemeris: &EphemerisAtTime) -> bool {
        let position_m = value(&ephemeris.position);
        let over_the_pole = angle_between_rad(&position_m, &value(&ephemeris.sun)) < self.angle_rad;
        if !over_the_pole {
            return false;
        }
        let distance_m = position_m.norm();
        let planet = &ephemeris.planet;
        let along_axes =
            value(&(planet.planet_from_inertial(ephemeris.epoch_s) * ephemeris.position)) / distance_m;
        let surface_m = along_axes.component_div(&planet.radii_m).norm().recip();
        distance_m - surface_m < self.altitude_m
    }

    /// By how much -Z is inside the cone about `planet_body`, in rad; negative outside.
    pub fn excess_rad(&self, planet_body: &Vector3<f64>) -> f64 {
        self.cone_rad - angle_between_rad(&TOP_DECK_BODY, planet_body)
    }

    /// `pointing` turned about the Sun line until the cone is kept; unchanged where it is, outside the region, and where
    /// planet or Sun has no direction. `last` is the side of a turn that lasts.
    pub fn constrained(
        &self,
        pointing: &Pointing,
        ephemeris: &EphemerisAtTime,
        last: Option<TurnSide>,
    ) -> KeptOut {
        let free = KeptOut { pointing: *pointing, side: None, reached: true };
        if !self.in_region(ephemeris) {
            return free;
        }
        let (Some(to_sun), Some(to_planet)) = (unit(&ephemeris.to_sun()), unit(&ephemeris.to_planet()))
        else {
            return free;
        };
        let planet_body = pointing.to_body(&to_planet);
        if self.excess_rad(&value(&planet_body)) <= 0.0 {
            return free;
        }
        let sun_body = pointing.to_body(&to_sun);
        let deck = fixed(TOP_DECK_BODY);
        let along = sun_body.dot(&deck) * sun_body.dot(&planet_body);
        let (a, b) = (deck.dot(&planet_body) - along, sun_body.cross(&deck).dot(&planet_body));
        let c = Moving::constant(math::cos(self.cone_rad)) - along;
        // With Sun, deck and planet in one plane either sense is as far; rounding does not choose it.
        let smaller = if b.re < -PARALLEL_RAD { TurnSide::Ahead } else { TurnSide::Behind };
        let side = last.unwrap_or(smaller);
        if math::hypot(a.re, b.re) < PARALLEL_RAD {
            // Planet or deck on the Sun line: no turn changes the angle.
            return KeptOut { side: Some(side), reached: false, ..free };
        }
        let m = (a * a + b * b).sqrt();
        let farthest = Moving::polar_angle(b, a);
        let squared = (m - c) * (m + c);
        let reached = c.re > -m.re;
        let opening = if squared.re > 0.0 {
            Moving::polar_angle(squared.sqrt(), c)
        } else {
            Moving::constant(if reached { 0.0 } else { core::f64::consts::PI })
        };
        let turn = match side {
            TurnSide::Ahead => farthest + opening,
            TurnSide::Behind => farthest - opening,
        };
        KeptOut { pointing: pointing.turned(&sun_body, turn), side: Some(side), reached }
    }
}

#[cfg(test)]
mod tests;
