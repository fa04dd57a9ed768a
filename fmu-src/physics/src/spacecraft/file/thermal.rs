//! Heat of a surface, from its description.

use super::describe_thermal::{ConductionDescription, ThermalDescription};
use super::materials::ChosenMaterial;
use super::part_reader::PartReader;
use crate::spacecraft::thermal::{BusLink, Conduction, Honeycomb, Thermal};
use crate::toml::{NotNegative, Table};

/// Heat of a surface whose faces are of these materials.
pub(crate) fn thermal(
    part: &mut PartReader<'_, '_>,
    description: Option<&ThermalDescription>,
    front: ChosenMaterial,
    rear: Option<ChosenMaterial>,
) -> Thermal {
    let nothing = ThermalDescription::default();
    let has_rear = rear.is_some() || part.is_stand_in("rear_optics");
    let mut part = part.table("thermal");
    part.check.rules(&part.at, ThermalDescription::RULES);
    let description = description.unwrap_or(&nothing);
    if !has_rear {
        let needs_rear = [
            ("conduction", description.conduction.is_some()),
            ("rear_internal_heat_w", description.rear_internal_heat_w.is_some()),
            ("rear_bus_conductance_w_m2_k", description.rear_bus_conductance_w_m2_k.is_some()),
        ];
        for (key, _) in needs_rear.into_iter().filter(|(_, given)| *given) {
            part.report(key, "a surface without `rear_optics`", "a surface with both faces");
        }
    }
    let bus = bus(&mut part, description);
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
fn bus(part: &mut PartReader<'_, '_>, description: &ThermalDescription) -> [BusLink; 2] {
    let own_k = description.bus_temperature_k.map(f64::from);
    let faces = [
        ("bus_conductance_w_m2_k", description.bus_conductance_w_m2_k),
        ("rear_bus_conductance_w_m2_k", description.rear_bus_conductance_w_m2_k),
    ];
    faces.map(|(key, given)| {
        let Some(NotNegative(conductance_w_m2_k)) = given else { return BusLink::NONE };
        let temperature_k = own_k.or(part.materials.environment.bus_temperature_k);
        if temperature_k.is_none() && conductance_w_m2_k > 0.0 {
            let allowed = "`bus_temperature_k` beside it or under [thermal]";
            part.report(key, "no temperature of the bus", allowed);
        }
        BusLink { conductance_w_m2_k, temperature_k: temperature_k.unwrap_or(0.0) }
    })
}

fn conduction(description: &ConductionDescription) -> Conduction {
    let Some(honeycomb) = &description.honeycomb else {
        return Conduction {
            conductance_w_m2_k: description.conductance_w_m2_k.map_or(0.0, f64::from),
            radiative_exchange: description.radiative_exchange.map_or(0.0, f64::from),
        };
    };
    Honeycomb {
        conductivity_w_m_k: honeycomb.conductivity_w_m_k.0,
        thickness_m: honeycomb.thickness_m.0,
        wall_area_ratio: honeycomb.wall_area_ratio.0,
        packing_factor: honeycomb.packing_factor.0,
        internal_emissivity: honeycomb.internal_emissivity.0,
    }
    .conduction()
}
