//! The bodies of `fmi_export_describe` and `fmi_export_check_schedule_file`, see [`model_description::describe`].

use core::ffi::{c_char, c_int, c_void};

use model_description::describe::{Receive, kind};

use super::arguments::text;
use crate::library::{Entry, Library};
use crate::model::Manual;
use crate::panics::contain;
use crate::prepared::DescribeError;

/// Sends texts to a caller.
struct Sender {
    context: *mut c_void,
    receive: Receive,
}

impl Sender {
    fn send(&self, kind: i32, text: &str) {
        // SAFETY: the promise of whoever called the C function; the text is valid until `receive` returns.
        unsafe { (self.receive)(self.context, kind, text.as_ptr().cast(), text.len()) }
    }

    fn introduce(&self, entry: &Entry) {
        self.send(kind::MODEL, entry.name);
        if let Some(file) = entry.setup_file {
            self.send(kind::SETUP_FILE, file);
        }
        for file in entry.schedule_files {
            self.send(kind::SCHEDULE_FILE, file);
        }
        let Manual { about, example, closed_loop, frames, .. } = entry.manual;
        let texts = [
            (kind::SETUP_TEXT, entry.default_setup),
            (kind::REFERENCE_INPUTS, entry.reference_inputs),
            (kind::ABOUT, about),
            (kind::EXAMPLE, example),
            (kind::CLOSED_LOOP, closed_loop),
            (kind::FRAMES, frames),
        ];
        for (kind, text) in texts {
            self.send(kind, text);
        }
        for (what, by) in entry.manual.sources() {
            self.send(kind::SOURCE, &format!("{what}\t{by}"));
        }
    }

    /// Runs `body`: 0, or 1 after its error or panic was sent.
    fn run(&self, body: impl FnOnce() -> Result<(), String>) -> c_int {
        let problem = match contain(body) {
            Ok(Ok(())) => return 0,
            Ok(Err(problem)) => problem,
            Err(panic) => format!("panic: {panic}"),
        };
        let _ = contain(|| self.send(kind::ERROR, &problem));
        1
    }
}

/// `fmi_export_describe` over the models of a library, with the arguments of that C function.
///
/// # Safety
/// Every pointer is NULL or a NUL-terminated string that is valid during the call; `receive` may be called with
/// `context`.
pub unsafe fn describe(
    library: &Library,
    model: *const c_char,
    setup_file: *const c_char,
    setup_text: *const c_char,
    context: *mut c_void,
    receive: Option<Receive>,
) -> c_int {
    let Some(receive) = receive else { return 1 };
    let sender = Sender { context, receive };
    sender.run(|| {
        if model.is_null() {
            library.entries.iter().for_each(|entry| sender.introduce(entry));
            return Ok(());
        }
        // SAFETY: the caller's promise.
        let given = |text, name| unsafe { optional(text, name) };
        let (model, file) = (given(model, "model")?, given(setup_file, "setup_file")?);
        let setup = given(setup_text, "setup_text")?;
        let entry = found(library, model.unwrap_or_default())?;
        let description =
            library.describe(entry, file, setup).map_err(|error| message(entry.name, &error))?;
        sender.introduce(entry);
        sender.send(kind::XML, &model_description::to_xml(&description));
        Ok(())
    })
}

/// `fmi_export_check_schedule_file` over the models of a library.
///
/// # Safety
/// As [`describe`].
#[allow(clippy::too_many_arguments, reason = "the signature of `CheckSchedule`")]
pub unsafe fn check_schedule(
    library: &Library,
    model: *const c_char,
    setup_file: *const c_char,
    setup_text: *const c_char,
    schedule: *const c_char,
    schedule_file: *const c_char,
    schedule_text: *const c_char,
    context: *mut c_void,
    receive: Option<Receive>,
) -> c_int {
    let Some(receive) = receive else { return 1 };
    Sender { context, receive }.run(|| {
        // SAFETY: the caller's promise.
        let given = |text, name| unsafe { optional(text, name) };
        let (model, file) = (given(model, "model")?, given(setup_file, "setup_file")?);
        let (setup, schedule) = (given(setup_text, "setup_text")?, given(schedule, "schedule")?);
        let (schedule_file, text) =
            (given(schedule_file, "schedule_file")?, given(schedule_text, "schedule_text")?);
        let entry = found(library, model.unwrap_or_default())?;
        let schedule = schedule.ok_or("argument schedule is NULL")?;
        let text = text.ok_or("argument schedule_text is NULL")?;
        let schedule_file = schedule_file.unwrap_or(schedule);
        if !entry.schedule_files.contains(&schedule) {
            return Err(format!("{schedule_file}: {} takes no {schedule}", entry.name));
        }
        let prepared = entry.prepare(file, setup, library.entries);
        prepared
            .and_then(|mut prepared| prepared.set_schedule(schedule, schedule_file, text))
            .map_err(|error| message(entry.name, &error))
    })
}

fn found(library: &Library, model: &str) -> Result<&'static Entry, String> {
    library
        .find(model)
        .ok_or_else(|| format!("no model `{model}` in this library; it has {}", library.names()))
}

fn message(model: &str, error: &DescribeError) -> String {
    match error {
        // They name their file and line first, where editors expect them.
        DescribeError::Setup(problem) => problem.to_string(),
        DescribeError::Start(problems) => problems.clone(),
        other => format!("{model}: {other}"),
    }
}

/// # Safety
/// As [`describe`].
unsafe fn optional<'a>(pointer: *const c_char, name: &'static str) -> Result<Option<&'a str>, String> {
    // SAFETY: the caller's promise.
    match unsafe { text(pointer, name) } {
        Ok(text) => text.to_str().map(Some).map_err(|error| format!("argument {name} is not UTF-8: {error}")),
        Err(_) => Ok(None),
    }
}
