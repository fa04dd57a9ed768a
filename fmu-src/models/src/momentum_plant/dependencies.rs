//! Dependencies of outputs and calculated parameters, by groups.

use fmi_export::{Dependencies, Knowns, Model, knowns};

use super::setup::{MomentumPlant, PlantSetup};
use super::variables::PlantVariables;
use super::variables::choices::{AttitudeSource, CommandSource, EphemerisSource, OrbitSource, StartAttitude};
use crate::common::start_values::fixed_item;

/// Rows by groups of outputs.
pub(super) fn table(setup: &PlantSetup, v: &PlantVariables) -> Dependencies {
    let choice = OpenChoices::new(setup);
    let (inputs, parameters) = (&Inputs::new(setup, choice, v), &Parameters::new(choice, v));
    let mut table = Dependencies::new();
    motion(&mut table, v, inputs, parameters);
    loads(&mut table, v, inputs, parameters);
    momentum(&mut table, v, inputs, parameters);
    actuators(&mut table, v, inputs, parameters);
    if choice.begins_commanded {
        table.begins(turned(v), &v.command);
    }
    table
}

/// Ways to turn the spacecraft that the options of the setup leave open.
#[derive(Clone, Copy, Debug)]
struct OpenChoices {
    /// The attitude follows a command or guidance, and dumps take the momentum at once.
    ideal: bool,
    /// The body turns by torque.
    by_torque: bool,
    /// The orbit phase's own guidance sets the attitude, if only where a flight by torque begins.
    guided: bool,
    /// The orbit phase's guidance gives the attitude where a free flight begins, for the file has none.
    begins_guided: bool,
    /// The command gives the attitude where a controlled flight begins, likewise.
    begins_commanded: bool,
    /// Orbit or Sun may come by inputs: until they do, the attitude is the commanded one in any flight.
    waits: bool,
}

impl OpenChoices {
    /// The ways that stay open with what the setup fixes.
    fn new(setup: &PlantSetup) -> Self {
        use AttitudeSource::{Commanded, Controlled, Free, Guided};
        let start = &setup.spacecraft.start;
        let source = fixed_item::<AttitudeSource>(start, MomentumPlant::NAME, "attitude.source");
        let command = fixed_item::<CommandSource>(start, MomentumPlant::NAME, "command.source");
        let is_inputs = matches!(command, Some(CommandSource::Inputs));
        let orbit = fixed_item::<OrbitSource>(start, MomentumPlant::NAME, "orbit.source");
        let ephemeris = fixed_item::<EphemerisSource>(start, MomentumPlant::NAME, "ephemeris.source");
        let has_places = matches!(orbit, Some(OrbitSource::Elements))
            && !matches!(ephemeris, None | Some(EphemerisSource::Inputs));
        let is_given = |name: &str| {
            let for_this = start
                .iter()
                .filter(|it| it.model.as_deref().is_none_or(|model| model == MomentumPlant::NAME));
            for_this.into_iter().any(|it| it.name == name || it.name.starts_with(&format!("{name}[")))
        };
        let begins_pointed = match fixed_item::<StartAttitude>(start, MomentumPlant::NAME, "start.attitude") {
            None | Some(StartAttitude::Guided) => true,
            Some(StartAttitude::Automatic) => !is_given("start.q") && !is_given("start.rate"),
            Some(StartAttitude::Given) => false,
        };
        Self {
            ideal: matches!(source, None | Some(Guided | Commanded)),
            by_torque: matches!(source, None | Some(Controlled | Free)),
            guided: match source {
                None | Some(Guided) => true,
                Some(Commanded | Controlled) => !is_inputs,
                Some(Free) => false,
            },
            begins_guided: begins_pointed && matches!(source, Some(Free)),
            begins_commanded: begins_pointed
                && matches!(source, Some(Controlled))
                && !matches!(command, Some(CommandSource::Guidance)),
            waits: !has_places,
        }
    }
}

