//! Steps end where they should, whatever roundings the master's clock has; wrong times are errors.

use client::StatePointer;
use fmi_export::model_description::Status::{Discard, Error, Ok, Warning};

use fmi_export::Enumeration;
use probe::panicking::Fault;

use super::{fresh, only_message, real, reference, started};

#[test]
fn jitter_within_roundings_is_taken_and_a_wrong_time_is_not() {
    let (mut instance, description) = started("Empty");
    let clock = reference(&description, "clock");
    let h = 1.0 / 60.0;
    let mut sum = 0.0;
    for i in 0..600 {
        let product = f64::from(i) * h;
        let point = if i % 2 == 0 { product } else { sum };
        assert_eq!(instance.do_step(point, h), Ok);
        assert_eq!(real(&mut instance, clock), point + h);
        sum += h;
    }
    assert_eq!(instance.do_step(10.0 + h, h), Error);
    let text = only_message(&instance);
    assert!(text.contains(&format!("begins at {:?} s", 10.0 + h)), "{text}");
}

#[test]
fn step_sizes_must_be_positive_and_move_the_time() {
    for (time_s, step_s) in [(0.0, 0.0), (0.0, -1.0), (0.0, f64::NAN), (0.0, f64::INFINITY), (1e9, 1e-9)] {
        let (mut instance, _) = fresh("Empty");
        assert_eq!(instance.start(time_s, None), Ok);
        assert_eq!(instance.do_step(time_s, step_s), Error, "{step_s}");
        assert!(only_message(&instance).contains("step size"));
    }
    let (mut instance, _) = started("Empty");
    assert_eq!(instance.do_step(f64::NAN, 1.0), Error);
}

#[test]
fn a_step_past_the_stop_time_is_an_error() {
    let (mut instance, _) = fresh("Empty");
    assert_eq!(instance.start(0.0, Some(0.3)), Ok);
    // 0.1 + 0.1 + 0.1 rounds to just above 0.3.
    let mut time = 0.0;
    for _ in 0..3 {
        assert_eq!(instance.do_step(time, 0.1), Ok);
        time += 0.1;
    }
    assert!(time > 0.3);
    assert_eq!(instance.do_step(time, 0.1), Error);
    assert!(only_message(&instance).contains("after the stop time 0.3 s"));
}

#[test]
fn a_model_that_ends_by_itself_answers_discard_with_terminated() {
    let (mut instance, description) = started("Panicking");
    let fault = [reference(&description, "fault")];
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!((instance.terminated(), instance.last_successful_time()), ((Ok, false), (Ok, 1.0)));
    let terminate = probe::panicking::Fault::TerminateStep as i32 + 1;
    assert_eq!(instance.set_integer(&fault, &[terminate]), Ok);
    assert_eq!(instance.do_step(1.0, 1.0), Discard);
    assert!(only_message(&instance).contains("the model ends here"));
    assert_eq!((instance.terminated(), instance.last_successful_time()), ((Ok, true), (Ok, 1.0)));
    assert_eq!(instance.get_real(&[reference(&description, "clock")], &mut [0.0]), Ok);
    assert_eq!(instance.terminate(), Ok);
}

#[test]
fn a_status_that_only_a_pending_step_has_is_discarded() {
    let (mut instance, _) = started("Empty");
    for kind in [0, 1, 2, 3, 4, -1, i32::MAX] {
        assert_eq!(instance.get_status(kind), Discard);
    }
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.cancel_step(), Error);
}

#[test]
fn going_back_behind_a_promise_is_warned_about_and_works() {
    let (mut instance, _) = started("AllTypes");
    let mut state = StatePointer::null();
    assert_eq!(instance.get_state(&mut state), Ok);
    for i in 0..3 {
        assert_eq!(instance.do_step_without_return(f64::from(i), 1.0), Ok);
    }
    for _ in 0..2 {
        assert_eq!(instance.set_state(&state), Ok);
    }
    let messages = instance.drain_messages();
    assert_eq!(messages.len(), 1);
    assert_eq!(messages[0].status, Warning);
    assert!(messages[0].text.contains("noSetFMUStatePriorToCurrentPoint"));
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
}

/// The promise is about times before the point at which it is given, not before the step's end.
#[test]
fn going_back_to_the_point_of_a_promise_keeps_it() {
    let (mut instance, _) = started("AllTypes");
    assert_eq!(instance.do_step_without_return(0.0, 1.0), Ok);
    let mut state = StatePointer::null();
    assert_eq!(instance.get_state(&mut state), Ok);
    assert_eq!(instance.do_step_without_return(1.0, 1.0), Ok);
    assert_eq!(instance.set_state(&state), Ok);
    assert!(instance.drain_messages().is_empty());
    assert_eq!(instance.do_step_without_return(1.0, 0.5), Ok);
}

/// A clock of milliseconds far from its zero: two sums of the same steps differ by more than any share of a step.
#[test]
fn roundings_of_late_times_are_taken() {
    for start_s in [1e9, -1e9, 1e11_f64] {
        let (mut instance, _) = fresh("Empty");
        assert_eq!(instance.start(start_s, None), Ok);
        let (h, mut time_s) = (1e-3, start_s);
        for i in 1..=50 {
            let at = if i % 2 == 0 { time_s.next_up() } else { time_s.next_down() };
            assert_eq!(instance.do_step(if i == 1 { time_s } else { at }, h), Ok, "{start_s} {i}");
            assert_eq!(instance.last_successful_time().0, Ok);
            time_s = instance.last_successful_time().1;
        }
    }
}

/// FMI 2.0 has no step that ends early without ending the simulation.
#[test]
fn a_step_that_the_model_leaves_early_goes_on_to_its_end() {
    let (mut instance, description) = started("Panicking");
    let [fault, input, output, clock] =
        ["fault", "input", "output", "clock"].map(|name| reference(&description, name));
    assert_eq!(instance.set_integer(&[fault], &[Fault::StepShort.value()]), Ok);
    assert_eq!(instance.set_real(&[input], &[2.0]), Ok);
    assert_eq!(instance.set_input_derivatives(&[input], &[1], &[3.0]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!((real(&mut instance, clock), real(&mut instance, output)), (1.0, 5.0));
    assert_eq!(instance.set_integer(&[fault], &[Fault::StepStill.value()]), Ok);
    instance.drain_messages();
    assert_eq!(instance.do_step(1.0, 1.0), Error);
    let text = only_message(&instance);
    assert!(text.contains("from 1.0 to 2.0 s at 1.0 s"), "{text}");
}
