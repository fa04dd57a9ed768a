//! DisturbanceTorque through FMI's functions gives what its physics gives, with derivatives that are slopes, which
//! appear only where dependencies are declared.

use std::collections::{BTreeMap, BTreeSet};

use fmi_export::abi::{InProcess, Message, StatePointer};
use fmi_export::{Entry, Library, Model, Status};
use model_description::{Causality, Description, validate};
use models::DisturbanceTorque;

static LIBRARY: Library = Library { entries: &[Entry::of::<DisturbanceTorque>()] };

/// A spacecraft whose panel is shadowed by a shade at many directions of the Sun, with skew axes everywhere.
const SHADOWED: &str = r#"
name = "Shadowed"
per_plate_outputs = true
[mass_properties]
mass_kg = 100
center_of_mass_m = [0.1, 0.05, -0.2]
inertia_kg_m2 = [[10, 0.5, -0.2], [0.5, 12, 0.3], [-0.2, 0.3, 15]]
[optics.white]
specular = 0.2
diffuse = 0.5
emissivity = 0.8
infrared_absorptivity = 0.7
[[plates]]
polygon_m = [[-0.5, -1.2, -0.4], [0.6, -1.2, -0.4], [0.5, -1.2, 0.6], [-0.4, -1.2, 0.5]]
normal = [0.0, -1.0, 0.0]
optics = "white"
rear_optics = "white"
[[plates]]
polygon_m = [[-1.0, 0.3, -1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0], [-1.0, 0.3, 1.0]]
normal = [-0.1483404, -0.9889364, 0.0]
optics = "white"
[[panels]]
polygon_m = [[0.2, -0.2, -1.0], [1.6, -0.2, -1.0], [1.6, -0.2, 1.0], [0.2, -0.2, 1.0]]
axis = [1.0, 0.0, 0.0]
zero_normal = [0.0, -1.0, 0.0]
optics = "white"
rear_optics = "white"
control = "angle"
thermal.conduction = { conductance_w_m2_k = 10.0, radiative_exchange = 0.1 }
"#;

fn resources(name: &str, text: &str) -> std::path::PathBuf {
    let folder = std::path::Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("spacecraft.toml"), text).unwrap();
    folder
}

/// The model through FMI's functions, its variables by name.
pub struct Disturbance {
    fmu: InProcess,
    description: Description,
    names: BTreeMap<String, u32>,
    time_s: f64,
}

impl Disturbance {
    fn new(fmu: InProcess, description: Description) -> Self {
        let names = description.variables.iter().map(|v| (v.name.clone(), v.value_reference)).collect();
        Self { fmu, description, names, time_s: 0.0 }
    }

    /// MESSENGER as shipped.
    pub fn messenger() -> Self {
        let description = LIBRARY.find("DisturbanceTorque").unwrap().describe(None, None).unwrap();
        Self::new(InProcess::of(&LIBRARY, "DisturbanceTorque").unwrap(), description)
    }

    /// The spacecraft with shadows.
    pub fn shadowed() -> Self {
        Self::of("shadowed", SHADOWED)
    }

    /// The spacecraft of a TOML text, in a folder of its own.
    pub fn of(name: &str, text: &str) -> Self {
        let folder = resources(name, text);
        let entry = LIBRARY.find("DisturbanceTorque").unwrap();
        let description = entry.describe(Some("spacecraft.toml"), Some(text)).unwrap();
        let location = format!("file://{}", folder.display());
        let fmu = InProcess::instantiate(&LIBRARY, &description.guid, Some(&location)).unwrap();
        Self::new(fmu, description)
    }

    fn at(&self, name: &str) -> u32 {
        *self.names.get(name).unwrap_or_else(|| panic!("no variable {name}"))
    }

    pub fn put(&mut self, name: &str, value: f64) {
        let at = self.at(name);
        assert_eq!(self.fmu.set_real(&[at], &[value]), Status::Ok, "{name} = {value}");
    }

