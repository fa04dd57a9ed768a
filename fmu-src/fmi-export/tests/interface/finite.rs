//! Nothing that is no finite number is answered under OK: AllTypes multiplies what it is given, also beyond what a Real
//! can hold.

use fmi_export::model_description::Status::{Error, Ok};

use super::{fresh, only_message, reference, started};

const GAIN: &str = "channel[1].gain";
const INPUT: &str = "channel[1].input";
const OUTPUT: &str = "channel[1].output";

#[test]
fn a_step_to_infinity_is_an_error_that_names_the_output() {
    let (mut instance, description) = started("AllTypes");
    let at = |name| reference(&description, name);
    assert_eq!(instance.set_real(&[at(GAIN), at(INPUT)], &[1e300, 1e300]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Error);
    let text = only_message(&instance);
    assert!(text.contains("fmi2DoStep: `channel[1].output`") && text.contains("inf"), "{text}");
    assert!(text.contains("channel[1].input = 1e300"), "{text}");
    // A reset brings the instance back.
    assert_eq!(instance.reset(), Ok);
    assert_eq!(instance.start(0.0, None), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
}

#[test]
fn an_initialization_to_infinity_is_an_error_wherever_it_is_met() {
    for read_first in [false, true] {
        let (mut instance, description) = fresh("AllTypes");
        let at = |name| reference(&description, name);
        assert_eq!(instance.set_real(&[at(GAIN)], &[1e300]), Ok);
        assert_eq!(instance.setup_experiment(0.0, None), Ok);
        assert_eq!(instance.enter_initialization_mode(), Ok);
        assert_eq!(instance.set_real(&[at(INPUT)], &[-1e300]), Ok);
        let status = match read_first {
            true => instance.get_real(&[at(OUTPUT)], &mut [0.0]),
            false => instance.exit_initialization_mode(),
        };
        assert_eq!(status, Error);
        let text = only_message(&instance);
        assert!(text.contains("`channel[1].output`") && text.contains("-inf"), "{text}");
    }
}

#[test]
fn derivatives_are_finite_too() {
    let (mut instance, description) = started("AllTypes");
    let at = |name| reference(&description, name);
    assert_eq!(instance.set_real(&[at(GAIN)], &[1e300]), Ok);
    assert_eq!(instance.set_input_derivatives(&[at(INPUT)], &[1], &[1e9]), Ok);
    assert_eq!(instance.do_step(0.0, 1e-9), Ok);
    assert_eq!(instance.get_output_derivatives(&[at(OUTPUT)], &[1], &mut [0.0]), Error);
    let text = only_message(&instance);
    assert!(text.contains("derivative of `channel[1].output`") && text.contains("inf"), "{text}");

    let (mut instance, _) = started("AllTypes");
    assert_eq!(instance.set_real(&[at(GAIN)], &[1e300]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    let mut along = |seed: f64| {
        let status =
            instance.get_directional_derivative(&[at(OUTPUT)], &[at(INPUT)], &[seed], &mut [f64::NAN]);
        (status, instance.drain_messages())
    };
    assert_eq!(along(2.0).0, Ok);
    let (status, messages) = along(1e10);
    assert_eq!(status, Error);
    assert!(messages[0].text.contains("`channel[1].output`"), "{messages:?}");
    assert!(messages[0].text.contains("along channel[1].input came out as inf"), "{messages:?}");
    let (mut instance, _) = started("AllTypes");
    let status = instance.get_directional_derivative(&[at(OUTPUT)], &[at(INPUT)], &[f64::NAN], &mut [0.0]);
    assert_eq!(status, Error);
    assert!(only_message(&instance).contains("the seed of `channel[1].input`"));
}
