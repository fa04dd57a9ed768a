//! Literal limits, start and nominal values must be in order.

use fmi_export::{Integer, Real, RealMatrix, RealVector, Variables};

#[derive(Variables)]
struct UnorderedLimits {
    /// Start below min.
    #[parameter(unit = "kg", min = 0.0, start = -1.0)]
    below: Real,
    /// One element above max.
    #[parameter(unit = "m", max = 1.5, start = [0.0, 2.0, 1.0])]
    above: RealVector<3>,
    /// All elements above max.
    #[parameter(unit = "m", max = 1, start = [[2.0; 2]; 2])]
    matrix: RealMatrix<2, 2>,
    /// Min above max.
    #[output(min = 5, max = 4)]
    empty: Integer,
    /// A nominal value of zero.
    #[output(unit = "1", nominal = 0.0)]
    nominal: Real,
}

fn main() {}
