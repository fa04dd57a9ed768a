//! Inputs and tunable parameters of a step.

use fmi_export::{Enumeration, InputsOverTime, Real, RealVector, Values};
use nalgebra::Vector3;
use physics::attitude::control::SensorHealth;
use physics::bodies::Body;
use physics::guidance::modes::guidance_command::CommandKind as GuidanceCommandKind;
use physics::loads::ForceTorque;
use physics::plant::{Digest, DynamicsInputs, Maneuver, ThrustCommand};
use physics::propulsion::PulseCommand;
use serde::{Deserialize, Serialize};

use crate::common::choices::{CommandKind, OrbitCenter};
use crate::momentum_plant::setup::Plan;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::{
    AttitudeSource, CommandSource, EphemerisSource, OrbitSource,
};

/// Inputs and tunable parameters as they were last read.
#[derive(Clone, Debug, Default)]
pub struct StepInputs {
    /// Whether they have been read since the start or a restore.
    pub are_read: bool,
    /// How the attitude comes about.
    pub source: SourceChoice,
    /// The command inputs.
    pub command: CommandInputs,
    /// Whether position and velocity are inputs.
    pub orbit_is_given: bool,
    /// Whether they are inputs and changed since the last step.
    pub orbit_moves: bool,
    /// Position and velocity.
    pub orbit: [[f64; 3]; 2],
    /// Digest of the numbers on which loads depend, next to command and orbit.
    pub loads: Digest,
    /// Whether a panel's angle moves as an input.
    pub panels_move: bool,
    /// Mass and dumps.
    pub tunables: [f64; 8],
    /// Force and torque from outside.
    pub applied: [[f64; 3]; 2],
    /// The inputs without which there is no flight and that are not set yet.
    pub unset_places: Vec<&'static str>,
    /// Whether the Earth's position is an input and not set yet.
    pub earth_is_unset: bool,
    /// Whether a dump is requested, and the momentum after it, body frame, in N m s.
    pub dump: (bool, Vector3<f64>),
    /// Whether a maneuver is requested, and the maneuver.
    pub maneuver: (bool, Maneuver),
    /// Inputs of wheels, sensors and thrusters; the controller's command follows from the state.
    pub dynamics: DynamicsInputs,
}

/// How the attitude comes about.
#[derive(Clone, Copy, Debug, Default)]
pub struct SourceChoice {
    /// By dynamics.
    pub is_dynamic: bool,
    /// The orbit phase's own guidance gives the commands that are followed or tracked.
    pub guides_itself: bool,
    /// The inputs `command.*` are followed or tracked.
    pub is_commanded: bool,
}

impl SourceChoice {
    fn read(variables: &PlantVariables, values: &Values) -> Self {
        let source = values.choice(variables.attitude.source);
        let from_guidance = matches!(values.choice(variables.command.source), CommandSource::Guidance);
        let follows = matches!(source, AttitudeSource::Commanded | AttitudeSource::Controlled);
        Self {
            is_dynamic: matches!(source, AttitudeSource::Controlled | AttitudeSource::Free),
            guides_itself: matches!(source, AttitudeSource::Guided) || (follows && from_guidance),
            is_commanded: follows && !from_guidance,
        }
    }
}

/// The inputs `command.*`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CommandInputs {
    kind: i32,
    /// Attitude.
    pub q: [f64; 4],
    /// Body rate, in rad/s.
    pub rate: [f64; 3],
    /// Attitude error.
    pub error: [f64; 4],
}

impl CommandInputs {
    /// The kind of the command: which of its quantities count.
    pub fn kind(&self) -> GuidanceCommandKind {
        CommandKind::from_value(self.kind).unwrap_or(CommandKind::FIRST).0
    }

    /// With everything that the kind of command does not give left out; an error that was applied gives no more.
    pub fn given(self, error_is_applied: bool) -> Self {
        let (no_q, no_rate) = ([0.0; 4], [0.0; 3]);
        match self.kind() {
            GuidanceCommandKind::None => Self { q: no_q, rate: no_rate, error: no_q, ..self },
            GuidanceCommandKind::RateOnly => Self { q: no_q, error: no_q, ..self },
            GuidanceCommandKind::ErrorQuaternion if error_is_applied => Self { q: no_q, error: no_q, ..self },
            GuidanceCommandKind::ErrorQuaternion => Self { q: no_q, ..self },
            GuidanceCommandKind::Attitude => Self { error: no_q, ..self },
        }
    }
}

/// Force and torque from outside over a step.
pub(crate) struct AppliedLoad<'a> {
    pub inputs: [RealVector<3>; 2],
    pub held: [[f64; 3]; 2],
    pub over_time: InputsOverTime<'a>,
}

impl AppliedLoad<'_> {
    /// At a time, and how they change.
    pub(crate) fn at(&self, time_s: f64) -> [ForceTorque; 2] {
        let Self { inputs: [force, torque], held: [force_now, torque_now], over_time } = self;
        let value = |handle: &RealVector<3>, held: &[f64; 3]| {
            let value = |i: usize| over_time.from_held(held[i], handle.element(i), time_s);
            Vector3::new(value(0), value(1), value(2))
        };
        let rate = |handle: &RealVector<3>| {
            let rate = |i: usize| over_time.rate(handle.element(i), time_s);
            Vector3::new(rate(0), rate(1), rate(2))
        };
        [
            ForceTorque { force_body_n: value(force, force_now), torque_body_n_m: value(torque, torque_now) },
            ForceTorque { force_body_n: rate(force), torque_body_n_m: rate(torque) },
        ]
    }
}

