//! Kind of file that a TOML text is meant as, recognised by its keys also where it is damaged; the wrong kind is refused by name.

use std::{fmt, path::Path};

use physics::toml::nearest;
use toml::de::DeTable;

/// A kind of file that people write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// A spacecraft or a spinner.
    Spacecraft,
    /// A mission.
    Mission,
    /// Commands, positions of panels and events over time.
    Timeline,
    /// Positions over time.
    Ephemeris,
    /// How far arrays and attitude may go to hold a mission's momentum.
    Plan,
    /// Departure of a leg, and the encounter that it leads to.
    Leg,
    /// Values that vary over many runs, and results that are kept of each.
    Campaign,
}

/// The table that every spacecraft and spinner has.
const OF_SPACECRAFT: &str = "mass_properties";
/// Lists that only timelines have.
const OF_TIMELINE: [&str; 2] = ["command", "event"];
/// The list that timelines share with spacecraft, and the keys of its items that only timelines have.
const PANELS: (&str, [&str; 3]) = ("panels", ["at", "sunOffset", "windmill"]);
/// Keys that only one kind has but for those below it: of spacecraft and spinners tables, where that of every one is missing or
/// misspelt; a leg has some of a plan's.
const BY_KEYS: [(FileKind, &[&str]); 6] = [
    (
        FileKind::Spacecraft,
        &[
            "optics",
            "plates",
            "boxes",
            "cylinders",
            "discs",
            "dishes",
            "sunshade",
            "panels",
            "wheels",
            "tanks",
            "thrusters",
            "groups",
        ],
    ),
    (FileKind::Ephemeris, &["frame", "body", "coarse"]),
    (FileKind::Campaign, &["vary", "keep", "sampling", "runs", "correlation"]),
    (FileKind::Leg, &["depart", "arrive"]),
    (
        FileKind::Plan,
        &[
            "mission",
            "freeze",
            "window",
            "windmill",
            "alternation",
            "sunOffset",
            "tilt",
            "contactShare",
            "activity",
            "flyby",
            "update",
            "compare",
            "montecarlo",
        ],
    ),
    (
        FileKind::Mission,
        &[
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
        ],
    ),
];

impl FileKind {
    /// By the keys of the text; `None` where no key identifies it.
    pub fn recognize(text: &str) -> Option<Self> {
        let (root, _) = DeTable::parse_recoverable(text);
        let root = root.get_ref();
        let has = |key: &str| root.contains_key(key);
        let is_like = |key: &str| root.keys().any(|found| nearest(found.get_ref(), &[key]).is_some());
        let by_keys = BY_KEYS.into_iter().find(|(_, keys)| keys.iter().any(|key| has(key)));
        if has(OF_SPACECRAFT) {
            Some(Self::Spacecraft)
        } else if panels_have_times(root) {
            Some(Self::Timeline)
        } else if let Some((kind, _)) = by_keys {
            Some(kind)
        } else if OF_TIMELINE.into_iter().any(is_like) {
            Some(Self::Timeline)
        } else {
            is_like(OF_SPACECRAFT).then_some(Self::Spacecraft)
        }
    }

    /// Refuses a text that says nothing, or is of another kind.
    ///
    /// # Errors
    /// What was found, and what is done with that.
    pub fn check(self, file: &str, text: &str) -> Result<(), String> {
        if is_blank(text) {
            let new = if self == Self::Ephemeris { "" } else { "new " };
            return Err(format!(
                "{file}: found an empty file, allowed: {self}: see `heliotorque {new}{}`",
                self.word()
            ));
        }
        match Self::recognize(text) {
            Some(found) if found != self => {
                Err(format!("{file}: found {found}, allowed: {self}: {}", found.remedy(file)))
            }
            _ => Ok(()),
        }
    }

    /// Reads a file of this kind.
    ///
    /// # Errors
    /// A file that cannot be read, is empty, or is of another kind.
    pub fn read(self, path: &Path) -> Result<String, String> {
        let text = files::read_text(path)?;
        self.check(&path.display().to_string(), &text)?;
        Ok(text)
    }

    /// Its name for `heliotorque new`.
    fn word(self) -> &'static str {
        ["spacecraft", "mission", "timeline", "ephemeris", "plan", "leg", "campaign"][self as usize]
    }

    /// Returns the commands for a file of this kind.
    pub fn remedy(self, file: &str) -> String {
        match self {
            Self::Spacecraft => format!(
                "`heliotorque pack {file}` makes an FMU of it, a mission (`heliotorque new mission`) simulates it"
            ),
            Self::Mission => format!("run it: `heliotorque run {file}`"),
            Self::Plan | Self::Leg => format!("`heliotorque plan {file} --output DIR` carries it out"),
            Self::Campaign => format!("`heliotorque sweep {file}` simulates it"),
            Self::Timeline | Self::Ephemeris => {
                let word = self.word();
                format!("`{word} = \"{file}\"` in a mission or `heliotorque pack --{word} {file}` takes it")
            }
        }
    }
}

