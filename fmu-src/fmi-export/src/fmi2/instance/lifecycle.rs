//! Experiment, initialization, termination, reset, log settings.

use super::{Instance, once};
use crate::fmi2::access::SET_BY_IMPORTER;
use crate::fmi2::instance::state::{Experiment, InstanceState};
use crate::fmi2::problem::Problem;
use crate::fmi2::references;
use crate::logger::Category;
use crate::model::Log;
use crate::variables::{Real, Values};
use model_description::{BaseType, Status};

impl Instance {
    /// `fmi2SetDebugLogging`: `categories` gives each named category, or `None` where the name is unknown.
    pub(crate) fn set_debug_logging(
        &mut self,
        on: bool,
        count: usize,
        mut categories: impl FnMut(usize) -> Option<Category>,
    ) -> Result<(), Problem> {
        let known: Vec<Category> = (0..count).filter_map(&mut categories).collect();
        let unknown = (0..count).find(|&index| categories(index).is_none());
        // None named means all of them; none known is none.
        self.logger.enable(on && (count == 0 || !known.is_empty()), known);
        match unknown {
            None => Ok(()),
            Some(index) => {
                let (number, known) = (index + 1, Category::names());
                let text = format!("log category number {number} is not declared; known are {known}");
                Err(Problem { status: Status::Warning, text })
            }
        }
    }

    /// `fmi2SetupExperiment`.
    pub(crate) fn setup_experiment(&mut self, experiment: Experiment) -> Result<(), Problem> {
        let Experiment { start_s, stop_s, tolerance } = experiment;
        let usable = |tolerance: &f64| *tolerance > 0.0 && tolerance.is_finite();
        if !experiment.is_valid() {
            return Err(match stop_s {
                None => Problem::error(format_args!("the start time is {start_s:?} s, it must be finite")),
                Some(stop_s) => Problem::error(format_args!(
                    "the start time is {start_s:?} s and the stop time {stop_s:?} s: both must be finite, and the \
                     stop not before the start"
                )),
            });
        }
        if let Some(tolerance) = tolerance.filter(|tolerance| !usable(tolerance)) {
            self.logger.log(
                Status::Warning,
                format_args!(
                    "fmi2SetupExperiment: the tolerance {tolerance:?} is no positive number; ignored"
                ),
            );
        }
        self.state.experiment = Some(Experiment { tolerance: tolerance.filter(usable), ..experiment });
        Ok(())
    }

    /// `fmi2EnterInitializationMode`.
    pub(crate) fn enter_initialization_mode(&mut self) -> Result<(), Problem> {
        let experiment = self.state.experiment.ok_or_else(|| {
            Problem::error("fmi2SetupExperiment must be called before fmi2EnterInitializationMode")
        })?;
        self.state.time_s = experiment.start_s;
        self.set_tolerance(experiment.tolerance);
        self.state.needs_initialization = true;
        Ok(())
    }

    /// The tolerance of the experiment becomes the value of the model's parameter, unless the master set that: so it is
    /// read, saved and restored like any value.
    fn set_tolerance(&mut self, tolerance: Option<f64>) {
        let is_settable = |at: &Real| {
            let flags = self.access.flags_at(BaseType::Real, references::for_variable(*at));
            flags.is_some_and(|flags| flags & SET_BY_IMPORTER != 0)
        };
        let is_open = |at: &Real| !self.state.values.is_set(*at) && is_settable(at);
        let Some(at) = self.tolerance.filter(is_open) else { return };
        let default = self.start.real(at);
        let reference = references::for_variable(at);
        let (min, max) = self.access.limits_at(reference);
        let name = self.access.any_name(reference).unwrap_or_default();
        // Not `clamp`, which panics where the limits are no range.
        let taken = tolerance.map_or(default, |tolerance| tolerance.max(min).min(max));
        if let Some(tolerance) = tolerance.filter(|tolerance| *tolerance != taken) {
            self.logger.log(
                Status::Warning,
                format_args!(
                    "fmi2SetupExperiment: the tolerance {tolerance:?} is taken as {taken:?}, for `{name}` may be \
                     {min:?} to {max:?}"
                ),
            );
        }
        if taken != default {
            let message =
                format!("{name} = {taken:?}, the tolerance of fmi2SetupExperiment, as it is not set");
            self.logger.event(self.state.time_s, &message);
        }
        self.state.values.set_real(at, taken);
    }

    /// `fmi2ExitInitializationMode`.
    pub(crate) fn exit_initialization_mode(&mut self) -> Result<(), Problem> {
        self.initialize_if_needed()?;
        let before = self.logger.events_enabled().then(|| self.state.values.clone());
        self.runtime.resolve_parameters(&mut self.state.values, &self.logger);
        if let Some(before) = before {
            self.report_resolved(&before);
        }
        // No step has to bring them to their size.
        self.spare.clone_from(&self.state.values);
        Ok(())
    }

    /// Reports the parameters that the model resolved to others than their values before.
    fn report_resolved(&self, before: &Values) {
        let mut resolved = Vec::new();
        for base in BaseType::ALL {
            let places = 0..self.access.flags(base).len();
            for place in places.filter(|place| !self.state.values.is_same(before, base, *place)) {
                let name = self.access.name(base, references::first(base) + place as u32).unwrap_or_default();
                resolved.push(format!("{name} = {}", self.state.values.shown(base, place)));
            }
        }
        if !resolved.is_empty() {
            let message = format!(
                "parameters that follow others, as they are not set, or all of their group to their start values: {}",
                resolved.join(", ")
            );
            self.logger.event(self.state.time_s, &message);
        }
    }

    /// Computes the outputs of Initialization Mode from what was set so far.
    pub(super) fn initialize_if_needed(&mut self) -> Result<(), Problem> {
        if self.state.needs_initialization {
            self.runtime.initialize(&mut self.state.values, self.state.time_s, &self.logger)?;
            self.check_finite(true)?;
            self.state.needs_initialization = false;
        }
        Ok(())
    }

    /// `fmi2Reset`: as if freshly instantiated.
    pub(crate) fn reset(&mut self) {
        self.runtime.clear();
        self.forget_last_step();
        self.deferred.mark_none();
        self.state.copy_from(&InstanceState::new(&self.start));
        self.logger.reset();
        self.reported = 0;
        self.earliest_s = f64::NEG_INFINITY;
    }

    /// Warns where a state from before `noSetFMUStatePriorToCurrentPoint` is set.
    pub(crate) fn warn_of_early_state(&mut self, time_s: f64) {
        let earliest_s = self.earliest_s;
        if time_s < earliest_s {
            self.log_once(
                once::EARLY_STATE,
                Status::Warning,
                format_args!(
                    "fmi2SetFMUstate: goes back to {time_s:?} s, although noSetFMUStatePriorToCurrentPoint was fmi2True at {earliest_s:?} s"
                ),
            );
        }
    }
}
