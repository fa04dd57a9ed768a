//! Oscillators on the spacecraft: flexible modes, and propellant as pendulums.

use serde::Serialize;

use crate::attitude::{FlexibleMode, SloshPendulum};

/// A flexible mode of the spacecraft.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedMode {
    /// For messages.
    pub name: String,
    /// Frequency, damping and coupling.
    pub mode: FlexibleMode,
}

/// Propellant that swings in its tank.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct NamedSlosh {
    /// For messages.
    pub name: String,
    /// Mass, pendulum and damping.
    pub pendulum: SloshPendulum,
}

/// Frequency of propellant without acceleration where the file gives none, in Hz: surface tension or a membrane holds it.
/// Assumed.
pub(super) const COAST_FREQUENCY_HZ: f64 = 0.005;
