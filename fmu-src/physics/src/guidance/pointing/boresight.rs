//! The boresight options of paper 001's Table 1 as one table: vectors, the MDIS camera, the phased-array antennas.

use core::f64::consts::{PI, TAU};

use nalgebra::{ComplexField, Vector3};
use serde::{Deserialize, Serialize};

use super::antenna::AntennaAzimuth;
use super::command::{BoresightCommand, BoresightOption};
use crate::attitude::{SunAngles, direction_from_angles};
use crate::constants::DEG_RAD;
use crate::guidance::geometry::moving::{Moving, MovingVector, fixed};
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
        self.nearest((-direction_body.y).atan2(direction_body.z))
    }
}

/// Body-frame boresight of the MDIS camera.
pub fn mdis_boresight(angle_rad: f64) -> Vector3<f64> {
    let (sine, cosine) = angle_rad.sin_cos();
    Vector3::new(0.0, -sine, cosine)
}

/// The same of an angle that moves.
pub fn mdis_direction(angle: Moving) -> MovingVector {
    let (sine, cosine) = angle.sin_cos();
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

/// The boresight of an option.
type BoresightLaw = fn(&BoresightCommand, &MdisRange) -> Boresight;

/// Every option and its law, in the order of [`BoresightOption`].
pub const BORESIGHTS: [(BoresightOption, BoresightLaw); 4] = [
    (BoresightOption::Vector, |c, _| Boresight::of(c.vector)),
    (BoresightOption::AzimuthElevation, |c, _| {
        let angles = SunAngles { azimuth_rad: c.azimuth_rad, elevation_rad: c.elevation_rad };
        Boresight::of(direction_from_angles(angles))
    }),
    (BoresightOption::Mdis, |c, range| Boresight::mdis(c.angle_rad, range)),
    (BoresightOption::PhasedArray, |c, _| Boresight::antenna(c.azimuth_rad)),
];

/// The commanded boresight; `None` where none is commanded.
pub fn boresight(command: &BoresightCommand, mdis: &MdisRange) -> Option<Boresight> {
    let option = command.option?;
    BORESIGHTS.iter().find(|(of, _)| *of == option).map(|(_, law)| law(command, mdis))
}

#[cfg(test)]
mod tests {
    //! What the paper's figures 1 to 3 say in words.
    use super::*;
    use crate::guidance::geometry::moving::value;
    use approx::assert_relative_eq;

    fn with(option: BoresightOption, degrees: f64) -> Boresight {
        let command = BoresightCommand {
            option: Some(option),
            vector: Vector3::new(0.0, 2.0, 0.0),
            azimuth_rad: degrees * DEG_RAD,
            angle_rad: degrees * DEG_RAD,
            ..BoresightCommand::default()
        };
        boresight(&command, &MdisRange::default()).unwrap()
    }

    #[test]
    fn the_table_holds_every_option_once() {
        for (at, (option, _)) in BORESIGHTS.iter().enumerate() {
            assert_eq!(*option as usize, at);
        }
        assert!(boresight(&BoresightCommand::default(), &MdisRange::default()).is_none());
    }

    #[test]
    fn the_camera_looks_sunward_at_positive_angles_and_stops_at_its_range() {
        let camera = |degrees| with(BoresightOption::Mdis, degrees);
        assert_eq!(value(&camera(0.0).body), Vector3::z());
        let half = 0.5_f64.sqrt();
        assert_relative_eq!(value(&camera(-45.0).body), Vector3::new(0.0, half, half), epsilon = 1e-15);
        assert!(value(&camera(30.0).body).y < 0.0, "toward the sunshade");
        for (requested, taken, in_range) in [
            (39.0, 39.0, true),
            (41.0, 40.0, false),
            (-51.0, -50.0, false),
            (-50.0, -50.0, true),
            (180.0, -50.0, false),
        ] {
            let angle = camera(requested).mdis.unwrap();
            assert_eq!(angle.in_range, in_range, "{requested}");
            assert_relative_eq!(angle.angle_rad, taken * DEG_RAD, epsilon = 1e-15);
        }
    }

    #[test]
    fn the_camera_turns_nearest_to_a_direction() {
        let range = MdisRange::default();
        for i in 0..500 {
            let t = f64::from(i) * 0.7;
            let direction = Vector3::new(0.5 * t.sin(), (1.3 * t).cos(), (0.4 * t).sin());
            let found = mdis_boresight(range.toward(&direction).angle_rad).dot(&direction);
            let best = (0..=9000)
                .map(|k| mdis_boresight((f64::from(k) * 0.01 - 50.0) * DEG_RAD).dot(&direction))
                .fold(f64::NEG_INFINITY, f64::max);
            assert!(found >= best - 1e-15, "{direction}");
        }
    }

    #[test]
    fn the_antennas_cover_two_quadrants_and_stop_at_the_nearest_bound() {
        let antenna = |degrees| with(BoresightOption::PhasedArray, degrees);
        let front = value(&antenna(-33.0).body);
        assert!(front.x < 0.0 && front.y < 0.0, "the -X,-Y quadrant");
        let back = value(&antenna(147.0).body);
        assert!(back.x > 0.0 && back.y > 0.0, "the +X,+Y quadrant");
        for (requested, taken, in_range) in [
            (-33.0, -33.0, true),
            (0.0, 0.0, true),
            (30.0, 0.0, false),
            (60.0, 90.0, false),
            (120.0, 120.0, true),
            (180.0, 180.0, true),
            (-170.0, 180.0, false),
            (-100.0, -90.0, false),
            (240.0, -90.0, false),
            (-180.0, 180.0, true),
        ] {
            let antenna = antenna(requested).antenna.unwrap();
            let angle = DeviceAngle { angle_rad: antenna.azimuth_rad, in_range: antenna.is_in_range() };
            assert_eq!(angle.in_range, in_range, "{requested}");
            assert_relative_eq!(angle.angle_rad, taken * DEG_RAD, epsilon = 1e-14);
        }
    }

    #[test]
    fn instrument_0_is_plus_z_and_the_rows_follow() {
        let tilted = Vector3::new(0.0, 0.6, 0.8);
        let table = [Instrument { name: "tilted".into(), boresight_body: tilted }];
        assert_eq!(instrument_boresight(&table, 0), Some(Vector3::z()));
        assert_eq!(instrument_boresight(&table, 1), Some(tilted));
        assert_eq!(instrument_boresight(&table, 2), None);
    }
}
