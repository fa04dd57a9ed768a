//! The shape of a spacecraft file, as people write it: SI units named in the keys, angles in degrees (`_deg`).

use std::collections::BTreeMap;

use super::antennas::AntennaDescription;
use super::articulation::ArticulationDescription;
use super::body::BodyDescription;
use super::downlinks::DownlinksDescription;
use super::instruments::InstrumentDescription;
use super::mass::MassDescription;
use super::materials::{OpticsDescription, SurroundingsDescription};
use super::momentum::MomentumDescription;
use super::panel::PanelDescription;
use super::planet_map::PlanetMapDescription;
use super::plate_table::{PlateDescription, SunshadeDescription};
use super::pointing_table::PointingDescription;
use super::shapes::{BoxDescription, DiscDescription, DishDescription, FacetedCylinderDescription};
use super::start::StartTable;
use super::sun_sensors::SunSensorDescription;
use super::swinging::{FlexibleModeDescription, SloshDescription};
use super::tank::TankDescription;
use super::thruster::ThrusterDescription;
use super::wheels::WheelDescription;
use super::zones::{HotPoleDescription, SunKeepInDescription};
use crate::toml::{List, MOST_ANTENNAS, MOST_THRUSTERS, NonEmpty, tables};

tables! {
/// A spacecraft: what light falls on, what it weighs, what stores its momentum.
#[cfg_attr(feature = "schema", schemars(title = "heliotorque spacecraft"))]
struct SpacecraftDescription {
    /// Name of the spacecraft.
    name: String,
    /// Whether models that can report temperature and force of every plate.
    per_plate_outputs: bool = false,
    mass_properties: MassDescription,
    /// Surface materials by name; plates, cylinder and panels refer to them.
    optics: BTreeMap<String, OpticsDescription>,
    /// Flat surfaces fixed in the body frame, other than a sunshade.
    plates: Option<NonEmpty<PlateDescription>>,
    /// Boxes of plates.
    boxes: Option<NonEmpty<BoxDescription>>,
    /// Cylinders of plates.
    cylinders: Option<NonEmpty<FacetedCylinderDescription>>,
    /// Round discs, a plate each.
    discs: Option<NonEmpty<DiscDescription>>,
    /// Paraboloids of plates.
    dishes: Option<NonEmpty<DishDescription>>,
    sunshade: Option<SunshadeDescription>,
    /// Panels that turn about one axis.
    panels: Option<NonEmpty<PanelDescription>>,
    /// Reaction wheels.
    wheels: Option<NonEmpty<WheelDescription>>,
    /// Propellant tanks.
    tanks: Option<NonEmpty<TankDescription>>,
    /// Names of the sets of thrusters in the order of their items in `thrust.request` and `burn.thrusters`, where that is not
    /// the order of their first thruster; sets without thrusters may be among them.
    sets: Option<List<String, 1, MOST_THRUSTERS>>,
    /// Thrusters; they need a tank.
    thrusters: Option<List<ThrusterDescription, 1, MOST_THRUSTERS>>,
    /// Flexible modes.
    flexible_modes: Option<NonEmpty<FlexibleModeDescription>>,
    /// Propellant that swings.
    slosh: Option<NonEmpty<SloshDescription>>,
    /// Sun sensors; left out, six along the body axes.
    sun_sensors: Option<Vec<SunSensorDescription>>,
    /// Instruments, which Guidance points by their number from 1.
    instruments: Option<NonEmpty<InstrumentDescription>>,
    /// Antennas to the Earth, the items of `antenna.select` from 1; without any there are no downlinks.
    antennas: Option<List<AntennaDescription, 1, MOST_ANTENNAS>>,
    momentum: Option<MomentumDescription>,
    sun_keep_in: Option<SunKeepInDescription>,
    pointing: Option<PointingDescription>,
    downlinks: Option<DownlinksDescription>,
    articulation: Option<ArticulationDescription>,
    hot_pole: Option<HotPoleDescription>,
    planet_map: Option<PlanetMapDescription>,
    body: Option<BodyDescription>,
    thermal: Option<SurroundingsDescription>,
    start: Option<StartTable>,
    /// Variables that are local constants of this FMU, with their values; `heliotorque pack --fix` writes them.
    fixed: Option<StartTable>,
} rules {
    AnyOf plates boxes cylinders discs dishes sunshade panels: "no surface",
        "at least one of `plates`, `boxes`, `cylinders`, `discs`, `dishes`, `sunshade`, `panels`";
}
}

/// The schema as indented JSON text (draft 2020-12): point an editor with TOML support at it.
#[cfg(feature = "schema")]
pub fn schema() -> String {
    crate::toml::schema::<SpacecraftDescription>()
}

#[cfg(feature = "schema")]
#[cfg(test)]
mod tests {
    //! Every key of the shipped spacecraft stands in the schema, which allows no other keys.

    use toml::Value;

    use super::*;
    use crate::spacecraft::MESSENGER_TOML;

    /// Follows references and takes the first of several forms.
    fn resolve<'s>(root: &'s Value, node: &'s Value) -> &'s Value {
        if let Some(form) = node.get("anyOf").and_then(|forms| forms.get(0)) {
            return resolve(root, form);
        }
        match node.get("$ref").and_then(Value::as_str) {
            Some(reference) => reference.split('/').skip(1).fold(root, |at, key| &at[key]),
            None => node,
        }
    }

    fn assert_allowed(root: &Value, node: &Value, value: &Value, place: &str) {
        let node = resolve(root, node);
        match value {
            Value::Table(table) => {
                for (key, inner) in table {
                    let place = format!("{place}.{key}");
                    let named = node.get("properties").and_then(|properties| properties.get(key));
                    let allowed = named.or(node.get("additionalProperties").filter(|any| any.is_table()));
                    assert_allowed(root, allowed.expect(&place), inner, &place);
                }
            }
            Value::Array(list) => {
                for inner in list {
                    assert_allowed(root, &node["items"], inner, place);
                }
            }
            _ => {}
        }
    }

    #[test]
    fn the_shipped_file_uses_known_keys_only() {
        let root = Value::try_from(schemars::schema_for!(SpacecraftDescription).as_value()).unwrap();
        assert_allowed(&root, &root, &toml::from_str(MESSENGER_TOML).unwrap(), "");
    }

    #[test]
    fn every_table_is_closed_and_every_key_described() {
        let root = Value::try_from(schemars::schema_for!(SpacecraftDescription).as_value()).unwrap();
        let definitions = root["$defs"].as_table().unwrap();
        for (name, node) in definitions.iter().chain([(&"spacecraft".to_owned(), &root)]) {
            let Some(properties) = node.get("properties").and_then(Value::as_table) else { continue };
            assert_eq!(node.get("additionalProperties"), Some(&Value::Boolean(false)), "{name}");
            for (key, property) in properties {
                let described = property.get("description").or(resolve(&root, property).get("description"));
                assert!(described.is_some(), "{name}.{key}");
            }
        }
    }
}
