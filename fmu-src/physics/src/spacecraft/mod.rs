//! Parts of the spacecraft: plates, cylinder, panels, optics, mass, wheels; parsed and validated once, here.
//!
//! A spacecraft is described in one TOML file ([`Spacecraft::from_toml`]). In the file lengths, areas, masses and
//! momenta are SI with the unit in the key (`area_m2`); angles are in degrees (`_deg`) because people write them.
//! Everything in memory is SI with angles in radians.
//!
//! Body frame, as in paper 000: -Y is the nominal direction to the Sun, Z the axis of the cylindrical shade, X the
//! axis of the panels; the origin is wherever the file's coordinates start, not the centre of mass.

mod antennas;
mod articulation;
mod assembly;
mod body;
mod copies;
mod description;
mod downlinks;
mod facets;
mod gas_surface;
mod instruments;
mod mass;
mod material;
mod materials;
mod momentum;
mod names;
mod optics;
mod outline;
mod panel;
mod panel_mass;
mod part_reader;
mod planet_map;
mod plate_table;
mod pointing;
mod pointing_table;
mod polygon;
mod shapes;
mod start;
mod sun_sensors;
mod surface;
mod swinging;
mod tank;
mod thermal;
mod thermal_table;
mod thruster;
mod wheels;
mod zones;

#[cfg(test)]
mod tests;

pub use crate::toml::{MOST_ANTENNAS, MOST_THRUSTERS};
pub use antennas::{Antenna, AntennaRange, FanAzimuths, NamedAntenna};
pub use articulation::Articulation;
pub use assembly::Spacecraft;
pub use body::{BodyElements, BodyMotion, BodyOrbit, CustomBody, InertialFrame};
#[cfg(feature = "schema")]
pub use description::schema;
pub use downlinks::{DownlinkWindows, TimeAfterPeriapsis};
pub use gas_surface::GasSurface;
pub use instruments::{GimbalMount, Instrument};
pub(crate) use mass::steiner;
pub use mass::{MassProperties, PanelMass, check_inertia};
pub use material::{Following, Material, MaterialError, MaterialValues, NamedMaterial};
pub use momentum::SlewDemand;
pub use optics::Optics;
pub use panel::{Panel, PanelControl, light_suns, offset_for_suns};
pub use panel_mass::{hinged_masses, with_panels};
pub use planet_map::{PlanetCell, PlanetMap};
pub use pointing::{
    AlignedAxes, AttitudeName, AttitudePart, AttitudeRefusal, NamedAttitude, PointingSettings,
    PointingTarget, StarDirection, TargetItem, TargetedAxis, panels_need_yaw_steering,
};
pub(crate) use pointing_table::{StarDescription, TargetedAxisDescription, aligned, axes};
pub use polygon::Polygon;
pub(crate) use shapes::frame;
pub use start::{StartEntry, StartValue};
pub(crate) use start::{StartTable, start_entries};
pub use sun_sensors::MountedSunSensor;
pub use surface::{Cylinder, FaceProperties, MOST_SURFACES, Plate, Sunshade, SunshadeModel};
pub use swinging::{NamedMode, NamedSlosh};
pub use tank::{Blowdown, Tank};
pub use thermal::{
    BACKGROUND_K, BusLink, Conduction, EMISSIVITY_REFERENCE_TEMPERATURE_K, Emission, FaceThermal, Honeycomb,
    Thermal,
};
pub use thruster::{Thrust, Thruster, ThrusterSet, ValveTiming};
pub use wheels::{Wheel, free_capacity_n_m_s};
pub use zones::{HotPoleZone, SunKeepIn};

/// MESSENGER as paper 000 describes it, for callers without a file.
pub const MESSENGER_TOML: &str = include_str!("../../../resources/messenger.toml");

/// MESSENGER as paper 004 describes it, cell by cell, for callers without a file.
pub const MESSENGER_THERMAL_TOML: &str = include_str!("../../../resources/messenger-thermal.toml");
