//! Antennas: where each looks, and how wide its beam is.

use core::fmt;

use nalgebra::Vector3;
use serde::Serialize;

/// An antenna with its name.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedAntenna {
    /// Item of `antenna.select`.
    pub name: String,
    /// The antenna.
    pub antenna: Antenna,
}

/// An antenna.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Antenna {
    /// Directions in which its beam can point.
    pub range: AntennaRange,
    /// Full width of the beam across the XY plane, in rad.
    pub across_rad: f64,
    /// Full width along the plane, in rad.
    pub along_rad: f64,
}

/// Directions in which an antenna's beam can point.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum AntennaRange {
    /// In the XY plane, steered over these azimuths.
    Fan(FanAzimuths),
    /// Along this unit vector, body frame.
    Axis(Vector3<f64>),
}

/// Azimuths of a fan, from -Y toward +X.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FanAzimuths {
    /// The middle, in rad.
    pub middle_rad: f64,
    /// How far it is steered to either side of it, in rad; pi is all round.
    pub half_rad: f64,
}

impl Antenna {
    /// The azimuths of a fan; `None` of an antenna along an axis.
    pub fn fan(&self) -> Option<FanAzimuths> {
        match self.range {
            AntennaRange::Fan(fan) => Some(fan),
            AntennaRange::Axis(_) => None,
        }
    }

    /// Half the width of the beam across the XY plane, in rad.
    pub fn half_across_rad(&self) -> f64 {
        0.5 * self.across_rad
    }

    /// The axis of a fixed antenna; `None` of a fan.
    pub fn axis_body(&self) -> Option<Vector3<f64>> {
        match self.range {
            AntennaRange::Fan(_) => None,
            AntennaRange::Axis(axis_body) => Some(axis_body),
        }
    }
}

impl FanAzimuths {
    /// From and to which azimuth, in rad.
    pub fn bounds_rad(&self) -> [f64; 2] {
        [self.middle_rad - self.half_rad, self.middle_rad + self.half_rad]
    }
}

impl fmt::Display for AntennaRange {
    /// Writes the directions as a participle: "fixed along (0, 0, 1)".
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let rounded = |number: f64| (number * 1e6).round() / 1e6 + 0.0;
        match self {
            Self::Fan(fan) => {
                let [from_deg, to_deg] = fan.bounds_rad().map(|bound_rad| rounded(bound_rad.to_degrees()));
                write!(f, "steered in the XY plane from azimuth {from_deg} to {to_deg} deg")
            }
            Self::Axis(axis_body) => {
                let [x, y, z]: [f64; 3] = axis_body.map(rounded).into();
                write!(f, "fixed along ({x}, {y}, {z})")
            }
        }
    }
}