/// Outputs that follow the attitude.
fn turned(v: &PlantVariables) -> Knowns {
    let sun = knowns![v.sun.direction, v.sun.azimuth, v.sun.elevation, v.sun.position_body];
    let others = knowns![v.planet.position_body, v.planet.pole_body, v.earth.azimuth, v.earth.elevation];
    let sun = knowns![sun, v.keep_in.margin];
    let seen = knowns![&v.attitude, sun, others, v.sunshade.polynomial_valid, &v.panel, &v.downlink];
    let sensed = knowns![&v.estimate, v.sun.sensed, v.sun.sensed_valid, &v.control];
    let loads = knowns![&v.torque, &v.force, &v.plate, v.acceleration, v.delta_v, v.accelerometer.delta_v];
    let spent = knowns![v.mass, v.propellant_used, &v.tank, v.center_of_mass, &v.dump];
    let moved = knowns![&v.momentum, &v.wheel, &v.thrust, &v.thruster, &v.flexible_mode, &v.slosh];
    knowns![seen, sensed, loads, spent, moved]
}

/// Inputs by what they act on directly, over the values of `attitude.source` and `command.source` that are open.
struct Inputs {
    /// Positions of spacecraft, Sun and Earth.
    places: Knowns,
    /// How the spacecraft is turned. A body that moves by torque follows the places where the flight begins, and the angles of
    /// panels that have a mass.
    attitude: Knowns,
    /// Dumps of an ideal flight, which take the momentum at once.
    dumped_at_once: Knowns,
    /// Air and magnetic field as they are given.
    environment: Knowns,
    /// Failures of sensors and wheels.
    failures: Knowns,
    /// Commands of thrusters, wheels and panels.
    commanded: Knowns,
    /// Inputs by which a turn by torque is foreseen where a flight begins.
    foreseen: Knowns,
}

impl Inputs {
    fn new(setup: &PlantSetup, choice: OpenChoices, v: &PlantVariables) -> Self {
        // A maneuver puts it on another orbit at once.
        let maneuver = knowns![&v.maneuver].only_if(choice.ideal);
        let places = knowns![v.orbit.position, v.orbit.velocity, &v.sun, &v.earth, &maneuver];
        let panels_weigh = setup.spacecraft.panels.iter().any(|panel| panel.mass.is_some());
        // The Sun's place in a downlink follows the momentum, and that the dump.
        let environment = knowns![&v.atmosphere, &v.magnetic_field];
        let guided = knowns![&v.panel, &v.dump, &v.downlink, &environment].only_if(choice.guided);
        let commanded = knowns![&v.command].only_if(choice.ideal || choice.waits);
        let attitude = knowns![&places, guided, commanded, knowns![&v.panel].only_if(panels_weigh)];
        let sensors = v.sun_sensor.iter().map(|sensor| sensor.failed).collect::<Knowns>();
        let wheels = v.wheel.iter().map(|wheel| wheel.failed).collect::<Knowns>();
        let commanding =
            knowns![&v.command, &v.dump, &v.maneuver, &v.thrust, &v.thruster, &v.wheel, &v.panel];
        let failures =
            knowns![v.star_tracker.failed, v.star_tracker.spare_failed, v.gyro.failed, sensors, wheels];
        let applied = knowns![v.torque.applied, v.force.applied];
        Self {
            foreseen: knowns![&commanding, &failures, applied].only_if(choice.by_torque),
            places,
            environment,
            attitude,
            dumped_at_once: knowns![&v.dump, maneuver].only_if(choice.ideal),
            failures,
            commanded: commanding,
        }
    }
}

/// Parameters by section, over the same values.
struct Parameters {
    orbit: Knowns,
    attitude: Knowns,
    sensors: Knowns,
    light: Knowns,
    momentum: Knowns,
    actuators: Knowns,
}

