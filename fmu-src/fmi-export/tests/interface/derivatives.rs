//! Input derivatives are a Taylor polynomial for exactly one step; output derivatives belong to its end.

use fmi_export::fmi2::MAX_INPUT_DERIVATIVE_ORDER;
use fmi_export::model_description::Status::{Discard, Error, Ok, Warning};

use super::{fresh, only_message, real, reference, started};

#[test]
fn inputs_follow_their_polynomial_for_one_step() {
    let (mut instance, description) = started("AllTypes");
    let at = |name| reference(&description, name);
    let (input, output, integral) = (at("input.real"), at("output.real"), at("output.integral"));
    // The order of set and set-derivatives does not matter; the last of two for the same order counts.
    assert_eq!(instance.set_input_derivatives(&[input, input, input], &[1, 3, 1], &[99.0, 6.0, 2.0]), Ok);
    assert_eq!(instance.set_real(&[input], &[1.0]), Ok);
    assert_eq!(instance.do_step(0.0, 2.0), Ok);
    // u = 1 + 2 t + t^3 at t = 2, its slope 2 + 3 t^2, its integral t + t^2 + t^4 / 4
    assert_eq!(real(&mut instance, output), 13.0);
    let mut slope = [f64::NAN; 2];
    assert_eq!(instance.get_output_derivatives(&[output, integral], &[1, 1], &mut slope), Ok);
    assert_eq!(slope, [14.0, 13.0]);
    assert!((real(&mut instance, integral) - 10.0).abs() < 1e-14);
    assert_eq!(instance.do_step(2.0, 1.0), Ok);
    assert_eq!(real(&mut instance, output), 1.0);
    assert!((real(&mut instance, integral) - 11.0).abs() < 1e-14);
}

#[test]
fn derivatives_may_be_given_before_the_first_step() {
    let (mut instance, description) = fresh("AllTypes");
    let input = reference(&description, "input.real");
    assert_eq!(instance.set_input_derivatives(&[input], &[1], &[3.0]), Ok);
    assert_eq!(instance.start(0.0, None), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(real(&mut instance, reference(&description, "output.real")), 3.0);
}

#[test]
fn wrong_orders_and_variables_are_refused() {
    let largest = MAX_INPUT_DERIVATIVE_ORDER as i32;
    for (name, order, value, status, word) in [
        ("input.real", 0, 1.0, Error, "order is 0, allowed are 1 to 170"),
        ("input.real", -1, 1.0, Error, "order is -1"),
        ("input.real", largest + 1, 1.0, Error, "order is 171"),
        ("input.real", i32::MAX, 1.0, Error, "order is"),
        ("input.real", largest, 1.0, Ok, ""),
        ("input.real", 1, f64::NAN, Discard, "-1e100 to 1e100"),
        ("input.real", 2, -1.1e100, Discard, "-1e100 to 1e100"),
        ("input.discreteReal", 1, 1.0, Error, "is no continuous Real input"),
        ("tunable.real", 1, 1.0, Error, "is no continuous Real input"),
    ] {
        let (mut instance, description) = started("AllTypes");
        let references = [reference(&description, name)];
        assert_eq!(instance.set_input_derivatives(&references, &[order], &[value]), status, "{name} {order}");
        if status != Ok {
            let text = only_message(&instance);
            assert!(text.contains(word), "{text}");
        }
        assert_eq!(instance.do_step(0.0, 1.0) == Ok, status != Error);
    }
    for (name, order) in [("output.real", 0), ("output.real", -1), ("input.real", 1)] {
        let (mut instance, description) = started("AllTypes");
        let references = [reference(&description, name)];
        assert_eq!(
            instance.get_output_derivatives(&references, &[order], &mut [0.0]),
            Error,
            "{name} {order}"
        );
    }
}

#[test]
fn output_derivatives_beyond_the_declared_order_are_zero_with_a_warning() {
    let (mut instance, description) = started("AllTypes");
    assert_eq!(description.co_simulation.as_ref().unwrap().max_output_derivative_order, 1);
    let output = reference(&description, "output.real");
    let mut values = [f64::NAN; 2];
    assert_eq!(instance.get_output_derivatives(&[output; 2], &[2, 1], &mut values), Warning);
    assert!(values[0] == 0.0 && values[1].is_finite(), "{values:?}");
    assert!(only_message(&instance).contains("order 2 are answered with 0: maxOutputDerivativeOrder is 1"));
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
}

#[test]
fn directional_derivatives_belong_to_the_last_step_too() {
    let (mut instance, description) = started("AllTypes");
    let at = |name| reference(&description, name);
    let (unknowns, knowns) = ([at("channel[2].output"), at("output.real")], [at("channel[2].input")]);
    let mut result = [f64::NAN; 2];
    assert_eq!(instance.get_directional_derivative(&unknowns, &knowns, &[2.0], &mut result), Ok);
    assert_eq!(result, [-6.0, 0.0]);
    assert_eq!(instance.get_directional_derivative(&knowns, &unknowns, &[1.0, 1.0], &mut result), Error);
    assert!(only_message(&instance).contains("`channel[2].input`"));
    let (mut empty, description) = started("Empty");
    let clock = [reference(&description, "clock")];
    assert_eq!(empty.get_directional_derivative(&clock, &[], &[], &mut [0.0]), Error);
    assert!(only_message(&empty).contains("no directional derivatives"));
}
