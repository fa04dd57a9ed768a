//! The setup of `AllTypes`.

use serde::{Deserialize, Serialize};

/// The content of `all-types.toml`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Setup {
    /// Start value of `parameter.text`.
    pub label: String,
    /// The channels, any number.
    #[serde(default)]
    pub channel: Vec<Channel>,
    /// When the schedule ends the simulation, in s.
    #[serde(skip)]
    pub end_s: Option<f64>,
}

/// The content of `all-types-schedule.toml`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Schedule {
    pub(super) end_s: f64,
}

/// One channel.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Channel {
    /// Start value of the gain.
    pub gain: f64,
}