impl fmt::Display for FileKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let article = if *self == Self::Ephemeris { "an" } else { "a" };
        write!(f, "{article} {}", self.word())
    }
}

/// Whether there are panels, and those of a timeline.
fn panels_have_times(root: &DeTable<'_>) -> bool {
    let (list, keys) = PANELS;
    let items = root.get(list).and_then(|list| list.get_ref().as_array());
    let mut tables =
        items.into_iter().flat_map(|items| items.iter()).filter_map(|it| it.get_ref().as_table());
    tables.any(|table| keys.into_iter().any(|key| table.contains_key(key)))
}

/// Whether a text has nothing but comments.
pub fn is_blank(text: &str) -> bool {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    text.lines().all(|line| line.trim().is_empty() || line.trim_start().starts_with('#'))
}

/// Refuses a TOML file where an FMU or a system is expected, by what it is.
///
/// # Errors
/// The file's kind, and what is done with that.
pub fn check_archive(path: &Path) -> Result<(), String> {
    if path.extension().is_none_or(|extension| !extension.eq_ignore_ascii_case("toml")) || !path.is_file() {
        return Ok(());
    }
    let (file, text) = (path.display().to_string(), files::read_text(path)?);
    Err(match FileKind::recognize(&text) {
        Some(found) => format!("{file}: found {found}, allowed: an FMU or a system: {}", found.remedy(&file)),
        None => format!("{file}: found a TOML file, allowed: an FMU or a system: see `heliotorque check`"),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_tell_the_kind() {
        for (text, kind) in [
            (include_str!("../../cli/src/new/spacecraft.toml"), Some(FileKind::Spacecraft)),
            (include_str!("../../cli/src/new/spinner.toml"), Some(FileKind::Spacecraft)),
            (include_str!("../../cli/src/new/mission.toml"), Some(FileKind::Mission)),
            (include_str!("../../cli/src/new/timeline.toml"), Some(FileKind::Timeline)),
            (include_str!("../../cli/src/new/plan.toml"), Some(FileKind::Plan)),
            (include_str!("../../cli/src/new/leg.toml"), Some(FileKind::Leg)),
            ("[flyby]\nbody = \"mercury\"\n", Some(FileKind::Plan)),
            ("[update]\nat = 0\n", Some(FileKind::Plan)),
            ("[compare]\nnext = 0\n", Some(FileKind::Plan)),
            ("[montecarlo]\nruns = 9\n", Some(FileKind::Plan)),
            (include_str!("../../cli/src/new/campaign.toml"), Some(FileKind::Campaign)),
            ("mission = \"a.toml\"\n[arrive]\nbody = \"mercury\"\n", Some(FileKind::Leg)),
            ("[[comand]]\nat = 0\n", Some(FileKind::Timeline)),
            ("[[panels]]\nat = 0\n", Some(FileKind::Timeline)),
            ("[[panels]]\nsun_offset_deg = 3\n[[command]]\n", Some(FileKind::Spacecraft)),
            ("[[event]]\nat = 0\n[[panels]]\nsunOffset = 0\n", Some(FileKind::Timeline)),
            ("[[evnt]]\nat = 0\n", Some(FileKind::Timeline)),
            ("spacecraft = \"a.toml\"\nstop = \"torn", Some(FileKind::Mission)),
            ("frame = \"eme2000\"\n[[body]]\n", Some(FileKind::Ephemeris)),
            ("[mass_properties]\n[body]\n", Some(FileKind::Spacecraft)),
            ("[mass_propertys]\nmass_kg = 1\n", Some(FileKind::Spacecraft)),
            ("", None),
            ("name = 1\n[optics.a]\n", Some(FileKind::Spacecraft)),
            ("name = 1\n", None),
        ] {
            assert_eq!(FileKind::recognize(text), kind, "{text}");
        }
    }

    #[test]
    fn another_kind_is_refused_with_what_is_done_with_it() {
        let refused = |kind: FileKind, text: &str| kind.check("x.toml", text).unwrap_err();
        let mission = include_str!("../../cli/src/new/mission.toml");
        assert_eq!(
            refused(FileKind::Spacecraft, mission),
            "x.toml: found a mission, allowed: a spacecraft: run it: `heliotorque run x.toml`"
        );
        assert!(refused(FileKind::Timeline, "\u{feff}# nothing\n\n").contains("found an empty file"));
        assert_eq!(FileKind::Mission.check("x.toml", mission), Ok(()));
        assert_eq!(FileKind::Spacecraft.check("x.toml", "name = 1\n"), Ok(()));
    }
}
