//! The shape of a campaign file.

use std::collections::BTreeMap;

use serde::Deserialize;

use super::schema::{Correlation, List, Number};
use crate::reading::{Written, WrittenAs};

/// Many runs of a mission or an FMU: what varies and what is kept of each run. Paths are relative to the file.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[schemars(title = "heliotorque campaign")]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct CampaignDescription {
    /// The mission: spacecraft or FMU, times, values, inputs, limits.
    pub mission: Option<String>,
    /// An FMU that is packed already, instead of a mission.
    pub fmu: Option<String>,
    /// Where its runs begin, in s or with a unit; otherwise its default.
    pub start: Option<WrittenAs<Number>>,
    /// Where its runs end; otherwise its default.
    pub stop: Option<WrittenAs<Number>>,
    /// Communication step; the mission's or the FMU's default unless given.
    pub step: Option<WrittenAs<Number>>,
    /// How many runs; grid, oneAtATime and file have a number of their own.
    pub runs: Option<WrittenAs<u64>>,
    /// Seed of the draws; 0 unless given.
    pub seed: Option<WrittenAs<u64>>,
    /// How runs are spread over what varies; random unless given.
    pub sampling: Option<SamplingWord>,
    /// The values of every run with sampling file: a CSV file whose columns are named as variables.
    pub file: Option<String>,
    /// Correlations of normal variables: two names and a coefficient each.
    pub correlation: Option<Vec<WrittenAs<Correlation>>>,
    /// What varies, by names of variables in quotes.
    pub vary: Option<BTreeMap<String, VaryDescription>>,
    /// What is kept of each run; the final values of all outputs unless given.
    pub keep: Option<KeepDescription>,
}

/// How the values of runs are chosen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase")]
pub enum SamplingWord {
    /// Independent draws.
    #[default]
    Random,
    /// One run in each of as many strata as there are runs, of every variable.
    LatinHypercube,
    /// The points of the Sobol sequence, not scrambled.
    Sobol,
    /// Every combination of values and steps.
    Grid,
    /// All at their means, then each a standard deviation below and above.
    OneAtATime,
    /// The rows of `file`.
    File,
}

/// Where the values of a variable come from: one of these, numbers in SI or with a unit, dates for epochs.
#[derive(Debug, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase", deny_unknown_fields)]
pub struct VaryDescription {
    /// Mean and standard deviation.
    pub normal: Option<WrittenAs<List, Vec<Written>>>,
    /// The smallest and the largest value.
    pub uniform: Option<WrittenAs<List, Vec<Written>>>,
    /// The smallest and the largest value, both above 0, between which the logarithm is uniform.
    pub log_uniform: Option<WrittenAs<List, Vec<Written>>>,
    /// The smallest value, the most likely one, the largest one.
    pub triangular: Option<WrittenAs<List, Vec<Written>>>,
    /// A list of values, each as likely as any other.
    pub values: Option<WrittenAs<List, Vec<Written>>>,
    /// From, to and how many values, evenly spaced.
    pub steps: Option<WrittenAs<List, Vec<Written>>>,
}

/// What is kept of each run: names of variables, vectors, patterns with * for outputs.
#[derive(Debug, Default, Deserialize, schemars::JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct KeepDescription {
    /// The value at the end, as NAME.final.
    pub r#final: Option<Vec<String>>,
    /// The smallest and largest value, the largest magnitude and its time at communication points, as NAME.min, NAME.max, NAME.largest,
    /// NAME.timeOfLargest.
    pub extremes: Option<Vec<String>>,
    /// Percentiles of all runs over time, in a table beside the one of the runs.
    pub percentiles: Option<Vec<String>>,
    /// Time between their rows, in s or with a unit; every communication point unless given.
    pub every: Option<WrittenAs<Number>>,
    /// A folder that takes a table of every run over time: what the mission records, otherwise every output.
    pub histories: Option<String>,
}
