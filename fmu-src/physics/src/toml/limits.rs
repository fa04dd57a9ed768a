//! Limits on the size of TOML files: bytes, items of a list or table, problems reported.
//!
//! A file beyond a limit is refused before anything is computed from it, so that no file costs more than a second and
//! 200 MB.

use super::key_path::KeyPath;

/// Longest text of a file, in bytes.
pub const MOST_TEXT_BYTES: usize = 4 << 20;

/// Most problems that an error lists; it counts the others.
pub const MOST_PROBLEMS: usize = 100;

/// Most thrusters of a spacecraft: a set of them is a bit mask.
pub const MOST_THRUSTERS: usize = 24;
/// Most antennas of a spacecraft.
pub const MOST_ANTENNAS: usize = 6;

/// Most items of a list or names of a table by its key; [`MOST_ITEMS`] of every other.
pub const LIMITS: &[(&str, usize)] = &[
    ("plates", 2000),
    ("boxes", 200),
    ("cylinders", 200),
    ("discs", 200),
    ("dishes", 200),
    ("panels", 100),
    ("wheels", 64),
    ("tanks", 64),
    ("sets", MOST_THRUSTERS),
    ("thrusters", MOST_THRUSTERS),
    ("antennas", MOST_ANTENNAS),
    ("thruster", MOST_THRUSTERS),
    ("flexible_modes", 64),
    ("slosh", 64),
    ("sun_sensors", 64),
    ("instruments", 64),
    ("polygon_m", 1000),
    ("start", 5000),
    ("set", 5000),
    ("command", 10_000),
];

/// In a timeline these go before [`LIMITS`]: its panels are positions over time.
pub const TIMELINE_LIMITS: &[(&str, usize)] = &[("panels", 10_000)];

/// Most items of a list or names of a table that [`LIMITS`] does not name.
pub const MOST_ITEMS: usize = 20_000;

/// Most items of the list or names of the table at a place, `own` limits of the kind of file going first.
pub(super) fn most_items(at: &KeyPath, own: &[(&str, usize)]) -> usize {
    let key = at.last_key().unwrap_or_default();
    own.iter().chain(LIMITS).find(|(name, _)| *name == key).map_or(MOST_ITEMS, |(_, most)| *most)
}
