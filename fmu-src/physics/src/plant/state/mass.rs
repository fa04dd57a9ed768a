//! Mass properties of a spacecraft that uses propellant and turns panels; the only place where they are kept.

use serde::{Deserialize, Serialize};

use crate::spacecraft::MassProperties;

/// Mass properties of a body that turns by its dynamics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct MassState {
    /// At the last edge of the grid, with the panels as they stood then: what the controller knows.
    pub known: MassProperties,
    /// At the start of the present segment of the motion: without the propellant that flowed since.
    pub now: MassProperties,
    /// At the last edge of the grid with every panel at angle 0; absent while no propellant is used.
    pub stowed: Option<MassProperties>,
}

impl MassState {
    /// At the start of a flight.
    pub(crate) fn new(mass: MassProperties) -> Self {
        Self { known: mass, now: mass, stowed: None }
    }

    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        [Some(self.known), Some(self.now), self.stowed].iter().flatten().all(|mass| mass.mass_kg > 0.0)
    }
}
