//! What the spacecraft is made of: plates, cylinder, panels, optics, mass, wheels; parsed and validated once, here.
//!
//! A spacecraft is described in one TOML file ([`Spacecraft::from_toml`]). In the file lengths, areas, masses and
//! momenta are SI with the unit in the key (`area_m2`); angles are in degrees (`_deg`) because people write them.
//! Everything in memory is SI with angles in radians.
//!
//! Body frame, as in paper 000: -Y is the nominal direction to the Sun, Z the axis of the cylindrical shade, X the
//! axis of the panels; the origin is wherever the file's coordinates start, not the centre of mass.

mod build;
mod build_propulsion;
mod build_shapes;
mod build_swinging;
mod build_thermal;
mod checker;
mod copies;
mod describe_shapes;
mod describe_swinging;
mod describe_thermal;
mod description;
mod document;
mod error;
mod facets;
mod instruments;
mod limits;
mod mass;
mod optics;
mod panel;
mod panel_mass;
mod place;
mod planet_map;
mod polygon;
mod reader;
#[cfg(feature = "schema")]
mod schema;
mod spelling;
mod start;
mod sun_sensors;
mod surface;
mod swinging;
mod tank;
mod thermal;
mod thruster;
mod wheels;

#[cfg(test)]
mod tests;

pub use build::{Spacecraft, SunKeepIn};
pub use checker::Checker;
pub use document::Document;
pub use error::{Problem, SpacecraftError};
pub use instruments::Instrument;
pub use limits::{LIMITS, MOST_ITEMS, MOST_PROBLEMS, MOST_SURFACES, MOST_TEXT_BYTES};
pub(crate) use mass::steiner;
pub use mass::{MassProperties, PanelMass, check_inertia};
pub use optics::Optics;
pub use panel::{Panel, PanelControl};
pub use panel_mass::{hinged_masses, with_panels};
pub use place::Place;
pub use planet_map::{PlanetCell, PlanetMap, PlanetMapError};
pub use polygon::{Polygon, PolygonError};
pub use reader::Findings;
#[cfg(feature = "schema")]
pub use schema::schema;
pub use spelling::nearest;
pub use start::{StartEntry, StartValue};
pub(crate) use start::{StartTable, start_entries};
pub use sun_sensors::MountedSunSensor;
pub use surface::{Cylinder, Plate, Sunshade, SunshadeModel};
pub use swinging::{NamedMode, NamedSlosh};
pub use tank::{Blowdown, Tank};
pub use thermal::{
    BACKGROUND_K, BusLink, Conduction, EMISSIVITY_REFERENCE_TEMPERATURE_K, Emission, FaceThermal, Honeycomb,
    Thermal,
};
pub use thruster::{MOST_THRUSTERS, Thrust, Thruster, ThrusterSet, ValveTiming};
pub use wheels::{PAPER_DUMP_THRESHOLDS_N_M_S, Wheel};

/// MESSENGER as paper 000 describes it, for callers without a file.
pub const MESSENGER_TOML: &str = include_str!("../../../resources/messenger.toml");

/// MESSENGER as paper 004 describes it, cell by cell, for callers without a file.
pub const MESSENGER_THERMAL_TOML: &str = include_str!("../../../resources/messenger-thermal.toml");
