//! Contents of a timeline: commands (when, where to point, what else it changes), panels, events.

use nalgebra::Vector3;
use serde::Deserialize;

use crate::attitude::SunAngles;
use crate::environment::dates;
use crate::guidance::burn::delta_v::BurnSettings;
use crate::guidance::burn::nominal_thrust::NominalThrust;
use crate::guidance::burn::velocity_path::VelocityPath;
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::downlink::sun_direction::SunRequest;
use crate::guidance::modes::mode::Mode;
use crate::guidance::pointing::command::{PointingCommand, Scenario};
use crate::spacecraft::ThrusterSet;

/// By which clock a timeline counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimelineClock {
    /// Seconds past J2000 TDB.
    Epoch,
    /// FMI time in s.
    FmiTime,
}

/// The time of the simulation, in s, at `at_s` of a timeline's clock. Epochs are known to 6e-8 s: what counts in them is rounded to
/// whole microseconds, and whole seconds of UTC are whole seconds ([`dates::span_s`]), at which masters communicate.
pub fn simulation_time_s(at_s: f64, clock_minus_time_s: f64) -> f64 {
    const PER_S: f64 = 1e6;
    if clock_minus_time_s == 0.0 {
        return at_s;
    }
    (dates::span_s(clock_minus_time_s, at_s) * PER_S).round() / PER_S
}

/// How many of these items have begun at a time of the simulation, in s; `at_s` is each one's, by the timeline's clock, and grows.
pub fn begun<T>(items: &[T], clock_minus_time_s: f64, time_s: f64, at_s: impl Fn(&T) -> f64) -> usize {
    /// Rounding moves none farther, in s.
    const MOST_S: f64 = 0.01;
    let near = items.partition_point(|item| at_s(item) - clock_minus_time_s <= time_s + MOST_S);
    let is_begun = |item: &T| simulation_time_s(at_s(item), clock_minus_time_s) <= time_s;
    items.get(..near).and_then(|near| near.iter().rposition(is_begun)).map_or(0, |last| last + 1)
}

/// Whether a plan may change a command.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase")]
pub enum PlanStatus {
    /// Command that a plan leaves as it is.
    #[default]
    Fixed,
    /// Command that a plan leaves, reporting its cost.
    Planned,
    /// Command that a plan may change.
    Free,
}

/// A command of a timeline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimelineEntry {
    /// Line in the file, from 1.
    pub line: usize,
    /// When it begins, in s of the timeline's clock.
    pub at_s: f64,
    /// When it ends, if that is before the next one begins; at this instant it no longer counts.
    pub until_s: Option<f64>,
    /// Pointing command; without a scenario nothing is commanded.
    pub command: PointingCommand,
    /// Direction of the Sun in its downlink, if it gives one, and whether the attitude is turned about the Sun line.
    pub downlink: DownlinkOverride,
    /// Changes of the Sun keep-in zone while it lasts.
    pub keep_in: KeepInOverride,
    /// A mode requested when it begins.
    pub mode: Option<Mode>,
    /// The burn of its scenario; `None`: that of the parameters.
    pub burn: Option<TimelineBurn>,
    /// Whether a plan may change it.
    pub status: PlanStatus,
}

/// Entry in force over a span of the simulation's time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Slot<'a> {
    /// The command; `None`: nothing is commanded.
    pub entry: Option<&'a TimelineEntry>,
    /// Its row, from 1; 0 where nothing is commanded.
    pub row: usize,
    /// Since when, in s; minus infinity before the first command.
    pub since_s: f64,
    /// Until when, in s; infinite after the last one.
    pub until_s: f64,
}

impl Slot<'_> {
    /// The scenario that it commands itself, the orbit phase's aside.
    pub fn scenario(&self) -> Option<Scenario> {
        self.entry.and_then(|entry| entry.command.scenario).filter(|it| *it != Scenario::OrbitPhase)
    }

    /// Returns the requested direction of the Sun in its downlink; `requested` by an input goes first.
    pub fn sun_request(&self, requested: SunRequest) -> SunRequest {
        self.entry.map_or(requested, |entry| entry.downlink.under(requested))
    }
}

/// How the panels stand from a time on.
#[derive(Clone, Debug, PartialEq)]
pub struct TimelinePanels {
    /// Line in the file, from 1.
    pub line: usize,
    /// When it begins, in s of the timeline's clock.
    pub at_s: f64,
    /// Offset of each panel's cells from the Sun, its sign the sense of the tilt, in rad.
    pub sun_offsets_rad: Vec<f64>,
    /// Added to the offsets of panels on one side, and taken from those on the other, in rad.
    pub windmill_rad: f64,
}

