//! Sets of thrusters, by the file's own names.

use super::description::SpacecraftDescription;
use super::names::check_item_name;
use crate::toml::{Checker, KeyPath};

/// The names of the sets: those that `sets` lists, then others in the order of their first thruster.
pub(crate) fn thruster_sets(check: &mut Checker<'_>, description: &SpacecraftDescription) -> Vec<String> {
    let mut sets: Vec<String> = Vec::new();
    let place = KeyPath::root().key("sets");
    for (index, name) in description.sets.iter().flat_map(|sets| sets.iter()).enumerate() {
        let at = place.item(index);
        check_item_name(check, &at, name);
        if sets.contains(name) {
            check.report(&at, format_args!("`{name}` once more"), "each set once");
        } else {
            sets.push(name.clone());
        }
    }
    let place = KeyPath::root().key("thrusters");
    for (index, thruster) in description.thrusters.iter().flat_map(|list| list.iter()).enumerate() {
        let Some(name) = thruster.set.as_ref().filter(|name| !sets.contains(name)) else { continue };
        check_item_name(check, &place.item(index).key("set"), name);
        sets.push(name.clone());
    }
    sets
}
