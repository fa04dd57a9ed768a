//! Causality, variability, initial and start must fit each other.

use fmi_export::{Integer, Real, Text, Variables};

#[derive(Variables)]
struct Roles {
    /// An illegal pair.
    #[parameter(continuous, unit = "1", start = 0.0)]
    pair: Real,
    /// An illegal initial.
    #[parameter(initial = calculated, unit = "1")]
    initial_of_parameter: Real,
    /// An initial where none may be.
    #[input(initial = exact, unit = "1", start = 0.0)]
    initial_of_input: Real,
    /// A word that is none.
    #[output(initial = random, unit = "1")]
    word: Real,
    /// Only Reals are continuous.
    #[output(continuous)]
    count: Integer,
    /// A parameter without start.
    #[parameter]
    label: Text,
    /// An input without start.
    #[input(unit = "1")]
    input: Real,
    /// An output with a start.
    #[output(unit = "1", start = 1.0)]
    output: Real,
}

fn main() {}
