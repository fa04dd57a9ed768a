//! Elementary functions of the crate `libm`: the same bits on every platform.
//!
//! IEEE 754 fixes the rounding of the four operations, of the square root and of the fused multiply-add, but not that
//! of these functions: each system's library rounds them in its own way. All code inside the FMU calls them here
//! (`clippy::disallowed_methods` holds it so), and nalgebra takes them from `libm` as well (its feature `libm-force`).

use core::f64::consts::{PI, TAU};

macro_rules! functions {
    ($($(#[$meta:meta])* $name:ident($($argument:ident),+) = $of_libm:ident;)+) => {$(
        $(#[$meta])*
        #[inline]
        #[must_use]
        pub fn $name($($argument: f64),+) -> f64 {
            libm::$of_libm($($argument),+)
        }
    )+};
}

functions! {
    /// Sine of an angle in rad.
    sin(angle_rad) = sin;
    /// Cosine of an angle in rad.
    cos(angle_rad) = cos;
    /// Tangent of an angle in rad.
    tan(angle_rad) = tan;
    /// Angle in [-pi/2, pi/2] with the sine `x`, in rad.
    asin(x) = asin;
    /// Angle in [0, pi] with the cosine `x`, in rad.
    acos(x) = acos;
    /// Angle in (-pi/2, pi/2) with the tangent `x`, in rad.
    atan(x) = atan;
    /// Angle in (-pi, pi] from the x axis to (x, y), in rad.
    atan2(y, x) = atan2;
    /// Hyperbolic sine.
    sinh(x) = sinh;
    /// Hyperbolic cosine.
    cosh(x) = cosh;
    /// Inverse of the hyperbolic sine.
    asinh(x) = asinh;
    /// Inverse of the hyperbolic tangent.
    atanh(x) = atanh;
    /// e to the power `x`.
    exp(x) = exp;
    /// e to the power `x`, less 1.
    exp_m1(x) = expm1;
    /// Natural logarithm.
    ln(x) = log;
    /// Natural logarithm of 1 + `x`.
    ln_1p(x) = log1p;
    /// Logarithm to the base 2.
    log2(x) = log2;
    /// `base` to a real power.
    powf(base, exponent) = pow;
    /// Length of (x, y).
    hypot(x, y) = hypot;
    /// Cube root.
    cbrt(x) = cbrt;
    /// Complement of the error function, 2 / sqrt(pi) times the integral of e^(-t^2) from `x` on.
    erfc(x) = erfc;
}

/// Cube root to 24 bits of a number within the range of `f32`.
#[inline]
#[must_use]
pub fn cbrt_approximate(x: f64) -> f64 {
    f64::from(libm::cbrtf(x as f32))
}

/// Sine and cosine of an angle in rad.
#[inline]
#[must_use]
pub fn sin_cos(angle_rad: f64) -> (f64, f64) {
    libm::sincos(angle_rad)
}

/// The greatest integer not above `x`, saturated at 64 bits. `f64::floor` is a function call on baseline x86-64.
#[inline]
#[must_use]
pub fn floor(x: f64) -> i64 {
    let whole = x as i64;
    whole.saturating_sub(i64::from(x < whole as f64))
}

/// The nearest integer, ties upward. `f64::round` is a function call on baseline x86-64.
#[inline]
#[must_use]
pub fn nearest_integer(x: f64) -> f64 {
    // Doubles above 2^52 are integers.
    if x.abs() < 4_503_599_627_370_496.0 { floor(x + 0.5) as f64 } else { x }
}

/// The angle in -pi..pi.
#[inline]
#[must_use]
pub fn wrapped_rad(angle_rad: f64) -> f64 {
    if angle_rad.abs() <= PI { angle_rad } else { angle_rad - TAU * nearest_integer(angle_rad / TAU) }
}

/// `base` to a whole power, by repeated squaring: the compiler's own leaves open in which order it multiplies.
#[inline]
#[must_use]
pub fn powi(base: f64, exponent: i32) -> f64 {
    let (mut power, mut square, mut left) = (1.0, base, exponent.unsigned_abs());
    while left > 0 {
        if left & 1 == 1 {
            power *= square;
        }
        left >>= 1;
        if left > 0 {
            square *= square;
        }
    }
    if exponent < 0 { 1.0 / power } else { power }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_powers_of_two_are_exact() {
        for exponent in -1000..1000 {
            assert_eq!(powi(2.0, exponent).log2(), f64::from(exponent), "{exponent}");
        }
        assert_eq!([powi(-3.0, 3), powi(5.0, 0), powi(0.0, -1)], [-27.0, 1.0, f64::INFINITY]);
    }

    #[test]
    fn floor_and_nearest_integer_are_those_of_the_standard_library() {
        for x in
            [0.0, 0.3, 0.7, 1.0, 1e6 + 0.4, 4_503_599_627_370_497.0, 1e18].map(|x| [x, -x]).as_flattened()
        {
            assert_eq!(floor(*x), x.floor() as i64, "{x}");
            assert_eq!(nearest_integer(*x), x.round(), "{x}");
        }
        assert_eq!([-1.5, -0.5, 0.5, 1.5].map(nearest_integer), [-1.0, 0.0, 1.0, 2.0]);
        let extremes = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].map(floor);
        assert_eq!(extremes, [0, i64::MAX, i64::MIN]);
        assert!(nearest_integer(f64::NAN).is_nan());
    }

    #[test]
    fn functions_agree_with_those_of_the_system() {
        type OfSystem = fn(f64) -> f64;
        let pairs: [(OfSystem, OfSystem); 16] = [
            (sin, f64::sin),
            (cos, f64::cos),
            (tan, f64::tan),
            (asin, f64::asin),
            (acos, f64::acos),
            (atan, f64::atan),
            (sinh, f64::sinh),
            (cosh, f64::cosh),
            (asinh, f64::asinh),
            (exp, f64::exp),
            (exp_m1, f64::exp_m1),
            (ln, f64::ln),
            (ln_1p, f64::ln_1p),
            (log2, f64::log2),
            (cbrt, f64::cbrt),
            (atanh, f64::atanh),
        ];
        for k in 1..1000 {
            let x = f64::from(k) / 1000.0;
            for (index, (ours, systems)) in pairs.iter().enumerate() {
                let (found, expected) = (ours(x), systems(x));
                // Three units in the last place.
                assert!(
                    (found - expected).abs() <= 7e-16 * expected.abs(),
                    "{index} of {x}: {found} {expected}"
                );
            }
            assert_eq!(sin_cos(x), (sin(x), cos(x)));
        }
    }
}
