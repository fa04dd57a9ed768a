//! What an FMU answers and logs.

use std::ffi::c_int;

/// `fmi2Status`, with whatever else a foreign library may answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the standard's own words")]
pub enum Status {
    Ok,
    Warning,
    Discard,
    Error,
    Fatal,
    Pending,
    /// A number that the standard does not know.
    Invalid(i32),
}

impl From<c_int> for Status {
    fn from(code: c_int) -> Self {
        match code {
            0 => Self::Ok,
            1 => Self::Warning,
            2 => Self::Discard,
            3 => Self::Error,
            4 => Self::Fatal,
            5 => Self::Pending,
            other => Self::Invalid(other),
        }
    }
}

impl Status {
    /// The number at the C interface.
    pub fn code(self) -> i32 {
        match self {
            Self::Ok => 0,
            Self::Warning => 1,
            Self::Discard => 2,
            Self::Error => 3,
            Self::Fatal => 4,
            Self::Pending => 5,
            Self::Invalid(code) => code,
        }
    }
}

impl std::fmt::Display for Status {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Ok => write!(f, "fmi2OK"),
            Self::Warning => write!(f, "fmi2Warning"),
            Self::Discard => write!(f, "fmi2Discard"),
            Self::Error => write!(f, "fmi2Error"),
            Self::Fatal => write!(f, "fmi2Fatal"),
            Self::Pending => write!(f, "fmi2Pending"),
            Self::Invalid(code) => write!(f, "status {code}, which FMI 2.0 does not have"),
        }
    }
}

/// One message of an instance.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogMessage {
    /// Status that goes with it.
    pub status: Status,
    /// Category, if the FMU names one.
    pub category: Option<String>,
    /// The text; `%%` and `##` unescaped.
    pub text: String,
}

impl std::fmt::Display for LogMessage {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "[{}] {}", self.category.as_deref().unwrap_or("no category"), self.text)
    }
}
