//! The boresight options of paper 001's Table 1: vectors, the MDIS camera, the phased-array antennas.

use core::f64::consts::{PI, TAU};

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::antenna::AntennaAzimuth;
use super::command::{BoresightCommand, BoresightOption};
use crate::attitude::{SunAngles, direction_from_angles};
use crate::constants::DEG_RAD;
use crate::guidance::geometry::moving::{Moving, MovingVector, fixed};
use crate::math;
use crate::numerics::scalar::sin_cos;
use crate::spacecraft::Instrument;

/// Boresight of an instrument, body frame: number 0 is +Z, then the rows of the table from 1; `None` past the last row.
pub fn instrument_boresight(instruments: &[Instrument], number: u32) -> Option<Vector3<f64>> {
    match number {
        0 => Some(Vector3::z()),
        row => instruments.get(row as usize - 1).map(|instrument| instrument.boresight_body),
    }
}

/// Range of the camera: 50 deg away from the Sun, 40 deg toward it (paper 001, Figure 2).
pub const MDIS_RANGE_RAD: [f64; 2] = [-50.0 * DEG_RAD, 40.0 * DEG_RAD];

/// Range of the MDIS camera's angle: from +Z in the Y-Z plane, positive sunward, toward -Y.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MdisRange {
    /// Least angle, in rad.
    pub minimum_rad: f64,
    /// Largest angle, in rad.
    pub maximum_rad: f64,
}

impl Default for MdisRange {
    fn default() -> Self {
        let [minimum_rad, maximum_rad] = MDIS_RANGE_RAD;
        Self { minimum_rad, maximum_rad }
    }
}

/// A device's angle after its range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeviceAngle {
    /// The angle it takes, in rad.
    pub angle_rad: f64,
    /// Whether that is the one requested; else it is the nearest bound.
    pub in_range: bool,
}

impl MdisRange {
    /// The angle nearest to `angle_rad` around the circle.
    pub fn nearest(&self, angle_rad: f64) -> DeviceAngle {
        let angle_rad = wrapped_rad(angle_rad);
        if angle_rad >= self.minimum_rad && angle_rad <= self.maximum_rad {
            return DeviceAngle { angle_rad, in_range: true };
        }
        let off = |bound_rad: f64| wrapped_rad(angle_rad - bound_rad).abs();
        let lower = off(self.minimum_rad) < off(self.maximum_rad);
        DeviceAngle { angle_rad: if lower { self.minimum_rad } else { self.maximum_rad }, in_range: false }
    }

    /// The angle that brings the camera nearest to a body-frame direction of any length.
    pub fn toward(&self, direction_body: &Vector3<f64>) -> DeviceAngle {
        self.nearest(math::atan2(-direction_body.y, direction_body.z))
    }
}

/// Body-frame boresight of the MDIS camera.
pub fn mdis_boresight(angle_rad: f64) -> Vector3<f64> {
    let (sine, cosine) = math::sin_cos(angle_rad);
    Vector3::new(0.0, -sine, cosine)
}

/// The same of an angle that moves.
pub fn mdis_direction(angle: Moving) -> MovingVector {
    let (sine, cosine) = sin_cos(angle);
    MovingVector::new(Moving::from_re(0.0), -sine, cosine)
}

/// The angle in -pi..pi.
fn wrapped_rad(angle_rad: f64) -> f64 {
    if angle_rad.abs() <= PI { angle_rad } else { angle_rad - TAU * (angle_rad / TAU).round() }
}

/// A boresight and what it asks of its device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boresight {
    /// Body frame, of any length.
    pub body: MovingVector,
    /// The camera's angle, where it is the boresight.
    pub mdis: Option<DeviceAngle>,
    /// The antenna's azimuth, where it is the boresight.
    pub antenna: Option<AntennaAzimuth>,
}

impl Boresight {
    /// A boresight without a device.
    pub fn of(body: Vector3<f64>) -> Self {
        Self { body: fixed(body), mdis: None, antenna: None }
    }

    /// The MDIS camera at the angle nearest to `angle_rad`.
    pub fn mdis(angle_rad: f64, range: &MdisRange) -> Self {
        let angle = range.nearest(angle_rad);
        Self { mdis: Some(angle), ..Self::of(mdis_boresight(angle.angle_rad)) }
    }

    /// The phased-array antenna at the azimuth nearest to `azimuth_rad`.
    pub fn antenna(azimuth_rad: f64) -> Self {
        let antenna = AntennaAzimuth::of(azimuth_rad);
        let angles = SunAngles { azimuth_rad: antenna.azimuth_rad, elevation_rad: 0.0 };
        Self { antenna: Some(antenna), ..Self::of(direction_from_angles(angles)) }
    }
}

/// The commanded boresight; `None` where none is commanded.
pub fn boresight(command: &BoresightCommand, mdis: &MdisRange) -> Option<Boresight> {
    Some(match command.option? {
        BoresightOption::Vector => Boresight::of(command.vector),
        BoresightOption::AzimuthElevation => Boresight::of(direction_from_angles(SunAngles {
            azimuth_rad: command.azimuth_rad,
            elevation_rad: command.elevation_rad,
        })),
        BoresightOption::Mdis => Boresight::mdis(command.angle_rad, mdis),
        BoresightOption::PhasedArray => Boresight::antenna(command.azimuth_rad),
    })
}

#[cfg(test)]
mod tests;
