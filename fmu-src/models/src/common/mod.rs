//! Parts that several models share: choices, groups of variables, readings of a spacecraft.

pub(crate) mod center;
pub(crate) mod choices;
pub(crate) mod downlink;
pub(crate) mod effects;
pub(crate) mod ellipse;
pub(crate) mod ephemeris;
pub(crate) mod guided;
pub(crate) mod loads;
pub(crate) mod management;
pub(crate) mod numbers;
pub(crate) mod optics;
pub(crate) mod orientation;
pub(crate) mod pointing;
pub(crate) mod spacecraft;
pub(crate) mod start_values;
pub(crate) mod value_reader;
pub(crate) mod variables;

use fmi_export::{About, model_description::annotation::TOOL};

/// Facts that every model states alike.
pub(crate) fn about() -> About {
    About {
        author: "the heliotorque authors".to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        copyright: "Copyright (c) 2026 the heliotorque authors".to_owned(),
        license: "MIT OR Apache-2.0".to_owned(),
        annotation_tool: TOOL.to_owned(),
        tool: concat!("heliotorque ", env!("CARGO_PKG_VERSION")).to_owned(),
        ..About::default()
    }
}
