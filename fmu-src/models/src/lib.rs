//! The heliotorque models: each declares its variables and wires physics to the model trait. No physics here.

mod common;
mod disturbance_torque;
mod guidance;
mod manuals;
mod momentum_plant;
mod spin_plant;

pub use disturbance_torque::{DisturbanceSetup, DisturbanceTorque};
pub use guidance::Guidance;
pub use momentum_plant::{MomentumPlant, PlantSetup};
pub use spin_plant::SpinPlant;
