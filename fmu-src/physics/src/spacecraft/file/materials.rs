//! Materials, and what every surface exchanges heat with, from their descriptions.

use std::collections::BTreeMap;

use super::describe_thermal::SurroundingsDescription;
use super::description::{Description, OpticsDescription};
use crate::spacecraft::optics::Optics;
use crate::spacecraft::thermal::{
    BACKGROUND_K, EMISSIVITY_REFERENCE_TEMPERATURE_K, Emission, FaceThermal, HIGHEST_TEMPERATURE_K,
};
use crate::toml::{Checker, Place, nearest, rounded};

/// What a file says of a material.
#[derive(Clone, Copy)]
pub(crate) struct Material {
    pub optics: Optics,
    pub thermal: FaceThermal,
}

impl Material {
    /// Stands in for a material that was reported as unknown.
    pub const BLACK: Self = Self {
        optics: Optics::from_reflectivities(0.0, 0.0),
        thermal: FaceThermal::like_sunlight(&Optics::from_reflectivities(0.0, 0.0)),
    };
}

/// What every surface exchanges heat with.
#[derive(Clone, Copy)]
pub(crate) struct ThermalEnvironment {
    pub background_k: f64,
    /// Of the bus, if the file gives one for all surfaces.
    pub bus_temperature_k: Option<f64>,
}

impl ThermalEnvironment {
    pub fn of(check: &mut Checker<'_>, description: Option<&SurroundingsDescription>) -> Self {
        let at = Place::root().key("thermal");
        let mut kelvin = |key: &str, value: f64| {
            check.within(&at.key(key), value, 0.0, HIGHEST_TEMPERATURE_K, "0 to 2000 K")
        };
        let given = |of: fn(&SurroundingsDescription) -> Option<f64>| description.and_then(of);
        Self {
            background_k: given(|it| it.background_k).map_or(BACKGROUND_K, |it| kelvin("background_k", it)),
            bus_temperature_k: given(|it| it.bus_temperature_k).map(|it| kelvin("bus_temperature_k", it)),
        }
    }
}

/// The file's materials by name, and what their surfaces exchange heat with.
pub(crate) struct Materials {
    by_name: BTreeMap<String, Material>,
    pub surroundings: ThermalEnvironment,
}

impl Materials {
    /// Those of a file.
    pub fn read(check: &mut Checker<'_>, description: &Description) -> Self {
        let surroundings = ThermalEnvironment::of(check, description.thermal.as_ref());
        let materials = description.optics.iter().map(|(name, description)| {
            let at = Place::root().key("optics").key(name);
            let optics = optics(check, &at, description);
            let thermal = face_thermal(check, &at, description, &optics);
            (name.clone(), Material { optics, thermal })
        });
        Self { by_name: materials.collect(), surroundings }
    }

    /// The material of this name; an unknown one is reported.
    pub fn find(&self, check: &mut Checker<'_>, at: &Place, name: &str) -> Material {
        if let Some(material) = self.by_name.get(name) {
            return *material;
        }
        if check.is_stand_in(&Place::root().key("optics")) {
            return Material::BLACK;
        }
        let known: Vec<&str> = self.by_name.keys().map(String::as_str).collect();
        let hint = nearest(name, &known).map(|n| format!(" (did you mean `{n}`?)")).unwrap_or_default();
        let allowed = format!("a material under [optics]: {}", known.join(", "));
        check.report(at, format_args!("the unknown material `{name}`{hint}"), allowed);
        Material::BLACK
    }
}

/// How far absorptivity + specular + diffuse may be off 1.
const OPTICS_SUM_TOLERANCE: f64 = 1e-9;

fn optics(check: &mut Checker<'_>, at: &Place, description: &OpticsDescription) -> Optics {
    let specular = check.fraction(&at.key("specular"), description.specular);
    let diffuse = check.fraction(&at.key("diffuse"), description.diffuse);
    let reflected = specular + diffuse;
    let Some(absorptivity) = description.absorptivity else {
        if reflected > 1.0 + OPTICS_SUM_TOLERANCE && !check.has_reported(at) {
            let found = format!("specular + diffuse = {}", rounded(reflected));
            check.report_across(at, &at.key("specular"), found, "a sum of at most 1");
        }
        let absorptivity = (1.0 - reflected).max(0.0);
        return Optics { absorptivity, specular, diffuse };
    };
    check.fraction(&at.key("absorptivity"), absorptivity);
    let sum = absorptivity + reflected;
    if (sum - 1.0).abs() > OPTICS_SUM_TOLERANCE {
        let found = format!("absorptivity + specular + diffuse = {}", rounded(sum));
        check.report_across(at, &at.key("absorptivity"), found, "a sum of 1 within 1e-9");
    }
    Optics { absorptivity, specular, diffuse }
}

fn face_thermal(
    check: &mut Checker<'_>,
    at: &Place,
    description: &OpticsDescription,
    sunlight: &Optics,
) -> FaceThermal {
    let infrared_optics = description.infrared_absorptivity.map_or(*sunlight, |absorptivity| {
        sunlight.with_absorptivity(check.fraction(&at.key("infrared_absorptivity"), absorptivity))
    });
    let like_sunlight = FaceThermal::like_sunlight(sunlight).emission.emissivity;
    let emissivity = description.emissivity.map_or(like_sunlight, |emissivity| {
        check.within(&at.key("emissivity"), emissivity, 1e-3, 1.0, "a number from 0.001 to 1")
    });
    let slope = at.key("emissivity_per_k");
    let emission = Emission {
        emissivity,
        slope_per_k: check.finite(&slope, description.emissivity_per_k.unwrap_or(0.0)),
        reference_temperature_k: check.within(
            &at.key("emissivity_temperature_k"),
            description.emissivity_temperature_k.unwrap_or(EMISSIVITY_REFERENCE_TEMPERATURE_K),
            0.0,
            HIGHEST_TEMPERATURE_K,
            "0 to 2000 K",
        ),
    };
    if !emission.grows() {
        check.report_across(
            at,
            &slope,
            emission.slope_per_k,
            "a slope so small that up to 2000 K a hotter face emits more power",
        );
    }
    FaceThermal { infrared_optics, emission }
}
