//! Guidance as a sampled system (paper 001, "Guidance system architecture"): a command a second, propagated by its rate.
//!
//! A sample decides the mode, admits the command that the mode allows, aims, applies the constraints and judges the result.
//! Samples lie at whole seconds of time, and at the start. Without a scenario, or a direction of boresight or aimpoint, the last
//! law stays that gave an attitude, within its constraints; without spacecraft, Sun or Earth the last command, not judged.

use serde::{Deserialize, Serialize};

use super::body_positions::BodyPositions;
use super::command_status::CommandStatus;
use super::command_timers::CommandTimers;
use super::guidance_command::{CommandKind, GuidanceCommand};
use super::mode::Mode;
use super::sample_inputs::{GuidanceSettings, SampleContext, SampleInputs, TimedEntries};
use super::sun_line::SunLine;
use super::transitions::{ModeState, Sensed, Steering};
use crate::attitude::Attitude;
use crate::guidance::burn::delta_v::{BurnState, MeasuredMotion};
use crate::guidance::constraints::command_slew::CommandSlew;
use crate::guidance::constraints::constrained::{ConstrainedPointing, Constraints};
use crate::guidance::constraints::hot_pole::TurnSide;
use crate::guidance::downlink::sun_direction::{SelectedSunDirection, SelectedSunDirections, SunRequest};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::geometry::moving::value;
use crate::guidance::orbit_phase::attitudes::Sight;
use crate::guidance::orbit_phase::downlink_sun::{DownlinkSun, WindowStart, present_window};
use crate::guidance::orbit_phase::guided::{DownlinkStatus, Guided, OrbitPhaseLaw};
use crate::guidance::orbit_phase::periapsis_count::PeriapsisCount;
use crate::guidance::orbit_phase::schedule::Schedule;
use crate::guidance::pointing::command::{PointingCommand, Scenario};
use crate::guidance::pointing::law::Pointing;
use crate::guidance::scenario::{
    PointingProgress, PointingSolution, orbit_phase_solution, pointing_solution,
};
use crate::numerics::spacing::spacing;

/// Time between two samples, in s.
pub const SAMPLE_INTERVAL_S: f64 = 1.0;

/// Units of about a microsecond that a sample takes at most, a selection of the Sun's direction aside.
pub const SAMPLE_WORK: u32 = 4;

/// State of the sampled system.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GuidanceState {
    /// The command in force.
    pub command: GuidanceCommand,
    /// Status of the command.
    pub status: CommandStatus,
    /// The line to the Sun at the last sample where it was known.
    pub sun_line: SunLine,
    /// The mode in force, its reason and its monitors.
    pub modes: ModeState,
    periapses: PeriapsisCount,
    /// Side on which the turn away from the hot pole ends, while it lasts.
    hot_pole_turn: Option<TurnSide>,
    timers: CommandTimers,
    /// The last command that gave an attitude; it stays where none is given, and where a new one has no direction.
    law: Option<PointingCommand>,
    /// Progress of a burn.
    pub burn: BurnState,
    /// Direction of the Sun in downlink.
    pub downlink_sun: DownlinkSun,
    /// The slew into the timeline's command.
    slew: Option<CommandSlew>,
    /// Time of the next sample, in s.
    pub next_sample_s: f64,
}

impl GuidanceState {
    /// Before the first sample, which is due at `start_s`.
    pub fn new(attitude: Attitude, start_s: f64) -> Self {
        Self {
            command: GuidanceCommand::held(attitude, start_s),
            status: CommandStatus::NOTHING,
            sun_line: SunLine::default(),
            modes: ModeState::default(),
            periapses: PeriapsisCount::default(),
            hot_pole_turn: None,
            timers: CommandTimers::default(),
            law: None,
            burn: BurnState::default(),
            downlink_sun: DownlinkSun::default(),
            slew: None,
            next_sample_s: start_s,
        }
    }
    /// The windows of the orbit phase where the spacecraft is; `None` where that is not known.
    pub fn windows(&self, law: &Guided, positions: &BodyPositions) -> Option<Schedule> {
        let mut periapses = self.periapses;
        self.modes.ephemeris_in_mode(positions).map(|ephemeris| periapses.windows(&law.schedule, ephemeris))
    }

    /// The next sample that belongs to a step to `end_s`; one at its end belongs to the step after it.
    pub fn due_before(&self, end_s: f64) -> Option<f64> {
        let tolerance_s = 4.0 * spacing(end_s);
        (self.next_sample_s < end_s - tolerance_s).then_some(self.next_sample_s)
    }