    pub fn put_vector(&mut self, name: &str, value: [f64; 3]) {
        for (i, value) in value.into_iter().enumerate() {
            self.put(&format!("{name}[{}]", i + 1), value);
        }
    }

    pub fn start(&mut self) {
        assert_eq!(self.fmu.start(0.0, None), Status::Ok, "{:?}", self.fmu.take_messages());
    }

    fn step(&mut self) -> Status {
        let status = self.fmu.do_step(self.time_s, 1.0);
        self.time_s += 1.0;
        status
    }

    fn real(&mut self, name: &str) -> f64 {
        let at = self.at(name);
        self.read(&[at])[0]
    }

    fn read(&mut self, references: &[u32]) -> Vec<f64> {
        let mut values = vec![0.0; references.len()];
        assert_eq!(self.fmu.get_real(references, &mut values), Status::Ok);
        values
    }

    fn vector(&mut self, name: &str) -> [f64; 3] {
        [1, 2, 3].map(|i| self.real(&format!("{name}[{i}]")))
    }

    /// Name of a Real.
    pub fn name(&self, reference: u32) -> &str {
        let is = |v: &&model_description::ScalarVariable| {
            v.value_reference == reference && matches!(v.kind, model_description::VariableKind::Real { .. })
        };
        &self.description.variables.iter().find(is).unwrap().name
    }

    pub fn references(&self, causality: Causality) -> Vec<u32> {
        let real = |v: &&model_description::ScalarVariable| {
            v.causality == causality && matches!(v.kind, model_description::VariableKind::Real { .. })
        };
        self.description.variables.iter().filter(real).map(|v| v.value_reference).collect()
    }

    /// Every output after a step with these inputs.
    pub fn outputs_at(&mut self, inputs: &[u32], values: &[f64], outputs: &[u32]) -> Vec<f64> {
        assert_eq!(self.fmu.set_real(inputs, values), Status::Ok);
        assert_eq!(self.step(), Status::Ok, "{:?}", self.fmu.take_messages());
        self.read(outputs)
    }

    pub fn slopes(&mut self, unknowns: &[u32], knowns: &[u32], seed: &[f64]) -> Vec<f64> {
        let mut result = vec![f64::NAN; unknowns.len()];
        let status = self.fmu.get_directional_derivative(unknowns, knowns, seed, &mut result);
        assert_eq!(status, Status::Ok, "{:?}", self.fmu.take_messages());
        result
    }
}

/// Numbers in [0, 1) that are the same every time.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn direction(&mut self) -> [f64; 3] {
        let (azimuth, z) = (core::f64::consts::TAU * self.next(), 2.0 * self.next() - 1.0);
        let rho = (1.0 - z * z).sqrt();
        [rho * azimuth.cos(), rho * azimuth.sin(), z]
    }

    /// Sun, planet, centre of mass, angles, in the order of the inputs' names.
    fn inputs(&mut self, fmu: &Disturbance, in_shadow: bool) -> (Vec<u32>, Vec<f64>) {
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
            values.insert(fmu.at(&format!("sun.position[{}]", i + 1)), sun[i] * 5.8e10);
            let planet_m = toward_planet[i] * altitude * 2.4394e6;
            values.insert(fmu.at(&format!("planet.position[{}]", i + 1)), planet_m);
            values.insert(fmu.at(&format!("centerOfMass[{}]", i + 1)), self.next() - 0.5);
        }
        for k in 1.. {
            match fmu.names.get(&format!("panel[{k}].angle")) {
                Some(angle) => values.insert(*angle, 6.0 * self.next() - 3.0),
                None => break,
            };
        }
        values.into_iter().unzip()
    }
}

