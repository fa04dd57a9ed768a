//! Heat of a surface in a spacecraft file, as people write it.

use serde::Deserialize;

/// Heat flow through a thin structure: two numbers, or the honeycomb they follow from.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ConductionDescription {
    /// Conductance from face to face, in W/m2/K.
    #[cfg_attr(feature = "schema", schemars(range(min = 0)))]
    pub conductance_w_m2_k: Option<f64>,
    /// Radiative exchange from face to face as a fraction of that between black plates.
    #[cfg_attr(feature = "schema", schemars(range(min = 0, max = 1)))]
    pub radiative_exchange: Option<f64>,
    pub honeycomb: Option<HoneycombDescription>,
}

/// A honeycomb between face sheets.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct HoneycombDescription {
    /// Conductivity of the core's material, in W/m/K.
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0)))]
    pub conductivity_w_m_k: f64,
    /// Thickness, in m.
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0)))]
    pub thickness_m: f64,
    /// Cross-section of the walls over the panel's area.
    #[cfg_attr(feature = "schema", schemars(range(min = 0, max = 1)))]
    pub wall_area_ratio: f64,
    /// Packing factor of the solar cells.
    #[cfg_attr(feature = "schema", schemars(range(min = 0, max = 1)))]
    pub packing_factor: f64,
    /// Emissivity inside the honeycomb.
    #[cfg_attr(feature = "schema", schemars(range(min = 0, max = 1)))]
    pub internal_emissivity: f64,
}

/// What every surface exchanges heat with.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SurroundingsDescription {
    /// Temperature of the space that surfaces see, in K; 2.725, the cosmic microwave background's, unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0, max = 2000)))]
    pub background_k: Option<f64>,
    /// Temperature of the bus behind surfaces that conduct heat to it, in K; held, whatever flows.
    #[cfg_attr(feature = "schema", schemars(range(min = 0, max = 2000)))]
    pub bus_temperature_k: Option<f64>,
}

/// Heat of a plate or panel.
#[derive(Debug, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ThermalDescription {
    /// Heat flow between front and rear; insulated from each other unless given.
    pub conduction: Option<ConductionDescription>,
    /// Heat from inside that leaves through the front face, in W; 0 unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0)))]
    pub internal_heat_w: Option<f64>,
    /// Heat from inside that leaves through the rear face, in W; 0 unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0)))]
    pub rear_internal_heat_w: Option<f64>,
    /// Conductance from the front face to the bus, by the surface's area, in W/m2/K; 0 unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0)))]
    pub bus_conductance_w_m2_k: Option<f64>,
    /// Conductance from the rear face to the bus, by the surface's area, in W/m2/K; 0 unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0)))]
    pub rear_bus_conductance_w_m2_k: Option<f64>,
    /// Temperature of the bus behind this surface, in K; the one under `[thermal]` unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0, max = 2000)))]
    pub bus_temperature_k: Option<f64>,
    /// Heat capacity of each face, in J/m2/K; used by the transient heat balance; 0 unless given.
    #[cfg_attr(feature = "schema", schemars(range(min = 0)))]
    pub heat_capacity_j_m2_k: Option<f64>,
}
