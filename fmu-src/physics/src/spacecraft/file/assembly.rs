//! The spacecraft, and its reading from a file: every part is read, then checked against the others.

use nalgebra::Vector3;

use super::antennas::antenna;
use super::body::body;
use super::describe_operation::SunKeepInDescription;
use super::description::SpacecraftDescription;
use super::devices::{check_gimbals, instrument, sun_sensor, wheel};
use super::mass::{mass, parts_fit};
use super::materials::Materials;
use super::names::check_names;
use super::part_reader::PartReader;
use super::planet_map::planet_map;
use super::plates::{body_plates, panel, sunshade};
use super::pointing::pointing;
use super::propulsion::{tank, thruster};
use super::swinging::{mode, slosh, swinging_fits};
use super::thruster_sets::thruster_sets;
use super::windows::{articulation, downlinks, hot_pole, slew, unload_every};
use crate::spacecraft::sun_sensors::MountedSunSensor;
use crate::toml::{Checker, Document, FileError, KeyPath, Table, Written};

use crate::spacecraft::antennas::NamedAntenna;
use crate::spacecraft::articulation::Articulation;
use crate::spacecraft::body::CustomBody;
use crate::spacecraft::downlinks::{DownlinkWindows, TimeAfterPeriapsis};
use crate::spacecraft::hot_pole::HotPoleZone;
use crate::spacecraft::instruments::Instrument;
use crate::spacecraft::mass::MassProperties;
use crate::spacecraft::material::NamedMaterial;
use crate::spacecraft::panel::Panel;
use crate::spacecraft::planet_map::PlanetMap;
use crate::spacecraft::pointing::PointingSettings;
use crate::spacecraft::slew::SlewDemand;
use crate::spacecraft::start::{StartEntry, start_entries};
use crate::spacecraft::surface::{Plate, Sunshade, SunshadeModel};
use crate::spacecraft::swinging::{NamedMode, NamedSlosh};
use crate::spacecraft::tank::Tank;
use crate::spacecraft::thruster::{Thruster, ThrusterSet};
use crate::spacecraft::wheels::Wheel;
use serde::Serialize;

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
        let spacecraft = spacecraft(&mut check, &description);
        check.finish(spacecraft)
    }
}

fn spacecraft(check: &mut Checker<'_>, given: &SpacecraftDescription) -> Spacecraft {
    let root = KeyPath::root();
    if given.name.trim().is_empty() {
        check.report(&root.key("name"), "an empty name", "a name");
    }
    let materials = Materials::read(check, given);
    check.rules(&root, SpacecraftDescription::RULES);
    check_names(check, given);
    check_masses(check, given);
    let file = &mut PartReader { check, materials: &materials, at: root, index: 0 };
    let tanks = file.list("tanks", given.tanks.as_deref(), tank);
    let thruster_sets = thruster_sets(file.check, given);
    let thrusters = file
        .list("thrusters", given.thrusters.as_deref(), |part, it| thruster(part, it, &tanks, &thruster_sets));
    let mass_properties = mass(&mut file.table("mass_properties"), &given.mass_properties);
    let flexible_modes = file.list("flexible_modes", given.flexible_modes.as_deref(), mode);
    let sloshes = file.list("slosh", given.slosh.as_deref(), slosh);
    swinging_fits(file.check, &flexible_modes, &sloshes, &mass_properties);
    let instruments = file.list("instruments", given.instruments.as_deref(), instrument);
    check_gimbals(file.check, &file.at.key("instruments"), &instruments);
    let has_antenna = given.antennas.is_some() || file.is_stand_in("antennas");
    let start = start_entries(file.check, given.start.as_ref(), given.fixed.as_ref());
    let panels = file.list("panels", given.panels.as_deref(), panel);
    let momentum = given.momentum.as_ref();
    let dump_threshold_n_m_s = momentum.and_then(|it| it.dump_threshold_n_m_s);
    Spacecraft {
        name: given.name.clone(),
        mass_properties,
        plates: body_plates(file, given),
        sunshade: file.optional("sunshade", given.sunshade.as_ref(), sunshade),
        pointing: file
            .optional("pointing", given.pointing.as_ref(), |part, it| pointing(part, it, &start, &panels))
            .flatten(),
        panels,
        wheels: file.list("wheels", given.wheels.as_deref(), wheel),
        flexible_modes,
        sloshes,
        tanks,
        thrusters,
        thruster_sets,
        sun_sensors: match given.sun_sensors.as_deref() {
            Some(sensors) => file.list("sun_sensors", Some(sensors), sun_sensor),
            None => MountedSunSensor::six(),
        },
        instruments,
        antennas: file.list("antennas", given.antennas.as_deref(), antenna),
        dump_threshold_n_m_s: dump_threshold_n_m_s.map(|it| Vector3::from(it.value())),
        unload_every: file.optional("momentum", momentum, unload_every).flatten(),
        slew: file.optional("momentum", momentum, slew).flatten(),
        per_plate_outputs: given.per_plate_outputs(),
        background_k: materials.environment.background_k,
        planet_map: file.optional("planet_map", given.planet_map.as_ref(), planet_map).flatten(),
        body: file.optional("body", given.body.as_ref(), body),
        downlinks: file.optional("downlinks", given.downlinks.as_ref(), |part, it| {
            downlinks(part, it, &start, has_antenna)
        }),
        articulation: file
            .optional("articulation", given.articulation.as_ref(), articulation)
            .unwrap_or_default(),
        hot_pole: given.hot_pole.as_ref().map(hot_pole),
        start,
        sun_keep_in: given.sun_keep_in.as_ref().map(sun_keep_in),
        // After the surfaces, which say what is in use.
        materials: materials.in_use(),
    }
}

/// Panels and tanks are a part of the spacecraft's mass.
fn check_masses(check: &mut Checker<'_>, given: &SpacecraftDescription) {
    let whole_kg = given.mass_properties.mass_kg.0;
    let panels = given.panels.iter().flat_map(|panels| panels.iter());
    parts_fit(check, ("panels", "mass_kg"), panels.map(|panel| panel.mass_kg.value()), whole_kg);
    let tanks = given.tanks.iter().flat_map(|tanks| tanks.iter());
    parts_fit(check, ("tanks", "propellant_kg"), tanks.map(|tank| Some(tank.propellant_kg.0)), whole_kg);
}

fn sun_keep_in(limits: &SunKeepInDescription) -> SunKeepIn {
    SunKeepIn {
        azimuth_rad: limits.azimuth_rad(),
        elevation_rad: limits.elevation_rad(),
        distance_m: limits.distance_m.value().unwrap_or(SunKeepIn::FARTHEST_M),
    }
}
