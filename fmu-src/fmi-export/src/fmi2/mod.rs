//! FMI 2.0 co-simulation: everything of the standard that a model does not see.
//!
//! [`references`] gives each element of a variable its value reference, [`description`] writes the `modelDescription.xml`,
//! [`instance`] is the state machine around a model, [`functions`] are the C functions over it, and
//! [`crate::export!`] makes a library of them. Pointers are followed in [`arguments`], [`boundary`], [`describe`] and
//! [`functions`] only.

pub(crate) mod access;
#[allow(unsafe_code, reason = "takes the raw pointers of the C interface")]
mod arguments;
#[allow(unsafe_code, reason = "takes the raw pointers of the C interface")]
mod boundary;
#[allow(unsafe_code, reason = "takes the raw pointers of the C interface")]
mod describe;
pub(crate) mod description;
mod export;
#[allow(unsafe_code, reason = "takes the raw pointers of the C interface")]
mod functions;
pub(crate) mod instance;
pub(crate) mod problem;
pub mod references;
mod structure;

pub use crate::model::{SetupValue, StartValue};
pub use crate::panics::silence as silence_panics;
pub use crate::prepared::DescribeError;
pub use describe::{check_schedule, describe};
pub use description::{description_of, entry, scalar_variables};
pub use functions::*;
pub use instance::MAX_INPUT_DERIVATIVE_ORDER;
