//! `fmi_export_describe`: the one function beside FMI's, from which packers obtain descriptions.
//!
//! ```c
//! int fmi_export_describe(const char* model, const char* setup_file, const char* setup_text, void* context,
//!                         void (*receive)(void* context, int kind, const char* utf8, size_t length));
//! ```
//!
//! With `model` NULL the models are listed: for each one its name, the name of its setup file under
//! `resources/` (left out if it has none), its compiled-in setup text, and by what it computes, one `quantity TAB
//! source` at a time. With a model's name: the same, then the `modelDescription.xml` for `setup_text`, or for the
//! compiled-in text if that is NULL. `setup_file` names the text in errors; NULL means the model's own file name.
//! Returns 0, or 1 after an error was received. The texts are UTF-8 of the given length, without a NUL at the end, and live until `receive` returns.

use core::ffi::{c_char, c_int, c_void};

use super::arguments::text;
use crate::describe::DescribeError;
use crate::library::{Entry, Library};
use crate::panics::contain;

/// Takes one text; see the module.
pub type Receive = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, usize);

/// What a received text is.
pub mod kind {
    /// The `modelDescription.xml`.
    pub const XML: i32 = 0;
    /// Why there is none.
    pub const ERROR: i32 = 1;
    /// The compiled-in setup text.
    pub const SETUP_TEXT: i32 = 2;
    /// A model's name.
    pub const MODEL: i32 = 3;
    /// Name of the setup file under `resources/`.
    pub const SETUP_FILE: i32 = 4;
    /// A quantity, a tab and by what it is computed.
    pub const SOURCE: i32 = 5;
}

/// `fmi_export_describe` over the models of a library.
///
/// # Safety
/// Every pointer is NULL or a NUL-terminated string; `receive` may be called with `context`.
pub unsafe fn describe(
    library: &Library,
    model: *const c_char,
    setup_file: *const c_char,
    setup_text: *const c_char,
    context: *mut c_void,
    receive: Option<Receive>,
) -> c_int {
    let Some(receive) = receive else { return 1 };
    let send = |kind: i32, text: &str| {
        // SAFETY: the caller's promise; the text lives until `receive` returns.
        unsafe { receive(context, kind, text.as_ptr().cast(), text.len()) }
    };
    let introduce = |entry: &Entry| {
        send(kind::MODEL, entry.name());
        if let Some(file) = entry.setup_file() {
            send(kind::SETUP_FILE, file);
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
        let (model, file, setup) = unsafe {
            (
                optional(model, "model")?,
                optional(setup_file, "setup_file")?,
                optional(setup_text, "setup_text")?,
            )
        };
        let model = model.unwrap_or_default();
        let entry = library
            .find(model)
            .ok_or_else(|| format!("no model `{model}` in this library; it has {}", library.names()))?;
        let description = library.describe(entry, file, setup).map_err(|error| match error {
            // They name their file and line first, where editors look for them.
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