#[test]
fn the_description_is_valid_and_structured() {
    for fmu in [Disturbance::messenger(), Disturbance::shadowed()] {
        assert_eq!(validate(&fmu.description), vec![]);
        assert!(fmu.description.co_simulation.as_ref().unwrap().provides_directional_derivative);
        assert!(fmu.description.structure.outputs.iter().all(|unknown| unknown.dependencies.is_some()));
    }
    let names = Disturbance::messenger().names;
    assert!(names.contains_key("panel[2].angle") && !names.contains_key("panel[3].angle"));
    assert!(!names.contains_key("plate[1].temperature"));
    // Two plates, one with a rear, and a panel with both.
    let names = Disturbance::shadowed().names;
    assert!(names.contains_key("plate[5].force[3]") && !names.contains_key("plate[6].temperature"));
}

/// Straight into the Sun with the planet far away: the shade's front half and the panels by hand.
#[test]
fn a_panel_facing_the_sun_is_pushed_by_the_flat_plate_law() {
    let mut fmu = Disturbance::messenger();
    fmu.put_vector("sun.position", [0.0, -1.495978707e11, 0.0]);
    fmu.put_vector("planet.position", [0.0, 0.0, 1e12]);
    fmu.start();
    assert_eq!(fmu.step(), Status::Ok);
    let pressure = 1365.0 / 299_792_458.0;
    let (side_cos, front) = (52.8_f64.to_radians().cos(), 1.264 * (0.63 + 0.23 + 2.0 * (0.23 / 3.0 + 0.14)));
    // The side shades make 52.8 deg with -Y in azimuth: 37.2 deg from the Sun.
    let cos = 52.8_f64.to_radians().sin();
    let along_light = (0.64 + 0.22) + 2.0 * (0.22 / 3.0 + 0.14 * cos) * cos;
    let sides = (2.122 + 2.121) * cos * along_light;
    let panels = 2.0 * 2.724 * (0.75 + 2.0 * 0.25);
    let expected = pressure * (front + sides + panels);
    let [x, y, z] = fmu.vector("force.solar");
    assert!((y / expected - 1.0).abs() < 1e-9, "{y} {expected}");
    assert!(z.abs() < 1e-20 && x.abs() < pressure * 0.01 * side_cos, "{x} {z}");
    assert_eq!(fmu.real("sun.litFraction"), 1.0);
    let total = fmu.vector("force.total");
    let parts = ["solar", "albedo", "infrared", "thermal"].map(|name| fmu.vector(&format!("force.{name}")));
    for i in 0..3 {
        assert!((total[i] - parts.iter().map(|part| part[i]).sum::<f64>()).abs() < 1e-19);
    }
    // The planet is a million radii away.
    assert!(parts[1].iter().chain(&parts[2]).all(|x| x.abs() < 1e-12));
}

#[test]
fn there_is_no_memory() {
    let mut fmu = Disturbance::messenger();
    fmu.start();
    let mut dice = Dice(5);
    let outputs = fmu.references(Causality::Output);
    let geometries: Vec<_> = (0..20).map(|_| dice.inputs(&fmu, false)).collect();
    let first: Vec<_> = geometries.iter().map(|(at, values)| fmu.outputs_at(at, values, &outputs)).collect();
    for ((at, values), first) in geometries.iter().zip(&first).rev() {
        assert_eq!(&fmu.outputs_at(at, values, &outputs), first);
    }
}

#[test]
fn a_restored_state_goes_on_as_before() {
    let mut fmu = Disturbance::shadowed();
    fmu.start();
    let outputs = fmu.references(Causality::Output);
    let inputs = fmu.references(Causality::Input);
    let (at, values) = Dice(9).inputs(&fmu, false);
    let expected = fmu.outputs_at(&at, &values, &outputs);
    let (status, bytes) = fmu.fmu.state_bytes();
    assert_eq!(status, Status::Ok);
    let mut other = Disturbance::shadowed();
    other.start();
    let (status, state) = other.fmu.deserialize(&bytes);
    assert_eq!(status, Status::Ok);
    assert_eq!(other.fmu.set_state(&state), Status::Ok);
    let mut state: StatePointer = state;
    other.fmu.free_state(&mut state);
    assert_eq!(other.read(&outputs), expected);
    let seed = vec![1.0; inputs.len()];
    assert_eq!(other.slopes(&outputs, &inputs, &seed), fmu.slopes(&outputs, &inputs, &seed));
    other.time_s = 1.0;
    assert_eq!(other.step(), Status::Ok);
    assert_eq!(other.read(&outputs), expected);
}

