//! FMI's status codes.

/// What an FMI function answers (2.1.3); the discriminants are the C values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(i32)]
pub enum Status {
    /// Done.
    Ok = 0,
    /// Done, with a message in the log.
    Warning = 1,
    /// Not done (a value out of range, a step given up, a status that cannot be given); the instance stays usable.
    Discard = 2,
    /// Not done, and the instance is in the error state.
    Error = 3,
    /// No instance of the FMU can be used any more.
    Fatal = 4,
    /// Still running.
    Pending = 5,
}

impl Status {
    /// Every status, by C value.
    pub const ALL: [Self; 6] =
        [Self::Ok, Self::Warning, Self::Discard, Self::Error, Self::Fatal, Self::Pending];

    /// The value at the C interface.
    pub const fn code(self) -> i32 {
        self as i32
    }

    /// The status of a C value, if it is one.
    pub fn from_code(code: i32) -> Option<Self> {
        usize::try_from(code).ok().and_then(|index| Self::ALL.get(index)).copied()
    }
}

impl core::fmt::Display for Status {
    /// The standard's name.
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(match self {
            Self::Ok => "fmi2OK",
            Self::Warning => "fmi2Warning",
            Self::Discard => "fmi2Discard",
            Self::Error => "fmi2Error",
            Self::Fatal => "fmi2Fatal",
            Self::Pending => "fmi2Pending",
        })
    }
}
