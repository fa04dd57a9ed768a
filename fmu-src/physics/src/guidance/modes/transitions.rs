//! Modes: Operational, Safe Hold, Earth Acquisition with its Sun search (paper 001, "Safe Modes").
//!
//! Demotion is autonomous: lost attitude leads to Earth Acquisition, the constraint monitor one mode down. Promotion comes
//! by request alone. A request acts at the sample where it changes, so that one that is held does not undo a demotion; a
//! reason to demote at the same sample outweighs it. Losing the Sun sensors alone demotes nothing. Losing the precise
//! ephemerides, where a spacecraft carries its own ([`super::body_positions`]), ends Operational.
//!
//! In Earth Acquisition the Sun is sensed, or computed from the ephemeris with the estimated attitude once that is back.
//! The error quaternion (eqs 25 and 26) is the rotation from the commanded to the actual frame: A(q) takes the components
//! of the boresight B to those of the sensed Sun S. At S = -B the rotation's axis is free; it is the part perpendicular to
//! B of +Z, or of +X where B lies along Z. With neither Sun there is a rate alone, about X, Y and Z in turn.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::body_positions::{BodyPositions, EphemerisTrust};
use super::mode::{Mode, ModeReason};
use super::monitor::{Monitor, MonitorState, Violation, excess};
use crate::attitude::{Attitude, Quaternion};
use crate::guidance::constraints::constrained::{Constraints, Excess};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::value;

/// Two unit vectors whose cross product is as small as this are opposite within rounding.
const OPPOSITE: f64 = 1e-15;

/// Rate of Earth Acquisition, assumed: a turn in three hours. Paper 001 says slow.
pub const EARTH_ACQUISITION_RATE_RAD_S: f64 = core::f64::consts::TAU / 10_800.0;

/// Rate of the Sun search, assumed: half a degree a second. Paper 001 says slow.
pub const SUN_SEARCH_RATE_RAD_S: f64 = 0.5 * crate::constants::DEG_RAD;

/// How long the search turns about one axis, assumed: a whole turn.
pub const SUN_SEARCH_DURATION_S: f64 = core::f64::consts::TAU / SUN_SEARCH_RATE_RAD_S;

/// Parameters of the modes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ModeSettings {
    /// Constraints in Operational.
    pub operational: Constraints,
    /// Constraints in Safe Hold.
    pub safe_hold: Constraints,
    /// `None` is off.
    pub monitor: Option<Monitor>,
    /// How far from the sensed Sun that of the precise ephemerides may be, and for how long; `None`: nobody looks.
    pub ephemeris_check: Option<Monitor>,
    /// Whether it watches the hot pole; not while no turn about the Sun line reaches the cone's boundary.
    pub watches_hot_pole: bool,
    /// Boresight of Earth Acquisition, body frame, of any length.
    pub boresight_body: Vector3<f64>,
    /// Rate of Earth Acquisition about its boresight, in rad/s.
    pub earth_acquisition_rate_rad_s: f64,
    /// Rate of the Sun search, in rad/s.
    pub sun_search_rate_rad_s: f64,
    /// How long the search turns about one axis, in s.
    pub sun_search_duration_s: f64,
}

/// Measurements and requests at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sensed {
    /// Time of the sample, in s.
    pub time_s: f64,
    /// The mode that is requested.
    pub request: Option<Mode>,
    /// Whether a timeline requests it.
    pub is_of_timeline: bool,
    /// Estimated attitude; `None` where it is not valid.
    pub estimate: Option<Attitude>,
    /// Sun in the body frame by the Sun sensors, of any length; `None` where not valid.
    pub sun_body: Option<Vector3<f64>>,
}

/// Steering that a mode takes at a sample.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Steering {
    /// An attitude within these constraints.
    Pointing(Constraints),
    /// Rotation about the Sun line.
    ErrorQuaternion {
        /// From the commanded to the actual frame, scalar last.
        error: Quaternion,
        /// Body rate, in rad/s.
        rate_body_rad_s: Vector3<f64>,
    },
    /// A rate alone, body frame, in rad/s.
    RateOnly(Vector3<f64>),
}

