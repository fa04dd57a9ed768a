//! The plant's variables at its public face.

use super::setup::PlantSetup;
use fmi_export::{Boolean, Choice, Integer, Real, RealMatrix, RealVector, Variables};

use super::choices::{
    AttitudeSource, CommandKind, DumpReinit, EclipseModel, EphemerisSource, MomentumConvention, OrbitCenter,
    OrbitFrame, OrbitModel, OrbitSource, PanelControl, PanelTilt, ScienceRule, SunshadeModel,
};
use super::defaults;
use crate::shared::DayTemperature;
use physics::environment::surface::MERCURY;

/// Every variable of the plant, in the order of the XML.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct PlantVariables {
    #[group]
    pub attitude: AttitudeVariables,
    #[group]
    pub command: CommandVariables,
    #[group]
    pub guided: GuidedVariables,
    #[group]
    pub initial: InitialVariables,
    #[group]
    pub orbit: OrbitVariables,
    #[group]
    pub planet: PlanetVariables,
    #[group]
    pub ephemeris: EphemerisVariables,
    #[group]
    pub solar: SolarVariables,
    #[group]
    pub eclipse: EclipseVariables,
    #[group]
    pub planet_light: PlanetLightVariables,
    #[group]
    pub thermal: ThermalVariables,
    #[group]
    pub shadowing: ShadowingVariables,
    #[group]
    pub gravity_gradient: GravityGradientVariables,
    #[group]
    pub spacecraft: SpacecraftVariables,
    #[group]
    pub sunshade: SunshadeVariables,
    #[group(count = setup.spacecraft.panels.len())]
    pub panel: Vec<PanelVariables>,
    #[group(count = setup.spacecraft.wheels.len())]
    pub wheel: Vec<WheelVariables>,
    #[group]
    pub keep_in: KeepInVariables,
    #[group]
    pub momentum: MomentumVariables,
    #[group]
    pub dump: DumpVariables,
    #[group]
    pub torque: TorqueVariables,
    #[group]
    pub force: ForceVariables,
    #[group]
    pub sun: SunVariables,
    #[group]
    pub earth: EarthVariables,
    #[group]
    pub heliocentric: HeliocentricVariables,
    #[group]
    pub solver: SolverVariables,
    /// Acceleration by the forces listed here, without gravity, in EME2000.
    #[output(unit = "m/s2", display = "nm/s2", nominal = 1e-7)]
    pub acceleration: RealVector<3>,
    /// Velocity change since the start by the forces listed here, without gravity, in EME2000.
    #[output(unit = "m/s", display = "mm/s", nominal = 1e-3)]
    pub delta_v: RealVector<3>,
    /// Position about the orbit's centre, in EME2000.
    #[output(unit = "m", display = "km", nominal = 1e7)]
    pub position: RealVector<3>,
    /// Velocity about the orbit's centre, in EME2000.
    #[output(unit = "m/s", display = "km/s", nominal = 1e3)]
    pub velocity: RealVector<3>,
    /// Spacecraft mass.
    #[output(unit = "kg", nominal = 1e3)]
    pub mass: Real,
    /// Centre of mass in the body frame.
    #[output(unit = "m", display = "cm")]
    pub center_of_mass: RealVector<3>,
    #[group(count = setup.reported_faces.len())]
    pub plate: Vec<PlateVariables>,
}

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

/// The command followed when attitude.source is commanded.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct CommandVariables {
    /// What the command gives. A command takes effect when any of its inputs changes, and is propagated from then on.
    #[input(start = CommandKind::Attitude)]
    pub kind: Choice<CommandKind>,
    /// Commanded attitude quaternion, scalar last, from EME2000 to the body frame.
    #[input(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
    /// Commanded angular rate in body components; the attitude is propagated with it.
    #[input(unit = "rad/s", display = "deg/s", start = [0.0; 3])]
    pub rate: RealVector<3>,
    /// Error quaternion, scalar last: the rotation from the attitude held to the one commanded.
    #[input(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub error: RealVector<4>,
}

