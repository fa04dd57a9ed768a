//! A set is checked as a whole before anything is written, and values out of range are discarded by name.

use fmi_export::model_description::Status::{Discard, Error, Ok, Warning};

use client::InProcess;
use fmi_export::model_description::Description;

use super::{fresh, only_message, real, reference, started};

#[test]
fn an_unknown_reference_in_a_vector_writes_nothing_of_it() {
    let (mut instance, description) = started("AllTypes");
    let input = reference(&description, "input.real");
    assert_eq!(instance.set_real(&[input, 9999], &[5.0, 6.0]), Error);
    let text = only_message(&instance);
    assert!(text.contains("fmi2SetReal: unknown Real value reference 9999: this model has 0 to"), "{text}");
    assert_eq!(real(&mut instance, input), 0.0);
}

#[test]
fn values_out_of_range_are_discarded_whole_and_the_instance_lives() {
    let (mut instance, description) = started("AllTypes");
    let at = |name| reference(&description, name);
    let (input, tunable) = (at("input.real"), at("tunable.real"));
    for (values, words) in [
        ([1.0, 10.5], ["`tunable.real`", "10.5", "0.0 to 10.0"]),
        ([1.0, f64::NAN], ["`tunable.real`", "NaN", "0.0 to 10.0"]),
        ([f64::INFINITY, 1.0], ["`input.real`", "inf", "-1000000.0 to 1000000.0"]),
    ] {
        assert_eq!(instance.set_real(&[input, tunable], &values), Discard);
        let text = only_message(&instance);
        assert!(words.iter().all(|word| text.contains(word)), "{text}");
        assert_eq!([real(&mut instance, input), real(&mut instance, tunable)], [0.0, 2.5]);
    }
    let discrete = at("input.discreteReal");
    assert_eq!(instance.set_real(&[discrete], &[f64::NEG_INFINITY]), Discard);
    assert!(only_message(&instance).contains("-1e100 to 1e100"));
    assert_eq!(instance.set_real(&[discrete], &[1e100_f64.next_up()]), Discard);
    assert!(only_message(&instance).contains("-1e100 to 1e100"));
    assert_eq!(instance.set_integer(&[at("input.integer")], &[1001]), Discard);
    assert!(only_message(&instance).contains("`input.integer`"));
    for gap in [-1, 3, 5, i32::MIN] {
        assert_eq!(instance.set_integer(&[at("input.choice")], &[gap]), Discard, "{gap}");
        assert!(only_message(&instance).contains("[0, 1, 2, 4]"));
    }
    assert_eq!(instance.set_integer(&[at("input.choice")], &[4]), Ok);
    assert_eq!(instance.set_boolean(&[at("input.boolean")], &[2]), Discard);
    assert!(only_message(&instance).contains("0 (fmi2False) and 1 (fmi2True)"));
    assert_eq!(instance.set_string(&[at("input.text")], &[b"\xFF\xFE"]), Discard);
    assert!(only_message(&instance).contains("UTF-8"));
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
}

#[test]
fn what_may_be_set_depends_on_the_state() {
    // Name, then whether Instantiated, Initialization Mode and the steps admit it (2.2.7, notes 1, 3, 6).
    let table = [
        ("parameter.real", [true, true, false]),
        ("tunable.real", [true, true, true]),
        ("input.real", [true, true, true]), // Instantiated: leniency
        ("output.real", [false, false, false]),
        ("role.calculatedFixed", [false, false, false]),
        ("role.calculatedApprox", [true, false, false]),
        ("role.outputConstant", [false, false, false]),
        ("role.outputApprox", [true, false, false]),
        ("role.localExact", [true, true, false]),
        ("role.localContinuous", [false, false, false]),
    ];
    for (name, admitted) in table {
        for (phase, admitted) in admitted.into_iter().enumerate() {
            let (mut instance, description) = fresh("AllTypes");
            if phase > 0 {
                assert_eq!(instance.setup_experiment(0.0, None), Ok);
                assert_eq!(instance.enter_initialization_mode(), Ok);
            }
            if phase > 1 {
                assert_eq!(instance.exit_initialization_mode(), Ok);
            }
            let expected = if admitted { Ok } else { Error };
            let found = instance.set_real(&[reference(&description, name)], &[3.0]);
            assert_eq!(found, expected, "{name} in phase {phase}");
            if !admitted {
                let text = only_message(&instance);
                assert!(text.contains(&format!("`{name}`")) && text.contains("may not be set"), "{text}");
            }
        }
    }
}