impl Parameters {
    fn new(choice: OpenChoices, v: &PlantVariables) -> Self {
        // A maneuver of the timeline at the start puts it on another orbit.
        let maneuver = knowns![&v.timeline, &v.maneuver, v.noise_seed].only_if(choice.ideal);
        let between = knowns![&v.encounter, maneuver];
        let bodies = knowns![&v.planet, v.ephemeris_source, &v.ephemeris, v.sun.radius, &v.eclipse];
        let orbit = knowns![&v.start, &v.orbit, bodies, between];
        let wheels =
            v.wheel.iter().map(|wheel| knowns![wheel.axis, wheel.bias_momentum, wheel.start_momentum]);
        // Guidance balances torques against the momentum.
        let air = &knowns![&v.atmosphere, &v.space_weather, &v.magnetic_field, v.earth.ut1_offset];
        let balanced = knowns![air, &v.laws, &v.solar, v.optics.light(), &v.spacecraft];
        let solution = &knowns![balanced, &v.guided, &v.momentum, wheels.collect::<Knowns>()];
        let panels = knowns![&v.panel, v.articulation.target_suns];
        let followed = knowns![&v.attitude, &v.command, &v.timeline, &v.keep_in];
        let turned = knowns![&orbit, followed, &v.sunshade, panels];
        let attitude = knowns![turned, solution.clone().only_if(choice.guided || choice.begins_guided)];
        let sensors = knowns![&v.star_tracker, &v.gyro, &v.sun_sensor, v.noise_seed, v.control.rate];
        // In controlled and free flight they are fitted along the turn ahead, by the torque that is foreseen.
        let turning = knowns![&sensors, &v.control, &v.wheel, &v.thruster, &v.thrust, &v.dump];
        let turning = turning.only_if(choice.by_torque);
        let effects = knowns![&v.planet_light, &v.thermal, v.thermal_storage, &v.shadowing, &v.laws, air];
        let body = knowns![&v.optics, &v.spacecraft, &v.tank];
        let light = knowns![&attitude, turning, effects, body, &v.solver, &v.solar];
        let momentum = knowns![&attitude, solution, &v.dump];
        Self {
            // A dump at once takes propellant, which moves the centre of mass, and may move it at random.
            light: knowns![light, knowns![&momentum, &v.thruster, v.noise_seed].only_if(choice.ideal)],
            actuators: knowns![&momentum, &sensors, &v.control, &v.wheel, &v.thruster, &v.tank, &v.thrust],
            sensors: knowns![&attitude, sensors],
            orbit,
            attitude,
            momentum,
        }
    }
}

/// Orbit and attitude, directions of Sun, planet and Earth, and the sensors' readings.
fn motion(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, parameters: &Parameters) {
    table.output(v.epoch, knowns![], v.start.epoch);
    let sun = knowns![v.sun.position_inertial, v.sun.velocity_inertial, v.sun.distance, v.sun.lit_fraction];
    let earth = knowns![v.earth.position_inertial, v.earth.velocity_inertial];
    let orbit = knowns![v.position, v.velocity, v.heliocentric_position, v.orbit.time_since_periapsis];
    let between = knowns![v.orbit.current_center, &v.encounter, &v.osculating, v.sun.beta];
    table.output(knowns![sun, earth, orbit, between], &inputs.places, &parameters.orbit);
    predicted(table, v, inputs, parameters);
    let orientation = knowns![&parameters.orbit, v.earth.ut1_offset];
    table.output(&v.geodetic, &inputs.places, &orientation);
    let air = knowns![v.atmosphere.density, v.atmosphere.temperature, v.atmosphere.molar_mass];
    let of_places = knowns![&inputs.places, &inputs.environment];
    let models = knowns![orientation, &v.laws, &v.atmosphere, &v.space_weather, &v.magnetic_field];
    table.output(knowns![air, v.magnetic_field.inertial], of_places, &models);
    let turned = knowns![&inputs.attitude, &inputs.environment];
    let relative = knowns![v.atmosphere.velocity_body, v.magnetic_field.body];
    let models = knowns![models, &parameters.attitude];
    table.output(relative, turned, &models);
    table.output(v.planet.pole_body, &inputs.attitude, &models);
    let sun = knowns![v.sun.direction, v.sun.azimuth, v.sun.elevation, v.sun.position_body];
    let others = knowns![v.planet.position_body, v.earth.azimuth, v.earth.elevation, v.keep_in.margin];
    let seen = knowns![v.attitude.q, v.attitude.rate, sun, others, v.sunshade.polynomial_valid];
    let seen = knowns![seen, v.guided_degenerate, &v.downlink, &v.timeline];
    table.output(seen, &inputs.attitude, &parameters.attitude);
    // How the panels stand, and to the corridor.
    let stood = knowns![&parameters.attitude, &v.articulation];
    table.output(&v.panel, knowns![&inputs.attitude, &v.panel], stood);
    let sensed = knowns![&v.estimate, v.sun.sensed, v.sun.sensed_valid];
    table.output(sensed, knowns![&inputs.attitude, &inputs.failures], &parameters.sensors);
}

