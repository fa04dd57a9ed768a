//! Mass properties, from their description; panels and tanks are a part of them.

use nalgebra::{Matrix3, Vector3};

use super::describe_surfaces::PanelDescription;
use super::description::MassDescription;
use super::part_reader::PartReader;
use crate::spacecraft::mass::{MassProperties, PanelMass, check_inertia};
use crate::toml::{Checker, KeyPath, Point, Positive, Written};

pub(crate) fn mass(part: &mut PartReader<'_, '_>, description: &MassDescription) -> MassProperties {
    MassProperties {
        inertia_body_kg_m2: inertia_kg_m2(part, description.inertia_kg_m2),
        mass_kg: description.mass_kg.0,
        center_of_mass_body_m: description.center_of_mass_m.value(),
    }
}

/// Parts of one kind, each with its mass if it has one, are a part of the spacecraft's mass.
pub(crate) fn parts_fit(
    check: &mut Checker<'_>,
    (kind, key): (&str, &str),
    masses_kg: impl Iterator<Item = Option<f64>>,
    whole_kg: f64,
) {
    let mut sum_kg = 0.0;
    for (index, mass_kg) in masses_kg.enumerate() {
        let Some(mass_kg) = mass_kg else { continue };
        sum_kg += mass_kg;
        if sum_kg >= whole_kg {
            let at = KeyPath::root().key(kind).item(index).key(key);
            let found = format!("{mass_kg}, with the {kind} before it {sum_kg}");
            let allowed = format!("less than mass_properties.mass_kg = {whole_kg}, of which it is a part");
            check.report(&at, found, allowed);
            return;
        }
    }
}

fn inertia_kg_m2(part: &mut PartReader<'_, '_>, rows: [[f64; 3]; 3]) -> Matrix3<f64> {
    let inertia_kg_m2 = Matrix3::from(rows).transpose();
    if let Err(allowed) = check_inertia(&inertia_kg_m2) {
        part.report("inertia_kg_m2", format!("{rows:?}"), allowed);
    }
    inertia_kg_m2
}

/// A panel's mass in the panel frame.
pub(crate) fn panel_mass(
    part: &mut PartReader<'_, '_>,
    description: &PanelDescription,
    area_m2: f64,
    center_m: Vector3<f64>,
    normal: &Vector3<f64>,
) -> Option<PanelMass> {
    let Positive(mass_kg) = description.mass_kg?;
    let place = description.mass_center_m.map_or(center_m, Point::value);
    let mut mass = PanelMass::square_plate(mass_kg, area_m2, place, normal);
    if let Some(rows) = description.inertia_kg_m2 {
        mass.inertia_body_kg_m2 = inertia_kg_m2(part, rows);
    }
    Some(mass)
}
