//! Heat of a surface in a spacecraft file, as people write it.

use crate::toml::{Fraction, Kelvin, NotNegative, Positive};
use serde::Deserialize;

/// Heat flow through a thin structure: two numbers, or the honeycomb they follow from.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ConductionDescription {
    /// Conductance from face to face, in W/m2/K.
    pub conductance_w_m2_k: Option<NotNegative>,
    /// Radiative exchange from face to face as a fraction of that between black plates.
    pub radiative_exchange: Option<Fraction>,
    pub honeycomb: Option<HoneycombDescription>,
}

/// A honeycomb between face sheets.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct HoneycombDescription {
    /// Conductivity of the core's material, in W/m/K.
    pub conductivity_w_m_k: Positive,
    /// Thickness, in m.
    pub thickness_m: Positive,
    /// Cross-section of the walls over the panel's area.
    pub wall_area_ratio: Fraction,
    /// Packing factor of the solar cells.
    pub packing_factor: Fraction,
    /// Emissivity inside the honeycomb.
    pub internal_emissivity: Fraction,
}

/// What every surface exchanges heat with.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SurroundingsDescription {
    /// Temperature of the space that surfaces see, in K; 2.725, the cosmic microwave background's, unless given.
    pub background_k: Option<Kelvin>,
    /// Temperature of the bus behind surfaces that conduct heat to it, in K; held, whatever flows.
    pub bus_temperature_k: Option<Kelvin>,
}

/// Heat of a plate or panel.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ThermalDescription {
    /// Heat flow between front and rear; insulated from each other unless given.
    pub conduction: Option<ConductionDescription>,
    /// Heat from inside that leaves through the front face, in W; 0 unless given.
    pub internal_heat_w: Option<NotNegative>,
    /// Heat from inside that leaves through the rear face, in W; 0 unless given.
    pub rear_internal_heat_w: Option<NotNegative>,
    /// Conductance from the front face to the bus, by the surface's area, in W/m2/K; 0 unless given.
    pub bus_conductance_w_m2_k: Option<NotNegative>,
    /// Conductance from the rear face to the bus, by the surface's area, in W/m2/K; 0 unless given.
    pub rear_bus_conductance_w_m2_k: Option<NotNegative>,
    /// Temperature of the bus behind this surface, in K; the one under `[thermal]` unless given.
    pub bus_temperature_k: Option<Kelvin>,
    /// Heat capacity of each face, in J/m2/K; used by the transient heat balance; 0 unless given.
    pub heat_capacity_j_m2_k: Option<NotNegative>,
}
