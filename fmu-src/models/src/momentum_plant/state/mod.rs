//! State of the plant between steps: the flight, the command in effect, and the inputs last read.

pub(super) mod step_inputs;

use fmi_export::Failure;
use nalgebra::Vector3;
use physics::attitude::Attitude;
use physics::guidance::modes::guidance_command::CommandKind as GuidanceCommandKind;
use physics::plant::{Command, Digest, Flight, SimulationContext, Thrusters, Tracked};
use physics::plausibility::FlightWatch;
use physics::spacecraft::Spacecraft;
use serde::{Deserialize, Serialize};

use self::step_inputs::{CommandInputs, StepInputs};
use super::setup::Plan;

/// A commanded quaternion whose norm is off 1 by more is warned of.
const NORM_TOLERANCE: f64 = 0.05;

/// State of one plant, and apart from it what the step has read; that is not saved but read anew after a restore.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(transparent)]
pub struct PlantState {
    /// Everything that is saved.
    pub saved: SavedState,
    /// Inputs and tunable parameters of the step.
    #[serde(skip)]
    pub inputs: StepInputs,
}

/// The part of a plant's state that is saved.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct SavedState {
    /// Start time of the flight, in s.
    pub start_s: f64,
    /// The spacecraft in flight.
    pub flight: Flight,
    /// Whether it waits for inputs that are not set yet: nothing acts, and the attitude is held.
    pub waiting: bool,
    /// The command in effect.
    pub command: Command,
    /// Inputs and tunables at the last change.
    last: LastInputs,
    /// Digest of the files of timeline and ephemeris that the flight follows.
    schedules: u64,
    /// `dump.request` at the last step.
    pub request: Request,
    /// `maneuver.request` at the last step.
    pub maneuver_request: Request,
    /// Warnings that were given.
    pub warned: Warned,
}

/// Warnings that are given once.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Warned {
    /// Warnings of the watch over the flight.
    pub watch: FlightWatch,
    /// Warnings about thrusters.
    pub thrusters: ThrusterWarnings,
    /// Inputs that are not set yet were named.
    unset_inputs: bool,
    /// A commanded quaternion was far from unit length.
    command_norm: bool,
    /// Targets of the attitude were on one line.
    pub degenerate: bool,
}

/// Warnings about thrusters that were given.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct ThrusterWarnings {
    /// A pulse was cut at the end of its step.
    pub cut: bool,
    /// A delta-v was requested from a set without thrusters.
    pub no_set: bool,
    /// A dump found no thrusters about every axis both ways.
    pub unserved: bool,
    /// A dump found thrusters that no tank fed.
    pub unfed: bool,
}

/// Inputs and tunable parameters at their last change.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct LastInputs {
    command: CommandInputs,
    /// Whether the attitude error of the command was applied.
    error_is_applied: bool,
    orbit: [[f64; 3]; 2],
    /// When they changed, in s.
    orbit_since_s: f64,
    /// Digest of the numbers on which loads depend, command and orbit among them.
    loads: Digest,
    /// Mass and dumps.
    tunables: [f64; 8],
    /// Force from outside.
    force: [f64; 3],
}

/// An input whose rising edge counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Request(bool);

impl Request {
    /// Stores the present value and returns whether it rose.
    pub fn rises(&mut self, now: bool) -> bool {
        let before = std::mem::replace(&mut self.0, now);
        now && !before
    }
}

impl PlantState {
    /// Checks numbers that were decoded.
    pub fn check(&self, spacecraft: &Spacecraft) -> Result<(), Failure> {
        let parts = [
            ("the command", self.saved.command.attitude.is_rotation()),
            ("the flight", self.saved.flight.is_valid(spacecraft)),
        ];
        match parts.iter().find(|(_, is_valid)| !is_valid) {
            None => Ok(()),
            Some((part, _)) => Err(Failure::new(format!(
                "{part} in the saved state hold what no flight has: no rotation, or counts and times that do not fit"
            ))),
        }
    }