/// Slopes of every output along every input, against central differences over many geometries.
fn check_slopes(mut fmu: Disturbance, seed: u64, in_shadow: bool) {
    fmu.start();
    let mut dice = Dice(seed);
    let outputs = fmu.references(Causality::Output);
    let mut checked = 0;
    for _ in 0..40 {
        let (inputs, values) = dice.inputs(&fmu, in_shadow);
        // A direction that moves everything by about a thousandth of what matters.
        let scale = |reference: u32| match fmu.name(reference).split('.').next().unwrap() {
            "sun" => 5.8e10,
            "planet" => 2.4e6,
            _ => 1.0,
        };
        let along: Vec<f64> = inputs.iter().map(|at| (dice.next() - 0.5) * scale(*at)).collect();
        let base = fmu.outputs_at(&inputs, &values, &outputs);
        let exact = fmu.slopes(&outputs, &inputs, &along);
        let quotient = |fmu: &mut Disturbance, h: f64| {
            let mut at = |h: f64| {
                let moved: Vec<f64> = values.iter().zip(&along).map(|(v, a)| v + h * a).collect();
                fmu.outputs_at(&inputs, &moved, &outputs)
            };
            let (high, low) = (at(h), at(-h));
            high.iter().zip(low).map(|(high, low)| (high - low) / (2.0 * h)).collect::<Vec<f64>>()
        };
        let h = if in_shadow { 1e-8 } else { 1e-6 };
        let (near, far) = (quotient(&mut fmu, h), quotient(&mut fmu, 2.0 * h));
        // A component may pass through 0: compare with the largest of its vector's neighbours.
        for i in 0..outputs.len() {
            let window = i.saturating_sub(2)..(i + 3).min(outputs.len());
            let size = window.clone().map(|k| exact[k].abs() + base[k].abs()).fold(0.0, f64::max);
            // Away from edges, where the quotients do not depend on the step, and above rounding.
            if (near[i] - far[i]).abs() > 2e-7 * size || size * h < 1e3 * f64::EPSILON * base[i].abs() {
                continue;
            }
            let slope = (4.0 * near[i] - far[i]) / 3.0;
            let allowed = 1e-6 * size + 4.0 * f64::EPSILON * base[i].abs() / h;
            assert!((slope - exact[i]).abs() <= allowed, "output {}: {slope} {}", outputs[i], exact[i]);
            checked += 1;
        }
    }
    assert!(checked > 40 * outputs.len() / 2, "only {checked} slopes could be checked");
}

#[test]
fn directional_derivatives_are_slopes() {
    check_slopes(Disturbance::messenger(), 1, false);
}

#[test]
fn directional_derivatives_with_shadows_are_slopes() {
    check_slopes(Disturbance::shadowed(), 2, false);
}

#[test]
fn directional_derivatives_in_the_penumbra_are_slopes() {
    check_slopes(Disturbance::messenger(), 3, true);
}

