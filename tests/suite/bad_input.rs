//! Bad input gets an error that names what was found and what is allowed, and nothing else changes.

use model_description::BaseType;
use std::fs;
use std::path::{Path, PathBuf};

use client::{InProcess, Message, Names};
use fmi_export::{Library, Model, Status};
use models::MomentumPlant;

use crate::support::{LIBRARY, everything, fresh, guid, library, names, ok, real_bits};

const PLANT: &str = "MomentumPlant";

fn refused(library: &'static Library, guid: &str, location: Option<&str>) -> String {
    let messages = InProcess::instantiate(library, guid, location).unwrap_err();
    text(&messages)
}

fn text(messages: &[Message]) -> String {
    assert!(!messages.is_empty());
    // What went to the logger has `%` and `#` doubled.
    let texts: Vec<String> =
        messages.iter().map(|it| it.text.replace("%%", "%").replace("##", "#")).collect();
    texts.join("\n")
}

#[track_caller]
fn contains(text: &str, words: &[&str]) {
    for word in words {
        assert!(text.contains(word), "`{word}` is missing in: {text}");
    }
}

/// A resources folder with this spacecraft file.
fn resources(folder: &Path, spacecraft: &str) -> PathBuf {
    fs::create_dir_all(folder).unwrap();
    fs::write(folder.join("spacecraft.toml"), spacecraft).unwrap();
    folder.to_owned()
}

fn uri(folder: &Path) -> String {
    fmi::file_uri(folder)
}

fn guid_of(spacecraft: &str) -> String {
    LIBRARY.describe(LIBRARY.find(PLANT).unwrap(), None, Some(spacecraft)).unwrap().guid
}

#[test]
fn a_wrong_guid_is_named_beside_the_right_ones() {
    let unknown = "{00000000-1111-2222-3333-444444444444}";
    let text = refused(&LIBRARY, unknown, None);
    contains(&text, &[unknown, "AllTypes", guid("AllTypes"), PLANT, guid(PLANT)]);
}

#[test]
fn a_guid_of_another_spacecraft_is_named_as_such() {
    let folder = tempfile::tempdir().unwrap();
    let edited = MomentumPlant::DEFAULT_SETUP.replace("mass_kg = 700.0", "mass_kg = 701.0");
    let folder = resources(folder.path(), &edited);
    let text = refused(library(PLANT), guid(PLANT), Some(&uri(&folder)));
    contains(&text, &[guid(PLANT), &guid_of(&edited), "spacecraft.toml", "changed after packing"]);
}

#[test]
fn a_missing_resource_folder_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let missing = folder.path().join("no such folder");
    let text = refused(library(PLANT), guid(PLANT), Some(&uri(&missing)));
    contains(&text, &[missing.to_str().unwrap(), "does not exist"]);
    assert!(!text.contains("changed after packing"), "{text}");
    // The folder is there, the file is not.
    let text = refused(library(PLANT), guid(PLANT), Some(&uri(folder.path())));
    contains(&text, &["spacecraft.toml", "cannot read"]);
}

#[test]
fn resource_folders_of_any_name_are_found() {
    let base = tempfile::tempdir().unwrap();
    // Not the compiled-in spacecraft, so that the file must have been read.
    let spacecraft = MomentumPlant::DEFAULT_SETUP.replace("mass_kg = 700.0", "mass_kg = 650.0");
    let guid = guid_of(&spacecraft);
    for name in [
        "with space",
        "a+b",
        "50% off",
        "100%25",
        "%41%zz",
        "üñï çødé 世界 🛰",
        "{braces}",
        "#hash?query",
        "a'b\"c",
    ] {
        let folder = resources(&base.path().join(name), &spacecraft);
        let plain = format!("file://{}", folder.to_str().unwrap());
        for location in [uri(&folder), plain, uri(&folder).replace("file:///", "file:/")] {
            let instance = InProcess::instantiate(library(PLANT), &guid, Some(&location));
            assert!(instance.is_ok(), "{location}: {}", text(&instance.unwrap_err()));
        }
    }
}

#[test]
fn a_spacecraft_file_that_cannot_be_used_is_named_by_file_and_key() {
    let good = MomentumPlant::DEFAULT_SETUP;
    let damaged = &good[..good.find("[sunshade.cylinder]").unwrap() + 8];
    let place_of_damage = format!("spacecraft.toml:{}", damaged.lines().count());
    let unknown = good.replace("mass_kg = 700.0", "mass_kg = 700.0\ncolour = \"red\"");
    let negative = good.replacen("area_m2 = 1.169", "area_m2 = -1.169", 1);
    let infinite = good.replace("mass_kg = 700.0", "mass_kg = inf");
    let wrong_type = good.replace("mass_kg = 700.0", "mass_kg = \"heavy\"");
    let cases: [(&str, &[&str]); 6] = [
        (damaged, &[&place_of_damage, "unclosed table"]),
        (&unknown, &["colour"]),
        (&negative, &["plates[1].area_m2", "-1.169", "above 0"]),
        (&infinite, &["mass_kg", "inf"]),
        (&wrong_type, &["mass_kg", "heavy"]),
        ("", &["no key `name`"]),
    ];
    for (spacecraft, words) in cases {
        let folder = tempfile::tempdir().unwrap();
        let folder = resources(folder.path(), spacecraft);
        let text = refused(library(PLANT), guid(PLANT), Some(&uri(&folder)));
        contains(&text, &["spacecraft.toml"]);
        contains(&text, words);
    }
    let folder = tempfile::tempdir().unwrap();
    let folder = resources(folder.path(), "");
    fs::write(folder.join("spacecraft.toml"), b"name = \"\xFF\xFE\"").unwrap();
    contains(&refused(library(PLANT), guid(PLANT), Some(&uri(&folder))), &["spacecraft.toml", "UTF-8"]);
}

