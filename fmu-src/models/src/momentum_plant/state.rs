//! What the plant remembers between steps.

use fmi_export::{Failure, Values};
use physics::attitude::Attitude;
use physics::environment::ephemeris::Ephemeris;
use physics::momentum::{Accumulator, Event, Totals};
use physics::plant::{Command, Configuration, Course, LightModel};
use serde::{Deserialize, Serialize};

use super::choices::{AttitudeSource, CommandKind};
use super::{Plan, log_dump, physics_vector};

/// State of one plant.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PlantState {
    /// Start time of the flight, in s.
    pub start_s: f64,
    /// The orbit and the stretch of flight at hand.
    pub course: Course,
    /// Momentum, delta-v and dumps.
    pub accumulator: Accumulator,
    /// The command in effect and the inputs it came from.
    pub command: Command,
    command_inputs: CommandInputs,
    /// When the orbit's position and velocity inputs last changed, in s.
    pub orbit_since_s: f64,
    orbit_inputs: [[f64; 3]; 2],
    /// Inputs and tunables that light and heat depend on, beside command and orbit, at the last change.
    light_inputs: Vec<f64>,
    /// `dump.request` at the last step.
    pub request: Request,
    /// Time between dumps.
    pub spacing: Spacing,
    /// Cache, not state: the same epoch gives the same bits.
    #[serde(skip)]
    pub ephemeris: Ephemeris,
    /// Cache of what parameters and inputs say.
    #[serde(skip)]
    pub configuration: Option<Configuration>,
    /// Cache of what light and heat need; absent where direct sunlight is all there is.
    #[serde(skip)]
    pub light: Option<LightModel>,
}

/// What a change of inputs and tunables touches.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Changes {
    /// Position and velocity are given anew.
    pub orbit: bool,
    /// Light and heat are no longer what they were going to be.
    pub light: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct CommandInputs {
    kind: i32,
    q: [f64; 4],
    rate: [f64; 3],
    error: [f64; 4],
}

/// An input whose rising edge counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Request(bool);

impl Request {
    /// Takes the present value; true when it rose.
    pub fn rises(&mut self, now: bool) -> bool {
        let before = std::mem::replace(&mut self.0, now);
        now && !before
    }
}

/// Shortest time between two dumps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Spacing {
    last_s: Option<f64>,
    /// In s; absent before the second dump.
    pub closest_s: Option<f64>,
}

impl Spacing {
    /// Counts a dump and reports it.
    pub fn dumped(&mut self, context: &Plan<'_>, event: &Event) {
        log_dump(context, event);
        if let Some(last_s) = self.last_s.replace(event.time_s) {
            let gap_s = event.time_s - last_s;
            self.closest_s = Some(self.closest_s.map_or(gap_s, |closest_s| closest_s.min(gap_s)));
        }
    }
}

impl PlantState {
    /// At the start, before anything is accumulated.
    pub fn new(context: &Plan<'_>, values: &Values, start_s: f64) -> Result<Self, Failure> {
        let q = values.vector(context.variables.initial.q);
        let attitude =
            Attitude::from_quaternion(q).map_err(|error| Failure::new(format!("initial.q: {error}")))?;
        let rate_body_rad_s = physics_vector([0.0; 3]);
        let mut state = Self {
            start_s,
            course: Course::default(),
            accumulator: Accumulator::new(start_s, Totals::default()),
            command: Command { attitude, rate_body_rad_s, since_s: start_s },
            command_inputs: CommandInputs::read(context, values),
            orbit_since_s: start_s,
            orbit_inputs: orbit_inputs(context, values),
            light_inputs: light_inputs(context, values).collect(),
            request: Request::default(),
            spacing: Spacing::default(),
            ephemeris: Ephemeris::default(),
            configuration: None,
            light: None,
        };
        if is_commanded(context, values) {
            state.take_command(context, values, start_s)?;
        }
        Ok(state)
    }

    /// Takes over inputs and tunables that differ from the last ones.
    pub fn inputs_changed(
        &mut self,
        context: &Plan<'_>,
        values: &Values,
        time_s: f64,
    ) -> Result<Changes, Failure> {
        let inputs = CommandInputs::read(context, values);
        let commanded = is_commanded(context, values) && inputs != self.command_inputs;
        if commanded {
            self.command_inputs = inputs;
            self.take_command(context, values, time_s)?;
        }
        let orbit = orbit_inputs(context, values);
        let moved = orbit != self.orbit_inputs;
        if moved {
            self.orbit_inputs = orbit;
            self.orbit_since_s = time_s;
        }
        let lit = !light_inputs(context, values).eq(self.light_inputs.iter().copied());
        if lit {
            self.light_inputs.clear();
            self.light_inputs.extend(light_inputs(context, values));
        }
        Ok(Changes { orbit: moved, light: lit || moved || commanded })
    }

    fn take_command(&mut self, context: &Plan<'_>, values: &Values, time_s: f64) -> Result<(), Failure> {
        let CommandInputs { q, rate, error, .. } = self.command_inputs;
        let quaternion = |name: &str, q| {
            Attitude::along_quaternion(q).map_err(|error| Failure::new(format!("{name}: {error}")))
        };
        let held = self.command.attitude_at(time_s);
        let attitude = match values.choice(context.variables.command.kind) {
            Some(CommandKind::ErrorQuaternion) => held.then(&quaternion("command.error", error)?),
            Some(CommandKind::RateOnly) => held,
            Some(CommandKind::Attitude) | None => quaternion("command.q", q)?,
        };
        self.command = Command { attitude, rate_body_rad_s: physics_vector(rate), since_s: time_s };
        Ok(())
    }
}

/// Whether the attitude follows the inputs `command.*`.
fn is_commanded(context: &Plan<'_>, values: &Values) -> bool {
    matches!(values.choice(context.variables.attitude.source), Some(AttitudeSource::Commanded))
}

impl CommandInputs {
    fn read(context: &Plan<'_>, values: &Values) -> Self {
        let command = &context.variables.command;
        Self {
            kind: values.choice(command.kind).map_or(0, fmi_export::Enumeration::value),
            q: values.vector(command.q),
            rate: values.vector(command.rate),
            error: values.vector(command.error),
        }
    }
}

fn orbit_inputs(context: &Plan<'_>, values: &Values) -> [[f64; 3]; 2] {
    let orbit = &context.variables.orbit;
    [values.vector(orbit.position), values.vector(orbit.velocity)]
}

fn light_inputs<'a>(context: &'a Plan<'_>, values: &'a Values) -> impl Iterator<Item = f64> + 'a {
    let variables = context.variables;
    let vectors = [variables.sun.position, variables.earth.position, variables.spacecraft.center_of_mass];
    let panels =
        variables.panel.iter().flat_map(|panel| [values.real(panel.angle), values.real(panel.sun_offset)]);
    vectors.into_iter().flat_map(|vector| values.vector(vector)).chain(panels)
}
