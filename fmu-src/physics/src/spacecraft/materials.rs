//! Materials, and what every surface exchanges heat with: their tables in the file, and the reading of them.

use std::cell::Cell;
use std::collections::BTreeMap;

use super::gas_surface::GasSurface;
use super::material::{Material, NamedMaterial, OPTICS_SUM_TOLERANCE};
use super::names::variable_name;
use super::optics::Optics;
use super::surface::FaceProperties;
use super::thermal::{BACKGROUND_K, EMISSIVITY_REFERENCE_TEMPERATURE_K, Emission, FaceThermal, Thermal};
use crate::toml::{Emissivity, Finite, Fraction, Kelvin, NotNegative, Place, Written, hint, rounded, tables};

tables! {
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

/// What every surface exchanges heat with.
struct SurroundingsDescription makes #[derive(Clone, Copy, Debug)] pub(crate) struct ThermalEnvironment or Default {
    /// Temperature of the space that surfaces see, in K; the default is the cosmic microwave background's.
    background_k: Kelvin = BACKGROUND_K,
    /// Temperature of the bus behind surfaces that conduct heat to it, in K; held, whatever flows.
    bus_temperature_k: Option<Kelvin>,
}
}

/// A material that a surface names.
#[derive(Clone, Copy)]
pub(super) struct ChosenMaterial {
    /// Its place among those in use; `None` for a stand-in.
    pub place: Option<usize>,
    /// Its properties.
    pub material: Material,
}

impl ChosenMaterial {
    /// Stands in for a material that was reported as unknown.
    const BLACK: Self = {
        let optics = Optics::from_reflectivities(0.0, 0.0);
        let thermal = FaceThermal::like_sunlight(&optics);
        Self { place: None, material: Material { optics, thermal, gas_surface: GasSurface::ASSUMED } }
    };

    /// Faces of a surface of these materials, front and rear.
    pub(super) fn faces(front: Self, rear: Option<Self>, thermal: Thermal) -> FaceProperties {
        FaceProperties {
            optics: front.material.optics,
            rear_optics: rear.map(|rear| rear.material.optics),
            gas_surface: [front, rear.unwrap_or(front)].map(|it| it.material.gas_surface),
            thermal,
            materials: [front.place, rear.and_then(|it| it.place)],
        }
    }
}

/// The file's materials by name, and what their surfaces exchange heat with.
pub(super) struct Materials {
    by_name: BTreeMap<String, (NamedMaterial, Cell<Option<usize>>)>,
    /// How many are in use.
    used: Cell<usize>,
    pub environment: ThermalEnvironment,
}

impl Materials {
    /// Reads the materials of a file.
    pub(super) fn read(
        root: &Place<'_>,
        described: &BTreeMap<String, OpticsDescription>,
        surroundings: Option<&SurroundingsDescription>,
    ) -> Self {
        let none = SurroundingsDescription::default();
        let environment = surroundings.unwrap_or(&none).value();
        let place = root.key("optics");
        let names = variable_names(&place, described.keys());
        let materials = described.iter().zip(names).map(|((name, description), variable)| {
            let at = place.key(name);
            let optics = optics(&at, description);
            let thermal = face_thermal(&at, description, &optics);
            let material = NamedMaterial {
                name: variable,
                material: Material { optics, thermal, gas_surface: gas_surface(description) },
                emissivity_follows: description.emissivity.is_none(),
                infrared_follows: description.infrared_absorptivity.is_none(),
                has_air: says_air(description),
            };
            (name.clone(), (material, Cell::new(None)))
        });
        Self { by_name: materials.collect(), used: Cell::new(0), environment }
    }

    /// Returns the materials that surfaces name, in the order of their first use.
    pub(super) fn in_use(&self) -> Vec<NamedMaterial> {
        let mut used: Vec<_> = self.by_name.values().filter(|(_, place)| place.get().is_some()).collect();
        used.sort_by_key(|(_, place)| place.get());
        used.into_iter().map(|(material, _)| material.clone()).collect()
    }