#[test]
fn leniencies_are_logged_once() {
    let (mut instance, description) = fresh("AllTypes");
    let input = reference(&description, "input.real");
    assert_eq!(instance.set_real(&[input], &[1.0]), Ok);
    assert!(only_message(&instance).contains("inputs are set before Initialization Mode"));
    assert_eq!(instance.set_real(&[input], &[2.0]), Ok);
    assert_eq!(instance.setup_experiment(0.0, None), Ok);
    assert_eq!(instance.enter_initialization_mode(), Ok);
    assert!(instance.drain_messages().is_empty());
    assert_eq!(real(&mut instance, input), 2.0);
    assert!(only_message(&instance).contains("read in Initialization Mode"));
    assert_eq!(real(&mut instance, input), 2.0);
    assert_eq!(real(&mut instance, reference(&description, "output.real")), 2.0);
    assert!(instance.drain_messages().is_empty());
}

#[test]
fn start_values_are_read_before_initialization_with_a_warning() {
    let (mut instance, description) = fresh("AllTypes");
    let (parameter, input) =
        (reference(&description, "parameter.real"), reference(&description, "input.real"));
    let mut values = [f64::NAN; 2];
    assert_eq!(instance.set_real(&[input], &[4.0]), Ok);
    instance.drain_messages();
    assert_eq!(instance.get_real(&[parameter, input], &mut values), Warning);
    assert_eq!(values, [1.5, 4.0]);
    assert!(only_message(&instance).contains("before Initialization Mode"));
    assert_eq!(instance.setup_experiment(0.0, None), Ok);
    assert_eq!(instance.enter_initialization_mode(), Ok);
    // What has no start value is not known yet.
    let (mut instance, _) = fresh("AllTypes");
    let output = reference(&description, "output.real");
    assert_eq!(instance.get_real(&[parameter, output], &mut values), Error);
    assert!(only_message(&instance).contains("`output.real` (Real value reference"));
}

#[test]
fn initialization_follows_what_was_set() {
    let (mut instance, description) = fresh("AllTypes");
    let at = |name| reference(&description, name);
    assert_eq!(instance.setup_experiment(7.0, None), Ok);
    assert_eq!(instance.enter_initialization_mode(), Ok);
    let (parameter, calculated) = (at("parameter.real"), at("role.calculatedFixed"));
    assert_eq!(real(&mut instance, calculated), 3.0);
    assert_eq!(instance.set_real(&[parameter, at("input.real")], &[5.0, 8.0]), Ok);
    assert_eq!(real(&mut instance, calculated), 10.0);
    assert_eq!(instance.set_real(&[parameter], &[6.0]), Ok);
    assert_eq!(instance.exit_initialization_mode(), Ok);
    assert_eq!(real(&mut instance, calculated), 12.0);
    assert_eq!(real(&mut instance, at("output.real")), 8.0);
}

