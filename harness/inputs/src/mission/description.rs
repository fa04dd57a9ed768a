//! The shape of a mission file.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::schema::{Inputs, Number, Time};
use crate::reading::{Written, WrittenAs};

/// A mission: what is simulated, when, with which values, and what is recorded. Paths are relative to the file.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[schemars(title = "heliotorque mission")]
#[serde(deny_unknown_fields)]
pub struct MissionDescription {
    /// The spacecraft's or spinner's file, which is packed for the run.
    pub spacecraft: Option<String>,
    /// The model: MomentumPlant, SpinPlant, Guidance, DisturbanceTorque; otherwise MomentumPlant, or the one that takes the
    /// spacecraft's file.
    pub model: Option<String>,
    /// An FMU, or a system (SSP), that is packed already; instead of spacecraft and model.
    pub fmu: Option<String>,
    /// Commands, positions of panels and events over time, a TOML file, for models that take one: MomentumPlant, Guidance.
    pub timeline: Option<String>,
    /// Positions over time, a TOML file, for models that take one.
    pub ephemeris: Option<String>,
    /// When the flight begins: a date that ends in UTC, Z, TDB, TT or TAI, or a Julian date ("2011-04-06T00:00:00 UTC"), which is then simulation time 0; or
    /// simulation time, in s or with a unit ("10 d").
    pub start: Option<WrittenAs<Time>>,
    /// When it ends: a date, if `start` is one; or simulation time.
    pub stop: Option<WrittenAs<Time>>,
    /// Communication step, in s or with a unit ("60 s").
    pub step: Option<WrittenAs<Time>>,
    /// Variables to record: names, vectors, patterns with * for outputs; otherwise every output.
    pub record: Option<Vec<String>>,
    /// Record the step nearest to each multiple of this time, in s or with a unit; otherwise every step.
    pub every: Option<WrittenAs<Time>>,
    /// The CSV file of what is recorded.
    pub output: Option<String>,
    /// Pictures.
    pub plot: Option<Vec<PlotDescription>>,
    /// Parameters and start values by name, in quotes; they win over the spacecraft file's `[start]`.
    pub set: Option<BTreeMap<String, Written>>,
    /// Inputs over time: a CSV file as `run --input` takes; or a table of names, in quotes, each with a value that stays, or rows
    /// of a time and a value (for a vector, all of its values). Between rows continuous inputs are interpolated and others held.
    pub inputs: Option<WrittenAs<Inputs>>,
    /// Bounds by name, in quotes, judged at every time that is recorded; a run that breaks one ends with status 1.
    pub limits: Option<BTreeMap<String, LimitDescription>>,
}

/// A picture.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PlotDescription {
    /// The SVG file.
    pub file: String,
    /// What it shows, named as in `record`; otherwise everything recorded.
    pub names: Option<Vec<String>>,
}

/// Bounds of a number, at least one.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LimitDescription {
    /// The smallest value that is kept, in SI or with a unit.
    pub min: Option<WrittenAs<Number>>,
    /// The largest.
    pub max: Option<WrittenAs<Number>>,
}
