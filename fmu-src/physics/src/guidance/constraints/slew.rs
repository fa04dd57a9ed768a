//! Turn from one attitude to another that moves on, the Sun inside its keep-in zone.
//!
//! Equation: C(t) = C_to(t) R(u), u from 1 to 0 at an even rate. About the eigenaxis R = exp(u b), b the rotation
//! from the new attitude back to the old one where the turn begins. Where that leaves the zone and both ends lie inside,
//! R = B(s_to) Ry(u r) B(s)^T with B(A, E) = Z Rz(A) Rx(E), Z the zone's frame, which takes -Y to the Sun's direction s in
//! the body; s goes straight from end to end in azimuth A and elevation E, the body turns evenly about the Sun line, by r
//! in all. The zone is a rectangle in both angles, so s stays inside.
//! The turn's own rate over the rate of u is hypot(r, dA, dE) but for r dA sin E: r^2 + dA^2 + dE^2 + 2 r dA sin E,
//! which is greatest at an end.
//! Error measure: the eigenaxis turn is judged where the turn begins. What the new attitude's Sun may move meanwhile is
//! kept as a margin, so that no turn leaves the zone later.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::keep_in::{BOUNDARY_RAD, KeepIn};
use crate::attitude::{MovingFrame, MovingUnit, SunAngles, rotation_vector};
use crate::guidance::geometry::moving::{Moving, MovingVector, PARALLEL_RAD, rotation_about, value};
use crate::guidance::pointing::law::Pointing;
use crate::math;
use crate::numerics::scalar::Scalar;

/// Start of a turn.
#[derive(Clone, Copy, Debug)]
pub struct SlewStart<'a> {
    /// The old attitude.
    pub from: &'a MovingFrame,
    /// The new one.
    pub to: &'a MovingFrame,
    /// Unit vector to the Sun, EME2000.
    pub to_sun: Vector3<f64>,
    /// Greatest rate of the Sun's direction in the new attitude's body frame, in rad/s.
    pub sun_drift_rad_s: f64,
}

/// A turn.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Slew {
    /// About one axis: the rotation vector back from the new attitude to the old one, in rad.
    Eigenaxis {
        /// Components along the body axes.
        back_body_rad: Vector3<f64>,
    },
    /// The Sun straight from place to place.
    WithinZone {
        /// From the zone's frame to the body's.
        body_from_zone: Matrix3<f64>,
        /// The Sun's place in the old attitude.
        from: SunAngles,
        /// Turn about +Y of the zone's frame back to the old attitude, in rad.
        back_rad: f64,
        /// Greatest rate over that of the fraction of the turn that remains, in rad.
        length_rad: f64,
    },
}

/// A slew's attitude, and when it ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlewedFrame {
    /// Body frame and rate.
    pub frame: MovingFrame,
    /// End of the slew, in s.
    pub end_s: f64,
}

impl Slew {
    /// Longest turn within this zone or without one, in rad: half a revolution about one axis or about the Sun line, and across the
    /// zone.
    pub fn longest_rad(zone: Option<&KeepIn>) -> f64 {
        let across_rad = zone.map_or(0.0, |zone| 2.0 * (zone.azimuth_rad + zone.elevation_rad));
        core::f64::consts::PI + across_rad
    }

