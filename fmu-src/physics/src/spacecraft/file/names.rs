//! Lists of parts and what each part is called: the names of one kind are distinct.

use super::describe_shapes::{BoxDescription, DiscDescription, DishDescription, FacetedCylinderDescription};
use super::describe_swinging::{FlexibleModeDescription, SloshDescription};
use super::description::{
    Description, InstrumentDescription, PanelDescription, PlateDescription, SunSensorDescription,
    TankDescription, ThrusterDescription, WheelDescription,
};
use crate::toml::{Checker, Place};
use std::collections::BTreeMap;

/// A part that has a name, or the name of its kind and its number from 1.
pub(crate) trait Named {
    /// What such a part is.
    const KIND: &'static str;

    /// The name that the file gives.
    fn name(&self) -> Option<&str>;

    /// What the part is called.
    fn called(&self, index: usize) -> String {
        self.name().map_or_else(|| format!("{} {}", Self::KIND, index + 1), str::to_owned)
    }
}

macro_rules! named {
    ($($part:ty: $kind:literal),* $(,)?) => {
        $(impl Named for $part {
            const KIND: &'static str = $kind;

            fn name(&self) -> Option<&str> {
                self.name.as_deref()
            }
        })*
    };
}

named! {
    PlateDescription: "plate",
    BoxDescription: "box",
    FacetedCylinderDescription: "cylinder",
    DiscDescription: "disc",
    DishDescription: "dish",
    PanelDescription: "panel",
    WheelDescription: "wheel",
    SunSensorDescription: "sun sensor",
    TankDescription: "tank",
    ThrusterDescription: "thruster",
    FlexibleModeDescription: "flexible mode",
    SloshDescription: "slosh",
}

impl Named for InstrumentDescription {
    const KIND: &'static str = "instrument";

    fn name(&self) -> Option<&str> {
        Some(&self.name)
    }
}

/// A list that may be left out but not be empty.
pub(crate) fn list<D, S>(
    check: &mut Checker<'_>,
    at: &Place,
    items: Option<&[D]>,
    mut read: impl FnMut(&mut Checker<'_>, &Place, usize, &D) -> S,
) -> Vec<S> {
    if items.is_some_and(<[D]>::is_empty) {
        check.report(at, "an empty list", "at least one item, or no such key");
    }
    items.unwrap_or_default().iter().enumerate().map(|(i, d)| read(check, &at.item(i), i, d)).collect()
}

/// Where a part stands, what it is called, and whether the file says so.
type Name = (Place, String, bool);

fn names<D: Named>(at: Place, items: Option<&[D]>) -> Vec<Name> {
    let items = items.unwrap_or_default().iter().enumerate();
    items.map(|(i, item)| (at.item(i), item.called(i), item.name().is_some())).collect()
}

/// Two parts of one kind with one name could not be distinguished; all plates are one kind, the shade's among them.
pub(crate) fn check_names(check: &mut Checker<'_>, description: &Description) {
    let at = |key: &str| Place::root().key(key);
    let of_shade = description
        .sunshade
        .as_ref()
        .map_or_else(Vec::new, |shade| names(at("sunshade").key("plates"), shade.plates.as_deref()));
    let plates = [
        names(at("plates"), description.plates.as_deref()),
        names(at("boxes"), description.boxes.as_deref()),
        names(at("cylinders"), description.cylinders.as_deref()),
        names(at("discs"), description.discs.as_deref()),
        names(at("dishes"), description.dishes.as_deref()),
        of_shade,
    ];
    let kinds = [
        plates.concat(),
        names(at("panels"), description.panels.as_deref()),
        names(at("wheels"), description.wheels.as_deref()),
        names(at("sun_sensors"), description.sun_sensors.as_deref()),
        names(at("instruments"), description.instruments.as_deref()),
        names(at("tanks"), description.tanks.as_deref()),
        names(at("thrusters"), description.thrusters.as_deref()),
        names(at("flexible_modes"), description.flexible_modes.as_deref()),
        names(at("slosh"), description.slosh.as_deref()),
    ];
    for kind in &kinds {
        check_kind(check, kind);
    }
}

fn check_kind(check: &mut Checker<'_>, names: &[Name]) {
    let mut known: BTreeMap<&str, &Name> = BTreeMap::new();
    for part in names {
        let (at, name, is_given) = part;
        let (other, _, other_is_given) = *known.entry(name).or_insert(part);
        // A plate and one of the shade that nobody named are both called by their number.
        if at != other && (*is_given || *other_is_given) {
            let unnamed = if *is_given { "" } else { " as what has no name is called" };
            let found = format!("`{name}`{unnamed}, the name of {other} too");
            check.report(&at.key("name"), found, "a name of its own");
        }
    }
}
