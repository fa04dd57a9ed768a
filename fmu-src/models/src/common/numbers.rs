//! Parameters with defaults taken from a body or an orbit.

use fmi_export::{Elements, Given, Real, Values};

/// A parameter with the number of a `T` that it is.
pub(crate) type Number<T> = (Real, fn(&mut T) -> &mut f64);

/// Group of parameters with defaults from one body.
pub(crate) struct Numbers<T, const N: usize>(pub [Number<T>; N]);

impl<T: Copy, const N: usize> Numbers<T, N> {
    /// They follow the body together.
    pub(crate) fn group(&self) -> [Elements; N] {
        self.0.map(|(parameter, _)| parameter.into())
    }

    /// Values set by the importer, otherwise those of `own`.
    pub(crate) fn read_or(&self, given: Given<'_>, own: &T) -> T {
        let mut read = *own;
        for (parameter, number) in self.0 {
            let number = number(&mut read);
            *number = given.real_or(parameter, *number);
        }
        read
    }

    /// Writes these numbers.
    pub(crate) fn write(&self, values: &mut Values, mut written: T) {
        for (parameter, number) in self.0 {
            values.set_real(parameter, *number(&mut written));
        }
    }
}
