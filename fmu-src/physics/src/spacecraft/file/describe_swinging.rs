//! The shape of flexible modes and propellant in a spacecraft file.

use crate::toml::{Fraction, Frequency, Positive};
use serde::Deserialize;

/// A flexible mode, of a panel or a boom, in hybrid coordinates: with modal displacement e, e'' + 2 z w e' + w^2 e = -d.w',
/// and the body's momentum holds d e'.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct FlexibleModeDescription {
    /// Name for messages; numbered unless given.
    pub name: Option<String>,
    /// Frequency with the body held, in Hz.
    pub frequency_hz: Frequency,
    /// Damping ratio; 0.005 unless given.
    pub damping: Option<Fraction>,
    /// Coupling d to rotation about the body axes, for a modal mass of 1, in sqrt(kg) m; the sum of d d^T over all modes is less
    /// than the inertia.
    pub coupling_sqrt_kg_m: [f64; 3],
}

/// Propellant that swings as a pendulum.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SloshDescription {
    /// Name for messages; numbered unless given.
    pub name: Option<String>,
    /// Mass that swings, in kg; a part of mass_properties.mass_kg, at rest in its inertia.
    pub mass_kg: Positive,
    /// Length of the pendulum, in m.
    pub length_m: Positive,
    /// Pivot, body frame, in m.
    pub pivot_m: [f64; 3],
    /// Unit vector from the pivot to the mass at rest, body frame: against the acceleration by the thrusters it swings under.
    pub axis: [f64; 3],
    /// Damping ratio; 0.005 unless given.
    pub damping: Option<Fraction>,
    /// Frequency without acceleration, in Hz, by surface tension or a membrane; 0.005 unless given.
    pub coast_frequency_hz: Option<Frequency>,
}
