//! The models in this process, their variables by name, and what else many tests need.

use std::collections::BTreeMap;
use std::ffi::OsStr;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

use client::{InProcess, Names};
use fmi_export::fmi2::entry;
use fmi_export::{Library, Status};
use model_description::{BaseType, Description};
use models::{DisturbanceTorque, Guidance, MomentumPlant, SpinPlant};
use probe::{AllTypes, Empty, Panicking, RigidBody};

/// Every model here.
pub(crate) static LIBRARY: Library = Library {
    entries: &[
        entry::<Empty>(),
        entry::<AllTypes>(),
        entry::<Panicking>(),
        entry::<RigidBody>(),
        entry::<MomentumPlant>(),
        entry::<SpinPlant>(),
        entry::<DisturbanceTorque>(),
        entry::<Guidance>(),
    ],
};

/// Libraries of few models each, so that instantiating one does not describe all others: those that take a spacecraft's file
/// stand together, for its `[start]` may have names of each.
pub(crate) fn library(model: &str) -> &'static Library {
    static EMPTY: Library = Library { entries: &[entry::<Empty>()] };
    static ALL_TYPES: Library = Library { entries: &[entry::<AllTypes>()] };
    static PANICKING: Library = Library { entries: &[entry::<Panicking>()] };
    static SPIN_PLANT: Library = Library { entries: &[entry::<SpinPlant>()] };
    static OF_SPACECRAFT: Library =
        Library { entries: &[entry::<MomentumPlant>(), entry::<DisturbanceTorque>(), entry::<Guidance>()] };
    match model {
        "SpinPlant" => &SPIN_PLANT,
        "Empty" => &EMPTY,
        "AllTypes" => &ALL_TYPES,
        "Panicking" => &PANICKING,
        "MomentumPlant" | "DisturbanceTorque" | "Guidance" => &OF_SPACECRAFT,
        other => panic!("no library of {other}"),
    }
}

/// The models that are packed into `dist/`.
pub(crate) const SHIPPED: &[&str] = &["MomentumPlant", "SpinPlant", "DisturbanceTorque", "Guidance"];

/// The description of a model with its compiled-in setup.
pub(crate) fn description(model: &str) -> Description {
    LIBRARY.describe(LIBRARY.find(model).unwrap(), None, None).unwrap()
}

/// The references of a model.
pub(crate) fn names(model: &str) -> Names {
    Names::new(&description(model))
}

/// A fresh instance of a model with its compiled-in setup.
pub(crate) fn fresh(model: &str) -> InProcess {
    InProcess::instantiate(library(model), guid(model), None).unwrap()
}

/// The GUID of a model with its compiled-in setup.
pub(crate) fn guid(model: &str) -> &'static str {
    static GUIDS: OnceLock<BTreeMap<&str, String>> = OnceLock::new();
    let all = || LIBRARY.entries.iter().map(|entry| (entry.name, description(entry.name).guid)).collect();
    &GUIDS.get_or_init(all)[model]
}

/// A fresh instance without log but for errors.
pub(crate) fn silent(model: &str) -> InProcess {
    let mut instance = fresh(model);
    ok(instance.set_debug_logging(false, &[]));
    instance
}

/// Fails unless the call went well.
#[track_caller]
pub(crate) fn ok(status: Status) {
    assert_eq!(status, Status::Ok);
}

/// Every Real's bits.
pub(crate) fn real_bits(instance: &mut InProcess, references: &[u32]) -> Vec<u64> {
    let mut values = vec![0.0; references.len()];
    ok(instance.get_real(references, &mut values));
    values.into_iter().map(f64::to_bits).collect()
}

/// Bits of Reals, Integers, Booleans, Strings.
pub(crate) type Everything = (Vec<u64>, Vec<i32>, Vec<i32>, Vec<String>);

/// All that a master can see: Reals by their bits, Integers, Booleans and Strings.
pub(crate) fn everything(instance: &mut InProcess, names: &Names) -> Everything {
    let (integers, booleans) = (names.all(BaseType::Integer), names.all(BaseType::Boolean));
    let (mut integer_values, mut boolean_values) = (vec![0; integers.len()], vec![0; booleans.len()]);
    ok(instance.get_integer(integers, &mut integer_values));
    ok(instance.get_boolean(booleans, &mut boolean_values));
    let (status, texts) = instance.get_string(names.all(BaseType::String));
    ok(status);
    (real_bits(instance, names.all(BaseType::Real)), integer_values, boolean_values, texts)
}

/// Pseudo-random numbers, the same in every run: a Weyl sequence through an avalanche (splitmix64).
pub(crate) struct RandomNumbers(pub u64);

impl RandomNumbers {
    /// Any 64 bits.
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ (mixed >> 31)
    }

    /// Below `limit`.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        (self.bits() % limit as u64) as usize
    }

    /// From 0 to 1.
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Runs one test of this program again, in a process of its own with an environment variable set, and gives what it
/// printed. Fails unless that test was there, ran and passed.
#[track_caller]
pub(crate) fn in_a_process_of_its_own(test: &str, variable: &str, value: &OsStr) -> String {
    let output = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", test, "--nocapture"])
        .env(variable, value)
        .output()
        .unwrap();
    let printed =
        [output.stdout, output.stderr].map(|bytes| String::from_utf8_lossy(&bytes).into_owned()).concat();
    // A name that matches nothing succeeds too.
    assert!(output.status.success() && printed.contains("test result: ok. 1 passed"), "{test}: {printed}");
    printed
}

/// The path in an environment variable that `cargo xtask test` sets; without it the test prints that and ends, and fails in
/// CI.
#[track_caller]
pub(crate) fn built(variable: &str) -> Option<PathBuf> {
    let path = std::env::var_os(variable).map(PathBuf::from);
    if path.is_none() {
        assert!(std::env::var_os("CI").is_none(), "{variable} is not set");
        eprintln!("skipped: {variable} is not set (cargo xtask test sets it)");
    }
    path
}

#[test]
#[should_panic(expected = "running 0 tests")]
fn a_test_that_is_not_there_does_not_pass() {
    in_a_process_of_its_own("support::no_such_test", "HELIOTORQUE_TEST_NOTHING", OsStr::new("1"));
}
