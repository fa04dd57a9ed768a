//! Guidance's choices.

use fmi_export::Enumeration;
use physics::bodies::Body;
use physics::guidance::constraints::keep_in;
use physics::guidance::geometry::lighting;
use physics::guidance::modes::mode;
use physics::guidance::pointing::antenna::Antenna;
use physics::guidance::pointing::command;

use crate::common::choices::{enumeration_of, optional_enumeration_of};

optional_enumeration_of! {
    /// What is pointed at what (paper 001, Table 5).
    PointingScenario(command::Scenario) {
        /// Not commanded here: the timeline rules, and without one the last command stays.
        none = 0,
        /// The four vectors by their options.
        generic = 1 => Generic,
        /// An instrument at the aimpoint, -Y rolled toward the Sun.
        plusZ = 2 => PlusZ,
        /// An instrument at the planet's centre.
        nadir = 3 => Nadir,
        /// The MDIS camera at boresight.angle at the aimpoint.
        mdis = 4 => Mdis,
        /// An instrument at the aimpoint, the MDIS camera as near as it can be to the second one.
        doubleTarget = 5 => DoubleTarget,
        /// A phased-array antenna at the Earth.
        downlink = 6 => Downlink,
        /// An instrument at the limb on the terminator, the point nearer to the downtrack direction.
        limbTerminator = 7 => LimbTerminator,
        /// An instrument at the limb at limb.azimuth.
        limbGeneric = 8 => LimbGeneric,
        /// The thrust along the path of the burn.
        burn = 9 => Burn,
        /// Science and downlink in turn by guided.*, as MomentumPlant flies by itself.
        orbitPhase = 10 => OrbitPhase,
    }
}

optional_enumeration_of! {
    /// How the boresight is given (paper 001, Table 1).
    BoresightOption(command::BoresightOption) {
        /// Not given.
        none = 0,
        /// By boresight.vector.
        vector = 1 => Vector,
        /// By boresight.azimuth and boresight.elevation.
        azEl = 2 => AzimuthElevation,
        /// The MDIS camera at boresight.angle.
        mdis = 3 => Mdis,
        /// A phased-array antenna at boresight.azimuth.
        phasedArray = 4 => PhasedArray,
    }
}

optional_enumeration_of! {
    /// What is aimed at (paper 001, Table 2).
    AimpointOption(command::AimpointOption) {
        /// Not given.
        none = 0,
        /// The direction vector in EME2000.
        vector = 1 => Vector,
        /// The direction of rightAscension and declination in EME2000.
        raDec = 2 => RightAscensionDeclination,
        /// position from the Earth, in EME2000.
        earthCentered = 3 => EarthCentered,
        /// position from the Sun, in EME2000.
        sunCentered = 4 => SunCentered,
        /// position from the target planet, in EME2000.
        planetCentered = 5 => PlanetCentered,
        /// position from the target planet along its own axes, which turn with it.
        planetFixed = 6 => PlanetFixed,
        /// Planetocentric latitude, east longitude and height along the radius.
        latLon = 7 => LatitudeLongitude,
        /// azimuth and elevation in the local frame, azimuth from the downtrack direction.
        lvlhDowntrack = 8 => LvlhDowntrack,
        /// azimuth and elevation in the local frame, azimuth from the direction of the Sun.
        lvlhSun = 9 => LvlhSun,
        /// The Sun.
        sun = 10 => Sun,
        /// The Earth.
        earth = 11 => Earth,
        /// The planet's centre.
        nadir = 12 => Nadir,
        /// The subsolar point.
        subsolar = 13 => Subsolar,
        /// The surface point of best lighting (eqs 17 to 19).
        optimalLighting = 14 => OptimalLighting,
        /// The body named beside.
        body = 15 => Body,
    }
}

optional_enumeration_of! {
    /// A body to aim at, numbered as OrbitCenter's: 5 is kept free for the Moon.
    AimpointBody(Body) {
        /// Not given.
        none = 0,
        /// Mercury.
        mercury = 1 => Mercury,
        /// The Sun.
        sun = 2 => Sun,
        /// Venus.
        venus = 3 => Venus,
        /// The Earth.
        earth = 4 => Earth,
        /// Mars.
        mars = 6 => Mars,
        /// Jupiter.
        jupiter = 7 => Jupiter,
    }
}

