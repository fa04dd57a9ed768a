//! Momentum management by sunlight (paper 000, eqs 14 to 22 and "Momentum management strategies"): where the Sun should stand
//! during a downlink so that its torque brings the momentum to a target, and which target that is.

mod admissible;
mod dump_request;
mod linear;
mod prediction;
mod profile;
mod rotated_momentum;
mod sampled;
mod searches;
mod strategy;
mod targeting;

pub use admissible::KeepInLimits;
pub use dump_request::DumpRequests;
pub use linear::LinearTorque;
pub use prediction::{
    Components, Forecast, LONGEST_HORIZON, PredictedDownlink, PredictedScience, Prediction,
};
pub use profile::{Component, ControlAuthority, Cycle, Excursion};
pub use rotated_momentum::{RotatedMomentum, SquareSum, best_turned};
pub use sampled::SampledManager;
pub use strategy::{Manager, Strategy};
pub use targeting::{DownlinkState, TargetAxes, Targeting, TargetingMethod};
