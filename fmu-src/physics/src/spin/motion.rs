//! Motion of the spinner between edges: anchored where torque last changed, evaluated anywhere after.
//!
//! Closed form and series hold about the principal axes; attitude, momentum and torque are turned into them and back.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::{
    coast::Coast,
    damper::Damper,
    series::{Anchor, BodyTorque, TaylorSegment},
};
use crate::attitude::{Inertia, Quaternion, RigidBodyState};
use crate::numerics::spacing::spacing;

/// A body faster than this is not followed.
const GREATEST_RATE_RAD_S: f64 = 1e4;
/// Nor is one that needs shorter segments.
const SHORTEST_SEGMENT_S: f64 = 1e-5;
/// Nor one that turns by more than this from one double to the next.
const GREATEST_TURN_RAD: f64 = 0.05;

/// Why a motion cannot be followed.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum MotionError {
    /// The rate, or a number that is none.
    #[error(
        "at {time_s} s the body turns at up to {rate_rad_s:e} rad/s; allowed is up to {GREATEST_RATE_RAD_S:e} rad/s: look \
         at torque.applied and at what fires"
    )]
    TooFast {
        /// When, in s.
        time_s: f64,
        /// Momentum over the least moment of inertia, in rad/s; NaN where the state is not finite.
        rate_rad_s: f64,
    },
    /// The torque.
    #[error(
        "at {time_s} s a torque with a component of {torque_n_m:e} N m changes the motion within less than \
         {SHORTEST_SEGMENT_S:e} s; allowed is what keeps the body below {GREATEST_RATE_RAD_S:e} rad/s: look at torque.applied \
         and its derivatives"
    )]
    TooSudden {
        /// When, in s.
        time_s: f64,
        /// Greatest component of the torque, in N m.
        torque_n_m: f64,
    },
    /// The clock.
    #[error(
        "at {time_s} s neighbouring double-precision times are {spacing_s:e} s apart, too far for a motion that changes within \
         {change_s:e} s: start the flight nearer to time 0"
    )]
    TooLate {
        /// When, in s.
        time_s: f64,
        /// From it to the next double, in s.
        spacing_s: f64,
        /// Time in which the motion changes, in s.
        change_s: f64,
    },
}

/// How the motion after the anchor is represented.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[allow(clippy::large_enum_variant, reason = "the state of a step must not allocate")]
enum Path {
    Coast(Coast),
    Series(TaylorSegment),
}

/// An interval of motion with one inertia and one torque law.
///
/// The anchor moves only where the caller changes torque or inertia, and from segment to segment; never to where somebody
/// looks. So the same edges give the same motion, to the bit, however it is sampled.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// The body.
    pub inertia: Inertia,
    /// The damper.
    pub damper: Damper,
    /// The torque of the present segment.
    pub torque: BodyTorque,
    anchor: Anchor,
    path: Path,
}

impl Motion {
    /// Motion from `anchor` on. `hint_s` is how long this torque will last, if known (infinite otherwise).
    pub fn new(inertia: Inertia, damper: Damper, torque: BodyTorque, anchor: Anchor, hint_s: f64) -> Self {
        let principal = Anchor { attitude: inertia.principal_attitude(anchor.attitude), ..anchor };
        let path = if torque.is_zero() && inertia.is_axisymmetric() {
            Path::Coast(Coast::new(&inertia, &damper, &principal))
        } else {
            let torque = torque.about_principal_axes(&inertia);
            Path::Series(TaylorSegment::new(&inertia, &damper, &torque, &principal, hint_s))
        };
        Self { inertia, damper, torque, anchor, path }
    }

    /// Start of the present closed form or segment, in s.
    pub fn anchor_s(&self) -> f64 {
        self.anchor.time_s
    }

    /// End of the present segment, in s; infinite for a closed form.
    pub fn segment_end_s(&self) -> f64 {
        match &self.path {
            Path::Coast(_) => f64::INFINITY,
            Path::Series(segment) => self.anchor.time_s + segment.length_s,
        }
    }

    /// Whether the body turns faster than segments can follow, or its numbers are not finite or no body's.
    pub fn diverges(&self) -> bool {
        self.check().is_err() || !self.inertia.is_valid()
    }

    /// Whether a decoded motion can be one: finite, and its path that of its anchor.
    pub fn is_valid(&self) -> bool {
        let path = match &self.path {
            // What it is made of says all of it.
            Path::Coast(coast) => {
                let attitude = self.inertia.principal_attitude(self.anchor.attitude);
                *coast == Coast::new(&self.inertia, &self.damper, &Anchor { attitude, ..self.anchor })
            }
            Path::Series(segment) => segment.is_valid(),
        };
        let unit = Quaternion::from_components(self.anchor.attitude.0).is_some();
        path && unit && self.damper.is_valid() && !self.diverges()
    }

