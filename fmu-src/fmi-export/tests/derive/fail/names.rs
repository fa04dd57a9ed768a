//! Names are structured and single, and everything is described.

use fmi_export::{Real, RealVector, Variables};

#[derive(Variables)]
struct Names {
    #[output(unit = "1")]
    undescribed: Real,
    ///
    #[output(unit = "1")]
    blank: Real,
    /// The first of two.
    #[output(unit = "1")]
    sun_angle: Real,
    /// The second of two.
    #[output(unit = "1", name = "sunAngle")]
    other: Real,
    /// Ill-formed.
    #[output(unit = "1", name = "sun angle")]
    spaced: Real,
    /// An index on top of the vector's own.
    #[output(unit = "1", name = "x[1]")]
    vector: RealVector<3>,
    /// Only groups may be without name.
    #[output(unit = "1", name = "")]
    nameless: Real,
    #[group(name = "2nd")]
    prefix: Inner,
    #[group(name = "", count = 2)]
    counted: Vec<Inner>,
}

#[derive(Variables)]
struct Inner {}

fn main() {}