    /// State at the start, before anything is accumulated.
    pub fn new(
        inputs: StepInputs,
        attitude: Attitude,
        thrusters: Thrusters,
        start_s: f64,
        schedules: u64,
    ) -> Result<Self, Failure> {
        let saved = SavedState {
            start_s,
            flight: Flight::waiting(thrusters),
            waiting: true,
            command: Command { attitude, rate_body_rad_s: Vector3::from([0.0; 3]), since_s: start_s },
            last: LastInputs {
                command: inputs.command,
                error_is_applied: false,
                orbit: inputs.orbit,
                orbit_since_s: start_s,
                loads: inputs.loads,
                tunables: inputs.tunables,
                force: inputs.applied[0],
            },
            schedules,
            request: Request::default(),
            maneuver_request: Request::default(),
            warned: Warned::default(),
        };
        let mut state = Self { saved, inputs };
        if state.inputs.source.is_commanded {
            state.update_command(start_s)?;
        }
        Ok(state)
    }

    /// When the orbit's position and velocity inputs last changed, in s.
    pub fn orbit_since_s(&self) -> f64 {
        self.saved.last.orbit_since_s
    }

    /// Compares inputs and tunables with the last ones and stores them; returns whether the configuration changed.
    pub fn update_inputs(&mut self, time_s: f64) -> Result<bool, Failure> {
        let (command, is_commanded) = (self.inputs.command, self.inputs.source.is_commanded);
        let before = core::mem::replace(&mut self.saved.last.command, command);
        let is_applied = self.saved.last.error_is_applied;
        let commanded = is_commanded && command.given(is_applied) != before.given(is_applied);
        if command.kind() != before.kind() {
            self.saved.last.error_is_applied = false;
        }
        if commanded {
            self.update_command(time_s)?;
        }
        self.track();
        let Self { saved: SavedState { last, command, .. }, inputs } = self;
        let mut loads = inputs.loads.with(inputs.orbit.as_flattened().iter().copied());
        // A command moves light through the attitude, which in dynamics does not jump.
        if inputs.source.is_commanded && !inputs.source.is_dynamic {
            let Command { attitude, rate_body_rad_s, since_s } = command;
            let numbers = attitude.unit_quaternion().0.into_iter().chain(rate_body_rad_s.iter().copied());
            loads = loads.with(numbers.chain([*since_s]));
        }
        // Panels that move in this step are elsewhere in the next.
        if inputs.panels_move {
            loads = loads.with([time_s]);
        }
        let moved = core::mem::replace(&mut last.orbit, inputs.orbit) != inputs.orbit;
        if moved {
            last.orbit_since_s = time_s;
        }
        inputs.orbit_moves = moved && inputs.orbit_is_given;
        let is_changed = inputs.orbit_moves || last.loads != loads || last.tunables != inputs.tunables;
        (last.loads, last.tunables, [last.force, _]) = (loads, inputs.tunables, inputs.applied);
        Ok(is_changed)
    }

    /// Gives the flight the digest of what loads depend on; in dynamics mass and forces that move the orbit are among it.
    pub fn pass_digest(&mut self) {
        let Self { saved: SavedState { last, flight, schedules, .. }, inputs } = self;
        let Some(SimulationContext { configuration, models, .. }) = flight.context_mut() else { return };
        models.digest = last.loads.with_word(*schedules);
        if inputs.source.is_dynamic {
            models.digest = models.digest.with([last.tunables[0]]);
            let has_forces = configuration.motion.has_nongravitational_forces();
            models.digest = models.digest.with(last.force.into_iter().filter(|_| has_forces));
        }
    }

    /// Follows the files with this digest from `time_s` on; returns whether they changed, which ends everything computed ahead.
    pub fn update_schedules(&mut self, schedules: u64, time_s: f64) -> bool {
        let changed = core::mem::replace(&mut self.saved.schedules, schedules) != schedules;
        if changed {
            self.saved.flight.reschedule(time_s);
        }
        changed
    }

    /// Begins a flight with dynamics at the command that stands at its start; `attitude` is held where there is none.
    pub fn start_command(&mut self, attitude: Attitude, time_s: f64) -> Result<(), Failure> {
        self.saved.command = Command { attitude, rate_body_rad_s: Vector3::from([0.0; 3]), since_s: time_s };
        // An error applied before there was a body to turn counts for nothing.
        self.saved.last.error_is_applied = false;
        if self.inputs.source.is_commanded {
            self.update_command(time_s)?;
        }
        self.track();
        Ok(())
    }

    /// The command by inputs, where it gives an attitude.
    pub fn attitude_command(&self) -> Option<Command> {
        let given = &self.saved.last.command;
        let is_given = matches!(given.kind(), GuidanceCommandKind::Attitude) && !is_zero(&given.q);
        (self.inputs.source.is_commanded && is_given).then_some(self.saved.command)
    }