    /// Takes the sample that is due; `choose` puts the Sun where a downlink begins, or science that unloads. Whether it was requested.
    pub fn sample(
        &mut self,
        settings: &GuidanceSettings<'_>,
        inputs: &SampleInputs,
        choose: impl Fn(&WindowStart<'_>) -> Option<SelectedSunDirection>,
    ) -> bool {
        let mut is_chosen = false;
        let time_s = self.next_sample_s;
        // A time within rounding of a whole second counts as it.
        self.next_sample_s = (time_s + 4.0 * spacing(time_s)).floor() + SAMPLE_INTERVAL_S;
        let sensed = Sensed { time_s, ..inputs.sensed };
        let mut modes = settings.modes;
        let before = self.modes.ephemeris_in_mode(&inputs.positions).map(EphemerisAtTime::to_sun);
        if before.is_some_and(|to_sun| value(&to_sun).norm() > settings.keep_in.distance_m) {
            modes.operational.keep_in = None;
        }
        modes.watches_hot_pole &= self.status.hot_pole_reached;
        self.begin_slew(settings, inputs, time_s);
        self.update_timers(&inputs.command, inputs.entries, time_s);
        self.burn.measure(
            &settings.burn,
            sensed.estimate.map(|attitude| MeasuredMotion {
                time_s,
                attitude,
                delta_v_body_m_s: inputs.delta_v_body_m_s,
            }),
        );
        let steering = self.modes.sample(&modes, &sensed, &inputs.positions);
        let ephemeris = self.modes.ephemeris_in_mode(&inputs.positions);
        if let Some(to_sun) = ephemeris.map(EphemerisAtTime::to_sun) {
            self.sun_line = SunLine::new(&to_sun, time_s);
        }
        match steering {
            Some(Steering::Pointing(constraints)) => {
                is_chosen = self.point(settings, inputs, &constraints, &sensed, choose);
            }
            Some(rate) => {
                self.command = self.command.followed_by_rate(&rate, time_s);
                self.status = CommandStatus::NOTHING;
            }
            None => self.status = CommandStatus { degenerate: true, ..CommandStatus::NOTHING },
        }
        if !self.status.hot_pole {
            self.hot_pole_turn = None;
        }
        if self.modes.mode != Mode::Operational {
            self.burn.end(time_s);
            self.downlink_sun.end();
            self.slew = None;
        }
        is_chosen
    }

    /// Points as the command of a sample says, within the constraints of its mode. Returns whether a direction of the Sun was requested.
    fn point(
        &mut self,
        settings: &GuidanceSettings<'_>,
        inputs: &SampleInputs,
        constraints: &Constraints,
        sensed: &Sensed,
        choose: impl Fn(&WindowStart<'_>) -> Option<SelectedSunDirection>,
    ) -> bool {
        let command = self.modes.mode.allowed(&inputs.command);
        let ephemeris = self.modes.ephemeris_in_mode(&inputs.positions);
        let Some(ephemeris) = ephemeris.filter(|_| command.scenario.is_some()) else { return false };
        let keep_in = constraints.keep_in;
        let science = settings.orbit_phase.science.within(keep_in);
        let orbit_phase = Guided { keep_in, science, ..settings.orbit_phase };
        let settings = &GuidanceSettings { orbit_phase, ..*settings };
        let time_s = sensed.time_s;
        let attitude = sensed.estimate.unwrap_or_else(|| self.command.attitude_at(time_s));
        let is_operational = self.modes.mode == Mode::Operational;
        let (law, periapses) = (&settings.orbit_phase, &mut self.periapses);
        let window = || present_window(law, &command, ephemeris, attitude, periapses);
        let window = is_operational.then(window).flatten();
        let is_chosen = self.downlink_sun.update(window.as_ref(), self.timers.entries.scenario, choose);
        let requested_sun = if is_operational {
            inputs.requested_sun.within(keep_in.as_ref())
        } else {
            SunRequest::default()
        };
        let (constraints, sun_is_placed) = (*constraints, inputs.sun_is_placed);
        let now = SampleContext { settings, constraints, ephemeris, requested_sun, sun_is_placed, time_s };
        self.compute_attitude(&now, &command);
        if is_operational {
            let is_law = self.law.is_some_and(|law| law.scenario == Some(Scenario::Burn));
            self.burn.begin(&settings.burn, time_s, is_law && self.status.reachable);
        }
        is_chosen
    }

    /// Begins the slew into a command of the timeline, from what was commanded so far; an input's command is taken at once.
    fn begin_slew(&mut self, settings: &GuidanceSettings<'_>, inputs: &SampleInputs, time_s: f64) {
        if inputs.is_commanded {
            self.slew = None;
        }
        let is_new = self.timers.is_new_scenario(&inputs.entries);
        if is_new && self.command.kind == CommandKind::Attitude && settings.orbit_phase.slew_rate_rad_s > 0.0
        {
            self.slew = Some(CommandSlew::new(time_s, &self.command.frame_at(time_s)));
        }
    }

    /// Directions of the Sun in the mode.
    fn sun_directions(&self) -> SelectedSunDirections {
        let is_operational = self.modes.mode == Mode::Operational;
        if is_operational { self.downlink_sun.selected } else { SelectedSunDirections::default() }
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.command.is_valid()
            && self.burn.is_valid()
            && self.downlink_sun.selected.is_valid()
            && self.slew.is_none_or(|slew| slew.is_valid())
    }

    /// Whether a step could begin at `time_s`.
    pub fn covers(&self, time_s: f64) -> bool {
        let tolerance_s = 4.0 * spacing(time_s);
        (time_s - tolerance_s..=time_s + SAMPLE_INTERVAL_S + tolerance_s).contains(&self.next_sample_s)
    }

    /// Command in force: without a scenario the last one that gave an attitude, without its scans.
    pub fn continued(&self, command: &PointingCommand) -> PointingCommand {
        match self.law {
            Some(law) if command.scenario.is_none() => law.without_scans(),
            _ => *command,
        }
    }

    /// Updates burn, request and timers by the command of a sample, in whatever mode.
    fn update_timers(&mut self, command: &PointingCommand, entries: TimedEntries, time_s: f64) {
        let is_burn = command.scenario == Some(Scenario::Burn) && !entries.burn_is_over;
        self.burn.command(is_burn, self.timers.is_new_scenario(&entries), time_s);
        if entries.mode != self.timers.entries.mode {
            self.modes.last_request = None;
        }
        self.timers.update(command, entries, time_s);
    }

    /// Computes an attitude; without a direction the last law stays that gave one.
    fn compute_attitude(&mut self, now: &SampleContext<'_>, command: &PointingCommand) {
        let mut found = self.constrained(now, command);
        let is_given = found.is_some();
        if !is_given && let Some(law) = self.law.map(|law| self.modes.mode.allowed(&law.without_scans())) {
            found = self.constrained(now, &law);
        } else if is_given && self.modes.mode == Mode::Operational {
            self.law = Some(*command);
        }
        let Some((mut solution, mut constrained)) = found else {
            self.status = CommandStatus { degenerate: true, ..CommandStatus::NOTHING };
            return;
        };
        let is_slewing = self.slewed(now, &constrained.pointing).is_some_and(|slewed| {
            solution.downlink = DownlinkStatus::default();
            constrained = ConstrainedPointing { sun_keep_in: constrained.sun_keep_in, ..slewed };
            true
        });
        self.hot_pole_turn = constrained.hot_pole;
        self.command = self.command.followed_by(&constrained.pointing.frame(), now.time_s);
        self.status = CommandStatus::new(now, &solution, &constrained);
        self.status.degenerate |= !is_given;
        self.status.reachable &= !is_slewing;
    }

    /// Attitude of the slew into the command on the way to `target`, kept away from the hot pole; `None` where it is over.
    fn slewed(&mut self, now: &SampleContext<'_>, target: &Pointing) -> Option<ConstrainedPointing> {
        let slew = self.slew.as_mut()?;
        let rate_rad_s = now.settings.orbit_phase.slew_rate_rad_s;
        let (target, sun) = (target.frame(), now.ephemeris.lines().sun);
        if slew.is_open() {
            slew.aim(&target, &sun, now.constraints.keep_in.as_ref(), rate_rad_s);
        }
        let Some(slewed) = slew.at(now.time_s, &target, &sun, rate_rad_s) else {
            self.slew = None;
            return None;
        };
        let vectors = Pointing::from_frame(&slewed.frame).vectors();
        let constraints = Constraints { keep_in: None, ..now.constraints };
        constraints.applied(&vectors, now.ephemeris, self.hot_pole_turn)
    }

    /// The vectors of a command and the attitude within the constraints; `None` where something has no direction.
    fn constrained(
        &mut self,
        now: &SampleContext<'_>,
        command: &PointingCommand,
    ) -> Option<(PointingSolution, ConstrainedPointing)> {
        let solution = self.solution(now, command)?;
        let constrained = now.constraints.applied(&solution.vectors, now.ephemeris, self.hot_pole_turn)?;
        Some((solution, constrained))
    }

    /// The vectors that the command asks for.
    fn solution(&mut self, now: &SampleContext<'_>, command: &PointingCommand) -> Option<PointingSolution> {
        if command.scenario == Some(Scenario::OrbitPhase) {
            let guided = now.settings.orbit_phase.with_sun_directions(&self.sun_directions());
            let guided = Guided { requested: now.requested_sun, ..guided };
            let hardware = &now.settings.hardware;
            let law = OrbitPhaseLaw { guided, default_downlink: hardware.default_downlink };
            let attitude = self.periapses.attitude(&law, now.ephemeris);
            return Some(orbit_phase_solution(&attitude, &guided, now.ephemeris, hardware));
        }
        let progress = PointingProgress {
            scan: self.timers.scan_time(now.time_s),
            limb_elapsed_s: self.timers.limb_elapsed_s(now.time_s),
            downlink_sun: self.sun_directions().in_downlink().filter(|_| !now.sun_is_placed),
            requested: now.requested_sun,
            burn: self.burn.pointing(&now.settings.burn),
        };
        pointing_solution(command, &now.settings.hardware, now.ephemeris, &progress)
    }
}
