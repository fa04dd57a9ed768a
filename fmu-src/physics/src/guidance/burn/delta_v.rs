//! Delta-V steering (paper 001, "Delta-V guidance", Figure 9): where to point the thrust, and when to end it.
//!
//! Once a second the accelerometers' increment, turned by the estimate at mid-interval, is added to velocity and magnitude.
//! The magnitude tells the point of the path where the burn should be (2 in the figure), a look-ahead further on is the aimpoint
//! (4). Steering starts from the path's tangent and has two corrections:
//! - theta, predictive: the thrust direction in the body frame, the boresight, turns by a fraction `gain` of the angle to the
//!   measured direction. That accumulates until the offset from nominal is found.
//! - beta, reactive: the tangent turns by the rotation that takes the line from 2 to 4 onto the line from the actual
//!   velocity to 4, so that an offset decays over the look-ahead.
//!
//! The tangent and not the chord to the aimpoint: a chord leads a turning path by half the look-ahead and cuts its corners. The
//! tangent's turn at the estimated acceleration is the commanded rate. Cut-off is where the magnitude reaches the length of
//! the path, predicted from the estimated acceleration: the greater of the last two intervals', since thrust may fill a part
//! of one; before there is any, the nominal one. Paper 001 says that the secondary pair -Y and Sun is not relied on for Sun
//! safety, since the mission's design keeps burns inside the keep-in zone: constraints hold as in any scenario, but a burn
//! does not begin while they keep the thrust off its commanded direction. It waits as long as thrust may last, then its time is up.

use nalgebra::{Rotation3, Vector3};
use serde::{Deserialize, Serialize};

use super::nominal_thrust::NominalThrust;
use super::velocity_path::VelocityPath;
use crate::attitude::{Attitude, angle_between_rad};
use crate::constants::DEG_RAD;
use crate::guidance::geometry::moving::{MovingVector, moving, value};
use crate::spacecraft::ThrusterSet;

/// Look-ahead, assumed; paper 001 gives none.
pub const LOOK_AHEAD_S: f64 = 10.0;

/// Fraction of a measured direction that the predictive correction takes over each second, assumed.
pub const GAIN: f64 = 0.3;

/// A measured acceleration below this fraction of the nominal one is no thrust.
const LEAST_FRACTION: f64 = 0.1;

/// Least acceleration that counts as thrust without a nominal one, in m/s2.
const LEAST_ACCELERATION_M_S2: f64 = 1e-3;

/// How near the estimated attitude brings the thrust to its aimpoint where a burn begins with that, in rad: it costs 2e-4 of the
/// first seconds' delta-v along the path, and the reactive correction takes back what it puts across.
const ATTITUDE_REACHED_RAD: f64 = DEG_RAD;

/// Settings of a burn, by parameters or a timeline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurnSettings {
    /// The velocity to add; `None` where that has no direction.
    pub path: Option<VelocityPath>,
    /// The thrusters that are requested.
    pub thrusters: Option<ThrusterSet>,
    /// Earliest time at which thrust begins, in s.
    pub start_s: f64,
    /// Whether it begins when the estimated attitude has the thrust on its commanded direction, and not before.
    pub awaits_attitude: bool,
    /// How far ahead the path is aimed at, in s at the estimated acceleration.
    pub look_ahead_s: f64,
    /// Fraction of a measured direction that the predictive correction takes over each second.
    pub gain: f64,
    /// Whether theta is corrected.
    pub predictive: bool,
    /// Whether beta is.
    pub reactive: bool,
    /// Thrust and acceleration as planned: its direction is where the estimate begins; an acceleration of 0 is not known.
    pub nominal: NominalThrust,
    /// Longest time that thrust may last, in s.
    pub timeout_s: f64,
    /// Longest time that a burn which is due waits for its direction, in s.
    pub wait_s: f64,
}

