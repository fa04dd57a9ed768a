//! Attitude, its commands, and the orbit.

use fmi_export::{Boolean, Choice, Integer, Real, RealVector, Values, Variables};

use super::super::setup::PlantSetup as Setup;
use physics::bodies::Body;
use physics::environment::{ephemeris, time};
use physics::guidance::modes::guidance_command;

use super::choices::{
    AttitudeSource, CommandSource, EncounterBody, OrbitDynamics, OrbitFrame, OrbitSource, StartAttitude,
};
use crate::common::choices::{CommandKind, OrbitCenter, custom_body};

/// Source of the attitude, attitude quaternion and rate.
#[derive(Variables)]
pub struct AttitudeVariables {
    /// Where the attitude comes from.
    #[parameter(start = AttitudeSource::Guided)]
    pub source: Choice<AttitudeSource>,
    /// Attitude quaternion, scalar last, from EME2000 to the body frame. Of its two signs it begins with the one nearer to start.q and
    /// then keeps it: it is continuous wherever the attitude is, and where that jumps the nearer one is taken.
    #[output(unit = "1", nominal = 1.0)]
    #[annotation(interpolation = "attitude", rate = "attitude.rate")]
    pub q: RealVector<4>,
    /// Angular rate of the body in EME2000, in body components.
    #[output(unit = "rad/s", display = "deg/s", nominal = 1e-3)]
    pub rate: RealVector<3>,
}

/// The command followed when attitude.source is commanded, tracked when it is controlled.
#[derive(Variables)]
pub struct CommandVariables {
    /// Where commands come from in commanded and controlled flight.
    #[parameter(start = CommandSource::Inputs)]
    pub source: Choice<CommandSource>,
    /// What the command gives. A command takes effect when any of the inputs it gives changes, and is propagated from then
    /// on. The attitude is held without rate while this is none, or while the quaternion it gives is all zero.
    #[input(start = CommandKind(guidance_command::CommandKind::Attitude))]
    #[read_where(option = "attitude.source", items = "commanded controlled", set = "commanded")]
    #[read_where(option = "command.source", items = "inputs", set = "inputs")]
    pub kind: Choice<CommandKind>,
    /// Commanded attitude quaternion, scalar last, from EME2000 to the body frame; a norm of 0.1 to 10 is restored to 1, with
    /// a warning where it is off by more than 5 %. Its sign does not count.
    #[input(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    #[annotation(interpolation = "attitude", rate = "command.rate")]
    #[read_where(option = "attitude.source", items = "commanded controlled", set = "commanded")]
    #[read_where(option = "command.source", items = "inputs", set = "inputs")]
    pub q: RealVector<4>,
    /// Commanded angular rate in body components; the attitude is propagated with it.
    #[input(unit = "rad/s", display = "deg/s", start = [0.0; 3])]
    #[read_where(option = "attitude.source", items = "commanded controlled", set = "commanded")]
    #[read_where(option = "command.source", items = "inputs", set = "inputs")]
    pub rate: RealVector<3>,
    /// Error quaternion, scalar last: from the commanded to the actual body frame, so that A(error) takes the boresight to
    /// the sensed Sun (paper 001, eq 25). In commanded flight it is turned out once, when command.kind becomes
    /// errorQuaternion; in controlled flight whenever it changes.
    #[input(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    #[annotation(interpolation = "attitude")]
    #[read_where(option = "attitude.source", items = "commanded controlled", set = "commanded")]
    #[read_where(option = "command.source", items = "inputs", set = "inputs")]
    pub error: RealVector<4>,
}

/// Epoch, attitude, rate and momentum at the start.
#[derive(Variables)]
pub struct StartVariables {
    /// Epoch at the start time, seconds past J2000 TDB; the default is 2009-04-06 00:00.
    #[parameter(unit = "s", display = "d", min = ephemeris::EARLIEST_EPOCH_S, max = ephemeris::VALID_EPOCH_S, start = time::MOMENTUM_STUDY_START_S)]
    #[annotation(role = "epoch")]
    pub epoch: Real,
    /// Whether a controlled or free flight starts in start.q at start.rate (given), or in the first attitude and at the rate that
    /// the command or, in free flight too, the internal guidance gives (guided). automatic is given where start.q or start.rate
    /// stands in the file or is set, be it to its start value, else guided; also where every parameter of the FMU is set and both
    /// have their start values, as some tools set everything. The log tells which.
    #[parameter(start = StartAttitude::Automatic)]
    pub attitude: Choice<StartAttitude>,
    /// Attitude quaternion at the start, scalar last, from EME2000 to body; used until a command changes it, in controlled and free
    /// flight by start.attitude.
    #[parameter(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
    /// Body rate at the start in controlled and free flight by start.attitude; set, it also counts where that is guided.
    #[parameter(unit = "rad/s", display = "deg/s", min = -1e3, max = 1e3, start = [0.0; 3])]
    pub rate: RealVector<3>,
    /// System momentum at the start, body frame, from momentum.bias. In controlled and free flight it follows from start.rate and
    /// wheel[k].startMomentum instead.
    #[parameter(unit = "N.m.s", min = -1e12, max = 1e12, start = [0.0; 3])]
    pub momentum: RealVector<3>,
}

