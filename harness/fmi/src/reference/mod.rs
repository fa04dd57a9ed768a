//! Reference flights: a short simulation that an FMU carries with it, its inputs and outputs as CSV.
//!
//! They stand where the layered standard FMI-LS-REF (1.0.0-alpha.1) has files related to an FMU, with roles `testcase` and
//! `result`. The steps, the tolerance and the file of inputs, for which that standard has no place, are an annotation.

mod compare;
mod manifest;
mod record;
mod replay;

pub use compare::{Cell, Compared, Difference, differences};
pub use manifest::{FOLDER, MANIFEST, Manifest, ReferenceSimulation, Related};
pub use record::{RecordError, record};
pub use replay::{Replay, replays};