/// Measured motion at a sample.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MeasuredMotion {
    /// When, in s.
    pub time_s: f64,
    /// Estimated attitude.
    pub attitude: Attitude,
    /// Sum of the accelerometers' increments along the body axes since some start, in m/s.
    pub delta_v_body_m_s: Vector3<f64>,
}

/// How far a burn is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum BurnPhase {
    /// No burn is commanded.
    #[default]
    None,
    /// The thrust is pointed at the beginning of the path.
    Waiting {
        /// Since when, in s.
        since_s: f64,
        /// Whether it is due and the constraints keep the thrust off its commanded direction, or there is no direction to aim at.
        refused: bool,
    },
    /// Thrust since this time, in s, until a time in s that is predicted anew at each sample.
    Burning {
        /// Since when.
        since_s: f64,
        /// Until when.
        stop_s: f64,
    },
    /// The burn is over; its results stay.
    Ended {
        /// Whether its time was up before its magnitude, or it ended before it began.
        timed_out: bool,
    },
}

/// Thrust direction that a burn commands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BurnPointing {
    /// Unit vector of the estimated thrust in the body frame.
    pub boresight_body: Vector3<f64>,
    /// Commanded direction of the thrust, EME2000.
    pub direction: MovingVector,
}

/// State of the steering.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct BurnState {
    /// Phase that the burn is in.
    pub phase: BurnPhase,
    /// Whether a burn was commanded at the last sample.
    is_commanded: bool,
    last: Option<MeasuredMotion>,
    /// Velocity that the burn added, EME2000, in m/s.
    pub velocity_m_s: Vector3<f64>,
    /// Sum of the increments' magnitudes, in m/s.
    magnitude_m_s: f64,
    /// Estimated thrust direction, a unit vector; `None` before a burn: the nominal one.
    thrust_body: Option<Vector3<f64>>,
    /// Accelerations over the last two intervals, the later one first, in m/s2.
    accelerations_m_s2: [f64; 2],
    /// Interruption at the last sample.
    pub interruption: Option<Interruption>,
}

/// How a burn ended that was not over.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Interruption {
    /// Thrust had not begun.
    BeforeThrust,
    /// Its thrust was cut off before its stop.
    CutOff,
}

impl BurnSettings {
    fn is_thrust(&self, acceleration_m_s2: f64) -> bool {
        let least_m_s2 = if self.nominal.acceleration_m_s2 > 0.0 {
            LEAST_FRACTION * self.nominal.acceleration_m_s2
        } else {
            LEAST_ACCELERATION_M_S2
        };
        acceleration_m_s2 >= least_m_s2
    }
}

impl BurnState {
    /// Whether thrusters are requested.
    pub fn is_requested(&self) -> bool {
        matches!(self.phase, BurnPhase::Waiting { .. } | BurnPhase::Burning { .. })
    }

    /// When thrust ends, in s; `None` without thrust.
    pub fn stop_s(&self) -> Option<f64> {
        let BurnPhase::Burning { stop_s, .. } = self.phase else { return None };
        Some(stop_s)
    }

    /// How far that is off the path at the magnitude reached, in m/s.
    pub fn velocity_error_m_s(&self, settings: &BurnSettings) -> Vector3<f64> {
        let point = settings.path.as_ref().map(|path| path.point(self.magnitude_m_s));
        point.map_or_else(Vector3::zeros, |point| self.velocity_m_s - point.velocity_m_s)
    }

    /// Estimated thrust direction in the body frame, a unit vector.
    pub fn thrust_body(&self, settings: &BurnSettings) -> Vector3<f64> {
        self.thrust_body.unwrap_or(settings.nominal.direction_body)
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.last.as_ref().is_none_or(|last| last.attitude.is_rotation())
            && self.thrust_body.is_none_or(|thrust| (thrust.norm() - 1.0).abs() < 1e-9)
    }

