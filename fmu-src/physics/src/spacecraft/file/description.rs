//! The shape of a spacecraft file, as people write it: SI units named in the keys, angles in degrees (`_deg`).

use std::collections::BTreeMap;

use super::describe_shapes::{
    BoxDescription, DiscDescription, DishDescription, FacetedCylinderDescription, MirrorPlane,
    RepeatDescription,
};
use super::describe_swinging::{FlexibleModeDescription, SloshDescription};
use super::describe_thermal::{SurroundingsDescription, ThermalDescription};
use super::written_time::WrittenTime;
use crate::spacecraft::body::InertialFrame;
use crate::spacecraft::gas_surface::GasSurface;
use crate::spacecraft::panel::PanelControl;
use crate::spacecraft::pointing::{AttitudeName, TargetItem};
use crate::spacecraft::start::StartTable;
use crate::spacecraft::sun_sensors::HALF_FIELD_OF_VIEW_DEG;
use crate::spacecraft::surface::SunshadeModel;
use crate::spacecraft::tank::HYDRAZINE_KG_M3;
use crate::spacecraft::thermal::EMISSIVITY_REFERENCE_TEMPERATURE_K;
use crate::toml::{
    BodyRadius, Emissivity, FieldOfView, Finite, Fraction, GravitationalParameter, HalfTurn, HalfTurnEither,
    Kelvin, NonEmpty, NotNegative, OrbitAxis, Orbits, Positive, QuarterTurn, SpecificImpulse, SubtendedAngle,
    TurnEither, tables,
};

