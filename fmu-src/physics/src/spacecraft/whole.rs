//! The whole spacecraft.

use nalgebra::Vector3;
use serde::Serialize;

use super::antennas::NamedAntenna;
use super::articulation::Articulation;
use super::body::CustomBody;
use super::downlinks::{DownlinkWindows, TimeAfterPeriapsis};
use super::hot_pole::HotPoleZone;
use super::instruments::Instrument;
use super::mass::MassProperties;
use super::material::NamedMaterial;
use super::panel::Panel;
use super::planet_map::PlanetMap;
use super::pointing::PointingSettings;
use super::slew::SlewDemand;
use super::start::StartEntry;
use super::sun_sensors::MountedSunSensor;
use super::surface::{Plate, Sunshade, SunshadeModel};
use super::swinging::{NamedMode, NamedSlosh};
use super::tank::Tank;
use super::thruster::{Thruster, ThrusterSet};
use super::wheels::Wheel;

/// A validated spacecraft.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Spacecraft {
    /// Name of the spacecraft.
    pub name: String,
    /// Mass, centre of mass, inertia.
    pub mass_properties: MassProperties,
    /// Materials of its surfaces.
    pub materials: Vec<NamedMaterial>,
    /// Plates fixed in the body frame, other than the sunshade's.
    pub plates: Vec<Plate>,
    /// The sunshade, if it has one.
    pub sunshade: Option<Sunshade>,
    /// Panels that turn.
    pub panels: Vec<Panel>,
    /// Reaction wheels.
    pub wheels: Vec<Wheel>,
    /// Flexible modes.
    pub flexible_modes: Vec<NamedMode>,
    /// Propellant that swings.
    pub sloshes: Vec<NamedSlosh>,
    /// Propellant tanks.
    pub tanks: Vec<Tank>,
    /// Thrusters.
    pub thrusters: Vec<Thruster>,
    /// Names of the sets of thrusters, by their row; those of the models that have them enter the GUID with their items.
    #[serde(skip)]
    pub thruster_sets: Vec<String>,
    /// Sun sensors.
    pub sun_sensors: Vec<MountedSunSensor>,
    /// Instruments that are pointed.
    pub instruments: Vec<Instrument>,
    /// Antennas to the Earth.
    pub antennas: Vec<NamedAntenna>,
    /// Magnitude of each body component of the momentum at which thrusters dump it, in N m s.
    pub dump_threshold_n_m_s: Option<Vector3<f64>>,
    /// Time between unloadings that wheels are sized for.
    #[serde(skip)]
    pub unload_every: Option<TimeAfterPeriapsis>,
    /// Slew that they are sized for.
    #[serde(skip)]
    pub slew: Option<SlewDemand>,
    /// Directions the Sun may have.
    pub sun_keep_in: Option<SunKeepIn>,
    /// How it stands while it observes; `None`: as the models' defaults say. Models have it as start values.
    #[serde(skip)]
    pub pointing: Option<PointingSettings>,
    /// When it talks to the Earth; `None`: never by its file.
    pub downlinks: Option<DownlinkWindows>,
    /// Corridor of light on the cells.
    pub articulation: Articulation,
    /// Zone in which -Z keeps away from the planet.
    pub hot_pole: Option<HotPoleZone>,
    /// Whether models report temperature and force of every face.
    pub per_plate_outputs: bool,
    /// Temperature of the space that surfaces see, in K.
    pub background_k: f64,
    /// The planet it orbits, cell by cell.
    pub planet_map: Option<PlanetMap>,
    /// A body of the user's own.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub body: Option<CustomBody>,
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
    /// Greatest distance from the Sun at which it counts, in m.
    pub distance_m: f64,
}

impl SunKeepIn {
    /// A distance from the Sun that no spacecraft has, in m.
    pub const FARTHEST_M: f64 = 1e13;

    /// The smaller of all limits.
    #[must_use]
    pub fn within(&self, other: &Self) -> Self {
        Self {
            azimuth_rad: self.azimuth_rad.min(other.azimuth_rad),
            elevation_rad: self.elevation_rad.min(other.elevation_rad),
            distance_m: self.distance_m.min(other.distance_m),
        }
    }
}

impl Spacecraft {
    /// The thrusters of a set.
    pub fn thrusters_of(&self, set: ThrusterSet) -> impl Iterator<Item = &Thruster> + Clone {
        self.thrusters.iter().filter(move |thruster| thruster.set == Some(set))
    }

    /// The set of this name.
    pub fn thruster_set(&self, name: &str) -> Option<ThrusterSet> {
        ThrusterSet::named(&self.thruster_sets, name)
    }

    /// How many modal coordinates swing on it: one of each flexible mode, two of each pendulum.
    pub fn oscillator_count(&self) -> usize {
        self.flexible_modes.len() + 2 * self.sloshes.len()
    }

    /// The plates of body and sunshade in the body frame, the body's first; a cylindrical shade adds none.
    pub fn plates_body(&self, sunshade_model: SunshadeModel) -> Vec<Plate> {
        let shade = self.sunshade.iter().filter(|_| sunshade_model == SunshadeModel::Plates);
        let shade_plates =
            shade.flat_map(|shade| shade.plates.iter().map(|p| p.rotated(&shade.dcm_body_from_shade)));
        self.plates.iter().cloned().chain(shade_plates).collect()
    }

    /// How many surfaces have an outline, and the names of those that have none.
    pub fn outlines(&self, sunshade_model: SunshadeModel) -> (usize, Vec<String>) {
        let plates = self.plates_body(sunshade_model);
        let plates = plates.iter().map(|plate| (&plate.name, plate.polygon.is_some()));
        let panels = self.panels.iter().map(|panel| (&panel.name, panel.polygon.is_some()));
        let (given, missing): (Vec<_>, Vec<_>) = plates.chain(panels).partition(|(_, has)| *has);
        let mut missing: Vec<String> = missing.into_iter().map(|(name, _)| name.clone()).collect();
        let shade = self.sunshade.as_ref().filter(|_| sunshade_model == SunshadeModel::Cylinder);
        missing.extend(shade.map(|_| "sunshade.cylinder".to_owned()));
        (given.len(), missing)
    }
}
