//! Source of the attitude: guidance, a command, or torque.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::{Attitude, MovingFrame, Quaternion};
use crate::guidance::Guided;

/// Source of the attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AttitudeSource {
    /// The orbit phase's own guidance; its schedule runs in epochs (s past J2000 TDB).
    Guided(Guided),
    /// A command, followed ideally.
    Commanded(Command),
    /// A body that turns by its dynamics; the orbit phase's own guidance, absent where commands come from elsewhere.
    Dynamic(Option<Guided>),
}

impl AttitudeSource {
    /// The orbit phase's own guidance, followed ideally or as a command to the controller.
    pub fn guided(&self) -> Option<&Guided> {
        match self {
            Self::Guided(guided) => Some(guided),
            Self::Commanded(_) => None,
            Self::Dynamic(guided) => guided.as_ref(),
        }
    }
}

/// An attitude by torque, which is known up to now.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turning {
    /// The attitude now, continuing at the present rate.
    pub motion: Command,
    /// Change of that rate: the first and second term of its series, in rad/s2 and rad/s3.
    pub rate_terms_body: [Vector3<f64>; 2],
}

impl From<Command> for Turning {
    fn from(motion: Command) -> Self {
        Self { motion, rate_terms_body: [Vector3::zeros(); 2] }
    }
}

impl Turning {
    /// A body that stands still in EME2000, where nothing turns by torque.
    pub fn still() -> Self {
        let attitude = Attitude::from_unit(Quaternion::IDENTITY);
        Command { attitude, rate_body_rad_s: Vector3::zeros(), since_s: 0.0 }.into()
    }

    /// Body frame and rate at `time_s`: the turn by the rate w + b t + c t^2 is w t + b t^2 / 2 + c t^3 / 3 + (w x b) t^3 / 12 +
    /// (w x c) t^4 / 12 to the fourth order (Magnus).
    pub fn frame_at(&self, time_s: f64) -> MovingFrame {
        let [slope, curve] = self.rate_terms_body;
        if slope == Vector3::zeros() && curve == Vector3::zeros() {
            return self.motion.frame_at(time_s);
        }
        let (rate, elapsed_s) = (self.motion.rate_body_rad_s, time_s - self.motion.since_s);
        let square = elapsed_s * elapsed_s;
        let straight = rate * elapsed_s + (slope / 2.0 + curve * (elapsed_s / 3.0)) * square;
        let bent = rate.cross(&(slope + curve * elapsed_s)) * (square * elapsed_s / 12.0);
        MovingFrame {
            inertial_from_body: self.motion.attitude.turned(straight + bent).inertial_from_body(),
            rate_body_rad_s: rate + (slope + curve * elapsed_s) * elapsed_s,
        }
    }
}

/// A commanded attitude, turning on at a constant rate.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Command {
    /// Attitude at `since_s`.
    pub attitude: Attitude,
    /// Body rate, in rad/s.
    pub rate_body_rad_s: Vector3<f64>,
    /// Time at which the command took effect, in s.
    pub since_s: f64,
}

impl Command {
    /// Body frame and rate at `time_s`.
    pub fn frame_at(&self, time_s: f64) -> MovingFrame {
        MovingFrame {
            inertial_from_body: self.attitude_at(time_s).inertial_from_body(),
            rate_body_rad_s: self.rate_body_rad_s,
        }
    }

    /// The attitude at `time_s`.
    pub fn attitude_at(&self, time_s: f64) -> Attitude {
        self.attitude.propagated(self.rate_body_rad_s, time_s - self.since_s)
    }
}
