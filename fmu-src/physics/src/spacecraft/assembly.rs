//! The whole spacecraft, and how its file becomes one.

use nalgebra::Vector3;
use serde::Serialize;

use super::antennas::NamedAntenna;
use super::articulation::Articulation;
use super::body::CustomBody;
use super::downlinks::{DownlinkWindows, TimeAfterPeriapsis};
use super::file::antennas::antenna;
use super::file::body::body;
use super::file::description::SpacecraftDescription;
use super::file::devices::{check_gimbals, instrument, sun_sensor, wheel};
use super::file::mass::{mass, parts_fit};
use super::file::materials::Materials;
use super::file::names::check_names;
use super::file::part_reader::PartReader;
use super::file::planet_map::planet_map;
use super::file::plates::{body_plates, panel, sunshade};
use super::file::pointing::pointing;
use super::file::propulsion::{tank, thruster};
use super::file::swinging::{mode, slosh, swinging_fits};
use super::file::thruster_sets::{set_of, thruster_sets};
use super::file::windows::{articulation, downlinks, hot_pole, slew, unload_every};
use super::hot_pole::HotPoleZone;
use super::instruments::Instrument;
use super::mass::MassProperties;
use super::material::NamedMaterial;
use super::panel::Panel;
use super::planet_map::PlanetMap;
use super::pointing::PointingSettings;
use super::slew::SlewDemand;
use super::start::{StartEntry, start_entries};
use super::sun_sensors::MountedSunSensor;
use super::surface::{Plate, Sunshade, SunshadeModel};
use super::swinging::{NamedMode, NamedSlosh};
use super::tank::Tank;
use super::thruster::{Thruster, ThrusterSet};
use super::wheels::Wheel;
use crate::toml::{Checker, Document, FileError, KeyPath};

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
    /// Reads a spacecraft from TOML text; `file_name` only names it in errors.
    ///
    /// # Errors
    ///
    /// Text that is not TOML, or all unknown, missing and ill-typed keys and all values no spacecraft can have, each
    /// with line, key, what was found and what is allowed.
    pub fn from_toml(file_name: &str, text: &str) -> Result<Self, FileError> {
        let document = Document::parse(file_name, text)?;
        let (description, findings) = document.read::<SpacecraftDescription>()?;
        let mut check = Checker::new(&document, findings);
        let spacecraft = Self::read(&mut check, &description);
        check.finish(spacecraft)
    }

    fn read(check: &mut Checker<'_>, description: &SpacecraftDescription) -> Self {
        let root = KeyPath::root();
        if description.name.trim().is_empty() {
            check.report(&root.key("name"), "an empty name", "a name");
        }
        let materials = Materials::read(check, description);
        let surfaces = [
            ("plates", description.plates.is_some()),
            ("boxes", description.boxes.is_some()),
            ("cylinders", description.cylinders.is_some()),
            ("discs", description.discs.is_some()),
            ("dishes", description.dishes.is_some()),
            ("sunshade", description.sunshade.is_some()),
            ("panels", description.panels.is_some()),
        ];
        if !surfaces.iter().any(|(key, is_given)| *is_given || check.is_stand_in(&root.key(key))) {
            let keys = surfaces.map(|(key, _)| format!("`{key}`")).join(", ");
            check.push(&root, "no surface", format_args!("at least one of {keys}"));
        }
        check_names(check, description);
        let file = &mut PartReader { check, materials: &materials, at: root, index: 0 };
        let whole_kg = description.mass_properties.mass_kg.0;
        let panels = description.panels.iter().flat_map(|panels| panels.iter());
        let panels_kg = panels.map(|panel| panel.mass_kg.map(f64::from));
        parts_fit(file.check, ("panels", "mass_kg"), panels_kg, whole_kg);
        let tanks = file.list("tanks", description.tanks.as_deref(), tank);
        let tanks_kg = tanks.iter().map(|tank| Some(tank.propellant_kg));
        parts_fit(file.check, ("tanks", "propellant_kg"), tanks_kg, whole_kg);
        let thruster_sets = thruster_sets(file.check, description);
        let thrusters = file.list("thrusters", description.thrusters.as_deref(), |part, it| {
            thruster(part, it, &tanks, &thruster_sets)
        });
        let mass_properties = mass(&mut file.table("mass_properties"), &description.mass_properties);
        let flexible_modes = file.list("flexible_modes", description.flexible_modes.as_deref(), mode);
        let sloshes = file.list("slosh", description.slosh.as_deref(), slosh);
        swinging_fits(file.check, &flexible_modes, &sloshes, &mass_properties);
        let instruments = file.list("instruments", description.instruments.as_deref(), instrument);
        let has_antenna = description.antennas.is_some() || file.is_stand_in("antennas");
        check_gimbals(file.check, &file.at.key("instruments"), &instruments);
        let momentum = description.momentum.as_ref();
        let start = start_entries(file.check, description.start.as_ref(), description.fixed.as_ref());
        let panels = file.list("panels", description.panels.as_deref(), panel);
        Self {
            name: description.name.clone(),
            mass_properties,
            plates: body_plates(file, description),
            sunshade: description.sunshade.as_ref().map(|it| sunshade(&mut file.table("sunshade"), it)),
            pointing: description
                .pointing
                .as_ref()
                .and_then(|it| pointing(&mut file.table("pointing"), it, &start, &panels)),
            panels,
            wheels: file.list("wheels", description.wheels.as_deref(), wheel),
            flexible_modes,
            sloshes,
            tanks,
            thrusters,
            thruster_sets,
            sun_sensors: match description.sun_sensors.as_deref() {
                Some(sensors) => file.list("sun_sensors", Some(sensors), sun_sensor),
                None => MountedSunSensor::six(),
            },
            instruments,
            antennas: file.list("antennas", description.antennas.as_deref(), antenna),
            dump_threshold_n_m_s: momentum
                .and_then(|it| it.dump_threshold_n_m_s)
                .map(|it| Vector3::from(it.map(f64::from))),
            unload_every: momentum.and_then(|it| unload_every(&mut file.table("momentum"), it)),
            slew: momentum.and_then(|it| slew(&mut file.table("momentum"), it)),
            per_plate_outputs: description.per_plate_outputs(),
            background_k: materials.environment.background_k,
            planet_map: description
                .planet_map
                .as_ref()
                .and_then(|map| planet_map(&mut file.table("planet_map"), map)),
            body: description.body.as_ref().map(|own| body(&mut file.table("body"), own)),
            downlinks: description
                .downlinks
                .as_ref()
                .map(|it| downlinks(&mut file.table("downlinks"), it, &start, has_antenna)),
            articulation: description
                .articulation
                .as_ref()
                .map_or(Articulation::default(), |it| articulation(&mut file.table("articulation"), it)),
            hot_pole: description.hot_pole.as_ref().map(hot_pole),
            start,
            sun_keep_in: description.sun_keep_in.as_ref().map(|limits| SunKeepIn {
                azimuth_rad: limits.azimuth_deg.0.to_radians(),
                elevation_rad: limits.elevation_deg.0.to_radians(),
                distance_m: limits.distance_m.map_or(SunKeepIn::FARTHEST_M, |distance| distance.0),
            }),
            // After the surfaces, which say what is in use.
            materials: materials.in_use(),
        }
    }

    /// The thrusters of a set.
    pub fn thrusters_of(&self, set: ThrusterSet) -> impl Iterator<Item = &Thruster> + Clone {
        self.thrusters.iter().filter(move |thruster| thruster.set == Some(set))
    }

    /// The set of this name.
    pub fn thruster_set(&self, name: &str) -> Option<ThrusterSet> {
        set_of(&self.thruster_sets, Some(name))
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
