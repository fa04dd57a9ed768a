//! State of the model between steps.

use physics::environment::coarse_ephemeris::CoarseEphemeris;
use physics::environment::ephemeris::Ephemeris;
use physics::guidance::modes::system::GuidanceState;
use physics::management::DumpRequests;
use serde::{Deserialize, Serialize};

use super::inputs::Fixed;

/// State of guidance between steps.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct State {
    /// Modes, constraints, scans and the command in force.
    pub system: GuidanceState,
    /// Requests of dumps.
    pub dumps: DumpRequests,
    /// The time up to which events of the timeline have come, in s.
    pub events_until_s: f64,
    /// When the timeline's entry begins, on its clock, in s, whose burn the present or last one is; `None`: the parameters'.
    pub burn_entry: Option<f64>,
    /// The communication point reached, in s.
    pub time_s: f64,
    /// Epoch less time, in s.
    pub epoch_minus_time_s: f64,
    /// Whether the warning was given that places are not connected.
    pub warned_unconnected: bool,
    /// Whether the warning was given of a roll axis along the boresight.
    pub warned_roll: bool,
    /// Whether the windows of the orbit phase were checked.
    pub windows_are_checked: bool,
    /// Cache, not state: the same epoch gives the same bits.
    #[serde(skip)]
    pub ephemeris: Ephemeris,
    /// Cache likewise.
    #[serde(skip)]
    pub coarse: CoarseEphemeris,
    /// Cache of what parameters fix.
    #[serde(skip)]
    pub fixed: Option<Fixed>,
}
