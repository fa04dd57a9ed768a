//! `Guidance`: commanded attitude and rate by the pointing options of paper 001, with scans, constraints and safe modes.

mod dependencies;
mod inputs;
mod outputs;
mod setup;
mod state;
mod variables;

use fmi_export::{
    About, Dependencies, Extensions, Failure, InputsOverTime, Manual, Model, OutputRates, Real, SetupError,
    StartValue, Step, StepEnd, Values,
};
use physics::environment::coarse_ephemeris::CoarseEphemeris;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::time;
use physics::guidance::burn::delta_v::{BurnPhase, BurnState};
use physics::guidance::modes::system::{
    GuidanceSettings, GuidanceState, SAMPLE_WORK, SampleInputs, TimedEntries,
};
use physics::management::{DumpRequests, SampledManager};
use physics::numerics::work::Work;

use crate::common::ephemeris::{self, EPHEMERIS_FILE};
use inputs::{Fixed, Reader, management};
pub use setup::Guidance;
use setup::{GuidanceSetup, Plan};
use state::State;
use variables::GuidanceVariables;

impl Model for Guidance {
    const NAME: &'static str = "Guidance";
    const STATE_VERSION: u32 = 5;
    const SETUP_FILE: Option<&'static str> = Some("spacecraft.toml");
    const SCHEDULE_FILES: &'static [&'static str] = &["timeline.toml", EPHEMERIS_FILE];
    const DEFAULT_SETUP: &'static str = include_str!("../../../resources/messenger.toml");
    const REFERENCE_INPUTS: &'static str = include_str!("../../../resources/reference/Guidance.csv");
    const MANUAL: Manual = crate::manuals::GUIDANCE;
    const EXTENSIONS: Extensions<Self> = Extensions::none().output_rates();

    type Setup = GuidanceSetup;
    type Variables = GuidanceVariables;
    type State = State;

    fn parse_setup(file: &str, text: &str) -> Result<GuidanceSetup, SetupError> {
        GuidanceSetup::from_toml(file, text)
    }

    fn parse_schedule(
        setup: &mut GuidanceSetup,
        schedule: &str,
        file: &str,
        text: &str,
    ) -> Result<(), SetupError> {
        if schedule == EPHEMERIS_FILE {
            setup.ephemeris = Some(ephemeris::read(file, text)?);
            return Ok(());
        }
        setup.take_timeline(file, text)
    }

    fn start_values(setup: &GuidanceSetup) -> Vec<StartValue> {
        crate::common::start_values::start_values(&setup.spacecraft.start)
    }

    fn about(setup: &GuidanceSetup) -> About {
        About {
            description: format!(
                "{}: commanded attitude and rate, once a second and propagated between: pointing options, scenarios, scans, \
                 Sun keep-in and hot-pole constraints, downlink, safe modes",
                setup.spacecraft.name
            ),
            start_time_s: 0.0,
            stop_time_s: 86_400.0,
            step_size_s: 1.0,
            tolerance: 1e-12,
            ..crate::common::about()
        }
    }

    fn dependencies(setup: &GuidanceSetup, variables: &GuidanceVariables) -> Dependencies {
        dependencies::table(setup, variables)
    }

    /// The sample at the start; the first step takes it again with its own inputs.
    fn initialize(context: &Plan<'_>, values: &mut Values, start_s: f64) -> Result<State, Failure> {
        let epoch_s = values.real(context.variables.start.epoch);
        let mut state = State {
            system: GuidanceState::new(inputs::start_attitude(context, values)?, start_s),
            dumps: DumpRequests::default(),
            time_s: start_s,
            epoch_minus_time_s: time::epoch_minus_time_s(epoch_s, start_s),
            warned_unconnected: false,
            ephemeris: Ephemeris::default(),
            coarse: CoarseEphemeris::default(),
            fixed: None,
        };
        // Masters that connect inputs one by one look before all of them are set: the first step says what is missing.
        let mut shown = State { warned_unconnected: true, ..state.clone() };
        let mut fixed = Fixed::read(context, values)?;
        management::set_panels(context, values, &mut fixed.panels);
        let settings = inputs::settings(context, values, &fixed)?;
        shown.sample(context, values, &fixed, &settings, InputsOverTime::held())?;
        state.ephemeris = shown.ephemeris.clone();
        state.coarse = shown.coarse.clone();
        outputs::write(context, values, &shown, &fixed.burn, epoch_s);
        state.fixed = Some(fixed);
        Ok(state)
    }

    fn step(
        context: &Plan<'_>,
        values: &mut Values,
        state: &mut State,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        let mut fixed = state.fixed.take().map_or_else(|| Fixed::read(context, values), Ok)?;
        management::set_panels(context, values, &mut fixed.panels);
        let settings = inputs::settings(context, values, &fixed)?;
        let limit = context.variables.solver.units(values);
        let mut work = Work::<1>::new(limit);
        while state.system.due_before(step.end_s).is_some() {
            work.spend(0, SAMPLE_WORK);
            if work.is_exhausted() {
                let reached_s = state.system.next_sample_s();
                return Err(Failure::new(format!(
                    "the step from {} to {} s reached {reached_s} s: its samples, one a second, take more than \
                     solver.workLimit = {limit} units",
                    step.start_s, step.end_s
                )));
            }
            let burn = *state.system.burn();
            work.spend(0, state.sample(context, values, &fixed, &settings, step.inputs)?);
            warn_of_missed_burn(context, &burn, state.system.burn());
        }
        let epoch_s = time::epoch_at_s(step.end_s, state.epoch_minus_time_s);
        state.time_s = step.end_s;
        outputs::write(context, values, state, &fixed.burn, epoch_s);
        state.fixed = Some(fixed);
        Ok(StepEnd::at(step.end_s))
    }

    fn settle_parameters(context: &Plan<'_>, values: &mut Values) {
        inputs::settle(context, values);
    }

    fn check_state(_setup: &GuidanceSetup, state: &State) -> Result<(), Failure> {
        if state.system.is_valid() {
            return Ok(());
        }
        Err(Failure::new("the saved state holds a direction or an attitude that is none"))
    }

    fn check_time(state: &State, time_s: f64) -> Result<(), Failure> {
        if state.time_s == time_s && state.system.covers(time_s) {
            return Ok(());
        }
        Err(Failure::new(format!("the next sample is due elsewhere than after {time_s:?} s")))
    }
}

