//! The plant at the edges of what a master may ask for.

use client::InProcess;

use crate::support::{Base, Names, fresh, names, ok, real_bits, silent};

fn integer(instance: &mut InProcess, names: &Names, name: &str) -> i32 {
    let mut value = [0];
    ok(instance.get_integer(&[names.of(Base::Integer, name)], &mut value));
    value[0]
}

#[test]
fn every_rising_edge_of_the_request_dumps_once() {
    let names = names("MomentumPlant");
    let mut instance = silent("MomentumPlant");
    ok(instance.set_real(&names.vector::<3>("dump.threshold"), &[1e6; 3]));
    ok(instance.start(0.0, None));
    let request = names.of(Base::Boolean, "dump.request");
    let mut expected = 0;
    for (step, (on, rises)) in
        [(0, 0), (1, 1), (1, 0), (0, 0), (1, 1), (0, 0), (0, 0), (1, 1), (1, 0)].into_iter().enumerate()
    {
        ok(instance.set_boolean(&[request], &[on]));
        ok(instance.do_step(60.0 * step as f64, 60.0));
        expected += rises;
        assert_eq!(integer(&mut instance, &names, "dump.count"), expected, "step {step}");
    }
}

/// Start times are any finite value (DESIGN 4.4); late ones are further apart than the solver's step.
#[test]
fn steps_end_at_any_start_time() {
    for start_s in [-1e9, -0.3, 1e12, 1e17, 1e20] {
        let mut instance = silent("MomentumPlant");
        ok(instance.start(start_s, None));
        let step_s = 600.0_f64.max(start_s * 1e-15);
        ok(instance.do_step(start_s, step_s));
        let (status, reached_s) = instance.last_successful_time();
        ok(status);
        assert_eq!(reached_s, start_s + step_s);
    }
}

/// A torque that no spacecraft ever met costs no more steps than a small one.
#[test]
fn huge_torques_and_momenta_do_not_stall_the_solver() {
    let names = names("MomentumPlant");
    for size in [1e3_f64, 1e9, 1e150] {
        let mut instance = silent("MomentumPlant");
        // As far as the parameter goes.
        ok(instance.set_real(&names.vector::<3>("start.momentum"), &[size.min(1e12); 3]));
        ok(instance.set_real(&names.vector::<3>("dump.threshold"), &[1e300; 3]));
        ok(instance.set_real(&names.vector::<3>("torque.applied"), &[size, -size, size]));
        ok(instance.start(0.0, None));
        for step in 0..20 {
            ok(instance.do_step(600.0 * f64::from(step), 600.0));
        }
        let mut momentum = [0.0; 3];
        ok(instance.get_real(&names.vector::<3>("momentum.inertial"), &mut momentum));
        assert!(momentum.iter().all(|it| it.is_finite()), "{momentum:?}");
    }
}

/// Reading does not move the plant, and neither does setting what is set already (DESIGN 4.4).
#[test]
fn looking_and_setting_the_same_change_no_bit() {
    let names = names("MomentumPlant");
    let reals = names.all(Base::Real);
    let mut plain = fresh("MomentumPlant");
    let mut watched = fresh("MomentumPlant");
    ok(plain.start(0.0, None));
    ok(watched.start(0.0, None));
    let torque = names.vector::<3>("torque.applied");
    let tunable = names.vector::<3>("spacecraft.centerOfMass");
    for step in 0..200 {
        let at_s = 600.0 * f64::from(step);
        ok(plain.do_step(at_s, 600.0));
        // The same simulation, cut at odd places.
        ok(watched.set_real(&torque, &[0.0; 3]));
        ok(watched.do_step(at_s, 100.0));
        let _ = real_bits(&mut watched, &reals);
        let mut center = [0.0; 3];
        ok(watched.get_real(&tunable, &mut center));
        ok(watched.set_real(&tunable, &center));
        ok(watched.do_step(at_s + 100.0, 7.0));
        let _ = watched.state_bytes();
        ok(watched.do_step(at_s + 107.0, 493.0));
        assert_eq!(real_bits(&mut plain, &reals), real_bits(&mut watched, &reals), "step {step}");
    }
}
