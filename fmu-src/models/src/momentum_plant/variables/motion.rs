//! Attitude and orbit: where they come from and what they are.

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Variables};

use super::super::setup::PlantSetup;
use physics::guidance::modes::guidance_command;

use super::choices::{AttitudeSource, CommandSource, OrbitDynamics, OrbitFrame, OrbitSource};
use super::defaults;
use crate::common::choices::custom_body;
use crate::common::choices::{CommandKind, OrbitCenter};

/// Attitude: where it comes from, and what it is.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct AttitudeVariables {
    /// Where the attitude comes from.
    #[parameter(start = AttitudeSource::Guided)]
    pub source: Choice<AttitudeSource>,
    /// Attitude quaternion, scalar last, from EME2000 to the body frame; the scalar is never negative.
    #[output(unit = "1", nominal = 1.0)]
    pub q: RealVector<4>,
    /// Angular rate of the body in EME2000, in body components.
    #[output(unit = "rad/s", display = "deg/s", nominal = 1e-3)]
    pub rate: RealVector<3>,
}

/// The command followed when attitude.source is commanded, tracked when it is controlled.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct CommandVariables {
    /// Where commands come from in commanded and controlled flight.
    #[parameter(start = CommandSource::Inputs)]
    pub source: Choice<CommandSource>,
    /// What the command gives. A command takes effect when any of the inputs it gives changes, and is propagated from then
    /// on. The attitude is held without rate while this is none, or while the quaternion it gives is all zero.
    #[input(start = CommandKind(guidance_command::CommandKind::Attitude))]
    pub kind: Choice<CommandKind>,
    /// Commanded attitude quaternion, scalar last, from EME2000 to the body frame; a norm of 0.1 to 10 is restored to 1.
    #[input(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
    /// Commanded angular rate in body components; the attitude is propagated with it.
    #[input(unit = "rad/s", display = "deg/s", start = [0.0; 3])]
    pub rate: RealVector<3>,
    /// Error quaternion, scalar last: from the commanded to the actual body frame, so that A(error) takes the boresight to
    /// the sensed Sun (paper 001, eq 25). In commanded flight it is turned out once, when command.kind becomes
    /// errorQuaternion; in controlled flight whenever it changes.
    #[input(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub error: RealVector<4>,
}

/// Where the flight starts.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct StartVariables {
    /// Epoch at the start time, seconds past J2000 TDB; the default is 2009-04-06 00:00.
    #[parameter(unit = "s", display = "d", min = defaults::EARLIEST_EPOCH_S, max = defaults::VALID_EPOCH_S, start = defaults::EPOCH_TDB_S)]
    pub epoch: Real,
    /// Attitude quaternion at the start, scalar last, from EME2000 to body; used until a command changes it. Unless this is set, be
    /// it to the identity, a controlled flight starts in the first attitude that command.q or the internal guidance commands, and a
    /// free one as the internal guidance points (start.q and start.rate both set to their start values count as not set, as some
    /// tools set everything).
    #[parameter(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
    /// Body rate at the start in controlled and free flight; that of the command or the internal guidance unless start.q or this
    /// is set.
    #[parameter(unit = "rad/s", display = "deg/s", min = -1e3, max = 1e3, start = [0.0; 3])]
    pub rate: RealVector<3>,
    /// System momentum at the start, body frame. In controlled and free flight it follows from start.rate and
    /// wheel[k].startMomentum instead.
    #[parameter(unit = "N.m.s", min = -1e12, max = 1e12, start = [0.0; 3])]
    pub momentum: RealVector<3>,
}

/// The spacecraft's orbit.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct OrbitVariables {
    /// What the spacecraft flies around. By a file that sets it in [start] the elements' and the planet's start values are of that
    /// body; set later, what nobody sets of orbit.*, planet.* and ephemeris.* is that body's own and reads back so once
    /// initialized, and a warning names the elements. A group of which every parameter is set to its start value follows too.
    #[parameter(start = OrbitCenter(setup.center.data.body), items = custom_body(&setup.spacecraft))]
    pub center: Choice<OrbitCenter>,
    /// Whether the orbit starts from elements, or from orbit.position and orbit.velocity, or these are where the spacecraft is.
    /// While one of the two is zero, of a held place the position, the flight waits for it: the attitude is held and nothing
    /// acts.
    #[parameter(start = OrbitSource::Elements)]
    pub source: Choice<OrbitSource>,
    /// What moves the spacecraft. On a disturbed orbit downlinks are counted from the periapses it really passes.
    #[parameter(start = OrbitDynamics::TwoBody)]
    pub dynamics: Choice<OrbitDynamics>,
    /// Whether the Sun's tide acts on a disturbed orbit.
    #[parameter(start = true)]
    pub sun_tide: Boolean,
    /// Whether light, heat, thrusters and force.applied move the spacecraft on a disturbed orbit.
    #[parameter(start = true)]
    pub radiation_feedback: Boolean,
    /// Longest integration step of a disturbed orbit; 300 s keep a revolution of the default orbit to 0.1 mm.
    #[parameter(unit = "s", min = 1.0, max = 1_800.0, start = 300.0)]
    pub step: Real,
    /// Frame of the elements; by default the equator of a planet, about the Sun the ecliptic.
    #[parameter(start = OrbitFrame(setup.center.frame()))]
    pub frame: Choice<OrbitFrame>,
    /// Semi-major axis; by default a period of 12 h about Mercury. About another planet the elements are by default those of a
    /// circle of three radii over the poles, about the Sun of 1 AU in the ecliptic.
    #[parameter(unit = "m", display = "km", min = 1.0, max = 1e13, start = setup.center.elements().semi_major_axis_m)]
    pub semi_major_axis: Real,
    /// Eccentricity.
    #[parameter(unit = "1", min = 0.0, max = 0.99, start = setup.center.elements().eccentricity)]
    pub eccentricity: Real,
    /// Inclination.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, start = setup.center.elements().inclination_rad)]
    pub inclination: Real,
    /// Longitude of the ascending node.
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = setup.center.elements().ascending_node_rad)]
    pub ascending_node: Real,
    /// Argument of periapsis.
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = setup.center.elements().periapsis_argument_rad)]
    pub periapsis_argument: Real,
    /// True anomaly at the start.
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = 0.0)]
    pub true_anomaly: Real,
    /// Position about the centre in EME2000 when orbit.source is inputs, where the orbit starts anew when it changes, or held.
    #[input(unit = "m", display = "km", start = [0.0; 3])]
    pub position: RealVector<3>,
    /// Velocity about the centre in EME2000 when orbit.source is inputs or held.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    pub velocity: RealVector<3>,
    /// Time since the last periapsis.
    #[output(unit = "s", display = "h", nominal = 1e4)]
    pub time_since_periapsis: Real,
}

/// Commands over time.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct TimelineVariables {
    /// Whether guided flight, and controlled flight with command.source guidance, follow the FMU's timeline.toml. Where it commands
    /// nothing guided.* rules.
    #[parameter(start = true)]
    pub enabled: Boolean,
    /// Row of the `[[command]]` in force, from 1; 0 where none is.
    #[output]
    pub command: Integer,
}
