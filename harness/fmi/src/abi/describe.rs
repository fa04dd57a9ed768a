//! The models of a heliotorque library with their descriptions: its C functions beside FMI's.

use std::{
    ffi::{CString, c_char, c_int, c_void},
    ptr,
};

use model_description::describe::{CHECK_SCHEDULE_SYMBOL, CheckSchedule, Describe, SYMBOL, kind};

use super::binary::Binary;
use crate::call_record;

/// A model in a heliotorque library.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Described {
    /// The model's name.
    pub model: String,
    /// Name of its setup file under `resources/`, if it has one.
    pub setup_file: Option<String>,
    /// Names of the schedule files under `resources/` that it takes.
    pub schedule_files: Vec<String>,
    /// The compiled-in setup text.
    pub default_setup: String,
    /// Inputs of its reference flight, over steps of the default experiment.
    pub reference_inputs: String,
    /// Description of the model, in HTML.
    pub about: String,
    /// A first example in Python, of the FMU `{fmu}`.
    pub example: String,
    /// An example in Python of a loop around the FMU `{fmu}`.
    pub closed_loop: String,
    /// Frames and units, in HTML.
    pub frames: String,
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

/// Returns all that the library sent to a call of this symbol with these texts, or why it refuses them. `call` is given pointers to the
/// texts, and the context for [`receive`].
fn received<const N: usize>(
    symbol: &str,
    texts: [Option<&str>; N],
    call: impl FnOnce([*const c_char; N], *mut c_void) -> c_int,
) -> Result<Vec<(c_int, String)>, String> {
    if texts.iter().flatten().any(|text| text.contains('\0')) {
        return Err("a text contains a zero byte".to_owned());
    }
    let texts = texts.map(|text| text.and_then(|text| CString::new(text).ok()));
    let pointers = texts.each_ref().map(|text| text.as_ref().map_or(ptr::null(), |text| text.as_ptr()));
    let mut received: Vec<(c_int, String)> = Vec::new();
    let code = call(pointers, (&raw mut received).cast());
    match received.iter().find(|(what, _)| *what == kind::ERROR) {
        Some((_, problem)) => Err(problem.clone()),
        None if code != 0 => Err(format!("{symbol} answered {code} without a reason")),
        None => Ok(received),
    }
}

impl Binary {
    /// The models of a heliotorque library.
    pub fn models(&self) -> Result<Vec<Described>, String> {
        self.call_describe(None, None, None)
    }

    /// The description of a model for a setup text (otherwise the compiled-in one); `file` names it in errors.
    pub fn describe(
        &self,
        model: &str,
        file: Option<&str>,
        setup: Option<&str>,
    ) -> Result<Described, String> {
        let mut described = self.call_describe(Some(model), file, setup)?;
        described
            .pop()
            .filter(|it| !it.xml.is_empty())
            .ok_or_else(|| format!("{model}: the library gave no XML"))
    }

    /// Whether a model takes a text, given with its name for errors, as one of its schedules, with this setup.
    pub fn check_schedule(
        &self,
        model: &str,
        file: Option<&str>,
        setup: Option<&str>,
        schedule: &str,
        (schedule_file, text): (&str, &str),
    ) -> Result<(), String> {
        // SAFETY: the symbol of this name has this type.
        let function = unsafe { self.library.get::<CheckSchedule>(CHECK_SCHEDULE_SYMBOL.as_bytes()) }
            .map_err(|_| {
                format!("{schedule_file}: the library of the template is older than this program")
            })?;
        let texts = [Some(model), file, setup, Some(schedule), Some(schedule_file), Some(text)];
        let call = |[model, file, setup, schedule, schedule_file, text]: [_; 6], context| {
            let _under_way = call_record::enter(call_record::CHECKING);
            // SAFETY: texts and list are valid during the call, which is the only time `receive` is called.
            unsafe { function(model, file, setup, schedule, schedule_file, text, context, Some(receive)) }
        };
        received(CHECK_SCHEDULE_SYMBOL, texts, call).map(drop)
    }

    fn call_describe(
        &self,
        model: Option<&str>,
        file: Option<&str>,
        setup: Option<&str>,
    ) -> Result<Vec<Described>, String> {
        // SAFETY: the symbol of this name has this type.
        let function = unsafe { self.library.get::<Describe>(SYMBOL.as_bytes()) }.map_err(|_| {
            "this is no heliotorque library: it does not export fmi_export_describe".to_owned()
        })?;
        let call = |[model, file, setup]: [_; 3], context| {
            let _under_way = call_record::enter(call_record::DESCRIBING);
            // SAFETY: texts and list are valid during the call, which is the only time `receive` is called.
            unsafe { function(model, file, setup, context, Some(receive)) }
        };
        let mut models: Vec<Described> = Vec::new();
        for (what, text) in received(SYMBOL, [model, file, setup], call)? {
            match (what, models.last_mut()) {
                (kind::XML, Some(model)) => model.xml = text,
                (kind::SETUP_TEXT, Some(model)) => model.default_setup = text,
                (kind::MODEL, _) => models.push(Described { model: text, ..Described::default() }),
                (kind::REFERENCE_INPUTS, Some(model)) => model.reference_inputs = text,
                (kind::ABOUT, Some(model)) => model.about = text,
                (kind::EXAMPLE, Some(model)) => model.example = text,
                (kind::CLOSED_LOOP, Some(model)) => model.closed_loop = text,
                (kind::FRAMES, Some(model)) => model.frames = text,
                (kind::SETUP_FILE, Some(model)) => model.setup_file = Some(text),
                (kind::SCHEDULE_FILE, Some(model)) => model.schedule_files.push(text),
                (kind::SOURCE, Some(model)) => {
                    let pair = text.split_once('\t').map(|(what, by)| (what.to_owned(), by.to_owned()));
                    model.sources.extend(pair);
                }
                _ => {}
            }
        }
        Ok(models)
    }
}
