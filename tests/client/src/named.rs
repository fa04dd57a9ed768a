//! One instance with its variables by name. A call that is not answered with `fmi2OK` fails the test, with the log.

use fmi_export::Library;
use model_description::{Description, Status};

use crate::{in_process::InProcess, names::Names};

/// An instance driven through the C functions, its variables by name.
#[derive(Debug)]
pub struct NamedInstance {
    /// The instance.
    pub fmu: InProcess,
    /// Its model description.
    pub description: Description,
    /// The last communication point, in s.
    pub time_s: f64,
    /// Its value references.
    pub names: Names,
}

impl NamedInstance {
    /// An instance and its description.
    pub fn new(fmu: InProcess, description: Description) -> Self {
        let names = Names::new(&description);
        Self { fmu, description, time_s: 0.0, names }
    }

    /// A model of a library with its compiled-in setup.
    #[track_caller]
    pub fn from_library(library: &'static Library, model: &str) -> Self {
        let entry = library.find(model);
        let entry = entry.unwrap_or_else(|| panic!("no model {model}, but {}", library.names()));
        let description =
            library.describe(entry, None, None).unwrap_or_else(|error| panic!("{model}: {error}"));
        let fmu = InProcess::instantiate(library, &description.guid, None);
        Self::new(fmu.unwrap_or_else(|messages| panic!("{model}: {messages:?}")), description)
    }

    /// The value reference of a variable.
    #[track_caller]
    pub fn at(&self, name: &str) -> u32 {
        self.find(name).unwrap_or_else(|| panic!("no variable {name}"))
    }

    /// The value reference of a variable that may be missing.
    pub fn find(&self, name: &str) -> Option<u32> {
        self.names.find(name)
    }

    /// The value references of `name[1]` to `name[N]`.
    #[track_caller]
    pub fn elements<const N: usize>(&self, name: &str) -> [u32; N] {
        core::array::from_fn(|i| self.at(&format!("{name}[{}]", i + 1)))
    }

    /// Fails unless `status` is OK.
    #[track_caller]
    pub fn ok(&self, what: &str, status: Status) {
        assert_eq!(status, Status::Ok, "{what}: {:?}", self.fmu.drain_messages());
    }

    /// Sets a Real.
    #[track_caller]
    pub fn put(&mut self, name: &str, value: f64) {
        let status = self.fmu.set_real(&[self.at(name)], &[value]);
        self.ok(name, status);
    }

    /// Sets `name[1]` to `name[N]`.
    #[track_caller]
    pub fn put_vector<const N: usize>(&mut self, name: &str, value: [f64; N]) {
        let status = self.fmu.set_real(&self.elements::<N>(name), &value);
        self.ok(name, status);
    }

    /// Sets an Integer or an item of an Enumeration.
    #[track_caller]
    pub fn put_integer(&mut self, name: &str, value: i32) {
        let status = self.fmu.set_integer(&[self.at(name)], &[value]);
        self.ok(name, status);
    }

    /// Sets a Boolean.
    #[track_caller]
    pub fn put_boolean(&mut self, name: &str, value: bool) {
        let status = self.fmu.set_boolean(&[self.at(name)], &[i32::from(value)]);
        self.ok(name, status);
    }

    /// Sets a String.
    #[track_caller]
    pub fn put_text(&mut self, name: &str, value: &str) {
        let status = self.fmu.set_string(&[self.at(name)], &[value.as_bytes()]);
        self.ok(name, status);
    }

    /// Brings a fresh instance to its first communication point.
    #[track_caller]
    pub fn begin(&mut self, start_s: f64) {
        let status = self.fmu.start(start_s, None);
        self.ok("start", status);
        self.time_s = start_s;
    }

    /// One step, of whatever status.
    pub fn try_step(&mut self, length_s: f64) -> Status {
        let status = self.fmu.do_step(self.time_s, length_s);
        self.time_s += length_s;
        status
    }

    /// One step.
    #[track_caller]
    pub fn step_to(&mut self, end_s: f64) {
        let status = self.fmu.do_step(self.time_s, end_s - self.time_s);
        self.ok("doStep", status);
        self.time_s = end_s;
    }

    /// A Real.
    #[track_caller]
    pub fn real(&mut self, name: &str) -> f64 {
        self.read(&[self.at(name)])[0]
    }

    /// `name[1]` to `name[3]`.
    #[track_caller]
    pub fn vector(&mut self, name: &str) -> [f64; 3] {
        self.array(name)
    }

    /// `name[1]` to `name[N]`.
    #[track_caller]
    pub fn array<const N: usize>(&mut self, name: &str) -> [f64; N] {
        let mut values = [f64::NAN; N];
        let status = self.fmu.get_real(&self.elements::<N>(name), &mut values);
        self.ok(name, status);
        values
    }

    /// Reals by reference.
    #[track_caller]
    pub fn read(&mut self, references: &[u32]) -> Vec<f64> {
        let mut values = vec![f64::NAN; references.len()];
        let status = self.fmu.get_real(references, &mut values);
        self.ok("getReal", status);
        values
    }

    /// An Integer or an item of an Enumeration.
    #[track_caller]
    pub fn integer(&mut self, name: &str) -> i32 {
        let mut value = [0];
        let status = self.fmu.get_integer(&[self.at(name)], &mut value);
        self.ok(name, status);
        value[0]
    }

    /// A Boolean.
    #[track_caller]
    pub fn boolean(&mut self, name: &str) -> bool {
        let mut value = [0];
        let status = self.fmu.get_boolean(&[self.at(name)], &mut value);
        self.ok(name, status);
        value[0] != 0
    }
}
