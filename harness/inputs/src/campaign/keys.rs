//! The keys of a campaign file.
#![allow(non_snake_case, reason = "keys are named as in the file")]

use serde::Deserialize;

use crate::reading::{
    At, InputFile, Named, OutputPath, ShippedFile,
    quantities::{Correlation, Count, CountFromOne, Duration, Settings, Span},
    tables, words,
};

tables! {
/// Many runs of a mission or an FMU: what varies and what is kept of each run. Paths are relative to the file.
struct CampaignKeys makes #[derive(Clone, Debug)] pub struct CampaignValues {
    /// The mission, with a spacecraft, a model or an FMU: its times, values, inputs and limits count.
    mission: Option<InputFile>,
    /// An FMU of FMI 2.0 co-simulation, instead of a mission.
    fmu: Option<ShippedFile>,
    /// Start time of its runs, a number of s or with a unit; otherwise its default.
    start as start_s: Option<Duration>,
    /// Stop time of its runs; otherwise its default.
    stop as stop_s: Option<Duration>,
    /// Communication step; the mission's or the FMU's unless given.
    step as step_s: Option<Span>,
    /// Number of runs; grid, oneAtATime and file have a number of their own.
    runs: Option<At<CountFromOne>>,
    /// Seed of the draws.
    seed: Count = 0,
    /// Distribution of the runs over the variables that vary; random unless given.
    sampling: SamplingWord => |_| SamplingWord::Random,
    /// The values of every run with sampling file: a CSV file whose columns are named as variables, as `--dry-run` prints it.
    file as table: Option<InputFile>,
    /// Correlations of normal variables: two names and a coefficient each.
    correlation as correlations: Vec<At<Correlation>> => |_| Vec::new(),
    /// Parameters, inputs and start values that vary, by names in quotes; vectors are named by element.
    vary: Named<VaryKeys> => |_| Vec::new(),
    /// Values recorded of each run; the final values of all outputs unless given.
    keep: Option<KeepKeys>,
} rules {
    AnyOf mission fmu: "no key `mission`", "mission = \"mission.toml\", or fmu = \"My.fmu\" with stop and step";
    Excludes fmu => mission: "`fmu` beside `mission`", "one of them";
    Excludes start => mission: "`start` beside `mission`", "the mission's own";
    Excludes stop => mission: "`stop` beside `mission`", "the mission's own";
}

/// Distribution of a variable: one of these, numbers in SI or with a unit, dates for epochs.
struct VaryKeys makes #[derive(Clone, Debug)] pub struct Vary {
    /// Mean and standard deviation.
    normal: Option<At<Settings>>,
    /// The smallest and the largest value.
    uniform: Option<At<Settings>>,
    /// The smallest and the largest value, both above 0, between which the logarithm is uniform.
    logUniform as log_uniform: Option<At<Settings>>,
    /// The smallest value, the most likely one, the largest one.
    triangular: Option<At<Settings>>,
    /// A list of values, each as likely as any other.
    values: Option<At<Settings>>,
    /// From, to and how many values, evenly spaced.
    steps: Option<At<Settings>>,
}

/// Values recorded of each run: names of variables, vectors, patterns with * for outputs.
struct KeepKeys makes #[derive(Clone, Debug)] pub struct Keep {
    /// Values at the end, as NAME.final; of all outputs without `[keep]`.
    r#final as finals: Vec<At<String>> => |_| Vec::new(),
    /// The smallest and largest value, the largest magnitude and its time at communication points, as NAME.min, NAME.max, NAME.largest,
    /// NAME.timeOfLargest (s).
    extremes: Vec<At<String>> => |_| Vec::new(),
    /// 1, 5, 25, 50, 75, 95 and 99 % of all runs over time, in a table of its own (runs-percentiles.csv); failed runs do not count.
    percentiles: Vec<At<String>> => |_| Vec::new(),
    /// Time between their rows, a number of s or with a unit; every communication point unless given.
    every as every_s: Option<Span>,
    /// A folder, in the campaign's own or below, that takes a table of every run over time (run-17.csv): what the mission records, otherwise
    /// every output.
    histories: Option<At<OutputPath>>,
} rules {
    Requires every => percentiles: "it without `percentiles`", "`every` beside `percentiles`";
}
}

/// Sampling of the values of runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "camelCase")]
pub enum SamplingWord {
    /// Independent draws.
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

words!(SamplingWord);
