//! Inputs of commands: scenario, the options of the four vectors, limb, scan, mode.

use crate::common::choices::custom_body;
use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Variables};
use physics::guidance::pointing::aimpoint::AimpointKind;
use physics::guidance::pointing::command;
use physics::guidance::pointing::scan::DEFAULT_COMPATIBILITY;

use super::super::setup::GuidanceSetup as Setup;
use super::choices::{
    ActiveMode, AimpointBody, AimpointOption, AzimuthReference, BodyRollOption, BoresightOption,
    ExternalRollOption, ModeReason, ModeRequest, ScanFrame,
};

/// The boresight.
#[derive(Variables)]
pub struct BoresightVariables {
    /// How it is given, in the scenario generic; phasedArray also asks the scenario downlink for boresight.azimuth.
    #[input(start = BoresightOption(None))]
    pub option: Choice<BoresightOption>,
    /// Body-frame components, of any length.
    #[input(unit = "1", start = [0.0; 3])]
    pub vector: RealVector<3>,
    /// Azimuth in the body frame, from -Y toward +X; of the antenna where an antenna is the boresight.
    #[input(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = 0.0)]
    pub azimuth: Real,
    /// Elevation in the body frame, positive toward -Z.
    #[input(unit = "rad", display = "deg", min = command::DOWN_ANGLE_RAD, max = command::RIGHT_ANGLE_RAD, start = 0.0)]
    pub elevation: Real,
    /// Angle of the gimbal, from the instrument's boresight in the file, right-handed about its axis.
    #[input(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = 0.0)]
    pub angle: Real,
    /// Instrument of a scenario: 0 is +Z, otherwise the row of [[instruments]] in the spacecraft file.
    #[input(min = 0, max = setup.last_instrument(), start = 0)]
    pub instrument: Integer,
}

/// An aimpoint.
#[derive(Variables)]
pub struct AimpointVariables {
    /// What is aimed at.
    #[input(start = AimpointOption(None))]
    pub option: Choice<AimpointOption>,
    /// Direction in EME2000, of any length.
    #[input(unit = "1", start = [0.0; 3])]
    pub vector: RealVector<3>,
    /// Position for the options earthCentered, sunCentered, planetCentered and planetFixed; with its derivative as an input
    /// derivative a given ephemeris is tracked.
    #[input(unit = "m", display = "km", start = [0.0; 3])]
    pub position: RealVector<3>,
    /// Right ascension.
    #[input(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = 0.0)]
    pub right_ascension: Real,
    /// Declination.
    #[input(unit = "rad", display = "deg", min = command::DOWN_ANGLE_RAD, max = command::RIGHT_ANGLE_RAD, start = 0.0)]
    pub declination: Real,
    /// Planetocentric latitude.
    #[input(unit = "rad", display = "deg", min = command::DOWN_ANGLE_RAD, max = command::RIGHT_ANGLE_RAD, start = 0.0)]
    pub latitude: Real,
    /// Longitude, east positive.
    #[input(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = 0.0)]
    pub longitude: Real,
    /// Height above the ellipsoid along the radius.
    #[input(unit = "m", display = "km", start = 0.0)]
    pub height: Real,
    /// Azimuth in the local frame, right-handed about up.
    #[input(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = 0.0)]
    pub azimuth: Real,
    /// Elevation in the local frame, toward up: away from the planet.
    #[input(unit = "rad", display = "deg", min = command::DOWN_ANGLE_RAD, max = command::RIGHT_ANGLE_RAD, start = 0.0)]
    pub elevation: Real,
    /// The body of the option body, by VSOP87; the spacecraft file's own by that file.
    #[input(start = AimpointBody(None), items = custom_body(&setup.spacecraft))]
    pub body: Choice<AimpointBody>,
}

/// The body roll vector.
#[derive(Variables)]
pub struct BodyRollVariables {
    /// How it is given, in the scenario generic.
    #[input(start = BodyRollOption(None))]
    pub option: Choice<BodyRollOption>,
    /// Body-frame components, of any length.
    #[input(unit = "1", start = [0.0; 3])]
    pub vector: RealVector<3>,
    /// Azimuth in the body frame, from -Y toward +X.
    #[input(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = 0.0)]
    pub azimuth: Real,
    /// Elevation in the body frame, positive toward -Z.
    #[input(unit = "rad", display = "deg", min = command::DOWN_ANGLE_RAD, max = command::RIGHT_ANGLE_RAD, start = 0.0)]
    pub elevation: Real,
}