/// The spacecraft's orbit.
#[derive(Variables)]
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
    /// Whether the Moon's tide acts on a disturbed orbit about the Earth.
    #[parameter(start = true)]
    pub moon_tide: Boolean,
    /// Whether light, heat, thrusters and force.applied move the spacecraft on a disturbed orbit.
    #[parameter(start = true)]
    pub radiation_feedback: Boolean,
    /// Longest integration step of a disturbed orbit; 300 s keep a revolution of the default orbit to 0.1 mm.
    #[parameter(unit = "s", min = 1.0, max = 86_400.0, start = 300.0)]
    pub step: Real,
    pub attraction: AttractionVariables,
    /// Whether the Sun's relativity acts with orbit.dynamics nBody: some 60 km in 200 days at 0.5 AU.
    #[parameter(start = true)]
    pub relativity: Boolean,
    /// Whether the path of orbit.dynamics nBody is integrated about the planet within whose sphere of influence it is, else about the
    /// Sun; otherwise, and about the body of the spacecraft's file, about orbit.center throughout. Positions count from orbit.center
    /// either way. Beyond the sphere of an orbit.center that bodies pull which orbit.attraction.* switches off, set it to false.
    #[parameter(start = true)]
    pub change_center: Boolean,
    /// Longest integration step of orbit.dynamics nBody; it is halved until orbit.nBodyTolerance holds.
    #[parameter(unit = "s", display = "h", min = 1.0, max = 864_000.0, start = 86_400.0)]
    pub n_body_step: Real,
    /// Error of position that a step of orbit.dynamics nBody may have, by its last Chebyshev term.
    #[parameter(unit = "m", display = "mm", min = 1e-5, max = 1e6, start = 1e-3)]
    pub n_body_tolerance: Real,
    /// Frame of the elements, and of osculating.*; by default the equator of a planet, about the Sun the ecliptic.
    #[parameter(start = OrbitFrame(setup.center.frame()))]
    pub frame: Choice<OrbitFrame>,
    /// Semi-major axis, with an eccentricity above 1 negative; by default a period of 12 h about Mercury. About another planet the
    /// elements are by default those of a circle of three radii over the poles, about the Sun of 1 AU in the ecliptic.
    #[parameter(unit = "m", display = "km", min = -1e13, max = 1e13, start = setup.center.elements().semi_major_axis_m)]
    pub semi_major_axis: Real,
    /// Eccentricity; above 1 that of a hyperbola. A parabola, 1, is given by orbit.source inputs.
    #[parameter(unit = "1", min = 0.0, max = 1e3, start = setup.center.elements().eccentricity)]
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
    #[annotation(interpolation = "position", rate = "orbit.velocity[i]")]
    #[read_where(option = "orbit.source", items = "inputs held")]
    pub position: RealVector<3>,
    /// Velocity about the centre in EME2000 when orbit.source is inputs or held.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    #[read_where(option = "orbit.source", items = "inputs held")]
    pub velocity: RealVector<3>,
    /// Time since the last periapsis.
    #[output(unit = "s", display = "h", nominal = 1e4)]
    pub time_since_periapsis: Real,
    /// The body that the path is integrated about at present; orbit.center but with orbit.dynamics nBody.
    #[output(items = custom_body(&setup.spacecraft))]
    pub current_center: Choice<OrbitCenter>,
}

/// Bodies that attract the spacecraft in nBody motion, next to the Sun and orbit.center, and the centre of integration.
#[derive(Variables)]
pub struct AttractionVariables {
    /// Whether Mercury does.
    #[parameter(start = true)]
    pub mercury: Boolean,
    /// Whether Venus does.
    #[parameter(start = true)]
    pub venus: Boolean,
    /// Whether the Earth does.
    #[parameter(start = true)]
    pub earth: Boolean,
    /// Whether the Moon does; by VSOP87's Earth and barycentre, or by the FMU's ephemeris.toml.
    #[parameter(start = true)]
    pub moon: Boolean,
    /// Whether Mars does.
    #[parameter(start = true)]
    pub mars: Boolean,
    /// Whether Jupiter does.
    #[parameter(start = true)]
    pub jupiter: Boolean,
}

impl OrbitVariables {
    /// Whether the orbit is propagated between planets.
    pub fn is_n_body(&self, values: &Values) -> bool {
        matches!(values.choice(self.dynamics), OrbitDynamics::NBody)
    }
}

impl EncounterVariables {
    /// The planet of the encounter, which other dynamics do not have.
    pub fn body(&self, orbit: &OrbitVariables, values: &Values) -> Option<Body> {
        values.choice(self.body).0.filter(|_| orbit.is_n_body(values))
    }
}

impl AttractionVariables {
    /// The planets with what says whether they attract.
    pub fn planets(&self) -> [(Body, Boolean); 5] {
        [
            (Body::Mercury, self.mercury),
            (Body::Venus, self.venus),
            (Body::Earth, self.earth),
            (Body::Mars, self.mars),
            (Body::Jupiter, self.jupiter),
        ]
    }
}

