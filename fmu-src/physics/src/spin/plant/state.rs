//! The spinner in flight: body, burn, outside commands and sensors, from edge to edge.

use serde::{Deserialize, Serialize};

use super::commands::Commands;
use super::directions::{DirectionSource, Directions};
use super::propulsion::Propulsion;
use super::sensors::{Sensor, SensorView, Sensors};
use super::start::{InitialConditions, LEAST_WORK, MOST_WORK, Start, StartError};
use crate::attitude::RigidBodyState;
use crate::propulsion::due_s;
use crate::spin::{
    burn::{Burn, BurnInitialConditions},
    damper::Damper,
    motion::{Motion, MotionError},
    nutation::Spin,
    sequencer::{Phase, Sequencer},
    series::{Anchor, BodyTorque},
    spinner::Spinner,
    work::{Work, WorkExceeded, WorkKind},
};

/// A communication point this close to an edge, as a fraction of the step's later or earlier end, counts as the edge.
const SAME_TIME: f64 = 1e-13;

/// A motion is followed at least this far through a ramp of thrust at once, in s.
const SHORTEST_RAMP_HINT_S: f64 = 2e-5;

/// Fraction of a turn by which times of one flight may be out of order.
const OUT_OF_ORDER: f64 = 1e-3;

/// Reason why a flight does not come to the end of a step.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SpinPlantError {
    /// Body that cannot be followed.
    #[error(transparent)]
    MotionError(#[from] MotionError),
    /// More work than a step may cost.
    #[error(transparent)]
    Work(#[from] WorkExceeded),
}

/// A spinner in flight: everything a step needs from the steps before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plant {
    /// The motion in force.
    pub motion: Motion,
    /// Present time of communication, in s.
    pub time_s: f64,
    /// The motion's state there, once it is computed.
    #[serde(skip)]
    present: Option<RigidBodyState>,
    /// Conditions at the start.
    pub initial: InitialConditions,
    /// The burn in flight.
    pub sequencer: Option<Sequencer>,
    commands: Commands,
    /// Whether commands came since the last step.
    commanded: bool,
    pub(super) directions: DirectionSource,
    /// Thrusters and tank.
    pub propulsion: Propulsion,
    /// Sun sensor and star tracker.
    pub sensors: Sensors,
    /// Greatest work of a step.
    work_limit: u32,
}

impl Plant {
    /// Starts a flight at `start_s`.
    pub fn start(
        spinner: &Spinner,
        start: &Start,
        directions: Directions,
        commands: Commands,
        start_s: f64,
    ) -> Result<Self, StartError> {
        let inertia = start.inertia(spinner)?;
        let attitude = start.check(spinner)?;
        let momentum = start.momentum_spin_frame_n_m_s(&inertia);
        let momentum_inertial = attitude.inertial_from_body(&inertia.body_from_spin_frame(&momentum));
        let theory = Spin {
            rate_rad_s: start.spin_rate_rad_s,
            ratio: inertia.inertial_nutation_ratio().unwrap_or(inertia.ratio()),
            inertia_kg_m2: inertia.spin_kg_m2(),
        };
        let initial = BurnInitialConditions {
            spin: theory,
            inertia,
            momentum_inertial,
            propellant_kg: start.propellant_kg,
            execution: &start.execution,
        };
        let burn = start.burn.as_ref().map(|request| Burn::new(spinner, request, &initial)).transpose()?;
        let slit_rad = spinner.sun_sensor.azimuth_deg.to_radians();
        let sequencer = burn.map(|burn| Sequencer::new(burn, slit_rad));
        let damper = Damper::new(start.damper_time_constant_s, &inertia);
        let anchor = Anchor { time_s: start_s, attitude, momentum_inertial };
        let motion = Motion::new(inertia, damper, BodyTorque::default(), anchor, f64::INFINITY);
        let mut plant = Self {
            present: Some(motion.at(start_s)),
            motion,
            time_s: start_s,
            initial: InitialConditions {
                momentum_inertial,
                spin_axis_inertial: attitude.spin_axis_inertial(),
                theory,
            },
            sequencer,
            commands: Commands::default(),
            commanded: true,
            directions: DirectionSource::new(directions, start.l1, start_s),
            propulsion: Propulsion::new(start, start_s),
            sensors: Sensors::new(spinner, start, start_s),
            work_limit: start.work_limit,
        };
        start
            .refuse_blind_timing(&plant.state().momentum_inertial, &plant.directions.present.sun_inertial)?;
        let mut work = Work::new(start.work_limit);
        plant.schedule(spinner, start_s, &mut work);
        work.check(start_s)?;
        plant.command(commands, directions);
        Ok(plant)
    }

    /// Attitude and momentum there.
    pub fn state(&self) -> RigidBodyState {
        self.present.unwrap_or_else(|| self.motion.at(self.time_s))
    }

