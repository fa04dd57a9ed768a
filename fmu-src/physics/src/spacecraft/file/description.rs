//! The shape of a spacecraft file, as people write it: SI units named in the keys, angles in degrees (`_deg`).

use std::collections::BTreeMap;

use serde::Deserialize;

use super::describe_shapes::{
    BoxDescription, DiscDescription, DishDescription, FacetedCylinderDescription, MirrorPlane,
    RepeatDescription,
};
use super::describe_swinging::{FlexibleModeDescription, SloshDescription};
use super::describe_thermal::{SurroundingsDescription, ThermalDescription};
use crate::spacecraft::panel::PanelControl;
use crate::spacecraft::start::StartTable;
use crate::spacecraft::surface::SunshadeModel;
use crate::spacecraft::thruster::ThrusterSet;
use crate::toml::{
    Emissivity, Finite, Fraction, HalfTurn, Kelvin, NotNegative, Positive, QuarterTurn, SpecificImpulse,
    SubtendedAngle,
};

/// A spacecraft: what light falls on, what it weighs, what stores its momentum.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "schema", schemars(title = "heliotorque spacecraft"))]
#[serde(deny_unknown_fields)]
pub(crate) struct Description {
    /// Name of the spacecraft.
    pub name: String,
    /// Whether models that can report temperature and force of every plate; false unless given.
    pub per_plate_outputs: Option<bool>,
    pub mass_properties: MassDescription,
    /// Surface materials by name; plates, cylinder and panels refer to them.
    pub optics: BTreeMap<String, OpticsDescription>,
    /// Flat surfaces fixed in the body frame, other than a sunshade.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub plates: Option<Vec<PlateDescription>>,
    /// Boxes of plates.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub boxes: Option<Vec<BoxDescription>>,
    /// Cylinders of plates.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub cylinders: Option<Vec<FacetedCylinderDescription>>,
    /// Round discs, a plate each.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub discs: Option<Vec<DiscDescription>>,
    /// Paraboloids of plates.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub dishes: Option<Vec<DishDescription>>,
    pub sunshade: Option<SunshadeDescription>,
    /// Panels that turn about one axis.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub panels: Option<Vec<PanelDescription>>,
    /// Reaction wheels.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub wheels: Option<Vec<WheelDescription>>,
    /// Propellant tanks.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub tanks: Option<Vec<TankDescription>>,
    /// Thrusters; they need a tank.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = crate::toml::MOST_THRUSTERS)))]
    pub thrusters: Option<Vec<ThrusterDescription>>,
    /// Flexible modes.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub flexible_modes: Option<Vec<FlexibleModeDescription>>,
    /// Propellant that swings.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub slosh: Option<Vec<SloshDescription>>,
    /// Sun sensors; left out, six along the body axes.
    pub sun_sensors: Option<Vec<SunSensorDescription>>,
    /// Instruments fixed in the body frame, which Guidance points by their number from 1.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub instruments: Option<Vec<InstrumentDescription>>,
    pub momentum: Option<MomentumDescription>,
    pub sun_keep_in: Option<SunKeepInDescription>,
    pub planet_map: Option<PlanetMapDescription>,
    pub thermal: Option<SurroundingsDescription>,
    pub start: Option<StartTable>,
    /// Variables that are local constants of this FMU, with their values; `heliotorque pack --fix` writes them.
    pub fixed: Option<StartTable>,
}

/// The planet's surface cell by cell, for `planetLight.method` map of DisturbanceTorque. Each key has n rows, belts of
/// latitude from south to north, of 2 n cells each, from midnight over morning, noon and evening.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PlanetMapDescription {
    /// Diffusely reflected fraction of sunlight.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = crate::spacecraft::planet_map::MOST_BELTS)))]
    pub diffuse_reflectivity: Vec<Vec<f64>>,
    /// Infrared emissivity.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = crate::spacecraft::planet_map::MOST_BELTS)))]
    pub emissivity: Vec<Vec<f64>>,
    /// Temperature, in K.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = crate::spacecraft::planet_map::MOST_BELTS)))]
    pub temperature_k: Vec<Vec<f64>>,
}

/// Mass properties of the whole spacecraft.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MassDescription {
    /// Mass, in kg.
    pub mass_kg: Positive,
    /// Centre of mass from the body frame's origin, in m.
    pub center_of_mass_m: [f64; 3],
    /// Inertia about the centre of mass, body axes, row by row, in kg m2.
    pub inertia_kg_m2: [[f64; 3]; 3],
}

/// What a surface does with sunlight: absorptivity + specular + diffuse = 1.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct OpticsDescription {
    /// Mirrored fraction.
    pub specular: Fraction,
    /// Fraction scattered by Lambert's law.
    pub diffuse: Fraction,
    /// Absorbed fraction; whatever is not reflected unless given.
    pub absorptivity: Option<Fraction>,
    /// Infrared emissivity; the absorptivity unless given.
    pub emissivity: Option<Emissivity>,
    /// Change of the emissivity with temperature, per K; 0 unless given.
    pub emissivity_per_k: Option<Finite>,
    /// Temperature at which `emissivity` holds, in K; 300 unless given.
    pub emissivity_temperature_k: Option<Kelvin>,
    /// Absorbed fraction of the planet's infrared light; the absorptivity unless given.
    pub infrared_absorptivity: Option<Fraction>,
}