optional_enumeration_of! {
    /// How the body roll vector is given (paper 001, Table 3).
    BodyRollOption(command::BodyRollOption) {
        /// Not given.
        none = 0,
        /// By bodyRoll.vector.
        vector = 1 => Vector,
        /// By bodyRoll.azimuth and bodyRoll.elevation.
        azEl = 2 => AzimuthElevation,
    }
}

optional_enumeration_of! {
    /// How the external roll reference is given (paper 001, Table 4).
    ExternalRollOption(command::ExternalRollOption) {
        /// Not given.
        none = 0,
        /// The direction externalRoll.vector in EME2000.
        vector = 1 => Vector,
        /// The direction of externalRoll.rightAscension and declination in EME2000.
        raDec = 2 => RightAscensionDeclination,
        /// The Sun.
        sun = 3 => Sun,
        /// The Earth.
        earth = 4 => Earth,
        /// The target planet.
        planet = 5 => Planet,
    }
}

optional_enumeration_of! {
    /// From where an azimuth about the local vertical counts.
    AzimuthReference(command::AzimuthReference) {
        /// As downtrack.
        none = 0,
        /// The horizontal part of the velocity.
        downtrack = 1 => Downtrack,
        /// The horizontal part of the direction from the planet to the Sun.
        sun = 2 => Sun,
    }
}

optional_enumeration_of! {
    /// Frame of a scan.
    ScanFrame(command::ScanFrame) {
        /// No scan.
        none = 0,
        /// The boresight turns about the body axes by scan.rate.
        body = 1 => Body,
        /// The aim turns about the axes of EME2000 by scan.rate.
        inertialRotation = 2 => InertialRotation,
        /// The aimpoint moves along the axes of EME2000 by scan.speed.
        inertialTranslation = 3 => InertialTranslation,
        /// The aimpoint moves along the planet's turning axes by scan.speed.
        planetTranslation = 4 => PlanetTranslation,
        /// The aim turns about the axes of the local frame by scan.rate.
        lvlhRotation = 5 => LvlhRotation,
    }
}

optional_enumeration_of! {
    /// A mode requested.
    ModeRequest(mode::Mode) {
        /// None: the mode stays.
        none = 0,
        /// Operational.
        operational = 1 => Operational,
        /// Safe Hold.
        safeHold = 2 => SafeHold,
        /// Earth Acquisition.
        earthAcquisition = 3 => EarthAcquisition,
    }
}

enumeration_of! {
    /// The mode in force.
    ActiveMode(mode::Mode) {
        /// Every command is followed.
        operational = 1 => Operational,
        /// Downlink only, within its own keep-in zone.
        safeHold = 2 => SafeHold,
        /// A slow turn about the Sun line, or the search for the Sun.
        earthAcquisition = 3 => EarthAcquisition,
    }
}

enumeration_of! {
    /// Which point of the ellipsoid is the subsolar point.
    SubsolarMethod(lighting::SubsolarMethod) {
        /// Where the line from the planet's centre to the Sun leaves it.
        line = 1 => Line,
        /// Where its normal points at the Sun.
        normal = 2 => Normal,
    }
}

enumeration_of! {
    /// Where a Sun outside the keep-in zone is put.
    KeepInMethod(keep_in::KeepInMethod) {
        /// At the nearest point of the boundary.
        nearest = 1 => Nearest,
        /// Azimuth and elevation clamped one by one, as paper 001 does; up to 3.5 deg farther away.
        clamp = 2 => Clamp,
    }
}

enumeration_of! {
    /// The antenna in use.
    AntennaSelect(Antenna) {
        /// None: no downlink.
        none = 0 => None,
        /// Beside the sunshade, azimuth -90 to 0 deg.
        sunshade = 1 => Sunshade,
        /// At the back, azimuth 90 to 180 deg.
        back = 2 => Back,
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
