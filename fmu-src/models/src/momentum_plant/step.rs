//! A flight of the model begins, steps, and waits for inputs that are not set yet.

use fmi_export::{DeferredOutputs, Failure, InputsOverTime, OutputGroups, Step, Values};
use physics::numerics::Span;
use physics::plant::{NEVER_DUMPED_N_M_S, Undo};

use super::inputs::{self, Reading, Reconfigured, guidance, plausibility, propulsion};
use super::outputs;
use super::outputs::messages::{failure, log_event};
use super::setup::{MomentumPlant, Plan, Read};
use super::state::{PlantState, SavedState};
use crate::common::management::window_warning;

/// One call of the model.
pub(super) struct Call<'c, 'a> {
    pub context: &'c Plan<'a>,
    pub values: &'c mut Values,
    pub state: &'c mut PlantState,
}

impl<'a> Call<'_, 'a> {
    /// The flight begins at `time_s`, or waits.
    pub(super) fn start(mut self, time_s: f64) -> Result<(), Failure> {
        let inputs = InputsOverTime::held();
        let start = Step { start_s: time_s, end_s: time_s, changed: true, parameters_changed: true, inputs };
        let reading = inputs::read(self.context, self.values, self.state, &start)?;
        self.configure(&reading, &start)?;
        // Samples at the start are taken anew by the first step, with its inputs.
        let undo = if reading.begins { Some(self.begin(&reading, time_s)?) } else { None };
        self.evaluate(&reading, time_s)?;
        MomentumPlant::write_outputs(self.context, self.values, self.state, OutputGroups::ALL, time_s)?;
        if let Some(undo) = undo {
            self.state.saved.flight.undo(undo);
        }
        Ok(())
    }

    /// One step: what is set, the flight on to the step's end, outputs.
    pub(super) fn step(mut self, step: &Step<'a>) -> Result<(), Failure> {
        let reading = inputs::read(self.context, self.values, self.state, step)?;
        self.state.warn_unset_inputs(self.context);
        self.state.warn_command_norm(self.context, step.start_s);
        self.configure(&reading, step)?;
        if reading.begins {
            let undo = self.begin(&reading, step.start_s)?;
            self.state.saved.flight.undo(undo);
        }
        if !self.state.saved.waiting {
            self.advance(&reading, step)?;
        }
        self.evaluate(&reading, step.end_s)
    }

    /// The flight takes what was read, from the step's start on.
    fn configure(&mut self, reading: &Reading<'_>, step: &Step<'_>) -> Result<(), Failure> {
        let Self { context, values, state } = self;
        let read = Read::new(context, values);
        let (mut configuration, mut settings) = (None, None);
        if reading.is_reconfigured {
            match inputs::configured(read, state, step.inputs, reading)? {
                Reconfigured::Simulation(simulation, settings) => {
                    state.saved.flight.configure(*simulation, settings)
                }
                Reconfigured::Changed(changed, with) => (configuration, settings) = (Some(changed), with),
            }
        }
        state.pass_digest();
        if reading.is_set && !state.saved.waiting && !reading.begins {
            state.saved.flight.apply(configuration, settings, step.start_s).map_err(failure)?;
            if state.inputs.orbit_moves {
                state.saved.flight.move_to(step.start_s).map_err(failure)?;
            }
        }
        // After what was computed ahead with those before is void.
        if reading.is_reconfigured { inputs::update_materials(read, state) } else { Ok(()) }
    }

    /// The flight begins at `time_s`, where a first sample is taken: how to undo that.
    fn begin(&mut self, reading: &Reading<'_>, time_s: f64) -> Result<Undo, Failure> {
        let Self { context, values, state } = self;
        let read = Read::new(context, values);
        propulsion::check(&state.saved.flight)?;
        let guided = state.saved.flight.configuration().and_then(|it| it.attitude.guided());
        if let Some(warning) = guided.and_then(|law| window_warning(&law.schedule)) {
            context.log.warning(&warning);
        }
        if state.inputs.source.is_dynamic {
            guidance::report_start(read, state, time_s);
        }
        report_dumps(context, state, time_s);
        let log = |event: &_| log_event(context, event);
        reading.with(&state.inputs.dynamics, &log, |given| {
            state.saved.flight.begin(given, &state.saved.command, time_s).map_err(failure)
        })?;
        if let Some(estimate) = state.saved.flight.estimate_at(time_s) {
            state.start_command(estimate.attitude, time_s)?;
        }
        let PlantState { saved: SavedState { flight, command, .. }, inputs } = state;
        reading.with(&inputs.dynamics, &log, |given| {
            plausibility::report(read, flight, given, time_s);
            let undo = flight.sample_at_start(given, time_s).map_err(failure)?;
            let reached = flight.evaluate(given, command, true, time_s).map_err(failure)?;
            outputs::check(flight, &reached, time_s)?;
            Ok(undo)
        })
    }

    /// The flight continues to the step's end.
    fn advance(&mut self, reading: &Reading<'_>, step: &Step<'_>) -> Result<(), Failure> {
        let PlantState { saved: SavedState { flight, request, maneuver_request, warned, .. }, inputs } =
            self.state;
        if let Some(flown) = flight.context() {
            let settings = &flown.allocator.settings;
            propulsion::warn(self.context, &inputs.dynamics, settings, &mut warned.thrusters, step);
        }
        let (is_requested, target_body_n_m_s) = inputs.dump;
        inputs.dynamics.dump_to_body_n_m_s = request.rises(is_requested).then_some(target_body_n_m_s);
        let (is_requested, maneuver) = inputs.maneuver;
        inputs.dynamics.maneuver = maneuver_request.rises(is_requested).then_some(maneuver);
        propulsion::drop_empty_maneuver(self.context, &mut inputs.dynamics, step.start_s);
        reading.with(&inputs.dynamics, &|event| log_event(self.context, event), |given| {
            flight.advance(given, Span::new(step.start_s, step.end_s)).map_err(failure)
        })
    }

    /// Evaluates the flight at `time_s`, where every output belongs to, and judges it; writes what follows from the configuration.
    fn evaluate(&mut self, reading: &Reading<'_>, time_s: f64) -> Result<(), Failure> {
        let Self { context, values, state } = self;
        let PlantState { saved: SavedState { flight, command, waiting, warned, .. }, inputs } = state;
        let with_loads = warned.watch.looks_at_forces(flight.configuration(), time_s);
        let reached = reading.with(&inputs.dynamics, &|_| {}, |given| {
            flight.evaluate(given, command, with_loads, time_s).map_err(failure)
        })?;
        if !*waiting {
            outputs::check(flight, &reached, time_s)?;
        }
        propulsion::warn_unserved(context, flight, &mut warned.thrusters, time_s);
        guidance::warn_degenerate(context, &reached, &mut warned.degenerate, time_s);
        let spacecraft = &context.setup.spacecraft;
        warned.watch.see((flight, time_s), spacecraft, |text| context.log.warning(text));
        if reading.is_reconfigured {
            outputs::write_polynomial(context, values, flight);
        }
        Ok(())
    }
}

