//! The shape of a spacecraft file, as people write it: SI units named in the keys, angles in degrees (`_deg`).

use std::collections::BTreeMap;

use super::describe_body::{BodyDescription, PlanetMapDescription};
use super::describe_devices::{
    AntennaDescription, InstrumentDescription, SunSensorDescription, TankDescription, ThrusterDescription,
    WheelDescription,
};
use super::describe_operation::{
    ArticulationDescription, DownlinksDescription, HotPoleDescription, MomentumDescription,
    PointingDescription, SunKeepInDescription,
};
use super::describe_shapes::{BoxDescription, DiscDescription, DishDescription, FacetedCylinderDescription};
use super::describe_surfaces::{PanelDescription, PlateDescription, SunshadeDescription};
use super::describe_swinging::{FlexibleModeDescription, SloshDescription};
use super::describe_thermal::SurroundingsDescription;
use crate::spacecraft::gas_surface::GasSurface;
use crate::spacecraft::start::StartTable;
use crate::spacecraft::thermal::EMISSIVITY_REFERENCE_TEMPERATURE_K;
use crate::toml::{
    Emissivity, Finite, Fraction, Kelvin, List, MOST_ANTENNAS, MOST_THRUSTERS, NonEmpty, NotNegative, Point,
    Positive, tables,
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
    sets: Option<List<String, 1, MOST_THRUSTERS>>,
    /// Thrusters; they need a tank.
    thrusters: Option<List<ThrusterDescription, 1, MOST_THRUSTERS>>,
    /// Flexible modes.
    flexible_modes: Option<NonEmpty<FlexibleModeDescription>>,
    /// Propellant that swings.
    slosh: Option<NonEmpty<SloshDescription>>,
    /// Sun sensors; left out, six along the body axes.
    sun_sensors: Option<Vec<SunSensorDescription>>,
    /// Instruments, which Guidance points by their number from 1.
    instruments: Option<NonEmpty<InstrumentDescription>>,
    /// Antennas to the Earth, the items of `antenna.select` from 1; without any there are no downlinks.
    antennas: Option<List<AntennaDescription, 1, MOST_ANTENNAS>>,
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
} rules {
    AnyOf plates boxes cylinders discs dishes sunshade panels: "no surface",
        "at least one of `plates`, `boxes`, `cylinders`, `discs`, `dishes`, `sunshade`, `panels`";
}

/// Mass properties of the whole spacecraft.
struct MassDescription {
    /// Mass, in kg.
    mass_kg: Positive,
    /// Centre of mass from the body frame's origin, in m.
    center_of_mass_m: Point,
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
}
