//! Heat of a surface: its table in the file, and the reading of it.

use super::materials::ChosenMaterial;
use super::part_reader::PartReader;
use super::thermal::{BusLink, Conduction, HoneycombDescription, Thermal};
use crate::toml::{Fraction, Kelvin, NotNegative, Table, Written, tables};

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

/// Heat of a surface whose faces are of these materials.
pub(super) fn thermal(
    part: &PartReader<'_>,
    description: Option<&ThermalDescription>,
    front: ChosenMaterial,
    rear: Option<ChosenMaterial>,
) -> Thermal {
    let nothing = ThermalDescription::default();
    let has_rear = rear.is_some() || part.key("rear_optics").is_stand_in();
    let part = part.table("thermal");
    part.rules(ThermalDescription::RULES);
    let description = description.unwrap_or(&nothing);
    if !has_rear {
        let needs_rear = ["conduction", "rear_internal_heat_w", "rear_bus_conductance_w_m2_k"];
        for at in needs_rear.map(|key| part.key(key)).iter().filter(|at| at.is_written()) {
            at.report("a surface without `rear_optics`", "a surface with both faces");
        }
    }
    let bus = bus(&part, description);
    Thermal {
        front: front.material.thermal,
        rear: rear.map(|rear| rear.material.thermal),
        bus,
        internal_heat_w: [description.internal_heat_w(), description.rear_internal_heat_w()],
        heat_capacity_j_m2_k: description.heat_capacity_j_m2_k(),
        conduction: part.optional("conduction", description.conduction.as_ref(), |_, it| conduction(it)),
    }
}

/// Heat flow from front and rear to the bus.
fn bus(part: &PartReader<'_>, description: &ThermalDescription) -> [BusLink; 2] {
    let own_k = description.bus_temperature_k.value();
    let faces = [
        ("bus_conductance_w_m2_k", description.bus_conductance_w_m2_k),
        ("rear_bus_conductance_w_m2_k", description.rear_bus_conductance_w_m2_k),
    ];
    faces.map(|(key, given)| {
        let Some(NotNegative(conductance_w_m2_k)) = given else { return BusLink::NONE };
        let temperature_k = own_k.or(part.materials.environment.bus_temperature_k);
        if temperature_k.is_none() && conductance_w_m2_k > 0.0 {
            let allowed = "`bus_temperature_k` beside it or under [thermal]";
            part.key(key).report("no temperature of the bus", allowed);
        }
        BusLink { conductance_w_m2_k, temperature_k: temperature_k.unwrap_or(0.0) }
    })
}

fn conduction(description: &ConductionDescription) -> Conduction {
    description.honeycomb.as_ref().map_or_else(
        || Conduction {
            conductance_w_m2_k: description.conductance_w_m2_k.value().unwrap_or(0.0),
            radiative_exchange: description.radiative_exchange.value().unwrap_or(0.0),
        },
        |honeycomb| honeycomb.value().conduction(),
    )
}
