//! What the spacecraft is made of: plates, cylinder, panels, optics, mass, wheels; parsed and validated once, here.
//!
//! A spacecraft is described in one TOML file ([`Spacecraft::from_toml`]). In the file lengths, areas, masses and
//! momenta are SI with the unit in the key (`area_m2`); angles are in degrees (`_deg`) because people write them.
//! Everything in memory is SI with angles in radians.
//!
//! Body frame, as in paper 000: -Y is the nominal direction to the Sun, Z the axis of the cylindrical shade, X the
//! axis of the panels; the origin is wherever the file's coordinates start, not the centre of mass.

mod build;
mod build_thermal;
mod checker;
mod description;
mod document;
mod error;
mod mass;
mod panel;
mod planet_map;
mod polygon;
mod reader;
#[cfg(feature = "schema")]
mod schema;
mod start;
mod surface;
mod thermal;
mod wheels;

#[cfg(test)]
mod tests;

use nalgebra::Vector3;
use serde::Serialize;

pub(crate) use checker::Checker;
pub(crate) use document::{Document, Place, nearest};
pub use error::{Problem, SpacecraftError};
pub use mass::{MassProperties, check_inertia};
pub use panel::{Panel, PanelControl};
pub use planet_map::{PlanetCell, PlanetMap, PlanetMapError};
pub use polygon::{Polygon, PolygonError};
#[cfg(feature = "schema")]
pub use schema::schema;
pub use start::{StartEntry, StartValue};
pub(crate) use start::{StartTable, start_entries};
pub use surface::{Cylinder, Optics, Plate, Sunshade, SunshadeModel};
pub use thermal::{
    Conduction, EMISSIVITY_REFERENCE_TEMPERATURE_K, Emission, FaceThermal, Honeycomb, Thermal,
};
pub use wheels::{PAPER_DUMP_THRESHOLDS_N_M_S, Wheel};

/// MESSENGER as paper 000 describes it, for callers without a file.
pub const MESSENGER_TOML: &str = include_str!("../../../resources/messenger.toml");

/// MESSENGER as paper 004 describes it, cell by cell, for callers without a file.
pub const MESSENGER_THERMAL_TOML: &str = include_str!("../../../resources/messenger-thermal.toml");

/// A validated spacecraft.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spacecraft {
    /// Name of the spacecraft.
    pub name: String,
    /// Mass, centre of mass, inertia.
    pub mass_properties: MassProperties,
    /// Plates fixed in the body frame, other than the sunshade's.
    pub plates: Vec<Plate>,
    /// The sunshade, if it has one.
    pub sunshade: Option<Sunshade>,
    /// Panels that turn.
    pub panels: Vec<Panel>,
    /// Reaction wheels.
    pub wheels: Vec<Wheel>,
    /// Magnitude of each body component of the momentum at which thrusters dump it, in N m s.
    pub dump_threshold_n_m_s: Option<Vector3<f64>>,
    /// Directions the Sun may have.
    pub sun_keep_in: Option<SunKeepIn>,
    /// Whether models report temperature and force of every face.
    pub per_plate_outputs: bool,
    /// The planet it flies about, cell by cell.
    pub planet_map: Option<PlanetMap>,
    /// Start values of the models' variables, handed on as they were written.
    #[serde(skip)]
    pub start: Vec<StartEntry>,
}

/// The Sun keep-in zone: azimuth from -Y toward +X in the XY plane, elevation from that plane toward -Z.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SunKeepIn {
    /// Greatest magnitude of the azimuth, in rad.
    pub azimuth_rad: f64,
    /// Greatest magnitude of the elevation, in rad.
    pub elevation_rad: f64,
}

impl Spacecraft {
    /// Reads a spacecraft from TOML text; `file_name` only names it in errors.
    ///
    /// # Errors
    ///
    /// Text that is not TOML, or all unknown, missing and ill-typed keys and all values no spacecraft can have, each
    /// with line, key, what was found and what is allowed.
    pub fn from_toml(file_name: &str, text: &str) -> Result<Self, SpacecraftError> {
        build::spacecraft(file_name, text)
    }

    /// The plates of body and sunshade in the body frame, the body's first; a cylindrical shade adds none.
    pub fn plates_body(&self, sunshade_model: SunshadeModel) -> Vec<Plate> {
        let shade = self.sunshade.iter().filter(|_| sunshade_model == SunshadeModel::Plates);
        let shade_plates =
            shade.flat_map(|shade| shade.plates.iter().map(|p| p.rotated(&shade.dcm_body_from_shade)));
        self.plates.iter().cloned().chain(shade_plates).collect()
    }
}