impl StepInputs {
    /// Reads all of them.
    pub fn update(&mut self, context: &Plan<'_>, values: &Values, over_time: InputsOverTime<'_>) {
        let v = context.variables;
        let real = |handle: Real| values.real(handle);
        self.are_read = true;
        self.source = SourceChoice::read(v, values);
        self.command = CommandInputs {
            kind: values.choice(v.command.kind).value(),
            q: values.vector(v.command.q),
            rate: values.vector(v.command.rate),
            error: values.vector(v.command.error),
        };
        let [position, velocity] = [v.orbit.position, v.orbit.velocity];
        self.orbit = [position, velocity].map(|vector| values.vector(vector));
        let center_of_mass = v.spacecraft.center_of_mass;
        let vectors = [v.sun.position, v.sun.velocity, v.earth.position, v.earth.velocity, center_of_mass];
        let mut loads = Digest::default().with(vectors.into_iter().flat_map(|vector| values.vector(vector)));
        loads = loads.with([real(v.solar.at_1_au.scale)]);
        let of_panels = v
            .panel
            .iter()
            .flat_map(|it| [it.angle, it.sun_offset, it.sun_offset_command, it.angle_bias].map(real));
        loads = loads.with(of_panels);
        let materials = v.optics.values(context, values, &context.setup.optics, real);
        loads = loads.with(materials.flat_map(|it| it.acting()));
        let downlink = &v.downlink;
        loads = loads.with([downlink.sun_azimuth, downlink.sun_elevation].map(real));
        loads = loads.with_word(values.boolean(downlink.alternate).into());
        let (air, weather) = (&v.atmosphere, &v.space_weather);
        let given = [air.given_density, air.given_temperature, air.given_molar_mass, air.density_factor];
        let numbers = given.into_iter().chain([weather.f107, weather.f107_average, weather.ap]);
        loads = loads.with(numbers.map(real));
        let vectors = [air.wind, v.magnetic_field.given];
        loads = loads.with(vectors.into_iter().flat_map(|vector| values.vector(vector)));
        self.loads = loads.with(v.laws.tunable().map(real)).with([real(v.earth.ut1_offset)]);
        let moves = |input: Real| over_time.derivatives(input).next().is_some();
        self.panels_move = v.panel.iter().any(|panel| moves(panel.angle) || moves(panel.sun_offset_command));
        let ([a, b, c], [d, e, f]) = (values.vector(v.dump.threshold), values.vector(v.dump.target));
        self.tunables = [real(v.spacecraft.mass), real(v.dump.reinit_fraction), a, b, c, d, e, f];
        self.applied = [v.force.applied, v.torque.applied].map(|vector| values.vector(vector));
        self.dump = (values.boolean(v.dump.request), Vector3::new(d, e, f));
        let maneuver = Maneuver {
            delta_v_inertial_m_s: Vector3::from(values.vector(v.maneuver.delta_v)),
            thrusters: values.choice(v.maneuver.thrusters).0,
            dumps: values.boolean(v.maneuver.dump),
        };
        self.maneuver = (values.boolean(v.maneuver.request), maneuver);

        let orbit_source = values.choice(v.orbit.source);
        let is_unset = |place: RealVector<3>| values.vector(place) == [0.0; 3];
        let is_sun_given = matches!(values.choice(v.ephemeris_source), EphemerisSource::Inputs);
        // About the Sun, the Sun is at zero.
        let is_planet = !matches!(values.choice(v.orbit.center), OrbitCenter(Body::Sun));
        self.orbit_is_given = orbit_source.is_given();
        let is_moving = matches!(orbit_source, OrbitSource::Inputs);
        let places = [
            (self.orbit_is_given, position, "orbit.position"),
            (is_moving, velocity, "orbit.velocity"),
            (is_sun_given && is_planet, v.sun.position, "sun.position"),
        ];
        let unset = places.into_iter().filter(|(is_given, place, _)| *is_given && is_unset(*place));
        self.unset_places.clear();
        self.unset_places.extend(unset.map(|(_, _, name)| name));
        self.earth_is_unset = is_sun_given && is_unset(v.earth.position);
        self.update_dynamics(v, values);
    }

    /// Reads the inputs of wheels, thrusters and sensors.
    fn update_dynamics(&mut self, v: &PlantVariables, values: &Values) {
        let real = |handle: Real| values.real(handle);
        let dynamics = &mut self.dynamics;
        refill(&mut dynamics.wheel_torques_n_m, v.wheel.iter().map(|it| real(it.torque_command)));
        refill(&mut dynamics.wheel_failed, v.wheel.iter().map(|it| values.boolean(it.failed)));
        refill(&mut dynamics.sun_sensor_failed, v.sun_sensor.iter().map(|it| values.boolean(it.failed)));
        let pulses =
            v.thruster.iter().map(|it| PulseCommand { delay_s: real(it.on_delay), on_s: real(it.on_time) });
        refill(&mut dynamics.pulses, pulses);
        let stop_s = real(v.thrust.stop);
        dynamics.thrust = ThrustCommand {
            set: values.choice(v.thrust.request).0.filter(|_| values.boolean(v.thrust.command)),
            stop_s: if stop_s < 0.0 { f64::INFINITY } else { stop_s },
        };
        // The spare takes over where the first star tracker has failed.
        let tracker = &v.star_tracker;
        dynamics.health = SensorHealth {
            star_tracker: !(values.boolean(tracker.failed) && values.boolean(tracker.spare_failed)),
            gyro: !values.boolean(v.gyro.failed),
        };
    }
}

/// Puts `items` in the place of those before: a step allocates nothing.
fn refill<T>(memory: &mut Vec<T>, items: impl Iterator<Item = T>) {
    memory.clear();
    memory.extend(items);
}
