//! The spinner in flight: body, burn, outside commands and sensors, from edge to edge.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::commands::{Commands, Directions};
use crate::spin::{
    crossing_detector::CrossingDetector,
    geometry::L1Ephemeris,
    motion::{Motion, MotionError},
    nutation::{LinearNutation, Spin},
    sequencer::{Phase, Sequencer},
    spinner::Spinner,
    tracker::NutationEstimator,
    work::{Cost, Work, WorkExceeded},
};

/// A communication point this close to an edge, as a share of the step's later or earlier end, counts as the edge.
const SAME_TIME: f64 = 1e-13;

/// Least work of a step that may be allowed, in units of about a microsecond.
pub const LEAST_WORK: u32 = 1000;
/// Most.
pub const MOST_WORK: u32 = 1_000_000_000;

/// Sun and Earth of the L1 orbit stand still for the sensors over intervals of this length, in s: less than 0.01 deg.
pub(super) const DIRECTION_INTERVAL_S: f64 = 600.0;

/// What the inertia follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum MassSource {
    /// Stays as given.
    Fixed,
    /// Follows the propellant by the setup's table, at the end of each pulse.
    Propellant,
}

/// When the star tracker samples its star.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum Sampling {
    /// On the turns that search the star's picket, when it passes the boresight.
    Spins,
    /// Every 8 nominal turns by the clock, as eqs 16 to 20 assume.
    Clock,
}

/// Why a flight does not come to the end of a step.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SpinPlantError {
    /// The motion.
    #[error(transparent)]
    MotionError(#[from] MotionError),
    /// The effort.
    #[error(transparent)]
    Work(#[from] WorkExceeded),
}

/// A star tracker sample.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct StarSample {
    /// When, in s; -1 before any.
    pub time_s: f64,
    /// Measured declination in the sensor, in rad.
    pub declination_rad: f64,
    /// How many so far.
    pub count: u32,
}

/// A spinner in flight: everything a step needs from the steps before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plant {
    pub(super) motion: Motion,
    pub(super) time_s: f64,
    pub(super) mass_source: MassSource,
    pub(super) initial_propellant_kg: f64,
    pub(super) initial_momentum_inertial: Vector3<f64>,
    pub(super) initial_spin_axis_inertial: Vector3<f64>,
    pub(super) theory: Spin,
    pub(super) sequencer: Option<Sequencer>,
    pub(super) commands: Commands,
    pub(super) directions: Directions,
    /// Thrusters on.
    pub(super) mask: u32,
    /// Since when, in s.
    pub(super) mask_since_s: f64,
    pub(super) used_kg: f64,
    pub(super) delta_v_inertial_m_s: Vector3<f64>,
    /// Up to when delta-v is summed, in s.
    pub(super) delta_v_until_s: f64,
    pub(super) predicted: LinearNutation,
    pub(super) sun: CrossingDetector,
    pub(super) star: CrossingDetector,
    pub(super) sun_sample_rad: f64,
    pub(super) sampling: Sampling,
    pub(super) clock_period_s: f64,
    pub(super) clock_start_s: f64,
    pub(super) clock_count: u64,
    /// One turn in so many sees the star.
    pub(super) every: u32,
    pub(super) sample: StarSample,
    pub(super) estimator: NutationEstimator,
    pub(super) estimator_since_s: f64,
    pub(super) sensor_azimuths: SensorAzimuths,
    pub(super) seed: u64,
    /// Whether commands came since the last step.
    pub(super) commanded: bool,
    pub(super) l1: Option<L1Ephemeris>,
    pub(super) refresh_count: i64,
    pub(super) refresh_s: f64,
    /// What a step may cost.
    pub(super) work_limit: u32,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SensorAzimuths {
    pub(super) sun: Vector3<f64>,
    pub(super) star: Vector3<f64>,
}

impl Plant {
    /// New commands and directions, from the present time on.
    ///
    /// With the L1 orbit in charge, only the star of `directions` counts.
    pub fn command(&mut self, commands: Commands, mut directions: Directions) {
        if self.l1.is_some() {
            directions.sun_inertial = self.directions.sun_inertial;
            directions.earth_inertial = self.directions.earth_inertial;
        }
        if directions.sun_inertial != self.directions.sun_inertial {
            self.sun.forget(self.time_s);
        }
        if directions.star_inertial != self.directions.star_inertial {
            self.star.forget(self.time_s);
        }
        self.directions = directions;
        self.commands = commands;
        self.commanded = true;
    }

