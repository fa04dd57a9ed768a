//! Downlink windows of a spacecraft's file, counted from periapsis.

use serde::Serialize;

/// A time after periapsis.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum TimeAfterPeriapsis {
    /// In s.
    Seconds(f64),
    /// As a share of the orbital period.
    PeriodShare(f64),
}

/// When an antenna looks at the Earth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct DownlinkWindows {
    /// Begin.
    pub start: TimeAfterPeriapsis,
    /// End.
    pub stop: TimeAfterPeriapsis,
    /// A downlink after every how many periapses; 0 is none.
    pub every: u32,
}

impl TimeAfterPeriapsis {
    /// In an orbit of this period, in s.
    pub fn in_orbit_s(self, period_s: f64) -> f64 {
        match self {
            Self::Seconds(time_s) => time_s,
            Self::PeriodShare(share) => share * period_s,
        }
    }

    /// The share; `None` where it is no share.
    pub fn period_share(self) -> Option<f64> {
        match self {
            Self::Seconds(_) => None,
            Self::PeriodShare(share) => Some(share),
        }
    }
}
