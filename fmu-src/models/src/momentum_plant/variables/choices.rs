//! The plant's choices.

use fmi_export::Enumeration;
use physics::bodies::Body;
use physics::environment::frames::Frame;
use physics::momentum::Convention;
use physics::spacecraft;

use crate::common::choices::enumeration_of;

/// Where the attitude comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum AttitudeSource {
    /// Computes its own guidance and follows it ideally.
    Guided = 1,
    /// Follows the command inputs ideally.
    Commanded = 2,
    /// Rigid body and wheels under an internal controller; not in this version.
    Controlled = 3,
    /// Rigid body and wheels driven by wheel-torque inputs; not in this version.
    Free = 4,
}

/// What a command gives.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum CommandKind {
    /// No command yet: the attitude is held.
    None = 0,
    /// Attitude command.q and rate command.rate.
    Attitude = 1,
    /// The attitude held turns at once, when this item is chosen, by the conjugate of command.error; then with
    /// command.rate.
    ErrorQuaternion = 2,
    /// The attitude held turns on with command.rate.
    RateOnly = 3,
}

/// Pitch during science.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum ScienceRule {
    /// Sun elevation is a fraction of (Sun-nadir angle - 90 deg), within the keep-in zone.
    Scaled = 1,
    /// Z points to nadir as far as the keep-in zone allows.
    Nadir = 2,
    /// Fixed to the Sun line: -Y from the planet to the Sun, -Z to the north of the planet's orbit, as in paper 004; no
    /// keep-in zone.
    FixedToSunLine = 3,
}

enumeration_of! {
    /// Central body.
    OrbitCenter(Body) {
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

/// Origin of the orbit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum OrbitSource {
    /// From the orbital elements at the start.
    Elements = 1,
    /// From the position and velocity inputs, anew whenever they change.
    Inputs = 2,
}

/// What moves the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum OrbitDynamics {
    /// The centre's gravity alone: the orbit in closed form.
    TwoBody = 1,
    /// Integrated with the planet's flattening, the Sun's tide, and light and heat.
    Disturbed = 2,
}

enumeration_of! {
    /// Frame of the orbital elements.
    OrbitFrame(Frame) {
        /// The planet's orbit plane, from its ascending node on the ecliptic: the Mercury-centred inertial frame of paper 004.
        planetOrbit = 1 => PlanetOrbit,
        /// The planet's equator of J2000.
        planetEquator = 2 => PlanetEquator,
        /// Earth mean equator and equinox of J2000.
        eme2000 = 3 => Eme2000,
        /// Ecliptic and equinox of J2000.
        ecliptic = 4 => Ecliptic,
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
}

enumeration_of! {
    /// What turns a panel.
    PanelControl(spacecraft::PanelControl) {
        /// A constant angle between the panel's normal and the Sun.
        sunOffset = 1 => SunOffset,
        /// The input angle.
        angle = 2 => Angle,
    }
}

/// Sense in which a panel tilts off the Sun.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum PanelTilt {
    /// Right-handed about the panel's axis.
    Positive = 1,
    /// Left-handed about the panel's axis.
    Negative = 2,
}

enumeration_of! {
    /// Meaning of system momentum in the body frame.
    MomentumConvention(Convention) {
        /// Physical: the inertial total shown in body components.
        inertial = 1 => Inertial,
        /// Paper 000: each body component of torque integrated on its own.
        bodyIntegral = 2 => BodyIntegral,
    }
}

/// Where a dump leaves a component that exceeded its threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Enumeration)]
pub enum DumpReinitTo {
    /// The opposite sign at dump.reinitFraction of the threshold.
    Opposite = 1,
    /// The component of dump.target.
    Target = 2,
}
