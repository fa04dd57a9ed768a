//! What scenarios and options read: tables of a command and keys of its tables.

use crate::guidance::pointing::command::{
    AimpointOption, BodyRollOption, BoresightOption, ExternalRollOption, ScanFrame, Scenario,
};

/// Keys of a table.
#[derive(Clone, Copy)]
pub(super) struct Keys {
    /// Those that have no default.
    pub needed: &'static [&'static str],
    /// Those that have one.
    pub optional: &'static [&'static str],
}

const fn keys(needed: &'static [&'static str], optional: &'static [&'static str]) -> Keys {
    Keys { needed, optional }
}

const NOTHING: Keys = keys(&[], &[]);
/// Options of vectors.
const VECTOR: Keys = keys(&["vector"], &[]);
const AZIMUTH_ELEVATION: Keys = keys(&["azimuth", "elevation"], &[]);
const CELESTIAL: Keys = keys(&["rightAscension", "declination"], &[]);

/// What a scenario reads of a command.
#[derive(Clone, Copy)]
pub(super) struct Reads {
    pub boresight: BoresightUse,
    pub aimpoint: AimpointUse,
    pub second_aimpoint: bool,
    /// `bodyRoll` and `externalRoll`.
    pub rolls: bool,
    pub limb: Option<Keys>,
    pub scan: bool,
}

/// What a scenario reads of the boresight.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum BoresightUse {
    /// Its option.
    Option,
    /// The instrument.
    Instrument,
    /// The camera's angle.
    MdisAngle,
    /// An antenna's azimuth, or nothing.
    Antenna,
    /// Nothing.
    Nothing,
}

/// What a scenario reads of the aimpoint.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum AimpointUse {
    /// Its option.
    Option,
    /// Nothing: it always aims at what this option stands for, which may be written.
    Fixed(AimpointOption),
    /// Nothing.
    Nothing,
}

/// What a scenario reads.
pub(super) fn reads(scenario: Scenario) -> Reads {
    let of_instrument = Reads {
        boresight: BoresightUse::Instrument,
        aimpoint: AimpointUse::Option,
        second_aimpoint: false,
        rolls: false,
        limb: None,
        scan: true,
    };
    let of_limb = |keys| Reads { aimpoint: AimpointUse::Nothing, limb: Some(keys), ..of_instrument };
    match scenario {
        Scenario::Generic => Reads { boresight: BoresightUse::Option, rolls: true, ..of_instrument },
        Scenario::PlusZ => of_instrument,
        Scenario::Nadir => Reads { aimpoint: AimpointUse::Fixed(AimpointOption::Nadir), ..of_instrument },
        Scenario::Mdis => Reads { boresight: BoresightUse::MdisAngle, ..of_instrument },
        Scenario::DoubleTarget => Reads { second_aimpoint: true, ..of_instrument },
        Scenario::Downlink => Reads {
            boresight: BoresightUse::Antenna,
            aimpoint: AimpointUse::Fixed(AimpointOption::Earth),
            scan: false,
            ..of_instrument
        },
        Scenario::Burn | Scenario::OrbitPhase => Reads {
            boresight: BoresightUse::Nothing,
            aimpoint: AimpointUse::Nothing,
            scan: false,
            ..of_instrument
        },
        Scenario::LimbTerminator => of_limb(keys(&[], &["height", "heightRate"])),
        Scenario::LimbGeneric => of_limb(keys(&["azimuth"], &["reference", "height", "heightRate"])),
    }
}

/// What an option of the boresight reads.
pub(super) fn boresight_keys(option: BoresightOption) -> Keys {
    match option {
        BoresightOption::Vector => VECTOR,
        BoresightOption::AzimuthElevation => AZIMUTH_ELEVATION,
        BoresightOption::Mdis => keys(&["angle"], &[]),
        BoresightOption::PhasedArray => keys(&["azimuth"], &[]),
    }
}

/// What an option of an aimpoint reads.
pub(super) fn aimpoint_keys(option: AimpointOption) -> Keys {
    match option {
        AimpointOption::Vector => VECTOR,
        AimpointOption::RightAscensionDeclination => CELESTIAL,
        AimpointOption::EarthCentered
        | AimpointOption::SunCentered
        | AimpointOption::PlanetCentered
        | AimpointOption::PlanetFixed => keys(&["position"], &[]),
        AimpointOption::LatitudeLongitude => keys(&["latitude", "longitude"], &["height"]),
        AimpointOption::LvlhDowntrack | AimpointOption::LvlhSun => AZIMUTH_ELEVATION,
        AimpointOption::Sun
        | AimpointOption::Earth
        | AimpointOption::Nadir
        | AimpointOption::Subsolar
        | AimpointOption::OptimalLighting => NOTHING,
        AimpointOption::Body => keys(&["body"], &[]),
    }
}

/// What an option of the body roll vector reads.
pub(super) fn body_roll_keys(option: BodyRollOption) -> Keys {
    match option {
        BodyRollOption::Vector => VECTOR,
        BodyRollOption::AzimuthElevation => AZIMUTH_ELEVATION,
    }
}

/// What an option of the external roll reference reads.
pub(super) fn external_roll_keys(option: ExternalRollOption) -> Keys {
    match option {
        ExternalRollOption::Vector => VECTOR,
        ExternalRollOption::RightAscensionDeclination => CELESTIAL,
        ExternalRollOption::Sun | ExternalRollOption::Earth | ExternalRollOption::Planet => NOTHING,
    }
}

/// What a scan in a frame reads.
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
