//! Guidance's choices.

use fmi_export::Enumeration;
use fmi_export::variables::DeclaredItem;
use physics::bodies::Body;
use physics::enumeration::Enumerated;
use physics::guidance::geometry::{lighting, lvlh};
use physics::guidance::modes::mode;
use physics::guidance::pointing::antenna::AntennaRow;
use physics::guidance::pointing::command;
use physics::spacecraft::{NamedAntenna, Spacecraft};

use crate::common::choices::{KNOWN_BODIES, choices, optional_choices, row_choice};

optional_choices! {
    /// What is pointed at what (paper 001, Table 5).
    PointingScenario(command::Scenario) or "Not commanded here: the timeline rules, and without one the last command stays.";
    /// How the boresight is given (paper 001, Table 1).
    BoresightOption(command::BoresightOption) or "Not given.";
    /// What is aimed at (paper 001, Table 2).
    AimpointOption(command::AimpointOption) or "Not given.";
    /// A body to aim at, numbered as OrbitCenter's: 5 is kept free for the Moon.
    AimpointBody(Body) of KNOWN_BODIES or "Not given.";
    /// How the body roll vector is given (paper 001, Table 3).
    BodyRollOption(command::BodyRollOption) or "Not given.";
    /// How the external roll reference is given (paper 001, Table 4).
    ExternalRollOption(command::ExternalRollOption) or "Not given.";
    /// From where an azimuth about the local vertical counts.
    AzimuthReference(lvlh::AzimuthReference) or "As downtrack.";
    /// Frame of a scan.
    ScanFrame(command::ScanFrame) or "No scan.";
    /// Why a mode is in force.
    ModeReason(mode::ModeReason) or "The mode of the start.";
}

/// A mode requested.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum ModeRequest {
    /// None: the mode stays.
    None = 0,
    /// Operational.
    Operational = 1,
    /// Safe Hold.
    SafeHold = 2,
    /// Earth Acquisition.
    EarthAcquisition = 3,
}

impl ModeRequest {
    /// The mode, which has the same number.
    pub fn mode(self) -> Option<mode::Mode> {
        mode::Mode::from_value(self.value())
    }
}

choices! {
    /// The mode in force.
    ActiveMode(mode::Mode);
    /// Which point of the ellipsoid is the subsolar point.
    SubsolarMethod(lighting::SubsolarMethod);
}

row_choice! {
    /// The antenna in use.
    AntennaSelect(AntennaRow) or "None: no downlink."
}

impl AntennaSelect {
    /// The items of the spacecraft's antennas.
    pub fn antennas(spacecraft: &Spacecraft) -> Vec<DeclaredItem> {
        let item = |(row, named): (u16, &NamedAntenna)| DeclaredItem {
            name: named.name.clone(),
            value: Self(Some(AntennaRow(row))).value(),
            description: format!("An antenna {}.", named.antenna.range),
        };
        (0..).zip(&spacecraft.antennas).map(item).collect()
    }
}

/// Origin of the Sun's and the planets' positions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum EphemerisSource {
    /// The analytic theory VSOP87.
    Vsop87 = 1,
    /// The planet on an ellipse about the Sun by ephemeris.semiMajorAxis and so on, as paper 004 prints it; the Earth by
    /// VSOP87.
    Kepler = 2,
    /// The inputs sun.position and earth.position.
    Inputs = 3,
    /// As flown (paper 001): precise Chebyshev models, by the FMU's ephemeris.toml or else by VSOP87, checked against the
    /// Sun sensors, and coarse ones as the modes allow.
    Chebyshev = 4,
    /// Coarse models alone: polynomials of Keplerian elements by ephemeris.toml, or else by VSOP87 averaged over ten years.
    Coarse = 5,
}

/// Ephemerides by how good they are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum EphemerisModel {
    /// Those of ephemeris.source.
    Precise = 1,
    /// Polynomials of Keplerian elements.
    Coarse = 2,
}

/// Where a requested dump leaves a component that exceeded its threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum DumpReinitTo {
    /// The opposite sign at dump.reinitFraction of the threshold.
    Opposite = 1,
    /// The component of momentum.target.
    Target = 2,
}
