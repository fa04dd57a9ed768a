//! Values as a file writes them, which stand for values in SI units.

/// Value as a file writes it, which stands for a value in SI units.
pub trait Written: Copy {
    /// Type in which a default is declared.
    type Plain;
    /// Type of the value in SI units.
    type Value;

    /// Returns the written form of a default.
    fn from_plain(plain: Self::Plain) -> Self;

    /// Returns the value in SI units.
    fn value(self) -> Self::Value;
}

/// Types that are written as they are used.
macro_rules! plain {
    ($($type:ty),+) => {$(
        impl $crate::toml::written::Written for $type {
            type Plain = Self;
            type Value = Self;

            fn from_plain(plain: Self) -> Self {
                plain
            }

            fn value(self) -> Self {
                self
            }
        }
    )+};
}

pub(crate) use plain;

plain!(bool, i64, f64);

impl<W: Written, const N: usize> Written for [W; N] {
    type Plain = [W::Plain; N];
    type Value = [W::Value; N];

    fn from_plain(plain: Self::Plain) -> Self {
        plain.map(W::from_plain)
    }

    fn value(self) -> Self::Value {
        self.map(W::value)
    }
}

impl<W: Written> Written for Option<W> {
    type Plain = Option<W::Plain>;
    type Value = Option<W::Value>;

    fn from_plain(plain: Self::Plain) -> Self {
        plain.map(W::from_plain)
    }

    fn value(self) -> Self::Value {
        self.map(W::value)
    }
}
