//! MomentumPlant's output derivatives are the slopes of its outputs, and its accelerations those of its velocities.

use std::collections::HashMap;

use client::{InProcess, StatePointer};
use fmi_export::{Entry, Library, Status};
use models::MomentumPlant;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

static LIBRARY: Library = Library { entries: &[Entry::of::<MomentumPlant>()] };

struct Flown {
    fmu: InProcess,
    names: HashMap<String, u32>,
}

impl Flown {
    fn new() -> Self {
        let variables = LIBRARY.find("MomentumPlant").unwrap().describe(None, None).unwrap().variables;
        let names = variables.into_iter().map(|it| (it.name, it.value_reference)).collect();
        Self { fmu: InProcess::of(&LIBRARY, "MomentumPlant").unwrap(), names }
    }

    fn at<const N: usize>(&self, name: &str) -> [u32; N] {
        std::array::from_fn(|i| self.names[&format!("{name}[{}]", i + 1)])
    }

    fn set<const N: usize>(&mut self, name: &str, values: [f64; N]) {
        let at = self.at::<N>(name);
        assert_eq!(self.fmu.set_real(&at, &values), Status::Ok, "{name}");
    }

    fn choose(&mut self, name: &str, item: i32) {
        assert_eq!(self.fmu.set_integer(&[self.names[name]], &[item]), Status::Ok, "{name}");
    }

    fn get<const N: usize>(&mut self, name: &str) -> [f64; N] {
        let mut values = [0.0; N];
        let at = self.at::<N>(name);
        assert_eq!(self.fmu.get_real(&at, &mut values), Status::Ok, "{name}");
        values
    }

    fn vector(&mut self, name: &str) -> Vector3<f64> {
        self.get::<3>(name).into()
    }

    fn slope(&mut self, name: &str) -> Vector3<f64> {
        let mut slopes = [0.0; 3];
        let at = self.at::<3>(name);
        assert_eq!(self.fmu.get_output_derivatives(&at, &[1; 3], &mut slopes), Status::Ok, "{name}");
        slopes.into()
    }
}

const NAMES: [&str; 4] = ["momentum.body", "momentum.inertial", "deltaV", "position"];

#[test]
fn output_derivatives_are_the_slopes_of_the_outputs() {
    for convention in [1, 2] {
        let mut plant = Flown::new();
        plant.choose("attitude.source", 2);
        plant.choose("momentum.convention", convention);
        plant.set("command.q", [0.5, -0.1, 0.7, 0.5]);
        plant.set("command.rate", [1e-3, -2e-3, 5e-4]);
        plant.set("start.momentum", [0.5, -1.0, 2.0]);
        plant.set("dump.threshold", [1e6; 3]);
        plant.set("torque.applied", [0.02, -0.01, 0.03]);
        plant.set("force.applied", [0.3, -0.1, 0.2]);
        assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
        let from_s = 600.0;
        assert_eq!(plant.fmu.do_step(0.0, from_s), Status::Ok);
        let slopes = NAMES.map(|name| plant.slope(name));
        let first = NAMES.map(|name| plant.vector(name));
        let mut state = StatePointer::null();
        assert_eq!(plant.fmu.get_state(&mut state), Status::Ok);
        let h_s = 5.0;
        let [y1, y2, y3, y4] = [1.0, 2.0, 3.0, 4.0].map(|k| {
            assert_eq!(plant.fmu.set_state(&state), Status::Ok);
            assert_eq!(plant.fmu.do_step(from_s, k * h_s), Status::Ok);
            NAMES.map(|name| plant.vector(name))
        });
        for (i, name) in NAMES.iter().enumerate() {
            // One-sided differences of the fourth order.
            let sum = first[i] * -25.0 + y1[i] * 48.0 - y2[i] * 36.0 + y3[i] * 16.0 - y4[i] * 3.0;
            let expected = sum / (12.0 * h_s);
            let apart = (slopes[i] - expected).norm() / expected.norm();
            assert!(apart < 1e-6, "{convention} {name}: {} {expected} {apart:e}", slopes[i]);
        }
        plant.fmu.free_state(&mut state);
    }
}

#[test]
fn the_inertial_force_is_the_bodys_turned_and_moves_the_mass() {
    let mut plant = Flown::new();
    plant.choose("attitude.source", 2);
    plant.set("command.q", [0.5, -0.1, 0.7, 0.5]);
    plant.set("force.applied", [0.3, -0.1, 0.2]);
    assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
    assert_eq!(plant.fmu.do_step(0.0, 60.0), Status::Ok);
    let [x, y, z, w] = plant.get("attitude.q");
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let expected = turn * plant.vector("force.total");
    let found = plant.vector("force.inertial");
    assert!((found - expected).norm() < 1e-14 && found.norm() > 0.3, "{found} {expected}");
    let mut mass_kg = [0.0];
    let at = plant.names["mass"];
    assert_eq!(plant.fmu.get_real(&[at], &mut mass_kg), Status::Ok);
    assert!((plant.vector("acceleration") * mass_kg[0] - found).norm() < 1e-14);
}

/// Nothing acts but a force that rises: F t + F' t^2 / 2 over the mass, and the slope is for one step only.
#[test]
fn a_force_with_a_slope_is_integrated() {
    let mut plant = Flown::new();
    plant.choose("attitude.source", 2);
    let at = plant.names["solar.flux"];
    assert_eq!(plant.fmu.set_real(&[at], &[0.0]), Status::Ok);
    plant.set("force.applied", [0.3, -0.1, 0.2]);
    assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
    let at = plant.at::<3>("force.applied");
    assert_eq!(plant.fmu.set_input_derivatives(&at, &[1; 3], &[1e-3, 2e-3, -3e-3]), Status::Ok);
    let mut mass_kg = [0.0];
    let mass = plant.names["mass"];
    assert_eq!(plant.fmu.get_real(&[mass], &mut mass_kg), Status::Ok);
    let (force_n, slope_n_s) = (Vector3::new(0.3, -0.1, 0.2), Vector3::new(1e-3, 2e-3, -3e-3));
    assert_eq!(plant.fmu.do_step(0.0, 100.0), Status::Ok);
    let first = (force_n * 100.0 + slope_n_s * 5000.0) / mass_kg[0];
    assert!((plant.vector("deltaV") - first).norm() < 1e-9 * first.norm(), "{}", plant.vector("deltaV"));
    assert_eq!(plant.fmu.do_step(100.0, 100.0), Status::Ok);
    let both = first + force_n * 100.0 / mass_kg[0];
    assert!((plant.vector("deltaV") - both).norm() < 1e-9 * both.norm(), "{}", plant.vector("deltaV"));
}
