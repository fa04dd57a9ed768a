//! Antennas as guidance steers them: fans in the XY plane by azimuth, others fixed along an axis.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::{SunAngles, angle_between_rad, direction_from_angles};
use crate::math::{self, wrapped_rad};
use crate::spacecraft::{Antenna, AntennaRange, FanAzimuths, NamedAntenna};

/// An azimuth this little outside a range counts as inside, in rad.
pub const BOUND_RAD: f64 = 1e-12;

/// The antennas of a spacecraft.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Antennas {
    list: Vec<Antenna>,
}

/// An antenna by its row in the file, from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct AntennaRow(pub u16);

/// Azimuth of an antenna's boresight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AntennaAzimuth {
    /// The antenna; `None`: there is none.
    pub antenna: Option<AntennaRow>,
    /// Azimuth in its range, or of its axis, in rad.
    pub azimuth_rad: f64,
    /// How far off the azimuth that was requested lies, in rad.
    pub outside_rad: f64,
}

/// Aim of an antenna's beam.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Beam {
    /// The Earth, wherever constraints leave it.
    AtTheEarth(AntennaAzimuth),
    /// A commanded azimuth.
    Commanded(AntennaAzimuth),
}

impl Antennas {
    /// Antennas of a spacecraft, in the order of its file.
    pub fn new(antennas: &[NamedAntenna]) -> Self {
        Self { list: antennas.iter().map(|named| named.antenna).collect() }
    }

