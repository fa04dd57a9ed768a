//! A saved state continues to the bit: in this instance, in another, and from bytes.

use client::{InProcess, StatePointer};
use fmi_export::model_description::Status::{self, Error, Ok};

use super::{Random, fresh, only_message, reference, started};

/// Steps with sets, derivatives and texts that depend on the step's number only.
fn advance(instance: &mut InProcess, input: u32, text: u32, steps: core::ops::Range<i32>) {
    for i in steps {
        let time_s = 0.25 * f64::from(i);
        if i % 3 == 0 {
            assert_eq!(instance.set_real(&[input], &[f64::from(i).sin()]), Ok);
        }
        if i % 4 == 0 {
            assert_eq!(instance.set_input_derivatives(&[input], &[1], &[f64::from(i).cos()]), Ok);
        }
        if i % 5 == 0 {
            assert_eq!(instance.set_string(&[text], &[format!("step {i}").as_bytes()]), Ok);
        }
        assert_eq!(instance.do_step(time_s, 0.25), Ok);
    }
}

#[test]
fn saved_and_restored_equals_never_interrupted() {
    let (mut instance, description) = started("AllTypes");
    let (input, text) = (reference(&description, "input.real"), reference(&description, "input.text"));
    let mut random = Random(1);
    for _ in 0..20 {
        let (from, to) = (random.below(40) as i32, 60 + random.below(20) as i32);
        assert_eq!(instance.reset(), Ok);
        assert_eq!(instance.start(0.0, None), Ok);
        advance(&mut instance, input, text, 0..from);
        let mut state = StatePointer::null();
        assert_eq!(instance.get_state(&mut state), Ok);
        let (status, bytes) = instance.serialize(&state);
        assert_eq!(status, Ok);
        advance(&mut instance, input, text, from..to);
        let (_, end) = instance.state_bytes();
        // Back in the same instance, after an error, in a fresh one from memory, in another from bytes.
        assert_eq!(instance.set_state(&state), Ok);
        advance(&mut instance, input, text, from..to);
        assert_eq!(instance.state_bytes().1, end);
        assert_eq!(instance.do_step(-1.0, 1.0), Error);
        assert_eq!(instance.set_state(&state), Ok);
        advance(&mut instance, input, text, from..to);
        assert_eq!(instance.state_bytes().1, end);
        let (mut twin, _) = fresh("AllTypes");
        assert_eq!(twin.set_state(&state), Ok);
        advance(&mut twin, input, text, from..to);
        assert_eq!(twin.state_bytes().1, end);
        let (mut third, _) = fresh("AllTypes");
        let (status, decoded) = third.deserialize(&bytes);
        assert_eq!(status, Ok);
        assert_eq!(third.serialize(&decoded), (Ok, bytes));
        assert_eq!(third.set_state(&decoded), Ok);
        advance(&mut third, input, text, from..to);
        assert_eq!(third.state_bytes().1, end);
    }
}

#[test]
fn a_save_between_a_set_and_its_step_keeps_both() {
    let (mut instance, description) = started("AllTypes");
    let (input, output) = (reference(&description, "input.real"), reference(&description, "output.real"));
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.set_real(&[input], &[3.0]), Ok);
    assert_eq!(instance.set_input_derivatives(&[input], &[1], &[1.0]), Ok);
    let (_, bytes) = instance.state_bytes();
    let (mut twin, _) = fresh("AllTypes");
    let (_, state) = twin.deserialize(&bytes);
    assert_eq!(twin.set_state(&state), Ok);
    for instance in [&mut instance, &mut twin] {
        assert_eq!(super::real(instance, output), 0.0);
        assert_eq!(instance.do_step(1.0, 2.0), Ok);
        assert_eq!(super::real(instance, output), 5.0);
    }
    assert_eq!(instance.state_bytes(), twin.state_bytes());
}

#[test]
fn the_state_of_another_model_is_refused() {
    let (mut all_types, _) = started("AllTypes");
    let (mut empty, _) = started("Empty");
    let mut state = StatePointer::null();
    assert_eq!(all_types.get_state(&mut state), Ok);
    let (_, bytes) = all_types.serialize(&state);
    type Call<'a> = &'a dyn Fn(&mut InProcess, &mut StatePointer) -> Status;
    let calls: [Call<'_>; 4] = [
        &|empty, state| empty.set_state(state),
        &|empty, state| empty.get_state(state),
        &|empty, state| empty.serialize(state).0,
        &|empty, _| empty.deserialize(&bytes).0,
    ];
    for call in calls {
        assert_eq!(call(&mut empty, &mut state), Error);
        assert!(only_message(&empty).contains("belongs to another model or another setup"));
    }
    assert_eq!(all_types.set_state(&state), Ok);
}

#[test]
fn a_buffer_too_small_is_an_error_and_one_too_large_is_not() {
    let (mut instance, _) = started("AllTypes");
    let mut state = StatePointer::null();
    assert_eq!(instance.get_state(&mut state), Ok);
    let (_, bytes) = instance.serialize(&state);
    let mut large = vec![0xAA; bytes.len() + 10];
    assert_eq!(instance.serialize_into(&state, &mut large), Ok);
    assert_eq!((&large[..bytes.len()], &large[bytes.len()..]), (&bytes[..], &[0xAA; 10][..]));
    assert_eq!(instance.deserialize(&large).0, Ok);
    let mut small = vec![0xAA; bytes.len() - 1];
    assert_eq!(instance.serialize_into(&state, &mut small), Error);
    assert!(small.iter().all(|&byte| byte == 0xAA));
    assert!(only_message(&instance).contains(&format!(
        "has {} bytes, expected {}",
        small.len(),
        bytes.len()
    )));
}