/// A flat surface.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PlateDescription {
    /// Name for messages and pictures; numbered unless given.
    pub name: Option<String>,
    /// Area, in m2; may be left out where a polygon is given.
    pub area_m2: Option<Positive>,
    /// Centre of area, in m; may be left out where a polygon is given.
    pub center_m: Option<[f64; 3]>,
    /// Unit vector out of the front face; lengths off by at most 1e-3 are renormalised. Where a polygon is given it may be
    /// left out: the vertices then run counter-clockwise seen from the front.
    pub normal: Option<[f64; 3]>,
    /// Outline, in m, for self-shadowing: at least 3 vertices in one plane, edges that do not cross. Vertices off the plane by
    /// rounding, up to 1 mm and 0.5 % of the size, are moved onto it. Only surfaces with an outline shadow others and are
    /// shadowed.
    #[cfg_attr(feature = "schema", schemars(length(min = 3)))]
    pub polygon_m: Option<Vec<[f64; 3]>>,
    /// Material of the front face.
    pub optics: String,
    /// Material of the rear face, if light can reach it.
    pub rear_optics: Option<String>,
    pub thermal: Option<ThermalDescription>,
    /// Mirrored copies besides: in the plane x = 0, y = 0 or z = 0 of the frame, one after the other.
    pub mirror: Option<Vec<MirrorPlane>>,
    pub repeat: Option<RepeatDescription>,
}

/// A sunshade in its own frame: given as plates, as section of a cylinder, or both.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SunshadeDescription {
    /// Which description is used.
    pub model: SunshadeModel,
    /// Misalignment: turns of the shade about the body's X, then Y, then Z axis, in deg.
    pub rotation_deg: Option<[f64; 3]>,
    /// Misalignment as matrix, row by row: components in the shade frame to components in the body frame.
    pub dcm_body_from_shade: Option<[[f64; 3]; 3]>,
    /// Plates in the shade frame.
    #[cfg_attr(feature = "schema", schemars(length(min = 1)))]
    pub plates: Option<Vec<PlateDescription>>,
    pub cylinder: Option<CylinderDescription>,
}

/// Part of a cylinder's outside: axis along Z through the origin, symmetric about the XY plane and the -Y direction.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct CylinderDescription {
    /// Radius, in m.
    pub radius_m: Positive,
    /// Total height, in m.
    pub height_m: Positive,
    /// Total angle subtended at the axis, in deg; up to 360.
    pub subtended_angle_deg: SubtendedAngle,
    /// Material of the outside.
    pub optics: String,
}

/// A flat panel that turns about one axis through its centre.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct PanelDescription {
    /// Name for messages and pictures; numbered unless given.
    pub name: Option<String>,
    /// Area of one side, in m2; may be left out where a polygon is given.
    pub area_m2: Option<Positive>,
    /// Centre in the panel frame, in m; may be left out where a polygon is given.
    pub center_m: Option<[f64; 3]>,
    /// Outline at angle 0 in the panel frame, in m, for self-shadowing; perpendicular to `zero_normal`.
    #[cfg_attr(feature = "schema", schemars(length(min = 3)))]
    pub polygon_m: Option<Vec<[f64; 3]>>,
    /// Axis of rotation in the panel frame; +X unless given.
    pub axis: Option<[f64; 3]>,
    /// Normal of the cell side at angle 0 in the panel frame, perpendicular to the axis; -Y unless given.
    pub zero_normal: Option<[f64; 3]>,
    /// Material of the cell side.
    pub optics: String,
    /// Material of the back, if light can reach it.
    pub rear_optics: Option<String>,
    pub thermal: Option<ThermalDescription>,
    /// Its part of the spacecraft's mass, in kg: centre of mass and inertia then follow its angle; `[mass_properties]` are those
    /// with every panel at angle 0.
    pub mass_kg: Option<Positive>,
    /// Centre of that mass at angle 0 in the panel frame, in m; the panel's centre unless given.
    pub mass_center_m: Option<[f64; 3]>,
    /// Inertia about that centre at angle 0, axes of the panel frame, row by row, in kg m2; that of a thin square plate unless
    /// given.
    pub inertia_kg_m2: Option<[[f64; 3]; 3]>,
    /// How the angle comes about; `sun_offset` unless given.
    pub control: Option<PanelControl>,
    /// Angle between cell normal and Sun for `sun_offset`, in deg; 0 unless given.
    pub sun_offset_deg: Option<HalfTurn>,
    /// Which way the panel tilts off the Sun about its axis: 1 or -1; 1 unless given.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = [1, -1])))]
    pub tilt_sign: Option<i64>,
    /// Angle about the axis for `angle`, in deg; 0 unless given.
    pub angle_deg: Option<f64>,
    /// Misalignment: turns of the panel frame about the body's X, then Y, then Z axis, in deg.
    pub rotation_deg: Option<[f64; 3]>,
    /// Misalignment as matrix, row by row: components in the panel frame to components in the body frame.
    pub dcm_body_from_panel: Option<[[f64; 3]; 3]>,
}

