//! Paper 001: the attitudes `Guidance` commands along the orbit that `MomentumPlant` propagates.
//!
//! Limb points and scans of the limb's height, mosaics on the planet's disc, and the commanded curves of Figures 7 and 8.

mod camera;
mod disc;
mod flight;
mod limb;
mod limb_orbit;
mod limb_point;
mod mosaic;
mod planet;
mod scans;
mod transition;

pub(crate) use limb::limb;
pub(crate) use mosaic::mosaic;
pub(crate) use transition::{
    EPOCH_S as TRANSITION_EPOCH_S, SLEW_S, TRUE_ANOMALY_DEG as TRANSITION_TRUE_ANOMALY_DEG, transition,
};
