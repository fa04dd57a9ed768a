//! The last prediction of an encounter.

use serde::{Deserialize, Serialize};

use crate::environment::orbit::BPlane;

/// A prediction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EncounterPrediction {
    /// Time at which the prediction was made, in s.
    pub since_s: f64,
    /// Predicted arrival; `None`: no closest approach before the horizon, or no hyperbola.
    pub arrival: Option<PredictedArrival>,
}

/// The next closest approach.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictedArrival {
    /// When, in s; on a path into the planet where it ends.
    pub at_s: f64,
    /// Height above the planet's radius, in m; 0 on a path into it.
    pub altitude_m: f64,
    /// The hyperbola that osculates at `osculates_s`.
    pub b_plane: BPlane,
    /// So long before the closest approach as is set, or when the prediction was made if that is later, in s.
    pub osculates_s: f64,
}

impl EncounterPrediction {
    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        self.arrival.is_none_or(|it| it.at_s >= self.since_s && it.osculates_s >= self.since_s)
    }
}
