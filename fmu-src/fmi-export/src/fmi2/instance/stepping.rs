//! The step and its status.

use super::Instance;
use crate::fmi2::problem::Problem;
use crate::model::{InputsOverTime, Step};
use crate::time;
use model_description::call_table::Function;

/// The kind of a `fmi2GetXXXStatus`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StatusKind {
    /// `fmi2LastSuccessfulTime`.
    LastSuccessfulTime,
    /// `fmi2Terminated`.
    Terminated,
    /// `fmi2DoStepStatus`, `fmi2PendingStatus` and numbers without meaning: only a pending step has them.
    Other(i32),
}

impl StatusKind {
    /// The kind of a C value.
    pub(crate) fn from_code(code: i32) -> Self {
        match code {
            2 => Self::LastSuccessfulTime,
            3 => Self::Terminated,
            other => Self::Other(other),
        }
    }

    fn code(self) -> i32 {
        match self {
            Self::LastSuccessfulTime => 2,
            Self::Terminated => 3,
            Self::Other(code) => code,
        }
    }
}

impl Instance {
    /// `fmi2DoStep`. By the standard's recipe the step begins where the last one ended, even if the
    /// communication point given differs by a rounding, and ends at `point_s + step_size_s`.
    pub(crate) fn do_step(&mut self, point_s: f64, step_size_s: f64, no_return: bool) -> Result<(), Problem> {
        self.guard(Function::DoStep)?;
        let start_s = self.state.time_s;
        if !(step_size_s > 0.0 && step_size_s.is_finite()) {
            return Err(Problem::StepSize { time_s: point_s, step_size_s });
        }
        if !time::is_same(point_s, start_s, step_size_s) {
            return Err(Problem::TimeMismatch { given_s: point_s, expected_s: start_s });
        }
        let end_s = point_s + step_size_s;
        if !(end_s > start_s && end_s.is_finite()) {
            return Err(Problem::StepSize { time_s: point_s, step_size_s });
        }
        if let Some(stop_s) = self.state.experiment.and_then(|experiment| experiment.stop_s)
            && end_s > stop_s
            && !time::is_same(end_s, stop_s, step_size_s)
        {
            return Err(Problem::PastStop { end_s, stop_s });
        }
        if no_return {
            self.earliest_s = self.earliest_s.max(point_s);
        }
        // An input whose derivatives are 0 stays where it is.
        self.state.input_derivatives.retain(|derivative| derivative.value != 0.0);
        let terminate = self.advance(start_s, end_s)?;
        self.check_finite(false)?;
        let state = &mut self.state;
        state.derivatives_ended = !state.input_derivatives.is_empty();
        state.input_derivatives.clear();
        state.terminated = terminate.is_some();
        self.forget_last_step();
        terminate.map_or(Ok(()), |reason| Err(Problem::Terminated(reason)))
    }

    /// Steps the model to `end_s`, again and again where it stops early, and leaves the time where it came to; the reason
    /// where it ends the simulation.
    fn advance(&mut self, start_s: f64, end_s: f64) -> Result<Option<String>, Problem> {
        let state = &mut self.state;
        let inputs = InputsOverTime::new(start_s, &state.input_derivatives);
        let mut changed = state.derivatives_ended || !state.input_derivatives.is_empty() || state.differs();
        let mut from_s = start_s;
        loop {
            let step = Step { start_s: from_s, end_s, changed, inputs };
            let end = self.runtime.step(&mut state.values, &step, &self.logger)?;
            let is_within = end.time_s >= from_s && end.time_s <= end_s;
            if !is_within || (end.time_s == from_s && end.terminate.is_none()) {
                return Err(Problem::StepEnd { from_s, end_s, came_to_s: end.time_s });
            }
            state.time_s = end.time_s;
            if end.terminate.is_some() || end.time_s == end_s {
                return Ok(end.terminate);
            }
            (from_s, changed) = (end.time_s, false);
        }
    }

    /// `fmi2GetRealStatus`.
    pub(crate) fn real_status(&mut self, kind: StatusKind) -> Result<f64, Problem> {
        self.guard(Function::GetRealStatus)?;
        match kind {
            StatusKind::LastSuccessfulTime => Ok(self.state.time_s),
            other => Err(Problem::NoStatus { kind: other.code() }),
        }
    }

    /// `fmi2GetBooleanStatus`.
    pub(crate) fn boolean_status(&mut self, kind: StatusKind) -> Result<bool, Problem> {
        self.guard(Function::GetBooleanStatus)?;
        match kind {
            StatusKind::Terminated => Ok(self.state.terminated),
            other => Err(Problem::NoStatus { kind: other.code() }),
        }
    }

    /// `fmi2GetStatus`, `fmi2GetIntegerStatus` and `fmi2GetStringStatus`: their status only a pending step has.
    pub(crate) fn no_status(&mut self, function: Function, kind: StatusKind) -> Result<(), Problem> {
        self.guard(function)?;
        Err(Problem::NoStatus { kind: kind.code() })
    }

    /// `fmi2CancelStep`: no step is ever in progress, so the table refuses it in every state we reach.
    pub(crate) fn cancel_step(&mut self) -> Result<(), Problem> {
        self.guard(Function::CancelStep)
    }
}
