//! What several models have in common: choices, groups of variables, what they read from a spacecraft.

pub mod center;
pub mod choices;
pub mod effects;
pub mod elements;
pub mod ephemeris;
pub mod loads;
pub mod management;
pub mod spacecraft;
pub mod start_values;
pub mod variables;

use fmi_export::About;

/// What every model says of itself alike.
pub fn about() -> About {
    About {
        author: "the heliotorque authors".to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        copyright: "Copyright (c) 2026 the heliotorque authors".to_owned(),
        license: "MIT OR Apache-2.0".to_owned(),
        tool: concat!("heliotorque ", env!("CARGO_PKG_VERSION")).to_owned(),
        ..About::default()
    }
}
