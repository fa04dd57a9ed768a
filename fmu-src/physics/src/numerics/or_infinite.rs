//! Serde of a time or length that may be infinite, for states whose floats are finite: `#[serde(with = "or_infinite")]`.

use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A number, or the infinity it is.
#[derive(Serialize, Deserialize)]
enum Extended {
    Finite(f64),
    Infinite,
    NegativeInfinite,
}

/// Writes `value`, an infinity by its name.
///
/// # Errors
/// The serializer's.
pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
    let extended = match *value {
        f64::INFINITY => Extended::Infinite,
        f64::NEG_INFINITY => Extended::NegativeInfinite,
        finite => Extended::Finite(finite),
    };
    extended.serialize(serializer)
}

/// Reads what [`serialize`] wrote.
///
/// # Errors
/// The deserializer's.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(match Extended::deserialize(deserializer)? {
        Extended::Finite(value) => value,
        Extended::Infinite => f64::INFINITY,
        Extended::NegativeInfinite => f64::NEG_INFINITY,
    })
}
