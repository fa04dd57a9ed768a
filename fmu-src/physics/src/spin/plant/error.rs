//! Errors of a step of the spinner.

use crate::spin::{motion::MotionError, work::WorkExceeded};

/// Reason why a flight does not come to the end of a step.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum SpinPlantError {
    /// Body that cannot be followed.
    #[error(transparent)]
    MotionError(#[from] MotionError),
    /// More work than a step may cost.
    #[error(transparent)]
    Work(#[from] WorkExceeded),
}