    /// Flies to `end_s`. Pulses commanded beyond it are cut there.
    ///
    /// # Errors
    /// A body that cannot be followed to there, or only with more work than a step may cost; the flight is then of no
    /// further use.
    pub fn advance(&mut self, spinner: &Spinner, end_s: f64) -> Result<(), SpinPlantError> {
        let work = &mut Work::new(self.work_limit);
        let from_s = self.time_s;
        let near_s = end_s + SAME_TIME * end_s.abs().max(from_s.abs());
        // The last edge, and the last thing of any kind that happened.
        let (mut now_s, mut reached_s) = (from_s, from_s);
        if self.commanded || self.commands.any_pulse {
            self.switch(spinner, from_s, now_s, f64::INFINITY, work)?;
            self.commanded = false;
        }
        self.motion.check()?;
        loop {
            work.check(reached_s)?;
            let plan_s = self.sequencer.as_ref().map_or(f64::INFINITY, |s| s.next_edge_s().max(now_s));
            let command_s = self.commands.edge_after_s(from_s, now_s);
            let dry_s = self.dry_s(spinner).max(now_s);
            let edge_s = plan_s.min(command_s).min(self.refresh_s).min(dry_s);
            let (until_s, segment_end_s) = (edge_s.min(end_s), self.motion.segment_end_s());
            // What is seen may move the plan's edge.
            if let Some(seen_s) = self.observe(spinner, until_s.min(segment_end_s), work)? {
                reached_s = seen_s;
                continue;
            }
            if segment_end_s < until_s {
                self.next_segment(spinner, work)?;
                reached_s = segment_end_s;
                continue;
            }
            if edge_s > near_s {
                break;
            }
            (now_s, reached_s) = (edge_s, edge_s);
            work.spend(Cost::Edge);
            if self.refresh_s <= edge_s {
                work.spend(Cost::Direction);
                self.refresh_directions();
            }
            let mut hint_s = f64::INFINITY;
            if plan_s <= edge_s
                && let Some(sequencer) = &mut self.sequencer
            {
                sequencer.note_centre();
                // A little longer than the pulse, so that rounding needs no second segment.
                hint_s = sequencer.pass_edge(now_s).map_or(f64::INFINITY, |width_s| 1.001 * width_s);
            }
            if dry_s <= edge_s {
                self.run_dry(spinner, now_s, work)?;
            }
            self.switch(spinner, from_s, now_s, hint_s, work)?;
            if self.sequencer.as_ref().is_some_and(|s| s.phase() == Phase::Idle) {
                self.schedule(now_s, work);
            }
        }
        self.reach(spinner, end_s, work)?;
        self.motion.check_at(end_s)?;
        self.time_s = end_s;
        Ok(())
    }

    /// Where communication stands, in s.
    pub fn time_s(&self) -> f64 {
        self.time_s
    }

    /// Puts the thrusters and outside torque in force that hold just after `now_s`.
    pub(super) fn switch(
        &mut self,
        spinner: &Spinner,
        from_s: f64,
        now_s: f64,
        hint_s: f64,
        work: &mut Work,
    ) -> Result<(), SpinPlantError> {
        let plan = self.sequencer.as_ref().map_or(0, Sequencer::mask);
        let asked = plan | self.commands.mask_after(from_s, now_s);
        let mask = if self.is_dry() { 0 } else { asked };
        let mut torque = self.commands.torque;
        if mask != 0 {
            torque = torque.plus(&spinner.thrust(mask).torque_body_n_m);
        }
        if mask != self.mask || torque != *self.motion.torque() {
            self.reach(spinner, now_s, work)?;
            self.settle_pulse(spinner, now_s);
            let inertia = self.inertia_now(spinner);
            work.spend_segment(self.motion.damper());
            self.motion = self.motion.followed_by(now_s, inertia, torque, hint_s);
            self.motion.check()?;
            self.mask = mask;
            self.mask_since_s = now_s;
            self.sun.forget(now_s);
            self.star.forget(now_s);
            if self.sequencer.as_ref().is_some_and(Sequencer::follows_motion) {
                self.schedule(now_s, work);
            }
        }
        Ok(())
    }

    pub(super) fn schedule(&mut self, now_s: f64, work: &mut Work) {
        if self.is_dry() {
            return;
        }
        if let Some(sequencer) = &mut self.sequencer {
            sequencer.schedule(&self.motion, now_s, &self.directions.sun_inertial, work);
        }
    }
}
