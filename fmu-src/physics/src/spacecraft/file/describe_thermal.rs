//! Heat of a surface in a spacecraft file, as people write it.

use crate::spacecraft::thermal::BACKGROUND_K;
use crate::toml::{Fraction, Kelvin, NotNegative, Positive, tables};

tables! {
/// Heat flow through a thin structure: two numbers, or the honeycomb they follow from.
struct ConductionDescription {
    /// Conductance from face to face, in W/m2/K.
    conductance_w_m2_k: Option<NotNegative>,
    /// Radiative exchange from face to face as a fraction of that between black plates.
    radiative_exchange: Option<Fraction>,
    honeycomb: Option<HoneycombDescription>,
} rules {
    AnyOf honeycomb conductance_w_m2_k radiative_exchange: "no conduction",
        "`honeycomb`, or `conductance_w_m2_k` and `radiative_exchange` or one of them";
    Either honeycomb => conductance_w_m2_k radiative_exchange: "both numbers and a `honeycomb`", "one of them";
}

/// A honeycomb between face sheets.
struct HoneycombDescription {
    /// Conductivity of the core's material, in W/m/K.
    conductivity_w_m_k: Positive,
    /// Thickness, in m.
    thickness_m: Positive,
    /// Cross-section of the walls over the panel's area.
    wall_area_ratio: Fraction,
    /// Packing factor of the solar cells.
    packing_factor: Fraction,
    /// Emissivity inside the honeycomb.
    internal_emissivity: Fraction,
}

/// What every surface exchanges heat with.
#[derive(Default)]
struct SurroundingsDescription {
    /// Temperature of the space that surfaces see, in K; the default is the cosmic microwave background's.
    background_k: Kelvin = BACKGROUND_K,
    /// Temperature of the bus behind surfaces that conduct heat to it, in K; held, whatever flows.
    bus_temperature_k: Option<Kelvin>,
}

/// Heat of a plate or panel.
#[derive(Default)]
struct ThermalDescription {
    /// Heat flow between front and rear; insulated from each other unless given.
    conduction: Option<ConductionDescription>,
    /// Heat from inside that leaves through the front face, in W.
    internal_heat_w: NotNegative = 0.0,
    /// Heat from inside that leaves through the rear face, in W.
    rear_internal_heat_w: NotNegative = 0.0,
    /// Conductance from the front face to the bus, by the surface's area, in W/m2/K; insulated unless given.
    bus_conductance_w_m2_k: Option<NotNegative>,
    /// Conductance from the rear face to the bus, by the surface's area, in W/m2/K; insulated unless given.
    rear_bus_conductance_w_m2_k: Option<NotNegative>,
    /// Temperature of the bus behind this surface, in K; the one under `[thermal]` unless given.
    bus_temperature_k: Option<Kelvin>,
    /// Heat capacity of each face, in J/m2/K; used by the transient heat balance.
    heat_capacity_j_m2_k: NotNegative = 0.0,
} rules {
    Requires bus_temperature_k => bus_conductance_w_m2_k rear_bus_conductance_w_m2_k: "no conductance to the bus",
        "`bus_conductance_w_m2_k` beside it";
}
}