    /// Whether a burn is commanded now; `is_new`: by a command other than the last sample's. What is commanded no longer
    /// ends, what is commanded anew begins anew.
    pub fn command(&mut self, is_commanded: bool, is_new: bool, time_s: f64) {
        let begins = is_commanded && (is_new || !self.is_commanded);
        self.interruption = None;
        self.is_commanded = is_commanded;
        if begins {
            self.end(time_s);
            let phase = BurnPhase::Waiting { since_s: time_s, refused: false };
            let Self { last, interruption, .. } = *self;
            *self = Self { phase, is_commanded, last, interruption, ..Self::default() };
        } else if !is_commanded {
            self.end(time_s);
        }
    }

    /// Ends at `time_s` what is commanded or under way; it does not begin again by itself.
    pub fn end(&mut self, time_s: f64) {
        self.interruption = match self.phase {
            BurnPhase::Waiting { .. } => Some(Interruption::BeforeThrust),
            BurnPhase::Burning { stop_s, .. } if time_s < stop_s => Some(Interruption::CutOff),
            _ => self.interruption,
        };
        if self.is_requested() {
            self.phase = BurnPhase::Ended { timed_out: matches!(self.phase, BurnPhase::Waiting { .. }) };
        }
    }

    /// Begins thrust at `time_s` where a burn waits, its time has come and `is_aimed` says that the commanded attitude has the
    /// thrust on its commanded direction.
    pub fn begin(&mut self, settings: &BurnSettings, time_s: f64, is_aimed: bool) {
        let BurnPhase::Waiting { since_s, .. } = self.phase else { return };
        if time_s < settings.start_s {
            return;
        }
        self.phase = match settings.path.filter(|_| is_aimed) {
            Some(_) if settings.awaits_attitude && !self.is_reached(settings) => {
                BurnPhase::Waiting { since_s, refused: false }
            }
            Some(_) => {
                let stop_s = self.predicted_stop_s(settings, time_s, time_s);
                BurnPhase::Burning { since_s: time_s, stop_s }
            }
            None if time_s >= since_s.max(settings.start_s) + settings.wait_s => {
                BurnPhase::Ended { timed_out: true }
            }
            None => BurnPhase::Waiting { since_s, refused: true },
        };
    }

    /// Whether the last burn was refused or ended before its magnitude was reached: it is due and cannot begin, its time was
    /// up, or something else was commanded before it began.
    pub fn is_missed(&self) -> bool {
        matches!(self.phase, BurnPhase::Waiting { refused: true, .. } | BurnPhase::Ended { timed_out: true })
    }

    /// Integrates the motion measured at a sample; `None` while there is no estimate.
    pub fn measure(&mut self, settings: &BurnSettings, motion: Option<MeasuredMotion>) {
        let last = core::mem::replace(&mut self.last, motion);
        let BurnPhase::Burning { since_s, stop_s } = self.phase else { return };
        let Some(now) = motion.filter(|_| settings.path.is_some()) else { return };
        if let Some(last) = last.filter(|last| last.time_s < now.time_s) {
            self.add(settings, &last, &now);
        }
        let timeout_s = since_s + settings.timeout_s;
        let is_seen = self.accelerations_m_s2.iter().any(|it| settings.is_thrust(*it));
        let predicted_s = self.predicted_stop_s(settings, now.time_s, since_s);
        // The spacecraft stopped by the last prediction, where that is over.
        let is_spent = is_seen && now.time_s >= stop_s.min(predicted_s);
        self.phase = if is_spent || now.time_s >= timeout_s {
            BurnPhase::Ended { timed_out: !is_spent || stop_s >= timeout_s }
        } else {
            BurnPhase::Burning { since_s, stop_s: predicted_s }
        };
    }