/// Events at one time: the centre of mass is placed, then the maneuver, then the dump.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TimelineEvent {
    /// Line in the file, from 1.
    pub line: usize,
    /// When, in s of the timeline's clock.
    pub at_s: f64,
    /// A dump; it is the maneuver's where there is one.
    pub dump: Option<TimelineDump>,
    /// A maneuver.
    pub maneuver: Option<TimelineManeuver>,
    /// Nominal centre of mass from then on, body frame, in m, with every panel at angle 0 and full tanks.
    pub center_of_mass_body_m: Option<Vector3<f64>>,
}

/// Target of a dump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TimelineDump {
    /// Target of dumps on request.
    Requested,
    /// To this momentum, body frame, by the flight's convention, in N m s.
    To {
        /// The momentum after it.
        momentum_body_n_m_s: Vector3<f64>,
    },
}

/// A delta-v as an impulse through the centre of mass.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimelineManeuver {
    /// Velocity to add, EME2000, in m/s.
    pub delta_v_inertial_m_s: Vector3<f64>,
    /// The thrusters; `None`: those of the parameters.
    pub thrusters: Option<ThrusterSet>,
    /// Whether a dump goes with it; `None`: as by the parameters.
    pub dumps: Option<bool>,
}

/// Direction of the Sun in a downlink, as a command gives it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DownlinkOverride {
    /// In the body frame.
    pub sun: Option<SunAngles>,
    /// Whether the attitude is turned by 180 deg about the Sun line.
    pub alternate: bool,
}

/// A burn of a timeline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimelineBurn {
    /// The velocity to add; of a timeline that was read, some.
    pub path: Option<VelocityPath>,
    /// The thrusters that are requested.
    pub thrusters: Option<ThrusterSet>,
    /// Their thrust by the spacecraft file.
    pub nominal: NominalThrust,
    /// When it begins, in s of the timeline's clock; `None` when the attitude is reached.
    pub start_s: Option<f64>,
    /// Longest time that thrust may last, in s; `None` as by the parameters.
    pub duration_s: Option<f64>,
}

impl TimelineBurn {
    /// As it acts where `parameters` say how to steer, its clock being `clock_minus_time_s` ahead of FMI time.
    pub fn settings(&self, parameters: &BurnSettings, clock_minus_time_s: f64) -> BurnSettings {
        let start_s = self.start_s.map(|it| simulation_time_s(it, clock_minus_time_s));
        BurnSettings {
            path: self.path,
            thrusters: self.thrusters,
            start_s: start_s.unwrap_or(f64::NEG_INFINITY),
            awaits_attitude: start_s.is_none(),
            nominal: self.nominal,
            timeout_s: self.duration_s.unwrap_or(parameters.timeout_s),
            // It waits until its command ends.
            wait_s: f64::INFINITY,
            ..*parameters
        }
    }
}

impl DownlinkOverride {
    /// Returns the requested direction of the Sun; `requested` by an input goes first.
    pub fn under(&self, requested: SunRequest) -> SunRequest {
        let is_set = requested.sun != SunAngles::default();
        SunRequest {
            sun: self.sun.filter(|_| !is_set).unwrap_or(requested.sun),
            alternate: requested.alternate || self.alternate,
            ..requested
        }
    }
}

/// Replacement of the Sun keep-in zone's parameters; `None` leaves them.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct KeepInOverride {
    /// Whether the zone is in force.
    pub enabled: Option<bool>,
    /// Greatest magnitude of the Sun's azimuth, in rad.
    pub azimuth_rad: Option<f64>,
    /// Greatest magnitude of its elevation, in rad.
    pub elevation_rad: Option<f64>,
}

impl KeepInOverride {
    /// The zone in force where `zone` is set, which without this is in force if `is_enabled`.
    pub fn applied(&self, zone: &KeepIn, is_enabled: bool) -> Option<KeepIn> {
        self.enabled.unwrap_or(is_enabled).then(|| KeepIn {
            azimuth_rad: self.azimuth_rad.unwrap_or(zone.azimuth_rad),
            elevation_rad: self.elevation_rad.unwrap_or(zone.elevation_rad),
            ..*zone
        })
    }
}
