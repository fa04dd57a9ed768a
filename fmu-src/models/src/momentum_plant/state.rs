//! What the plant remembers between steps.

use fmi_export::{Enumeration, Failure, InputsOverTime, Values};
use nalgebra::Vector3;
use physics::attitude::Attitude;
use physics::bodies::Body;
use physics::guidance::modes::guidance_command::CommandKind as Kind;
use physics::plant::{Changes, Command, DynamicsInputs, Flight, Thrusters};
use physics::spacecraft::Spacecraft;
use serde::{Deserialize, Serialize};

use super::inputs::dynamics::guides_itself;
use super::inputs::propulsion::{ThrusterWarnings, reaction_control};
use super::inputs::{is_given, panels_move};
use super::setup::Plan;
use super::variables::choices::{AttitudeSource, EphemerisSource, OrbitSource};
use crate::common::choices::{CommandKind, OrbitCenter};

/// State of one plant.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct PlantState {
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
    /// `dump.request` at the last step.
    pub request: Request,
    /// Which warnings were given.
    pub warned: Warned,
    /// Memory for what the inputs of a step say.
    #[serde(skip)]
    pub inputs: Option<DynamicsInputs>,
}

/// Warnings that are given once.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct Warned {
    /// About thrusters.
    pub thrusters: ThrusterWarnings,
    /// Which inputs are not set yet.
    unset_inputs: bool,
}

/// What was set at the last change.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct LastInputs {
    command: CommandInputs,
    /// Whether the attitude error of the command was applied.
    error_is_applied: bool,
    orbit: [[f64; 3]; 2],
    /// When they changed, in s.
    orbit_since_s: f64,
    /// On which light and heat depend, beside command and orbit.
    light: Vec<f64>,
    /// Whether a panel's angle moved as an input.
    panels_moved: bool,
    /// Mass and dumps.
    tunables: [f64; 8],
    /// Force from outside.
    force: [f64; 3],
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

impl PlantState {
    /// Checks numbers that were decoded.
    pub fn check(&self, spacecraft: &Spacecraft) -> Result<(), Failure> {
        let parts =
            [("the command", self.command.is_valid()), ("the flight", self.flight.is_valid(spacecraft))];
        match parts.iter().find(|(_, is_valid)| !is_valid) {
            None => Ok(()),
            Some((part, _)) => Err(Failure::new(format!(
                "{part} in the saved state hold what no flight has: no rotation, or counts and times that do not fit"
            ))),
        }
    }

    /// At the start, before anything is accumulated.
    pub fn new(context: &Plan<'_>, values: &Values, start_s: f64) -> Result<Self, Failure> {
        let q = values.vector(context.variables.start.q);
        let attitude =
            Attitude::from_quaternion(q).map_err(|error| Failure::new(format!("start.q: {error}")))?;
        let rate_body_rad_s = Vector3::from([0.0; 3]);
        let mut state = Self {
            start_s,
            flight: Flight::waiting(Thrusters::new(reaction_control(context, values)?, start_s)),
            waiting: !unset_places(context, values).is_empty(),
            command: Command { attitude, rate_body_rad_s, since_s: start_s },
            last: LastInputs {
                command: CommandInputs::read(context, values),
                error_is_applied: false,
                orbit: orbit_inputs(context, values),
                orbit_since_s: start_s,
                light: light_inputs(context, values).collect(),
                panels_moved: false,
                tunables: tunables(context, values),
                force: values.vector(context.variables.force.applied),
            },
            request: Request::default(),
            warned: Warned::default(),
            inputs: None,
        };
        if is_commanded(context, values) {
            state.take_command(context, values, start_s)?;
        }
        Ok(state)
    }

    /// When the orbit's position and velocity inputs last changed, in s.
    pub fn orbit_since_s(&self) -> f64 {
        self.last.orbit_since_s
    }