/// The guidance law when attitude.source is guided.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct GuidedVariables {
    /// How the spacecraft stands while it observes.
    #[parameter(start = ScienceRule::Scaled)]
    pub science_rule: Choice<ScienceRule>,
    /// Sun elevation per (Sun-nadir angle - 90 deg) under the scaled rule; 0.25 is fitted to paper 000's Table 2.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = 0.25)]
    pub science_gain: Real,
    /// Begin of downlink after periapsis.
    #[parameter(unit = "s", display = "h", min = 0.0, start = 7_200.0)]
    pub downlink_start: Real,
    /// End of downlink after periapsis.
    #[parameter(unit = "s", display = "h", min = 0.0, start = 36_000.0)]
    pub downlink_end: Real,
    /// A downlink after every how many periapses; 0 = never.
    #[parameter(min = 0, max = 1_000, start = 2)]
    pub downlink_every: Integer,
    /// Turn rate between science and downlink attitudes; 0 = at once, as in paper 000.
    #[parameter(unit = "rad/s", display = "deg/s", min = 0.0, start = 0.0)]
    pub slew_rate: Real,
}

/// Where the flight starts.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct InitialVariables {
    /// Epoch at the start time, seconds past J2000 TDB; the default is 2009-04-06 00:00.
    #[parameter(unit = "s", display = "d", start = defaults::EPOCH_TDB_S)]
    pub epoch: Real,
    /// Attitude quaternion at the start, scalar last, from EME2000 to body; used until a command changes it.
    #[parameter(unit = "1", start = [0.0, 0.0, 0.0, 1.0])]
    pub q: RealVector<4>,
    /// System momentum at the start, body frame.
    #[parameter(unit = "N.m.s", start = [0.0; 3])]
    pub momentum: RealVector<3>,
}

/// The spacecraft's orbit.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct OrbitVariables {
    /// What the spacecraft flies around.
    #[parameter(start = OrbitCenter::Mercury)]
    pub center: Choice<OrbitCenter>,
    /// Whether the orbit starts from elements, or from orbit.position and orbit.velocity.
    #[parameter(start = OrbitSource::Elements)]
    pub source: Choice<OrbitSource>,
    /// What moves the spacecraft. On a disturbed orbit downlinks are counted from the periapses it really passes.
    #[parameter(start = OrbitModel::TwoBody)]
    pub model: Choice<OrbitModel>,
    /// Whether the Sun's tide acts on a disturbed orbit.
    #[parameter(start = true)]
    pub sun_tide: Boolean,
    /// Whether light, heat and force.external move the spacecraft on a disturbed orbit.
    #[parameter(start = true)]
    pub radiation_feedback: Boolean,
    /// Longest integration step of a disturbed orbit; 300 s keep a revolution of the default orbit to 0.1 mm.
    #[parameter(unit = "s", min = 1.0, max = 1_800.0, start = 300.0)]
    pub step: Real,
    /// Frame of the elements.
    #[parameter(start = OrbitFrame::MercuryEquator)]
    pub frame: Choice<OrbitFrame>,
    /// Semi-major axis; the default gives a period of 12 h.
    #[parameter(unit = "m", display = "km", min = 1.0, start = defaults::semi_major_axis_m())]
    pub semi_major_axis: Real,
    /// Eccentricity.
    #[parameter(unit = "1", min = 0.0, max = 0.99, start = 0.74)]
    pub eccentricity: Real,
    /// Inclination.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, start = 82.52_f64.to_radians())]
    pub inclination: Real,
    /// Longitude of the ascending node.
    #[parameter(unit = "rad", display = "deg", start = 350.17_f64.to_radians())]
    pub ascending_node: Real,
    /// Argument of periapsis.
    #[parameter(unit = "rad", display = "deg", start = 119.16_f64.to_radians())]
    pub periapsis_argument: Real,
    /// True anomaly at the start.
    #[parameter(unit = "rad", display = "deg", start = 0.0)]
    pub true_anomaly: Real,
    /// Position about the centre in EME2000 when orbit.source is inputs; the orbit starts anew when it changes.
    #[input(unit = "m", display = "km", start = [0.0; 3])]
    pub position: RealVector<3>,
    /// Velocity about the centre in EME2000 when orbit.source is inputs.
    #[input(unit = "m/s", display = "km/s", start = [0.0; 3])]
    pub velocity: RealVector<3>,
    /// Time since the last periapsis.
    #[output(unit = "s", display = "h", nominal = 1e4)]
    pub time_since_periapsis: Real,
}

