//! The timeline of a new FMU, read by the library that will fly it.

use loader::{Binary, Described};

/// The file's name in the resources, if the model takes this text with this setup; `file` names it in errors.
pub fn checked(
    binary: &Binary,
    described: &Described,
    setup_file: Option<&str>,
    setup: &str,
    (file, text): (&str, &str),
) -> Result<String, String> {
    let model = &described.model;
    let Some(name) = &described.schedule_file else {
        let models = binary.models()?.into_iter().filter(|model| model.schedule_file.is_some());
        let names: Vec<String> = models.map(|model| model.model).collect();
        let allowed = if names.is_empty() { "no model of this library".to_owned() } else { names.join(", ") };
        return Err(format!("--timeline: {model} takes none, allowed for: {allowed}"));
    };
    let setup = described.setup_file.as_ref().map(|_| setup);
    binary.check_schedule(model, setup_file, setup, (file, text))?;
    Ok(name.clone())
}