    /// Commanded direction of the thrust; `None` without a path.
    pub fn pointing(&self, settings: &BurnSettings) -> Option<BurnPointing> {
        let path = settings.path.as_ref()?;
        let here = path.point(self.magnitude_m_s);
        let measured_m_s2 = self.measured_m_s2(settings);
        let ahead_m_s = measured_m_s2.unwrap_or(0.0) * settings.look_ahead_s;
        let turn = if settings.reactive && ahead_m_s > 0.0 {
            let aim_m_s = path.point(self.magnitude_m_s + ahead_m_s).velocity_m_s;
            rotation(&(aim_m_s - here.velocity_m_s), &(aim_m_s - self.velocity_m_s), 1.0)
        } else {
            Rotation3::identity()
        };
        let is_burning = matches!(self.phase, BurnPhase::Burning { .. });
        let speed_m_s2 = measured_m_s2.filter(|_| is_burning).unwrap_or(0.0);
        Some(BurnPointing {
            boresight_body: self.thrust_body(settings),
            direction: moving(turn * here.tangent, turn * here.curvature_s_m * speed_m_s2),
        })
    }

    /// Whether the attitude estimated at the last sample has the thrust on its commanded direction.
    fn is_reached(&self, settings: &BurnSettings) -> bool {
        self.last.zip(self.pointing(settings)).is_some_and(|(motion, pointing)| {
            let thrust = motion.attitude.to_inertial(&pointing.boresight_body);
            angle_between_rad(&thrust, &value(&pointing.direction)) <= ATTITUDE_REACHED_RAD
        })
    }

    /// Adds the increment between two samples.
    fn add(&mut self, settings: &BurnSettings, last: &MeasuredMotion, now: &MeasuredMotion) {
        let increment_body_m_s = now.delta_v_body_m_s - last.delta_v_body_m_s;
        let half_turn = last.attitude.rotation_vector_to(&now.attitude) * 0.5;
        self.velocity_m_s += last.attitude.turned(half_turn).to_inertial(&increment_body_m_s);
        let size_m_s = increment_body_m_s.norm();
        self.magnitude_m_s += size_m_s;
        let acceleration_m_s2 = size_m_s / (now.time_s - last.time_s);
        self.accelerations_m_s2 = [acceleration_m_s2, self.accelerations_m_s2[0]];
        if settings.predictive && settings.is_thrust(acceleration_m_s2) {
            let thrust_body = self.thrust_body(settings);
            let turned = rotation(&thrust_body, &increment_body_m_s, settings.gain) * thrust_body;
            self.thrust_body = turned.try_normalize(0.0).or(self.thrust_body);
        }
    }

    /// Acceleration by the accelerometers, in m/s2; `None` where they give no thrust.
    fn measured_m_s2(&self, settings: &BurnSettings) -> Option<f64> {
        let [last, before] = self.accelerations_m_s2;
        Some(last.max(before)).filter(|greatest| settings.is_thrust(*greatest))
    }

    /// When the path's length is used up, at the latest when the burn times out, in s.
    fn predicted_stop_s(&self, settings: &BurnSettings, now_s: f64, since_s: f64) -> f64 {
        let length_m_s = settings.path.as_ref().map_or(0.0, VelocityPath::length_m_s);
        let timeout_s = since_s + settings.timeout_s;
        let acceleration_m_s2 = self.measured_m_s2(settings).unwrap_or(settings.nominal.acceleration_m_s2);
        let remaining_m_s = (length_m_s - self.magnitude_m_s).max(0.0);
        let stop_s =
            if acceleration_m_s2 > 0.0 { now_s + remaining_m_s / acceleration_m_s2 } else { timeout_s };
        stop_s.min(timeout_s)
    }
}

/// A `fraction` of the smallest rotation that takes the direction of one vector to that of the other; none where they are
/// opposite or one is zero.
fn rotation(from: &Vector3<f64>, to: &Vector3<f64>, fraction: f64) -> Rotation3<f64> {
    let normal = from.cross(to);
    let angle_rad = angle_between_rad(from, to) * fraction;
    normal.try_normalize(0.0).map_or_else(Rotation3::identity, |axis| Rotation3::new(axis * angle_rad))
}
