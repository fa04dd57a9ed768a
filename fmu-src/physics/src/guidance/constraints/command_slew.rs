//! Turn into a command from where the body stood when the command began.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::keep_in::KeepIn;
use super::slew::{Slew, SlewStart, SlewedFrame};
use crate::attitude::{Attitude, MovingFrame, MovingUnit};

/// Turn into a command.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct CommandSlew {
    /// When it begins, in s.
    pub begin_s: f64,
    /// Attitude of the body at the begin.
    from: Attitude,
    /// Its course; `None` until the command's own attitude at the beginning is known.
    slew: Option<Slew>,
}

impl CommandSlew {
    /// From this attitude at `begin_s` on.
    pub fn new(begin_s: f64, from: &MovingFrame) -> Self {
        Self { begin_s, from: Attitude::from_rotation(&from.inertial_from_body), slew: None }
    }

    /// Whether its course is not known yet.
    pub fn is_open(&self) -> bool {
        self.slew.is_none()
    }

    /// Computes its course toward the attitude `to` that the command has when the slew begins, the Sun being there, within a zone
    /// that holds both ends, at a rate of `rate_rad_s`.
    pub fn aim(&mut self, to: &MovingFrame, sun: &MovingUnit, zone: Option<&KeepIn>, rate_rad_s: f64) {
        let from = MovingFrame {
            inertial_from_body: self.from.inertial_from_body(),
            rate_body_rad_s: Vector3::zeros(),
        };
        let to_body = to.inertial_from_body.inverse();
        let drift = to_body * sun.rate_1_s - to.rate_body_rad_s.cross(&(to_body * sun.direction));
        // Twice what it is at the beginning bounds the drift of the Sun over the slew.
        let start = SlewStart { from: &from, to, to_sun: sun.direction, sun_drift_rad_s: 2.0 * drift.norm() };
        self.slew = Some(Slew::between(&start, zone, rate_rad_s));
    }

    /// Forgets its course: the command has another attitude where it begins.
    pub fn reopen(&mut self) {
        self.slew = None;
    }

    /// The attitude at `time_s` on the way to `target`; `None` once the command's own is reached.
    pub fn at(
        &self,
        time_s: f64,
        target: &MovingFrame,
        sun: &MovingUnit,
        rate_rad_s: f64,
    ) -> Option<SlewedFrame> {
        self.slew?.at(self.begin_s, time_s, target, sun, rate_rad_s)
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.from.is_rotation() && self.slew.is_none_or(|slew| slew.is_valid())
    }
}
