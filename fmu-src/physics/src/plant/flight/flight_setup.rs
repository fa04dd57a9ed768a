//! Configuration, settings and caches of a flight, none of them saved.

use crate::loads::ForceTorque;
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
    pub evaluated: Evaluated,
}

/// What was evaluated last, kept in place because it is large.
#[derive(Clone, Debug, Default)]
pub(super) struct Evaluated {
    pub evaluation: Option<Evaluation>,
    /// Load from outside, where the loads are not computed yet.
    pub applied: Option<ForceTorque>,
}

impl FlightSetup {
    /// Setup of a flight that was not evaluated yet.
    pub(super) fn new(context: SimulationContext, settings: ModeSettings) -> Self {
        Self {
            context,
            settings,
            distribution: WheelDistribution::default(),
            evaluated: Evaluated::default(),
        }
    }
}
