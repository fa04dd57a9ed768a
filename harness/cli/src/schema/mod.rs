//! `heliotorque schema`: the JSON Schemas of files, kept in step with their readers by tests of `physics` and of the mission.

use clap::{Args, ValueEnum};
use files::outcome::{self, Outcome};

/// `heliotorque schema`.
#[derive(Debug, Args)]
pub(crate) struct Schema {
    /// Of which kind of file: spacecraft; spinner, which SpinPlant is packed with; mission, which `run` simulates; timeline, which `pack --timeline` takes; ephemeris, which `pack --ephemeris` takes; plan, which `plan momentum` takes; leg, which `plan leg` takes; or campaign, which `sweep` takes
    #[arg(value_enum, default_value_t, hide_possible_values = true)]
    pub kind: SchemaKind,
}

/// A kind of file that has a schema.
#[derive(Clone, Copy, Debug, Default, ValueEnum)]
pub(crate) enum SchemaKind {
    /// A spacecraft.
    #[default]
    Spacecraft,
    /// A spin-stabilised spacecraft.
    Spinner,
    /// A flight.
    Mission,
    /// Commands over time.
    Timeline,
    /// Positions over time.
    Ephemeris,
    /// How far arrays and attitude may go.
    Plan,
    /// Departure of a leg, and the encounter that it leads to.
    Leg,
    /// Values that vary over many runs, and results that are kept of each.
    Campaign,
}

/// Prints the schema.
pub(crate) fn run(arguments: &Schema) -> Outcome {
    let schema = match arguments.kind {
        SchemaKind::Spacecraft => include_str!("../../../../fmu-src/resources/spacecraft.schema.json"),
        SchemaKind::Spinner => include_str!("../../../../fmu-src/resources/spinner.schema.json"),
        SchemaKind::Mission => include_str!("../../../../fmu-src/resources/mission.schema.json"),
        SchemaKind::Timeline => include_str!("../../../../fmu-src/resources/timeline.schema.json"),
        SchemaKind::Leg => include_str!("../../../../fmu-src/resources/leg.schema.json"),
        SchemaKind::Campaign => include_str!("../../../../fmu-src/resources/campaign.schema.json"),
        SchemaKind::Plan => include_str!("../../../../fmu-src/resources/plan.schema.json"),
        SchemaKind::Ephemeris => include_str!("../../../../fmu-src/resources/ephemeris.schema.json"),
    };
    outcome::printed(schema.trim_end())
}
