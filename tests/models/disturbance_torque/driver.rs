//! DisturbanceTorque through FMI's functions, its variables by name, and geometries to put it in.

use core::ops::{Deref, DerefMut};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

use client::{InProcess, NamedInstance};
use fmi_export::fmi2::entry;
use fmi_export::{Library, Status};
use model_description::Causality;
use models::{DisturbanceTorque, Guidance, MomentumPlant};

use super::super::random::RandomNumbers;
use super::super::spacecraft::RADIATING;

/// The models of a spacecraft's file, whose `[start]` may have names of each.
pub(super) static LIBRARY: Library =
    Library { entries: &[entry::<DisturbanceTorque>(), entry::<MomentumPlant>(), entry::<Guidance>()] };

/// Air and field that random inputs are about.
pub(crate) const DENSITY_KG_M3: f64 = 1e-13;
pub(crate) const TEMPERATURE_K: f64 = 1000.0;
pub(crate) const MOLAR_MASS_KG_MOL: f64 = 0.016;
pub(crate) const SPEED_M_S: f64 = 7.6e3;
pub(crate) const FIELD_T: f64 = 3e-5;

/// Start values of the spacecraft with shadows.
const SHADOWED: &str = r#"
[start]
"planetLight.enabled" = true
"thermal.enabled" = true
"shadowing.enabled" = true
"#;

fn resources(name: &str, text: &str) -> std::path::PathBuf {
    // One folder a call: tests run side by side.
    static CALLS: AtomicUsize = AtomicUsize::new(0);
    let call = CALLS.fetch_add(1, Ordering::Relaxed);
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-{call}"));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("spacecraft.toml"), text).unwrap();
    folder
}

/// A model of the spacecraft of a TOML text, in a folder of its own.
pub(crate) fn instance(model: &str, name: &str, text: &str) -> NamedInstance {
    let folder = resources(name, text);
    let entry = LIBRARY.find(model).unwrap();
    let description = LIBRARY.describe(entry, Some("spacecraft.toml"), Some(text)).unwrap();
    let location = format!("file://{}", folder.display());
    let fmu = InProcess::instantiate(&LIBRARY, &description.guid, Some(&location)).unwrap();
    NamedInstance::new(fmu, description)
}

/// The model through FMI's functions.
pub(crate) struct Disturbance(NamedInstance);

impl Deref for Disturbance {
    type Target = NamedInstance;

    fn deref(&self) -> &NamedInstance {
        &self.0
    }
}

impl DerefMut for Disturbance {
    fn deref_mut(&mut self) -> &mut NamedInstance {
        &mut self.0
    }
}

impl Disturbance {
    /// MESSENGER as shipped.
    pub(crate) fn messenger() -> Self {
        Self(NamedInstance::from_library(&LIBRARY, "DisturbanceTorque"))
    }

    /// The spacecraft with shadows.
    pub(crate) fn shadowed() -> Self {
        Self::from_text("shadowed", &format!("{RADIATING}{SHADOWED}"))
    }

    /// The spacecraft of a TOML text, in a folder of its own.
    pub(crate) fn from_text(name: &str, text: &str) -> Self {
        Self(instance("DisturbanceTorque", name, text))
    }

    /// With air and a magnetic field acting, and the planet's flattening on the gravity gradient.
    pub(crate) fn near_the_earth(mut self) -> Self {
        for switch in ["aerodynamics.enabled", "magnetics.enabled", "gravityGradient.flattening"] {
            self.put_boolean(switch, true);
        }
        // Sentman's law.
        self.put_integer("aerodynamics.law", 2);
        for (axis, dipole_a_m2) in [(1, 0.3), (2, -0.2), (3, 0.5)] {
            self.put(&format!("dipole.residual[{axis}]"), dipole_a_m2);
        }
        self
    }

    /// Takes light of the planet by cells in this number of belts.
    pub(crate) fn by_cells(mut self, belts: i32) -> Self {
        self.put_integer("planetLight.method", 2);
        self.put_integer("planetLight.belts", belts);
        self
    }

    pub(crate) fn start(&mut self) {
        self.begin(0.0);
    }

    pub(crate) fn step(&mut self) -> Status {
        self.try_step(1.0)
    }

