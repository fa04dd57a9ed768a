//! What kind of file a TOML text is meant as, recognised by its keys also where it is damaged.

use physics::toml::nearest;
use toml::de::DeTable;

/// A kind of file that people write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A spacecraft or a spinner.
    Spacecraft,
    /// A mission.
    Mission,
    /// Commands over time.
    Timeline,
}

/// The table that every spacecraft and spinner has.
const OF_SPACECRAFT: &str = "mass_properties";
/// The list that every timeline has.
const OF_TIMELINE: &str = "command";
/// Keys that only missions have.
const OF_MISSION: [&str; 14] = [
    "spacecraft",
    "model",
    "fmu",
    "timeline",
    "ephemeris",
    "stop",
    "step",
    "every",
    "record",
    "output",
    "plot",
    "set",
    "inputs",
    "limits",
];

impl FileKind {
    /// By the keys of the text.
    pub fn of(text: &str) -> Self {
        let (root, _) = DeTable::parse_recoverable(text);
        let root = root.get_ref();
        let has = |key: &str| root.contains_key(key);
        let is_like = |key: &str| root.keys().any(|found| nearest(found.get_ref(), &[key]).is_some());
        if has(OF_SPACECRAFT) {
            Self::Spacecraft
        } else if OF_MISSION.into_iter().any(has) {
            Self::Mission
        } else if is_like(OF_TIMELINE) {
            Self::Timeline
        } else {
            Self::Spacecraft
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_tell_the_kind() {
        for (text, kind) in [
            (include_str!("new/spacecraft.toml"), FileKind::Spacecraft),
            (include_str!("new/spinner.toml"), FileKind::Spacecraft),
            (include_str!("new/mission.toml"), FileKind::Mission),
            (include_str!("new/timeline.toml"), FileKind::Timeline),
            ("[[comand]]\nat = 0\n", FileKind::Timeline),
            ("spacecraft = \"a.toml\"\nstop = \"torn", FileKind::Mission),
            ("", FileKind::Spacecraft),
            ("name = 1\n[optics.a]\n", FileKind::Spacecraft),
        ] {
            assert_eq!(FileKind::of(text), kind, "{text}");
        }
    }
}
