//! Keys that scenarios and options read: tables of a command and keys of its tables.

use crate::enumeration::Enumerated;
use crate::guidance::pointing::command::{
    AimpointOption, BodyRollOption, BoresightOption, ExternalRollOption, ScanFrame, Scenario,
};
use crate::toml::Place;

/// Keys of a table.
#[derive(Clone, Copy)]
pub(super) struct Keys {
    /// Keys without a default.
    pub needed: &'static [&'static str],
    /// Keys with a default.
    pub optional: &'static [&'static str],
}

impl Keys {
    /// Whether a key is among them.
    pub(super) fn has(&self, key: &str) -> bool {
        self.needed.contains(&key) || self.optional.contains(&key)
    }

    /// Reports keys among the `known` ones that are given and that `reader` does not read, and keys that lack.
    pub(super) fn check(self, at: &Place<'_>, known: &[&str], reader: &str) {
        let Self { needed, optional } = self;
        for key in known {
            let (is_given, is_needed) = (at.key(key).is_written(), needed.contains(key));
            if is_given && !is_needed && !optional.contains(key) {
                let read: Vec<&str> = needed.iter().chain(optional).copied().collect();
                let allowed = if read.is_empty() { "no other key".to_owned() } else { read.join(", ") };
                at.key(key).report(format_args!("what {reader} does not read"), allowed);
            } else if is_needed && !is_given {
                at.report_lack(key, format_args!("a value for `{key}`, which {reader} reads"));
            }
        }
    }
}

/// These keys.
pub(super) const fn keys(needed: &'static [&'static str], optional: &'static [&'static str]) -> Keys {
    Keys { needed, optional }
}

/// No key.
pub(super) const NOTHING: Keys = keys(&[], &[]);
const VECTOR: Keys = keys(&["vector"], &[]);
const AZIMUTH_ELEVATION: Keys = keys(&["azimuth", "elevation"], &[]);
const CELESTIAL: Keys = keys(&["rightAscension", "declination"], &[]);

/// Tables of a command that a scenario may read.
pub(super) const TABLES: &[&str] = &[
    "boresight",
    "aimpoint",
    "secondAimpoint",
    "bodyRoll",
    "externalRoll",
    "limb",
    "scan",
    "burn",
    "sun",
    "alternate",
];

/// Tables that a scenario reads.
pub(super) fn tables(scenario: Scenario) -> Keys {
    match scenario {
        Scenario::Generic => keys(&["boresight", "aimpoint", "bodyRoll", "externalRoll"], &["scan"]),
        Scenario::PlusZ => keys(&["aimpoint"], &["boresight", "scan"]),
        Scenario::Nadir => keys(&[], &["boresight", "aimpoint", "scan"]),
        Scenario::Gimbal => keys(&["boresight", "aimpoint"], &["scan"]),
        Scenario::DoubleTarget => keys(&["aimpoint", "secondAimpoint"], &["boresight", "scan"]),
        Scenario::Downlink => keys(&[], &["boresight", "aimpoint", "sun", "alternate"]),
        Scenario::LimbTerminator => keys(&[], &["boresight", "limb", "scan"]),
        Scenario::LimbGeneric => keys(&["limb"], &["boresight", "scan"]),
        Scenario::Burn => keys(&[], &["burn"]),
        Scenario::OrbitPhase => NOTHING,
    }
}

/// Fixed aimpoint of a scenario, which may be written.
pub(super) fn own_aimpoint(scenario: Scenario) -> Option<AimpointOption> {
    match scenario {
        Scenario::Nadir => Some(AimpointOption::Nadir),
        Scenario::Downlink => Some(AimpointOption::Earth),
        _ => None,
    }
}

/// Keys that a scenario at the limb reads of its table.
pub(super) fn limb_keys(scenario: Scenario) -> Keys {
    match scenario {
        Scenario::LimbGeneric => keys(&["azimuth"], &["reference", "height", "heightRate"]),
        _ => keys(&[], &["height", "heightRate"]),
    }
}

/// Options of boresight, aimpoint and rolls, and the keys that each reads.
pub(super) trait OptionKeys: Enumerated {
    /// Keys that the option reads.
    fn keys(self) -> Keys;
}

impl OptionKeys for BoresightOption {
    fn keys(self) -> Keys {
        match self {
            Self::Vector => VECTOR,
            Self::AzimuthElevation => AZIMUTH_ELEVATION,
            Self::Gimbal => keys(&["angle"], &[]),
            Self::PhasedArray => keys(&["azimuth"], &[]),
        }
    }
}

impl OptionKeys for AimpointOption {
    fn keys(self) -> Keys {
        match self {
            Self::Vector => VECTOR,
            Self::RightAscensionDeclination => CELESTIAL,
            Self::EarthCentered | Self::SunCentered | Self::PlanetCentered | Self::PlanetFixed => {
                keys(&["position"], &[])
            }
            Self::LatitudeLongitude => keys(&["latitude", "longitude"], &["height"]),
            Self::LvlhDowntrack | Self::LvlhSun => AZIMUTH_ELEVATION,
            Self::Body => keys(&["body"], &[]),
            Self::Sun | Self::Earth | Self::Nadir | Self::Subsolar | Self::OptimalLighting => NOTHING,
            Self::Velocity | Self::OrbitNormal | Self::EclipticNorth => NOTHING,
        }
    }
}

impl OptionKeys for BodyRollOption {
    fn keys(self) -> Keys {
        match self {
            Self::Vector => VECTOR,
            Self::AzimuthElevation => AZIMUTH_ELEVATION,
        }
    }
}

impl OptionKeys for ExternalRollOption {
    fn keys(self) -> Keys {
        match self {
            Self::Vector => VECTOR,
            Self::RightAscensionDeclination => CELESTIAL,
            Self::Sun | Self::Earth | Self::Planet => NOTHING,
            Self::Velocity | Self::OrbitNormal | Self::EclipticNorth => NOTHING,
        }
    }
}

/// Keys that a scan in a frame reads.
pub(super) fn scan_keys(frame: ScanFrame) -> Keys {
    match frame {
        ScanFrame::Body | ScanFrame::InertialRotation => {
            keys(&["rate", "duration"], &["pause", "segments", "reverse"])
        }
        ScanFrame::InertialTranslation | ScanFrame::PlanetTranslation => {
            keys(&["speed", "duration"], &["pause", "segments", "reverse"])
        }
        ScanFrame::LvlhRotation => {
            keys(&["rate", "duration"], &["reference", "pause", "segments", "reverse"])
        }
    }
}