/// Memory of the modes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ModeState {
    /// Active.
    pub mode: Mode,
    /// Why, since the mode changed last; without an estimate of the attitude what is lost now. `None`: the mode of the start.
    pub reason: Option<ModeReason>,
    /// Request of the last sample.
    pub last_request: Option<Mode>,
    /// When the Sun search began, in s; `None` outside a search.
    pub search_since_s: Option<f64>,
    /// Constraint monitor.
    pub monitor: MonitorState,
    /// Trust in the precise ephemerides.
    pub ephemeris: EphemerisTrust,
}

impl ModeState {
    /// Changes the mode by a sample and returns the steering in it; `None` where no boresight has a direction.
    /// While positions are unknown no constraint is judged.
    pub fn sample(
        &mut self,
        settings: &ModeSettings,
        sensed: &Sensed,
        positions: &BodyPositions,
    ) -> Option<Steering> {
        self.change_mode(settings, sensed, positions);
        if self.mode != Mode::EarthAcquisition {
            self.search_since_s = None;
            return Some(Steering::Pointing(*settings.constraints(self.mode)));
        }
        let Some(sun_body) = sun_body(sensed, self.ephemeris_in_mode(positions)) else {
            let since_s = *self.search_since_s.get_or_insert(sensed.time_s);
            return Some(Steering::RateOnly(settings.search_rate_body_rad_s(sensed.time_s - since_s)));
        };
        self.search_since_s = None;
        let boresight_body = settings.boresight_body.try_normalize(0.0)?;
        Some(Steering::ErrorQuaternion {
            error: error_quaternion(&boresight_body, &sun_body)?,
            rate_body_rad_s: boresight_body * settings.earth_acquisition_rate_rad_s,
        })
    }

    /// Positions by the ephemerides that the mode uses.
    pub fn ephemeris_in_mode<'p>(&self, positions: &'p BodyPositions) -> Option<&'p EphemerisAtTime> {
        positions.in_mode(self.mode, &self.ephemeris)
    }

    /// The next lower mode.
    fn demote(&mut self, reason: ModeReason) {
        self.mode = self.mode.demoted();
        self.reason = Some(reason);
    }

    fn change_mode(&mut self, settings: &ModeSettings, sensed: &Sensed, positions: &BodyPositions) {
        let requested = sensed.request.filter(|_| sensed.request != self.last_request);
        self.last_request = sensed.request;
        if let Some(mode) = requested {
            if mode != self.mode {
                let by = if sensed.is_of_timeline { ModeReason::Timeline } else { ModeReason::Request };
                self.reason = Some(by);
            }
            self.mode = mode;
            // A violation is judged anew, without the lenience toward a safing turn.
            self.monitor = MonitorState::default();
            if mode == Mode::Operational {
                self.ephemeris = EphemerisTrust::default();
            }
        }
        let sensed_sun = sensed.sun_body.and_then(direction);
        let sun_in_estimate = sensed.estimate.zip(sensed_sun);
        self.ephemeris.sample(settings.ephemeris_check.as_ref(), sensed.time_s, positions, sun_in_estimate);
        if self.mode == Mode::Operational && !self.ephemeris.is_valid() {
            // Coarse models do not point as Operational demands.
            self.demote(ModeReason::Ephemeris);
            // The turn to where the coarse Sun stands is a safing turn: any excess is less.
            let violation =
                Violation { since_s: sensed.time_s, least_excess_rad: Some(core::f64::consts::TAU) };
            self.monitor.violation = Some(violation);
        }
        let Some(estimate) = &sensed.estimate else {
            self.mode = Mode::EarthAcquisition;
            // Without the attitude no ephemeris tells where the Sun is in the body.
            let lost = if sensed_sun.is_some() { ModeReason::AttitudeLost } else { ModeReason::SunLost };
            self.reason = Some(lost);
            self.monitor = MonitorState::default();
            return;
        };
        // Below the last pointing mode nothing is left to demote.
        let Some(monitor) = settings.monitor.filter(|_| self.mode != Mode::EarthAcquisition) else {
            self.monitor = MonitorState::default();
            return;
        };
        let excess = self.ephemeris_in_mode(positions).map_or(Excess::NONE, |ephemeris| {
            let constraints = settings.constraints(self.mode);
            let hot_pole = constraints.hot_pole.filter(|_| settings.watches_hot_pole);
            excess(&Constraints { hot_pole, ..*constraints }, estimate, ephemeris)
        });
        let reason = if self.monitor.is_answered() {
            ModeReason::NoProgress
        } else if excess.planet_rad > excess.sun_rad {
            ModeReason::HotPole
        } else {
            ModeReason::SunKeepIn
        };
        if monitor.trips(&mut self.monitor, sensed.time_s, excess.greatest_rad()) {
            self.demote(reason);
        }
    }
}

