//! Constraints, modes and hardware limits.

use core::f64::consts::{FRAC_PI_2, PI};

use fmi_export::{Boolean, Choice, Real, RealVector, Variables};
use physics::constants::HALF_TURNS_RAD;
use physics::guidance::constraints::keep_in;
use physics::guidance::downlink::sun_direction;
use physics::guidance::modes::transitions;
use physics::guidance::pointing::command;
use physics::spacecraft::SunKeepIn;

use super::super::setup::GuidanceSetup as Setup;
use super::choices::AntennaSelect;
use crate::common::choices::KeepInMethod;

/// Sun keep-in zone. The timeline can switch and resize it.
#[derive(Variables)]
pub struct KeepInVariables {
    /// Whether commands keep the Sun inside the zone.
    #[parameter(tunable, start = setup.spacecraft.sun_keep_in.is_some())]
    pub enabled: Boolean,
    /// Largest Sun azimuth either way, in the zone's frame.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = FRAC_PI_2, start = setup.keep_in().azimuth_rad)]
    pub azimuth: Real,
    /// Largest Sun elevation either way, in the zone's frame.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = FRAC_PI_2, start = setup.keep_in().elevation_rad)]
    pub elevation: Real,
    /// Centre of the zone, body frame, of any length: the zone's frame is the body's, turned by the smallest rotation that
    /// takes -Y to it. Also the boresight of Earth Acquisition.
    #[parameter(unit = "1", start = [0.0, -1.0, 0.0])]
    pub axis: RealVector<3>,
    /// Greatest distance from the Sun at which the zone counts; in Safe Hold it always does.
    #[parameter(tunable, unit = "m", display = "AU", min = 0.0, max = SunKeepIn::FARTHEST_M, start = setup.keep_in().distance_m)]
    pub distance: Real,
    /// Where a Sun outside is put.
    #[parameter(start = KeepInMethod(keep_in::KeepInMethod::Nearest))]
    pub method: Choice<KeepInMethod>,
}

/// The zone of Safe Hold.
#[derive(Variables)]
pub struct SafeHoldVariables {
    /// Largest Sun azimuth either way in Safe Hold.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = FRAC_PI_2, start = setup.keep_in().azimuth_rad)]
    pub azimuth: Real,
    /// Largest Sun elevation either way in Safe Hold.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = FRAC_PI_2, start = setup.keep_in().elevation_rad)]
    pub elevation: Real,
}

/// Hot-pole keep-out, by the file's [hot_pole].
#[derive(Variables)]
pub struct HotPoleVariables {
    /// Whether -Z is kept away from the planet over the subsolar region; false unless the file has [hot_pole].
    #[parameter(tunable, start = setup.spacecraft.hot_pole.is_some())]
    pub enabled: Boolean,
    /// Below this height above the ellipsoid, along the radius, it can be in force; 0 without [hot_pole].
    #[parameter(tunable, unit = "m", display = "km", min = 0.0, max = 1e10, start = setup.hot_pole().altitude_m)]
    pub altitude: Real,
    /// Within this angle from the subsolar point it can be in force.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = PI, start = setup.hot_pole().angle_rad)]
    pub angle: Real,
    /// While it is in force -Z stays at least so far from the direction to the planet's centre.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = PI, start = setup.hot_pole().cone_rad)]
    pub cone: Real,
}

/// The constraint monitor.
#[derive(Variables)]
pub struct MonitorVariables {
    /// Whether a violation that lasts demotes the mode.
    #[parameter(tunable, start = true)]
    pub enabled: Boolean,
    /// How long the estimated attitude may violate a constraint (assumed; paper 001: some short period).
    #[parameter(tunable, unit = "s", min = 0.0, max = 1e9, start = 10.0)]
    pub persistence: Real,
    /// How far beyond the boundary counts as a violation (assumed; paper 001: not triggered by overshoot). The default is what
    /// MomentumPlant's controller by its own defaults overshoots where a scan of 0.05 deg/s reverses, and at least 1 deg.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = PI, start = setup.monitor_margin_rad())]
    pub margin: Real,
}

/// The gimbal of the instrument that has one by [[instruments]]; without one its numbers mean nothing.
#[derive(Variables)]
pub struct GimbalVariables {
    /// Smallest angle from the instrument's boresight in the file, right-handed about the gimbal's axis.
    #[parameter(unit = "rad", display = "deg", min = command::BACK_HALF_TURN_RAD, max = PI, start = setup.gimbal_range_rad()[0])]
    pub minimum: Real,
    /// Greatest angle.
    #[parameter(unit = "rad", display = "deg", min = command::BACK_HALF_TURN_RAD, max = PI, start = setup.gimbal_range_rad()[1])]
    pub maximum: Real,
    /// Its angle in the scenarios gimbal and doubleTarget, with the boresight option gimbal, and in science of the scenario
    /// orbitPhase with guided.scienceUnload, where it keeps nadir; else 0.
    #[output(discrete, unit = "rad", display = "deg")]
    pub angle: Real,
    /// Whether that is what was requested; false: clamped to the nearest bound.
    #[output]
    pub in_range: Boolean,
}

/// The antennas.
#[derive(Variables)]
pub struct AntennaVariables {
    /// The antenna in use.
    #[output(items = AntennaSelect::antennas(&setup.spacecraft))]
    pub select: Choice<AntennaSelect>,
    /// Its beam's azimuth in the body frame, from -Y toward +X; of a fixed antenna that of its axis.
    #[output(discrete, unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1])]
    pub azimuth: Real,
}

/// The radio link with the Earth.
#[derive(Variables)]
pub struct LinkVariables {
    /// The Sun's neighbourhood in the sky, where there is no link (assumed; paper 001 names no angle).
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = PI, start = sun_direction::SOLAR_EXCLUSION_RAD)]
    pub sun_exclusion: Real,
    /// Half width of every antenna's beam across the XY plane; unless set each has its own by beam_deg of [[antennas]], of which the
    /// first stands here.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = FRAC_PI_2, start = setup.beam_rad())]
    pub beam: Real,
    /// Whether an antenna covers the Earth, neither behind the planet nor near the Sun.
    #[output]
    pub available: Boolean,
}

/// Search for the Sun.
#[derive(Variables)]
pub struct SunSearchVariables {
    /// Rate about X, Y and Z in turn (assumed; paper 001: slow).
    #[parameter(tunable, unit = "rad/s", display = "deg/s", min = -1.0, max = 1.0, start = transitions::SUN_SEARCH_RATE_RAD_S)]
    pub rate: Real,
    /// How long about each (assumed): the default is a whole turn.
    #[parameter(tunable, unit = "s", min = 1.0, max = 1e9, start = transitions::SUN_SEARCH_DURATION_S)]
    pub duration: Real,
}
