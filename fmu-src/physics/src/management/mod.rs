//! Momentum management by sunlight (paper 000, eqs 14 to 22 and "Momentum management strategies"): where the Sun should stand
//! during a downlink so that its torque brings the momentum to a target, and which target that is.

mod admissible;
mod ahead;
mod dump_request;
mod linear;
mod profile;
mod sampled;
mod sampled_forecast;
mod strategy;
mod targeting;
mod turning;

pub use ahead::{Ahead, Components, DownlinkAhead, Forecast, LONGEST_HORIZON, ScienceAhead};
pub use dump_request::DumpRequests;
pub use linear::LinearTorque;
pub use profile::{Component, Cycle, Reach, Swing};
pub use sampled::SampledManager;
pub use sampled_forecast::SampledForecast;
pub use strategy::{Manager, Strategy};
pub use targeting::{Aim, TargetAxes, Targeted, Targeting, TargetingMethod};
pub use turning::{SquareSum, Turned, best_turned};