/// The planet the spacecraft orbits.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct PlanetVariables {
    /// Gravitational parameter of Mercury.
    #[parameter(unit = "m3/s2", display = "km3/s2", min = 1.0, start = defaults::MERCURY_GM_M3_S2)]
    pub gravitational_parameter: Real,
    /// Radius of Mercury; a flight below it is refused.
    #[parameter(unit = "m", display = "km", min = 1.0, start = defaults::MERCURY_RADIUS_M)]
    pub radius: Real,
    /// Flattening of Mercury's gravity on a disturbed orbit: second zonal harmonic, unnormalised (HgM005); 0 = none.
    #[parameter(unit = "1", start = defaults::MERCURY_J2)]
    pub j2: Real,
    /// Radius to which planet.j2 refers.
    #[parameter(unit = "m", display = "km", min = 1.0, start = defaults::MERCURY_J2_RADIUS_M)]
    pub j2_radius: Real,
    /// Right ascension of Mercury's north pole in EME2000 (IAU 2015).
    #[parameter(unit = "rad", display = "deg", start = defaults::MERCURY_POLE_RIGHT_ASCENSION_RAD)]
    pub pole_right_ascension: Real,
    /// Declination of Mercury's north pole in EME2000 (IAU 2015).
    #[parameter(unit = "rad", display = "deg", start = defaults::MERCURY_POLE_DECLINATION_RAD)]
    pub pole_declination: Real,
    /// Fraction of sunlight the planet absorbs; 0.88 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = MERCURY.absorptivity)]
    pub absorptivity: Real,
    /// Fraction of sunlight the planet reflects diffusely; 0.12 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = MERCURY.diffuse_reflectivity)]
    pub diffuse_reflectivity: Real,
    /// Infrared emissivity of the planet; 0.9 fits paper 004, which does not print it.
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = MERCURY.emissivity)]
    pub emissivity: Real,
    /// Temperature of the planet's night side; 100 K fits paper 004, which does not print it.
    #[parameter(unit = "K", min = 0.0, max = 1e4, start = MERCURY.night_temperature_k)]
    pub night_temperature: Real,
    /// How the planet's day side is heated.
    #[parameter(start = DayTemperature::Uniform)]
    pub day_temperature: Choice<DayTemperature>,
}

/// Positions of Sun, Mercury and Earth.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct EphemerisVariables {
    /// Where the positions of Sun and Earth come from.
    #[parameter(start = EphemerisSource::Vsop87)]
    pub source: Choice<EphemerisSource>,
    /// Semi-major axis of the planet's orbit about the Sun when source is keplerAsPrinted; elements are in the ecliptic and
    /// equinox of J2000, paper 004's Table 4 (whose axis is printed a digit short).
    #[parameter(unit = "m", display = "AU", min = 1e9, start = defaults::PRINTED.semi_major_axis_m)]
    pub semi_major_axis: Real,
    /// Its eccentricity.
    #[parameter(unit = "1", min = 0.0, max = 0.99, start = defaults::PRINTED.eccentricity)]
    pub eccentricity: Real,
    /// Its inclination.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, start = defaults::PRINTED.inclination_rad)]
    pub inclination: Real,
    /// Longitude of its ascending node.
    #[parameter(unit = "rad", display = "deg", start = defaults::PRINTED.ascending_node_rad)]
    pub ascending_node: Real,
    /// Its argument of perihelion; paper 004 uses Mercury's longitude of perihelion, 77.46 deg, in its place.
    #[parameter(unit = "rad", display = "deg", start = defaults::PRINTED.periapsis_argument_rad)]
    pub periapsis_argument: Real,
    /// The planet's true anomaly at initial.epoch; paper 004's cases 1 to 4 are 10, 98, 189 and 279 deg.
    #[parameter(unit = "rad", display = "deg", start = defaults::PRINTED.true_anomaly_rad)]
    pub true_anomaly: Real,
}

/// Sunlight.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct SolarVariables {
    /// Solar flux at 1 AU; 1353 W/m2 reproduces paper 000's pressure (well-known simulators use 1349 to 1368).
    #[parameter(unit = "W/m2", min = 0.0, start = defaults::SOLAR_FLUX_W_M2)]
    pub flux: Real,
    /// Whether the pressure is solar.pressure everywhere instead of following the distance from the Sun.
    #[parameter(start = false)]
    pub fixed_pressure: Boolean,
    /// Radiation pressure when it is fixed; the default is paper 000's value at 0.3 AU.
    #[parameter(unit = "Pa", display = "uPa", min = 0.0, start = 5.0145e-5)]
    pub pressure: Real,
}

/// Shadow of the planet.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct EclipseVariables {
    /// How the planet's shadow dims the Sun.
    #[parameter(start = EclipseModel::Discs)]
    pub model: Choice<EclipseModel>,
}

