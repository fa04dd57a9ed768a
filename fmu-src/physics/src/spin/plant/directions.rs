//! Directions of Sun, Earth and star in inertial space: as given, or Sun and Earth from the L1 orbit.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::numerics::or_infinite;
use crate::spin::geometry::{L1Ephemeris, SunEarth};

/// Sun and Earth of the L1 orbit stand still for the sensors over intervals of this length, in s: less than 0.01 deg.
const INTERVAL_S: f64 = 600.0;

/// Beyond these lengths the squares of a vector's components under- or overflow.
const NORMALIZABLE: core::ops::RangeInclusive<f64> = 1e-100..=1e100;

/// Directions in inertial space that the sensors look for; unit vectors, or 0 for one that is not known: nothing is seen
/// there. On the L1 orbit those of Sun and Earth do not count.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Directions {
    /// Sun.
    pub sun_inertial: Vector3<f64>,
    /// Earth.
    pub earth_inertial: Vector3<f64>,
    /// Star.
    pub star_inertial: Vector3<f64>,
}

/// Source of the directions of the sensors.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct DirectionSource {
    /// Directions that the sensors look for now.
    pub present: Directions,
    /// The L1 orbit; without it Sun and Earth stand where they are given.
    l1: Option<L1Ephemeris>,
    refresh_count: i64,
    /// Time at which the directions of the L1 orbit are next computed, in s; infinite without it.
    #[serde(with = "or_infinite")]
    pub refresh_s: f64,
}

impl Directions {
    /// The unit vector along a vector; 0 of 0, and `None` of one so short or long that rounding takes its direction.
    pub fn unit(along: [f64; 3]) -> Option<Vector3<f64>> {
        let vector = Vector3::from(along);
        let norm = vector.norm();
        if NORMALIZABLE.contains(&norm) {
            return Some(vector / norm);
        }
        (along == [0.0; 3]).then(Vector3::zeros)
    }

    /// Whether all are unit vectors, or none.
    pub(super) fn are_directions(&self) -> bool {
        let unit = |direction: &Vector3<f64>| *direction == Vector3::zeros() || is_unit(direction);
        [&self.sun_inertial, &self.earth_inertial, &self.star_inertial].into_iter().all(unit)
    }
}

impl DirectionSource {
    /// Directions at the start; with an L1 orbit only the star of `given` counts.
    pub(super) fn new(given: Directions, l1: Option<L1Ephemeris>, start_s: f64) -> Self {
        let mut source = Self { present: given, l1, refresh_count: 0, refresh_s: f64::INFINITY };
        if l1.is_some() {
            source.refresh_count = (start_s / INTERVAL_S).floor() as i64;
            source.refresh_s = source.refresh_count as f64 * INTERVAL_S;
            source.refresh();
        }
        source
    }

    /// New directions; with the L1 orbit in charge, only the star of `given` counts.
    pub(super) fn give(&mut self, given: Directions) {
        self.present = match self.l1 {
            Some(_) => Directions { star_inertial: given.star_inertial, ..self.present },
            None => given,
        };
    }

    /// Looks up Sun and Earth on the L1 orbit for the interval that begins; when it does, in s.
    pub(super) fn refresh(&mut self) -> Option<f64> {
        self.l1.as_ref()?;
        let from_s = self.refresh_s;
        self.present = self.at(from_s);
        self.refresh_count = self.refresh_count.saturating_add(1);
        self.refresh_s = self.refresh_count as f64 * INTERVAL_S;
        Some(from_s)
    }

    /// Directions at a time: on the L1 orbit they move.
    pub(super) fn at(&self, time_s: f64) -> Directions {
        let Some(L1Ephemeris { orbit, phases }) = &self.l1 else { return self.present };
        let SunEarth { sun_inertial, earth_inertial } = orbit.sun_earth(phases, time_s);
        Directions { sun_inertial, earth_inertial, ..self.present }
    }

    /// Whether a decoded source can be one at `time_s`.
    pub(super) fn is_valid(&self, time_s: f64) -> bool {
        let refreshes = match &self.l1 {
            None => self.refresh_s == f64::INFINITY,
            Some(l1) => {
                has_directions(l1)
                    && self.refresh_s == self.refresh_count as f64 * INTERVAL_S
                    && (self.refresh_s - time_s).abs() <= 2.0 * INTERVAL_S
            }
        };
        self.present.are_directions() && refreshes
    }
}

/// Whether Sun and Earth of an L1 orbit have a direction at any time.
pub(super) fn has_directions(L1Ephemeris { orbit, .. }: &L1Ephemeris) -> bool {
    orbit.amplitude_m[0].abs() < orbit.earth_l1_distance_m
}

/// Whether the norm of a decoded unit vector is 1, up to rounding.
pub(super) fn is_unit(vector: &Vector3<f64>) -> bool {
    (vector.norm() - 1.0).abs() <= 1e-6
}
