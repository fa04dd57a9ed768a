//! SpinPlant through FMI's functions, its variables by name.

use std::collections::HashMap;

use client::{InProcess, Message};
use fmi_export::{Entry, Library, Status};
use model_description::{Causality, Description, VariableKind};
use models::SpinPlant;

pub static LIBRARY: Library = Library { entries: &[Entry::of::<SpinPlant>()] };

pub fn description() -> Description {
    LIBRARY.find("SpinPlant").unwrap().describe(None, None).unwrap()
}

pub struct Spinner {
    pub fmu: InProcess,
    names: HashMap<String, u32>,
    real_outputs: Vec<u32>,
    pub time_s: f64,
}

impl Spinner {
    pub fn new() -> Self {
        let variables = description().variables;
        let real_outputs = variables
            .iter()
            .filter(|v| v.causality == Causality::Output && matches!(v.kind, VariableKind::Real { .. }))
            .map(|v| v.value_reference)
            .collect();
        let names = variables.into_iter().map(|v| (v.name, v.value_reference)).collect();
        Self { fmu: InProcess::of(&LIBRARY, "SpinPlant").unwrap(), names, real_outputs, time_s: 0.0 }
    }

    pub fn at(&self, name: &str) -> u32 {
        *self.names.get(name).unwrap_or_else(|| panic!("no variable {name}"))
    }

    pub fn set(mut self, name: &str, value: f64) -> Self {
        self.put(name, value);
        self
    }

    pub fn put(&mut self, name: &str, value: f64) {
        let at = self.at(name);
        assert_eq!(self.fmu.set_real(&[at], &[value]), Status::Ok, "{name} = {value}");
    }

    pub fn set_integer(mut self, name: &str, value: i32) -> Self {
        let at = self.at(name);
        assert_eq!(self.fmu.set_integer(&[at], &[value]), Status::Ok, "{name} = {value}");
        self
    }

    pub fn set_text(mut self, name: &str, value: &str) -> Self {
        let at = self.at(name);
        assert_eq!(self.fmu.set_string(&[at], &[value.as_bytes()]), Status::Ok);
        self
    }

    pub fn fire(&mut self, thruster: u32, on: bool) {
        let at = self.at(&format!("thruster[{thruster}].fire"));
        assert_eq!(self.fmu.set_boolean(&[at], &[i32::from(on)]), Status::Ok);
    }

    pub fn start(mut self) -> Self {
        assert_eq!(self.fmu.start(0.0, None), Status::Ok, "{:?}", self.fmu.take_messages());
        self
    }

    pub fn refusal(mut self) -> String {
        assert_ne!(self.fmu.start(0.0, None), Status::Ok);
        self.fmu.take_messages().into_iter().map(|Message { text, .. }| text).collect()
    }

    pub fn to(&mut self, end_s: f64) {
        let length_s = end_s - self.time_s;
        assert_eq!(self.fmu.do_step(self.time_s, length_s), Status::Ok, "{:?}", self.fmu.take_messages());
        self.time_s = end_s;
    }

    pub fn real(&mut self, name: &str) -> f64 {
        let (at, mut value) = (self.at(name), [0.0]);
        assert_eq!(self.fmu.get_real(&[at], &mut value), Status::Ok);
        value[0]
    }

    pub fn integer(&mut self, name: &str) -> i32 {
        let (at, mut value) = (self.at(name), [0]);
        assert_eq!(self.fmu.get_integer(&[at], &mut value), Status::Ok);
        value[0]
    }

    pub fn boolean(&mut self, name: &str) -> bool {
        let (at, mut value) = (self.at(name), [0]);
        assert_eq!(self.fmu.get_boolean(&[at], &mut value), Status::Ok);
        value[0] != 0
    }

    /// Every Real output.
    pub fn outputs(&mut self) -> Vec<f64> {
        let mut values = vec![0.0; self.real_outputs.len()];
        assert_eq!(self.fmu.get_real(&self.real_outputs, &mut values), Status::Ok);
        values
    }
}

pub fn assert_names(text: &str, parts: &[&str]) {
    for part in parts {
        assert!(text.contains(part), "`{part}` is missing from: {text}");
    }
}