/// Light of the planet.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct PlanetLightVariables {
    /// Whether sunlight reflected by the planet and its infrared light act and heat; paper 000 leaves them out.
    #[parameter(start = false)]
    pub enabled: Boolean,
    /// Quadrature nodes over the planet's disc: 6 for 1e-4 of the force, 16 for 1e-5.
    #[parameter(min = 1, max = 64, start = 6)]
    pub nodes: Integer,
}

/// Heat the spacecraft radiates.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct ThermalVariables {
    /// Whether the recoil of radiated heat acts; paper 000 leaves it out.
    #[parameter(start = false)]
    pub enabled: Boolean,
    /// Whether surfaces whose file gives a heat capacity store heat, and stay warm into an eclipse; otherwise every surface
    /// is in balance with its light.
    #[parameter(start = true)]
    pub storage: Boolean,
}

/// Shadows of the spacecraft's surfaces on one another.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct ShadowingVariables {
    /// Whether surfaces given as polygons shadow one another from the Sun. Planet light is never shadowed.
    #[parameter(start = false)]
    pub enabled: Boolean,
}

/// Gravity-gradient torque.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct GravityGradientVariables {
    /// Whether the planet's gravity gradient acts; paper 000 leaves it out.
    #[parameter(start = true)]
    pub enabled: Boolean,
}

/// Mass properties.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct SpacecraftVariables {
    /// Spacecraft mass.
    #[parameter(tunable, unit = "kg", min = 1e-3, start = setup.spacecraft.mass_properties.mass_kg)]
    pub mass: Real,
    /// Inertia about the centre of mass, body frame.
    #[parameter(unit = "kg.m2", start = defaults::inertia_kg_m2(setup))]
    pub inertia: RealMatrix<3, 3>,
    /// Centre of mass in the body frame.
    #[parameter(tunable, unit = "m", display = "cm", start = setup.spacecraft.mass_properties.center_of_mass_body_m.into())]
    pub center_of_mass: RealVector<3>,
}

/// Sunshade.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct SunshadeVariables {
    /// Which model of the shade takes the light.
    #[parameter(start = defaults::sunshade_model(setup))]
    pub model: Choice<SunshadeModel>,
    /// Coefficients of paper 000's eq 3 for the shade in use, about the centre of mass, in the shade's frame: rows are
    /// torque components x, y, z; columns the monomials x, y, z, xy, xz, yz, xx, yy, zz of the Sun direction. Torque
    /// is pressure times the polynomial while sunshade.polynomialValid holds.
    #[calculated_parameter(tunable, unit = "m3")]
    pub coefficient: RealMatrix<3, 9>,
    /// Whether all of the shade is lit, so that the polynomial gives its torque; elsewhere it is clipped.
    #[output]
    pub polynomial_valid: Boolean,
}

/// One solar panel.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct PanelVariables {
    /// What sets the panel's rotation angle.
    #[parameter(start = defaults::panel_control(setup, index))]
    pub control: Choice<PanelControl>,
    /// Angle between the panel's normal and the Sun direction when it is held by Sun offset.
    #[parameter(tunable, unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, start = setup.spacecraft.panels[index].sun_offset_rad)]
    pub sun_offset: Real,
    /// Sense of that tilt; the paper does not print it.
    #[parameter(start = defaults::panel_tilt(setup, index))]
    pub tilt: Choice<PanelTilt>,
    /// Whether the panel takes part; paper 000's Tables 2 and 3 leave the panels out.
    #[parameter(start = true)]
    pub enabled: Boolean,
    /// Rotation angle when panel control is by angle.
    #[input(unit = "rad", display = "deg", start = setup.spacecraft.panels[index].angle_rad)]
    pub angle: Real,
    /// Rotation angle in effect, about the panel's axis from its zero position.
    #[output(unit = "rad", display = "deg")]
    pub angle_actual: Real,
}

/// One reaction wheel. In guided and commanded flight the wheels hold the system momentum less the body's own.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct WheelVariables {
    /// Greatest spin momentum the wheel can hold.
    #[parameter(unit = "N.m.s", min = 0.0, start = setup.spacecraft.wheels[index].capacity_n_m_s)]
    pub capacity: Real,
    /// Spin momentum about the wheel's axis; stays 0 unless the wheels' axes span all directions.
    #[output(unit = "N.m.s", nominal = 1.0)]
    pub momentum: Real,
    /// Whether the wheel would have to hold more than its capacity.
    #[output]
    pub saturated: Boolean,
}