    /// Takes over inputs and tunables that differ from the last ones.
    pub fn inputs_changed(
        &mut self,
        context: &Plan<'_>,
        values: &Values,
        over_time: InputsOverTime<'_>,
        time_s: f64,
    ) -> Result<Changes, Failure> {
        let command = CommandInputs::read(context, values);
        let before = core::mem::replace(&mut self.last.command, command);
        let commanded = is_commanded(context, values)
            && command.given(self.last.error_is_applied) != before.given(self.last.error_is_applied);
        if command.kind != before.kind {
            self.last.error_is_applied = false;
        }
        if commanded {
            self.take_command(context, values, time_s)?;
        }
        let last = &mut self.last;
        let orbit = orbit_inputs(context, values);
        let moved = core::mem::replace(&mut last.orbit, orbit) != orbit;
        if moved {
            last.orbit_since_s = time_s;
        }
        // Panels that move in this step or did in the last are elsewhere than was computed.
        let panels_move = panels_move(context, over_time);
        let panels_moved = core::mem::replace(&mut last.panels_moved, panels_move);
        let lit =
            panels_move || panels_moved || !light_inputs(context, values).eq(last.light.iter().copied());
        if lit {
            last.light.clear();
            last.light.extend(light_inputs(context, values));
        }
        let tunables = tunables(context, values);
        let before = core::mem::replace(&mut last.tunables, tunables);
        let force = values.vector(context.variables.force.applied);
        // A command moves light through the attitude, which in dynamics does not jump.
        let turned = commanded && self.flight.estimate_at(time_s).is_none();
        Ok(Changes {
            orbit: moved && is_given(context.variables, values),
            light: lit || moved || turned,
            mass: before[0] != tunables[0],
            force: core::mem::replace(&mut last.force, force) != force,
            tunables: before != tunables,
        })
    }

    /// The command that stands at the start of a flight with dynamics; until one comes `attitude` is held.
    pub fn take_first_command(
        &mut self,
        context: &Plan<'_>,
        values: &Values,
        attitude: Attitude,
        time_s: f64,
    ) -> Result<(), Failure> {
        self.command = Command { attitude, rate_body_rad_s: Vector3::from([0.0; 3]), since_s: time_s };
        // An error applied before there was a body to turn counts for nothing.
        self.last.error_is_applied = false;
        if is_commanded(context, values) { self.take_command(context, values, time_s) } else { Ok(()) }
    }

    fn take_command(&mut self, context: &Plan<'_>, values: &Values, time_s: f64) -> Result<(), Failure> {
        let CommandInputs { q, rate, error, .. } = self.last.command;
        let quaternion = |name: &str, q| {
            Attitude::along_quaternion(q).map_err(|error| Failure::new(format!("{name}: {error}")))
        };
        let estimate = self.flight.estimate_at(time_s).map(|estimate| estimate.attitude);
        let held = estimate.unwrap_or_else(|| self.command.attitude_at(time_s));
        let (attitude, rate) = match values.choice(context.variables.command.kind).0 {
            Kind::None => (held, [0.0; 3]),
            Kind::RateOnly => (held, rate),
            Kind::ErrorQuaternion if self.last.error_is_applied => (held, rate),
            Kind::ErrorQuaternion if is_zero(&error) => (held, [0.0; 3]),
            Kind::ErrorQuaternion => {
                self.last.error_is_applied = estimate.is_none();
                (held.then(&quaternion("command.error", error)?.inverse()), rate)
            }
            Kind::Attitude if is_zero(&q) => (held, [0.0; 3]),
            Kind::Attitude => (quaternion("command.q", q)?, rate),
        };
        self.command = Command { attitude, rate_body_rad_s: Vector3::from(rate), since_s: time_s };
        Ok(())
    }

