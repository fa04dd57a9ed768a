//! Downlink: an antenna at the Earth, the Sun where momentum management places it (paper 000, eqs 14 to 22).
//!
//! Fans are steered in the XY plane over ranges of azimuth; MESSENGER's -90 to 0 deg and 90 to 180 deg, its quadrants.
//! With the Sun at azimuth A and elevation E and the Earth in the XY plane, theta from the Sun, the Earth's azimuth is
//! A + delta or A - delta, cos theta = cos E cos delta, which needs |E| <= min(theta, 180 deg - theta): E is cut there
//! (the paper names the first bound alone). Of both azimuths:
//!
//! - the one inside a range is taken; of two, A - delta for theta below 90 deg and A + delta beyond, which at A = E = 0
//!   is the default attitude (eq 18);
//! - where none is inside, the one nearest to a range gives the antenna. The antenna looks along the range's bound,
//!   and the Sun comes as near to the requested place as the Earth there allows.
//!
//! An antenna fixed along an axis looks along it, and the Sun comes as near to its place as that allows, | angle(place, axis) - theta |
//! off; of several antennas the one is taken that leaves the Sun nearest to its place. Without antennas the attitude is that of fans all
//! round.

use core::f64::consts::TAU;

use nalgebra::{ComplexField, Vector3};
use serde::{Deserialize, Serialize};

use crate::attitude::{SunAngles, angle_between_rad, direction_from_angles};
use crate::constants::DEG_RAD;
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::{Moving, MovingVector, PARALLEL_RAD, direction, fixed, unit, value};
use crate::guidance::pointing::antenna::{AntennaAzimuth, Antennas, BOUND_RAD};
use crate::guidance::pointing::law::PointingVectors;
use crate::math;
use crate::numerics::scalar::Scalar;

/// Request of a downlink attitude.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DownlinkRequest {
    /// Azimuth of the antenna's boresight, with -Y rolled toward the Sun; `None`: as the Sun's place needs it.
    pub antenna_azimuth_rad: Option<f64>,
    /// Requested direction of the Sun in the body frame; zero is on -Y. Read where no azimuth is given.
    pub sun_body: SunAngles,
    /// Whether the Earth's azimuth is A + delta; `None`: as the file's head says. Read where no azimuth is given.
    pub earth_ahead: Option<bool>,
}

/// Direction of the Sun in the body frame during a downlink, and the side of it on which the Earth stands: one of eq 20's two solutions.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DownlinkSunDirection {
    /// Azimuth and elevation of the Sun.
    pub angles: SunAngles,
    /// Whether the Earth's azimuth is A + delta; else A - delta.
    pub earth_ahead: bool,
}

impl DownlinkSunDirection {
    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        [self.angles.azimuth_rad, self.angles.elevation_rad].iter().all(|angle_rad| angle_rad.abs() <= TAU)
    }
}

/// Requested direction of the Sun in a downlink.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SunRequest {
    /// In the body frame; zero is on -Y.
    pub sun: SunAngles,
    /// Whether the attitude is turned by 180 deg about the Sun line: the Sun stays in its place, there is no link.
    pub alternate: bool,
    /// Zone that holds that direction.
    pub zone: Option<KeepIn>,
    /// Whether a zone moved that direction.
    pub is_moved: bool,
}

impl SunRequest {
    /// The same inside a zone, a direction outside at the point that the zone's method takes.
    #[must_use]
    pub fn within(self, zone: Option<&KeepIn>) -> Self {
        if self.sun == SunAngles::default() {
            return self;
        }
        let moved = zone.and_then(|zone| zone.boundary_angles(&direction_from_angles(self.sun)));
        Self { sun: moved.unwrap_or(self.sun), is_moved: moved.is_some(), ..self }
    }

    /// The same inside its own zone, this far from the Sun, in m.
    #[must_use]
    pub fn at_distance(self, distance_m: f64) -> Self {
        self.within(self.zone.filter(|zone| distance_m <= zone.distance_m).as_ref())
    }
}

/// Direction of the Sun that was selected for a downlink.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SelectedSunDirection {
    /// Direction of the Sun.
    pub place: DownlinkSunDirection,
    /// Whether limits keep the momentum from its target.
    pub clamped: bool,
}

/// Last selections; the slew after a downlink starts from its attitude, and that after science from its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SelectedSunDirections {
    /// Last selection for a downlink; `None`: on -Y.
    pub downlink: Option<SelectedSunDirection>,
    /// Last selection for science that unloads; `None`: on -Y.
    pub science: Option<SelectedSunDirection>,
}

impl SelectedSunDirections {
    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        [self.downlink, self.science].into_iter().flatten().all(|selected| selected.place.is_valid())
    }

    /// Direction of the Sun in the downlink attitude.
    pub fn in_downlink(&self) -> Option<DownlinkSunDirection> {
        self.downlink.map(|selected| selected.place)
    }

    /// Direction of the Sun in science that unloads.
    pub fn in_science(&self) -> Option<SunAngles> {
        self.science.map(|selected| selected.place.angles)
    }
}

