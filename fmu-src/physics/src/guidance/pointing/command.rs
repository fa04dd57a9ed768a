//! Commands of pointing: options of the four vectors (paper 001, Tables 1 to 4), scenarios (Table 5), limb and scan.
//!
//! A command holds every number any option reads; an option reads its own and no other. Options and scenarios that are
//! `None` are not commanded. Angles in rad, lengths in m, body-frame angles as in [`crate::attitude::SunAngles`]. In a file
//! options have the names of the FMU's items.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::bodies::Body;
use crate::enumeration::file_enumerations;
use crate::guidance::geometry::lvlh::AzimuthReference;

/// Greatest azimuth, longitude or right ascension either way, in rad.
pub const FULL_TURN_RAD: f64 = core::f64::consts::TAU;
/// Least azimuth, longitude or right ascension, in rad.
pub const BACK_TURN_RAD: f64 = -FULL_TURN_RAD;
/// Greatest elevation, latitude or declination either way, in rad.
pub const RIGHT_ANGLE_RAD: f64 = core::f64::consts::FRAC_PI_2;
/// Least elevation, latitude or declination, in rad.
pub const DOWN_ANGLE_RAD: f64 = -RIGHT_ANGLE_RAD;
/// Least angle in a half turn either way, in rad.
pub const BACK_HALF_TURN_RAD: f64 = -core::f64::consts::PI;

file_enumerations! {
    /// Sets of vectors under one name (Table 5).
    pub enum Scenario {
        /// The four vectors by their options.
        1 => Generic,
        /// An instrument at the aimpoint, -Y rolled toward the Sun.
        2 => PlusZ,
        /// An instrument at the planet's centre.
        3 => Nadir,
        /// The instrument on the gimbal at boresight.angle at the aimpoint.
        4 => Gimbal,
        /// An instrument at the aimpoint, the one on the gimbal as near as it can be to the second one.
        5 => DoubleTarget,
        /// An antenna at the Earth.
        6 => Downlink,
        /// An instrument at the limb on the terminator, the point nearer to the downtrack direction.
        7 => LimbTerminator,
        /// An instrument at the limb at limb.azimuth.
        8 => LimbGeneric,
        /// The thrust along the path of the burn.
        9 => Burn,
        /// Science and downlink in turn by guided.*, as MomentumPlant flies by itself.
        10 => OrbitPhase,
    }

    /// How the boresight is given (Table 1).
    pub enum BoresightOption {
        /// By boresight.vector.
        1 => Vector,
        /// By boresight.azimuth and boresight.elevation.
        #[serde(rename = "azEl")]
        2 => AzimuthElevation,
        /// The instrument on the gimbal at boresight.angle.
        3 => Gimbal,
        /// An antenna that is steered in the XY plane, at boresight.azimuth.
        4 => PhasedArray,
    }

    /// What the boresight aims at (Table 2), and any body of the table.
    pub enum AimpointOption {
        /// The direction vector in EME2000.
        1 => Vector,
        /// The direction of rightAscension and declination in EME2000.
        #[serde(rename = "raDec")]
        2 => RightAscensionDeclination,
        /// position from the Earth, in EME2000.
        3 => EarthCentered,
        /// position from the Sun, in EME2000.
        4 => SunCentered,
        /// position from the target planet, in EME2000.
        5 => PlanetCentered,
        /// position from the target planet along its own axes, which turn with it.
        6 => PlanetFixed,
        /// Planetocentric latitude, east longitude and height along the radius.
        #[serde(rename = "latLon")]
        7 => LatitudeLongitude,
        /// azimuth and elevation in the local frame, azimuth from the downtrack direction.
        8 => LvlhDowntrack,
        /// azimuth and elevation in the local frame, azimuth from the direction of the Sun.
        9 => LvlhSun,
        /// The Sun.
        10 => Sun,
        /// The Earth.
        11 => Earth,
        /// The planet's centre.
        12 => Nadir,
        /// The subsolar point.
        13 => Subsolar,
        /// The surface point of best lighting (eqs 17 to 19).
        // Of greatest cos(emission) cos(incidence).
        14 => OptimalLighting,
        /// The body named beside.
        15 => Body,
        /// The direction of the velocity about the planet.
        16 => Velocity,
        /// The direction of the orbit normal, position x velocity.
        17 => OrbitNormal,
        /// North of the ecliptic of J2000.
        18 => EclipticNorth,
    }

    /// How the body roll vector is given (Table 3).
    pub enum BodyRollOption {
        /// By bodyRoll.vector.
        1 => Vector,
        /// By bodyRoll.azimuth and bodyRoll.elevation.
        #[serde(rename = "azEl")]
        2 => AzimuthElevation,
    }

    /// How the external roll reference is given (Table 4).
    pub enum ExternalRollOption {
        /// The direction externalRoll.vector in EME2000.
        1 => Vector,
        /// The direction of externalRoll.rightAscension and declination in EME2000.
        #[serde(rename = "raDec")]
        2 => RightAscensionDeclination,
        /// The Sun.
        3 => Sun,
        /// The Earth.
        4 => Earth,
        /// The target planet.
        5 => Planet,
        /// The direction of the velocity about the planet.
        6 => Velocity,
        /// The direction of the orbit normal, position x velocity.
        7 => OrbitNormal,
        /// North of the ecliptic of J2000.
        8 => EclipticNorth,
    }

    /// Frame of a scan.
    pub enum ScanFrame {
        /// The boresight turns about the body axes by scan.rate.
        1 => Body,
        /// The aim turns about the axes of EME2000 by scan.rate.
        2 => InertialRotation,
        /// The aimpoint moves along the axes of EME2000 by scan.speed.
        3 => InertialTranslation,
        /// The aimpoint moves along the planet's turning axes by scan.speed.
        4 => PlanetTranslation,
        /// The aim turns about the axes of the local frame by scan.rate.
        // reference, up x reference, up.
        5 => LvlhRotation,
    }
}