    /// Warns once which inputs are not set yet, if any.
    pub fn warn_unset_inputs(&mut self, context: &Plan<'_>, values: &Values) {
        if self.warned.unset_inputs {
            return;
        }
        let mut unset = unset_places(context, values);
        let is_earth_given =
            matches!(values.choice(context.variables.ephemeris.source), EphemerisSource::Inputs);
        if is_earth_given && is_zero(&values.vector(context.variables.earth.position)) {
            unset.push("earth.position");
        }
        if is_commanded(context, values) {
            let CommandInputs { q, error, .. } = &self.last.command;
            match values.choice(context.variables.command.kind).0 {
                Kind::None => unset.push("command.kind"),
                Kind::Attitude if is_zero(q) => unset.push("command.q"),
                Kind::ErrorQuaternion if !self.last.error_is_applied && is_zero(error) => {
                    unset.push("command.error");
                }
                _ => {}
            }
        }
        if unset.is_empty() {
            return;
        }
        self.warned.unset_inputs = true;
        let until = if self.waiting {
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

/// The inputs without which there is no flight and that are not set yet.
pub fn unset_places(context: &Plan<'_>, values: &Values) -> Vec<&'static str> {
    let variables = context.variables;
    let orbit_given = is_given(variables, values);
    let moves = !matches!(values.choice(variables.orbit.source), OrbitSource::Held);
    let sun_given = matches!(values.choice(variables.ephemeris.source), EphemerisSource::Inputs);
    // About the Sun, the Sun is at zero.
    let planet = !matches!(values.choice(variables.orbit.center), OrbitCenter(Body::Sun));
    let places = [
        (orbit_given, variables.orbit.position, "orbit.position"),
        (orbit_given && moves, variables.orbit.velocity, "orbit.velocity"),
        (sun_given && planet, variables.sun.position, "sun.position"),
    ];
    let unset = places.iter().filter(|(given, place, _)| *given && is_zero(&values.vector(*place)));
    unset.map(|(_, _, name)| *name).collect()
}

/// Whether the attitude follows or tracks the inputs `command.*`.
fn is_commanded(context: &Plan<'_>, values: &Values) -> bool {
    let source = values.choice(context.variables.attitude.source);
    matches!(source, AttitudeSource::Commanded | AttitudeSource::Controlled)
        && !guides_itself(context, values)
}

impl CommandInputs {
    fn read(context: &Plan<'_>, values: &Values) -> Self {
        let command = &context.variables.command;
        Self {
            kind: values.choice(command.kind).value(),
            q: values.vector(command.q),
            rate: values.vector(command.rate),
            error: values.vector(command.error),
        }
    }

    /// With everything that the kind of command does not give left out; an error that was applied gives no more.
    fn given(self, error_is_applied: bool) -> Self {
        let (no_q, no_rate) = ([0.0; 4], [0.0; 3]);
        match CommandKind::from_value(self.kind).unwrap_or(CommandKind::FIRST).0 {
            Kind::None => Self { q: no_q, rate: no_rate, error: no_q, ..self },
            Kind::RateOnly => Self { q: no_q, error: no_q, ..self },
            Kind::ErrorQuaternion if error_is_applied => Self { q: no_q, error: no_q, ..self },
            Kind::ErrorQuaternion => Self { q: no_q, ..self },
            Kind::Attitude => Self { error: no_q, ..self },
        }
    }
}

fn orbit_inputs(context: &Plan<'_>, values: &Values) -> [[f64; 3]; 2] {
    let orbit = &context.variables.orbit;
    [values.vector(orbit.position), values.vector(orbit.velocity)]
}

fn tunables(context: &Plan<'_>, values: &Values) -> [f64; 8] {
    let v = context.variables;
    let ([a, b, c], [d, e, f]) = (values.vector(v.dump.threshold), values.vector(v.dump.target));
    [values.real(v.spacecraft.mass), values.real(v.dump.reinit_fraction), a, b, c, d, e, f]
}

fn light_inputs<'a>(context: &'a Plan<'_>, values: &'a Values) -> impl Iterator<Item = f64> + 'a {
    let variables = context.variables;
    let (sun, earth) = (&variables.sun, &variables.earth);
    let center_of_mass = variables.spacecraft.center_of_mass;
    let vectors = [sun.position, sun.velocity, earth.position, earth.velocity, center_of_mass];
    let panels = variables.panel.iter().flat_map(|panel| {
        [panel.angle, panel.sun_offset, panel.sun_offset_command].map(|angle| values.real(angle))
    });
    vectors.into_iter().flat_map(|vector| values.vector(vector)).chain(panels)
}
