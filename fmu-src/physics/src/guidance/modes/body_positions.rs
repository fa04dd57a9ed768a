//! Positions by the ephemerides that a spacecraft carries, and trust in the precise ones (paper 001,
//! "Inertial pointing options").
//!
//! Operational uses the precise models alone. Safe Hold uses them until they are unavailable, then the coarse ones. Earth
//! Acquisition assumes that they failed. They are declared invalid where their Sun, in the estimated body frame, has been
//! away from the sensed one for a while, and at once where their span is left. Invalid they stay until the ground asks for
//! Operational again; they are judged anew then.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::mode::Mode;
use super::monitor::{Monitor, MonitorState};
use crate::attitude::{Attitude, angle_between_rad};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::value;

/// How far the Sun of the precise models may be from the sensed one, assumed: two degrees, a few times what Sun sensors err.
pub const SUN_TOLERANCE_RAD: f64 = 2.0 * crate::constants::DEG_RAD;

/// For how long it may be farther away, in s, assumed.
pub const SUN_PERSISTENCE_S: f64 = 10.0;

/// Positions of spacecraft and bodies by precise and coarse models.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyPositions {
    /// By the precise models, or by the only ones; `None` while a place is not known, or outside their span.
    pub precise: Option<EphemerisAtTime>,
    /// By the coarse models; `None` while a place is not known.
    pub coarse: Option<EphemerisAtTime>,
    /// Whether modes choose between both; otherwise the precise ones hold in every mode.
    pub by_mode: bool,
}

impl BodyPositions {
    /// The same in every mode.
    pub fn in_every_mode(ephemeris: Option<EphemerisAtTime>) -> Self {
        Self { precise: ephemeris, coarse: None, by_mode: false }
    }

    /// Positions that a mode uses; `None` while one is unknown.
    pub fn in_mode(&self, mode: Mode, trust: &EphemerisTrust) -> Option<&EphemerisAtTime> {
        let chosen = if self.by_mode && trust.uses_coarse(mode) { &self.coarse } else { &self.precise };
        chosen.as_ref()
    }

    /// Whether the positions of either model are known.
    pub fn are_known(&self) -> bool {
        self.precise.is_some() || self.coarse.is_some()
    }
}

/// Whether the precise models are trusted.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct EphemerisTrust {
    is_lost: bool,
    disagreement: MonitorState,
}

impl EphemerisTrust {
    /// Whether they are valid.
    pub fn is_valid(&self) -> bool {
        !self.is_lost
    }

    /// Whether a mode uses the coarse models where modes choose.
    pub fn uses_coarse(&self, mode: Mode) -> bool {
        match mode {
            Mode::Operational => false,
            Mode::SafeHold => self.is_lost,
            Mode::EarthAcquisition => true,
        }
    }
    /// Takes a sample. Where attitude or Sun are not known, or `check` is `None`, nothing contradicts the models.
    pub fn sample(
        &mut self,
        check: Option<&Monitor>,
        time_s: f64,
        positions: &BodyPositions,
        sensed: Option<(Attitude, Vector3<f64>)>,
    ) {
        if !positions.by_mode || self.is_lost {
            return;
        }
        let Some(precise) = &positions.precise else {
            self.is_lost = positions.coarse.is_some();
            return;
        };
        let angle_rad = sensed.map_or(0.0, |(estimate, sun_body)| {
            let computed = estimate.inertial_from_body().inverse() * value(&precise.to_sun());
            angle_between_rad(&computed, &sun_body)
        });
        match check {
            Some(check) => self.is_lost = check.trips(&mut self.disagreement, time_s, angle_rad),
            None => self.disagreement = MonitorState::default(),
        }
    }
}

#[cfg(test)]
mod tests;