    /// Rejects decoded turns that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        let numbers = match self {
            Self::Eigenaxis { back_body_rad } => back_body_rad.norm(),
            Self::WithinZone { body_from_zone, from, back_rad, length_rad } => {
                body_from_zone.sum() + from.azimuth_rad + from.elevation_rad + back_rad + length_rad
            }
        };
        numbers.is_finite() && self.length_rad() >= 0.0
    }

    /// The turn between two attitudes at a rate of `rate_rad_s`; without a zone about the eigenaxis.
    pub fn between(start: &SlewStart<'_>, zone: Option<&KeepIn>, rate_rad_s: f64) -> Self {
        let [from, to] = [start.from, start.to].map(|frame| frame.inertial_from_body);
        let back_body_rad = rotation_vector(&to, &from);
        let eigenaxis = Self::Eigenaxis { back_body_rad };
        // Beyond a half space azimuths meet again behind, and the zone hardly bounds a turn.
        let zone = zone.filter(|zone| zone.azimuth_rad <= core::f64::consts::FRAC_PI_2);
        let Some((zone, body_from_zone)) = zone.and_then(|zone| Some((zone, zone.body_from_zone()?))) else {
            return eigenaxis;
        };
        let [sun_from, sun_to] = [from, to].map(|it| it.inverse() * start.to_sun);
        let is_inside = |sun: &Vector3<f64>| zone.excess_rad(sun).is_some_and(|it| it <= BOUNDARY_RAD);
        if !(is_inside(&sun_from) && is_inside(&sun_to)) {
            return eigenaxis;
        }
        let drift_rad = start.sun_drift_rad_s * back_body_rad.norm() / rate_rad_s;
        let least = zone.least_margin_on_turn(&body_from_zone, &sun_to, &-back_body_rad);
        if least >= drift_rad - BOUNDARY_RAD {
            return eigenaxis;
        }
        let angles = |sun: &Vector3<f64>| SunAngles::from_direction(&body_from_zone.tr_mul(sun));
        let (angles_from, angles_to) = (angles(&sun_from), angles(&sun_to));
        let frame = |angles: SunAngles| body_from_zone * pointed(angles);
        let back = frame(angles_to).transpose() * (to.inverse() * from).matrix() * frame(angles_from);
        let back_rad = math::atan2(back[(0, 2)] - back[(2, 0)], back[(0, 0)] + back[(2, 2)]);
        // Half a turn either way is as far; rounding does not choose it.
        let half = core::f64::consts::PI;
        let back_rad = if back_rad < PARALLEL_RAD - half { back_rad + 2.0 * half } else { back_rad };
        let (across_rad, up_rad) = (
            angles_to.azimuth_rad - angles_from.azimuth_rad,
            angles_to.elevation_rad - angles_from.elevation_rad,
        );
        let mixed = [angles_from, angles_to].map(|it| back_rad * across_rad * math::sin(it.elevation_rad));
        let squared =
            back_rad * back_rad + across_rad * across_rad + up_rad * up_rad + 2.0 * mixed[0].max(mixed[1]);
        let length_rad = squared.max(0.0).sqrt();
        Self::WithinZone { body_from_zone, from: angles_from, back_rad, length_rad }
    }

    /// Its greatest rate times its duration, in rad.
    pub fn length_rad(&self) -> f64 {
        match self {
            Self::Eigenaxis { back_body_rad } => back_body_rad.norm(),
            Self::WithinZone { length_rad, .. } => *length_rad,
        }
    }

    /// The attitude at `time_s` of the turn that began at `begin_s`, at a rate of `rate_rad_s`; `None` once `target` is reached.
    pub fn at(
        &self,
        begin_s: f64,
        time_s: f64,
        target: &MovingFrame,
        to_sun: &MovingUnit,
        rate_rad_s: f64,
    ) -> Option<SlewedFrame> {
        let duration_s = self.length_rad() / rate_rad_s;
        let elapsed_s = time_s - begin_s;
        // Written so that a NaN ends it.
        (elapsed_s < duration_s).then(|| SlewedFrame {
            frame: self.frame(target, to_sun, Moving::new(1.0 - elapsed_s / duration_s, -1.0 / duration_s)),
            end_s: begin_s + duration_s,
        })
    }

    /// The attitude with the fraction `remaining` of the turn to go, and its rate in 1/s; `target` is the new attitude and `to_sun` the
    /// Sun at this time.
    pub fn frame(&self, target: &MovingFrame, to_sun: &MovingUnit, remaining: Moving) -> MovingFrame {
        let Self::WithinZone { body_from_zone, from, back_rad, .. } = self else {
            let Self::Eigenaxis { back_body_rad } = self else { return *target };
            return target.offset(back_body_rad, remaining.re, remaining.eps);
        };
        let target = Pointing::from_frame(target);
        let zone = body_from_zone.map(Moving::from_re);
        let to_sun = crate::guidance::geometry::moving::moving(to_sun.direction, to_sun.rate_1_s);
        let [azimuth_to, elevation_to] = moving_angles(&zone.tr_mul(&target.to_body(&to_sun)));
        let between = |from_rad: f64, to: Moving| to + (Moving::constant(from_rad) - to) * remaining;
        let at = |azimuth, elevation| zone * rotation_about(2, azimuth) * rotation_about(0, elevation);
        let here = at(between(from.azimuth_rad, azimuth_to), between(from.elevation_rad, elevation_to));
        let turn = rotation_about(1, remaining * Moving::constant(*back_rad));
        let inertial_from_body =
            target.inertial_from_body * at(azimuth_to, elevation_to) * turn * here.transpose();
        Pointing { inertial_from_body, degenerate: false }.frame()
    }
}

/// The rotation Rz(A) Rx(E), which takes -Y to the direction of these angles.
fn pointed(angles: SunAngles) -> Matrix3<f64> {
    let about = |axis, angle_rad| rotation_about(axis, Moving::constant(angle_rad));
    (about(2, angles.azimuth_rad) * about(0, angles.elevation_rad)).map(|it| it.re)
}

/// Azimuth and elevation of a moving direction, as [`SunAngles::from_direction`]; at the pole the azimuth is 0.
fn moving_angles(sun: &MovingVector) -> [Moving; 2] {
    let [x, y, z] = [sun.x, sun.y, sun.z];
    if math::hypot(x.re, y.re) < PARALLEL_RAD {
        let SunAngles { elevation_rad, .. } = SunAngles::from_direction(&value(sun));
        return [Moving::constant(0.0), Moving::constant(elevation_rad)];
    }
    let across = nalgebra::ComplexField::sqrt(x * x + y * y);
    [Moving::polar_angle(x, -y), Moving::polar_angle(-z, across)]
}

#[cfg(test)]
mod tests;
