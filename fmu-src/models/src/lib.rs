//! The heliotorque models: each declares its variables and wires physics to the model trait. No physics here.

mod common;
mod disturbance_torque;
mod momentum_plant;
mod sources;
mod spin_plant;

pub use disturbance_torque::{DisturbanceSetup, DisturbanceTorque};
pub use momentum_plant::{MomentumPlant, PlantSetup};
pub use spin_plant::SpinPlant;

/// What every model says of itself alike.
fn about() -> fmi_export::About {
    fmi_export::About {
        author: "the heliotorque authors".to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        license: "MIT OR Apache-2.0".to_owned(),
        ..fmi_export::About::default()
    }
}
