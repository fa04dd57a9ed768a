//! The C functions as a master meets them, over the probe models.

mod access;
mod allocations;
mod deferred;
mod derivatives;
mod finite;
mod library;
mod lifecycle;
mod logging;
mod panics;
mod pointers;
mod random_walk;
mod saved_bytes;
mod states;
mod stepping;
mod threads;

use client::InProcess;
use fmi_export::Library;
use fmi_export::model_description::{Description, VariableKind};

static PROBE: &Library = &probe::LIBRARY;

/// A model's description with its compiled-in setup.
fn described(model: &str) -> Description {
    PROBE.find(model).unwrap().describe(None, None).unwrap()
}

/// A fresh instance and its description.
fn fresh(model: &str) -> (InProcess, Description) {
    (InProcess::from_library(PROBE, model).unwrap(), described(model))
}

/// An instance at its first communication point, 0 s, without a stop time.
fn started(model: &str) -> (InProcess, Description) {
    let (mut instance, description) = fresh(model);
    assert_eq!(instance.start(0.0, None), fmi_export::model_description::Status::Ok);
    (instance, description)
}

/// The value reference of a variable.
fn reference(description: &Description, name: &str) -> u32 {
    let found = description.variables.iter().find(|variable| variable.name == name);
    found.unwrap_or_else(|| panic!("no variable {name}")).value_reference
}

/// Every Real's value reference.
fn all_reals(description: &Description) -> Vec<u32> {
    let reals = description.variables.iter().filter(|it| matches!(it.kind, VariableKind::Real { .. }));
    reals.map(|it| it.value_reference).collect()
}

fn real(instance: &mut InProcess, reference: u32) -> f64 {
    let mut value = [f64::NAN];
    assert_eq!(instance.get_real(&[reference], &mut value), fmi_export::model_description::Status::Ok);
    value[0]
}

/// The one message logged since the last call.
fn only_message(instance: &InProcess) -> String {
    let mut messages = instance.drain_messages();
    assert_eq!(messages.len(), 1, "{messages:?}");
    messages.remove(0).text
}

/// Splitmix64: a fixed seed gives a fixed test.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, bound: usize) -> usize {
        (self.next() % bound as u64) as usize
    }
}
