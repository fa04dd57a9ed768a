//! Why a call is refused. Made without allocation; turned into text only when the log listens.

use crate::fmi2::references;
use core::fmt;
use model_description::BaseType;

use crate::fmi2::access::AccessTable;
use crate::model::Failure;
use crate::state_bytes::StateMismatch;
use crate::variables::GREATEST_SET;
use model_description::Status;
use model_description::call_table::{Access, Function, State, allowed};

/// Why a call was not carried out.
#[derive(Debug)]
pub(crate) enum Problem {
    /// The table forbids the call.
    Illegal { function: Function, state: State },
    /// The caller broke the C contract: null pointer, bad flag, wrong size.
    Argument { name: &'static str, what: ArgumentError },
    /// No such variable.
    UnknownReference { base: BaseType, reference: u32, count: usize },
    /// The variable exists but may not be set now.
    NotSettable { base: BaseType, reference: u32, state: State },
    /// The variable cannot play the part it is given.
    NotA { role: &'static str, reference: u32 },
    /// A Real outside its limits, or not finite.
    RealOutOfRange { reference: u32, value: f64 },
    /// An Integer outside its limits, or an unknown item.
    IntegerOutOfRange { reference: u32, value: i32 },
    /// A Boolean that is neither 0 nor 1.
    NoBoolean { reference: u32, value: i32 },
    /// A String that is not UTF-8.
    NoText { reference: u32 },
    /// An input derivative beyond [`GREATEST_SET`], or not finite.
    DerivativeOutOfRange { reference: u32, value: f64 },
    /// A seed of a directional derivative that is not finite.
    SeedNotFinite { reference: u32, value: f64 },
    /// A Real that the model computed, and what it depends on where that is declared.
    NotFinite { reference: u32, value: f64, depends_on: Option<String> },
    /// A derivative that the model computed, and what it is along.
    SlopeNotFinite { of: u32, along: Option<String>, value: f64 },
    /// A derivative order that is not offered.
    Order { order: i32, largest: u32 },
    /// A time that is not finite, or start and stop in the wrong order.
    Experiment { start_s: f64, stop_s: Option<f64> },
    /// `fmi2EnterInitializationMode` before `fmi2SetupExperiment`.
    NoExperiment,
    /// The step starts elsewhere than the last one ended.
    TimeMismatch { given_s: f64, expected_s: f64 },
    /// A step size that is not positive and finite, or too small to change the time.
    StepSize { time_s: f64, step_size_s: f64 },
    /// The step ends after the stop time.
    PastStop { end_s: f64, stop_s: f64 },
    /// A status that only a pending step has.
    NoStatus { kind: i32 },
    /// A log category that is not declared; the others were taken.
    UnknownCategory { index: usize },
    /// The model ended the simulation, for this reason.
    Terminated(String),
    /// The model left a step at a time that is not within it.
    StepEnd { from_s: f64, end_s: f64, came_to_s: f64 },
    /// The model itself.
    Model(Failure),
    /// An FMU state that does not fit this instance.
    ForeignState(StateMismatch),
    /// The instance panicked before.
    Poisoned,
}

/// Why an argument is refused.
#[derive(Debug)]
pub(crate) enum ArgumentError {
    Null,
    NotZeroOrOne(i32),
    TooLong { given: usize },
    NotOurs,
}

impl Problem {
    /// The status by which a function reports the problem.
    pub(crate) fn status(&self) -> Status {
        match self {
            Self::RealOutOfRange { .. }
            | Self::IntegerOutOfRange { .. }
            | Self::NoBoolean { .. }
            | Self::NoText { .. }
            | Self::DerivativeOutOfRange { .. }
            | Self::NoStatus { .. } => Status::Discard,
            Self::Terminated(_) => Status::Discard,
            Self::UnknownCategory { .. } => Status::Warning,
            _ => Status::Error,
        }
    }

    /// The problem in words, with variables by name.
    pub(crate) fn explain<'a>(&'a self, access: &'a AccessTable) -> impl fmt::Display + 'a {
        Explained { problem: self, access }
    }
}

impl From<Failure> for Problem {
    fn from(failure: Failure) -> Self {
        Self::Model(failure)
    }
}

impl From<StateMismatch> for Problem {
    fn from(mismatch: StateMismatch) -> Self {
        Self::ForeignState(mismatch)
    }
}

struct Explained<'a> {
    problem: &'a Problem,
    access: &'a AccessTable,
}

impl Explained<'_> {
    fn named(&self, base: BaseType, reference: u32) -> String {
        match self.access.name(base, reference) {
            Some(name) => format!("`{name}` ({} value reference {reference})", base.name()),
            None => format!("{} value reference {reference}", base.name()),
        }
    }

