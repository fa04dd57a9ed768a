//! The spacecraft, from its file: checks every value, resolves materials, turns parts into their frames.

use std::collections::BTreeMap;

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use super::build_propulsion::{tank, tanks_fit, thruster};
use super::build_shapes::{box_plates, cylinder_plates, disc_plates, dish_plates, distinct_plates};
use super::build_swinging::{mode, slosh, swinging_fits};
use super::build_thermal::{
    Material, Materials, Surroundings, checked_area, checked_center, checked_normal, checked_outline,
    face_thermal, thermal,
};
use super::checker::{Checker, rounded};
use super::copies::{check_apart, motions, plate_copies};
use super::description::{
    CylinderDescription, Description, InstrumentDescription, MassDescription, OpticsDescription,
    PanelDescription, PlanetMapDescription, PlateDescription, SunSensorDescription, SunshadeDescription,
    WheelDescription,
};
use super::document::Document;
use super::error::SpacecraftError;
use super::instruments::Instrument;
use super::limits::MOST_SURFACES;
use super::mass::{MassProperties, PanelMass, check_inertia};
use super::optics::Optics;
use super::panel::{Panel, PanelControl};
use super::place::Place;
use super::planet_map::{HOTTEST_K, MOST_BELTS, PlanetCell, PlanetMap};
use super::start::{StartEntry, start_entries};
use super::sun_sensors::{HALF_FIELD_OF_VIEW_DEG, MountedSunSensor};
use super::surface::{Cylinder, Plate, Sunshade, SunshadeModel};
use super::swinging::{NamedMode, NamedSlosh};
use super::tank::Tank;
use super::thruster::Thruster;
use super::wheels::{SPEED_AT_CAPACITY_RAD_S, TIME_TO_CAPACITY_S, Wheel};

/// How far absorptivity + specular + diffuse may be off 1.
const OPTICS_SUM_TOLERANCE: f64 = 1e-9;

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
    /// Flexible modes.
    pub flexible_modes: Vec<NamedMode>,
    /// Propellant that swings.
    pub sloshes: Vec<NamedSlosh>,
    /// Propellant tanks.
    pub tanks: Vec<Tank>,
    /// Thrusters.
    pub thrusters: Vec<Thruster>,
    /// Sun sensors.
    pub sun_sensors: Vec<MountedSunSensor>,
    /// Instruments that are pointed.
    pub instruments: Vec<Instrument>,
    /// Magnitude of each body component of the momentum at which thrusters dump it, in N m s.
    pub dump_threshold_n_m_s: Option<Vector3<f64>>,
    /// Directions the Sun may have.
    pub sun_keep_in: Option<SunKeepIn>,
    /// Whether models report temperature and force of every face.
    pub per_plate_outputs: bool,
    /// Temperature of the space that surfaces see, in K.
    pub background_k: f64,
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

