//! The boresight options of paper 001's Table 1: vectors, the instrument on the gimbal, the phased-array antennas.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::antenna::{AntennaAzimuth, Antennas};
use super::command::{BoresightCommand, BoresightOption};
use crate::attitude::{SunAngles, direction_from_angles};
use crate::guidance::geometry::moving::{MovingVector, fixed};
use crate::math::{self, wrapped_rad};
use crate::numerics::scalar::{Scalar, constant_vector, sin_cos};
use crate::spacecraft::Instrument;

/// Boresight of an instrument, body frame: number 0 is +Z, then the rows of the table from 1; `None` past the last row.
pub fn instrument_boresight(instruments: &[Instrument], number: u32) -> Option<Vector3<f64>> {
    match number {
        0 => Some(Vector3::z()),
        row => instruments.get(row as usize - 1).map(|instrument| instrument.boresight_body),
    }
}

/// The gimbal of the instrument that has one: its angle turns the boresight about an axis across it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gimbal {
    /// Boresight at angle 0, unit vector, body frame.
    pub zero_body: Vector3<f64>,
    /// Boresight at +90 deg: axis x boresight, unit vector, body frame.
    pub quarter_body: Vector3<f64>,
    /// Least angle, in rad.
    pub minimum_rad: f64,
    /// Largest angle, in rad.
    pub maximum_rad: f64,
}

/// A device's angle after its range.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DeviceAngle {
    /// The angle it takes, in rad.
    pub angle_rad: f64,
    /// Whether that is the one requested; else it is the nearest bound.
    pub in_range: bool,
}

impl Gimbal {
    /// Gimbal of the instrument that has one; `None` without.
    pub fn from_instruments(instruments: &[Instrument]) -> Option<Self> {
        instruments.iter().find_map(|instrument| {
            let mount = instrument.gimbal?;
            Some(Self {
                zero_body: instrument.boresight_body,
                quarter_body: mount.axis_body.cross(&instrument.boresight_body),
                minimum_rad: mount.minimum_rad,
                maximum_rad: mount.maximum_rad,
            })
        })
    }

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

    /// The angle that brings the boresight nearest to a body-frame direction of any length.
    pub fn toward(&self, direction_body: &Vector3<f64>) -> DeviceAngle {
        let (sine, cosine) = (direction_body.dot(&self.quarter_body), direction_body.dot(&self.zero_body));
        self.nearest(math::atan2(sine, cosine))
    }

    /// Boresight at an angle, with its rate where the angle has one.
    pub fn boresight<T: Scalar>(&self, angle_rad: T) -> Vector3<T> {
        let (sine, cosine) = sin_cos(angle_rad);
        constant_vector::<T>(&self.zero_body) * cosine + constant_vector::<T>(&self.quarter_body) * sine
    }
}

/// A boresight and what it asks of its device.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Boresight {
    /// Body frame, of any length.
    pub body: MovingVector,
    /// The gimbal's angle, where it turns the boresight.
    pub gimbal: Option<DeviceAngle>,
    /// The antenna's azimuth, where it is the boresight.
    pub antenna: Option<AntennaAzimuth>,
}

impl Boresight {
    /// A boresight without a device.
    pub fn fixed(body: Vector3<f64>) -> Self {
        Self { body: fixed(body), gimbal: None, antenna: None }
    }

    /// The instrument on the gimbal at the angle nearest to `angle_rad`.
    pub fn gimbal(angle_rad: f64, gimbal: &Gimbal) -> Self {
        let angle = gimbal.nearest(angle_rad);
        Self { gimbal: Some(angle), ..Self::fixed(gimbal.boresight(angle.angle_rad)) }
    }

    /// The fan at the azimuth nearest to `azimuth_rad`; `None` without a fan.
    pub fn antenna(azimuth_rad: f64, antennas: &Antennas) -> Option<Self> {
        let antenna = antennas.nearest_fan(azimuth_rad);
        antenna.antenna.map(|_| Self { antenna: Some(antenna), ..Self::fixed(antenna.direction_body()) })
    }
}

/// The commanded boresight; `None` where none is commanded, or one of a device that there is not.
pub fn boresight(
    command: &BoresightCommand,
    gimbal: Option<&Gimbal>,
    antennas: &Antennas,
) -> Option<Boresight> {
    Some(match command.option? {
        BoresightOption::Vector => Boresight::fixed(command.vector),
        BoresightOption::AzimuthElevation => {
            let BoresightCommand { azimuth_rad, elevation_rad, .. } = *command;
            Boresight::fixed(direction_from_angles(SunAngles { azimuth_rad, elevation_rad }))
        }
        BoresightOption::Gimbal => Boresight::gimbal(command.angle_rad, gimbal?),
        BoresightOption::PhasedArray => Boresight::antenna(command.azimuth_rad, antennas)?,
    })
}

#[cfg(test)]
mod tests;
