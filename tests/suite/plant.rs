//! The plant at the limits of its parameters and times.

use client::NamedInstance;
use model_description::BaseType;

use crate::support::{fresh, library, names, ok, real_bits};

fn plant() -> NamedInstance {
    NamedInstance::from_library(library("MomentumPlant"), "MomentumPlant")
}

#[test]
fn every_rising_edge_of_the_request_dumps_once() {
    let mut plant = plant();
    plant.put_vector("dump.threshold", [1e6; 3]);
    plant.begin(0.0);
    let mut expected = 0;
    for (step, (on, rises)) in
        [(0, 0), (1, 1), (1, 0), (0, 0), (1, 1), (0, 0), (0, 0), (1, 1), (1, 0)].into_iter().enumerate()
    {
        plant.put_boolean("dump.request", on == 1);
        plant.step_to(60.0 * (step + 1) as f64);
        expected += rises;
        assert_eq!(plant.integer("dump.count"), expected, "step {step}");
    }
}

/// Start times are any finite value (DESIGN 4.4); late ones are further apart than the solver's step.
#[test]
fn steps_end_at_any_start_time() {
    for start_s in [-1e9, -0.3, 1e12, 1e17, 1e20] {
        let mut plant = plant();
        plant.begin(start_s);
        let step_s = 600.0_f64.max(start_s * 1e-15);
        ok(plant.try_step(step_s));
        let (status, reached_s) = plant.fmu.last_successful_time();
        ok(status);
        assert_eq!(reached_s, start_s + step_s);
    }
}

/// A torque that no spacecraft ever met costs no more steps than a small one.
#[test]
fn huge_torques_and_momenta_do_not_stall_the_solver() {
    for size in [1e3_f64, 1e9, 1e90] {
        let mut plant = plant();
        // As far as the parameter goes.
        plant.put_vector("start.momentum", [size.min(1e12); 3]);
        plant.put_vector("dump.threshold", [1e100; 3]);
        plant.put_vector("torque.applied", [size, -size, size]);
        plant.begin(0.0);
        for step in 1..=20 {
            plant.step_to(600.0 * f64::from(step));
        }
        let momentum = plant.vector("momentum.inertial");
        assert!(momentum.iter().all(|it| it.is_finite()), "{momentum:?}");
    }
}

/// Reading does not move the plant, and neither does setting what is set already (DESIGN 4.4).
#[test]
fn reading_and_setting_the_same_change_no_bit() {
    let names = names("MomentumPlant");
    let reals = names.all(BaseType::Real);
    let mut plain = fresh("MomentumPlant");
    let mut read = fresh("MomentumPlant");
    ok(plain.start(0.0, None));
    ok(read.start(0.0, None));
    let torque = names.vector::<3>("torque.applied");
    let tunable = names.vector::<3>("spacecraft.centerOfMass");
    for step in 0..200 {
        let at_s = 600.0 * f64::from(step);
        ok(plain.do_step(at_s, 600.0));
        // The same simulation, cut at odd places.
        ok(read.set_real(&torque, &[0.0; 3]));
        ok(read.do_step(at_s, 100.0));
        let _ = real_bits(&mut read, reals);
        let mut center = [0.0; 3];
        ok(read.get_real(&tunable, &mut center));
        ok(read.set_real(&tunable, &center));
        ok(read.do_step(at_s + 100.0, 7.0));
        let _ = read.state_bytes();
        ok(read.do_step(at_s + 107.0, 493.0));
        assert_eq!(real_bits(&mut plain, reals), real_bits(&mut read, reals), "step {step}");
    }
}