impl SunKeepIn {
    /// The smaller of both limits.
    #[must_use]
    pub fn within(&self, other: &Self) -> Self {
        Self {
            azimuth_rad: self.azimuth_rad.min(other.azimuth_rad),
            elevation_rad: self.elevation_rad.min(other.elevation_rad),
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
    pub fn from_toml(file_name: &str, text: &str) -> Result<Self, SpacecraftError> {
        let document = Document::parse(file_name, text)?;
        let (description, findings) = document.read::<Description>()?;
        let mut check = Checker::new(&document, findings);
        let surroundings = Surroundings::of(&mut check, description.thermal.as_ref());
        let mut builder = Builder { check, materials: Materials::new(surroundings), surfaces: 0 };
        let spacecraft = builder.spacecraft(&description);
        builder.check.finish(spacecraft)
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

/// Gathers problems and materials on the way through the file.
struct Builder<'d> {
    check: Checker<'d>,
    materials: Materials,
    /// Surfaces of shapes so far.
    surfaces: usize,
}

impl Builder<'_> {
    fn spacecraft(&mut self, description: &Description) -> Spacecraft {
        let root = Place::root();
        if description.name.trim().is_empty() {
            self.check.report(&root.key("name"), "an empty name", "a name");
        }
        for (name, optics) in &description.optics {
            let place = root.key("optics").key(name);
            let sunlight = self.optics(&place, optics);
            let thermal = face_thermal(&mut self.check, &place, optics, &sunlight);
            self.materials.insert(name, Material { optics: sunlight, thermal });
        }
        let surfaces = [
            ("plates", description.plates.is_some()),
            ("boxes", description.boxes.is_some()),
            ("cylinders", description.cylinders.is_some()),
            ("discs", description.discs.is_some()),
            ("dishes", description.dishes.is_some()),
            ("sunshade", description.sunshade.is_some()),
            ("panels", description.panels.is_some()),
        ];
        if !surfaces.iter().any(|(key, is_given)| *is_given || self.check.is_stand_in(&root.key(key))) {
            let keys = surfaces.map(|(key, _)| format!("`{key}`")).join(", ");
            self.check.push(&root, "no surface", format_args!("at least one of {keys}"));
        }
        self.distinct_names(description);
        self.panels_fit(description);
        let tanks = self.list(&root.key("tanks"), description.tanks.as_deref(), |builder, at, index, it| {
            tank(&mut builder.check, at, index, it)
        });
        tanks_fit(&mut self.check, &tanks, description.mass_properties.mass_kg);
        let thrusters =
            self.list(&root.key("thrusters"), description.thrusters.as_deref(), |builder, at, index, it| {
                thruster(&mut builder.check, &tanks, at, index, it)
            });
        let mass_properties = self.mass(&root.key("mass_properties"), &description.mass_properties);
        let flexible_modes = self.list(
            &root.key("flexible_modes"),
            description.flexible_modes.as_deref(),
            |builder, at, index, it| mode(&mut builder.check, at, index, it),
        );
        let sloshes =
            self.list(&root.key("slosh"), description.slosh.as_deref(), |builder, at, index, it| {
                slosh(&mut builder.check, at, index, it)
            });
        swinging_fits(&mut self.check, &flexible_modes, &sloshes, &mass_properties);
        let keep_in = root.key("sun_keep_in");
        let threshold = root.key("momentum").key("dump_threshold_n_m_s");
        Spacecraft {
            name: description.name.clone(),
            mass_properties,
            plates: self.body_plates(description),
            sunshade: description.sunshade.as_ref().map(|s| self.sunshade(&root.key("sunshade"), s)),
            panels: self.list(&root.key("panels"), description.panels.as_deref(), Self::panel),
            wheels: self.list(&root.key("wheels"), description.wheels.as_deref(), Self::wheel),
            flexible_modes,
            sloshes,
            tanks,
            thrusters,
            sun_sensors: match description.sun_sensors.as_deref() {
                Some(sensors) => self.list(&root.key("sun_sensors"), Some(sensors), Self::sun_sensor),
                None => MountedSunSensor::six(),
            },
            instruments: self.list(
                &root.key("instruments"),
                description.instruments.as_deref(),
                Self::instrument,
            ),
            dump_threshold_n_m_s: description.momentum.as_ref().map(|momentum| {
                let mut axis = 0;
                Vector3::from(momentum.dump_threshold_n_m_s.map(|value| {
                    axis += 1;
                    self.check.positive(&threshold.item(axis - 1), value)
                }))
            }),
            per_plate_outputs: description.per_plate_outputs.unwrap_or(false),
            background_k: self.materials.surroundings.background_k,
            planet_map: description
                .planet_map
                .as_ref()
                .and_then(|map| self.planet_map(&root.key("planet_map"), map)),
            start: start_entries(&mut self.check, description.start.as_ref(), description.fixed.as_ref()),
            sun_keep_in: description.sun_keep_in.as_ref().map(|limits| SunKeepIn {
                azimuth_rad: self.check.angle(&keep_in.key("azimuth_deg"), limits.azimuth_deg, 0.0, 180.0),
                elevation_rad: self.check.angle(
                    &keep_in.key("elevation_deg"),
                    limits.elevation_deg,
                    0.0,
                    90.0,
                ),
            }),
        }
    }

    /// Two plates, the shade's among them, two panels, wheels, Sun sensors, instruments, tanks, thrusters, modes or sloshes with one name could not be told apart.
    fn distinct_names(&mut self, description: &Description) {
        let root = Place::root();
        let plate = |plate: &PlateDescription| plate.name.clone();
        let mut plates = named(&root.key("plates"), description.plates.as_deref(), "plate", plate);
        let Description { boxes, cylinders, discs, dishes, .. } = description;
        plates.extend(named(&root.key("boxes"), boxes.as_deref(), "box", |it| it.name.clone()));
        plates.extend(named(&root.key("cylinders"), cylinders.as_deref(), "cylinder", |it| it.name.clone()));
        plates.extend(named(&root.key("discs"), discs.as_deref(), "disc", |it| it.name.clone()));
        plates.extend(named(&root.key("dishes"), dishes.as_deref(), "dish", |it| it.name.clone()));
        if let Some(shade) = &description.sunshade {
            plates.extend(named(
                &root.key("sunshade").key("plates"),
                shade.plates.as_deref(),
                "plate",
                plate,
            ));
        }
        let panels =
            named(&root.key("panels"), description.panels.as_deref(), "panel", |panel| panel.name.clone());
        let wheels =
            named(&root.key("wheels"), description.wheels.as_deref(), "wheel", |wheel| wheel.name.clone());
        let sensors =
            named(&root.key("sun_sensors"), description.sun_sensors.as_deref(), "sun sensor", |sensor| {
                sensor.name.clone()
            });
        let instruments =
            named(&root.key("instruments"), description.instruments.as_deref(), "instrument", |instrument| {
                Some(instrument.name.clone())
            });
        let tanks = named(&root.key("tanks"), description.tanks.as_deref(), "tank", |tank| tank.name.clone());
        let thrusters =
            named(&root.key("thrusters"), description.thrusters.as_deref(), "thruster", |thruster| {
                thruster.name.clone()
            });
        let modes = named(
            &root.key("flexible_modes"),
            description.flexible_modes.as_deref(),
            "flexible mode",
            |mode| mode.name.clone(),
        );
        let sloshes =
            named(&root.key("slosh"), description.slosh.as_deref(), "slosh", |slosh| slosh.name.clone());
        for list in [plates, panels, wheels, sensors, instruments, tanks, thrusters, modes, sloshes] {
            let mut known: BTreeMap<String, (Place, bool)> = BTreeMap::new();
            for (at, name, is_given) in list {
                match known.get(&name) {
                    // A plate and one of the shade that nobody named are both called by their number.
                    Some((_, false)) if !is_given => {}
                    Some((other, _)) => {
                        let unnamed = if is_given { "" } else { " as what has no name is called" };
                        let found = format!("`{name}`{unnamed}, the name of {other} too");
                        self.check.report(&at.key("name"), found, "a name of its own");
                    }
                    None => {
                        known.insert(name, (at, is_given));
                    }
                }
            }
        }
    }

    /// The map, unless something in it was reported.
    fn planet_map(&mut self, at: &Place, description: &PlanetMapDescription) -> Option<PlanetMap> {
        let belts = description.temperature_k.len();
        let [reflectivity, emissivity, temperature] = [
            ("diffuse_reflectivity", &description.diffuse_reflectivity, 1.0, "a number from 0 to 1"),
            ("emissivity", &description.emissivity, 1.0, "a number from 0 to 1"),
            ("temperature_k", &description.temperature_k, HOTTEST_K, "a number from 0 to 10000 K"),
        ]
        .map(|(key, rows, most, allowed)| {
            let place = at.key(key);
            if rows.len() != belts || !(1..=MOST_BELTS).contains(&belts) {
                let wanted = format!("as many as `temperature_k` has, 1 to {MOST_BELTS}");
                self.check.report(&place, format_args!("{} belts", rows.len()), wanted);
            }
            for (belt, row) in rows.iter().enumerate() {
                let place = place.item(belt);
                if row.len() != 2 * rows.len() {
                    let wanted = format!("{}, twice as many as there are belts", 2 * rows.len());
                    self.check.report(&place, format_args!("{} cells", row.len()), wanted);
                }
                for (cell, value) in row.iter().enumerate() {
                    self.check.within(&place.item(cell), *value, 0.0, most, allowed);
                }
            }
            rows.concat()
        });
        let cells = reflectivity.into_iter().zip(emissivity).zip(temperature);
        let cells = cells.map(|((diffuse_reflectivity, emissivity), temperature_k)| PlanetCell {
            diffuse_reflectivity,
            emissivity,
            temperature_k,
        });
        PlanetMap::new(belts, cells.collect()).ok()
    }

    /// A list that may be left out but not be empty.
    fn list<D, S>(
        &mut self,
        at: &Place,
        items: Option<&[D]>,
        mut build: impl FnMut(&mut Self, &Place, usize, &D) -> S,
    ) -> Vec<S> {
        if items.is_some_and(<[D]>::is_empty) {
            self.check.report(at, "an empty list", "at least one item, or no such key");
        }
        items.unwrap_or_default().iter().enumerate().map(|(i, d)| build(self, &at.item(i), i, d)).collect()
    }

    fn mass(&mut self, at: &Place, description: &MassDescription) -> MassProperties {
        let [x, y, z] = description.inertia_kg_m2.map(|row| Vector3::from(row).transpose());
        let inertia_body_kg_m2 = Matrix3::from_rows(&[x, y, z]);
        if let Err(allowed) = check_inertia(&inertia_body_kg_m2) {
            let found = format!("{:?}", description.inertia_kg_m2);
            self.check.report(&at.key("inertia_kg_m2"), found, allowed);
        }
        MassProperties {
            mass_kg: self.check.positive(&at.key("mass_kg"), description.mass_kg),
            center_of_mass_body_m: self
                .check
                .vector(&at.key("center_of_mass_m"), description.center_of_mass_m),
            inertia_body_kg_m2,
        }
    }

    fn optics(&mut self, at: &Place, description: &OpticsDescription) -> Optics {
        let specular = self.check.fraction(&at.key("specular"), description.specular);
        let diffuse = self.check.fraction(&at.key("diffuse"), description.diffuse);
        let reflected = specular + diffuse;
        let Some(absorptivity) = description.absorptivity else {
            if reflected > 1.0 + OPTICS_SUM_TOLERANCE && !self.check.has_reported(at) {
                let found = format!("specular + diffuse = {}", rounded(reflected));
                self.check.report_across(at, &at.key("specular"), found, "a sum of at most 1");
            }
            let absorptivity = (1.0 - reflected).max(0.0);
            return Optics { absorptivity, specular, diffuse };
        };
        self.check.fraction(&at.key("absorptivity"), absorptivity);
        let sum = absorptivity + reflected;
        if (sum - 1.0).abs() > OPTICS_SUM_TOLERANCE {
            let found = format!("absorptivity + specular + diffuse = {}", rounded(sum));
            self.check.report_across(at, &at.key("absorptivity"), found, "a sum of 1 within 1e-9");
        }
        Optics { absorptivity, specular, diffuse }
    }

    fn material(&mut self, at: &Place, name: &str) -> Material {
        self.materials.find(&mut self.check, at, name)
    }

    /// The plates that the file lists, then those of its shapes.
    fn body_plates(&mut self, description: &Description) -> Vec<Plate> {
        let at = |key: &str| Place::root().key(key);
        let Description { plates, boxes, cylinders, discs, dishes, .. } = description;
        let mut found = self.list(&at("plates"), plates.as_deref(), |it, at, index, plate| {
            it.counted(at, |it| it.plates(at, index, plate))
        });
        found.extend(self.list(&at("boxes"), boxes.as_deref(), |it, at, index, shape| {
            it.counted(at, |it| box_plates(&mut it.check, &it.materials, at, index, shape))
        }));
        found.extend(self.list(&at("cylinders"), cylinders.as_deref(), |it, at, index, shape| {
            it.counted(at, |it| cylinder_plates(&mut it.check, &it.materials, at, index, shape))
        }));
        found.extend(self.list(&at("discs"), discs.as_deref(), |it, at, index, shape| {
            it.counted(at, |it| disc_plates(&mut it.check, &it.materials, at, index, shape))
        }));
        found.extend(self.list(&at("dishes"), dishes.as_deref(), |it, at, index, shape| {
            it.counted(at, |it| dish_plates(&mut it.check, &it.materials, at, index, shape))
        }));
        if self.surfaces > MOST_SURFACES {
            let found = "more surfaces, copies and facets of shapes among them";
            self.check.push(&Place::root(), found, format_args!("at most {MOST_SURFACES}"));
        }
        distinct_plates(&mut self.check, &found);
        found.into_iter().flat_map(|(_, plates)| plates).collect()
    }

    /// The plates of a shape; none beyond the most that a spacecraft may have.
    fn counted(&mut self, at: &Place, plates: impl FnOnce(&mut Self) -> Vec<Plate>) -> (Place, Vec<Plate>) {
        if self.surfaces > MOST_SURFACES {
            return (at.clone(), Vec::new());
        }
        let plates = plates(self);
        self.surfaces += plates.len();
        (at.clone(), plates)
    }

    /// A plate with its copies.
    fn plates(&mut self, at: &Place, index: usize, description: &PlateDescription) -> Vec<Plate> {
        let plate = self.plate(at, index, description);
        let (mirror, repeat) = (description.mirror.as_deref(), description.repeat.as_ref());
        let motions = motions(&mut self.check, at, mirror, repeat);
        let plates = plate_copies(&plate, &motions);
        check_apart(&mut self.check, at, &plates, motions.len());
        plates
    }

    fn plate(&mut self, at: &Place, index: usize, description: &PlateDescription) -> Plate {
        let front = self.material(&at.key("optics"), &description.optics);
        let rear = description.rear_optics.as_ref().map(|name| self.material(&at.key("rear_optics"), name));
        let normal = description.normal.map(|normal| self.check.unit_vector(&at.key("normal"), normal));
        let outline = checked_outline(&mut self.check, at, description.polygon_m.as_deref(), normal.as_ref());
        Plate {
            name: name_or_number(description.name.as_deref(), "plate", index),
            area_m2: checked_area(&mut self.check, at, description.area_m2, outline.as_ref()),
            center_m: checked_center(&mut self.check, at, description.center_m, outline.as_ref()),
            normal: checked_normal(&mut self.check, at, normal, outline.as_ref()),
            optics: front.optics,
            rear_optics: rear.map(|rear| rear.optics),
            thermal: thermal(
                &mut self.check,
                self.materials.surroundings,
                at,
                description.thermal.as_ref(),
                front,
                rear,
            ),
            polygon: outline,
        }
    }

    fn sunshade(&mut self, at: &Place, description: &SunshadeDescription) -> Sunshade {
        let sunshade = Sunshade {
            model: description.model,
            dcm_body_from_shade: self.check.rotation(
                at,
                ("rotation_deg", description.rotation_deg),
                ("dcm_body_from_shade", description.dcm_body_from_shade),
            ),
            plates: self.list(&at.key("plates"), description.plates.as_deref(), Self::plates).concat(),
            cylinder: description.cylinder.as_ref().map(|c| self.cylinder(&at.key("cylinder"), c)),
        };
        if !sunshade.has(description.model) {
            let (found, allowed) = match description.model {
                SunshadeModel::Plates => ("`plates` without plates", "[[sunshade.plates]] or \"cylinder\""),
                SunshadeModel::Cylinder => {
                    ("`cylinder` without a cylinder", "[sunshade.cylinder] or \"plates\"")
                }
            };
            self.check.report_across(at, &at.key("model"), found, allowed);
        }
        sunshade
    }

    fn cylinder(&mut self, at: &Place, description: &CylinderDescription) -> Cylinder {
        let angle = at.key("subtended_angle_deg");
        let angle_deg = self.check.positive(&angle, description.subtended_angle_deg);
        Cylinder {
            radius_m: self.check.positive(&at.key("radius_m"), description.radius_m),
            height_m: self.check.positive(&at.key("height_m"), description.height_m),
            half_angle_rad: self.check.angle(&angle, angle_deg.max(0.0), 0.0, 360.0) / 2.0,
            optics: self.material(&at.key("optics"), &description.optics).optics,
        }
    }

    fn panel(&mut self, at: &Place, index: usize, description: &PanelDescription) -> Panel {
        let dcm_body_from_panel = self.check.rotation(
            at,
            ("rotation_deg", description.rotation_deg),
            ("dcm_body_from_panel", description.dcm_body_from_panel),
        );
        let axis = self.check.unit_vector(&at.key("axis"), description.axis.unwrap_or([1.0, 0.0, 0.0]));
        let zero_normal = self.check.perpendicular(
            &at.key("zero_normal"),
            description.zero_normal.unwrap_or([0.0, -1.0, 0.0]),
            &axis,
            "axis",
        );
        let tilt_sign = description.tilt_sign.unwrap_or(1);
        if tilt_sign.abs() != 1 {
            self.check.report(&at.key("tilt_sign"), tilt_sign, "1 or -1");
        }
        let front = self.material(&at.key("optics"), &description.optics);
        let rear = description.rear_optics.as_ref().map(|name| self.material(&at.key("rear_optics"), name));
        let outline =
            checked_outline(&mut self.check, at, description.polygon_m.as_deref(), Some(&zero_normal));
        let area_m2 = checked_area(&mut self.check, at, description.area_m2, outline.as_ref());
        let center_m = checked_center(&mut self.check, at, description.center_m, outline.as_ref());
        let mass = self.panel_mass(at, description, area_m2, center_m, &zero_normal);
        Panel {
            name: name_or_number(description.name.as_deref(), "panel", index),
            area_m2,
            center_body_m: dcm_body_from_panel * center_m,
            mass: mass.map(|mass| mass.turned(&dcm_body_from_panel)),
            axis_body: dcm_body_from_panel * axis,
            zero_normal_body: dcm_body_from_panel * zero_normal,
            optics: front.optics,
            rear_optics: rear.map(|rear| rear.optics),
            thermal: thermal(
                &mut self.check,
                self.materials.surroundings,
                at,
                description.thermal.as_ref(),
                front,
                rear,
            ),
            polygon: outline.as_ref().map(|polygon| polygon.moved(|v| dcm_body_from_panel * v)),
            control: description.control.unwrap_or(PanelControl::SunOffset),
            sun_offset_rad: self.check.angle(
                &at.key("sun_offset_deg"),
                description.sun_offset_deg.unwrap_or(0.0),
                0.0,
                180.0,
            ),
            tilt_sign: if tilt_sign < 0 { -1.0 } else { 1.0 },
            angle_rad: self.check.angle(
                &at.key("angle_deg"),
                description.angle_deg.unwrap_or(0.0),
                -360.0,
                360.0,
            ),
        }
    }

    /// Panels are a part of the spacecraft's mass.
    fn panels_fit(&mut self, description: &Description) {
        let (mut sum_kg, whole_kg) = (0.0, description.mass_properties.mass_kg);
        for (index, panel) in description.panels.iter().flatten().enumerate() {
            let Some(mass_kg) = panel.mass_kg else { continue };
            sum_kg += mass_kg;
            if sum_kg >= whole_kg {
                let at = Place::root().key("panels").item(index).key("mass_kg");
                let found = format!("{mass_kg}, with the panels before it {sum_kg}");
                let allowed =
                    format!("less than mass_properties.mass_kg = {whole_kg}, of which it is a part");
                self.check.report(&at, found, allowed);
                return;
            }
        }
    }

    /// A panel's mass in the panel frame.
    fn panel_mass(
        &mut self,
        at: &Place,
        description: &PanelDescription,
        area_m2: f64,
        center_m: Vector3<f64>,
        normal: &Vector3<f64>,
    ) -> Option<PanelMass> {
        let Some(mass_kg) = description.mass_kg else {
            for (key, is_given) in [
                ("mass_center_m", description.mass_center_m.is_some()),
                ("inertia_kg_m2", description.inertia_kg_m2.is_some()),
            ] {
                if is_given {
                    self.check.report(&at.key(key), "no mass_kg beside it", "with mass_kg alone");
                }
            }
            return None;
        };
        let mass_kg = self.check.positive(&at.key("mass_kg"), mass_kg);
        let place = description.mass_center_m.map(|place| self.check.vector(&at.key("mass_center_m"), place));
        let mut mass = PanelMass::square_plate(mass_kg, area_m2, place.unwrap_or(center_m), normal);
        if let Some(rows) = description.inertia_kg_m2 {
            let [x, y, z] = rows.map(|row| Vector3::from(row).transpose());
            mass.inertia_body_kg_m2 = Matrix3::from_rows(&[x, y, z]);
            if let Err(allowed) = check_inertia(&mass.inertia_body_kg_m2) {
                self.check.report(&at.key("inertia_kg_m2"), format!("{rows:?}"), allowed);
            }
        }
        Some(mass)
    }

    fn wheel(&mut self, at: &Place, index: usize, description: &WheelDescription) -> Wheel {
        let capacity_n_m_s = self.check.positive(&at.key("capacity_n_m_s"), description.capacity_n_m_s);
        let mut positive = |key: &str, value: Option<f64>, otherwise: f64| {
            value.map_or(otherwise, |value| self.check.positive(&at.key(key), value))
        };
        let inertia_kg_m2 =
            positive("inertia_kg_m2", description.inertia_kg_m2, capacity_n_m_s / SPEED_AT_CAPACITY_RAD_S);
        let max_torque_n_m =
            positive("max_torque_n_m", description.max_torque_n_m, capacity_n_m_s / TIME_TO_CAPACITY_S);
        let mut or_zero = |key: &str, value: Option<f64>| {
            value.map_or(0.0, |value| self.check.not_negative(&at.key(key), value))
        };
        let coulomb_friction_n_m = or_zero("coulomb_friction_n_m", description.coulomb_friction_n_m);
        let viscous_friction_n_m_s = or_zero("viscous_friction_n_m_s", description.viscous_friction_n_m_s);
        let static_imbalance_kg_m = or_zero("static_imbalance_kg_m", description.static_imbalance_kg_m);
        if static_imbalance_kg_m > 0.0 && description.position_m.is_none() {
            self.check.report(
                &at.key("static_imbalance_kg_m"),
                "no position_m beside it",
                "with the rotor's place, position_m",
            );
        }
        Wheel {
            static_imbalance_kg_m,
            position_body_m: description
                .position_m
                .map_or(Vector3::zeros(), |place| self.check.vector(&at.key("position_m"), place)),
            name: name_or_number(description.name.as_deref(), "wheel", index),
            coulomb_friction_n_m,
            viscous_friction_n_m_s,
            axis_body: self.check.unit_vector(&at.key("axis"), description.axis),
            capacity_n_m_s,
            inertia_kg_m2,
            max_torque_n_m,
        }
    }

    fn sun_sensor(
        &mut self,
        at: &Place,
        index: usize,
        description: &SunSensorDescription,
    ) -> MountedSunSensor {
        let half_deg = description.half_field_of_view_deg.unwrap_or(HALF_FIELD_OF_VIEW_DEG);
        MountedSunSensor {
            name: name_or_number(description.name.as_deref(), "sun sensor", index),
            axis_body: self.check.unit_vector(&at.key("axis"), description.axis),
            half_field_of_view_rad: self.check.angle(&at.key("half_field_of_view_deg"), half_deg, 0.0, 180.0),
        }
    }

    fn instrument(&mut self, at: &Place, _: usize, description: &InstrumentDescription) -> Instrument {
        Instrument {
            name: description.name.clone(),
            boresight_body: self.check.unit_vector(&at.key("boresight"), description.boresight),
        }
    }
}

fn name_or_number(name: Option<&str>, kind: &str, index: usize) -> String {
    name.map_or_else(|| format!("{kind} {}", index + 1), str::to_owned)
}

/// Where each item stands, what it is called, and whether the file says so.
fn named<D>(
    at: &Place,
    items: Option<&[D]>,
    kind: &str,
    name: impl Fn(&D) -> Option<String>,
) -> Vec<(Place, String, bool)> {
    let items = items.unwrap_or_default().iter().enumerate();
    items
        .map(|(i, item)| {
            let given = name(item);
            (at.item(i), name_or_number(given.as_deref(), kind, i), given.is_some())
        })
        .collect()
}