    fn rows(&self) -> impl Iterator<Item = (AntennaRow, &Antenna)> {
        (0..).map(AntennaRow).zip(&self.list)
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Fans that are steered in the XY plane.
    pub fn fans(&self) -> impl Iterator<Item = (AntennaRow, FanAzimuths)> {
        self.rows().filter_map(|(row, antenna)| Some((row, antenna.fan()?)))
    }

    /// Antennas fixed along an axis.
    pub fn axes(&self) -> impl Iterator<Item = (AntennaRow, Vector3<f64>)> {
        self.rows().filter_map(|(row, antenna)| Some((row, antenna.axis_body()?)))
    }

    /// Whether one is steered in the XY plane.
    pub fn has_fan(&self) -> bool {
        self.fans().next().is_some()
    }

    /// Antenna of a row.
    pub fn get(&self, AntennaRow(row): AntennaRow) -> Option<&Antenna> {
        self.list.get(usize::from(row))
    }

    /// How far an azimuth is inside the range of a fan, in rad, negative outside; infinite of what is no fan.
    pub fn fan_margin_rad(&self, row: Option<AntennaRow>, azimuth_rad: f64) -> f64 {
        let fan = row.and_then(|row| self.get(row)?.fan());
        fan.map_or(f64::INFINITY, |fan| fan.half_rad - wrapped_rad(azimuth_rad - fan.middle_rad).abs())
    }

    /// Azimuth of the fan nearest to an azimuth; midway between two bounds, and of two with one bound, that of the first.
    pub fn nearest_fan(&self, azimuth_rad: f64) -> AntennaAzimuth {
        let none = AntennaAzimuth { antenna: None, azimuth_rad, outside_rad: f64::INFINITY };
        let nearer = |best: AntennaAzimuth, next: AntennaAzimuth| {
            if next.outside_rad < best.outside_rad - BOUND_RAD { next } else { best }
        };
        self.fans().map(|(row, fan)| fan_at(row, &fan, azimuth_rad)).fold(none, nearer)
    }

    /// Azimuth of the antenna nearest to a body-frame direction: a fan, unless one along an axis is nearer.
    pub fn toward(&self, direction_body: &Vector3<f64>) -> AntennaAzimuth {
        let fan = self.nearest_fan(SunAngles::from_direction(direction_body).azimuth_rad);
        let nearest = self.nearest_axis(&fan, direction_body, 0.0);
        nearest.map_or(fan, |(row, axis_body)| AntennaAzimuth::fixed(row, &axis_body))
    }

    /// The antenna along an axis that, looking at the Earth, leaves the Sun nearest to its place, if it is nearer than with the fan
    /// nearest to the Earth.
    pub fn nearest_axis(
        &self,
        fan: &AntennaAzimuth,
        place_body: &Vector3<f64>,
        separation_rad: f64,
    ) -> Option<(AntennaRow, Vector3<f64>)> {
        let off_rad =
            |earth_body: &Vector3<f64>| (angle_between_rad(place_body, earth_body) - separation_rad).abs();
        let of_fan_rad = fan.antenna.map_or(f64::INFINITY, |_| off_rad(&fan.direction_body()));
        let nearest = self.axes().fold((of_fan_rad, None), |(least_rad, found), (row, axis_body)| {
            let off_rad = off_rad(&axis_body);
            let is_nearer = off_rad < least_rad - BOUND_RAD;
            if is_nearer { (off_rad, Some((row, axis_body))) } else { (least_rad, found) }
        });
        nearest.1
    }

    /// Azimuth of the beam after a constraint moved it off the Earth: a fan follows it.
    pub fn following(&self, beam: AntennaAzimuth, earth_body: &Vector3<f64>) -> AntennaAzimuth {
        let is_fixed = beam.antenna.is_some_and(|row| self.axes().any(|(other, _)| other == row));
        if is_fixed { beam } else { self.nearest_fan(SunAngles::from_direction(earth_body).azimuth_rad) }
    }

    /// Whether a beam covers a body-frame direction, `across_rad` being half its width across the XY plane where that is given. A
    /// fan reaches half that width past its ends.
    pub fn covers(
        &self,
        beam: &AntennaAzimuth,
        direction_body: &Vector3<f64>,
        across_rad: Option<f64>,
    ) -> bool {
        let Some((row, antenna)) = beam.antenna.and_then(|row| Some((row, self.get(row)?))) else {
            return false;
        };
        let across_rad = across_rad.unwrap_or(antenna.half_across_rad());
        let along_rad = 0.5 * antenna.along_rad;
        match antenna.range {
            AntennaRange::Fan(fan) => {
                let SunAngles { azimuth_rad, elevation_rad } = SunAngles::from_direction(direction_body);
                let reach_rad = across_rad + BOUND_RAD;
                elevation_rad.abs() <= reach_rad
                    && beam.off_rad(azimuth_rad) <= along_rad
                    && fan_at(row, &fan, azimuth_rad).outside_rad <= reach_rad
            }
            AntennaRange::Axis(axis_body) => {
                // An ellipse about the axis: along is the direction across the axis that lies in the XY plane.
                let along = Vector3::z().cross(&axis_body).try_normalize(1e-9).unwrap_or(Vector3::x());
                let across = axis_body.cross(&along);
                let off_rad = angle_between_rad(&axis_body, direction_body);
                let (x, y) = (direction_body.dot(&along), direction_body.dot(&across));
                let length = math::hypot(x, y);
                if length == 0.0 {
                    return off_rad < 1.0;
                }
                let shares = [off_rad * x / (length * along_rad), off_rad * y / (length * across_rad)];
                math::hypot(shares[0], shares[1]) <= 1.0 + BOUND_RAD
            }
        }
    }
}

/// The azimuth of a fan's range nearest to `azimuth_rad`.
fn fan_at(row: AntennaRow, fan: &FanAzimuths, azimuth_rad: f64) -> AntennaAzimuth {
    let off_rad = wrapped_rad(azimuth_rad - fan.middle_rad);
    let nearest_rad = fan.middle_rad + off_rad.clamp(-fan.half_rad, fan.half_rad);
    AntennaAzimuth {
        antenna: Some(row),
        azimuth_rad: wrapped_rad(nearest_rad),
        outside_rad: (off_rad.abs() - fan.half_rad).max(0.0),
    }
}

impl AntennaAzimuth {
    /// Azimuth of an antenna along an axis.
    pub fn fixed(row: AntennaRow, axis_body: &Vector3<f64>) -> Self {
        Self {
            antenna: Some(row),
            azimuth_rad: SunAngles::from_direction(axis_body).azimuth_rad,
            outside_rad: 0.0,
        }
    }

    /// Unit vector of the azimuth in the XY plane, body frame.
    pub fn direction_body(&self) -> Vector3<f64> {
        direction_from_angles(SunAngles { azimuth_rad: self.azimuth_rad, elevation_rad: 0.0 })
    }

    /// How far a body-frame azimuth is from it, in rad.
    pub fn off_rad(&self, azimuth_rad: f64) -> f64 {
        wrapped_rad(azimuth_rad - self.azimuth_rad).abs()
    }

    /// Whether it is the azimuth that was requested.
    pub fn is_in_range(&self) -> bool {
        self.outside_rad <= BOUND_RAD
    }
}

#[cfg(test)]
pub(crate) mod tests;
