//! The way through the states, and Reset as the way back to the very beginning.

use client::StatePointer;
use fmi_export::model_description::Status::{Error, Ok};

use super::{all_reals, fresh, only_message, reference, started};

#[test]
fn an_experiment_comes_before_initialization() {
    let (mut instance, _) = fresh("AllTypes");
    assert_eq!(instance.enter_initialization_mode(), Error);
    assert!(only_message(&instance).contains("fmi2SetupExperiment must be called before"));
    assert_eq!(instance.reset(), Ok);
    assert_eq!(instance.start(0.0, None), Ok);
    assert_eq!(instance.reset(), Ok);
    assert_eq!(instance.enter_initialization_mode(), Error);
}

#[test]
fn an_experiment_needs_finite_times_in_order() {
    for (start_s, stop_s) in
        [(f64::NAN, None), (f64::INFINITY, None), (1.0, Some(0.5)), (0.0, Some(f64::INFINITY))]
    {
        let (mut instance, _) = fresh("AllTypes");
        assert_eq!(instance.setup_experiment(start_s, stop_s), Error, "{start_s} {stop_s:?}");
        assert!(only_message(&instance).contains("must"));
    }
    let (mut instance, _) = fresh("AllTypes");
    assert_eq!(instance.setup_experiment(5.0, Some(7.0)), Ok);
    assert_eq!(instance.setup_experiment(-5.0, Some(-5.0)), Ok);
}

#[test]
fn a_forbidden_call_says_what_and_when() {
    let (mut instance, _) = fresh("AllTypes");
    assert_eq!(instance.do_step(0.0, 1.0), Error);
    assert_eq!(
        only_message(&instance),
        "fmi2DoStep: not allowed in the state instantiated, only in: stepComplete"
    );
}

#[test]
fn reset_equals_a_fresh_instance_byte_for_byte() {
    let (mut fresh_one, description) = fresh("AllTypes");
    let (status, fresh_bytes) = fresh_one.state_bytes();
    assert_eq!(status, Ok);
    let input = reference(&description, "input.real");
    let (mut used, _) = started("AllTypes");
    assert_eq!(used.set_real(&[input, reference(&description, "tunable.real")], &[4.0, 5.0]), Ok);
    assert_eq!(used.set_string(&[reference(&description, "input.text")], &[b"used"]), Ok);
    assert_eq!(used.set_input_derivatives(&[input], &[1], &[1.0]), Ok);
    assert_eq!(used.do_step(0.0, 1.0), Ok);
    assert_eq!(used.set_real(&[input], &[6.0]), Ok);
    assert_eq!(used.set_input_derivatives(&[input], &[2], &[1.0]), Ok);
    for ruin in [false, true] {
        if ruin {
            assert_eq!(used.do_step(77.0, 1.0), Error);
        }
        assert_ne!(used.state_bytes().1, fresh_bytes);
        assert_eq!(used.reset(), Ok);
        assert_eq!(used.state_bytes().1, fresh_bytes);
    }
    for instance in [&mut fresh_one, &mut used] {
        assert_eq!(instance.start(0.0, None), Ok);
        for i in 0..5 {
            assert_eq!(instance.do_step(f64::from(i), 1.0), Ok);
        }
    }
    assert_eq!(fresh_one.state_bytes(), used.state_bytes());
    let references = all_reals(&description);
    let mut values = [vec![0.0; references.len()], vec![0.0; references.len()]];
    assert_eq!(fresh_one.get_real(&references, &mut values[0]), Ok);
    assert_eq!(used.get_real(&references, &mut values[1]), Ok);
    assert_eq!(values[0], values[1]);
}

/// What was switched off, said once or promised in one run has no meaning for the next.
#[test]
fn reset_forgets_what_was_logged_and_returned() {
    let (mut instance, description) = fresh("AllTypes");
    let input = [reference(&description, "input.real")];
    assert_eq!(instance.set_real(&input, &[1.0]), Ok);
    assert!(only_message(&instance).contains("before Initialization Mode"));
    assert_eq!(instance.set_real(&input, &[2.0]), Ok);
    assert!(instance.drain_messages().is_empty());
    assert_eq!(instance.set_debug_logging(false, &[]), Ok);
    assert_eq!(instance.start(0.0, None), Ok);
    for i in 0..3 {
        assert_eq!(instance.do_step_without_return(f64::from(i), 1.0), Ok);
    }
    assert_eq!(instance.reset(), Ok);
    assert_eq!(instance.set_real(&input, &[1.0]), Ok);
    assert!(only_message(&instance).contains("before Initialization Mode"));
    assert_eq!(instance.start(0.0, None), Ok);
    let mut state = StatePointer::null();
    assert_eq!(instance.get_state(&mut state), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.set_state(&state), Ok);
    assert!(instance.drain_messages().is_empty());
}
