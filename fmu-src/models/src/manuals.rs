//! The beginning of each model's manual inside its FMU.

use fmi_export::Manual;

macro_rules! manual {
    ($model:literal, $frame:literal) => {
        Manual {
            about: include_str!(concat!("../../resources/manual/", $model, "/about.html")),
            example: include_str!(concat!("../../resources/manual/", $model, "/example.py")),
            closed_loop: include_str!(concat!("../../resources/manual/", $model, "/closed_loop.py")),
            frames: include_str!(concat!("../../resources/manual/", $frame, ".html")),
        }
    };
}

/// Of MomentumPlant.
pub const MOMENTUM_PLANT: Manual = manual!("MomentumPlant", "body_frame");
/// Of DisturbanceTorque.
pub const DISTURBANCE_TORQUE: Manual = manual!("DisturbanceTorque", "body_frame");
/// Of SpinPlant.
pub const SPIN_PLANT: Manual = manual!("SpinPlant", "spin_frame");
/// Of Guidance.
pub const GUIDANCE: Manual = manual!("Guidance", "body_frame");
