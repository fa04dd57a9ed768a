//! A command of the sampled guidance, propagated by its rate.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::transitions::Steering;
use crate::attitude::{Attitude, MovingFrame, Quaternion};
use crate::enumeration::enumeration;

enumeration! {
    /// What a command gives.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
    pub enum CommandKind {
        /// No command yet: the attitude is held.
        #[default]
        0 => None,
        /// Attitude command.q and rate command.rate.
        1 => Attitude,
        /// The attitude held turns at once, when this item is chosen, by the conjugate of command.error; then with
        /// command.rate.
        2 => ErrorQuaternion,
        /// The attitude held turns on with command.rate.
        3 => RateOnly,
    }
}

/// A command, propagated by its rate from its sample on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GuidanceCommand {
    /// Kind of the command.
    pub kind: CommandKind,
    /// When it was computed, in s.
    pub since_s: f64,
    /// Attitude then, the sign of its quaternion continuing from command to command; without [`CommandKind::Attitude`] the one
    /// held before.
    attitude: Attitude,
    /// Body rate, in rad/s.
    pub rate_body_rad_s: Vector3<f64>,
    /// From the commanded to the actual body frame, scalar last (paper 001 eq 25).
    pub error: [f64; 4],
}

impl GuidanceCommand {
    /// The attitude held from `since_s` on, before anything is commanded.
    pub(super) fn held(attitude: Attitude, since_s: f64) -> Self {
        Self {
            kind: CommandKind::None,
            since_s,
            attitude,
            rate_body_rad_s: Vector3::zeros(),
            error: [0.0, 0.0, 0.0, 1.0],
        }
    }

    /// Whether decoded numbers are a rotation.
    pub(super) fn is_valid(&self) -> bool {
        self.attitude.is_rotation()
    }

    /// A command without an attitude of its own: the attitude reached at `time_s` is propagated by the rate.
    pub(super) fn followed_by_rate(&self, steering: &Steering, time_s: f64) -> Self {
        let (kind, Quaternion(error), rate_body_rad_s) = match *steering {
            Steering::Pointing(_) => return *self,
            Steering::RateOnly(rate) => (CommandKind::RateOnly, Quaternion::IDENTITY, rate),
            Steering::ErrorQuaternion { error, rate_body_rad_s } => {
                (CommandKind::ErrorQuaternion, error, rate_body_rad_s)
            }
        };
        Self { kind, since_s: time_s, attitude: self.attitude_at(time_s), rate_body_rad_s, error }
    }

    /// An attitude and rate at `time_s`, the quaternion's sign continuing.
    pub(super) fn followed_by(&self, frame: &MovingFrame, time_s: f64) -> Self {
        let attitude = Attitude::from_rotation(&frame.inertial_from_body);
        Self {
            kind: CommandKind::Attitude,
            since_s: time_s,
            attitude: attitude.continuing(&self.attitude_at(time_s).unit_quaternion()),
            rate_body_rad_s: frame.rate_body_rad_s,
            error: [0.0, 0.0, 0.0, 1.0],
        }
    }

    /// Attitude at `time_s`, its quaternion continuous from the sample on.
    pub fn attitude_at(&self, time_s: f64) -> Attitude {
        self.attitude.propagated(self.rate_body_rad_s, time_s - self.since_s)
    }

    /// Body frame and rate at `time_s`.
    pub(super) fn frame_at(&self, time_s: f64) -> MovingFrame {
        let inertial_from_body = self.attitude_at(time_s).inertial_from_body();
        MovingFrame { inertial_from_body, rate_body_rad_s: self.rate_body_rad_s }
    }

    /// Rate of its quaternion, in 1/s.
    pub fn quaternion_rate_at(&self, time_s: f64) -> [f64; 4] {
        self.attitude_at(time_s).quaternion_rate(&self.rate_body_rad_s)
    }
}
