//! A few variables of AllTypes with their roles and limits, typed from its declarations.

use model_description::BaseType;
use std::sync::OnceLock;

use crate::support;

/// Content of a variable that is read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Content {
    /// The value that was set, or the start value.
    AsSet,
    /// The input or tunable parameter of this name, as the last computation saw it.
    Echo(&'static str),
    /// Not predicted here.
    Other,
}

/// One value of any base type.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Value {
    Real(f64),
    Integer(i32),
    Boolean(i32),
    Text(&'static str),
    /// A String that is not UTF-8.
    Bytes,
}

/// One variable.
#[derive(Clone, Copy, Debug)]
pub(super) struct Variable {
    pub name: &'static str,
    pub base: BaseType,
    /// causality, variability, initial
    pub role: (&'static str, &'static str, &'static str),
    pub start: Value,
    pub content: Content,
    /// Values that may be set; anything else is out of range.
    pub admits: fn(Value) -> bool,
}

use BaseType::{Boolean, Integer, Real, String as Text};
use Content::{AsSet, Echo, Other};

const PARAMETER: (&str, &str, &str) = ("parameter", "fixed", "exact");
const TUNABLE: (&str, &str, &str) = ("parameter", "tunable", "exact");
const INPUT: (&str, &str, &str) = ("input", "continuous", "");
const DISCRETE_INPUT: (&str, &str, &str) = ("input", "discrete", "");
const OUTPUT: (&str, &str, &str) = ("output", "continuous", "calculated");
const DISCRETE_OUTPUT: (&str, &str, &str) = ("output", "discrete", "calculated");

const fn row(
    name: &'static str,
    base: BaseType,
    role: (&'static str, &'static str, &'static str),
    start: Value,
    content: Content,
    admits: fn(Value) -> bool,
) -> Variable {
    Variable { name, base, role, start, content, admits }
}

/// By base type; the order within is free.
pub(super) const VARIABLES: &[Variable] = &[
    row("parameter.real", Real, PARAMETER, Value::Real(1.5), AsSet, bounded),
    row("tunable.real", Real, TUNABLE, Value::Real(2.5), AsSet, |v| real(v, 0.0, 10.0)),
    row("input.real", Real, INPUT, Value::Real(0.0), AsSet, |v| real(v, -1e6, 1e6)),
    row("input.discreteReal", Real, DISCRETE_INPUT, Value::Real(0.25), AsSet, bounded),
    row("end.time", Real, TUNABLE, Value::Real(1e6), AsSet, bounded),
    row("output.real", Real, OUTPUT, Value::Real(0.0), Echo("input.real"), finite),
    row("output.discreteReal", Real, DISCRETE_OUTPUT, Value::Real(0.0), Echo("input.discreteReal"), finite),
    row("echo.real", Real, DISCRETE_OUTPUT, Value::Real(0.0), Echo("tunable.real"), finite),
    row(
        "role.calculatedFixed",
        Real,
        ("calculatedParameter", "fixed", "calculated"),
        Value::Real(0.0),
        Other,
        finite,
    ),
    row(
        "role.calculatedApprox",
        Real,
        ("calculatedParameter", "fixed", "approx"),
        Value::Real(4.0),
        Other,
        finite,
    ),
    row("role.outputConstant", Real, ("output", "constant", "exact"), Value::Real(42.0), AsSet, finite),
    row("role.outputApprox", Real, ("output", "continuous", "approx"), Value::Real(0.5), Other, finite),
    row("role.localContinuous", Real, ("local", "continuous", "calculated"), Value::Real(0.0), Other, finite),
    row("role.localExact", Real, ("local", "continuous", "exact"), Value::Real(9.0), AsSet, finite),
    row("parameter.integer", Integer, PARAMETER, Value::Integer(-7), AsSet, |v| integer(v, -1000, 1000)),
    row("tunable.integer", Integer, TUNABLE, Value::Integer(8), AsSet, |v| integer(v, -10, 10)),
    row("tunable.choice", Integer, TUNABLE, Value::Integer(2), AsSet, colour),
    row("input.integer", Integer, DISCRETE_INPUT, Value::Integer(1), AsSet, |v| integer(v, -1000, 1000)),
    row("input.choice", Integer, DISCRETE_INPUT, Value::Integer(1), AsSet, colour),
    row("output.integer", Integer, DISCRETE_OUTPUT, Value::Integer(0), Echo("input.integer"), any),
    row("output.choice", Integer, DISCRETE_OUTPUT, Value::Integer(0), Echo("input.choice"), colour),
    row("echo.choice", Integer, DISCRETE_OUTPUT, Value::Integer(0), Echo("tunable.choice"), colour),
    row("role.localFixed", Integer, ("local", "fixed", "calculated"), Value::Integer(0), Other, any),
    row("role.outputExact", Integer, ("output", "discrete", "exact"), Value::Integer(100), Other, any),
    row("parameter.boolean", Boolean, PARAMETER, Value::Boolean(1), AsSet, boolean),
    row("tunable.boolean", Boolean, TUNABLE, Value::Boolean(0), AsSet, boolean),
    row("input.boolean", Boolean, DISCRETE_INPUT, Value::Boolean(0), AsSet, boolean),
    row("output.boolean", Boolean, DISCRETE_OUTPUT, Value::Boolean(0), Echo("input.boolean"), boolean),
    row("role.localTunable", Boolean, ("local", "tunable", "calculated"), Value::Boolean(0), Other, boolean),
    row("parameter.text", Text, PARAMETER, Value::Text("Grüße, 世界 <&\"'> 🛰"), AsSet, any),
    row("tunable.text", Text, TUNABLE, Value::Text("naïve café"), AsSet, any),
    row("input.text", Text, DISCRETE_INPUT, Value::Text(""), AsSet, any),
    row("output.text", Text, DISCRETE_OUTPUT, Value::Text(""), Echo("input.text"), any),
    row("role.localConstant", Text, ("local", "constant", "exact"), Value::Text("constant"), AsSet, any),
];

fn real(value: Value, min: f64, max: f64) -> bool {
    matches!(value, Value::Real(x) if (min..=max).contains(&x))
}

/// A Real that declares no limit.
fn bounded(value: Value) -> bool {
    real(value, -1e100, 1e100)
}

fn finite(value: Value) -> bool {
    matches!(value, Value::Real(x) if x.is_finite())
}

fn integer(value: Value, min: i32, max: i32) -> bool {
    matches!(value, Value::Integer(x) if (min..=max).contains(&x))
}

fn colour(value: Value) -> bool {
    matches!(value, Value::Integer(0 | 1 | 2 | 4))
}

fn boolean(value: Value) -> bool {
    matches!(value, Value::Boolean(0 | 1))
}

fn any(value: Value) -> bool {
    value != Value::Bytes
}

/// Position of a name in [`VARIABLES`].
pub(super) fn position(name: &str) -> usize {
    VARIABLES.iter().position(|variable| variable.name == name).unwrap()
}

/// The value reference of every row.
pub(super) fn references() -> &'static [u32] {
    static REFERENCES: OnceLock<Vec<u32>> = OnceLock::new();
    REFERENCES.get_or_init(|| {
        let names = support::names("AllTypes");
        VARIABLES.iter().map(|variable| names.typed(variable.base, variable.name)).collect()
    })
}

/// Row of the variable that each echo repeats, by row of the echo.
pub(super) fn echoes() -> &'static [Option<usize>] {
    static ECHOES: OnceLock<Vec<Option<usize>>> = OnceLock::new();
    ECHOES.get_or_init(|| {
        let source = |variable: &Variable| match variable.content {
            Echo(name) => Some(position(name)),
            AsSet | Other => None,
        };
        VARIABLES.iter().map(source).collect()
    })
}

impl Variable {
    /// Whether the note of a table's cell for `fmi2SetXXX` admits the variable (1.1, notes 1, 3 and 6).
    pub(super) fn settable(&self, note: char) -> bool {
        let (causality, variability, initial) = self.role;
        let constant = variability == "constant";
        match note {
            '1' => !constant && (initial == "exact" || initial == "approx"),
            '3' => !constant && (initial == "exact" || causality == "input"),
            '6' => causality == "input" || (causality == "parameter" && variability == "tunable"),
            _ => false,
        }
    }

    /// Whether it is an input, which our FMUs accept before Initialization Mode too.
    pub(super) fn is_input(&self) -> bool {
        self.role.0 == "input"
    }

    /// Whether the description has a start value for it (2.2.7).
    pub(super) fn has_start(&self) -> bool {
        self.is_input() || matches!(self.role.2, "exact" | "approx")
    }
}
