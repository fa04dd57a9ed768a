//! The beginning of each model's manual inside its FMU.

use fmi_export::Manual;

macro_rules! manual {
    ($model:literal, $frame:literal) => {
        Manual {
            about: include_str!(concat!("../../resources/manual/", $model, "/about.html")),
            example: include_str!(concat!("../../resources/manual/", $model, "/example.py")),
            closed_loop: include_str!(concat!("../../resources/manual/", $model, "/closed_loop.py")),
            frames: include_str!(concat!("../../resources/manual/", $frame, ".html")),
            sources: include_str!(concat!("../../resources/manual/", $model, "/sources.txt")),
            shared_sources: include_str!("../../resources/manual/sources.txt"),
        }
    };
}

/// Manual of MomentumPlant.
pub(crate) const MOMENTUM_PLANT: Manual = manual!("MomentumPlant", "body_frame");
/// Manual of DisturbanceTorque.
pub(crate) const DISTURBANCE_TORQUE: Manual = manual!("DisturbanceTorque", "body_frame");
/// Manual of SpinPlant.
pub(crate) const SPIN_PLANT: Manual = manual!("SpinPlant", "spin_frame");
/// Manual of Guidance.
pub(crate) const GUIDANCE: Manual = manual!("Guidance", "body_frame");