/// Commands that are given field by field.
macro_rules! commands {
    ($($(#[$of:meta])* pub struct $name:ident { $($(#[$doc:meta])* pub $field:ident: $type:ty,)+ })+) => {$(
        $(#[$of])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
        pub struct $name {
            $($(#[$doc])* pub $field: $type,)+
        }

        impl $name {
            /// Field by field: this one where it is not zero or nothing, otherwise the planned one.
            #[must_use]
            pub fn over(&self, planned: &Self) -> Self {
                let nothing = Self::default();
                Self { $($field: if self.$field == nothing.$field { planned.$field } else { self.$field }),+ }
            }
        }
    )+};
}

commands! {
    /// The boresight, body frame.
    pub struct BoresightCommand {
        /// How it is given.
        pub option: Option<BoresightOption>,
        /// Components, of any length.
        pub vector: Vector3<f64>,
        /// Azimuth; also of the antenna.
        pub azimuth_rad: f64,
        /// Elevation.
        pub elevation_rad: f64,
        /// Angle of the gimbal.
        pub angle_rad: f64,
        /// Instrument of a scenario: 0 is +Z, then the rows of the instrument table from 1.
        pub instrument: u32,
    }

    /// An aimpoint.
    pub struct AimpointCommand {
        /// Kind of aimpoint.
        pub option: Option<AimpointOption>,
        /// EME2000 direction, of any length.
        pub vector: Vector3<f64>,
        /// Position of options centred on a body.
        pub position_m: Vector3<f64>,
        /// How it moves, in m/s: with it, an ephemeris given from outside is tracked.
        pub velocity_m_s: Vector3<f64>,
        /// Right ascension.
        pub right_ascension_rad: f64,
        /// Declination.
        pub declination_rad: f64,
        /// Planetocentric latitude.
        pub latitude_rad: f64,
        /// East longitude.
        pub longitude_rad: f64,
        /// Height above the ellipsoid along the radius.
        pub height_m: f64,
        /// Azimuth in the local frame, right-handed about up.
        pub azimuth_rad: f64,
        /// Elevation in the local frame, toward up.
        pub elevation_rad: f64,
        /// The body.
        pub body: Option<Body>,
    }

    /// The body roll vector.
    pub struct BodyRollCommand {
        /// How it is given.
        pub option: Option<BodyRollOption>,
        /// Components, body frame, of any length.
        pub vector: Vector3<f64>,
        /// Azimuth.
        pub azimuth_rad: f64,
        /// Elevation.
        pub elevation_rad: f64,
    }

    /// The external roll reference.
    pub struct ExternalRollCommand {
        /// How it is given.
        pub option: Option<ExternalRollOption>,
        /// EME2000 direction, of any length.
        pub vector: Vector3<f64>,
        /// Right ascension.
        pub right_ascension_rad: f64,
        /// Declination.
        pub declination_rad: f64,
    }

    /// Point at the limb and its scan.
    pub struct LimbCommand {
        /// Azimuth about the local vertical, right-handed about up.
        pub azimuth_rad: f64,
        /// From where it counts; downtrack unless given.
        pub reference: Option<AzimuthReference>,
        /// Height along the radius of the limb point, when the scenario starts.
        pub height_m: f64,
        /// How it grows, in m/s.
        pub height_rate_m_s: f64,
    }

    /// A scan pattern: on each axis a motion at constant rate, a pause, and again, possibly back.
    pub struct ScanCommand {
        /// Its frame.
        pub frame: Option<ScanFrame>,
        /// From where the local frame's azimuth counts; downtrack unless given.
        pub reference: Option<AzimuthReference>,
        /// Rates of rotations about x, y, z, in rad/s.
        pub rate_rad_s: [f64; 3],
        /// Speeds of translations along x, y, z, in m/s.
        pub speed_m_s: [f64; 3],
        /// How long an axis moves, in s.
        pub duration_s: [f64; 3],
        /// How long it holds after a motion, in s.
        pub pause_s: [f64; 3],
        /// How often it moves; 0 without end.
        pub segments: [u32; 3],
        /// Whether every second motion goes back.
        pub reverse: [bool; 3],
    }
}

/// Pointing command of all scenarios and options.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PointingCommand {
    /// Scenario; `None` commands nothing.
    pub scenario: Option<Scenario>,
    /// Boresight.
    pub boresight: BoresightCommand,
    /// Aimpoint.
    pub aimpoint: AimpointCommand,
    /// Aimpoint of the instrument on the gimbal in [`Scenario::DoubleTarget`].
    pub second_aimpoint: AimpointCommand,
    /// Body roll vector.
    pub body_roll: BodyRollCommand,
    /// External roll reference.
    pub external_roll: ExternalRollCommand,
    /// Limb.
    pub limb: LimbCommand,
    /// Scan pattern.
    pub scan: ScanCommand,
}

impl PointingCommand {
    /// Field by field: this one where it is not zero or nothing, otherwise the planned one.
    #[must_use]
    pub fn over(&self, planned: &Self) -> Self {
        Self {
            scenario: self.scenario.or(planned.scenario),
            boresight: self.boresight.over(&planned.boresight),
            aimpoint: self.aimpoint.over(&planned.aimpoint),
            second_aimpoint: self.second_aimpoint.over(&planned.second_aimpoint),
            body_roll: self.body_roll.over(&planned.body_roll),
            external_roll: self.external_roll.over(&planned.external_roll),
            limb: self.limb.over(&planned.limb),
            scan: self.scan.over(&planned.scan),
        }
    }

    /// Returns the command as it continues after its end: without its scans.
    #[must_use]
    pub fn without_scans(&self) -> Self {
        let limb = LimbCommand { height_rate_m_s: 0.0, ..self.limb };
        Self { scan: ScanCommand::default(), limb, ..*self }
    }
}
