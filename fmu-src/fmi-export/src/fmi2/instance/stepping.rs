//! The step.

use super::Instance;
use crate::fmi2::problem::Problem;
use crate::model::{InputsOverTime, Step};
use crate::time;

impl Instance {
    /// `fmi2DoStep`. By the standard's recipe the step begins where the last one ended, even if the
    /// communication point given differs by a rounding, and ends at `point_s + step_size_s`.
    pub(crate) fn do_step(&mut self, point_s: f64, step_size_s: f64, no_return: bool) -> Result<(), Problem> {
        let start_s = self.state.time_s;
        if !(step_size_s > 0.0 && step_size_s.is_finite()) {
            return Err(wrong_size(point_s, step_size_s));
        }
        if !time::is_same(point_s, start_s, step_size_s) {
            return Err(Problem::error(format_args!(
                "the step begins at {point_s:?} s, but the instance is at {start_s:?} s (to go back, set a saved FMU state)"
            )));
        }
        let end_s = point_s + step_size_s;
        if !(end_s > start_s && end_s.is_finite()) {
            return Err(wrong_size(point_s, step_size_s));
        }
        if let Some(stop_s) = self.state.experiment.and_then(|experiment| experiment.stop_s)
            && end_s > stop_s
            && !time::is_same(end_s, stop_s, step_size_s)
        {
            return Err(Problem::error(format_args!(
                "the step ends at {end_s:?} s, after the stop time {stop_s:?} s"
            )));
        }
        if no_return {
            self.earliest_s = self.earliest_s.max(point_s);
        }
        // An input whose derivatives are 0 stays where it is.
        self.state.input_derivatives.retain(|derivative| derivative.value != 0.0);
        self.deferred.mark_none();
        let terminate = self.advance(start_s, end_s)?;
        self.check_finite(false)?;
        self.deferred.pending = self.deferred.all;
        let state = &mut self.state;
        state.derivatives_ended = !state.input_derivatives.is_empty();
        state.input_derivatives.clear();
        state.terminated = terminate.is_some();
        self.forget_last_step();
        terminate.map_or(Ok(()), |reason| Err(Problem::discard(reason)))
    }

    /// Steps the model to `end_s`, again and again where it stops early, and leaves the time where it came to; the reason
    /// where it ends the simulation.
    fn advance(&mut self, start_s: f64, end_s: f64) -> Result<Option<String>, Problem> {
        let state = &mut self.state;
        let inputs = InputsOverTime::new(start_s, &state.input_derivatives);
        let mut changed = state.derivatives_ended || !state.input_derivatives.is_empty() || state.differs();
        let mut parameters_changed = state.parameters_differ(&self.tunable);
        let mut from_s = start_s;
        loop {
            let step = Step { start_s: from_s, end_s, changed, parameters_changed, inputs };
            let end = self.runtime.step(&mut state.values, &step, &self.logger)?;
            let is_within = end.time_s >= from_s && end.time_s <= end_s;
            if !is_within || (end.time_s == from_s && end.terminate.is_none()) {
                return Err(Problem::error(format_args!(
                    "the model left the step from {from_s:?} to {end_s:?} s at {:?} s, which is not within it",
                    end.time_s
                )));
            }
            state.time_s = end.time_s;
            if end.terminate.is_some() || end.time_s == end_s {
                return Ok(end.terminate);
            }
            (from_s, changed, parameters_changed) = (end.time_s, false, false);
        }
    }
}

fn wrong_size(time_s: f64, step_size_s: f64) -> Problem {
    Problem::error(format_args!(
        "the step size is {step_size_s:?} s at {time_s:?} s: it must be positive, finite and large enough to change the time"
    ))
}
