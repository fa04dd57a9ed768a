//! FMI's status codes.

use crate::words::words;

words! {
    /// Status that an FMI function returns (2.1.3); the discriminants are the C values.
    #[repr(i32)]
    pub enum Status, name {
        /// Done.
        Ok = 0 => "fmi2OK",
        /// Done, with a message in the log.
        Warning = 1 => "fmi2Warning",
        /// Not done (a value out of range, a step given up, a status that cannot be given); the instance stays usable.
        Discard = 2 => "fmi2Discard",
        /// Not done, and the instance is in the error state.
        Error = 3 => "fmi2Error",
        /// No instance of the FMU can be used any more.
        Fatal = 4 => "fmi2Fatal",
        /// Still running.
        Pending = 5 => "fmi2Pending",
    }
}

impl Status {
    /// The value at the C interface.
    pub const fn code(self) -> i32 {
        self as i32
    }

    /// The status of a C value, if it is one.
    pub fn from_code(code: i32) -> Option<Self> {
        usize::try_from(code).ok().and_then(|index| Self::ALL.get(index)).copied()
    }
}
