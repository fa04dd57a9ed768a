//! Antennas: where each looks, and how wide its beam is.

use core::f64::consts::PI;
use core::fmt;

use nalgebra::Vector3;
use serde::Serialize;

use super::names::check_item_name;
use super::part_reader::PartReader;
use crate::toml::{FieldOfView, TurnEither, UnitVector, tables};

/// A fan is steered over this at most, in deg, if not all round.
const WIDEST_FAN_DEG: f64 = 180.0;

tables! {
/// An antenna: a fan steered in the XY plane (`azimuth_deg`) or fixed along an axis (`axis`).
struct AntennaDescription called "antenna" {
    /// Its item of `antenna.select`: letters and digits, the first a letter.
    name: String,
    /// From and to which azimuth a fan is steered, in deg, from -Y toward +X: up to 180 deg apart, or 360.
    azimuth_deg: Option<[TurnEither; 2]>,
    /// Unit vector along which a fixed antenna looks, body frame: it is turned to the Earth, -Y as near to the Sun as that allows.
    axis as axis_body: Option<UnitVector>,
    /// Full widths of the beam, in deg: across the XY plane and along it (of an axis along Z along X).
    beam_deg as beam_rad: [FieldOfView; 2],
} rules {
    Excludes axis => azimuth_deg: "an axis beside `azimuth_deg`", "one of both: a fan has `azimuth_deg`, a fixed antenna `axis`";
    AnyOf azimuth_deg axis: "neither `azimuth_deg` nor `axis`",
        "`azimuth_deg = [from, to]` of a fan in the XY plane, or `axis` of a fixed antenna";
}
}

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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct FanAzimuths {
    /// The middle, in rad.
    pub middle_rad: f64,
    /// How far it is steered to either side of it, in rad; pi is all round.
    pub half_rad: f64,
}

impl Antenna {
    /// The azimuths of a fan; `None` of an antenna along an axis.
    pub fn fan(&self) -> Option<FanAzimuths> {
        let AntennaRange::Fan(fan) = self.range else { return None };
        Some(fan)
    }

    /// Half the width of the beam across the XY plane, in rad.
    pub fn half_across_rad(&self) -> f64 {
        0.5 * self.across_rad
    }

    /// The axis of a fixed antenna; `None` of a fan.
    pub fn axis_body(&self) -> Option<Vector3<f64>> {
        let AntennaRange::Axis(axis_body) = self.range else { return None };
        Some(axis_body)
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

/// Reads an antenna.
pub(super) fn antenna(part: &PartReader<'_>, description: &AntennaDescription) -> NamedAntenna {
    check_item_name(&part.key("name"), &description.name);
    let fan = |azimuth_deg: [TurnEither; 2]| fan(part, azimuth_deg.map(|it| it.0));
    let range = match (description.azimuth_deg, description.axis_body()) {
        (None, Some(axis_body)) => AntennaRange::Axis(axis_body),
        (azimuth_deg, _) => AntennaRange::Fan(azimuth_deg.map(fan).unwrap_or_default()),
    };
    let [across_rad, along_rad] = description.beam_rad();
    let antenna = Antenna { range, across_rad, along_rad };
    NamedAntenna { name: description.name.clone(), antenna }
}

fn fan(part: &PartReader<'_>, [from_deg, to_deg]: [f64; 2]) -> FanAzimuths {
    let width_deg = to_deg - from_deg;
    if width_deg == 360.0 {
        return FanAzimuths { middle_rad: 0.5 * (from_deg + to_deg).to_radians(), half_rad: PI };
    }
    if !(width_deg > 0.0 && width_deg <= WIDEST_FAN_DEG) {
        let allowed =
            "from and to in deg, from -Y toward +X, 0 to 180 deg apart or 360, as in [-90, 0] or [170, 190]";
        part.key("azimuth_deg").report(format_args!("[{from_deg}, {to_deg}]"), allowed);
    }
    let [from_rad, to_rad] = [from_deg, to_deg].map(f64::to_radians);
    FanAzimuths { middle_rad: 0.5 * (from_rad + to_rad), half_rad: 0.5 * (to_rad - from_rad) }
}
