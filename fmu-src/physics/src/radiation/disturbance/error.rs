//! Why a spacecraft and a planet cannot be prepared for light.

use crate::bodies::surface::SurfaceError;
use crate::radiation::faces::NoSuchSunshade;
use crate::radiation::grid::GridError;
use crate::radiation::ring::NodesError;

/// Options that cannot be.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// The planet's surface.
    #[error(transparent)]
    Surface(#[from] SurfaceError),
    /// The number of quadrature nodes.
    #[error(transparent)]
    Nodes(#[from] NodesError),
    /// The planet's cells.
    #[error(transparent)]
    Cells(#[from] GridError),
    /// The sunshade's form.
    #[error(transparent)]
    Sunshade(#[from] NoSuchSunshade),
    /// An evaluation that takes more work than a step may.
    #[error("one evaluation takes {found} units of work, allowed: {limit}")]
    Work {
        /// Units of about a microsecond.
        found: u32,
        /// What was allowed.
        limit: u32,
    },
}
