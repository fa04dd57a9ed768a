//! Configuration, settings and caches of a flight, none of them saved.

use crate::plant::control::wheel_control::WheelDistribution;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::disturbances::simulation_context::SimulationContext;
use crate::plant::settings::mode_settings::ModeSettings;

/// Configuration, settings and caches.
#[derive(Clone, Debug)]
pub(super) struct FlightSetup {
    pub context: SimulationContext,
    pub settings: ModeSettings,
    pub distribution: WheelDistribution,
    /// Geometry, attitude and loads at the last report, kept in place because they are large.
    pub evaluation: Option<Evaluation>,
}

impl FlightSetup {
    /// Setup of a flight that was not evaluated yet.
    pub(super) fn new(context: SimulationContext, settings: ModeSettings) -> Self {
        Self { context, settings, distribution: WheelDistribution::default(), evaluation: None }
    }
}
