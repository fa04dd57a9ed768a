//! The models of a heliotorque library with their descriptions: the C function `fmi_export_describe`.

use std::{
    ffi::{CString, c_char, c_int, c_void},
    ptr,
};

use model_description::describe::{Describe, SYMBOL, kind};

use super::binary::Binary;

/// A model in a heliotorque library.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Described {
    /// The model's name.
    pub model: String,
    /// Name of its setup file under `resources/`, if it has one.
    pub setup_file: Option<String>,
    /// Name of its schedule file under `resources/`, if it takes one.
    pub schedule_file: Option<String>,
    /// The compiled-in setup text.
    pub default_setup: String,
    /// Quantities and by what they are computed; names of papers and what they stand for.
    pub sources: Vec<(String, String)>,
    /// The `modelDescription.xml`; empty where the models are only listed.
    pub xml: String,
}

/// Collects what `fmi_export_describe` sends: a kind and a text at a time.
unsafe extern "C" fn receive(context: *mut c_void, kind: c_int, text: *const c_char, length: usize) {
    // SAFETY: the context is the list given to the call; the text has this length and is valid until we return.
    unsafe {
        let Some(received) = context.cast::<Vec<(c_int, String)>>().as_mut() else { return };
        let bytes = if length == 0 { &[] } else { std::slice::from_raw_parts(text.cast::<u8>(), length) };
        received.push((kind, String::from_utf8_lossy(bytes).into_owned()));
    }
}

impl Binary {
    /// The models of a heliotorque library.
    pub fn models(&self) -> Result<Vec<Described>, String> {
        self.call_describe(None, None, None, None)
    }

    /// The description of a model for a setup text (otherwise the compiled-in one); `file` names it in errors.
    pub fn describe(
        &self,
        model: &str,
        file: Option<&str>,
        setup: Option<&str>,
    ) -> Result<Described, String> {
        self.describe_with_schedule(model, file, setup, None)
    }

    /// The same once more with a schedule that is checked too: its name for errors and its text.
    pub fn describe_with_schedule(
        &self,
        model: &str,
        file: Option<&str>,
        setup: Option<&str>,
        schedule: Option<(&str, &str)>,
    ) -> Result<Described, String> {
        let mut described = self.call_describe(Some(model), file, setup, schedule)?;
        described
            .pop()
            .filter(|it| !it.xml.is_empty())
            .ok_or_else(|| format!("{model}: the library gave no XML"))
    }

    fn call_describe(
        &self,
        model: Option<&str>,
        file: Option<&str>,
        setup: Option<&str>,
        schedule: Option<(&str, &str)>,
    ) -> Result<Vec<Described>, String> {
        // SAFETY: the symbol of this name has this type.
        let function = unsafe { self.library.get::<Describe>(SYMBOL.as_bytes()) }.map_err(|_| {
            "this is no heliotorque library: it does not export fmi_export_describe".to_owned()
        })?;
        let c_text = |text: Option<&str>| {
            text.map(CString::new).transpose().map_err(|_| "a text contains a zero byte".to_owned())
        };
        let (model, file, setup) = (c_text(model)?, c_text(file)?, c_text(setup)?);
        let (schedule_file, schedule) = schedule.unzip();
        let (schedule_file, schedule) = (c_text(schedule_file)?, c_text(schedule)?);
        let pointer = |text: &Option<CString>| text.as_ref().map_or(ptr::null(), |text| text.as_ptr());
        let mut received: Vec<(c_int, String)> = Vec::new();
        // SAFETY: texts and list are valid during the call, which is the only time `receive` is called.
        let code = unsafe {
            function(
                pointer(&model),
                pointer(&file),
                pointer(&setup),
                pointer(&schedule_file),
                pointer(&schedule),
                (&raw mut received).cast(),
                Some(receive),
            )
        };
        let mut models: Vec<Described> = Vec::new();
        let mut problem = None;
        for (what, text) in received {
            match (what, models.last_mut()) {
                (kind::XML, Some(model)) => model.xml = text,
                (kind::ERROR, _) => problem = Some(text),
                (kind::SETUP_TEXT, Some(model)) => model.default_setup = text,
                (kind::MODEL, _) => models.push(Described { model: text, ..Described::default() }),
                (kind::SETUP_FILE, Some(model)) => model.setup_file = Some(text),
                (kind::SCHEDULE_FILE, Some(model)) => model.schedule_file = Some(text),
                (kind::SOURCE, Some(model)) => {
                    let pair = text.split_once('\t').map(|(what, by)| (what.to_owned(), by.to_owned()));
                    model.sources.extend(pair);
                }
                _ => {}
            }
        }
        match problem {
            None if code == 0 => Ok(models),
            None => Err(format!("fmi_export_describe answered {code} without a reason")),
            Some(problem) => Err(problem),
        }
    }
}
