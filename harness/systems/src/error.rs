//! Errors of a system, each with file, place, what was found and what is allowed.

use std::path::PathBuf;

/// Any failure of a system.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The archive is no usable SSP.
    #[error("{}: not a usable SSP archive: {what}", path.display())]
    Archive {
        /// The archive.
        path: PathBuf,
        /// Fault of the file.
        what: String,
    },
    /// The description of the system cannot be used.
    #[error("{}: {file}: {what}", path.display())]
    Structure {
        /// The SSP.
        path: PathBuf,
        /// The file in it.
        file: String,
        /// Line and element, what was found, what is allowed.
        what: String,
    },
    /// A component's FMU cannot be used.
    #[error("{}: component {component:?}: {source}", path.display())]
    Component {
        /// The SSP.
        path: PathBuf,
        /// The component.
        component: String,
        /// Error of its FMU.
        source: Box<fmi::Error>,
    },
    /// Refusal of connections that `wire` was asked for.
    #[error("{0}")]
    Wire(String),
    /// An FMI call, a value, the times of a run; the component's name is the instance's.
    #[error(transparent)]
    Run(Box<fmi::Error>),
}

impl From<fmi::Error> for Error {
    fn from(error: fmi::Error) -> Self {
        Self::Run(Box::new(error))
    }
}
