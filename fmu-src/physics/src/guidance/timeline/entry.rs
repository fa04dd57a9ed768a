//! A command of a timeline: when, where to point, what else it changes.

use crate::guidance::burn::delta_v::BurnSettings;
use crate::guidance::burn::nominal_thrust::NominalThrust;
use crate::guidance::burn::velocity_path::VelocityPath;
use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::modes::mode::Mode;
use crate::guidance::pointing::command::PointingCommand;
use crate::numerics::spacing::spacing;
use crate::spacecraft::ThrusterSet;

/// By which clock a timeline counts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TimelineClock {
    /// Seconds past J2000 TDB.
    Epoch,
    /// FMI time in s.
    FmiTime,
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
    /// Where to point; without a scenario nothing is commanded.
    pub command: PointingCommand,
    /// Changes of the Sun keep-in zone while it lasts.
    pub keep_in: KeepInOverride,
    /// A mode requested when it begins.
    pub mode: Option<Mode>,
    /// The burn of its scenario; `None`: that of the parameters.
    pub burn: Option<TimelineBurn>,
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
        // Rounding of the epoch takes no second away.
        let start_s = self.start_s.map(|it| it - clock_minus_time_s - 4.0 * spacing(it));
        BurnSettings {
            path: self.path,
            thrusters: self.thrusters,
            start_s: start_s.unwrap_or(f64::NEG_INFINITY),
            awaits_attitude: start_s.is_none(),
            thrust_body: self.nominal.direction_body,
            acceleration_m_s2: self.nominal.acceleration_m_s2,
            timeout_s: self.duration_s.unwrap_or(parameters.timeout_s),
            // It waits until its command ends.
            wait_s: f64::INFINITY,
            ..*parameters
        }
    }
}

/// What takes the place of the Sun keep-in zone's parameters; `None` leaves them.
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
