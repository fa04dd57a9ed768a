//! Taylor series in time over a segment of motion: how many terms, their values and products.

/// Highest order of the series.
pub(super) const ORDER: usize = 10;
/// Coefficients.
pub(super) const TERMS: usize = ORDER + 1;

/// Value of a polynomial.
pub(super) fn polynomial(terms: &[f64], at: f64) -> f64 {
    terms.iter().rev().fold(0.0, |sum, term| sum * at + term)
}

/// Coefficient `j` of a product.
pub(super) fn product(a: &[f64; TERMS], b: &[f64; TERMS], j: usize) -> f64 {
    a[..=j].iter().zip(b[..=j].iter().rev()).map(|(x, y)| x * y).sum()
}
