//! A number whose elementary functions are those of [`crate::math`], for a library that takes any number.
//!
//! The library computes the cosines of the day of the year in plain numbers; the FMU's shared library links its own cosine for them
//! (`component/trigonometry.rs`).

use core::fmt;
use core::iter::{Product, Sum};
use core::ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Rem, RemAssign, Sub, SubAssign};

use num_dual::{DualNum, DualStruct, Mappable};
use num_traits::{FromPrimitive, Inv, Num, One, ParseFloatError, Signed, Zero};

use crate::math;

/// A number.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(super) struct Portable(f64);

impl From<f64> for Portable {
    fn from(value: f64) -> Self {
        Self(value)
    }
}

impl From<&Portable> for Portable {
    fn from(number: &Portable) -> Self {
        *number
    }
}

impl From<Portable> for f64 {
    fn from(number: Portable) -> Self {
        number.0
    }
}

impl fmt::Display for Portable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.fmt(f)
    }
}

macro_rules! operators {
    ($($trait:ident $method:ident $assign:ident $assign_method:ident),+) => {$(
        impl<R: Into<Portable>> $trait<R> for Portable {
            type Output = Self;
            fn $method(self, other: R) -> Self {
                Self($trait::$method(self.0, other.into().0))
            }
        }
        impl<R: Into<Portable>> $assign<R> for Portable {
            fn $assign_method(&mut self, other: R) {
                $assign::$assign_method(&mut self.0, other.into().0);
            }
        }
    )+};
}

operators! {
    Add add AddAssign add_assign, Sub sub SubAssign sub_assign, Mul mul MulAssign mul_assign,
    Div div DivAssign div_assign, Rem rem RemAssign rem_assign
}

impl Neg for Portable {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl PartialEq<f64> for Portable {
    fn eq(&self, other: &f64) -> bool {
        self.0 == *other
    }
}

impl PartialOrd<f64> for Portable {
    fn partial_cmp(&self, other: &f64) -> Option<core::cmp::Ordering> {
        self.0.partial_cmp(other)
    }
}

impl Sum for Portable {
    fn sum<I: Iterator<Item = Self>>(numbers: I) -> Self {
        Self(numbers.map(|it| it.0).sum())
    }
}

impl Product for Portable {
    fn product<I: Iterator<Item = Self>>(numbers: I) -> Self {
        Self(numbers.map(|it| it.0).product())
    }
}

impl Zero for Portable {
    fn zero() -> Self {
        Self(0.0)
    }
    fn is_zero(&self) -> bool {
        self.0 == 0.0
    }
}

impl One for Portable {
    fn one() -> Self {
        Self(1.0)
    }
}

impl Num for Portable {
    type FromStrRadixErr = ParseFloatError;
    fn from_str_radix(text: &str, radix: u32) -> Result<Self, ParseFloatError> {
        f64::from_str_radix(text, radix).map(Self)
    }
}

impl Signed for Portable {
    fn abs(&self) -> Self {
        Self(self.0.abs())
    }
    fn abs_sub(&self, other: &Self) -> Self {
        Self((self.0 - other.0).max(0.0))
    }
    fn signum(&self) -> Self {
        Self(self.0.signum())
    }
    fn is_positive(&self) -> bool {
        self.0 > 0.0
    }
    fn is_negative(&self) -> bool {
        self.0 < 0.0
    }
}

impl Inv for Portable {
    type Output = Self;
    fn inv(self) -> Self {
        Self(1.0 / self.0)
    }
}

impl FromPrimitive for Portable {
    fn from_i64(value: i64) -> Option<Self> {
        Some(Self(value as f64))
    }
    fn from_u64(value: u64) -> Option<Self> {
        Some(Self(value as f64))
    }
    fn from_f64(value: f64) -> Option<Self> {
        Some(Self(value))
    }
}

impl DualStruct for Portable {
    type Real = f64;
    type Inner = f64;
    fn re(&self) -> f64 {
        self.0
    }
    fn from_inner(inner: &f64) -> Self {
        Self(*inner)
    }
}

impl Mappable<Self> for Portable {
    type Output<O> = O;
    fn map_dual<M: Fn(Self) -> O, O>(self, f: M) -> O {
        f(self)
    }
}

macro_rules! functions {
    ($($name:ident = $function:expr;)+) => {$(
        fn $name(&self) -> Self {
            let function: fn(f64) -> f64 = $function;
            Self(function(self.0))
        }
    )+};
}

impl DualNum for Portable {
    type Primitive = f64;
    type InnerDual = f64;
    const NDERIV: usize = 0;

    fn from_re(re: f64) -> Self {
        Self(re)
    }
    fn scale(self, factor: &f64) -> Self {
        Self(self.0 * factor)
    }
    fn powi(&self, n: i32) -> Self {
        Self(math::powi(self.0, n))
    }
    fn powf(&self, n: f64) -> Self {
        Self(math::powf(self.0, n))
    }
    fn log(&self, base: f64) -> Self {
        Self(math::ln(self.0) / math::ln(base))
    }
    fn sin_cos(&self) -> (Self, Self) {
        let (sin, cos) = math::sin_cos(self.0);
        (Self(sin), Self(cos))
    }
    fn atan2(&self, other: Self) -> Self {
        Self(math::atan2(self.0, other.0))
    }
    functions! {
        recip = |x| 1.0 / x;
        sqrt = f64::sqrt;
        cbrt = math::cbrt;
        exp = math::exp;
        exp2 = |x| math::powf(2.0, x);
        exp_m1 = math::exp_m1;
        ln = math::ln;
        log2 = math::log2;
        log10 = |x| math::ln(x) / core::f64::consts::LN_10;
        ln_1p = math::ln_1p;
        sin = math::sin;
        cos = math::cos;
        tan = math::tan;
        asin = math::asin;
        acos = math::acos;
        atan = math::atan;
        sinh = math::sinh;
        cosh = math::cosh;
        tanh = |x| math::sinh(x) / math::cosh(x);
        asinh = math::asinh;
        acosh = |x| math::ln(x + (x * x - 1.0).sqrt());
        atanh = math::atanh;
        sph_j0 = |x| if x == 0.0 { 1.0 } else { math::sin(x) / x };
        sph_j1 = |x| if x == 0.0 { 0.0 } else { (math::sin(x) / x - math::cos(x)) / x };
        sph_j2 = |x| if x == 0.0 { 0.0 } else { (3.0 / (x * x) - 1.0) * math::sin(x) / x - 3.0 * math::cos(x) / (x * x) };
    }
}
