//! Every field is declared once, with items that exist, on a type that can be declared.

use fmi_export::{Real, Variables};

#[derive(Variables)]
struct Fields {
    /// Not declared.
    undeclared: Real,
    /// Declared twice.
    #[input(unit = "1", start = 0.0)]
    #[output(unit = "1")]
    twice: Real,
    /// An item that does not exist.
    #[output(unit = "1", colour = "red")]
    colour: Real,
    /// An item given twice.
    #[output(unit = "1", unit = "m")]
    units: Real,
    /// Two variabilities.
    #[parameter(fixed, tunable, unit = "1", start = 0.0)]
    variabilities: Real,
    /// Not a variable.
    #[output(unit = "1")]
    float: f64,
    #[group]
    uncounted: Vec<Inner>,
    #[group(count = 2)]
    counted: Inner,
    #[group(length = 2)]
    length: Vec<Inner>,
}

#[derive(Variables)]
#[variables(type = Spacecraft)]
struct Inner {}

#[derive(Variables)]
struct Tuple(Real);

#[derive(Variables)]
enum Either {}

fn main() {}
