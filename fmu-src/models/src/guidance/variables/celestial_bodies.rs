//! Variables of bodies and spacecraft: positions, shape, attitude of the start.

use core::f64::consts::PI;

use fmi_export::{Boolean, Choice, Real, RealVector, Variables};
use physics::constants::{HALF_TURNS_RAD, QUARTER_TURNS_RAD};
use physics::environment::{ephemeris, time};
use physics::guidance::pointing::command;

use super::super::setup::GuidanceSetup as Setup;
use crate::common::choices::{OrbitCenter, custom_body};
use crate::common::orientation::RotationVariables;

/// Epoch and attitude at the start.
#[derive(Variables)]
pub struct StartVariables {
    /// Epoch at the start time, seconds past J2000 TDB; the default is 2009-04-06 00:00.
    #[parameter(unit = "s", display = "d", min = ephemeris::EARLIEST_EPOCH_S, max = ephemeris::VALID_EPOCH_S, start = time::MOMENTUM_STUDY_START_S)]
    #[annotation(role = "epoch")]
    pub epoch: Real,
    /// Attitude quaternion at the start, scalar last, from EME2000 to body; held until there is a command.
    #[parameter(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
}

/// Planet that is observed.
#[derive(Variables)]
pub struct TargetVariables {
    /// The planet that is observed, from whose centre positions count; by default orbit.center of the file's [start]. Set after
    /// packing, what nobody sets of planet.* and ephemeris.* is that body's own and reads back so once initialized; a group of
    /// which every parameter is set to its start value follows too.
    #[parameter(start = OrbitCenter(setup.target.data.body), items = custom_body(&setup.spacecraft))]
    pub planet: Choice<OrbitCenter>,
    /// Whether the boresight is on the aimpoint; false: clamped, constrained, or there is no such point.
    #[output]
    pub reachable: Boolean,
}

/// Shape, pole and rotation of the target planet.
#[derive(Variables)]
pub struct PlanetVariables {
    /// Radii of the ellipsoid along the planet's x, y and z.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e9, start = setup.target.radii_m)]
    pub radii: RealVector<3>,
    #[group(name = "", setup = &setup.target)]
    pub rotation: RotationVariables,
    /// Gravitational parameter of the planet: by the acceleration it gives, the rate of a frame that follows the velocity.
    #[parameter(unit = "m3/s2", display = "km3/s2", min = 0.0, max = 1e21, start = setup.target.data.gm_m3_s2)]
    pub gravitational_parameter: Real,
}

/// The Sun.
#[derive(Variables)]
pub struct SunVariables {
    /// Sun's position from the orbit's centre in EME2000 when ephemeris.source is inputs; zero: not connected yet.
    #[input(unit = "m", display = "AU", start = [0.0; 3])]
    #[annotation(
        also_called = "sun.positionInertial[i]",
        interpolation = "position",
        rate = "sun.velocity[i]"
    )]
    #[read_where(option = "ephemeris.source", items = "inputs")]
    pub position: RealVector<3>,
    /// Its velocity.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    #[annotation(also_called = "sun.velocityInertial[i]")]
    #[read_where(option = "ephemeris.source", items = "inputs")]
    pub velocity: RealVector<3>,
    /// Direction of the Sun as its sensors see it, body frame, of any length.
    #[input(unit = "1", start = [0.0; 3])]
    pub sensed: RealVector<3>,
    /// Whether they see it.
    #[input(start = false)]
    pub sensed_valid: Boolean,
    /// Azimuth of the Sun in the commanded body frame, from -Y toward +X.
    #[output(unit = "rad", display = "deg", min = HALF_TURNS_RAD[0], max = HALF_TURNS_RAD[1])]
    #[annotation(limited_by = "keepIn.azimuth")]
    pub azimuth: Real,
    /// Elevation of the Sun in the commanded body frame, positive toward -Z.
    #[output(unit = "rad", display = "deg", min = QUARTER_TURNS_RAD[0], max = QUARTER_TURNS_RAD[1])]
    #[annotation(limited_by = "keepIn.elevation")]
    pub elevation: Real,
}

/// The Earth.
#[derive(Variables)]
pub struct EarthVariables {
    /// UT1 minus UTC, for the Earth's orientation iau.
    #[parameter(tunable, unit = "s", min = -1e3, max = 1e3, start = 0.0)]
    pub ut1_offset: Real,
    /// Earth's position from the orbit's centre in EME2000 when ephemeris.source is inputs; zero: not connected yet.
    #[input(unit = "m", display = "AU", start = [0.0; 3])]
    #[annotation(
        also_called = "earth.positionInertial[i]",
        interpolation = "position",
        rate = "earth.velocity[i]"
    )]
    #[read_where(option = "ephemeris.source", items = "inputs")]
    pub position: RealVector<3>,
    /// Its velocity.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    #[annotation(also_called = "earth.velocityInertial[i]")]
    #[read_where(option = "ephemeris.source", items = "inputs")]
    pub velocity: RealVector<3>,
    /// Angle between Sun and Earth as seen from the spacecraft.
    #[output(discrete, unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI)]
    pub sun_separation: Real,
}

/// The attitude as star tracker and gyros give it.
#[derive(Variables)]
pub struct EstimateVariables {
    /// Attitude quaternion, scalar last, from EME2000 to body; what the monitor watches, and what turns the accelerometers'
    /// increments. 0, or never set: not connected yet, the monitor watches nothing and the commanded attitude stands in. The
    /// start value counts as set unless estimate.valid is set to its start value too.
    #[input(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    #[annotation(interpolation = "attitude", rate = "estimate.rate")]
    pub q: RealVector<4>,
    /// Body rate. No law reads it yet; it is here so that an estimator connects whole.
    #[input(unit = "rad/s", display = "deg/s", min = command::BACK_HALF_TURN_RAD, max = PI, start = [0.0; 3])]
    pub rate: RealVector<3>,
    /// Whether the attitude is known.
    #[input(start = true)]
    pub valid: Boolean,
}