    /// The type of a variable that is there, but not of type `base`.
    fn of_another_type(&self, base: BaseType, reference: u32) -> Option<BaseType> {
        references::base_type(reference)
            .filter(|other| *other != base && self.access.name(*other, reference).is_some())
    }

    fn when_settable(&self, base: BaseType, reference: u32) -> &'static str {
        use crate::fmi2::access::{INPUT, SET_INITIALIZATION, SET_INSTANTIATED, SET_STEP};
        let flags = self.access.flags(base).get(references::index(base, reference)).copied().unwrap_or(0);
        match flags {
            f if f & (SET_STEP | INPUT) != 0 => "before a step",
            f if f & (SET_INSTANTIATED | SET_INITIALIZATION) != 0 => "before the end of Initialization Mode",
            _ => "never",
        }
    }
}

impl fmt::Display for Explained<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.problem {
            Problem::Illegal { function, state } => {
                let admits = |state: &State| allowed(*function, *state) != Access::Forbidden;
                let states: Vec<_> = State::ALL.iter().filter(|it| admits(it)).map(|it| it.name()).collect();
                let states = states.join(", ");
                write!(f, "not allowed in the state {}, only in: {states}", state.name())
            }
            Problem::Argument { name, what } => match what {
                ArgumentError::Null => write!(f, "argument {name} is NULL"),
                ArgumentError::NotZeroOrOne(value) => {
                    write!(f, "argument {name} is {value}, allowed are 0 (fmi2False) and 1 (fmi2True)")
                }
                ArgumentError::TooLong { given } => write!(f, "argument {name} cannot have {given} elements"),
                ArgumentError::NotOurs => write!(f, "argument {name} was not made by this library"),
            },
            Problem::UnknownReference { base, reference, .. }
                if self.of_another_type(*base, *reference).is_some() =>
            {
                let other = self.of_another_type(*base, *reference).unwrap_or(*base);
                write!(f, "{} is no {}", self.named(other, *reference), base.name())
            }
            Problem::UnknownReference { base, reference, count: 0 } => {
                write!(f, "unknown value reference {reference}: this model has no {} variables", base.name())
            }
            Problem::UnknownReference { base, reference, count } => write!(
                f,
                "unknown {} value reference {reference}: this model has {} to {}",
                base.name(),
                references::first(*base),
                references::first(*base) as usize + count - 1
            ),
            Problem::NotSettable { base, reference, state } => write!(
                f,
                "{} may not be set in the state {}: it may be set {}",
                self.named(*base, *reference),
                state.name(),
                self.when_settable(*base, *reference)
            ),
            Problem::NotA { role, reference } => {
                write!(f, "{} is no {role}", self.named(BaseType::Real, *reference))
            }
            Problem::RealOutOfRange { reference, value } => {
                let (min, max) = self
                    .access
                    .real_limits
                    .get(references::index(BaseType::Real, *reference))
                    .copied()
                    .unwrap_or((f64::MIN, f64::MAX));
                let name = self.named(BaseType::Real, *reference);
                write!(f, "{name} was set to {value:?}, ")?;
                match (min == f64::MIN, max == f64::MAX) {
                    (true, true) => write!(f, "allowed is any finite value"),
                    (false, true) => write!(f, "allowed is any finite value from {min:?} up"),
                    (true, false) => write!(f, "allowed is any finite value up to {max:?}"),
                    (false, false) => write!(f, "allowed is {min:?} to {max:?}"),
                }
            }
            Problem::IntegerOutOfRange { reference, value } => {
                let index = references::index(BaseType::Integer, *reference);
                let name = self.named(BaseType::Integer, *reference);
                write!(f, "{name} was set to {value}, ")?;
                if let Some(Some(items)) = self.access.integer_items.get(index) {
                    return write!(f, "allowed are {items:?}");
                }
                let (min, max) =
                    self.access.integer_limits.get(index).copied().unwrap_or((i32::MIN, i32::MAX));
                write!(f, "allowed is {min} to {max}")
            }
            Problem::NoBoolean { reference, value } => write!(
                f,
                "{} was set to {value}, allowed are 0 (fmi2False) and 1 (fmi2True)",
                self.named(BaseType::Boolean, *reference)
            ),
            Problem::NoText { reference } => {
                write!(f, "{} was set to text that is not UTF-8", self.named(BaseType::String, *reference))
            }
            Problem::DerivativeOutOfRange { reference, value } => write!(
                f,
                "a derivative of {} was set to {value:?}, allowed is {:?} to {GREATEST_SET:?}",
                self.named(BaseType::Real, *reference),
                -GREATEST_SET
            ),
            Problem::SeedNotFinite { reference, value } => write!(
                f,
                "the seed of {} is {value:?}, allowed is any finite value",
                self.named(BaseType::Real, *reference)
            ),
            Problem::NotFinite { reference, value, depends_on } => {
                let name = self.named(BaseType::Real, *reference);
                write!(f, "{name} came out as {value:?}, which is no finite number")?;
                match depends_on {
                    Some(depends_on) => write!(f, "; it depends on {depends_on}"),
                    None => write!(f, "; look for inputs or parameters beyond what can be"),
                }
            }
            Problem::SlopeNotFinite { of, along, value } => {
                let name = self.named(BaseType::Real, *of);
                write!(f, "the derivative of {name}")?;
                if let Some(along) = along {
                    write!(f, " along {along}")?;
                }
                write!(f, " came out as {value:?}, which is no finite number")
            }
            Problem::Order { order, largest: 0 } => {
                write!(f, "derivatives of order {order} were requested, this model offers none")
            }
            Problem::Order { order, largest } => {
                write!(f, "the derivative order is {order}, allowed are 1 to {largest}")
            }
            Problem::Experiment { start_s, stop_s: None } => {
                write!(f, "the start time is {start_s:?} s, it must be finite")
            }
            Problem::Experiment { start_s, stop_s: Some(stop_s) } => write!(
                f,
                "the start time is {start_s:?} s and the stop time {stop_s:?} s: both must be finite, and the stop not before the start"
            ),
            Problem::NoExperiment => {
                write!(f, "fmi2SetupExperiment must be called before fmi2EnterInitializationMode")
            }
            Problem::TimeMismatch { given_s, expected_s } => write!(
                f,
                "the step begins at {given_s:?} s, but the instance is at {expected_s:?} s (to go back, set a saved FMU state)"
            ),
            Problem::StepSize { time_s, step_size_s } => write!(
                f,
                "the step size is {step_size_s:?} s at {time_s:?} s: it must be positive, finite and large enough to change the time"
            ),
            Problem::PastStop { end_s, stop_s } => {
                write!(f, "the step ends at {end_s:?} s, after the stop time {stop_s:?} s")
            }
            Problem::NoStatus { kind } => {
                write!(f, "status kind {kind} has no value here: no step is ever pending")
            }
            Problem::UnknownCategory { index } => write!(
                f,
                "log category number {} is not declared; known are {}",
                index + 1,
                crate::logger::Category::names()
            ),
            Problem::Terminated(reason) => write!(f, "{reason}"),
            Problem::StepEnd { from_s, end_s, came_to_s } => write!(
                f,
                "the model left the step from {from_s:?} to {end_s:?} s at {came_to_s:?} s, which is not within it"
            ),
            Problem::Model(failure) => write!(f, "{failure}"),
            Problem::ForeignState(mismatch) => write!(f, "{mismatch}"),
            Problem::Poisoned => write!(
                f,
                "a panic ended this instance before; only fmi2FreeInstance and fmi2FreeFMUstate still work"
            ),
        }
    }
}