/// Sun keep-in zone.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct KeepInVariables {
    /// Largest Sun azimuth.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, start = defaults::keep_in(setup).azimuth_rad)]
    pub azimuth: Real,
    /// Largest Sun elevation; guided attitudes stay within.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::FRAC_PI_2, start = defaults::keep_in(setup).elevation_rad)]
    pub elevation: Real,
    /// How far inside the zone the Sun stands; negative outside.
    #[output(unit = "rad", display = "deg")]
    pub margin: Real,
}

/// System momentum.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct MomentumVariables {
    /// What momentum.body and the dump thresholds mean.
    #[parameter(start = MomentumConvention::Inertial)]
    pub convention: Choice<MomentumConvention>,
    /// System momentum in the body frame, by momentum.convention.
    #[output(unit = "N.m.s", nominal = 1.0)]
    pub body: RealVector<3>,
    /// System momentum in EME2000: always the physical total.
    #[output(unit = "N.m.s", nominal = 1.0)]
    pub inertial: RealVector<3>,
}

/// Thruster dumps, taken as instantaneous.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct DumpVariables {
    /// Magnitude of a body component of momentum that triggers a dump; a very large value means never.
    #[parameter(tunable, unit = "N.m.s", min = 0.0, start = defaults::dump_threshold_n_m_s(setup))]
    pub threshold: RealVector<3>,
    /// Where a component goes that exceeded its threshold.
    #[parameter(start = DumpReinit::Opposite)]
    pub reinit: Choice<DumpReinit>,
    /// Fraction of the threshold, of opposite sign, after a dump: 1 is paper 000's, which dumps again within minutes
    /// where the drift reverses; 0.9 is robust; 0 dumps to zero.
    #[parameter(tunable, unit = "1", min = 0.0, max = 1.0, start = 0.9)]
    pub reinit_fraction: Real,
    /// A rising edge dumps all components to dump.target.
    #[input(start = false)]
    pub request: Boolean,
    /// Momentum after a requested dump, body frame.
    #[input(unit = "N.m.s", start = [0.0; 3])]
    pub target: RealVector<3>,
    /// Time that must lie between dumps; paper 000's mission asks for five days.
    #[parameter(unit = "s", display = "d", min = 0.0, start = 432_000.0)]
    pub required_spacing: Real,
    /// Largest threshold the wheels can honour on all axes at once, by their capacities and spin axes; 0 without wheels
    /// in all directions. Paper 000 states 4, 5.5 and 7 N.m.s for wheels of 4, 8 and 12 N.m.s without printing the axes.
    #[calculated_parameter(unit = "N.m.s")]
    pub guaranteed_threshold: Real,
    /// Whether two dumps lay closer together than dump.requiredSpacing.
    #[output]
    pub too_close: Boolean,
    /// Dumps so far.
    #[output]
    pub count: Integer,
    /// Time of the last dump; -1 before any.
    #[output(discrete, unit = "s", display = "d")]
    pub last_time: Real,
    /// Shortest time between two dumps so far; -1 before the second.
    #[output(discrete, unit = "s", display = "d")]
    pub closest: Real,
    /// Angular impulse of the last dump, body frame.
    #[output(discrete, unit = "N.m.s")]
    pub impulse: RealVector<3>,
}

/// Torque about the centre of mass by source, body frame.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct TorqueVariables {
    /// Torque from outside this model, body frame.
    #[input(unit = "N.m", display = "uN.m", start = [0.0; 3])]
    pub external: RealVector<3>,
    /// Direct sunlight on sunshade and panels.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-5)]
    pub solar: RealVector<3>,
    /// Sunlight reflected by the planet; 0 unless planetLight.enabled.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-6)]
    pub albedo: RealVector<3>,
    /// Infrared light of the planet; 0 unless planetLight.enabled.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-6)]
    pub infrared: RealVector<3>,
    /// Recoil of the heat the spacecraft radiates; 0 unless thermal.enabled.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-6)]
    pub thermal: RealVector<3>,
    /// Gravity gradient of the planet.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-5)]
    pub gravity_gradient: RealVector<3>,
    /// Sum of all sources, the external one included.
    #[output(unit = "N.m", display = "uN.m", nominal = 1e-5)]
    pub total: RealVector<3>,
}

