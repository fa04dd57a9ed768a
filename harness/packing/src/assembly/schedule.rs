//! Files packed beside the spacecraft, commands over time and ephemerides, read by the library that simulates it.

use fmi::{Binary, Described};

use crate::carried::ephemeris::FILE;

/// A file that `pack` takes beside the spacecraft.
pub(super) struct CarriedFile {
    /// The option that names it.
    pub option: &'static str,
    /// Its name in an FMU's resources; `None`: whatever the model takes first.
    pub resource: Option<&'static str>,
}

/// Commands over time; models of other libraries may call theirs otherwise.
pub(super) const TIMELINE: CarriedFile = CarriedFile { option: "--timeline", resource: None };

/// Positions over time.
pub(super) const EPHEMERIS: CarriedFile = CarriedFile { option: "--ephemeris", resource: Some(FILE) };

impl CarriedFile {
    /// Its name in the resources of a model that takes it.
    fn name_in<'d>(&self, model: &'d Described) -> Option<&'d str> {
        let mut names = model.schedule_files.iter().map(String::as_str);
        match self.resource {
            Some(resource) => names.find(|name| *name == resource),
            None => names.find(|name| *name != FILE),
        }
    }

    /// The file's name in the resources, if the model takes this text with this setup; `file` names it in errors.
    pub(super) fn checked(
        &self,
        binary: &Binary,
        described: &Described,
        setup_file: Option<&str>,
        setup: &str,
        (file, text): (&str, &str),
    ) -> Result<String, String> {
        let model = &described.model;
        let Some(name) = self.name_in(described) else {
            let models = binary.models()?.into_iter().filter(|model| self.name_in(model).is_some());
            let names: Vec<String> = models.map(|model| model.model).collect();
            let allowed =
                if names.is_empty() { "no model of this library".to_owned() } else { names.join(", ") };
            return Err(format!("{}: {model} takes none, allowed for: {allowed}", self.option));
        };
        let setup = described.setup_file.as_ref().map(|_| setup);
        binary.check_schedule(model, setup_file, setup, name, (file, text))?;
        Ok(name.to_owned())
    }
}