/// The external roll reference.
#[derive(Variables)]
pub struct ExternalRollVariables {
    /// How it is given, in the scenario generic.
    #[input(start = ExternalRollOption(None))]
    pub option: Choice<ExternalRollOption>,
    /// Direction in EME2000, of any length.
    #[input(unit = "1", start = [0.0; 3])]
    pub vector: RealVector<3>,
    /// Right ascension.
    #[input(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = 0.0)]
    pub right_ascension: Real,
    /// Declination.
    #[input(unit = "rad", display = "deg", min = command::DOWN_ANGLE_RAD, max = command::RIGHT_ANGLE_RAD, start = 0.0)]
    pub declination: Real,
}

/// Point at the limb and its scan.
#[derive(Variables)]
pub struct LimbVariables {
    /// Azimuth about the local vertical, right-handed about up, in the scenario limbGeneric.
    #[input(unit = "rad", display = "deg", min = command::BACK_TURN_RAD, max = command::FULL_TURN_RAD, start = 0.0)]
    pub azimuth: Real,
    /// From where it counts.
    #[input(start = AzimuthReference(None))]
    pub reference: Choice<AzimuthReference>,
    /// Height above the limb along its radius when the scenario starts.
    #[input(unit = "m", display = "km", start = 0.0)]
    pub height: Real,
    /// How fast the height grows.
    #[input(unit = "m/s", display = "km/s", start = 0.0)]
    pub height_rate: Real,
}

/// A scan pattern over the scenario.
#[derive(Variables)]
pub struct ScanVariables {
    /// Its frame; the scan starts at the sample where this becomes non-zero, and anew where any of the pattern changes.
    #[input(start = ScanFrame(None))]
    pub frame: Choice<ScanFrame>,
    /// From where the local frame's azimuth counts.
    #[input(start = AzimuthReference(None))]
    pub reference: Choice<AzimuthReference>,
    /// Rates of rotations, right-handed, about x, y and z in turn.
    #[input(unit = "rad/s", display = "deg/s", start = [0.0; 3])]
    pub rate: RealVector<3>,
    /// Speeds of translations.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    pub speed: RealVector<3>,
    /// How long each axis moves.
    #[input(unit = "s", min = 0.0, start = [0.0; 3])]
    pub duration: RealVector<3>,
    /// How long each axis holds after a motion.
    #[input(unit = "s", min = 0.0, start = [0.0; 3])]
    pub pause: RealVector<3>,
    /// How often axis x moves; 0 without end.
    #[input(name = "segments[1]", min = 0, max = 1_000_000, start = 0)]
    pub segments_x: Integer,
    /// How often axis y moves; 0 without end.
    #[input(name = "segments[2]", min = 0, max = 1_000_000, start = 0)]
    pub segments_y: Integer,
    /// How often axis z moves; 0 without end.
    #[input(name = "segments[3]", min = 0, max = 1_000_000, start = 0)]
    pub segments_z: Integer,
    /// Whether every second motion of axis x goes back.
    #[input(name = "reverse[1]", start = false)]
    pub reverse_x: Boolean,
    /// Whether every second motion of axis y goes back.
    #[input(name = "reverse[2]", start = false)]
    pub reverse_y: Boolean,
    /// Whether every second motion of axis z goes back.
    #[input(name = "reverse[3]", start = false)]
    pub reverse_z: Boolean,
    /// Whether a scan moves the boresight or the aimpoint: not with downlink, in a safe mode or where the frame does not go
    /// with the aimpoint.
    #[output]
    pub active: Boolean,
}

/// With which aimpoints the scan frame of this number (items of `scan.frame`) goes. Paper 001 prints no matrix: assumed.
#[derive(Variables)]
pub struct ScanCompatibilityVariables {
    /// With directions: vector, raDec (assumed).
    #[parameter(start = DEFAULT_COMPATIBILITY[index][AimpointKind::Direction as usize])]
    pub direction: Boolean,
    /// With directions of the local frames: lvlhDowntrack, lvlhSun (assumed).
    #[parameter(start = DEFAULT_COMPATIBILITY[index][AimpointKind::LocalDirection as usize])]
    pub local_direction: Boolean,
    /// With points in space: earthCentered, sunCentered, planetCentered, sun, earth, body (assumed).
    #[parameter(start = DEFAULT_COMPATIBILITY[index][AimpointKind::Point as usize])]
    pub point: Boolean,
    /// With points of the planet: planetFixed, latLon, nadir, subsolar, optimalLighting, limb (assumed).
    #[parameter(start = DEFAULT_COMPATIBILITY[index][AimpointKind::PlanetPoint as usize])]
    pub planet_point: Boolean,
}

/// The mode.
#[derive(Variables)]
pub struct ModeVariables {
    /// A mode requested: the only way up.
    #[input(start = ModeRequest::None)]
    pub request: Choice<ModeRequest>,
    /// The mode in force.
    #[output]
    pub active: Choice<ActiveMode>,
    /// Why, since it changed last; while there is no estimate of the attitude what is lost now. A demotion is logged too.
    #[output]
    pub reason: Choice<ModeReason>,
}