/// Warns where the burn is missed at this sample and was not at the one before.
fn warn_of_missed_burn(context: &Plan<'_>, before: &BurnState, now: &BurnState) {
    match (before.phase(), now.phase()) {
        (BurnPhase::Waiting { refused: true, .. }, BurnPhase::Waiting { .. }) => {}
        (_, BurnPhase::Waiting { refused: true, .. }) => context.log.warning(
            "burn.timedOut: the burn is due and does not begin: the constraints keep its thrust off the aim, or burn.deltaV and \
             burn.profile give it no direction; it waits for burn.timeout at most",
        ),
        (BurnPhase::None | BurnPhase::Waiting { .. }, BurnPhase::Ended { timed_out: true }) => context.log.warning(
            "burn.timedOut: the burn ended before it began, by another scenario or mode or after waiting for burn.timeout",
        ),
        _ => {}
    }
}

impl OutputRates for Guidance {
    fn output_rate(context: &Plan<'_>, _values: &Values, state: &State, output: Real) -> Option<f64> {
        outputs::derivative(context, &state.system, state.time_s, output)
    }
}

impl State {
    /// Takes the sample that is due; units of work that it took beside its own.
    fn sample(
        &mut self,
        context: &Plan<'_>,
        values: &Values,
        fixed: &Fixed,
        settings: &GuidanceSettings<'_>,
        inputs: InputsOverTime<'_>,
    ) -> Result<u32, Failure> {
        let time_s = self.system.next_sample_s();
        let epoch_s = time::epoch_at_s(time_s, self.epoch_minus_time_s);
        let reader = Reader::new(context, values, inputs, time_s);
        let entry = context.setup.timeline.as_ref().and_then(|timeline| timeline.entry_at(time_s, epoch_s));
        let mut settings = *settings;
        let given = reader.command();
        let mut command = given;
        if let Some(entry) = entry {
            command = command.over(&entry.command);
            let operational = &mut settings.modes.operational;
            operational.keep_in = entry.keep_in.applied(&settings.keep_in, operational.keep_in.is_some());
        }
        let line = entry.map(|entry| entry.line);
        let names_a_scenario = entry.is_some_and(|entry| entry.command.scenario.is_some());
        let entries = TimedEntries {
            scan: line.filter(|_| given.scan.frame.is_none()),
            scenario: line.filter(|_| given.scenario.is_none() && names_a_scenario),
            mode: line.filter(|_| !reader.asks_for_a_mode()),
        };
        let command = self.system.continued(&command);
        let places = reader.places(fixed, &command, (&mut self.ephemeris, &mut self.coarse), epoch_s);
        if !places.are_known() && !self.warned_unconnected {
            self.warned_unconnected = true;
            context.log.warning(
                "position, or with ephemeris.source inputs sun.position or earth.position, is all zero and counts as not \
                 connected yet: the last command stays until then",
            );
        }
        let commanded = self.system.command().attitude_at(time_s);
        let (mut sensed, is_estimated) = reader.sensed(commanded, places.are_known())?;
        if !is_estimated {
            settings.modes.monitor = None;
            settings.modes.ephemeris_check = None;
        }
        sensed.request = sensed.request.or(entry.and_then(|entry| entry.mode));
        let delta_v_body_m_s = reader.delta_v_body_m_s();
        let momentum_body_n_m_s = reader.momentum_body_n_m_s();
        self.dumps.sample(&management::policy(context, values), &momentum_body_n_m_s);
        let keep_in = settings.modes.operational.keep_in.unwrap_or(settings.keep_in);
        let manager = management::manager(context, values, &fixed.panels, &keep_in)?;
        let manager = SampledManager { momentum_body_n_m_s, ..manager };
        let inputs = SampleInputs { command, entries, places, sensed, delta_v_body_m_s };
        let is_chosen = self.system.sample(&settings, &inputs, |start| manager.choose(start));
        Ok(if is_chosen { manager.work(settings.orbit_phase.science.unloads()) } else { 0 })
    }
}