/// Force by source, body frame unless said otherwise.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct ForceVariables {
    /// Force from outside this model, body frame, through the centre of mass.
    #[input(unit = "N", display = "uN", start = [0.0; 3])]
    pub external: RealVector<3>,
    /// Direct sunlight on sunshade and panels.
    #[output(unit = "N", display = "uN", nominal = 1e-4)]
    pub solar: RealVector<3>,
    /// Sunlight reflected by the planet; 0 unless planetLight.enabled.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub albedo: RealVector<3>,
    /// Infrared light of the planet; 0 unless planetLight.enabled.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub infrared: RealVector<3>,
    /// Recoil of the heat the spacecraft radiates; 0 unless thermal.enabled.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub thermal: RealVector<3>,
    /// Sum of all sources, the external one included.
    #[output(unit = "N", display = "uN", nominal = 1e-4)]
    pub total: RealVector<3>,
    /// The total in EME2000.
    #[output(unit = "N", display = "uN", nominal = 1e-4)]
    pub inertial: RealVector<3>,
}

/// The Sun as seen from the spacecraft.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct SunVariables {
    /// Sun's position from the orbit's centre in EME2000 when ephemeris.source is inputs.
    #[input(unit = "m", display = "AU", start = [0.0; 3])]
    pub position: RealVector<3>,
    /// Unit vector to the Sun, body frame.
    #[output(unit = "1", nominal = 1.0)]
    pub direction: RealVector<3>,
    /// Azimuth of the Sun in the body frame, from -Y toward +X.
    #[output(unit = "rad", display = "deg")]
    pub azimuth: Real,
    /// Elevation of the Sun in the body frame, positive toward -Z.
    #[output(unit = "rad", display = "deg")]
    pub elevation: Real,
    /// Visible part of the Sun's disc: 1 in full light, 0 in the planet's shadow.
    #[output(unit = "1", nominal = 1.0)]
    pub lit_fraction: Real,
    /// Distance from the Sun.
    #[output(unit = "m", display = "AU", nominal = 1e11)]
    pub distance: Real,
}

/// The Earth as seen from the spacecraft.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct EarthVariables {
    /// Earth's position from the orbit's centre in EME2000 when ephemeris.source is inputs.
    #[input(unit = "m", display = "AU", start = [0.0; 3])]
    pub position: RealVector<3>,
    /// Azimuth of the Earth in the body frame, from -Y toward +X.
    #[output(unit = "rad", display = "deg")]
    pub azimuth: Real,
    /// Elevation of the Earth in the body frame, positive toward -Z.
    #[output(unit = "rad", display = "deg")]
    pub elevation: Real,
}

/// Position about the Sun.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct HeliocentricVariables {
    /// Position about the Sun in EME2000.
    #[output(unit = "m", display = "AU", nominal = 1e11)]
    pub position: RealVector<3>,
}

/// How the accumulation is carried out.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct SolverVariables {
    /// Longest internal step; steps end at its multiples, at attitude changes and at dumps.
    #[parameter(unit = "s", min = 1e-3, max = 86_400.0, start = 600.0)]
    pub step: Real,
    /// Largest last Chebyshev term of momentum and delta-v in an internal step, which is halved until it holds.
    #[parameter(unit = "1", min = 1e-15, max = 1.0, start = 1e-10)]
    pub tolerance: Real,
    /// Longest stretch over which planet light, recoil and shadowing are computed at a few nodes and read from a
    /// polynomial in between; stretches end at its multiples and where light or attitude change abruptly.
    #[parameter(unit = "s", min = 1e-3, max = 86_400.0, start = 600.0)]
    pub disturbance_step: Real,
    /// Largest last Chebyshev term of such a stretch relative to the largest force and torque in it; the stretch is
    /// shortened until it holds.
    #[parameter(unit = "1", min = 1e-12, max = 1.0, start = 1e-5)]
    pub disturbance_tolerance: Real,
}

/// One face of a plate or panel, in the file's order: plates, sunshade, panels, the rear after the front. There if the
/// FMU was packed with per-plate outputs.
#[derive(Variables)]
#[variables(setup = PlantSetup)]
pub struct PlateVariables {
    /// Temperature.
    #[output(unit = "K", nominal = 300.0)]
    pub temperature: Real,
    /// Force of sunlight and of whatever else acts of planet light and recoil, body frame.
    #[output(unit = "N", display = "uN", nominal = 1e-5)]
    pub force: RealVector<3>,
}
