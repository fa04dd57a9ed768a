//! The body of `fmi_export_describe`, see [`model_description::describe`].

use core::ffi::{c_char, c_int, c_void};

use model_description::describe::{Receive, kind};

use super::arguments::text;
use super::description::DescribeError;
use super::library::{Entry, Library};
use crate::panics::contain;

/// `fmi_export_describe` over the models of a library.
///
/// # Safety
/// Every pointer is NULL or a NUL-terminated string that is valid during the call; `receive` may be called with
/// `context`.
#[allow(clippy::too_many_arguments, reason = "the signature of `Describe`")]
pub unsafe fn describe(
    library: &Library,
    model: *const c_char,
    setup_file: *const c_char,
    setup_text: *const c_char,
    schedule_file: *const c_char,
    schedule_text: *const c_char,
    context: *mut c_void,
    receive: Option<Receive>,
) -> c_int {
    let Some(receive) = receive else { return 1 };
    let send = |kind: i32, text: &str| {
        // SAFETY: the caller's promise; the text is valid until `receive` returns.
        unsafe { receive(context, kind, text.as_ptr().cast(), text.len()) }
    };
    let introduce = |entry: &Entry| {
        send(kind::MODEL, entry.name());
        if let Some(file) = entry.setup_file() {
            send(kind::SETUP_FILE, file);
        }
        if let Some(file) = entry.schedule_file() {
            send(kind::SCHEDULE_FILE, file);
        }
        send(kind::SETUP_TEXT, entry.default_setup());
        for source in entry.sources() {
            send(kind::SOURCE, &format!("{}\t{}", source.what, source.by));
        }
    };
    let done = contain(|| {
        if model.is_null() {
            library.entries.iter().for_each(introduce);
            return Ok(());
        }
        // SAFETY: the caller's promise.
        let (model, file, setup, schedule_file, schedule) = unsafe {
            (
                optional(model, "model")?,
                optional(setup_file, "setup_file")?,
                optional(setup_text, "setup_text")?,
                optional(schedule_file, "schedule_file")?,
                optional(schedule_text, "schedule_text")?,
            )
        };
        let schedule = schedule.map(|text| (schedule_file, text));
        let model = model.unwrap_or_default();
        let entry = library
            .find(model)
            .ok_or_else(|| format!("no model `{model}` in this library; it has {}", library.names()))?;
        let description =
            library.describe_with_schedule(entry, file, setup, schedule).map_err(|error| match error {
                // They name their file and line first, where editors expect them.
                DescribeError::Setup(problem) => problem.to_string(),
                DescribeError::Start(problems) => problems,
                other => format!("{model}: {other}"),
            })?;
        introduce(entry);
        send(kind::XML, &model_description::to_xml(&description));
        Ok(())
    });
    let problem = match done {
        Ok(Ok(())) => return 0,
        Ok(Err(problem)) => problem,
        Err(panic) => format!("panic: {panic}"),
    };
    let _ = contain(|| send(kind::ERROR, &problem));
    1
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
