//! Constraint monitor: watches the estimated attitude and asks for the safing turn (paper 001, "Constrained pointing").
//!
//! A violation is an excess over the constraints widened by the margin. When one has lasted for the persistence, the
//! monitor trips and the mode is demoted by one. The safing turn then needs time: until the same violation has ended, its
//! time counts from the last sample that brought the excess to a new minimum, so that only a turn that makes no progress
//! is followed by a second demotion.

use serde::{Deserialize, Serialize};

use crate::attitude::Attitude;
use crate::guidance::constraints::constrained::{Constraints, Excess};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::value;

/// How far beyond a boundary counts as a violation, assumed: a degree.
pub const MARGIN_RAD: f64 = crate::constants::DEG_RAD;

/// Limits of the monitor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Monitor {
    /// By how much a constraint may be exceeded, in rad.
    pub margin_rad: f64,
    /// For how long, in s.
    pub persistence_s: f64,
}

/// A violation that lasts.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Violation {
    /// From when it counts, in s.
    pub since_s: f64,
    /// Least excess since it was answered by a demotion, in rad; `None`: not answered.
    pub least_excess_rad: Option<f64>,
}

/// Memory of the monitor.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct MonitorState {
    /// The present violation.
    pub violation: Option<Violation>,
}

impl MonitorState {
    /// Whether the present violation was answered by a demotion: a second one means that the turn makes no progress.
    pub fn is_answered(&self) -> bool {
        self.violation.is_some_and(|violation| violation.least_excess_rad.is_some())
    }
}

impl Monitor {
    /// Takes the sample at `time_s` with this excess over `constraints` (unwidened); whether the mode is to be demoted.
    pub fn trips(&self, state: &mut MonitorState, time_s: f64, excess_rad: f64) -> bool {
        // What is not a number is no violation.
        if excess_rad.is_nan() || excess_rad <= self.margin_rad {
            state.violation = None;
            return false;
        }
        let violation = state.violation.get_or_insert(Violation { since_s: time_s, least_excess_rad: None });
        if let Some(least_rad) = &mut violation.least_excess_rad
            && excess_rad < *least_rad
        {
            *least_rad = excess_rad;
            violation.since_s = time_s;
        }
        let trips = time_s - violation.since_s >= self.persistence_s;
        if trips {
            *violation = Violation { since_s: time_s, least_excess_rad: Some(excess_rad) };
        }
        trips
    }
}

/// By how much an estimated attitude exceeds the constraints.
pub fn excess(constraints: &Constraints, estimate: &Attitude, ephemeris: &EphemerisAtTime) -> Excess {
    let body_from_inertial = estimate.inertial_from_body().inverse();
    let in_region = constraints.hot_pole.is_some_and(|cone| cone.in_region(ephemeris));
    let body = |vector| body_from_inertial * value(&vector);
    constraints.excess(&body(ephemeris.to_sun()), &body(ephemeris.to_planet()), in_region)
}

#[cfg(test)]
mod tests;