/// Reports where no dump comes, and dumps that cost nothing.
fn report_dumps(context: &Plan<'_>, state: &PlantState, time_s: f64) {
    let Some(configuration) = state.saved.flight.configuration().filter(|_| context.log.events_enabled())
    else {
        return;
    };
    let policy = &configuration.momentum.policy;
    if policy.begins_none() {
        let reported = "dump.threshold is not set: in free flight dumps come on dump.request alone";
        return context.log.event(time_s, reported);
    }
    let axes = ["X", "Y", "Z"].into_iter().zip(&policy.threshold_body_n_m_s);
    let never = axes.filter(|(_, threshold)| **threshold >= NEVER_DUMPED_N_M_S).map(|(name, _)| name);
    let never: Vec<&str> = never.collect();
    if !never.is_empty() {
        context.log.event(
            time_s,
            &format!(
                "dump.threshold about {} is {NEVER_DUMPED_N_M_S:e} N.m.s: thrusters never dump what gathers there; by default \
                 where no wheels hold momentum",
                never.join(", ")
            ),
        );
    }
    if never.len() < 3 && context.setup.spacecraft.thrusters.is_empty() {
        let how = match state.inputs.source.is_dynamic {
            true => "by the constant dump.torque",
            false => "ideal: at once",
        };
        context.log.event(
            time_s,
            &format!(
                "dumps are {how} and without propellant, as the spacecraft has no thrusters ([[thrusters]])"
            ),
        );
    }
}
