//! A step of a model: its times, its inputs over time, its end.

use serde::{Deserialize, Serialize};

use crate::variables::{Real, RealVector, Values};

/// One step.
#[derive(Clone, Copy)]
pub struct Step<'a> {
    /// Time at which the last step ended, in s.
    pub start_s: f64,
    /// Time at which this step ends, in s; later than `start_s`.
    pub end_s: f64,
    /// Whether an input or tunable parameter was set to a *different* value since the last step, or inputs move in this one
    /// or did in the last: whatever was computed ahead of `start_s` is void.
    pub changed: bool,
    /// Whether a tunable parameter was set to a different value since the last step, or for the first time.
    pub parameters_changed: bool,
    /// The inputs within the step.
    pub inputs: InputsOverTime<'a>,
}

/// Continuous inputs as functions of time: u(t) = u + sum u_k (t - start)^k / k!, with u as [`Values`] hold it.
#[derive(Clone, Copy, Debug, Default)]
pub struct InputsOverTime<'a> {
    start_s: f64,
    derivatives: &'a [InputDerivative],
}

/// One derivative of an input.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InputDerivative {
    /// The input.
    pub input: Real,
    /// Order, from 1.
    pub order: u32,
    /// Value at the start, in the input's unit over s to the power of the order.
    pub value: f64,
}

impl<'a> InputsOverTime<'a> {
    /// Inputs that keep their values.
    #[inline]
    pub const fn held() -> Self {
        Self { start_s: 0.0, derivatives: &[] }
    }

    /// Inputs with these derivatives at `start_s`, in no particular order.
    #[inline]
    pub const fn new(start_s: f64, derivatives: &'a [InputDerivative]) -> Self {
        Self { start_s, derivatives }
    }

    /// The time at which the derivatives hold, in s.
    #[inline]
    pub const fn start_s(&self) -> f64 {
        self.start_s
    }

    /// The derivatives of an input, by order and value.
    #[inline]
    pub fn derivatives(&self, input: Real) -> impl Iterator<Item = (u32, f64)> + use<'a> {
        self.derivatives.iter().filter(move |it| it.input == input).map(|it| (it.order, it.value))
    }

    /// An input at `time_s`.
    #[inline]
    pub fn real(&self, values: &Values, input: Real, time_s: f64) -> f64 {
        self.from_held(values.real(input), input, time_s)
    }

    /// An input that has the value `held` where the derivatives hold, at `time_s`.
    #[inline]
    pub fn from_held(&self, held: f64, input: Real, time_s: f64) -> f64 {
        let mut sum = held;
        for &InputDerivative { input: of, order, value } in self.derivatives {
            if of == input {
                let dt_s = time_s - self.start_s;
                sum += (1..=order).fold(value, |term, k| term * dt_s / f64::from(k));
            }
        }
        sum
    }

    /// How fast an input changes at `time_s`, per second.
    #[inline]
    pub fn rate(&self, input: Real, time_s: f64) -> f64 {
        let dt_s = time_s - self.start_s;
        let of_input = self.derivatives.iter().filter(|it| it.input == input);
        of_input.map(|it| (1..it.order).fold(it.value, |term, k| term * dt_s / f64::from(k))).sum()
    }

    /// A vector of inputs at `time_s`.
    pub fn vector<const N: usize>(&self, values: &Values, inputs: RealVector<N>, time_s: f64) -> [f64; N] {
        core::array::from_fn(|i| self.real(values, inputs.element(i), time_s))
    }
}

/// Time at which a step ended, and whether the simulation ends with it.
#[derive(Clone, Debug, PartialEq)]
pub struct StepEnd {
    /// The time, in s, for which the outputs are; the end of the step or earlier.
    pub time_s: f64,
    /// Why the model ends the simulation here, if it does.
    pub terminate: Option<String>,
}

impl StepEnd {
    /// A step that ended at `time_s`.
    #[inline]
    pub const fn at(time_s: f64) -> Self {
        Self { time_s, terminate: None }
    }

    /// The simulation ends here, for this reason.
    #[must_use]
    pub fn terminate(self, reason: impl Into<String>) -> Self {
        Self { terminate: Some(reason.into()), ..self }
    }
}
