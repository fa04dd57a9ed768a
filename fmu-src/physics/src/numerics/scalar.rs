//! The number type of the radiation kernels: a plain `f64`, or a dual number that carries one exact derivative.
//!
//! This module is the only one that knows the dual-number library.

use core::ops::{Add, Div, Mul, Sub};

use nalgebra::{RealField, Vector3};

use crate::math;

/// A number with its derivative along one seed direction: `Dual64::new(value, derivative)`.
///
/// Comparisons look at the value only, so that a kernel takes the same branches as with plain numbers. The
/// rounding functions (`floor`, `round` ...) have no derivative and must not be called in generic kernels.
pub use num_dual::Dual64;

/// Scalar of the radiation kernels: real arithmetic, also directly with `f64` on the right-hand side.
pub trait Scalar:
    RealField
    + Copy
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// A number that does not depend on the seed.
    fn constant(value: f64) -> Self;

    /// The number without its derivative.
    fn value(self) -> f64;

    /// Whether two numbers agree, derivatives included.
    fn same(self, other: Self) -> bool;

    /// A function of this number by its value and, where the number carries a derivative, its slope.
    fn chain(self, value: f64, slope: impl FnOnce() -> f64) -> Self;

    /// Angle in (-pi, pi] from the x axis to the direction (x, y), in rad. Its derivative is finite in every direction;
    /// the origin has none and counts as one that stays. (That of `atan2` divides y by x.)
    fn polar_angle(y: Self, x: Self) -> Self;
}

