//! Directions of Sun and Earth for a spacecraft on a Lissajous orbit about the Sun-Earth L1 point.
//!
//! The Earth-Sun line turns at a steady rate in the ecliptic; about L1 the motion is linear (paper 002 gives the rate,
//! amplitudes are parameters).

use core::f64::consts::PI;

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::constants::ASTRONOMICAL_UNIT_M;
use crate::environment::frames::OBLIQUITY_J2000_RAD;
use crate::math;
use crate::toml::{Distance, Finite, tables};

/// Mean rate of the Earth about the Sun: 360 deg in a sidereal year of 365.256363 days.
const LINE_RATE_DEG_DAY: f64 = 360.0 / 365.256_363;
/// From the Earth to L1: 0.0100109 AU, the root of Euler's quintic for the mass of Earth and Moon, 1/328900.56 of the Sun's.
const EARTH_L1_AU: f64 = 0.010_010_9;

tables! {
/// Orbit about the Sun-Earth L1 point.
struct L1OrbitEntry makes #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)] #[serde(deny_unknown_fields)] pub struct L1Orbit or Default {
    /// Rate of the Earth-Sun line, in deg/day; otherwise the Earth's mean, 0.98561.
    line_rate_deg_day: Finite => |_| LINE_RATE_DEG_DAY,
    /// Sun to Earth, in m; otherwise 1 AU.
    sun_earth_distance_m: Distance => |_| ASTRONOMICAL_UNIT_M,
    /// Earth to L1, in m; otherwise 1.4976e9.
    earth_l1_distance_m: Distance => |_| EARTH_L1_AU * ASTRONOMICAL_UNIT_M,
    /// Lissajous amplitudes along the line, in the ecliptic across it, normal to the ecliptic, in m.
    amplitude_m: [Finite; 3] = [Finite(0.0), Finite(0.0), Finite(0.0)],
    // Linear frequencies about L1 in units of the mean motion, from the same root as its distance.
    /// In-plane frequency over the line's rate.
    in_plane_frequency: Finite = 2.0864,
    /// Out-of-plane frequency over the line's rate.
    out_of_plane_frequency: Finite = 2.0152,
    /// Ecliptic to equator, in deg; otherwise that of J2000.
    obliquity_deg: Finite => |_| OBLIQUITY_J2000_RAD.to_degrees(),
}
}

/// Unit vectors to Sun and Earth, EME2000.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SunEarth {
    /// Toward the Sun.
    pub sun_inertial: Vector3<f64>,
    /// Toward the Earth.
    pub earth_inertial: Vector3<f64>,
}

/// Phases of the Lissajous motion and of the Earth-Sun line at time 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct L1Phases {
    /// Ecliptic longitude of the Earth seen from the Sun, in rad.
    pub longitude_rad: f64,
    /// In-plane phase, in rad.
    pub in_plane_rad: f64,
    /// Out-of-plane phase, in rad.
    pub out_of_plane_rad: f64,
}

/// An L1 orbit as a flight uses it: the setup's, with what the master may change.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct L1Ephemeris {
    /// The orbit.
    pub orbit: L1Orbit,
    /// Its phases.
    pub phases: L1Phases,
}

impl L1Orbit {
    /// Rate of the Earth-Sun line, in rad/s.
    pub fn line_rate_rad_s(&self) -> f64 {
        (self.line_rate_deg_day * (PI / 180.0)) / 86_400.0
    }

    /// The same orbit with another rate of the Earth-Sun line and other amplitudes.
    #[must_use]
    pub fn changed(self, line_rate_rad_s: f64, amplitude_m: [f64; 3]) -> Self {
        Self { line_rate_deg_day: line_rate_rad_s * 86_400.0 / (PI / 180.0), amplitude_m, ..self }
    }

    /// Directions at `time_s`.
    pub fn sun_earth(&self, phases: &L1Phases, time_s: f64) -> SunEarth {
        let rate = self.line_rate_rad_s();
        let line = phases.longitude_rad + rate * time_s;
        let (sin_xy, cos_xy) = math::sin_cos(phases.in_plane_rad + self.in_plane_frequency * rate * time_s);
        let sin_z = math::sin(phases.out_of_plane_rad + self.out_of_plane_frequency * rate * time_s);
        // From L1: x away from the Sun, y along the Earth's motion, z to ecliptic north.
        let [ax, ay, az] = self.amplitude_m;
        let offset = Vector3::new(-ax * cos_xy, ay * sin_xy, az * sin_z);
        let earth = Vector3::new(self.earth_l1_distance_m, 0.0, 0.0) - offset;
        let sun = Vector3::new(self.earth_l1_distance_m - self.sun_earth_distance_m, 0.0, 0.0) - offset;
        let (sin_line, cos_line) = math::sin_cos(line);
        let (sin_obliquity, cos_obliquity) = math::sin_cos(self.obliquity_deg * (PI / 180.0));
        let to_equator = |v: Vector3<f64>| {
            let (x, y) = (v.x * cos_line - v.y * sin_line, v.x * sin_line + v.y * cos_line);
            Vector3::new(x, y * cos_obliquity - v.z * sin_obliquity, y * sin_obliquity + v.z * cos_obliquity)
                .normalize()
        };
        SunEarth { sun_inertial: to_equator(sun), earth_inertial: to_equator(earth) }
    }
}