/// A reaction wheel.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct WheelDescription {
    /// Name for messages; numbered unless given.
    pub name: Option<String>,
    /// Unit vector of the spin axis, body frame.
    pub axis: [f64; 3],
    /// Greatest momentum of the rotor, in N m s.
    pub capacity_n_m_s: Positive,
    /// Moment of inertia of the rotor about its axis, in kg m2; left out, that which reaches the capacity at 6000 rpm.
    pub inertia_kg_m2: Option<Positive>,
    /// Greatest torque of the motor, in N m; left out, that which reaches the capacity from rest in 100 s.
    pub max_torque_n_m: Option<Positive>,
    /// Coulomb friction, in N m; 0 unless given.
    pub coulomb_friction_n_m: Option<NotNegative>,
    /// Viscous friction, in N m per rad/s; 0 unless given.
    pub viscous_friction_n_m_s: Option<NotNegative>,
    /// Static imbalance of the rotor, in kg m; 0 unless given, and needs position_m.
    pub static_imbalance_kg_m: Option<NotNegative>,
    /// Place of the rotor, body frame, in m.
    pub position_m: Option<[f64; 3]>,
}

/// A propellant tank.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct TankDescription {
    /// Name for thrusters and messages; numbered unless given.
    pub name: Option<String>,
    /// Where its propellant is, taken as a point, body frame, in m.
    pub position_m: [f64; 3],
    /// Propellant loaded, in kg; a part of mass_properties.mass_kg.
    pub propellant_kg: Positive,
    /// Pressure when loaded, in Pa; 2e6 unless given.
    pub pressure_pa: Option<Positive>,
    /// Least and greatest pressure at which thrusters may be fed, in Pa; any unless given.
    pub allowed_pressure_pa: Option<[f64; 2]>,
    /// Volume of the gas that drives the propellant out, in m3: the pressure falls as it expands (blowdown). Left out, the
    /// pressure is regulated.
    pub ullage_m3: Option<Positive>,
    /// Density of the propellant in blowdown, in kg/m3; hydrazine's unless given.
    pub density_kg_m3: Option<Positive>,
}

/// A thruster.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct ThrusterDescription {
    /// Name for messages; numbered unless given.
    pub name: Option<String>,
    /// Where it stands, body frame, in m.
    pub position_m: [f64; 3],
    /// Unit vector of its force on the spacecraft, body frame; the plume goes the other way.
    pub direction: [f64; 3],
    /// Full thrust, in N.
    pub force_n: Positive,
    /// Pressure at which it has that thrust, in Pa; its tank's when loaded unless given. Thrust and flow are proportional to
    /// the pressure.
    pub at_pressure_pa: Option<Positive>,
    /// Specific impulse, in s.
    pub specific_impulse_s: SpecificImpulse,
    /// Name of the tank that feeds it; the first unless given.
    pub tank: Option<String>,
    /// The delta-v that it takes part in: `lva`, `c22` or `mono4`; none unless given. Those of `lva` never control the
    /// attitude.
    pub set: Option<ThrusterSet>,
    /// Shortest time for which its valve opens, in s; 0 unless given.
    pub min_on_time_s: Option<NotNegative>,
    /// Time over which the thrust rises linearly, in s; 0 unless given.
    pub rise_time_s: Option<NotNegative>,
    /// Time over which the full thrust falls linearly to nothing, in s; 0 unless given.
    pub tail_off_time_s: Option<NotNegative>,
    /// Standard deviation of the thrust from pulse to pulse, as a share of it; 0 unless given.
    pub scatter: Option<Fraction>,
    /// Half angle of the plume, in deg: surfaces within it are flagged while it fires; 0, which is none, unless given.
    pub plume_half_angle_deg: Option<QuarterTurn>,
}

/// A Sun sensor.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SunSensorDescription {
    /// Name for messages; numbered unless given.
    pub name: Option<String>,
    /// Unit vector of its axis, body frame.
    pub axis: [f64; 3],
    /// Half the field of view, from the axis, in deg; 60 unless given.
    pub half_field_of_view_deg: Option<HalfTurn>,
}

/// An instrument.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct InstrumentDescription {
    /// Name for messages and the manual.
    pub name: String,
    /// Unit vector of its boresight, body frame.
    pub boresight: [f64; 3],
}

/// Limits of the stored momentum; left out, they are what the wheels guarantee on all body axes at once.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct MomentumDescription {
    /// Magnitude of each body component at which thrusters dump it, in N m s.
    pub dump_threshold_n_m_s: [f64; 3],
}

/// Directions the Sun may have, symmetric about -Y.
#[derive(Debug, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub(crate) struct SunKeepInDescription {
    /// Greatest azimuth in the XY plane from -Y toward +X, in deg.
    pub azimuth_deg: HalfTurn,
    /// Greatest elevation from the XY plane toward -Z, in deg.
    pub elevation_deg: QuarterTurn,
}
