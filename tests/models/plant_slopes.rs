//! MomentumPlant's output derivatives are the slopes of its outputs, and its accelerations those of its velocities.

use client::{NamedInstance, StatePointer};
use fmi_export::fmi2::entry;
use fmi_export::{Library, Status};
use models::{Guidance, MomentumPlant};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

static LIBRARY: Library = Library { entries: &[entry::<MomentumPlant>(), entry::<Guidance>()] };

fn momentum_plant() -> NamedInstance {
    NamedInstance::from_library(&LIBRARY, "MomentumPlant")
}

fn vector(plant: &mut NamedInstance, name: &str) -> Vector3<f64> {
    plant.vector(name).into()
}

#[test]
fn output_derivatives_are_the_slopes_of_the_outputs() {
    for convention in [1, 2] {
        let mut plant = momentum_plant();
        plant.put_integer("attitude.source", 2);
        plant.put_integer("momentum.convention", convention);
        plant.put_vector("command.q", [0.5, -0.1, 0.7, 0.5]);
        plant.put_vector("command.rate", [1e-3, -2e-3, 5e-4]);
        plant.put_vector("start.momentum", [0.5, -1.0, 2.0]);
        plant.put_vector("dump.threshold", [1e6; 3]);
        plant.put_vector("torque.applied", [0.02, -0.01, 0.03]);
        plant.put_vector("force.applied", [0.3, -0.1, 0.2]);
        assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
        assert_eq!(plant.fmu.do_step(0.0, 600.0), Status::Ok);
        let names = ["momentum.body", "momentum.inertial", "deltaV", "position"];
        let off = slopes_off(&mut plant, &names, 600.0, 5.0);
        assert!(off < 1e-6, "{convention}: {off:e}");
    }
}

/// Largest share by which the slopes of outputs at the present time are off the differences over steps of `h_s` from
/// there, one-sided, of the fourth order.
fn slopes_off(plant: &mut NamedInstance, names: &[&str], from_s: f64, h_s: f64) -> f64 {
    let read = |plant: &mut NamedInstance| -> Vec<Vec<f64>> {
        names.iter().map(|name| components(name).iter().map(|name| plant.real(name)).collect()).collect()
    };
    let slopes: Vec<Vec<f64>> = names
        .iter()
        .map(|name| {
            let at: Vec<_> = components(name).iter().map(|name| plant.find(name).unwrap()).collect();
            let mut slopes = vec![0.0; at.len()];
            let status = plant.fmu.get_output_derivatives(&at, &vec![1; at.len()], &mut slopes);
            plant.ok(name, status);
            slopes
        })
        .collect();
    let mut state = StatePointer::null();
    assert_eq!(plant.fmu.get_state(&mut state), Status::Ok);
    let at = [0.0, 1.0, 2.0, 3.0, 4.0].map(|k| {
        assert_eq!(plant.fmu.set_state(&state), Status::Ok);
        if k > 0.0 {
            assert_eq!(plant.fmu.do_step(from_s, k * h_s), Status::Ok);
        }
        read(plant)
    });
    assert_eq!(plant.fmu.set_state(&state), Status::Ok);
    plant.fmu.free_state(&mut state);
    let mut worst = 0.0_f64;
    for (i, slopes) in slopes.iter().enumerate() {
        let weights = [-25.0, 48.0, -36.0, 16.0, -3.0];
        let expected = (0..slopes.len()).map(|element| {
            let sum: f64 = (0..5).map(|k| weights[k] * at[k][i][element]).sum();
            sum / (12.0 * h_s)
        });
        let expected: Vec<f64> = expected.collect();
        let norm = |vector: &mut dyn Iterator<Item = f64>| vector.map(|x| x * x).sum::<f64>().sqrt();
        let off = norm(&mut slopes.iter().zip(&expected).map(|(a, b)| a - b));
        let share = off / norm(&mut expected.iter().copied());
        println!("{}: {slopes:?} {expected:?} {share:e}", names[i]);
        worst = worst.max(share);
    }
    worst
}

fn components(name: &str) -> Vec<String> {
    let count = if name.ends_with(".q") { 4 } else { 3 };
    (1..=count).map(|i| format!("{name}[{i}]")).collect()
}

