//! The shape of flexible modes and propellant in a spacecraft file.

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
    #[cfg_attr(feature = "schema", schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0)))]
    pub frequency_hz: f64,
    /// Damping ratio; 0.005 unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub damping: Option<f64>,
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
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0)))]
    pub mass_kg: f64,
    /// Length of the pendulum, in m.
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0)))]
    pub length_m: f64,
    /// Pivot, body frame, in m.
    pub pivot_m: [f64; 3],
    /// Unit vector from the pivot to the mass at rest, body frame: against the acceleration by the thrusters it swings under.
    pub axis: [f64; 3],
    /// Damping ratio; 0.005 unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub damping: Option<f64>,
    /// Frequency without acceleration, in Hz, by surface tension or a membrane; 0.005 unless given.
    #[cfg_attr(feature = "schema", schemars(range(max = 1000.0), extend("exclusiveMinimum" = 0)))]
    pub coast_frequency_hz: Option<f64>,
}