fn running() -> (InProcess, Names) {
    let mut instance = fresh(PLANT);
    ok(instance.start(0.0, Some(6_000.0)));
    ok(instance.do_step(0.0, 600.0));
    let _ = instance.drain_messages();
    (instance, names(PLANT))
}

#[test]
fn nan_and_infinity_are_discarded_and_the_instance_stays_usable() {
    let (mut instance, names) = running();
    let torque = names.vector::<3>("torque.applied");
    let before = everything(&mut instance, &names);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        // The good elements beside the bad one are not written either.
        assert_eq!(instance.set_real(&torque, &[1e-3, bad, 1e-3]), Status::Discard);
        contains(&text(&instance.drain_messages()), &["torque.applied[2]", "allowed is -1e100 to 1e100"]);
        assert_eq!(everything(&mut instance, &names), before);
    }
    let threshold = names.real("dump.threshold[1]");
    assert_eq!(instance.set_real(&[threshold], &[-1.0]), Status::Discard);
    contains(&text(&instance.drain_messages()), &["dump.threshold[1]", "-1.0", "allowed is 1e-6 to 1e100"]);
    assert_eq!(instance.set_input_derivatives(&torque[..1], &[1], &[f64::NAN]), Status::Discard);
    let kind = names.typed(BaseType::Integer, "command.kind");
    assert_eq!(instance.set_integer(&[kind], &[17]), Status::Discard);
    // None of it leaves a trace.
    ok(instance.do_step(600.0, 600.0));
    let (mut untouched, _) = running();
    ok(untouched.do_step(600.0, 600.0));
    assert_eq!(everything(&mut instance, &names), everything(&mut untouched, &names));
}

#[test]
fn a_step_past_the_stop_time_is_an_error() {
    let (mut instance, names) = running();
    ok(instance.do_step(600.0, 5_400.0));
    let before = real_bits(&mut instance, names.all(BaseType::Real));
    assert_eq!(instance.do_step(6_000.0, 600.0), Status::Error);
    contains(&text(&instance.drain_messages()), &["6600.0", "6000.0", "stop"]);
    // Not carried out at all; Reset brings the instance back.
    assert_eq!(real_bits(&mut instance, names.all(BaseType::Real)), before);
    ok(instance.reset());
    ok(instance.start(0.0, None));
    ok(instance.do_step(0.0, 6_600.0));
}

#[test]
fn an_unknown_reference_in_a_vector_writes_nothing() {
    let (mut instance, names) = running();
    let torque = names.vector::<3>("torque.applied");
    let before = real_bits(&mut instance, names.all(BaseType::Real));
    assert_eq!(instance.set_real(&[torque[0], 4_000_000, torque[2]], &[1.0, 2.0, 3.0]), Status::Error);
    contains(&text(&instance.drain_messages()), &["4000000"]);
    assert_eq!(real_bits(&mut instance, names.all(BaseType::Real)), before);
    let mut values = [0.0; 2];
    assert_eq!(instance.get_real(&[torque[0], u32::MAX], &mut values), Status::Error);
    contains(&text(&instance.drain_messages()), &["4294967295"]);
}

#[test]
fn two_spacecraft_simulate_in_one_process_as_each_does_alone() {
    let base = tempfile::tempdir().unwrap();
    let heavy = MomentumPlant::DEFAULT_SETUP
        .replace("name = \"MESSENGER\"", "name = \"Heavy\"")
        .replace("mass_kg = 700.0", "mass_kg = 1400.0")
        .replace("center_of_mass_m = [0.0, 0.0, 0.0]", "center_of_mass_m = [0.01, 0.02, -0.05]");
    let spacecraft = [MomentumPlant::DEFAULT_SETUP, &heavy];
    let made = |number: usize| {
        let folder = resources(&base.path().join(format!("spacecraft {number}")), spacecraft[number]);
        let mut instance =
            InProcess::instantiate(library(PLANT), &guid_of(spacecraft[number]), Some(&uri(&folder)))
                .unwrap();
        ok(instance.start(0.0, None));
        instance
    };
    let names = names(PLANT);
    let step = |instance: &mut InProcess, number: i32| ok(instance.do_step(600.0 * f64::from(number), 600.0));
    let alone: Vec<_> = (0..2)
        .map(|which| {
            let mut instance = made(which);
            (0..300).for_each(|number| step(&mut instance, number));
            everything(&mut instance, &names)
        })
        .collect();
    assert_ne!(alone[0].0, alone[1].0);
    let mut together = [made(0), made(1)];
    for number in 0..300 {
        together.iter_mut().for_each(|instance| step(instance, number));
    }
    for (instance, alone) in together.iter_mut().zip(&alone) {
        assert_eq!(everything(instance, &names), *alone);
    }
    // A state of one is no state of the other.
    let (status, bytes) = together[0].state_bytes();
    ok(status);
    let _ = together[1].drain_messages();
    assert_eq!(together[1].deserialize(&bytes).0, Status::Error);
    contains(&text(&together[1].drain_messages()), &["another setup"]);
}
