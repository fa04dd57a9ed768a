//! The reference: what an instance of AllTypes must answer and become, from the rules alone.

use super::table;
use super::variables::{Content, VARIABLES, Value, Variable, echoes, position};
use model_description::BaseType;

/// One call of a master; any may come at any time.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Call {
    SetDebugLogging(bool),
    SetupExperiment {
        start_s: f64,
        stop_s: Option<f64>,
    },
    EnterInitializationMode,
    ExitInitializationMode,
    Terminate,
    Reset,
    /// `fmi2FreeInstance`, and another instance in its place.
    Replace,
    Get(BaseType, Vec<Picked>),
    Set(BaseType, Vec<(Picked, Value)>),
    GetState(usize),
    SetState(usize),
    FreeState(usize),
    /// Size and bytes of a slot, kept.
    Serialize(usize),
    /// The kept bytes, into a slot.
    Deserialize(usize),
    SetInputDerivative {
        known: bool,
        order: i32,
        value: f64,
    },
    GetOutputDerivative {
        known: bool,
        order: i32,
    },
    DirectionalDerivative {
        known: bool,
        seed: f64,
    },
    /// With a step size, and by how much the communication point is off.
    DoStep {
        step_s: f64,
        off_s: f64,
        no_return: bool,
    },
    CancelStep,
    GetStatus(i32),
    GetIntegerStatus(i32),
    GetStringStatus(i32),
    LastSuccessfulTime,
    Terminated,
}

/// A row of the variables, or a reference that no variable has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Picked {
    Row(usize),
    Unknown(u32),
}

/// Answer that is expected.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Answer {
    Ok,
    Discard,
    Error,
    /// OK with these values; `None` is not predicted.
    Values(Vec<Option<Value>>),
    /// The same with a warning: a declared leniency.
    Warned(Vec<Option<Value>>),
    /// OK with this number.
    Number(f64),
}

/// All that `fmi2SetFMUstate` brings back.
#[derive(Clone)]
pub(super) struct InstanceState {
    pub state: char,
    experiment: Option<(f64, Option<f64>)>,
    time_s: f64,
    terminated: bool,
    set_values: [Value; VARIABLES.len()],
    /// Computation that the outputs show; none before the first one.
    computed: Option<Computed>,
    derivatives: Vec<(i32, f64)>,
}

#[derive(Clone)]
struct Computed {
    set_values: [Value; VARIABLES.len()],
    output_real: f64,
    slope: f64,
}

/// The reference instance with the states its master keeps.
#[derive(Clone)]
pub(super) struct Master {
    pub now: InstanceState,
    slots: [Option<Box<InstanceState>>; 2],
    bytes: Option<Box<InstanceState>>,
    pub logging: bool,
    pub answer: Answer,
    misprint: Option<Misprint>,
}

/// A cell of the reference table that is not the standard's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Misprint {
    pub function: &'static str,
    pub state: char,
    pub cell: char,
}

impl InstanceState {
    fn fresh() -> Self {
        Self {
            state: 'I',
            experiment: None,
            time_s: 0.0,
            terminated: false,
            set_values: std::array::from_fn(|row| VARIABLES[row].start),
            computed: None,
            derivatives: Vec::new(),
        }
    }

    fn number(&self, name: &str) -> f64 {
        match self.set_values[position(name)] {
            Value::Real(value) => value,
            other => panic!("{name} is {other:?}"),
        }
    }

    /// The outputs at the end of a step of `length_s`, whose inputs follow their Taylor polynomials.
    fn compute(&mut self, length_s: f64, derivatives: &[(i32, f64)]) {
        let (mut output_real, mut slope) = (self.number("input.real"), 0.0);
        for &(order, value) in derivatives {
            let factorial: f64 = (1..=order).map(f64::from).product();
            output_real += value * length_s.powi(order) / factorial;
            slope += value * length_s.powi(order - 1) * f64::from(order) / factorial;
        }
        self.computed = Some(Computed { set_values: self.set_values, output_real, slope });
    }

    fn read(&self, row: usize) -> Option<Value> {
        match (VARIABLES[row].content, echoes()[row], &self.computed) {
            (Content::AsSet, ..) => Some(self.set_values[row]),
            (Content::Echo("input.real"), _, Some(computed)) => Some(Value::Real(computed.output_real)),
            (Content::Echo(_), Some(source), Some(computed)) => Some(computed.set_values[source]),
            _ => None,
        }
    }
}

/// Short, for it stands before every shrunk sequence.
impl std::fmt::Debug for Master {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "in {} at {} s", self.now.state, self.now.time_s)
    }
}

