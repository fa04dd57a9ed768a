//! Names and values that a study sets, and how it writes numbers.

use loader::Value;

use crate::vector::Vector;

/// Names and values to be set.
pub(crate) type Settings = Vec<(String, Value)>;

/// A vector's elements as settings.
pub(crate) fn vector_setting(name: &str, v: &Vector) -> Settings {
    (0..3).map(|i| (format!("{name}[{}]", i + 1), Value::Real(v[i]))).collect()
}

/// A quaternion's elements as settings.
pub(crate) fn quaternion_setting(name: &str, q: &[f64; 4]) -> Settings {
    (0..4).map(|i| (format!("{name}[{}]", i + 1), Value::Real(q[i]))).collect()
}

/// A Real as a setting.
pub(crate) fn real(name: &str, value: f64) -> (String, Value) {
    (name.to_owned(), Value::Real(value))
}

/// An Integer or the number of an option as a setting.
pub(crate) fn number(name: &str, value: i32) -> (String, Value) {
    (name.to_owned(), Value::Integer(value))
}

/// A Boolean as a setting.
pub(crate) fn flag(name: &str, value: bool) -> (String, Value) {
    (name.to_owned(), Value::Boolean(value))
}

/// All digits that a number has.
pub(crate) fn digits(x: f64) -> String {
    format!("{x:?}")
}
