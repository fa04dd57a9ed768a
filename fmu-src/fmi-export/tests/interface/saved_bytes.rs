//! Whatever bytes are given to DeSerialize, the answer is a state or an error that names what is wrong.

use client::InProcess;
use fmi_export::model_description::BaseType;
use fmi_export::model_description::Status::{Error, Ok};

use super::{Random, fresh, started};

const HEADER: usize = 44;

/// FNV-1a, 64 bits.
fn checksum(bytes: &[u8]) -> u64 {
    let mut hash = 14_695_981_039_346_656_037_u64;
    for byte in bytes {
        hash ^= u64::from(*byte);
        hash = hash.wrapping_mul(1_099_511_628_211);
    }
    hash
}

/// The header of `like` before another payload, sealed as ours would be.
fn sealed(like: &[u8], payload: &[u8]) -> Vec<u8> {
    let mut bytes = like[..28].to_vec();
    bytes.extend_from_slice(&(payload.len() as u64).to_le_bytes());
    bytes.extend_from_slice(&checksum(payload).to_le_bytes());
    bytes.extend_from_slice(payload);
    bytes
}

/// `bytes` with another float at a place, sealed anew.
fn with_float(bytes: &[u8], at: usize, float: f64) -> Vec<u8> {
    let mut payload = bytes[HEADER..].to_vec();
    payload[at - HEADER..at - HEADER + 8].copy_from_slice(&float.to_le_bytes());
    sealed(bytes, &payload)
}

/// The refusal of bytes by a fresh instance, `None` where they are taken.
fn refusal(bytes: &[u8]) -> Option<String> {
    let (mut instance, _) = fresh("AllTypes");
    let (status, _state) = instance.deserialize(bytes);
    (status == Error).then(|| super::only_message(&instance))
}

fn saved() -> Vec<u8> {
    let (mut instance, description) = started("AllTypes");
    let input = super::reference(&description, "input.real");
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert_eq!(instance.set_real(&[input], &[2.0]), Ok);
    assert_eq!(instance.set_input_derivatives(&[input], &[1], &[1.0]), Ok);
    instance.state_bytes().1
}

/// Decodes, and where that works uses the state; returns whether it worked.
fn survives(instance: &mut InProcess, bytes: &[u8]) -> bool {
    let (status, state) = instance.deserialize(bytes);
    let messages = instance.drain_messages();
    assert_eq!(state.is_null(), status == Error);
    if status == Error {
        assert_eq!(messages.len(), 1);
        assert!(!messages[0].text.contains("panic"), "{messages:?}");
        assert_eq!(instance.reset(), Ok);
        return false;
    }
    assert_eq!(instance.set_state(&state), Ok);
    let _ = instance.do_step(1.0, 0.5);
    let (status, _) = instance.state_bytes();
    let messages = instance.drain_messages();
    // A step from great numbers may end beyond what a saved state may hold.
    let beyond = messages.last().is_some_and(|last| last.text.contains("it could not be read: model state"));
    assert!(status == Ok || beyond, "{messages:?}");
    assert!(messages.iter().all(|message| !message.text.contains("panic")));
    assert_eq!(instance.reset(), Ok);
    true
}

#[test]
fn each_part_of_the_header_is_checked() {
    let bytes = saved();
    for (at, word) in [
        (0, "do not begin with its mark"),
        (8, "layout version"),
        (12, "another model or another setup"),
        (36, "checksum"),
        (HEADER, "checksum"),
    ] {
        let mut damaged = bytes.clone();
        damaged[at] ^= 1;
        assert!(refusal(&damaged).unwrap().contains(word), "{word}");
    }
    for length in [0, 7, 8, 12, 28, 36, HEADER, bytes.len() - 1] {
        assert!(refusal(&bytes[..length]).unwrap().contains(&format!("has {length} bytes")), "{length}");
    }
    let mut endless = bytes.clone();
    endless[28..36].fill(0xFF);
    assert!(refusal(&endless).is_some());
}

