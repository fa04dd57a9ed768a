//! A described model, and why a model cannot be described; free of any version of FMI but for the description's.

use std::sync::Arc;

use model_description::Description;
use uuid::Uuid;

use crate::model::SetupError;
use crate::panics::contain;
use crate::runtime::Runtime;
use crate::variables::{DeclareError, Real, Values};

/// Why a model cannot be described.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DescribeError {
    /// The setup text is refused.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A declaration is refused.
    #[error(transparent)]
    Declare(#[from] DeclareError),
    /// The declarations do not fit together.
    #[error("{0}")]
    Table(String),
    /// Start values of the setup that no variable takes, one a line.
    #[error("{0}")]
    Start(String),
    /// The setup cannot enter the GUID.
    #[error("the setup cannot be digested: {0}")]
    Digest(String),
    /// The model panicked.
    #[error("the model panicked: {0}")]
    Panic(String),
}

/// A description, and all that an instance is made from.
pub(crate) struct Prepared {
    pub(crate) description: Description,
    pub(crate) start: Arc<Values>,
    pub(crate) runtime: Box<dyn Runtime>,
    pub(crate) digest: Uuid,
    /// The parameter that the experiment's tolerance stands in for.
    pub(crate) tolerance: Option<Real>,
}

impl Prepared {
    /// Gives a schedule to the model.
    pub(crate) fn set_schedule(
        &mut self,
        schedule: &str,
        file: &str,
        text: &str,
    ) -> Result<(), DescribeError> {
        let set = contain(|| self.runtime.set_schedule(schedule, file, text));
        set.map_or_else(|panic| Err(DescribeError::Panic(panic)), |set| set.map_err(DescribeError::Setup))
    }
}
