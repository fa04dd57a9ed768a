//! The keys of a mission file.

use super::inputs::InputsKey;
use crate::reading::{
    At, InputFile, Named, OutputPath,
    quantities::{Bound, Moment, Setting, Span},
    tables,
};

tables! {
/// A mission: what is simulated, when, with which values, and what is recorded. Paths are relative to the file.
struct MissionKeys makes #[derive(Clone, Debug)] pub struct MissionValues {
    /// The spacecraft's or spinner's file, which is packed for the run.
    spacecraft: Option<InputFile>,
    /// The model: MomentumPlant, SpinPlant, Guidance, DisturbanceTorque; otherwise MomentumPlant, or the one that takes the
    /// spacecraft's file.
    model: Option<At<String>>,
    /// An FMU, or a system (SSP), that is packed already; instead of spacecraft and model.
    fmu: Option<InputFile>,
    /// Commands, positions of panels and events over time, a TOML file, for models that take one: MomentumPlant, Guidance.
    timeline: Option<InputFile>,
    /// Positions over time, a TOML file, for models that take one.
    ephemeris: Option<InputFile>,
    /// Start of the flight: a date that ends in UTC, Z, TDB, TT or TAI, or a Julian date ("2011-04-06T00:00:00 UTC"), which is then simulation time 0; or
    /// simulation time, a number of s or with a unit ("10 d").
    start: Option<At<Moment>>,
    /// Stop of the flight: a date, if `start` is one; or simulation time.
    stop: Option<At<Moment>>,
    /// Communication step, a number of s or with a unit ("60 s").
    step as step_s: Option<Span>,
    /// Variables to record: names, vectors, patterns with * for outputs; otherwise every output.
    record: Option<Vec<At<String>>>,
    /// Record the step nearest to each multiple of this time, a number of s or with a unit; otherwise every step.
    every as every_s: Option<Span>,
    /// The CSV file of what is recorded.
    output: Option<OutputPath>,
    /// Pictures.
    plot as plots: Vec<PlotKeys> => |_| Vec::new(),
    /// Parameters and start values by name, in quotes; they win over the spacecraft file's `[start]`.
    set as sets: Named<Setting> => |_| Vec::new(),
    /// Inputs over time: a CSV file as `run --input` takes; or a table of names, in quotes, each with a value that stays, or rows
    /// of a time and a value (for a vector, all of its values). Between rows continuous inputs are interpolated and others held.
    inputs: Option<InputsKey>,
    /// Bounds by name, in quotes, judged at every time that is recorded; a run that breaks one ends with status 1.
    limits: Named<LimitKeys> => |_| Vec::new(),
} rules {
    AnyOf spacecraft model fmu: "no key `spacecraft`",
        "spacecraft = \"my.toml\", or fmu = \"My.fmu\", or model = \"MomentumPlant\" for the model's own spacecraft";
    Excludes spacecraft => fmu: "`spacecraft` beside `fmu`", "one of them: the FMU has its own, packed with it";
    Excludes model => fmu: "`model` beside `fmu`", "one of them: the FMU has its own, packed with it";
    Excludes timeline => fmu: "`timeline` beside `fmu`", "one of them: the FMU has its own, packed with it";
    Excludes ephemeris => fmu: "`ephemeris` beside `fmu`", "one of them: the FMU has its own, packed with it";
}

/// A picture.
struct PlotKeys makes #[derive(Clone, Debug)] pub struct Plot {
    /// The SVG file.
    file: OutputPath,
    /// Variables that it shows, named as in `record`; otherwise everything recorded.
    names: Option<Vec<At<String>>>,
}

/// Bounds of a number, at least one.
struct LimitKeys makes #[derive(Clone, Debug)] pub struct Bounds {
    /// The smallest value that is kept, in SI or with a unit.
    min: Option<Bound>,
    /// The largest.
    max: Option<Bound>,
} rules {
    AnyOf min max: "no bound", "min, max or both";
}
}