    /// Directions at a time: on the L1 orbit they move.
    pub fn directions_at(&self, time_s: f64) -> Directions {
        self.directions.at(time_s)
    }

    /// New commands and directions, from the present time on.
    ///
    /// With the L1 orbit in charge, only the star of `directions` counts.
    pub fn command(&mut self, commands: Commands, directions: Directions) {
        let before = self.directions.present;
        self.directions.give(directions);
        let now = self.directions.present;
        if now.sun_inertial != before.sun_inertial {
            self.sensors.sun.forget(self.time_s);
        }
        if now.star_inertial != before.star_inertial {
            self.sensors.star.forget(self.time_s);
        }
        self.commands = commands;
        self.commanded = true;
    }

    /// Advances to `end_s`. Pulses commanded beyond it are cut there, or where their valves may close.
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
        let waiting_s = self.propulsion.valves.edge_before_s(spinner, f64::INFINITY);
        if self.commanded || self.commands.fires() || waiting_s <= due_s(from_s) {
            self.propulsion.valves.command(&self.commands, from_s, end_s);
            // An edge where the last step ended waited for this command.
            let edge_s = self.propulsion.valves.edge_before_s(spinner, end_s);
            if edge_s <= due_s(from_s) {
                now_s = edge_s;
            }
            self.switch(spinner, now_s, f64::INFINITY, work)?;
            self.commanded = false;
        }
        self.motion.check()?;
        loop {
            work.check(reached_s)?;
            let plan_s = self.sequencer.as_ref().map_or(f64::INFINITY, |s| s.next_edge_s().max(now_s));
            let command_s = self.propulsion.valves.edge_before_s(spinner, end_s);
            let depletion_time_s = self.propulsion.depletion_time_s().max(now_s);
            let ramp_s = self.propulsion.valves.ramp_end_s(spinner).max(now_s);
            let edge_s =
                plan_s.min(command_s).min(self.directions.refresh_s).min(depletion_time_s).min(ramp_s);
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
            work.spend(WorkKind::Edge);
            if self.directions.refresh_s <= edge_s {
                work.spend(WorkKind::Direction);
                if let Some(from_s) = self.directions.refresh() {
                    self.sensors.sun.forget(from_s);
                }
            }
            let mut hint_s = f64::INFINITY;
            if plan_s <= edge_s
                && let Some(sequencer) = &mut self.sequencer
            {
                sequencer.record_centre();
                // A little longer than the pulse, so that rounding needs no second segment.
                hint_s = sequencer.pass_edge(now_s).map_or(f64::INFINITY, |width_s| 1.001 * width_s);
            }
            if depletion_time_s <= edge_s {
                self.run_dry(spinner, now_s, work)?;
            }
            self.switch(spinner, now_s, hint_s, work)?;
            if self.sequencer.as_ref().is_some_and(|s| s.phase == Phase::Idle) {
                self.schedule(spinner, now_s, work);
            }
        }
        self.reach(spinner, end_s, work)?;
        self.present = Some(self.motion.check_at(end_s)?);
        self.time_s = end_s;
        Ok(())
    }

    /// Puts the thrusters and outside torque in force that hold just after `now_s`.
    fn switch(
        &mut self,
        spinner: &Spinner,
        now_s: f64,
        hint_s: f64,
        work: &mut Work,
    ) -> Result<(), SpinPlantError> {
        let plan = self.sequencer.as_ref().map_or(0, Sequencer::mask);
        let requested = plan | self.propulsion.valves.pulsing_mask(now_s);
        let mask = if self.propulsion.is_dry() { 0 } else { requested };
        let turns_valves =
            mask != self.propulsion.valves.open_mask() || self.propulsion.valves.ramp_end_s(spinner) <= now_s;
        let applied = self.commands.torque;
        if turns_valves || self.propulsion.with_thrusters(spinner, &applied) != self.motion.torque {
            self.reach(spinner, now_s, work)?;
            self.accumulate_pulse(spinner, now_s);
            let inertia = self.propulsion.inertia(spinner, &self.motion);
            work.spend_segment(&self.motion.damper);
            self.propulsion.valves.open(spinner, mask, now_s);
            let torque = self.propulsion.with_thrusters(spinner, &applied);
            let ramp_s = (self.propulsion.valves.ramp_end_s(spinner) - now_s).max(SHORTEST_RAMP_HINT_S);
            self.motion = self.motion.followed_by(now_s, inertia, torque, hint_s.min(1.001 * ramp_s));
            self.motion.check()?;
            self.sensors.forget_motion(now_s);
            if self.sequencer.as_ref().is_some_and(Sequencer::follows_motion) {
                self.schedule(spinner, now_s, work);
            }
        }
        Ok(())
    }

    /// Accumulates what the thrusters that were on used and did.
    fn accumulate_pulse(&mut self, spinner: &Spinner, now_s: f64) {
        if self.propulsion.accumulate(spinner, &self.motion, &self.initial.theory, now_s) {
            self.sensors.restart_estimate(now_s);
        }
    }

    /// Empties the tank at `now_s`; the burn ends with the pulse it cut.
    fn run_dry(&mut self, spinner: &Spinner, now_s: f64, work: &mut Work) -> Result<(), SpinPlantError> {
        self.reach(spinner, now_s, work)?;
        self.accumulate_pulse(spinner, now_s);
        self.propulsion.empty(now_s);
        if let Some(sequencer) = &mut self.sequencer {
            sequencer.stop();
        }
        Ok(())
    }

    /// Lets the sensors see the first thing there is to see up to `until_s`; when it was, if there was one.
    fn observe(
        &mut self,
        spinner: &Spinner,
        until_s: f64,
        work: &mut Work,
    ) -> Result<Option<f64>, SpinPlantError> {
        let directions = &self.directions.present;
        let view = SensorView { motion: &self.motion, directions, theory: &self.initial.theory };
        let Some((sensor, time_s)) = self.sensors.next_reading(&view, until_s, work) else { return Ok(None) };
        self.reach(spinner, time_s, work)?;
        let directions = &self.directions.present;
        let view = SensorView { motion: &self.motion, directions, theory: &self.initial.theory };
        match sensor {
            Sensor::Sun => {
                self.sensors.read_sun(spinner, &view, time_s);
                if let Some(sequencer) = self.sequencer.as_mut().filter(|_| !self.propulsion.is_dry()) {
                    sequencer.sun_pulse(&self.motion, time_s, &directions.sun_inertial, work);
                }
            }
            Sensor::StarTracker => self.sensors.read_star(spinner, &view, time_s),
        }
        Ok(Some(time_s))
    }

    /// Continues to the next segment, summing delta-v as the present one ends.
    fn next_segment(&mut self, spinner: &Spinner, work: &mut Work) -> Result<(), SpinPlantError> {
        self.motion.check()?;
        let end_s = self.motion.segment_end_s();
        work.spend_segment(&self.motion.damper);
        self.propulsion.close_segment(spinner, &self.motion, work);
        self.motion.next_segment();
        self.sensors.forget_motion(end_s);
        Ok(())
    }

    /// Continues through segments until the present one holds `time_s`.
    fn reach(&mut self, spinner: &Spinner, time_s: f64, work: &mut Work) -> Result<(), SpinPlantError> {
        while self.motion.segment_end_s() < time_s {
            work.check(self.motion.anchor_s())?;
            self.next_segment(spinner, work)?;
        }
        Ok(self.propulsion.sum_panels(spinner, &self.motion, time_s, work)?)
    }

    fn schedule(&mut self, spinner: &Spinner, now_s: f64, work: &mut Work) {
        if self.propulsion.is_dry() {
            return;
        }
        // What a rising or falling thrust does to the motion is known where it ends.
        let is_ramping = self.propulsion.valves.ramp_end_s(spinner).is_finite();
        if let Some(sequencer) = self.sequencer.as_mut().filter(|it| !(is_ramping && it.follows_motion())) {
            sequencer.schedule(&self.motion, now_s, &self.directions.present.sun_inertial, work);
        }
    }

    /// Whether a decoded state can be advanced: its thrusters exist, its numbers belong together.
    pub fn fits(&self, spinner: &Spinner) -> bool {
        let burn = self.sequencer.as_ref().map(|it| &it.burn);
        let known = (1_u64 << spinner.thrusters.len()) - 1;
        let planned = burn.map_or(0, |burn| burn.masks[0] | burn.masks[1]);
        let used = self.propulsion.valves.open_mask() | self.commands.fire | planned;
        let slack_s = OUT_OF_ORDER * self.initial.theory.period_s();
        u64::from(used) & !known == 0
            && (LEAST_WORK..=MOST_WORK).contains(&self.work_limit)
            && self.initial.is_valid()
            && self.motion_is_valid(slack_s)
            && self.propulsion.is_valid(spinner, self.time_s + slack_s)
            && self.commands.is_valid()
            && self.sensors.is_valid(self.time_s)
            && self.directions.is_valid(self.time_s)
            && self.sequencer.as_ref().is_none_or(Sequencer::is_valid)
    }

    fn motion_is_valid(&self, slack_s: f64) -> bool {
        let (now_s, anchor_s, end_s) = (self.time_s, self.motion.anchor_s(), self.motion.segment_end_s());
        self.motion.is_valid()
            && anchor_s <= now_s + slack_s
            && now_s <= end_s + slack_s
            && self.motion.check_at(now_s).is_ok()
    }
}
