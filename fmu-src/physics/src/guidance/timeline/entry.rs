//! A command of a timeline: when, where to point, what else it changes.

use crate::guidance::constraints::keep_in::KeepIn;
use crate::guidance::modes::mode::Mode;
use crate::guidance::pointing::command::PointingCommand;

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
