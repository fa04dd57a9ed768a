//! SpinPlant through FMI's functions, its variables by name.

use core::ops::{Deref, DerefMut};

use client::{Message, NamedInstance};
use fmi_export::fmi2::entry;
use fmi_export::{Library, Status};
use model_description::{Causality, VariableKind};
use models::SpinPlant;

static LIBRARY: Library = Library { entries: &[entry::<SpinPlant>()] };

pub(super) struct Spinner {
    named: NamedInstance,
    real_outputs: Vec<u32>,
}

impl Deref for Spinner {
    type Target = NamedInstance;

    fn deref(&self) -> &NamedInstance {
        &self.named
    }
}

impl DerefMut for Spinner {
    fn deref_mut(&mut self) -> &mut NamedInstance {
        &mut self.named
    }
}

impl Spinner {
    pub(super) fn new() -> Self {
        let named = NamedInstance::from_library(&LIBRARY, "SpinPlant");
        let real_outputs = named
            .description
            .variables
            .iter()
            .filter(|v| v.causality == Causality::Output && matches!(v.kind, VariableKind::Real { .. }))
            .map(|v| v.value_reference)
            .collect();
        Self { named, real_outputs }
    }

    pub(super) fn set(mut self, name: &str, value: f64) -> Self {
        self.put(name, value);
        self
    }

    pub(super) fn set_integer(mut self, name: &str, value: i32) -> Self {
        self.put_integer(name, value);
        self
    }

    pub(super) fn set_text(mut self, name: &str, value: &str) -> Self {
        self.put_text(name, value);
        self
    }

    pub(super) fn fire(&mut self, thruster: u32, on: bool) {
        self.put_boolean(&format!("thruster[{thruster}].fire"), on);
    }

    pub(super) fn start(mut self) -> Self {
        self.begin(0.0);
        self
    }

    pub(super) fn refusal(mut self) -> String {
        assert_ne!(self.fmu.start(0.0, None), Status::Ok);
        self.fmu.drain_messages().into_iter().map(|Message { text, .. }| text).collect()
    }

    pub(super) fn to(&mut self, end_s: f64) {
        self.step_to(end_s);
    }

    /// Every Real output.
    pub(super) fn outputs(&mut self) -> Vec<f64> {
        self.named.read(&self.real_outputs)
    }
}

pub(super) fn assert_names(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing from: {text}");
    }
}