#[test]
fn outputs_after_a_set_belong_to_the_last_step_and_inputs_read_back() {
    let (mut instance, description) = started("AllTypes");
    let (input, output) = (reference(&description, "input.real"), reference(&description, "output.real"));
    assert_eq!(instance.set_real(&[input], &[1.0]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.set_real(&[input], &[2.0]), Ok);
    assert_eq!(real(&mut instance, input), 2.0);
    assert!(instance.drain_messages().is_empty());
    assert_eq!(real(&mut instance, output), 1.0);
    assert!(only_message(&instance).contains("last communication point"));
    assert_eq!(real(&mut instance, output), 1.0);
    assert!(instance.drain_messages().is_empty());
    assert_eq!(instance.do_step(1.0, 1.0), Ok);
    assert_eq!(real(&mut instance, output), 2.0);
}

/// The integral of AllTypes is one product while nothing changes, so a step that ends what was computed ahead shows.
#[test]
fn a_value_set_again_or_set_back_between_two_steps_is_no_change() {
    type Disturb = fn(&mut InProcess, u32, &Description);
    let simulate = |steps: u8, disturb: Disturb| {
        let (mut instance, description) = fresh("AllTypes");
        let input = reference(&description, "input.real");
        assert_eq!(instance.set_real(&[input], &[0.1]), Ok);
        assert_eq!(instance.start(0.0, None), Ok);
        let length_s = 0.875 / f64::from(steps);
        for i in 0..steps {
            disturb(&mut instance, input, &description);
            assert_eq!(instance.do_step(length_s * f64::from(i), length_s), Ok);
        }
        real(&mut instance, reference(&description, "output.integral")).to_bits()
    };
    let run = |disturb: Disturb| simulate(7, disturb);
    let undisturbed = simulate(1, |_, _, _| {});
    assert_eq!(run(|_, _, _| {}), undisturbed);
    let again: Disturb = |it, input, _| assert_eq!(it.set_real(&[input], &[0.1]), Ok);
    assert_eq!(run(again), undisturbed);
    let there_and_back: Disturb = |it, input, description| {
        let (integer, text) = (reference(description, "input.integer"), reference(description, "input.text"));
        assert_eq!(it.set_real(&[input], &[0.7]), Ok);
        assert_eq!(it.set_integer(&[integer], &[5]), Ok);
        assert_eq!(it.set_string(&[text], &[b"longer than what was there"]), Ok);
        assert_eq!(it.set_real(&[input], &[0.1]), Ok);
        assert_eq!(it.set_integer(&[integer], &[1]), Ok);
        assert_eq!(it.set_string(&[text], &[b""]), Ok);
    };
    assert_eq!(run(there_and_back), undisturbed);
    // Also where the state is saved and restored, as bytes, while the other value is set.
    let over_a_state: Disturb = |it, input, _| {
        assert_eq!(it.set_real(&[input], &[0.7]), Ok);
        let (status, bytes) = it.state_bytes();
        assert_eq!(status, Ok);
        let (status, mut state) = it.deserialize(&bytes);
        assert_eq!((status, it.set_state(&state)), (Ok, Ok));
        assert_eq!(it.free_state(&mut state), Ok);
        assert_eq!(it.set_real(&[input], &[0.1]), Ok);
    };
    assert_eq!(run(over_a_state), undisturbed);
    // An input that moves with the slope 0 stays where it is.
    let still: Disturb = |it, input, _| assert_eq!(it.set_input_derivatives(&[input], &[1], &[0.0]), Ok);
    assert_eq!(run(still), undisturbed);
    // And one that does change is a change: the sum of products differs from the product.
    let changed: Disturb = |it, input, _| {
        let value = real(it, input);
        assert_eq!(it.set_real(&[input], &[value.next_up()]), Ok);
    };
    assert_ne!(run(changed), undisturbed);
}

#[test]
fn a_reference_of_another_type_is_named() {
    let (mut instance, description) = started("AllTypes");
    let integer = reference(&description, "input.integer");
    assert_eq!(instance.get_real(&[integer], &mut [0.0]), Error);
    let text = only_message(&instance);
    assert!(text.contains("`input.integer`") && text.contains("is no Real"), "{text}");
}

#[test]
fn every_type_comes_back_as_it_was_set() {
    let (mut instance, description) = started("AllTypes");
    let at = |name| reference(&description, name);
    let (mut integer, mut boolean) = ([0], [9]);
    assert_eq!(instance.set_integer(&[at("tunable.integer")], &[-10]), Ok);
    assert_eq!(instance.set_boolean(&[at("tunable.boolean")], &[1]), Ok);
    assert_eq!(instance.set_string(&[at("input.text")], &["Ωμέγα % #".as_bytes()]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.get_integer(&[at("echo.integer")], &mut integer), Ok);
    assert_eq!(instance.get_boolean(&[at("echo.boolean")], &mut boolean), Ok);
    let (status, texts) = instance.get_string(&[at("output.text"), at("output.text"), at("parameter.text")]);
    assert_eq!((status, integer, boolean), (Ok, [-10], [1]));
    assert_eq!(texts, ["Ωμέγα % #", "Ωμέγα % #", "Grüße, 世界 <&\"'> 🛰"]);
    assert_eq!(instance.get_string(&[77]).0, Error);
}
