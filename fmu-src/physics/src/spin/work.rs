//! Work of a step of the spinner, and the parameter that asks for most of it.

use super::damper::Damper;
use crate::numerics;

/// Kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkKind {
    /// Segments of the motion.
    TaylorSegment,
    /// Segments of the motion with a damper, whose gain takes several rounds.
    DampedCell,
    /// Crossings of Sun and star.
    Crossing,
    /// Samples by the star tracker's clock.
    ClockSample,
    /// Edges of pulses.
    Edge,
    /// Directions on the L1 orbit.
    Direction,
    /// Panels of the impulse of thrusters that turn with the body.
    Impulse,
}

impl WorkKind {
    /// Units of about a microsecond, a little more than each takes.
    fn units(self) -> u32 {
        match self {
            Self::TaylorSegment => 16,
            Self::DampedCell => 64,
            Self::Crossing | Self::Edge | Self::Impulse => 4,
            Self::ClockSample | Self::Direction => 2,
        }
    }
}

/// Cause of each [`WorkKind`], and the parameter that asks for it.
const CAUSES: [&str; 7] = [
    SEGMENTS,
    SEGMENTS,
    "crossings of Sun and star, one of each in a turn: requested by spin.initialRate",
    "samples of the star tracker, every 8 turns of limit.spinRate: starTracker.sampling 2 (clock) asks for them",
    "edges of pulses: requested by burn.count and the thrusters' inputs",
    "directions of Sun and Earth: geometry.source 2 (L1 orbit) looks them up every 600 s",
    "panels of the turning thrust, a few in each turn: requested by thruster[k].fire, long pulses and spin.initialRate",
];

const SEGMENTS: &str = "segments of the motion, a few in each turn: requested by spin.initialRate, by moments of inertia[1] and \
     inertia[2] that differ, by productsOfInertia, by a short damper.timeConstant and by torques";

/// Work of one step of the spinner.
#[derive(Clone, Copy, Debug)]
pub struct Work(numerics::work::Work<{ CAUSES.len() }>);

impl Work {
    /// Returns a count of 0 under this limit.
    pub fn new(limit: u32) -> Self {
        Self(numerics::work::Work::new(limit))
    }

    /// Counts one unit of a kind of work.
    #[inline]
    pub fn spend(&mut self, kind: WorkKind) {
        self.0.spend(kind as usize, kind.units());
    }

    /// Counts a segment of a motion with this damper.
    #[inline]
    pub fn spend_segment(&mut self, damper: &Damper) {
        self.spend(if damper.acts() { WorkKind::DampedCell } else { WorkKind::TaylorSegment });
    }

    /// Tells whether the limit is exceeded.
    #[inline]
    pub fn is_exhausted(&self) -> bool {
        self.0.is_exhausted()
    }

    /// Refuses to continue a flight that has come to `time_s` beyond the limit.
    ///
    /// # Errors
    /// More was spent than may be.
    #[inline]
    pub fn check(&self, time_s: f64) -> Result<(), WorkExceeded> {
        if !self.is_exhausted() {
            return Ok(());
        }
        Err(WorkExceeded {
            limit: self.0.limit(),
            time_s,
            cause: CAUSES.get(self.0.greatest()).copied().unwrap_or_default(),
        })
    }
}

/// A step that costs more than it may.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the step came to {time_s} s and then needed more work than solver.workLimit = {limit} allows; most went into {cause}. \
     Take shorter steps or raise solver.workLimit"
)]
pub struct WorkExceeded {
    /// Limit that was set.
    pub limit: u32,
    /// Time to which the step came, in s.
    pub time_s: f64,
    /// Cause of most of the work.
    pub cause: &'static str,
}