impl Master {
    pub(super) fn new() -> Self {
        Self {
            now: InstanceState::fresh(),
            slots: [None, None],
            bytes: None,
            logging: true,
            answer: Answer::Ok,
            misprint: None,
        }
    }

    /// A reference whose table has one broken cell.
    pub(super) fn misled(misprint: Misprint) -> Self {
        Self { misprint: Some(misprint), ..Self::new() }
    }

    fn cell(&self, call: &Call) -> char {
        let (function, state) = (function(call), self.now.state);
        match self.misprint {
            Some(misprint) if (misprint.function, misprint.state) == (function, state) => misprint.cell,
            _ => table::cell(function, state),
        }
    }

    /// Time of the last communication point.
    pub(super) fn time_s(&self) -> f64 {
        self.now.time_s
    }

    /// Makes the call; the answer is kept in `answer`.
    pub(super) fn call(&mut self, call: &Call) {
        let cell = self.cell(call);
        self.answer = match call {
            // Declared leniency: start values before Initialization Mode.
            Call::Get(_, picked) if cell == '.' && self.now.state == 'I' => self.start_values(picked),
            _ if cell == '.' => Answer::Error,
            _ => self.allowed(call, cell),
        };
        if self.answer == Answer::Error {
            self.now.state = 'E';
        }
    }

    fn allowed(&mut self, call: &Call, note: char) -> Answer {
        let now = &mut self.now;
        match *call {
            Call::SetDebugLogging(on) => self.logging = on,
            Call::SetupExperiment { start_s, stop_s } => {
                if !start_s.is_finite()
                    || stop_s.is_some_and(|stop_s| !stop_s.is_finite() || stop_s < start_s)
                {
                    return Answer::Error;
                }
                now.experiment = Some((start_s, stop_s));
            }
            Call::EnterInitializationMode => {
                let Some((start_s, _)) = now.experiment else { return Answer::Error };
                (now.state, now.time_s) = ('M', start_s);
            }
            Call::ExitInitializationMode => {
                now.compute(0.0, &[]);
                now.state = 'C';
            }
            Call::Terminate => now.state = 'T',
            Call::Reset | Call::Replace => {
                *now = InstanceState::fresh();
                self.logging = true;
            }
            Call::Get(_, ref picked) => return self.get(picked),
            Call::Set(_, ref expected) => return self.set(expected, note),
            Call::GetState(slot) => self.slots[slot] = Some(Box::new(now.clone())),
            Call::SetState(slot) => match &self.slots[slot] {
                Some(saved) => *now = (**saved).clone(),
                None => return Answer::Error,
            },
            Call::FreeState(slot) => self.slots[slot] = None,
            Call::Serialize(slot) => match &self.slots[slot] {
                Some(saved) => self.bytes = Some(saved.clone()),
                None => return Answer::Error,
            },
            Call::Deserialize(slot) => match &self.bytes {
                Some(saved) => self.slots[slot] = Some(saved.clone()),
                None => return Answer::Error,
            },
            Call::SetInputDerivative { known, order, value } => {
                if !known || order < 1 {
                    return Answer::Error;
                }
                if !value.is_finite() {
                    return Answer::Discard;
                }
                now.derivatives.retain(|(kept, _)| *kept != order);
                now.derivatives.push((order, value));
            }
            Call::GetOutputDerivative { known, order } => {
                return match &now.computed {
                    // Beyond maxOutputDerivativeOrder.
                    _ if known && order > 1 => Answer::Warned(vec![Some(Value::Real(0.0))]),
                    Some(computed) if known && order == 1 => Answer::Number(computed.slope),
                    _ => Answer::Error,
                };
            }
            Call::DirectionalDerivative { known, seed } => {
                if known && now.state == 'M' {
                    now.compute(0.0, &[]);
                }
                return match now.computed {
                    Some(_) if known => Answer::Number(seed),
                    _ => Answer::Error,
                };
            }
            Call::DoStep { step_s, off_s, .. } => return self.step(step_s, off_s),
            Call::CancelStep => return Answer::Error,
            // No step is ever pending, so there is nothing to report.
            Call::GetStatus(_) | Call::GetIntegerStatus(_) | Call::GetStringStatus(_) => {
                return Answer::Discard;
            }
            Call::LastSuccessfulTime => return Answer::Number(now.time_s),
            Call::Terminated => return Answer::Number(f64::from(u8::from(now.terminated))),
        }
        Answer::Ok
    }