#[test]
fn damage_behind_a_valid_checksum_is_survived() {
    let bytes = saved();
    let (mut instance, _) = fresh("AllTypes");
    let mut random = Random(7);
    let mut accepted = 0;
    for _ in 0..20_000 {
        let mut payload = bytes[HEADER..].to_vec();
        for _ in 0..=random.below(4) {
            let at = random.below(payload.len());
            match random.below(4) {
                0 => payload[at] = random.next() as u8,
                1 => payload.truncate(at + 1),
                2 => payload.insert(at, random.next() as u8),
                _ => payload[at] = 0xFF,
            }
        }
        accepted += usize::from(survives(&mut instance, &sealed(&bytes, &payload)));
    }
    // Most of the payload is plain numbers, so some damage is another state.
    assert!(accepted > 100, "{accepted}");
}

#[test]
fn random_payloads_and_random_bytes_are_survived() {
    let bytes = saved();
    let (mut instance, _) = fresh("AllTypes");
    let mut random = Random(8);
    for _ in 0..20_000 {
        let noise: Vec<u8> = (0..random.below(200)).map(|_| random.next() as u8).collect();
        survives(&mut instance, &sealed(&bytes, &noise));
        survives(&mut instance, &noise);
    }
}

#[test]
fn values_that_could_not_be_set_are_refused_in_bytes_too() {
    let bytes = saved();
    let needle = 2.5_f64.to_le_bytes();
    let at = bytes.windows(8).position(|window| window == needle).unwrap();
    assert!(refusal(&with_float(&bytes, at, -1.0)).unwrap().contains("`tunable.real` is -1.0"));
}

#[test]
fn a_float_of_the_model_that_no_simulation_can_go_on_with_is_refused() {
    let (mut instance, description) = started("AllTypes");
    let input = super::reference(&description, "input.real");
    assert_eq!(instance.set_real(&[input], &[7.25]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    let bytes = instance.state_bytes().1;
    // The last place that holds it is the model's; those before are values of variables.
    let needle = 7.25_f64.to_le_bytes();
    let at = bytes.windows(8).rposition(|window| window == needle).unwrap();
    for (float, accepted) in [
        (1e100, true),
        (-1e100, true),
        (f64::NAN, false),
        (f64::INFINITY, false),
        (f64::NEG_INFINITY, false),
        (1.0001e100, false),
        (f64::MIN, false),
    ] {
        let refused = refusal(&with_float(&bytes, at, float));
        assert_eq!(refused.is_none(), accepted, "{float}");
        assert!(refused.is_none_or(|text| text.contains(&format!("holds {float:?}"))), "{float}");
    }
}

/// An Integer in postcard's format.
fn encoded(value: i32) -> Vec<u8> {
    let mut rest = ((value << 1) ^ (value >> 31)) as u32;
    let mut bytes = Vec::new();
    while rest >= 0x80 {
        bytes.push(rest as u8 | 0x80);
        rest >>= 7;
    }
    bytes.push(rest as u8);
    bytes
}

#[test]
fn a_wrong_enumeration_in_a_restored_state_is_refused() {
    let (mut instance, description) = started("AllTypes");
    let integers: Vec<_> =
        description.variables.iter().filter(|it| it.kind.base_type() == BaseType::Integer).collect();
    let references: Vec<u32> = integers.iter().map(|it| it.value_reference).collect();
    let mut values = vec![0; references.len()];
    assert_eq!(instance.get_integer(&references, &mut values), Ok);
    let bytes = instance.state_bytes().1;
    let words: Vec<Vec<u8>> = values.iter().map(|&value| encoded(value)).collect();
    let needle = words.concat();
    let start = bytes.windows(needle.len()).position(|window| window == needle).unwrap() - HEADER;
    let mut enumerations = 0;
    for (place, variable) in integers.iter().enumerate() {
        if !variable.name.ends_with(".choice") {
            continue;
        }
        enumerations += 1;
        let at = start + words[..place].concat().len();
        // 3 is a gap between the items of `Colour`, -1 and 63 lie beside them.
        for (value, accepted) in [(values[place], true), (3, false), (-1, false), (63, false)] {
            let mut payload = bytes[HEADER..].to_vec();
            payload.splice(at..at + words[place].len(), encoded(value));
            let refused = refusal(&sealed(&bytes, &payload));
            assert_eq!(refused.is_none(), accepted, "{} = {value}", variable.name);
            assert!(refused.is_none_or(|text| text.contains(&format!("`{}` is {value}", variable.name))));
        }
    }
    assert!(enumerations >= 4, "{enumerations}");
}
