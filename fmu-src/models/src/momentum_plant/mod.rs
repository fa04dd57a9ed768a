//! `MomentumPlant`: a three-axis spacecraft about a planet or the Sun, its disturbance torques by source and the
//! momentum they add up to.

mod dependencies;
mod inputs;
mod outputs;
mod setup;
mod state;
mod step;
mod variables;

use fmi_export::{
    About, Dependencies, Extensions, Failure, Manual, Model, Real, SetupError, StartValue, Step, StepEnd,
    Values, checksum,
};
use physics::environment::time;

use crate::common::downlink::TIMELINE_FILE;
use crate::common::ephemeris::{self, EPHEMERIS_FILE};
use crate::common::start_values::{entry_of, item, of_spacecraft};
use inputs::wheels;
pub use setup::{MomentumPlant, PlantSetup};
use setup::{Plan, Read};
use state::PlantState;
use step::Call;
use variables::PlantVariables;
use variables::choices::AttitudeSource;

impl Model for MomentumPlant {
    const NAME: &'static str = "MomentumPlant";
    const STATE_VERSION: u32 = 23;
    const SETUP_FILE: Option<&'static str> = Some("spacecraft.toml");
    const SCHEDULE_FILES: &'static [&'static str] = &[TIMELINE_FILE, EPHEMERIS_FILE];
    const DEFAULT_SETUP: &'static str = include_str!("../../../resources/messenger.toml");
    const REFERENCE_INPUTS: &'static str = include_str!("../../../resources/reference/MomentumPlant.csv");
    const MANUAL: Manual = crate::manuals::MOMENTUM_PLANT;
    const EXTENSIONS: Extensions<Self> = Extensions::none().output_rates().deferred_outputs();

    type Setup = PlantSetup;
    type Variables = PlantVariables;
    type State = PlantState;

    fn parse_setup(file: &str, text: &str) -> Result<PlantSetup, SetupError> {
        PlantSetup::from_toml(file, text)
    }

    fn parse_schedule(
        setup: &mut PlantSetup,
        schedule: &str,
        file: &str,
        text: &str,
    ) -> Result<(), SetupError> {
        setup.schedules = setup.schedules.rotate_left(1) ^ checksum(text.as_bytes());
        if schedule == EPHEMERIS_FILE {
            setup.ephemeris = Some(ephemeris::read(file, text)?);
            return Ok(());
        }
        setup.set_timeline(file, text)
    }

    fn start_values(setup: &PlantSetup) -> Vec<StartValue> {
        of_spacecraft(&setup.spacecraft, Self::NAME, Some(time::MOMENTUM_STUDY_START_S))
    }

    fn following_start_values(
        _setup: &PlantSetup,
        variables: &PlantVariables,
        start: &Values,
    ) -> Vec<StartValue> {
        inputs::plausibility::following_dynamics(variables, start).into_iter().collect()
    }

    fn about(setup: &PlantSetup) -> About {
        // 90 days of the momentum; dynamics are computed at 50 Hz.
        let (stop_time_s, step_size_s) =
            if starts_with_dynamics(setup) { (86_400.0, 1.0) } else { (7_776_000.0, 600.0) };
        About {
            description: format!(
                "{}: torque of solar radiation, planet light, thermal recoil, air, magnetic field and gravity gradient, \
                 system momentum and thruster dumps of a three-axis spacecraft about a planet or the Sun",
                setup.spacecraft.name
            ),
            start_time_s: 0.0,
            stop_time_s,
            step_size_s,
            tolerance: 1e-10,
            ..crate::common::about()
        }
    }

    fn dependencies(setup: &PlantSetup, variables: &PlantVariables) -> Dependencies {
        dependencies::table(setup, variables)
    }

    fn initialize(context: &Plan<'_>, values: &mut Values, start_s: f64) -> Result<PlantState, Failure> {
        let read = Read::new(context, values);
        inputs::check_effects(read, start_s)?;
        let mut state = inputs::start(read, start_s)?;
        let guaranteed_n_m_s = wheels::guaranteed_threshold_n_m_s(read);
        values.set_real(context.variables.dump.guaranteed_threshold, guaranteed_n_m_s);
        Call { context, values, state: &mut state }.start(start_s)?;
        Ok(state)
    }

    fn step(
        context: &Plan<'_>,
        values: &mut Values,
        state: &mut PlantState,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        inputs::check_span(Read::new(context, values), state, step.end_s)?;
        Call { context, values, state }.step(step)?;
        Ok(StepEnd::at(step.end_s))
    }

    fn resolve_parameters(context: &Plan<'_>, values: &mut Values) {
        inputs::resolve_start(context, values);
    }

    fn tolerance(variables: &PlantVariables) -> Option<Real> {
        Some(variables.solver.tolerance)
    }

    fn check_state(setup: &PlantSetup, state: &PlantState) -> Result<(), Failure> {
        state.check(&setup.spacecraft)
    }

    fn check_time(state: &PlantState, time_s: f64) -> Result<(), Failure> {
        match state.saved.flight.first_uncovered(time_s) {
            Some(what) => Err(Failure::new(format!("{what} elsewhere than at {time_s:?} s"))),
            None => Ok(()),
        }
    }
}

/// Whether the spacecraft's file asks for controlled or free flight.
fn starts_with_dynamics(setup: &PlantSetup) -> bool {
    let source = entry_of(&setup.spacecraft.start, MomentumPlant::NAME, "attitude.source");
    let source = source.and_then(|entry| item(&entry.value));
    matches!(source, Some(AttitudeSource::Controlled | AttitudeSource::Free))
}
