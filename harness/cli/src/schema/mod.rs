//! JSON Schemas of files, kept in step with their readers by tests of `physics` and of the mission.

use clap::ValueEnum;

/// A kind of file that has a schema.
#[derive(Clone, Copy, Debug, ValueEnum)]
pub(crate) enum SchemaKind {
    /// A spacecraft.
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

impl SchemaKind {
    /// The schema.
    pub(crate) fn text(self) -> &'static str {
        match self {
            Self::Spacecraft => include_str!("../../../../fmu-src/resources/spacecraft.schema.json"),
            Self::Spinner => include_str!("../../../../fmu-src/resources/spinner.schema.json"),
            Self::Mission => include_str!("../../../../fmu-src/resources/mission.schema.json"),
            Self::Timeline => include_str!("../../../../fmu-src/resources/timeline.schema.json"),
            Self::Leg => include_str!("../../../../fmu-src/resources/leg.schema.json"),
            Self::Campaign => include_str!("../../../../fmu-src/resources/campaign.schema.json"),
            Self::Plan => include_str!("../../../../fmu-src/resources/plan.schema.json"),
            Self::Ephemeris => include_str!("../../../../fmu-src/resources/ephemeris.schema.json"),
        }
    }
}