    fn get(&mut self, picked: &[Picked]) -> Answer {
        let rows: Option<Vec<usize>> = picked
            .iter()
            .map(|picked| match picked {
                Picked::Row(row) => Some(*row),
                Picked::Unknown(_) => None,
            })
            .collect();
        let Some(rows) = rows else { return Answer::Error };
        // Whoever reads an output in Initialization Mode has it computed from what was set so far.
        let by_master = |row: &usize| matches!(VARIABLES[*row].role.0, "input" | "parameter");
        if self.now.state == 'M' && !rows.iter().all(by_master) {
            self.now.compute(0.0, &[]);
        }
        Answer::Values(rows.iter().map(|row| self.now.read(*row)).collect())
    }

    fn start_values(&self, picked: &[Picked]) -> Answer {
        let value = |picked: &Picked| match *picked {
            Picked::Row(row) if VARIABLES[row].has_start() => Some(self.now.read(row)),
            _ => None,
        };
        picked.iter().map(value).collect::<Option<_>>().map_or(Answer::Error, Answer::Warned)
    }

    /// All or nothing; the first element that is wrong decides.
    fn set(&mut self, expected: &[(Picked, Value)], note: char) -> Answer {
        for (picked, value) in expected {
            let Picked::Row(row) = *picked else { return Answer::Error };
            let variable: &Variable = &VARIABLES[row];
            // Declared leniency: inputs before Initialization Mode.
            if !(variable.settable(note) || note == '1' && variable.is_input()) {
                return Answer::Error;
            }
            if !(variable.admits)(*value) {
                return Answer::Discard;
            }
        }
        for (picked, value) in expected {
            if let Picked::Row(row) = *picked {
                self.now.set_values[row] = *value;
            }
        }
        Answer::Ok
    }

    fn step(&mut self, step_s: f64, off_s: f64) -> Answer {
        let now = &mut self.now;
        let (point_s, start_s) = (now.time_s + off_s, now.time_s);
        if !step_s.is_finite() || step_s <= 0.0 || off_s != 0.0 {
            return Answer::Error;
        }
        let end_s = point_s + step_s;
        if now.experiment.and_then(|(_, stop_s)| stop_s).is_some_and(|stop_s| end_s > stop_s) {
            return Answer::Error;
        }
        let over_s = now.number("end.time");
        let derivatives = std::mem::take(&mut now.derivatives);
        if over_s >= start_s {
            now.time_s = end_s.min(over_s);
            now.compute(now.time_s - start_s, &derivatives);
        }
        if over_s < end_s {
            (now.state, now.terminated) = ('F', true);
            return Answer::Discard;
        }
        Answer::Ok
    }
}

/// The table's name of a call.
pub(super) fn function(call: &Call) -> &'static str {
    match call {
        Call::SetDebugLogging(_) => "SetDebugLogging",
        Call::SetupExperiment { .. } => "SetupExperiment",
        Call::EnterInitializationMode => "EnterInitializationMode",
        Call::ExitInitializationMode => "ExitInitializationMode",
        Call::Terminate => "Terminate",
        Call::Reset => "Reset",
        Call::Replace => "FreeInstance",
        Call::Get(BaseType::Real, _) => "GetReal",
        Call::Get(BaseType::Integer, _) => "GetInteger",
        Call::Get(BaseType::Boolean, _) => "GetBoolean",
        Call::Get(BaseType::String, _) => "GetString",
        Call::Set(BaseType::Real, _) => "SetReal",
        Call::Set(BaseType::Integer, _) => "SetInteger",
        Call::Set(BaseType::Boolean, _) => "SetBoolean",
        Call::Set(BaseType::String, _) => "SetString",
        Call::GetState(_) => "GetFMUstate",
        Call::SetState(_) => "SetFMUstate",
        Call::FreeState(_) => "FreeFMUstate",
        Call::Serialize(_) => "SerializeFMUstate",
        Call::Deserialize(_) => "DeSerializeFMUstate",
        Call::SetInputDerivative { .. } => "SetRealInputDerivatives",
        Call::GetOutputDerivative { .. } => "GetRealOutputDerivatives",
        Call::DirectionalDerivative { .. } => "GetDirectionalDerivative",
        Call::DoStep { .. } => "DoStep",
        Call::CancelStep => "CancelStep",
        Call::GetStatus(_) => "GetStatus",
        Call::GetIntegerStatus(_) => "GetIntegerStatus",
        Call::GetStringStatus(_) => "GetStringStatus",
        Call::LastSuccessfulTime => "GetRealStatus",
        Call::Terminated => "GetBooleanStatus",
    }
}