/// Predictions of the encounter, made where a step begins: by all that moves the spacecraft from there on.
fn predicted(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, parameters: &Parameters) {
    let pushed = knowns![&inputs.dumped_at_once, &v.panel, &v.downlink, v.force.applied];
    let turned = knowns![&inputs.attitude, &inputs.commanded, &inputs.failures];
    let ahead = knowns![&v.prediction, &parameters.light, &parameters.actuators];
    table.output(&v.prediction, knowns![pushed, turned], ahead);
}

/// Forces and torques by source, their sums, and those of single faces.
fn loads(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, parameters: &Parameters) {
    let lit = &knowns![&inputs.attitude, &inputs.dumped_at_once, &v.panel, &inputs.environment];
    let by_source = knowns![&v.torque.by_source, &v.force.by_source, &v.plate];
    table.output(&by_source, lit, &parameters.light);
    table.begins(by_source, &inputs.foreseen);
    // What swings does so under all forces.
    let rows = v.torque.by_source.iter().filter(|(effect, _)| effect.is_by_moving_parts());
    let moving = rows.map(|(_, output)| output).collect::<Knowns>();
    let total = knowns![v.torque.total, v.force.total, v.force.inertial, v.acceleration, moving];
    let applied = knowns![v.torque.applied, v.force.applied];
    let acting = knowns![lit, applied, &inputs.commanded, &inputs.failures];
    table.output(total, acting, knowns![&parameters.light, &parameters.actuators]);
    let shape = knowns![v.spacecraft.center_of_mass, v.sunshade.shape, v.optics.light()];
    table.calculated(v.sunshade.coefficient, shape);
}

/// System momentum, dumps, and the propellant of dumps.
fn momentum(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, parameters: &Parameters) {
    let momentum = &parameters.momentum;
    let dumped = &knowns![&inputs.attitude, &inputs.dumped_at_once];
    table.output(knowns![v.momentum.body, v.momentum.inertial], dumped, momentum);
    let biases = v.wheel.iter().map(|wheel| knowns![wheel.axis, wheel.bias_momentum]).collect::<Knowns>();
    table.output(v.momentum.bias, knowns![], biases);
    table.output(v.momentum.unheld, dumped, knowns![momentum, &v.wheel]);
    // They count from the last dump on.
    table.output(&v.momentum.by_source, knowns![dumped, &v.dump, v.torque.applied], momentum);
    let target = knowns![&inputs.attitude, &v.panel, &v.dump];
    table.output(knowns![v.momentum.target_clamped], &target, momentum);
    let spent = knowns![v.mass, v.propellant_used, &v.tank, v.center_of_mass];
    let moved = knowns![v.delta_v, v.accelerometer.delta_v];
    table.output(knowns![spent, moved], dumped, &parameters.actuators);
    table.output(&v.dump, target, &parameters.actuators);
    let executed = knowns![&v.maneuver, v.noise_seed, &v.timeline, &v.start];
    table.output(&v.maneuver, knowns![&inputs.attitude, &v.maneuver], executed);
    table.calculated(v.dump.guaranteed_threshold, &v.wheel);
}

/// Wheels, thrusters and the controller that drives them; flexible modes and propellant start at rest.
fn actuators(table: &mut Dependencies, v: &PlantVariables, inputs: &Inputs, parameters: &Parameters) {
    let all = &knowns![&inputs.attitude, &inputs.commanded, &inputs.failures];
    let fired = knowns![v.thrust.active, &v.thruster, v.torque.thruster, v.force.thruster];
    table.output(knowns![fired, &v.control], all, &parameters.actuators);
    for wheel in &v.wheel {
        // What acts on the body reaches the wheels that follow ideally or stand at their capacity.
        let applied = knowns![v.torque.applied, v.force.applied, &inputs.environment];
        let driven = knowns![all, &v.panel, &inputs.dumped_at_once, applied];
        let at_start = knowns![&parameters.light, &parameters.actuators];
        table.output(knowns![wheel.torque, wheel.power], driven, at_start);
        // Ideal wheels hold what is left of the momentum.
        let held = knowns![wheel.momentum, wheel.speed, wheel.saturated];
        let dumped = knowns![&inputs.attitude, &inputs.dumped_at_once];
        table.output(held, dumped, knowns![&parameters.momentum, &v.wheel]);
    }
    table.output(knowns![&v.flexible_mode, &v.slosh], &inputs.attitude, knowns![]);
}