tables! {
/// A spacecraft: what light falls on, what it weighs, what stores its momentum.
#[cfg_attr(feature = "schema", schemars(title = "heliotorque spacecraft"))]
struct SpacecraftDescription {
    /// Name of the spacecraft.
    name: String,
    /// Whether models that can report temperature and force of every plate.
    per_plate_outputs: bool = false,
    mass_properties: MassDescription,
    /// Surface materials by name; plates, cylinder and panels refer to them.
    optics: BTreeMap<String, OpticsDescription>,
    /// Flat surfaces fixed in the body frame, other than a sunshade.
    plates: Option<NonEmpty<PlateDescription>>,
    /// Boxes of plates.
    boxes: Option<NonEmpty<BoxDescription>>,
    /// Cylinders of plates.
    cylinders: Option<NonEmpty<FacetedCylinderDescription>>,
    /// Round discs, a plate each.
    discs: Option<NonEmpty<DiscDescription>>,
    /// Paraboloids of plates.
    dishes: Option<NonEmpty<DishDescription>>,
    sunshade: Option<SunshadeDescription>,
    /// Panels that turn about one axis.
    panels: Option<NonEmpty<PanelDescription>>,
    /// Reaction wheels.
    wheels: Option<NonEmpty<WheelDescription>>,
    /// Propellant tanks.
    tanks: Option<NonEmpty<TankDescription>>,
    /// Names of the sets of thrusters in the order of their items in `thrust.request` and `burn.thrusters`, where that is not
    /// the order of their first thruster; sets without thrusters may be among them.
    #[cfg_attr(feature = "schema", schemars(length(max = crate::toml::MOST_THRUSTERS)))]
    sets: Option<NonEmpty<String>>,
    /// Thrusters; they need a tank.
    #[cfg_attr(feature = "schema", schemars(length(max = crate::toml::MOST_THRUSTERS)))]
    thrusters: Option<NonEmpty<ThrusterDescription>>,
    /// Flexible modes.
    flexible_modes: Option<NonEmpty<FlexibleModeDescription>>,
    /// Propellant that swings.
    slosh: Option<NonEmpty<SloshDescription>>,
    /// Sun sensors; left out, six along the body axes.
    sun_sensors: Option<Vec<SunSensorDescription>>,
    /// Instruments, which Guidance points by their number from 1.
    instruments: Option<NonEmpty<InstrumentDescription>>,
    /// Antennas to the Earth, the items of `antenna.select` from 1; without any there are no downlinks.
    #[cfg_attr(feature = "schema", schemars(length(max = crate::toml::MOST_ANTENNAS)))]
    antennas: Option<NonEmpty<AntennaDescription>>,
    momentum: Option<MomentumDescription>,
    sun_keep_in: Option<SunKeepInDescription>,
    pointing: Option<PointingDescription>,
    downlinks: Option<DownlinksDescription>,
    articulation: Option<ArticulationDescription>,
    hot_pole: Option<HotPoleDescription>,
    planet_map: Option<PlanetMapDescription>,
    body: Option<BodyDescription>,
    thermal: Option<SurroundingsDescription>,
    start: Option<StartTable>,
    /// Variables that are local constants of this FMU, with their values; `heliotorque pack --fix` writes them.
    fixed: Option<StartTable>,
}

/// A body of one's own, an asteroid, a comet or a moon: with it `custom` is an item of `orbit.center` and the default there, and one
/// of `target.planet` and `aimpoint.body`.
struct BodyDescription {
    /// Its name.
    name: String,
    /// Gravitational parameter, in m3/s2.
    gravitational_parameter_m3_s2: GravitationalParameter,
    /// Radii of its ellipsoid along its own x, y and z, in m; shadow and light take their mean.
    radii_m: [BodyRadius; 3],
    /// Second zonal harmonic of its gravity, unnormalised, for the first radius.
    j2: f64 = 0.0,
    /// Right ascension and declination of its north pole in EME2000, in deg.
    pole_deg: [f64; 2] = [0.0, 90.0],
    /// Angle of its prime meridian from the node of its equator on that of EME2000 at J2000, in deg.
    prime_meridian_deg: TurnEither = 0.0,
    /// Rotation rate about its pole, in rad/s.
    rotation_rate_rad_s: f64 = 0.0,
    /// Diffusely reflected fraction of sunlight; the default is assumed.
    albedo: Fraction = 0.1,
    /// Infrared emissivity; the default is assumed.
    emissivity: Emissivity = 0.9,
    elements: Option<BodyElementsDescription>,
    /// Instead of elements, its position from the Sun at `epoch`, in m.
    position_m: Option<[f64; 3]>,
    /// Its velocity then, in m/s.
    velocity_m_s: Option<[f64; 3]>,
    /// When elements or state hold, a date such as "2030-01-01 TDB".
    epoch: Option<String>,
    /// Axes of elements or state: the ecliptic unless given.
    frame: Option<InertialFrame>,
}

/// Its orbit about the Sun. Without it and without a state, inputs or the file of onboard ephemerides say where the body is.
struct BodyElementsDescription {
    /// Semi-major axis, in m.
    semi_major_axis_m: OrbitAxis,
    /// Eccentricity, at most 0.99.
    eccentricity: f64,
    /// Inclination, in deg.
    inclination_deg: HalfTurn,
    /// Longitude of the ascending node, in deg.
    ascending_node_deg: TurnEither,
    /// Argument of periapsis, in deg.
    periapsis_argument_deg: TurnEither,
    /// True anomaly at `epoch`, in deg.
    true_anomaly_deg: TurnEither,
}

/// The planet's surface cell by cell, for `planetLight.method` map of DisturbanceTorque. Each key has n rows, belts of
/// latitude from south to north, of 2 n cells each, from midnight over morning, noon and evening.
struct PlanetMapDescription {
    /// Diffusely reflected fraction of sunlight.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = crate::spacecraft::planet_map::MOST_BELTS)))]
    diffuse_reflectivity: Vec<Vec<f64>>,
    /// Infrared emissivity.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = crate::spacecraft::planet_map::MOST_BELTS)))]
    emissivity: Vec<Vec<f64>>,
    /// Temperature, in K.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = crate::spacecraft::planet_map::MOST_BELTS)))]
    temperature_k: Vec<Vec<f64>>,
}

/// Mass properties of the whole spacecraft.
struct MassDescription {
    /// Mass, in kg.
    mass_kg: Positive,
    /// Centre of mass from the body frame's origin, in m.
    center_of_mass_m: [f64; 3],
    /// Inertia about the centre of mass, body axes, row by row, in kg m2.
    inertia_kg_m2: [[f64; 3]; 3],
}

/// What a surface does with sunlight (absorptivity + specular + diffuse = 1), heat and air.
struct OpticsDescription {
    /// Mirrored fraction.
    specular: Fraction,
    /// Fraction scattered by Lambert's law.
    diffuse: Fraction,
    /// Absorbed fraction; whatever is not reflected unless given.
    absorptivity: Option<Fraction>,
    /// Infrared emissivity; the absorptivity unless given.
    emissivity: Option<Emissivity>,
    /// Change of the emissivity with temperature, per K.
    emissivity_per_k: Finite = 0.0,
    /// Temperature at which `emissivity` holds, in K.
    emissivity_temperature_k: Kelvin = EMISSIVITY_REFERENCE_TEMPERATURE_K,
    /// Absorbed fraction of the planet's infrared light; the absorptivity unless given.
    infrared_absorptivity: Option<Fraction>,
    /// Drag coefficient for `aerodynamics.law` dragCoefficient, of the area across the flow; the default is assumed.
    drag_coefficient: NotNegative = GasSurface::ASSUMED.drag_coefficient,
    /// Energy accommodation for `aerodynamics.law` sentman; the default is assumed.
    energy_accommodation: Fraction = GasSurface::ASSUMED.energy_accommodation,
    /// Accommodation of normal momentum for `aerodynamics.law` schaafChambre; the default is assumed.
    normal_accommodation: Fraction = GasSurface::ASSUMED.normal_accommodation,
    /// Accommodation of tangential momentum for `aerodynamics.law` schaafChambre; the default is assumed.
    tangential_accommodation: Fraction = GasSurface::ASSUMED.tangential_accommodation,
    /// Temperature in the air where no heat balance gives it, in K; the default is assumed.
    wall_temperature_k: Kelvin = GasSurface::ASSUMED.wall_temperature_k,
}

/// A flat surface.
struct PlateDescription {
    /// Name for messages and pictures; numbered unless given.
    name: Option<String>,
    /// Area, in m2; may be left out where a polygon is given.
    area_m2: Option<Positive>,
    /// Centre of area, in m; may be left out where a polygon is given.
    center_m: Option<[f64; 3]>,
    /// Unit vector out of the front face; lengths off by at most 1e-3 are renormalised. Where a polygon is given it may be
    /// left out: the vertices then run counter-clockwise seen from the front.
    normal: Option<[f64; 3]>,
    /// Outline, in m, for self-shadowing: at least 3 vertices in one plane, edges that do not cross. Vertices off the plane by
    /// rounding, up to 1 mm and 0.5 % of the size, are moved onto it. Only surfaces with an outline shadow others and are
    /// shadowed.
    #[cfg_attr(feature = "schema", schemars(length(min = 3)))]
    polygon_m: Option<Vec<[f64; 3]>>,
    /// Material of the front face.
    optics: String,
    /// Material of the rear face, if light can reach it.
    rear_optics: Option<String>,
    thermal: Option<ThermalDescription>,
    /// Mirrored copies besides: in the plane x = 0, y = 0 or z = 0 of the frame, one after the other.
    mirror: Option<Vec<MirrorPlane>>,
    repeat: Option<RepeatDescription>,
}

/// A sunshade in its own frame: given as plates, as section of a cylinder, or both.
struct SunshadeDescription {
    /// Which description is used.
    model: SunshadeModel,
    /// Misalignment: turns of the shade about the body's X, then Y, then Z axis, in deg.
    rotation_deg: Option<[TurnEither; 3]>,
    /// Misalignment as matrix, row by row: components in the shade frame to components in the body frame.
    dcm_body_from_shade: Option<[[f64; 3]; 3]>,
    /// Plates in the shade frame.
    plates: Option<NonEmpty<PlateDescription>>,
    cylinder: Option<CylinderDescription>,
}

/// Part of a cylinder's outside: axis along Z through the origin, symmetric about the XY plane and the -Y direction.
struct CylinderDescription {
    /// Radius, in m.
    radius_m: Positive,
    /// Total height, in m.
    height_m: Positive,
    /// Total angle subtended at the axis, in deg; up to 360.
    subtended_angle_deg: SubtendedAngle,
    /// Material of the outside.
    optics: String,
}

/// A flat panel that turns about one axis through its centre.
struct PanelDescription {
    /// Name for messages and pictures; numbered unless given.
    name: Option<String>,
    /// Area of one side, in m2; may be left out where a polygon is given.
    area_m2: Option<Positive>,
    /// Centre in the panel frame, in m; may be left out where a polygon is given.
    center_m: Option<[f64; 3]>,
    /// Outline at angle 0 in the panel frame, in m, for self-shadowing; perpendicular to `zero_normal`.
    #[cfg_attr(feature = "schema", schemars(length(min = 3)))]
    polygon_m: Option<Vec<[f64; 3]>>,
    /// Axis of rotation in the panel frame.
    axis: [f64; 3] = [1.0, 0.0, 0.0],
    /// Normal of the cell side at angle 0 in the panel frame, perpendicular to the axis.
    zero_normal: [f64; 3] = [0.0, -1.0, 0.0],
    /// Material of the cell side.
    optics: String,
    /// Material of the back, if light can reach it.
    rear_optics: Option<String>,
    thermal: Option<ThermalDescription>,
    /// Its part of the spacecraft's mass, in kg: centre of mass and inertia then follow its angle; `[mass_properties]` are those
    /// with every panel at angle 0.
    mass_kg: Option<Positive>,
    /// Centre of that mass at angle 0 in the panel frame, in m; the panel's centre unless given.
    mass_center_m: Option<[f64; 3]>,
    /// Inertia about that centre at angle 0, axes of the panel frame, row by row, in kg m2; that of a thin square plate unless
    /// given.
    inertia_kg_m2: Option<[[f64; 3]; 3]>,
    /// How the angle comes about.
    control: PanelControl = PanelControl::SunOffset,
    /// Angle between cell normal and Sun for `sun_offset`, in deg; its sign is a sense of tilt.
    sun_offset_deg: HalfTurnEither = 0.0,
    /// Which way the panel tilts off the Sun about its axis at a positive offset: 1 or -1.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = [1, -1])))]
    tilt_sign: i64 = 1,
    /// Which way a windmill angle turns the panel, about its axis: 1, -1, or 0, not at all. Left out, the sign of the centre's part
    /// along the axis, so that panels of both sides turn against one another.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = [1, -1, 0])))]
    windmill_side: Option<i64>,
    /// Angle about the axis for `angle`, in deg.
    angle_deg: TurnEither = 0.0,
    /// Misalignment: turns of the panel frame about the body's X, then Y, then Z axis, in deg.
    rotation_deg: Option<[TurnEither; 3]>,
    /// Misalignment as matrix, row by row: components in the panel frame to components in the body frame.
    dcm_body_from_panel: Option<[[f64; 3]; 3]>,
}

/// A reaction wheel.
struct WheelDescription {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Unit vector of the spin axis, body frame.
    axis: [f64; 3],
    /// Greatest momentum of the rotor, in N m s.
    capacity_n_m_s: Positive,
    /// Momentum about which the wheel works, along its axis, in N m s; up to its capacity either way.
    bias_momentum_n_m_s: Finite = 0.0,
    /// Moment of inertia of the rotor about its axis, in kg m2; left out, that which reaches the capacity at 6000 rpm.
    inertia_kg_m2: Option<Positive>,
    /// Greatest torque of the motor, in N m; left out, that which reaches the capacity from rest in 100 s.
    max_torque_n_m: Option<Positive>,
    /// Coulomb friction, in N m.
    coulomb_friction_n_m: NotNegative = 0.0,
    /// Viscous friction, in N m per rad/s.
    viscous_friction_n_m_s: NotNegative = 0.0,
    /// Static imbalance of the rotor, in kg m; it needs position_m.
    static_imbalance_kg_m: NotNegative = 0.0,
    /// Place of the rotor, body frame, in m.
    position_m: Option<[f64; 3]>,
}

/// A propellant tank.
struct TankDescription {
    /// Name for thrusters and messages; numbered unless given.
    name: Option<String>,
    /// Where its propellant is, taken as a point, body frame, in m.
    position_m: [f64; 3],
    /// Propellant loaded, in kg; a part of mass_properties.mass_kg.
    propellant_kg: Positive,
    /// Pressure when loaded, in Pa. Only its ratio counts; the default is assumed.
    pressure_pa: Positive = 2e6,
    /// Least and greatest pressure at which thrusters may be fed, in Pa; any unless given.
    allowed_pressure_pa: Option<[f64; 2]>,
    /// Volume of the gas that drives the propellant out, in m3: the pressure falls as it expands (blowdown). Left out, the
    /// pressure is regulated.
    ullage_m3: Option<Positive>,
    /// Density of the propellant in blowdown, in kg/m3; the default is hydrazine's.
    density_kg_m3: Positive = HYDRAZINE_KG_M3,
}

/// A thruster.
struct ThrusterDescription {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Where it stands, body frame, in m.
    position_m: [f64; 3],
    /// Unit vector of its force on the spacecraft, body frame; the plume goes the other way.
    direction: [f64; 3],
    /// Full thrust, in N.
    force_n: Positive,
    /// Pressure at which it has that thrust, in Pa; its tank's when loaded unless given. Thrust and flow are proportional to
    /// the pressure.
    at_pressure_pa: Option<Positive>,
    /// Specific impulse, in s.
    specific_impulse_s: SpecificImpulse,
    /// Name of the tank that feeds it; the first unless given.
    tank: Option<String>,
    /// Name of the set whose delta-v it takes part in: letters and digits, the first a letter; none unless given.
    set: Option<String>,
    /// Whether it may control the attitude and dump momentum; a main engine does not.
    attitude_control: bool = true,
    /// Shortest time for which its valve opens, in s.
    min_on_time_s: NotNegative = 0.0,
    /// Time over which the thrust rises linearly, in s.
    rise_time_s: NotNegative = 0.0,
    /// Time over which the full thrust falls linearly to nothing, in s.
    tail_off_time_s: NotNegative = 0.0,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it.
    scatter: Fraction = 0.0,
    /// Electric power while it fires, in W, for `heliotorque size`.
    power_w: Option<NotNegative>,
    /// Half angle of the plume, in deg: surfaces within it are flagged while it fires; 0 is none.
    plume_half_angle_deg: QuarterTurn = 0.0,
}

/// A Sun sensor.
struct SunSensorDescription {
    /// Name for messages; numbered unless given.
    name: Option<String>,
    /// Unit vector of its axis, body frame.
    axis: [f64; 3],
    /// Half the field of view, from the axis, in deg.
    half_field_of_view_deg: HalfTurn = HALF_FIELD_OF_VIEW_DEG,
}

/// An instrument.
struct InstrumentDescription {
    /// Name for messages and the manual.
    name: String,
    /// Unit vector of its boresight, body frame; on a gimbal at angle 0.
    boresight: [f64; 3],
    gimbal: Option<GimbalDescription>,
}

/// A gimbal that turns an instrument about one axis: at most one instrument has one.
struct GimbalDescription {
    /// Unit vector of its axis, body frame, perpendicular to the boresight; angles count right-handed about it.
    axis: [f64; 3],
    /// Least angle, in deg.
    minimum_deg: HalfTurnEither,
    /// Greatest angle, in deg.
    maximum_deg: HalfTurnEither,
}

/// An antenna: a fan steered in the XY plane (`azimuth_deg`) or fixed along an axis (`axis`).
struct AntennaDescription {
    /// Its item of `antenna.select`: letters and digits, the first a letter.
    name: String,
    /// From and to which azimuth a fan is steered, in deg, from -Y toward +X: up to 180 deg apart, or 360.
    azimuth_deg: Option<[TurnEither; 2]>,
    /// Unit vector along which a fixed antenna looks, body frame: it is turned to the Earth, -Y as near to the Sun as that allows.
    axis: Option<[f64; 3]>,
    /// Full widths of the beam, in deg: across the XY plane and along it (of an axis along Z along X).
    beam_deg: [FieldOfView; 2],
}

/// Limits of the stored momentum, and what wheels are sized for.
struct MomentumDescription {
    /// Magnitude of each body component, from the wheels' bias, at which thrusters dump it, in N m s; left out, what the wheels hold
    /// on all body axes that they span at once, about others 1e9, never.
    dump_threshold_n_m_s: Option<[Positive; 3]>,
    /// Time between unloadings that `heliotorque size` counts with: s, a string with a unit ("2 d"), or a share of the orbital period
    /// ("100 %"); a day unless given.
    unload_every: Option<WrittenTime>,
    /// Slew that `heliotorque size` counts with, about every axis: "90 deg in 10 min"; none unless given.
    slew: Option<String>,
}

/// Directions the Sun may have, symmetric about -Y.
struct SunKeepInDescription {
    /// Greatest azimuth in the XY plane from -Y toward +X, in deg.
    azimuth_deg: HalfTurn,
    /// Greatest elevation from the XY plane toward -Z, in deg.
    elevation_deg: QuarterTurn,
    /// Greatest distance from the Sun at which commands of Guidance keep the zone, in m; any unless given.
    distance_m: Option<Positive>,
}

/// How the spacecraft stands while it observes, by a name, a quaternion, or two axes and their targets: the start values of
/// `guided.scienceRule`, `guided.attitude`, `guided.align`, `guided.constrain` and `guided.slewRate`, which `[start]` does not have
/// beside it. With it `guided.phase` is orbit by default.
struct PointingDescription {
    attitude: Option<AttitudeName>,
    /// Quaternion from EME2000 to the body, scalar last.
    quaternion: Option<[f64; 4]>,
    align: Option<TargetedAxisDescription>,
    constrain: Option<TargetedAxisDescription>,
    star: Option<StarDescription>,
    /// Greatest rate of turns, in deg/s; 0 is at once.
    slew_rate_deg_s: Option<NotNegative>,
}

/// A body axis and its target: that of `align` exactly, that of `constrain` as near as possible.
struct TargetedAxisDescription {
    /// Body frame, of any length.
    axis: [f64; 3],
    /// The target.
    to: TargetItem,
}

/// Direction in EME2000 of `to = "star"`.
struct StarDescription {
    /// Right ascension, in deg.
    right_ascension_deg: TurnEither,
    /// Declination, in deg.
    declination_deg: f64,
}

/// When an antenna looks at the Earth, counted from periapsis; left out, there are no downlinks. The start values of
/// `guided.downlinkStart`, `guided.downlinkEnd`, `guided.downlinkEvery`, which `[start]` does not have beside it.
struct DownlinksDescription {
    /// Begin after periapsis: s, a string with a unit ("2 h"), or a share of the orbital period ("20 %").
    start: WrittenTime,
    /// End, after the begin, likewise.
    stop: WrittenTime,
    /// A downlink after every how many periapses; 0 is none.
    every: Orbits = 0,
}

/// Corridor of the light on the cells of panels, in suns: max(0, cosine of the angle to the Sun) over the square of the distance in
/// AU. The defaults of `articulation.*`.
struct ArticulationDescription {
    /// Least light, for power.
    min_suns: NotNegative = 0.0,
    /// Greatest light, for temperature.
    max_suns: Positive = 1e3,
    /// Light that panels with `control = "distance"` keep.
    target_suns: Positive = 1.0,
}

/// Where the top deck, -Z, does not look at the planet: low above its subsolar point, which is hot. Guidance keeps it; left
/// out, `hotPole.enabled` is false.
struct HotPoleDescription {
    /// Below this height above the ellipsoid, in km.
    altitude_km: NotNegative,
    /// Within this angle from the subsolar point, in deg.
    angle_deg: HalfTurn,
    /// Least angle between -Z and the direction to the planet's centre, in deg.
    cone_deg: HalfTurn,
}
}