    /// The controller tracks the command in effect.
    fn track(&mut self) {
        self.inputs.dynamics.tracked = match self.saved.last.command.kind() {
            _ if self.inputs.source.guides_itself => Tracked::Guidance,
            GuidanceCommandKind::RateOnly => Tracked::Rate(self.saved.command.rate_body_rad_s),
            _ => Tracked::Attitude(self.saved.command),
        };
    }

    fn update_command(&mut self, time_s: f64) -> Result<(), Failure> {
        let CommandInputs { q, rate, error, .. } = self.saved.last.command;
        let quaternion = |name: &str, q| {
            Attitude::along_quaternion(q).map_err(|error| Failure::new(format!("{name}: {error}")))
        };
        let estimate = self.saved.flight.estimate_at(time_s).map(|estimate| estimate.attitude);
        let held = estimate.unwrap_or_else(|| self.saved.command.attitude_at(time_s));
        let (attitude, rate) = match self.saved.last.command.kind() {
            GuidanceCommandKind::None => (held, [0.0; 3]),
            GuidanceCommandKind::RateOnly => (held, rate),
            GuidanceCommandKind::ErrorQuaternion if self.saved.last.error_is_applied => (held, rate),
            GuidanceCommandKind::ErrorQuaternion if is_zero(&error) => (held, [0.0; 3]),
            GuidanceCommandKind::ErrorQuaternion => {
                self.saved.last.error_is_applied = estimate.is_none();
                (held.then(&quaternion("command.error", error)?.inverse()), rate)
            }
            GuidanceCommandKind::Attitude if is_zero(&q) => (held, [0.0; 3]),
            GuidanceCommandKind::Attitude => (quaternion("command.q", q)?, rate),
        };
        let attitude = attitude.continuing(&held.unit_quaternion());
        self.saved.command = Command { attitude, rate_body_rad_s: Vector3::from(rate), since_s: time_s };
        Ok(())
    }

    /// Warns once of a commanded quaternion far from unit length, which is taken along its direction.
    pub fn warn_command_norm(&mut self, context: &Plan<'_>, time_s: f64) {
        let CommandInputs { q, error, .. } = self.saved.last.command;
        let (name, q) = match self.saved.last.command.kind() {
            GuidanceCommandKind::Attitude => ("command.q", q),
            GuidanceCommandKind::ErrorQuaternion => ("command.error", error),
            GuidanceCommandKind::None | GuidanceCommandKind::RateOnly => return,
        };
        let Some(norm) = Attitude::norm_if_far_from_unit(q, NORM_TOLERANCE) else { return };
        if is_zero(&q) || !self.inputs.source.is_commanded || self.saved.warned.command_norm {
            return;
        }
        self.saved.warned.command_norm = true;
        context.log.warning(&format!(
            "{name} = {q:?} at {time_s} s has norm {norm:.4}: it is restored to 1, and points elsewhere where components were \
             interpolated between quaternions of other signs or far apart"
        ));
    }

    /// Names once the inputs that are not set yet.
    pub fn warn_unset_inputs(&mut self, context: &Plan<'_>) {
        if self.saved.warned.unset_inputs {
            return;
        }
        let earth = self.inputs.earth_is_unset.then_some("earth.position");
        let CommandInputs { q, error, .. } = &self.saved.last.command;
        let command = match self.saved.last.command.kind() {
            _ if !self.inputs.source.is_commanded => None,
            GuidanceCommandKind::None => Some("command.kind"),
            GuidanceCommandKind::Attitude if is_zero(q) => Some("command.q"),
            GuidanceCommandKind::ErrorQuaternion if !self.saved.last.error_is_applied && is_zero(error) => {
                Some("command.error")
            }
            _ => None,
        };
        let places = self.inputs.unset_places.iter().copied();
        let unset: Vec<&str> = places.chain(earth).chain(command).collect();
        if unset.is_empty() {
            return;
        }
        self.saved.warned.unset_inputs = true;
        let until = if self.saved.waiting {
            "the attitude is held and nothing acts until then"
        } else {
            "without a command the attitude is held, without the Earth it stands at the orbit's centre"
        };
        context.log.warning(&format!(
            "inputs that are all zero count as not set yet: {}; {until}",
            unset.join(", ")
        ));
    }
}

fn is_zero(vector: &[f64]) -> bool {
    vector.iter().all(|x| *x == 0.0)
}