/// After 4 rad the scalar is negative.
#[test]
fn slopes_of_quaternions_have_their_sign() {
    let mut plant = momentum_plant();
    plant.put_integer("attitude.source", 2);
    plant.put_vector("command.rate", [0.0, 0.0, 0.02]);
    assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
    assert_eq!(plant.fmu.do_step(0.0, 200.0), Status::Ok);
    assert!((plant.real("attitude.q[4]") - 2.0_f64.cos()).abs() < 1e-12);
    let off = slopes_off(&mut plant, &["attitude.q"], 200.0, 0.05);
    assert!(off < 1e-9, "{off:e}");
}

#[test]
fn slopes_hold_in_every_source_of_attitude_and_during_a_dump() {
    let names = ["attitude.q", "momentum.body", "momentum.inertial", "deltaV"];
    for source in 2..=4 {
        let mut plant = momentum_plant();
        plant.put_integer("attitude.source", source);
        plant.put_vector("start.rate", [2e-3, -1e-3, 3e-3]);
        plant.put_vector("command.rate", [1e-3, -2e-3, 5e-4]);
        plant.put_vector("dump.threshold", [1e6; 3]);
        plant.put_vector("torque.applied", [0.02, -0.01, 0.03]);
        plant.put_vector("force.applied", [0.3, -0.1, 0.2]);
        plant.put("dump.torque", 0.02);
        // Differences lie between two samples and within an interval of disturbances.
        plant.put("control.rate", 2.0);
        plant.put("control.bandwidth", 0.02);
        assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
        assert_eq!(plant.fmu.do_step(0.0, 30.2), Status::Ok);
        let off = slopes_off(&mut plant, &names, 30.2, 0.05);
        assert!(off < 1e-9, "{source}: {off:e}");
        plant.put_vector("dump.target", [5.0, 3.0, -4.0]);
        plant.put_boolean("dump.request", true);
        assert_eq!(plant.fmu.do_step(30.2, 1.0), Status::Ok);
        assert_eq!(plant.boolean("dump.active"), source > 2);
        let off = slopes_off(&mut plant, &names, 31.2, 0.05);
        assert!(off < 1e-9, "{source}, dumping: {off:e}");
    }
}

#[test]
fn the_inertial_force_is_the_bodys_turned_and_moves_the_mass() {
    let mut plant = momentum_plant();
    plant.put_integer("attitude.source", 2);
    plant.put_vector("command.q", [0.5, -0.1, 0.7, 0.5]);
    plant.put_vector("force.applied", [0.3, -0.1, 0.2]);
    assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
    assert_eq!(plant.fmu.do_step(0.0, 60.0), Status::Ok);
    let [x, y, z, w] = plant.array("attitude.q");
    let turn = UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z));
    let expected = turn * vector(&mut plant, "force.total");
    let found = vector(&mut plant, "force.inertial");
    assert!((found - expected).norm() < 1e-14 && found.norm() > 0.3, "{found} {expected}");
    let mass_kg = plant.real("mass");
    assert!((vector(&mut plant, "acceleration") * mass_kg - found).norm() < 1e-14);
}

/// A force that rises acts alone: F t + F' t^2 / 2 over the mass, and the slope is for one step only.
#[test]
fn a_force_with_a_slope_is_integrated() {
    let mut plant = momentum_plant();
    plant.put_integer("attitude.source", 2);
    plant.put("solar.flux", 0.0);
    plant.put_vector("force.applied", [0.3, -0.1, 0.2]);
    assert_eq!(plant.fmu.start(0.0, None), Status::Ok);
    let at = plant.elements::<3>("force.applied");
    assert_eq!(plant.fmu.set_input_derivatives(&at, &[1; 3], &[1e-3, 2e-3, -3e-3]), Status::Ok);
    let mass_kg = plant.real("mass");
    let (force_n, slope_n_s) = (Vector3::new(0.3, -0.1, 0.2), Vector3::new(1e-3, 2e-3, -3e-3));
    assert_eq!(plant.fmu.do_step(0.0, 100.0), Status::Ok);
    let first = (force_n * 100.0 + slope_n_s * 5000.0) / mass_kg;
    assert!(
        (vector(&mut plant, "deltaV") - first).norm() < 1e-9 * first.norm(),
        "{}",
        vector(&mut plant, "deltaV")
    );
    assert_eq!(plant.fmu.do_step(100.0, 100.0), Status::Ok);
    let both = first + force_n * 100.0 / mass_kg;
    assert!(
        (vector(&mut plant, "deltaV") - both).norm() < 1e-9 * both.norm(),
        "{}",
        vector(&mut plant, "deltaV")
    );
}