impl ModeSettings {
    fn constraints(&self, mode: Mode) -> &Constraints {
        match mode {
            Mode::Operational => &self.operational,
            Mode::SafeHold | Mode::EarthAcquisition => &self.safe_hold,
        }
    }

    /// Rate `elapsed_s` after the search began; about X throughout where the duration is not positive.
    fn search_rate_body_rad_s(&self, elapsed_s: f64) -> Vector3<f64> {
        // Samples at the edge belong to the axis that follows, whatever the rounding of their times.
        let turns = (elapsed_s / self.sun_search_duration_s + 1e-9).floor().rem_euclid(3.0);
        let axis = match turns {
            1.0 => Vector3::y(),
            2.0 => Vector3::z(),
            _ => Vector3::x(),
        };
        axis * self.sun_search_rate_rad_s
    }
}

/// Unit vector to the Sun in the body frame: sensed, or else of the ephemeris in the estimated attitude.
pub fn sun_body(sensed: &Sensed, ephemeris: Option<&EphemerisAtTime>) -> Option<Vector3<f64>> {
    let computed = || {
        let to_sun = value(&ephemeris?.to_sun());
        Some(sensed.estimate?.inertial_from_body().inverse() * to_sun)
    };
    sensed.sun_body.and_then(direction).or_else(|| computed().and_then(direction))
}

/// Its unit vector; `None` where it has none.
fn direction(vector: Vector3<f64>) -> Option<Vector3<f64>> {
    let largest = vector.amax();
    (largest.is_finite() && largest > 0.0).then(|| (vector / largest).normalize())
}

/// Eqs 25 and 26 for the unit vectors `boresight_body` and `sun_body`; `None` where one is none.
pub fn error_quaternion(boresight_body: &Vector3<f64>, sun_body: &Vector3<f64>) -> Option<Quaternion> {
    let (sum, difference) = (sun_body + boresight_body, sun_body - boresight_body);
    let normal = sun_body.cross(boresight_body);
    let axis = if normal.norm() > OPPOSITE || sum.norm() > 1.0 {
        normal
    } else if boresight_body.cross(&Vector3::z()).norm() > OPPOSITE {
        Vector3::z()
    } else {
        Vector3::x()
    };
    // Perpendicular to S - B, where rounding would have it otherwise near S = -B.
    let length = difference.norm();
    let across =
        if length > 0.0 { axis - difference * (axis.dot(&difference) / (length * length)) } else { axis };
    let size = across.norm();
    let unit_axis = if size > 0.0 { across / size } else { Vector3::zeros() };
    let vector = unit_axis * length;
    let norm = (vector.norm_squared() + sum.norm_squared()).sqrt();
    (norm.is_finite() && norm > 0.0)
        .then(|| Quaternion([vector.x / norm, vector.y / norm, vector.z / norm, sum.norm() / norm]))
}

#[cfg(test)]
mod tests;
