//! `Guidance`: commanded attitude and rate by the pointing options of paper 001, with scans, constraints and safe modes.

mod dependencies;
mod inputs;
mod outputs;
mod setup;
mod state;
mod variables;

use fmi_export::{
    About, Dependencies, Extensions, Failure, InputsOverTime, Manual, Model, SetupError, StartValue, Step,
    StepEnd, Values,
};
use physics::enumeration::Enumerated;
use physics::environment::coarse_ephemeris::CoarseEphemeris;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::time;
use physics::guidance::burn::delta_v::{BurnPhase, BurnState, Interruption};
use physics::guidance::modes::mode::ModeReason;
use physics::guidance::modes::system::{GuidanceState, SAMPLE_WORK};
use physics::guidance::modes::transitions::ModeState;
use physics::management::DumpRequests;
use physics::numerics::work::Work;

use crate::common::downlink::TIMELINE_FILE;
use crate::common::ephemeris::{self, EPHEMERIS_FILE};
use crate::common::spacecraft::start_attitude;
use crate::common::start_values::of_spacecraft;
use inputs::Fixed;
use inputs::reader::Reader;
pub use setup::Guidance;
use setup::{GuidanceSetup, Plan, Read};
use state::State;
use variables::GuidanceVariables;

impl Model for Guidance {
    const NAME: &'static str = "Guidance";
    const STATE_VERSION: u32 = 11;
    const SETUP_FILE: Option<&'static str> = Some("spacecraft.toml");
    const SCHEDULE_FILES: &'static [&'static str] = &[TIMELINE_FILE, EPHEMERIS_FILE];
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
        setup.set_timeline(file, text)
    }

    fn start_values(setup: &GuidanceSetup) -> Vec<StartValue> {
        of_spacecraft(&setup.spacecraft, Self::NAME, Some(time::MOMENTUM_STUDY_START_S))
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
            system: GuidanceState::new(start_attitude(values, context.variables.start.q)?, start_s),
            dumps: DumpRequests::default(),
            events_until_s: start_s.next_down(),
            burn_entry: None,
            time_s: start_s,
            epoch_minus_time_s: time::epoch_minus_time_s(epoch_s, start_s),
            warned_unconnected: false,
            warned_roll: false,
            windows_are_checked: false,
            ephemeris: Ephemeris::with_cache(&context.setup.ephemeris_cache),
            coarse: CoarseEphemeris::default(),
            fixed: None,
        };
        // Masters that connect inputs one by one look before all of them are set: the first step says what is missing.
        let mut shown =
            State { warned_unconnected: true, warned_roll: true, windows_are_checked: true, ..state.clone() };
        let read = Read::new(context, values);
        let fixed = Fixed::current(None, read)?;
        let settings = inputs::settings(read, &fixed)?;
        shown.sample(read, &fixed, &settings, InputsOverTime::held())?;
        state.ephemeris = shown.ephemeris.clone();
        state.coarse = shown.coarse.clone();
        if !Reader::new(read, InputsOverTime::held(), start_s).has_estimate() {
            let message = "estimate.q is not set, or with estimate.valid to its start value: until it changes the commanded attitude \
                           stands in for it";
            context.log.event(start_s, message);
        }
        outputs::write(context, values, &shown, &fixed, epoch_s);
        state.fixed = Some(fixed);
        Ok(state)
    }

    fn step(
        context: &Plan<'_>,
        values: &mut Values,
        state: &mut State,
        step: &Step<'_>,
    ) -> Result<StepEnd, Failure> {
        let read = Read::new(context, values);
        let fixed = Fixed::current(state.fixed.take(), read)?;
        let settings = inputs::settings(read, &fixed)?;
        let limit = context.variables.solver.units(values);
        let mut work = Work::<1>::new(limit);
        let mut requested_s = None;
        while state.system.due_before(step.end_s).is_some() {
            if let Some(requested_s) = requested_s {
                context.log.warning(&format!(
                    "dump.request was true from {requested_s} to {} s, within a step to {} s, and no communication point saw it: \
                     step by a second at most",
                    state.system.next_sample_s,
                    step.end_s
                ));
            }
            work.spend(0, SAMPLE_WORK);
            if work.is_exhausted() {
                let reached_s = state.system.next_sample_s;
                return Err(Failure::new(format!(
                    "the step from {} to {} s reached {reached_s} s: its samples, one a second, take more than \
                     solver.workLimit = {limit} units",
                    step.start_s, step.end_s
                )));
            }
            let (burn, sampled_s) = (state.system.burn, state.system.next_sample_s);
            let before = state.system.modes;
            work.spend(0, state.sample(read, &fixed, &settings, step.inputs)?);
            requested_s = Some(sampled_s).filter(|_| state.dumps.is_requested);
            warn_of_missed_burn(context, &burn, &state.system.burn, sampled_s);
            log_demotion(context, sampled_s, &before, &state.system.modes);
        }
        let epoch_s = time::epoch_at_s(step.end_s, state.epoch_minus_time_s);
        state.time_s = step.end_s;
        outputs::write(context, values, state, &fixed, epoch_s);
        state.fixed = Some(fixed);
        Ok(StepEnd::at(step.end_s))
    }

    fn resolve_parameters(context: &Plan<'_>, values: &mut Values) {
        inputs::resolve_start(context, values);
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

/// Reports why the mode fell at the sample, or what was lost beside: a request as an event, what comes by itself as a warning.
fn log_demotion(context: &Plan<'_>, sampled_s: f64, before: &ModeState, now: &ModeState) {
    let (mode, Some(reason)) = (now.mode, now.reason) else { return };
    let has_fallen = mode.value() > before.mode.value();
    let is_requested = matches!(reason, ModeReason::Request | ModeReason::Timeline);
    let is_lost = matches!(reason, ModeReason::AttitudeLost | ModeReason::SunLost);
    let is_lost_anew = is_lost && before.reason != Some(reason);
    if !has_fallen && !is_lost_anew {
        return;
    }
    let why = match reason {
        ModeReason::Request => "mode.request asked for it",
        ModeReason::Timeline => "the timeline asked for it",
        ModeReason::SunKeepIn => {
            "estimate.q has the Sun outside the keep-in zone (keepIn.*) by more than monitor.margin for monitor.persistence"
        }
        ModeReason::HotPole => {
            "estimate.q has -Z too near the planet over its hot pole (hotPole.*) by more than monitor.margin for \
             monitor.persistence"
        }
        ModeReason::AttitudeLost => "estimate.valid is false",
        ModeReason::SunLost => "estimate.valid and sun.sensedValid are false: the Sun is searched for",
        ModeReason::Ephemeris => {
            "the precise ephemerides contradict the Sun sensors by more than ephemeris.tolerance for \
             ephemeris.persistence, or do not reach this time"
        }
        ModeReason::NoProgress => {
            "the turn back within the constraints came no nearer to them for monitor.persistence"
        }
    };
    let (from, to, name) = (before.mode.name(), mode.name(), reason.name());
    let change = if has_fallen { format!("mode {from} -> {to}") } else { format!("mode {to} stays") };
    if is_requested {
        context.log.event(sampled_s, &format!("{change} (mode.reason {name}): {why}"));
    } else {
        context.log.warning(&format!("t = {sampled_s} s: {change} (mode.reason {name}): {why}"));
    }
}

/// Warns where the burn is missed at this sample and was not at the one before.
fn warn_of_missed_burn(context: &Plan<'_>, before: &BurnState, now: &BurnState, time_s: f64) {
    let is_anew = matches!(now.phase, BurnPhase::Waiting { .. } | BurnPhase::Burning { .. });
    match now.interruption {
        Some(Interruption::CutOff) => {
            let [x, y, z]: [f64; 3] = before.velocity_m_s.into();
            context.log.warning(&format!(
                "burn: cut off at {time_s} s by the end of its command, by another command or by another mode; until a second \
                 before, it had added ({x:.3}, {y:.3}, {z:.3}) m/s"
            ));
        }
        Some(Interruption::BeforeThrust) if is_anew => {
            context.log.warning("burn.timedOut: the burn ended before it began: another one was commanded");
        }
        _ => {}
    }
    match (before.phase, now.phase) {
        (BurnPhase::Waiting { refused: true, .. }, BurnPhase::Waiting { .. }) => {}
        (_, BurnPhase::Waiting { refused: true, .. }) => context.log.warning(
            "burn.timedOut: the burn is due and does not begin: the constraints keep its thrust off the aim, or burn.deltaV and \
             burn.profile give it no direction; it waits for burn.timeout at most, one with a table in a timeline until its command ends",
        ),
        (BurnPhase::None | BurnPhase::Waiting { .. }, BurnPhase::Ended { timed_out: true }) => context.log.warning(
            "burn.timedOut: the burn ended before it began, by another scenario or mode or after waiting for burn.timeout",
        ),
        _ => {}
    }
}
