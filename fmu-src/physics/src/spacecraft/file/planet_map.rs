//! The planet's surface cell by cell, from its description.

use super::describe_body::PlanetMapDescription;
use super::part_reader::PartReader;
use crate::spacecraft::planet_map::{HOTTEST_K, MOST_BELTS, PlanetCell, PlanetMap};

/// The map, unless something in it was reported.
pub(crate) fn planet_map(
    part: &mut PartReader<'_, '_>,
    description: &PlanetMapDescription,
) -> Option<PlanetMap> {
    let belts = description.temperature_k.len();
    let [reflectivity, emissivity, temperature] = [
        ("diffuse_reflectivity", &description.diffuse_reflectivity, 1.0, "a number from 0 to 1"),
        ("emissivity", &description.emissivity, 1.0, "a number from 0 to 1"),
        ("temperature_k", &description.temperature_k, HOTTEST_K, "a number from 0 to 10000 K"),
    ]
    .map(|(key, rows, most, allowed)| {
        let (place, check) = (part.at.key(key), &mut *part.check);
        if rows.len() != belts || !(1..=MOST_BELTS).contains(&belts) {
            let requested = format!("as many as `temperature_k` has, 1 to {MOST_BELTS}");
            check.report(&place, format_args!("{} belts", rows.len()), requested);
        }
        for (belt, row) in rows.iter().enumerate() {
            let place = place.item(belt);
            if row.len() != 2 * rows.len() {
                let requested = format!("{}, twice as many as there are belts", 2 * rows.len());
                check.report(&place, format_args!("{} cells", row.len()), requested);
            }
            for (cell, value) in row.iter().enumerate() {
                check.within(&place.item(cell), *value, 0.0, most, allowed);
            }
        }
        rows.concat()
    });
    let cells = reflectivity.into_iter().zip(emissivity).zip(temperature);
    let cells = cells.map(|((diffuse_reflectivity, emissivity), temperature_k)| PlanetCell {
        diffuse_reflectivity,
        emissivity,
        temperature_k,
    });
    PlanetMap::new(belts, cells.collect()).ok()
}
