//! From a file to the spacecraft: every part is read, then checked against the others.

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
use crate::spacecraft::start::start_entries;
use crate::spacecraft::sun_sensors::MountedSunSensor;
use crate::spacecraft::whole::{Spacecraft, SunKeepIn};
use crate::toml::{Checker, Document, FileError, KeyPath, Table, Written};

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