/// Defines scratch space over scalars, which need no default of their own: all of it starts empty.
macro_rules! scratch {
    ($(#[$attribute:meta])* $visibility:vis struct $name:ident<T: Scalar> {
        $($(#[$of_field:meta])* $field_visibility:vis $field:ident: $type:ty,)+
    }) => {
        $(#[$attribute])*
        #[derive(Clone, Debug)]
        $visibility struct $name<T: Scalar> {
            $($(#[$of_field])* $field_visibility $field: $type,)+
        }

        impl<T: Scalar> Default for $name<T> {
            fn default() -> Self {
                Self { $($field: Default::default(),)+ }
            }
        }
    };
}
pub(crate) use scratch;

impl Scalar for f64 {
    #[inline]
    fn constant(value: f64) -> Self {
        value
    }

    #[inline]
    fn value(self) -> f64 {
        self
    }

    #[inline]
    fn same(self, other: Self) -> bool {
        self == other
    }

    #[inline]
    fn chain(self, value: f64, _: impl FnOnce() -> f64) -> Self {
        value
    }

    #[inline]
    fn polar_angle(y: Self, x: Self) -> Self {
        math::atan2(y, x)
    }
}

impl Scalar for Dual64 {
    #[inline]
    fn constant(value: f64) -> Self {
        Self::from_re(value)
    }

    #[inline]
    fn value(self) -> f64 {
        self.re
    }

    #[inline]
    fn same(self, other: Self) -> bool {
        self.re == other.re && self.eps == other.eps
    }

    #[inline]
    fn chain(self, value: f64, slope: impl FnOnce() -> f64) -> Self {
        Self::new(value, slope() * self.eps)
    }

    #[inline]
    fn polar_angle(y: Self, x: Self) -> Self {
        let squared = x.re * x.re + y.re * y.re;
        let slope = if squared > 0.0 { (x.re * y.eps - y.re * x.eps) / squared } else { 0.0 };
        Self::new(math::atan2(y.re, x.re), slope)
    }
}

/// Elementary functions of [`crate::math`], each with its slope by the number and the function there.
macro_rules! functions {
    ($($(#[$doc:meta])* $name:ident: |$number:pat_param, $function:pat_param| $slope:expr;)+) => {$(
        $(#[$doc])*
        #[inline]
        pub fn $name<T: Scalar>(x: T) -> T {
            let value = math::$name(x.value());
            let ($number, $function) = (x.value(), value);
            x.chain(value, || $slope)
        }
    )+};
}

functions! {
    /// e to the power `x`.
    exp: |_, exp| exp;
    /// Natural logarithm.
    ln: |x, _| 1.0 / x;
    /// Angle in [-pi/2, pi/2] with the sine `x`, in rad.
    asin: |x, _| 1.0 / (1.0 - x * x).sqrt();
    /// Angle in [0, pi] with the cosine `x`, in rad.
    acos: |x, _| -1.0 / (1.0 - x * x).sqrt();
    /// Angle in (-pi/2, pi/2) with the tangent `x`, in rad.
    atan: |x, _| 1.0 / (1.0 + x * x);
    /// Sine of an angle in rad.
    sin: |x, _| math::cos(x);
    /// Cosine of an angle in rad.
    cos: |x, _| -math::sin(x);
    /// Tangent of an angle in rad.
    tan: |_, tan| 1.0 + tan * tan;
}

/// Sine and cosine of an angle in rad.
#[inline]
pub fn sin_cos<T: Scalar>(angle_rad: T) -> (T, T) {
    let (sin, cos) = math::sin_cos(angle_rad.value());
    (angle_rad.chain(sin, || cos), angle_rad.chain(cos, || -sin))
}

/// A constant vector as kernel numbers.
#[inline]
pub fn constant_vector<T: Scalar>(vector: &Vector3<f64>) -> Vector3<T> {
    vector.map(T::constant)
}

/// The values of a vector of kernel numbers.
#[inline]
pub fn vector_value<T: Scalar>(vector: &Vector3<T>) -> Vector3<f64> {
    vector.map(T::value)
}

#[cfg(test)]
mod tests {
    //! Derivatives carried along agree with derivatives known in closed form.

    use nalgebra::ComplexField;

    use super::*;

    fn length_of_sum<T: Scalar>(x: T) -> T {
        let v = Vector3::new(x, x * x, T::constant(2.0)) * (x.sin() + 1.0);
        v.dot(&v).sqrt() / 3.0 - 1.0
    }

    #[test]
    fn plain_and_dual_numbers_take_the_same_values() {
        for x in [-2.0, -0.3, 0.1, 1.7] {
            let dual = length_of_sum(Dual64::new(x, 1.0));
            assert_eq!(dual.value(), length_of_sum(x));
        }
    }

    #[test]
    fn the_derivative_of_a_cube_is_three_squares() {
        let x = Dual64::new(1.5, 1.0);
        assert_eq!((x * x * x).eps, 3.0 * 1.5 * 1.5);
        assert_eq!(Dual64::constant(4.0).eps, 0.0);
    }

    /// On the unit circle the angle is the arc's length, whichever axis the direction lies on.
    #[test]
    fn a_polar_angle_grows_with_the_arc_everywhere() {
        for eighth in 0..8 {
            let angle = f64::from(eighth) * core::f64::consts::FRAC_PI_4 - 3.0;
            let arc = Dual64::new(angle, 0.5);
            let found = Dual64::polar_angle(arc.sin() * 3.0, arc.cos() * 3.0);
            assert!((found.re - angle).abs() < 4e-15 && (found.eps - 0.5).abs() < 4e-15, "{found}");
        }
        for (y, x) in [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)] {
            let found = Dual64::polar_angle(Dual64::new(y, x), Dual64::new(x, -y));
            assert_eq!((found.re, found.eps), (f64::polar_angle(y, x), 1.0), "y {y}, x {x}");
        }
        assert_eq!(Dual64::polar_angle(Dual64::new(0.0, 1.0), Dual64::new(0.0, 1.0)).eps, 0.0);
    }

    #[test]
    fn comparisons_look_at_the_value_only() {
        assert!(Dual64::new(1.0, 5.0) == Dual64::new(1.0, -5.0));
        assert!(Dual64::new(1.0, 5.0) < Dual64::new(2.0, -5.0));
        assert!(!Dual64::new(1.0, 5.0).same(Dual64::new(1.0, -5.0)));
        assert!(Dual64::new(1.0, 5.0).same(Dual64::new(1.0, 5.0)));
    }
}
