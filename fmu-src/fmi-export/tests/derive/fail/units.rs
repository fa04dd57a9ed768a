//! Units come from the unit table, and only Reals have them.

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Text, Variables};

#[derive(Variables)]
struct Units {
    /// Not in the table.
    #[output(unit = "furlong")]
    unknown: Real,
    /// A display unit of something else.
    #[output(unit = "rad", display = "km")]
    other: RealVector<3>,
    /// A unit without display units.
    #[output(unit = "kg", display = "g")]
    none: Real,
    /// No unit at all.
    #[output]
    missing: Real,
    /// Integers have no unit.
    #[output(unit = "m")]
    integer: Integer,
    /// Nor has a text a display unit.
    #[output(display = "km")]
    text: Text,
    /// Nor a Boolean a nominal value.
    #[output(nominal = 1.0)]
    boolean: Boolean,
    /// Nor a choice limits.
    #[output(min = 1)]
    choice: Choice<u8>,
}

fn main() {}