/// A downlink attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Downlink {
    /// The antenna at the Earth, the Sun toward its place.
    pub vectors: PointingVectors,
    /// The antenna that looks at the Earth, and where in its range.
    pub antenna: AntennaAzimuth,
    /// Whether elevation or antenna stands at a bound, off what was requested.
    pub clamped: bool,
    /// At roots of these the law takes another form; infinite where there is none: the Earth's azimuth is the other one of both;
    /// elevation or antenna comes to a bound.
    pub margins: [f64; 2],
}

/// Azimuths of the Earth in the XY plane for one direction of the Sun.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EarthAzimuths {
    /// A - delta and A + delta, in rad, in no particular turn.
    pub azimuths: [Moving; 2],
    /// Direction of the Sun in the body frame, its elevation cut where it had to be.
    pub sun_body: MovingVector,
    /// How far it is from being cut, by sines; negative where it was.
    pub margin: f64,
    /// Cosine of the angle between Sun and Earth.
    pub cosine: f64,
}

/// The attitude that points an antenna at the Earth; `None` where Sun or Earth has no direction.
pub fn downlink(
    to_sun: &MovingVector,
    to_earth: &MovingVector,
    antennas: &Antennas,
    request: &DownlinkRequest,
) -> Option<Downlink> {
    let solutions = both_solutions(to_sun, to_earth, request.sun_body)?;
    let is_placed = request.antenna_azimuth_rad.is_none();
    let is_free = is_placed && request.earth_ahead.is_none();
    let (azimuth, sun_body, cut) = match request.antenna_azimuth_rad {
        Some(azimuth_rad) => {
            let minus_y = fixed(direction_from_angles(SunAngles::default()));
            (Moving::constant(azimuth_rad), minus_y, false)
        }
        None => {
            let [minus, plus] = solutions.azimuths;
            // The one inside a fan's range, or nearest to one; where both are inside, that on the default attitude's side.
            let preferred = || is_ahead(antennas, [minus.re, plus.re], solutions.cosine);
            let ahead = request.earth_ahead.unwrap_or_else(preferred);
            (if ahead { plus } else { minus }, solutions.sun_body, solutions.margin < 0.0)
        }
    };
    let vectors = |boresight_body, body_roll| PointingVectors {
        boresight_body,
        aimpoint: *to_earth,
        body_roll,
        external_roll: *to_sun,
    };
    let antenna = antennas.nearest_fan(azimuth.re);
    if is_free {
        let place_body = direction_from_angles(request.sun_body);
        let separation_rad = angle_between_rad(&value(to_sun), &value(to_earth));
        if let Some((row, axis_body)) = antennas.nearest_axis(&antenna, &place_body, separation_rad) {
            let vectors = vectors(fixed(axis_body), fixed(place_body));
            let antenna = AntennaAzimuth::fixed(row, &axis_body);
            let off_rad = (angle_between_rad(&place_body, &axis_body) - separation_rad).abs();
            // Nobody requested the default place.
            let clamped = request.sun_body != SunAngles::default() && off_rad > BOUND_RAD;
            return Some(Downlink { vectors, antenna, clamped, margins: [f64::INFINITY; 2] });
        }
    }
    let at_bound = antenna.antenna.is_some() && !antenna.is_in_range();
    let margins = [
        is_free.then(|| solutions.margin_of_choice(antennas)),
        is_placed.then(|| solutions.margin.min(antennas.fan_margin_rad(antenna.antenna, azimuth.re))),
    ];
    let boresight_azimuth = if at_bound { Moving::constant(antenna.azimuth_rad) } else { azimuth };
    Some(Downlink {
        vectors: vectors(direction(boresight_azimuth, Moving::constant(0.0)), sun_body),
        antenna,
        clamped: cut || at_bound,
        margins: margins.map(|margin| margin.unwrap_or(f64::INFINITY)),
    })
}

/// The vector turned by 180 deg about a direction: 2 s (s v) - v; unchanged where there is no direction.
pub fn half_turned(vector: &MovingVector, about: &MovingVector) -> MovingVector {
    unit(about).map_or(*vector, |axis| axis * (axis.dot(vector) * 2.0) - vector)
}