    /// Name of a Real.
    pub(crate) fn name(&self, reference: u32) -> &str {
        let is = |v: &&model_description::ScalarVariable| {
            v.value_reference == reference && matches!(v.kind, model_description::VariableKind::Real { .. })
        };
        &self.description.variables.iter().find(is).unwrap().name
    }

    /// Indices in `outputs` of each output and of the other components of its vector.
    pub(crate) fn vectors_of(&self, outputs: &[u32]) -> Vec<Vec<usize>> {
        let vector = |reference: u32| {
            let name = self.name(reference);
            if name.ends_with(']') { name.rsplit_once('[').unwrap().0 } else { name }
        };
        let same = |of: u32| (0..outputs.len()).filter(|&k| vector(outputs[k]) == vector(of)).collect();
        outputs.iter().map(|of| same(*of)).collect()
    }

    pub(crate) fn references(&self, causality: Causality) -> Vec<u32> {
        let real = |v: &&model_description::ScalarVariable| {
            v.causality == causality && matches!(v.kind, model_description::VariableKind::Real { .. })
        };
        self.description.variables.iter().filter(real).map(|v| v.value_reference).collect()
    }

    /// Every output after a step with these inputs.
    pub(crate) fn outputs_at(&mut self, inputs: &[u32], values: &[f64], outputs: &[u32]) -> Vec<f64> {
        assert_eq!(self.fmu.set_real(inputs, values), Status::Ok);
        assert_eq!(self.step(), Status::Ok, "{:?}", self.fmu.drain_messages());
        self.read(outputs)
    }

    pub(crate) fn slopes(&mut self, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> Vec<f64> {
        let mut result = vec![f64::NAN; unknowns.len()];
        let status = self.fmu.get_directional_derivative(unknowns, knowns, seed, &mut result);
        assert_eq!(status, Status::Ok, "{:?}", self.fmu.drain_messages());
        result
    }
}

impl RandomNumbers {
    /// Sun, planet, centre of mass, air, field, angles, in the order of the inputs' names.
    pub(crate) fn inputs(&mut self, fmu: &Disturbance, in_shadow: bool) -> (Vec<u32>, Vec<f64>) {
        let sun = self.direction();
        let altitude = 1.05 + 3.0 * self.next();
        // Toward the penumbra: the planet before the Sun, off by its angular radius.
        let edge = (1.0 / altitude).asin() + 2e-3 * (self.next() - 0.5);
        let other = self.direction();
        let along: f64 = sun.iter().zip(other).map(|(a, b)| a * b).sum();
        let across = [0, 1, 2].map(|i| other[i] - along * sun[i]);
        let length = across.iter().map(|x| x * x).sum::<f64>().sqrt();
        let toward_planet = if in_shadow {
            [0, 1, 2].map(|i| edge.cos() * sun[i] + edge.sin() * across[i] / length)
        } else {
            self.direction()
        };
        let mut values = BTreeMap::new();
        for i in 0..3 {
            values.insert(fmu.at(&format!("sun.positionBody[{}]", i + 1)), sun[i] * 5.8e10);
            let planet_m = toward_planet[i] * altitude * 2.4394e6;
            values.insert(fmu.at(&format!("planet.positionBody[{}]", i + 1)), planet_m);
            values.insert(fmu.at(&format!("planet.pole[{}]", i + 1)), self.next() - 0.5);
            values.insert(fmu.at(&format!("spacecraft.centerOfMass[{}]", i + 1)), self.next() - 0.5);
        }
        // Air of a low orbit, at the speed of one, and a field as strong.
        let (flow, field) = (self.direction(), self.direction());
        for i in 0..3 {
            values.insert(fmu.at(&format!("atmosphere.velocityBody[{}]", i + 1)), flow[i] * SPEED_M_S);
            values.insert(fmu.at(&format!("magneticField.body[{}]", i + 1)), field[i] * FIELD_T);
        }
        values.insert(fmu.at("atmosphere.density"), DENSITY_KG_M3 * (0.5 + self.next()));
        values.insert(fmu.at("atmosphere.temperature"), TEMPERATURE_K * (0.5 + self.next()));
        values.insert(fmu.at("atmosphere.molarMass"), MOLAR_MASS_KG_MOL * (0.5 + self.next()));
        for k in 1.. {
            match fmu.find(&format!("panel[{k}].angle")) {
                Some(angle) => values.insert(angle, 6.0 * self.next() - 3.0),
                None => break,
            };
        }
        values.into_iter().unzip()
    }
}
