//! The functions that may be called in each state, and the states they lead to: FMI 2.0.5 co-simulation, 4.2.4.
//!
//! The rows stand in [`functions!`](crate::functions!), next to the signatures. One table serves the exporter's guard, the
//! harness's call checker and the generated documentation; the tests hold it against a second one.

use crate::rules::effective_initial;
use crate::words::words;
use crate::{Causality, Initial, ScalarVariable, Status, Variability};
use Access::{Allowed, Conditional, Forbidden};
use Condition::{
    Debugging, DebuggingUnlessTerminated, InputOrTunable, OutputOrInitialUnknown,
    SettableBeforeInitialization, SettableInInitialization,
};

words! {
    /// The state of a co-simulation slave; in the order of the table's columns.
    #[repr(u8)]
    pub enum State, name {
        /// After `fmi2Instantiate` or `fmi2Reset`.
        Instantiated => "instantiated",
        /// Between `fmi2EnterInitializationMode` and `fmi2ExitInitializationMode`.
        InitializationMode => "Initialization Mode",
        /// Between steps.
        StepComplete => "stepComplete",
        /// `fmi2DoStep` answered `fmi2Pending`.
        StepInProgress => "stepInProgress",
        /// `fmi2DoStep` answered `fmi2Discard`.
        StepFailed => "stepFailed",
        /// `fmi2CancelStep` ended a step in progress.
        StepCanceled => "stepCanceled",
        /// After `fmi2Terminate`.
        Terminated => "terminated",
        /// A function answered `fmi2Error`.
        Error => "error",
        /// A function answered `fmi2Fatal`, here or in another instance.
        Fatal => "fatal",
    }
}

impl State {
    /// Number of states.
    pub const COUNT: usize = Self::ALL.len();
}

/// Whether a function may be called.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Access {
    /// Never.
    Forbidden,
    /// Always.
    Allowed,
    /// For the variables, or in the situation, that the condition names.
    Conditional(Condition),
}

words! {
    /// The notes under the standard's table, in words; the numbers are the standard's.
    pub enum Condition, text {
        /// Note 1.
        SettableBeforeInitialization = 1
            => "variables whose variability is not constant and whose initial is exact or approx",
        /// Note 2.
        OutputOrInitialUnknown = 2 => "outputs and variables listed under InitialUnknowns",
        /// Note 3.
        SettableInInitialization = 3
            => "variables whose variability is not constant, and whose initial is exact or which are inputs",
        /// Note 6.
        InputOrTunable = 6 => "inputs and tunable parameters",
        /// Note 7.
        Debugging = 7 => "for debugging only",
        /// Note 8.
        DebuggingUnlessTerminated = 8 => "for debugging only, unless the status fmi2Terminated is true",
    }
}

impl Condition {
    /// The number of the note.
    pub const fn number(self) -> u32 {
        self as u32
    }

    /// Whether a variable meets the condition; `initial_unknown` is whether `InitialUnknowns` lists it. The conditions on
    /// debugging say what values are good for, not whose they are: every variable meets them.
    pub fn admits(self, variable: &ScalarVariable, initial_unknown: bool) -> bool {
        let changes = variable.variability != Variability::Constant;
        let initial = effective_initial(variable);
        match self {
            SettableBeforeInitialization => {
                changes && matches!(initial, Some(Initial::Exact | Initial::Approx))
            }
            OutputOrInitialUnknown => initial_unknown || variable.causality == Causality::Output,
            SettableInInitialization => {
                changes && (initial == Some(Initial::Exact) || variable.causality == Causality::Input)
            }
            InputOrTunable => match variable.causality {
                Causality::Input => true,
                Causality::Parameter => variable.variability == Variability::Tunable,
                _ => false,
            },
            Debugging | DebuggingUnlessTerminated => true,
        }
    }
}

