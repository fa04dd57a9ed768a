//! `SpinPlant`: a spin-stabilised spacecraft (ACE), its thruster pulses with exact edges, nutation and its damper, burn
//! sequencing and sensors.

mod dependencies;
mod inputs;
mod outputs;
mod setup;
mod variables;

use fmi_export::{
    About, Dependencies, Extensions, Failure, Manual, Model, SetupError, StartValue, Step, StepEnd, Values,
};
use nalgebra::Vector3;
use physics::spin::{
    plant::{Directions, Plant, Predictions},
    spinner::Spinner,
};

use crate::common::start_values::start_values;
use setup::Plan;
pub use setup::SpinPlant;
use variables::SpinVariables;

impl Model for SpinPlant {
    const NAME: &'static str = "SpinPlant";
    const STATE_VERSION: u32 = 7;
    const SETUP_FILE: Option<&'static str> = Some("spacecraft.toml");
    const DEFAULT_SETUP: &'static str = include_str!("../../../resources/ace.toml");
    const REFERENCE_INPUTS: &'static str = include_str!("../../../resources/reference/SpinPlant.csv");
    const MANUAL: Manual = crate::manuals::SPIN_PLANT;
    const EXTENSIONS: Extensions<Self> = Extensions::none().output_rates();

    type Setup = Spinner;
    type Variables = SpinVariables;
    type State = Plant;

    fn parse_setup(file: &str, text: &str) -> Result<Spinner, SetupError> {
        Spinner::parse(file, text).map_err(|error| SetupError(error.to_string()))
    }

    fn start_values(setup: &Spinner) -> Vec<StartValue> {
        start_values(&setup.start, Self::NAME, None, false)
    }

    fn about(setup: &Spinner) -> About {
        About {
            description: format!(
                "{}: a spin-stabilised spacecraft with exact thruster pulses, nutation and its damper, burn sequencing, Sun \
                 and star sensing",
                setup.name
            ),
            start_time_s: 0.0,
            stop_time_s: 1400.0,
            step_size_s: 0.5,
            tolerance: 1e-12,
            ..crate::common::about()
        }
    }

    fn dependencies(setup: &Spinner, variables: &SpinVariables) -> Dependencies {
        dependencies::table(setup, variables)
    }

    fn initialize(context: &Plan<'_>, values: &mut Values, start_time_s: f64) -> Result<Plant, Failure> {
        let directions = inputs::directions(context, values, |handle| values.vector(handle))?;
        let start = inputs::start(context, values);
        let commands = inputs::commands(context, values);
        let plant = Plant::start(context.setup, &start, directions, commands, start_time_s)
            .map_err(|error| Failure::new(error.to_string()))?;
        warn_of_burn(context, &plant);
        warn_of_unknown(context, values, None, &directions);
        outputs::write_calculated(context, values, &plant);
        outputs::write(context, values, &plant);
        Ok(plant)
    }

    fn step(
        context: &Plan<'_>,
        values: &mut Values,
        plant: &mut Plant,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        if step.changed {
            let mut commands = inputs::commands(context, values);
            commands.torque = inputs::torque(context, values, step)?;
            // Directions that move within the step are taken where it ends: they are read, not integrated.
            let at_end = |handle| step.inputs.vector(values, handle, step.end_s);
            let cut = commands.cut_by(step.start_s, step.end_s);
            if let Some(thruster) = cut.and_then(|index| context.setup.thrusters.get(index)) {
                context.log.warning(&format!(
                    "a pulse of thruster {} reaches beyond the step from {} to {} s and is cut there",
                    thruster.name, step.start_s, step.end_s
                ));
            }
            let directions = inputs::directions(context, values, at_end)?;
            warn_of_unknown(context, values, Some(&plant.directions_at(step.start_s)), &directions);
            plant.command(commands, directions);
        }
        let (fired, log) = (plant.sequencer.as_ref().map_or(0, |s| s.fired), context.log);
        let had_propellant = !plant.propulsion.is_dry();
        plant.advance(context.setup, step.end_s).map_err(|error| Failure::new(error.to_string()))?;
        if had_propellant && plant.propulsion.is_dry() {
            log.warning(&format!(
                "the propellant ran out between {} and {} s: no thruster fires any more",
                step.start_s, step.end_s
            ));
        }
        if log.events_enabled()
            && let Some(sequencer) = plant.sequencer.as_ref().filter(|s| s.fired != fired)
        {
            let count = sequencer.burn.train.count;
            log.event(step.end_s, &format!("burn: {} of {count} pulses fired", sequencer.fired));
        }
        outputs::write(context, values, plant);
        Ok(StepEnd::at(step.end_s))
    }

    fn check_state(setup: &Spinner, state: &Plant) -> Result<(), Failure> {
        if state.fits(setup) {
            return Ok(());
        }
        Err(Failure::new(
            "the state does not belong to this spacecraft or its numbers do not belong together",
        ))
    }

    fn check_time(state: &Plant, time_s: f64) -> Result<(), Failure> {
        if state.time_s == time_s {
            return Ok(());
        }
        Err(Failure::new(format!("the state is one of {} s, not of {time_s} s", state.time_s)))
    }
}

/// Warns of a burn that can be simulated and will not do what one may expect.
fn warn_of_burn(context: &Plan<'_>, plant: &Plant) {
    let (log, seen) = (context.log, Predictions::from_plant(plant));
    if plant.propulsion.is_dry() {
        log.warning("there is no propellant (propellant.loaded): no thruster fires");
    }
    if let Some(apart_rad) = seen.passed_target_rad(plant) {
        log.warning(&format!(
            "the burn's {} pulses would move the momentum by {:.4} deg, but burn.targetDirection is {:.4} deg away, and \
             beyond it they take back what they did",
            seen.count,
            seen.manoeuvre_rad.to_degrees(),
            apart_rad.to_degrees()
        ));
    }
    if let Some(clearance_rad) = seen.too_close_to_sun_rad(plant) {
        log.warning(&format!(
            "the burn is timed by Sun crossings, and its way passes the Sun's line at {:.4} deg, where a crossing says \
             little: burn.timing 3 (true phase) or 1 (clock) does without",
            clearance_rad.to_degrees()
        ));
    }
}

/// Directions that became 0: masters send that before the first exchange.
fn warn_of_unknown(context: &Plan<'_>, values: &Values, before: Option<&Directions>, now: &Directions) {
    let from_inputs = inputs::takes_directions(context, values);
    let became_unknown = |before: Option<&Vector3<f64>>, now: &Vector3<f64>| {
        *now == Vector3::zeros() && before.is_none_or(|before| *before != Vector3::zeros())
    };
    let found = [
        ("sun.direction", from_inputs, before.map(|it| &it.sun_inertial), &now.sun_inertial),
        ("earth.direction", from_inputs, before.map(|it| &it.earth_inertial), &now.earth_inertial),
        ("star.direction", true, before.map(|it| &it.star_inertial), &now.star_inertial),
    ];
    let names: Vec<&str> = found
        .into_iter()
        .filter(|(_, used, before, now)| *used && became_unknown(*before, now))
        .map(|(name, ..)| name)
        .collect();
    if !names.is_empty() {
        context
            .log
            .warning(&format!("{} is 0: nothing is seen there until it has a direction", names.join(", ")));
    }
}