/// The planet that the spacecraft is on its way to, with orbit.dynamics nBody.
#[derive(Variables)]
pub struct EncounterVariables {
    /// The planet of the encounter, another than orbit.center. Where it is given, planet.*, shadow, light, heat and gravity gradient are
    /// that planet's.
    #[parameter(start = EncounterBody(None))]
    pub body: Choice<EncounterBody>,
    /// So long before a predicted closest approach the hyperbola of prediction.bT and prediction.bR osculates.
    #[parameter(unit = "s", display = "h", min = 0.0, max = 1e8, start = 21_600.0)]
    pub lead_time: Real,
    /// Its position from orbit.center in EME2000; 0 without an encounter, as its velocity and distance.
    #[output(unit = "m", display = "AU", nominal = 1e11)]
    pub position: RealVector<3>,
    /// Its velocity from orbit.center in EME2000.
    #[output(unit = "m/s", display = "km/s", nominal = 1e4)]
    pub velocity: RealVector<3>,
    /// Distance of the spacecraft from its centre.
    #[output(unit = "m", display = "km", nominal = 1e10)]
    pub distance: Real,
    /// Whether the present osculating orbit about it is a hyperbola, of which the next three are.
    #[output]
    pub hyperbolic: Boolean,
    /// Component of B along T: B is where the incoming asymptote meets the plane through the planet's centre across it, T = unit(S x
    /// N), S along the asymptote, N north of the ecliptic of J2000. Of the hyperbola osculating now: six hours before periapsis and
    /// there it differs by tens of kilometres.
    #[output(unit = "m", display = "km", nominal = 1e7)]
    pub b_t: Real,
    /// Component of B along R = S x T.
    #[output(unit = "m", display = "km", nominal = 1e7)]
    pub b_r: Real,
    /// Speed far from the planet.
    #[output(unit = "m/s", display = "km/s", nominal = 1e3)]
    pub excess_speed: Real,
    /// How many closest approaches within the planet's sphere of influence are over.
    #[output]
    pub count: Integer,
    /// Time of the last one; -1 before any.
    #[output(unit = "s", display = "d", nominal = 1e6)]
    pub last_time: Real,
    /// Its altitude above planet.radius; 0 before any.
    #[output(unit = "m", display = "km", nominal = 1e6)]
    pub last_altitude: Real,
}

/// Predictions of the encounter: the flight simulated on to the next closest approach within the sphere of influence of
/// encounter.body, along the present timeline, inputs held.
#[derive(Variables)]
pub struct PredictionVariables {
    /// The encounter is predicted at whole multiples of this time; 0: never. Each prediction costs a flight of the orbit up to the
    /// encounter, also of solver.workLimit. It is made in the step that begins there or goes over it, with that step's inputs.
    #[parameter(unit = "s", display = "d", min = 0.0, max = 1e10, start = 0.0)]
    pub refresh: Real,
    /// How far ahead the closest approach is looked for at most; where there is none until then, that costs all of it.
    #[parameter(unit = "s", display = "d", min = 1.0, max = 1e10, start = 34_560_000.0)]
    pub horizon: Real,
    /// Whether the last prediction found a closest approach, and a hyperbola encounter.leadTime before it.
    #[output]
    pub valid: Boolean,
    /// Time of the last prediction; -1 before any.
    #[output(unit = "s", display = "d", nominal = 1e6)]
    pub since: Real,
    /// Time of the closest approach it found; -1 without one. On a path into the planet that of the impact.
    #[output(unit = "s", display = "d", nominal = 1e6)]
    pub arrival: Real,
    /// Altitude of the closest approach above planet.radius; 0 on a path into the planet, and without one.
    #[output(unit = "m", display = "km", nominal = 1e6)]
    pub altitude: Real,
    /// Speed far from the planet of the hyperbola that osculates at prediction.epoch; 0 without one, as the next three.
    #[output(unit = "m/s", display = "km/s", nominal = 1e3)]
    pub excess_speed: Real,
    /// Component of its B along T, as encounter.bT has it.
    #[output(unit = "m", display = "km", nominal = 1e7)]
    pub b_t: Real,
    /// Component of its B along R.
    #[output(unit = "m", display = "km", nominal = 1e7)]
    pub b_r: Real,
    /// When that hyperbola osculates, seconds past J2000 TDB: encounter.leadTime before the closest approach, or at the prediction
    /// if that is later.
    #[output(unit = "s", display = "d", nominal = 1e8)]
    #[annotation(role = "epoch")]
    pub epoch: Real,
}

/// Commands over time.
#[derive(Variables)]
pub struct TimelineVariables {
    /// Whether guided flight, and controlled flight with command.source guidance, follow the FMU's timeline.toml. Where it commands
    /// nothing guided.* rules.
    #[parameter(start = true)]
    pub enabled: Boolean,
    /// Row of the `[[command]]` in force, from 1; 0 where none is.
    #[output]
    pub command: Integer,
    /// When the timeline's command ends, or where none is in force the next one begins; -1 where none does.
    #[output(discrete, unit = "s", display = "d")]
    pub until: Real,
}