/// Over many geometries, in light and penumbra, an output changes with an input only if it says so; and every
/// declared dependency is seen at least once.
#[test]
fn what_depends_is_declared() {
    for make in [Disturbance::messenger, Disturbance::shadowed] {
        let mut fmu = make();
        fmu.start();
        let outputs = fmu.references(Causality::Output);
        let inputs = fmu.references(Causality::Input);
        let reference_of =
            |fmu: &Disturbance, index: u32| fmu.description.variables[index as usize - 1].value_reference;
        let declared: BTreeMap<u32, BTreeSet<u32>> = fmu
            .description
            .structure
            .outputs
            .iter()
            .map(|unknown| {
                let known = unknown.dependencies.as_ref().unwrap();
                let known = known.iter().map(|index| reference_of(&fmu, *index)).collect();
                (reference_of(&fmu, unknown.index), known)
            })
            .collect();
        let mut seen: BTreeMap<u32, BTreeSet<u32>> = BTreeMap::new();
        let mut dice = Dice(77);
        for round in 0..120 {
            let (at, values) = dice.inputs(&fmu, round % 3 == 0);
            fmu.outputs_at(&at, &values, &outputs);
            for known in &inputs {
                let slopes = fmu.slopes(&outputs, &[*known], &[1.0]);
                for (output, slope) in outputs.iter().zip(slopes) {
                    if slope != 0.0 {
                        seen.entry(*output).or_default().insert(*known);
                    }
                }
            }
        }
        for (output, knowns) in &seen {
            for known in knowns {
                let (output_name, known_name) = (fmu.name(*output), fmu.name(*known));
                assert!(declared[output].contains(known), "{output_name} depends on {known_name}");
            }
        }
        let total = fmu.at("torque.total[2]");
        assert_eq!(seen[&total], declared[&total]);
        let lit = fmu.at("sun.litFraction");
        assert_eq!(seen[&lit], declared[&lit]);
    }
}

#[test]
fn derivatives_by_anything_but_inputs_are_refused() {
    let mut fmu = Disturbance::messenger();
    fmu.start();
    let (output, flux) = (fmu.at("force.solar[2]"), fmu.at("solar.flux"));
    let mut result = [0.0];
    assert_eq!(fmu.fmu.get_directional_derivative(&[output], &[flux], &[1.0], &mut result), Status::Error);
}

fn refusal(change: impl FnOnce(&mut Disturbance)) -> String {
    let mut fmu = Disturbance::messenger();
    change(&mut fmu);
    assert_ne!(fmu.fmu.start(0.0, None), Status::Ok);
    fmu.fmu.take_messages().into_iter().map(|Message { text, .. }| text).collect()
}

#[test]
fn impossible_geometries_are_refused_by_name() {
    let inside = refusal(|fmu| fmu.put_vector("planet.position", [1e6, 0.0, 0.0]));
    assert!(inside.contains("planet.position") && inside.contains("radius"), "{inside}");
    let sunless = refusal(|fmu| fmu.put_vector("sun.position", [0.0; 3]));
    assert!(sunless.contains("sun.position"), "{sunless}");
    let dark = refusal(|fmu| fmu.put("planet.emissivity", 0.0));
    assert!(dark.contains("emissivity"), "{dark}");
    let sum = refusal(|fmu| fmu.put("planet.diffuseReflectivity", 0.5));
    assert!(sum.contains("at most 1"), "{sum}");
    let inertia = refusal(|fmu| fmu.put("spacecraft.inertia[1,2]", 900.0));
    assert!(inertia.contains("spacecraft.inertia"), "{inertia}");
}

#[test]
fn without_a_planet_only_sunlight_is_left() {
    let mut fmu = Disturbance::messenger();
    let present = fmu.at("planet.present");
    assert_eq!(fmu.fmu.set_boolean(&[present], &[0]), Status::Ok);
    fmu.put_vector("planet.position", [0.0; 3]);
    fmu.start();
    assert_eq!(fmu.step(), Status::Ok);
    for name in ["force.albedo", "force.infrared", "torque.gravityGradient"] {
        assert_eq!(fmu.vector(name), [0.0; 3]);
    }
    assert!(fmu.vector("force.solar")[1] > 0.0 && fmu.vector("force.thermal")[1] > 0.0);
}

#[test]
fn the_shipped_setup_reads() {
    assert!(DisturbanceTorque::parse_setup("spacecraft.toml", DisturbanceTorque::DEFAULT_SETUP).is_ok());
}