macro_rules! declare {
    ($($(#[$doc:meta])* $name:ident $symbol:ident $parameters:tt -> $result:ty: $access:expr;)*) => {
        /// The functions of FMI 2.0 co-simulation.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
        #[repr(u8)]
        #[allow(missing_docs, reason = "the variants are the standard's own function names")]
        pub enum Function { $($name),* }

        impl Function {
            /// Every function, in the order of the table's rows.
            pub const ALL: &'static [Self] = &[$(Self::$name),*];

            /// Name of the exported symbol.
            pub const fn symbol(self) -> &'static str {
                match self { $(Self::$name => stringify!($symbol)),* }
            }
        }

        /// Row by [`Function`], column by [`State`].
        pub const CALL_TABLE: &[[Access; State::COUNT]] = &[$($access),*];
    };
}

const X: Access = Allowed;
const O: Access = Forbidden;
const N1: Access = Conditional(SettableBeforeInitialization);
const N2: Access = Conditional(OutputOrInitialUnknown);
const N3: Access = Conditional(SettableInInitialization);
const N6: Access = Conditional(InputOrTunable);
const N7: Access = Conditional(Debugging);
const N8: Access = Conditional(DebuggingUnlessTerminated);

/// Allowed whenever no step is in progress.
const IDLE: [Access; State::COUNT] = [X, X, X, O, X, X, X, X, O];
const GET: [Access; State::COUNT] = [O, N2, X, O, N8, N7, X, N7, O];
const SET: [Access; State::COUNT] = [N1, N3, N6, O, O, O, O, O, O];
const STATUS: [Access; State::COUNT] = [O, O, X, X, X, O, X, O, O];
const ANY: [Access; State::COUNT] = [X, X, X, X, X, X, X, X, O];

crate::functions!(declare);

/// Whether `function` may be called in `state`.
#[inline]
pub const fn allowed(function: Function, state: State) -> Access {
    CALL_TABLE[function as usize][state as usize]
}

/// The state after a call.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Next {
    /// To this state.
    State(State),
    /// To the state that the given FMU state was taken in (`fmi2SetFMUstate`).
    Stored,
    /// The instance is gone (`fmi2FreeInstance`).
    Freed,
}

/// The state after a call of `function` in `state` that answered `status`.
///
/// A call that the table forbids answers `fmi2Error`; pass that status.
pub const fn after(function: Function, state: State, status: Status) -> Next {
    match (function, status) {
        (_, Status::Fatal) => Next::State(State::Fatal),
        (Function::FreeInstance, Status::Ok) => Next::Freed,
        // What is fatal stays so.
        _ if matches!(state, State::Fatal) => Next::State(State::Fatal),
        (_, Status::Error) => Next::State(State::Error),
        (Function::DoStep, Status::Discard) => Next::State(State::StepFailed),
        (Function::DoStep, Status::Pending) => Next::State(State::StepInProgress),
        (_, Status::Discard | Status::Pending) => Next::State(state),
        (_, Status::Ok | Status::Warning) => after_success(function, state),
    }
}

const fn after_success(function: Function, state: State) -> Next {
    Next::State(match function {
        Function::Instantiate | Function::Reset => State::Instantiated,
        Function::EnterInitializationMode => State::InitializationMode,
        Function::ExitInitializationMode | Function::DoStep => State::StepComplete,
        Function::Terminate => State::Terminated,
        Function::CancelStep => State::StepCanceled,
        Function::SetFmuState => return Next::Stored,
        _ => state,
    })
}

/// A call outside the table that our FMUs answer all the same, with a message in the log.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leniency {
    /// The functions.
    pub functions: &'static [Function],
    /// The state.
    pub state: State,
    /// The status of the answer.
    pub answer: Status,
    /// For which variables.
    pub variables: &'static str,
    /// Why it is admitted.
    pub reason: &'static str,
}

const GETTERS: &[Function] =
    &[Function::GetReal, Function::GetInteger, Function::GetBoolean, Function::GetString];

/// Every leniency there is.
pub const LENIENCIES: &[Leniency] = &[
    Leniency {
        functions: &[Function::SetReal, Function::SetInteger, Function::SetBoolean, Function::SetString],
        state: State::Instantiated,
        answer: Status::Ok,
        variables: "inputs",
        reason: "FMPy sets inputs before Initialization Mode, and FMI 3.0 allows it",
    },
    Leniency {
        functions: GETTERS,
        state: State::Instantiated,
        answer: Status::Warning,
        variables: "variables with a start value",
        reason: "many tools show values before a run, and FMI 3.0 allows it",
    },
    Leniency {
        functions: GETTERS,
        state: State::InitializationMode,
        answer: Status::Ok,
        variables: "inputs, parameters and locals",
        reason: "libcosim's observers read every variable in Initialization Mode, and FMI 3.0 allows it",
    },
];

/// The leniency by which our FMUs answer `function` in `state`, if there is one.
pub fn leniency(function: Function, state: State) -> Option<&'static Leniency> {
    LENIENCIES.iter().find(|it| it.state == state && it.functions.contains(&function))
}