    /// Whether the motion can be followed from the anchor on.
    ///
    /// # Errors
    /// The body turns too fast there, is not finite, or its torque leaves it a segment too short.
    pub fn check(&self) -> Result<(), MotionError> {
        self.check_rate(&self.anchor)?;
        let Path::Series(segment) = &self.path else { return Ok(()) };
        // Written so that a NaN is refused.
        if segment.length_s >= SHORTEST_SEGMENT_S {
            return check_clock(self.anchor.time_s, segment.length_s);
        }
        let torque_n_m = self.torque.at(self.anchor.time_s, &Vector3::zeros()).amax();
        Err(MotionError::TooSudden { time_s: self.anchor.time_s, torque_n_m })
    }

    /// The state at a time within the present segment, if it is finite and has a rate that can be followed.
    ///
    /// # Errors
    /// It turns too fast or is not finite.
    pub fn check_at(&self, time_s: f64) -> Result<RigidBodyState, MotionError> {
        let state = self.at(time_s);
        let RigidBodyState { attitude, momentum_inertial, .. } = state;
        self.check_rate(&Anchor { time_s, attitude, momentum_inertial })?;
        Ok(state)
    }

    fn check_rate(&self, at: &Anchor) -> Result<(), MotionError> {
        let Anchor { time_s, attitude, momentum_inertial } = *at;
        let least_kg_m2 = self.inertia.principal_kg_m2().into_iter().fold(f64::INFINITY, f64::min);
        let finite = attitude.0.iter().all(|x| x.is_finite());
        let rate_rad_s = if finite { momentum_inertial.norm() / least_kg_m2 } else { f64::NAN };
        if rate_rad_s <= GREATEST_RATE_RAD_S {
            return check_clock(time_s, rate_rad_s.recip());
        }
        Err(MotionError::TooFast { time_s, rate_rad_s })
    }

    /// Continues to the next segment. Without effect on a closed form.
    pub fn next_segment(&mut self) {
        let end_s = self.segment_end_s();
        if end_s.is_finite() {
            let RigidBodyState { attitude, momentum_inertial, .. } = self.at(end_s);
            let anchor = Anchor { time_s: end_s, attitude, momentum_inertial };
            *self = Self::new(self.inertia, self.damper, self.torque, anchor, f64::INFINITY);
        }
    }

    /// State at a time within the present segment (any time after the anchor for a closed form).
    #[inline]
    pub fn at(&self, time_s: f64) -> RigidBodyState {
        let dt_s = time_s - self.anchor.time_s;
        match &self.path {
            Path::Coast(coast) => self.conserved(coast.attitude_at(dt_s)),
            Path::Series(segment) => {
                let principal = segment.attitude(dt_s);
                if self.torque.is_zero() {
                    return self.conserved(principal);
                }
                let momentum_principal = segment.momentum_body(dt_s);
                RigidBodyState {
                    attitude: self.inertia.body_attitude(principal),
                    momentum_inertial: principal.inertial_from_body(&momentum_principal),
                    momentum_body: self.inertia.body_from_principal(&momentum_principal),
                }
            }
        }
    }

    /// The motion that follows at `time_s`, within the present segment, under another torque or inertia.
    #[must_use]
    pub fn followed_by(&self, time_s: f64, inertia: Inertia, torque: BodyTorque, hint_s: f64) -> Self {
        let state = self.at(time_s);
        let damper = if inertia == self.inertia { self.damper } else { self.damper.on(&inertia) };
        let attitude = state.attitude.normalized();
        let anchor = Anchor { time_s, attitude, momentum_inertial: state.momentum_inertial };
        Self::new(inertia, damper, torque, anchor, hint_s)
    }

    /// The state in which the principal axes have this attitude and the momentum is that of the anchor.
    fn conserved(&self, principal: Quaternion) -> RigidBodyState {
        let momentum_inertial = self.anchor.momentum_inertial;
        let attitude = self.inertia.body_attitude(principal);
        RigidBodyState {
            attitude,
            momentum_inertial,
            momentum_body: attitude.body_from_inertial(&momentum_inertial),
        }
    }
}

/// Whether doubles near `time_s` lie close enough for a motion that changes within `change_s`.
fn check_clock(time_s: f64, change_s: f64) -> Result<(), MotionError> {
    let spacing_s = spacing(time_s);
    // Written so that a NaN is refused.
    if spacing_s <= GREATEST_TURN_RAD * change_s {
        return Ok(());
    }
    Err(MotionError::TooLate { time_s, spacing_s, change_s })
}