    /// The material of this name; an unknown one is reported.
    pub(super) fn find(&self, at: &Place<'_>, name: &str) -> ChosenMaterial {
        if let Some((named, place)) = self.by_name.get(name) {
            if place.get().is_none() {
                place.set(Some(self.used.replace(self.used.get() + 1)));
            }
            return ChosenMaterial { place: place.get(), material: named.material };
        }
        if at.of_file("optics").is_stand_in() {
            return ChosenMaterial::BLACK;
        }
        let known: Vec<&str> = self.by_name.keys().map(String::as_str).collect();
        let allowed = format!("a material under [optics]: {}", known.join(", "));
        at.report(format_args!("the unknown material `{name}`{}", hint(name, &known)), allowed);
        ChosenMaterial::BLACK
    }
}

/// Names of the parameters of materials, no two alike.
fn variable_names<'n>(optics: &Place<'_>, names: impl Iterator<Item = &'n String>) -> Vec<String> {
    let mut known: BTreeMap<String, &str> = BTreeMap::new();
    let called = names.map(|name| {
        let at = optics.key(name);
        let Some(variable) = variable_name(name) else {
            let allowed = "letters and digits, words apart by `-` or `_`, the first a letter: parameters are called after it, \
                           those of `shield-film` optics.shieldFilm.*";
            at.report(format_args!("{name:?}"), allowed);
            return name.clone();
        };
        if let Some(other) = known.insert(variable.clone(), name) {
            let found = format!("parameters optics.{variable}.*, as of `{other}`");
            at.report(found, "a name of its own without `-` and `_` too");
        }
        variable
    });
    called.collect()
}

fn optics(at: &Place<'_>, description: &OpticsDescription) -> Optics {
    let (specular, diffuse) = (description.specular.0, description.diffuse.0);
    let reflected = specular + diffuse;
    let given = description.absorptivity.value();
    let absorptivity = given.unwrap_or((1.0 - reflected).max(0.0));
    let sum = absorptivity + reflected;
    if given.is_some() && (sum - 1.0).abs() > OPTICS_SUM_TOLERANCE {
        let found = format!("absorptivity + specular + diffuse = {}", rounded(sum));
        at.key("absorptivity").report_across(found, "a sum of 1 within 1e-9");
    } else if given.is_none() && reflected > 1.0 + OPTICS_SUM_TOLERANCE && !at.has_reported() {
        let found = format!("specular + diffuse = {}", rounded(reflected));
        at.key("specular").report_across(found, "a sum of at most 1");
    }
    Optics { absorptivity, specular, diffuse }
}

/// Whether the file gives any number of the interaction with air.
fn says_air(description: &OpticsDescription) -> bool {
    description.drag_coefficient.is_some()
        || description.energy_accommodation.is_some()
        || description.normal_accommodation.is_some()
        || description.tangential_accommodation.is_some()
        || description.wall_temperature_k.is_some()
}

fn gas_surface(description: &OpticsDescription) -> GasSurface {
    GasSurface {
        drag_coefficient: description.drag_coefficient(),
        energy_accommodation: description.energy_accommodation(),
        normal_accommodation: description.normal_accommodation(),
        tangential_accommodation: description.tangential_accommodation(),
        wall_temperature_k: description.wall_temperature_k(),
    }
}

fn face_thermal(at: &Place<'_>, description: &OpticsDescription, sunlight: &Optics) -> FaceThermal {
    let infrared_optics = description
        .infrared_absorptivity
        .map_or(*sunlight, |Fraction(absorptivity)| sunlight.with_absorptivity(absorptivity));
    let like_sunlight = FaceThermal::like_sunlight(sunlight).emission.emissivity;
    let emission = Emission {
        emissivity: description.emissivity.value().unwrap_or(like_sunlight),
        slope_per_k: description.emissivity_per_k(),
        reference_temperature_k: description.emissivity_temperature_k(),
    };
    if !emission.grows() {
        let allowed = "a slope so small that up to 2000 K a hotter face emits more power";
        at.key("emissivity_per_k").report_across(emission.slope_per_k, allowed);
    }
    FaceThermal { infrared_optics, emission }
}
