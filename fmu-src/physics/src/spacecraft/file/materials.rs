//! Materials, and what every surface exchanges heat with, from their descriptions.

use std::collections::BTreeMap;

use super::describe_thermal::SurroundingsDescription;
use super::description::{OpticsDescription, SpacecraftDescription};
use crate::spacecraft::gas_surface::GasSurface;
use crate::spacecraft::optics::Optics;
use crate::spacecraft::thermal::{Emission, FaceThermal};
use crate::toml::{Checker, Fraction, KeyPath, hint, rounded};

/// What a file says of a material.
#[derive(Clone, Copy)]
pub(crate) struct Material {
    pub optics: Optics,
    pub thermal: FaceThermal,
    pub gas_surface: GasSurface,
}

impl Material {
    /// Stands in for a material that was reported as unknown.
    pub(crate) const BLACK: Self = Self {
        optics: Optics::from_reflectivities(0.0, 0.0),
        thermal: FaceThermal::like_sunlight(&Optics::from_reflectivities(0.0, 0.0)),
        gas_surface: GasSurface::ASSUMED,
    };

    /// Front and rear of a surface in the air.
    pub(crate) fn in_air(front: Self, rear: Option<Self>) -> [GasSurface; 2] {
        [front, rear.unwrap_or(front)].map(|material| material.gas_surface)
    }
}

/// What every surface exchanges heat with.
#[derive(Clone, Copy)]
pub(crate) struct ThermalEnvironment {
    pub background_k: f64,
    /// Of the bus, if the file gives one for all surfaces.
    pub bus_temperature_k: Option<f64>,
}

/// The file's materials by name, and what their surfaces exchange heat with.
pub(crate) struct Materials {
    by_name: BTreeMap<String, Material>,
    pub environment: ThermalEnvironment,
}

impl Materials {
    /// Those of a file.
    pub(crate) fn read(check: &mut Checker<'_>, description: &SpacecraftDescription) -> Self {
        let none = SurroundingsDescription::default();
        let thermal = description.thermal.as_ref().unwrap_or(&none);
        let environment = ThermalEnvironment {
            background_k: thermal.background_k(),
            bus_temperature_k: thermal.bus_temperature_k.map(f64::from),
        };
        let materials = description.optics.iter().map(|(name, description)| {
            let at = KeyPath::root().key("optics").key(name);
            let optics = optics(check, &at, description);
            let thermal = face_thermal(check, &at, description, &optics);
            (name.clone(), Material { optics, thermal, gas_surface: gas_surface(description) })
        });
        Self { by_name: materials.collect(), environment }
    }

    /// The material of this name; an unknown one is reported.
    pub(crate) fn find(&self, check: &mut Checker<'_>, at: &KeyPath, name: &str) -> Material {
        if let Some(material) = self.by_name.get(name) {
            return *material;
        }
        if check.is_stand_in(&KeyPath::root().key("optics")) {
            return Material::BLACK;
        }
        let known: Vec<&str> = self.by_name.keys().map(String::as_str).collect();
        let allowed = format!("a material under [optics]: {}", known.join(", "));
        check.report(at, format_args!("the unknown material `{name}`{}", hint(name, &known)), allowed);
        Material::BLACK
    }
}

/// How far absorptivity + specular + diffuse may be off 1.
const OPTICS_SUM_TOLERANCE: f64 = 1e-9;

fn optics(check: &mut Checker<'_>, at: &KeyPath, description: &OpticsDescription) -> Optics {
    let (specular, diffuse) = (description.specular.0, description.diffuse.0);
    let reflected = specular + diffuse;
    let Some(Fraction(absorptivity)) = description.absorptivity else {
        if reflected > 1.0 + OPTICS_SUM_TOLERANCE && !check.has_reported(at) {
            let found = format!("specular + diffuse = {}", rounded(reflected));
            check.report_across(at, &at.key("specular"), found, "a sum of at most 1");
        }
        let absorptivity = (1.0 - reflected).max(0.0);
        return Optics { absorptivity, specular, diffuse };
    };
    let sum = absorptivity + reflected;
    if (sum - 1.0).abs() > OPTICS_SUM_TOLERANCE {
        let found = format!("absorptivity + specular + diffuse = {}", rounded(sum));
        check.report_across(at, &at.key("absorptivity"), found, "a sum of 1 within 1e-9");
    }
    Optics { absorptivity, specular, diffuse }
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

fn face_thermal(
    check: &mut Checker<'_>,
    at: &KeyPath,
    description: &OpticsDescription,
    sunlight: &Optics,
) -> FaceThermal {
    let infrared_optics = description
        .infrared_absorptivity
        .map_or(*sunlight, |Fraction(absorptivity)| sunlight.with_absorptivity(absorptivity));
    let like_sunlight = FaceThermal::like_sunlight(sunlight).emission.emissivity;
    let emission = Emission {
        emissivity: description.emissivity.map_or(like_sunlight, f64::from),
        slope_per_k: description.emissivity_per_k(),
        reference_temperature_k: description.emissivity_temperature_k(),
    };
    if !emission.grows() {
        check.report_across(
            at,
            &at.key("emissivity_per_k"),
            emission.slope_per_k,
            "a slope so small that up to 2000 K a hotter face emits more power",
        );
    }
    FaceThermal { infrared_optics, emission }
}