/// Both azimuths of the Earth in the XY plane with the Sun at `sun_body` (eq 20); `None` where one has no direction.
pub fn both_solutions(
    to_sun: &MovingVector,
    to_earth: &MovingVector,
    sun_body: SunAngles,
) -> Option<EarthAzimuths> {
    let (sun, earth) = (unit(to_sun)?, unit(to_earth)?);
    let cosine = sun.dot(&earth);
    let normal = sun.cross(&earth);
    let squared = normal.dot(&normal);
    // Sun and Earth in line: the plane of both is the law's fallback, theta stays.
    let sine = if squared.re > PARALLEL_RAD * PARALLEL_RAD { squared.sqrt() } else { Moving::constant(0.0) };
    let azimuth = Moving::constant(sun_body.azimuth_rad);
    let sine_elevation = math::sin(sun_body.elevation_rad);
    let above = sine_elevation.abs() >= sine.re;
    let (elevation, delta) = if above {
        // At the bound the great circle from the Sun meets the XY plane at a right angle, or on the far side.
        let bound = Moving::polar_angle(sine, cosine.abs()) * sine_elevation.signum();
        (bound, Moving::constant(if cosine.re < 0.0 { core::f64::consts::PI } else { 0.0 }))
    } else {
        let root = ((sine - sine_elevation) * (sine + sine_elevation)).sqrt();
        (Moving::constant(sun_body.elevation_rad), Moving::polar_angle(root, cosine))
    };
    Some(EarthAzimuths {
        azimuths: [azimuth - delta, azimuth + delta],
        sun_body: direction(azimuth, elevation),
        margin: sine.re - sine_elevation.abs(),
        cosine: cosine.re,
    })
}

impl EarthAzimuths {
    /// Changes its sign where the other azimuth is taken; positive with A - delta.
    fn margin_of_choice(&self, antennas: &Antennas) -> f64 {
        let [minus_rad, plus_rad] = self.azimuths.map(|azimuth| outside_rad(antennas, azimuth.re));
        let apart_rad = plus_rad - minus_rad;
        if apart_rad.abs() <= BOUND_RAD || apart_rad.is_nan() { self.cosine } else { apart_rad }
    }
}

/// How far an azimuth is outside the range of the nearest fan, in rad.
fn outside_rad(antennas: &Antennas, azimuth_rad: f64) -> f64 {
    let nearest = antennas.nearest_fan(azimuth_rad);
    if nearest.is_in_range() { 0.0 } else { nearest.outside_rad }
}

/// Whether of both azimuths of the Earth A + delta is taken, the cosine being that of the angle between Sun and Earth.
pub(crate) fn is_ahead(antennas: &Antennas, [minus_rad, plus_rad]: [f64; 2], cosine: f64) -> bool {
    // Symmetric ranges about the Sun line are equally far outside; rounding does not choose between them.
    let [minus_rad, plus_rad] = [minus_rad, plus_rad].map(|it| outside_rad(antennas, it));
    if cosine > 0.0 { plus_rad < minus_rad - BOUND_RAD } else { plus_rad <= minus_rad + BOUND_RAD }
}

/// Least angle between Sun and Earth for a link, assumed: no paper names it.
pub const SOLAR_EXCLUSION_RAD: f64 = 3.0 * DEG_RAD;

/// Conditions of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinkLimits {
    /// Least angle between Sun and Earth seen from the spacecraft, in rad.
    pub sun_separation_rad: f64,
    /// Half the width of every antenna's beam across the XY plane, in rad; `None`: each has its own.
    pub coverage_rad: Option<f64>,
}

/// Geometry of the link to the Earth.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    /// Angle between Sun and Earth seen from the spacecraft, in rad.
    pub sun_separation_rad: f64,
    /// Whether the Earth is in the beam's fan and the antenna's coverage.
    pub covered: bool,
    /// Whether it is, far enough from the Sun and not behind the planet.
    pub available: bool,
}

/// The link of a beam, the Earth being at `earth_body` in the body frame; `None` where Sun or Earth has no direction.
pub fn link(
    ephemeris: &EphemerisAtTime,
    earth_body: &Vector3<f64>,
    antennas: &Antennas,
    beam: Option<&AntennaAzimuth>,
    limits: &LinkLimits,
) -> Option<Link> {
    let earth = unit(&ephemeris.to_earth())?;
    let sun = unit(&ephemeris.to_sun())?;
    let sun_separation_rad = angle_between_rad(&value(&sun), &value(&earth));
    let covered = beam.is_some_and(|beam| antennas.covers(beam, earth_body, limits.coverage_rad));
    let available =
        covered && sun_separation_rad > limits.sun_separation_rad && !behind_planet(ephemeris, &earth);
    Some(Link { sun_separation_rad, covered, available })
}

/// Whether the line to the Earth meets the sphere of the planet's greatest radius on its way.
fn behind_planet(ephemeris: &EphemerisAtTime, earth: &MovingVector) -> bool {
    let to_planet_m = value(&ephemeris.to_planet());
    let earth = value(earth);
    let nearest_m = to_planet_m.dot(&earth);
    nearest_m > 0.0
        && nearest_m < value(&ephemeris.to_earth()).norm()
        && to_planet_m.cross(&earth).norm() < ephemeris.planet.radii_m.max()
}

#[cfg(test)]
mod tests;
