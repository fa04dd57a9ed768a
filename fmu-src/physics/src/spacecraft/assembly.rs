//! The spacecraft, and its reading from a file: every part is read, then checked against the others.

use nalgebra::Vector3;
use serde::Serialize;

use super::antennas::{NamedAntenna, antenna};
use super::articulation::{Articulation, articulation};
use super::body::{CustomBody, body};
use super::description::SpacecraftDescription;
use super::downlinks::{DownlinkWindows, TimeAfterPeriapsis, downlinks};
use super::instruments::{Instrument, check_gimbals, instrument};
use super::mass::{MassProperties, mass};
use super::material::NamedMaterial;
use super::materials::Materials;
use super::momentum::{SlewDemand, slew, unload_every};
use super::panel::{Panel, panel};
use super::part_reader::{Names, PartReader};
use super::planet_map::{PlanetMap, planet_map};
use super::plate_table::{plates, sunshade};
use super::pointing::PointingSettings;
use super::pointing_table::pointing;
use super::shapes::{box_plates, cylinder_plates, disc_plates, dish_plates, distinct_plates};
use super::start::{StartEntry, start_entries};
use super::sun_sensors::MountedSunSensor;
use super::surface::{MOST_SURFACES, Plate, Sunshade, SunshadeModel};
use super::swinging::{NamedMode, NamedSlosh, mode, slosh, swinging_fits};
use super::tank::{Tank, tank};
use super::thruster::{Thruster, ThrusterSet, thruster, thruster_sets};
use super::wheels::{Wheel, wheel};
use super::zones::{HotPoleZone, SunKeepIn};
use crate::toml::{Checker, Document, FileError, Named, Place, Table, Written};

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
        let (description, check) = Checker::read(&document)?;
        let spacecraft = spacecraft(Place::root(&check), &description);
        check.finish(spacecraft)
    }
}

fn spacecraft(root: Place<'_>, given: &SpacecraftDescription) -> Spacecraft {
    if given.name.trim().is_empty() {
        root.key("name").report("an empty name", "a name");
    }
    let materials = Materials::read(&root, &given.optics, given.thermal.as_ref());
    root.rules(SpacecraftDescription::RULES);
    check_masses(&root, given);
    let names = Names::default();
    let file = &PartReader { at: root, materials: &materials, names: &names, index: 0 };
    let tanks = file.list("tanks", given.tanks.as_deref(), tank);
    let thruster_sets = thruster_sets(file, given.sets.as_deref(), given.thrusters.as_deref());
    let thrusters = file
        .list("thrusters", given.thrusters.as_deref(), |part, it| thruster(part, it, &tanks, &thruster_sets));
    let mass_properties = mass(&file.table("mass_properties"), &given.mass_properties);
    let flexible_modes = file.list("flexible_modes", given.flexible_modes.as_deref(), mode);
    let sloshes = file.list("slosh", given.slosh.as_deref(), slosh);
    swinging_fits(file, &flexible_modes, &sloshes, &mass_properties);
    let instruments = file.list("instruments", given.instruments.as_deref(), instrument);
    check_gimbals(&file.key("instruments"), &instruments);
    let has_antenna = given.antennas.is_some() || file.key("antennas").is_stand_in();
    let start = start_entries(file, given.start.as_ref(), given.fixed.as_ref());
    let panels = file.list("panels", given.panels.as_deref(), panel);
    let corridor = file.optional("articulation", given.articulation.as_ref(), articulation);
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
            Some(sensors) => file.list("sun_sensors", Some(sensors), |part, it| it.made(part.index)),
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
        articulation: corridor.unwrap_or_default(),
        hot_pole: given.hot_pole.value(),
        start,
        sun_keep_in: given.sun_keep_in.value(),
        // After the surfaces, which say what is in use.
        materials: materials.in_use(),
    }
}

/// Panels and tanks are a part of the spacecraft's mass.
fn check_masses(root: &Place<'_>, given: &SpacecraftDescription) {
    let whole_kg = given.mass_properties.mass_kg.0;
    let panels = given.panels.iter().flat_map(|panels| panels.iter());
    let panels = panels.map(|panel| panel.mass_kg.value()).collect();
    let tanks = given.tanks.iter().flat_map(|tanks| tanks.iter());
    let tanks = tanks.map(|tank| Some(tank.propellant_kg.0)).collect();
    let kinds: [(_, _, Vec<_>); 2] = [("panels", "mass_kg", panels), ("tanks", "propellant_kg", tanks)];
    for (kind, key, masses_kg) in kinds {
        let mut sum_kg = 0.0;
        for (at, mass_kg) in root.key(kind).items(&masses_kg) {
            sum_kg += mass_kg.unwrap_or(0.0);
            if let Some(mass_kg) = mass_kg.filter(|_| sum_kg >= whole_kg) {
                let found = format!("{mass_kg}, with the {kind} before it {sum_kg}");
                let allowed =
                    format!("less than mass_properties.mass_kg = {whole_kg}, of which it is a part");
                at.key(key).report(found, allowed);
                break;
            }
        }
    }
}

/// The plates that the file lists, then those of its shapes; none beyond the most that a spacecraft may have.
fn body_plates(file: &PartReader<'_>, description: &SpacecraftDescription) -> Vec<Plate> {
    let mut found = Vec::new();
    let SpacecraftDescription { plates: listed, boxes, cylinders, discs, dishes, .. } = description;
    shaped(file, &mut found, ("plates", listed.as_deref()), plates);
    shaped(file, &mut found, ("boxes", boxes.as_deref()), box_plates);
    shaped(file, &mut found, ("cylinders", cylinders.as_deref()), cylinder_plates);
    shaped(file, &mut found, ("discs", discs.as_deref()), disc_plates);
    shaped(file, &mut found, ("dishes", dishes.as_deref()), dish_plates);
    if surfaces(&found) > MOST_SURFACES {
        let found = "more surfaces, copies and facets of shapes among them";
        file.push(found, format_args!("at most {MOST_SURFACES}"));
    }
    distinct_plates(&found);
    found.into_iter().flat_map(|(_, plates)| plates).collect()
}

/// Place and plates of every item.
type Found<'p> = Vec<(Place<'p>, Vec<Plate>)>;

fn surfaces(found: &Found<'_>) -> usize {
    found.iter().map(|(_, plates)| plates.len()).sum()
}

/// Adds the plates of every item under a key.
fn shaped<'p, D: Table + Named>(
    file: &PartReader<'p>,
    found: &mut Found<'p>,
    (key, items): (&str, Option<&[D]>),
    plates: impl Fn(&PartReader<'_>, &D) -> Vec<Plate>,
) {
    file.list(key, items, |part, item| {
        if surfaces(found) <= MOST_SURFACES {
            found.push((part.at.clone(), plates(part, item)));
        }
    });
}
