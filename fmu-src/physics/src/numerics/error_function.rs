//! Repeated integrals of the complementary error function, without cancellation.
//!
//! Equation: i0 = erfc, i(n) = int from y to infinity of i(n-1); i(n-1) = -d i(n) / dy.
//! Method: up to y = 1.5 by erfc itself; from there the ratios r(n) = i(n) / i(n-1) by their continued fraction
//! r(n) = 1 / (2 (y + (n + 1) r(n+1))), all of whose terms are positive, from i(-1) = 2 / sqrt(pi) e^(-y^2).
//! Error measure: relative, below 1e-14 for y up to 1.5 and 2e-16 (8 + y^2) beyond, where the exponential's argument is rounded.
//! Reference: Gautschi, Recursive computation of the repeated integrals of the error function, Math. Comp. 15, 1961;
//! Abramowitz and Stegun 7.2.

use core::f64::consts::{FRAC_2_SQRT_PI, PI};

use crate::math;

/// From here on the closed forms lose digits to cancellation.
const FRACTION_FROM: f64 = 1.5;

/// erfc, its integral from `y` to infinity, and the integral of that.
pub fn repeated_erfc(y: f64) -> [f64; 3] {
    if y < FRACTION_FROM {
        let erfc = math::erfc(y);
        let bell = math::exp(-y * y) / PI.sqrt();
        return [erfc, bell - y * erfc, ((0.5 + y * y) * erfc - y * bell) * 0.5];
    }
    // So many levels leave nothing below a double's last bits.
    let levels = 10 + (240.0 / (y * y)) as u32;
    let mut ratios = [0.0; 3];
    for n in (0..=levels).rev() {
        let ratio = 0.5 / (y + f64::from(n + 1) * ratios[0]);
        ratios = [ratio, ratios[0], ratios[1]];
    }
    let first = FRAC_2_SQRT_PI * math::exp(-y * y) * ratios[0];
    let second = first * ratios[1];
    [first, second, second * ratios[2]]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By mpmath with 60 digits.
    const KNOWN: [[f64; 4]; 15] = [
        [-9.0, 2.0, 18.0, 81.5],
        [-2.5, 1.999593047982555, 5.000071762071564, 6.7499879645850935],
        [-0.25, 1.276326390168237, 0.8490886622301164, 0.4252176803208238],
        [0.0, 1.0, 0.5641895835477563, 0.25],
        [0.5, 0.4795001221869535, 0.19964122837424567, 0.06996472345317695],
        [1.0, 0.15729920705028513, 0.05025454166001222, 0.014197530932565173],
        [1.75, 0.013328328780817557, 0.003062922598644464, 0.0006520249213904831],
        [1.9999, 0.004679802092970608, 0.000978490591798306, 0.00019150885597393608],
        [2.0, 0.004677734981047266, 0.0009780227149514952, 0.0001914110303103212],
        [2.5, 0.0004069520174449589, 7.176207156395751e-05, 1.2035414906292846e-05],
        [3.5, 7.430983723414128e-07, 9.886908549744665e-08, 1.2753693464821555e-08],
        [5.0, 1.537459794428035e-12, 1.481342933684934e-13, 1.4029215185775204e-14],
        [7.5, 2.776649386030569e-26, 1.8195649534567443e-27, 1.1825488961363195e-28],
        [12.0, 1.3562611692059042e-64, 5.612508902316952e-66, 2.314758162458956e-67],
        [26.0, 5.663192408856143e-296, 1.0874703305376301e-297, 2.086672515116688e-299],
    ];

    #[test]
    fn repeated_integrals_agree_with_sixty_digits() {
        for [y, expected @ ..] in KNOWN {
            for (found, expected) in repeated_erfc(y).into_iter().zip(expected) {
                let bound = if y < FRACTION_FROM { 1e-14 } else { 2e-16 * (8.0 + y * y) };
                assert!((found / expected - 1.0).abs() < bound, "{y}: {found} {expected}");
            }
        }
    }
}
