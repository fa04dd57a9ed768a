//! The functions that a library of this project exports next to FMI's: packers obtain a model's description from
//! `fmi_export_describe`, and have a schedule judged by `fmi_export_check_schedule_file`.

use core::ffi::{c_char, c_int, c_void};

/// Name of the symbol.
pub const SYMBOL: &str = "fmi_export_describe";

/// A text of the caller, or NULL.
pub type Text = *const c_char;

/// Takes one text: the caller's context, the [`kind`], the UTF-8 text and its length in bytes. The text is the library's
/// and is valid until the function returns.
pub type Receive = unsafe extern "C" fn(*mut c_void, c_int, *const c_char, usize);

/// `fmi_export_describe(model, setup_file, setup_text, context, receive)`.
///
/// With `model` NULL the models are listed: for each one its name, the name of its setup file under `resources/` (left
/// out if it has none), those of its schedule files likewise, one at a time, its compiled-in setup text, the inputs of its reference
/// flight, the beginning of its manual, and by what it computes, one `quantity TAB source` at a time. With a model's name: the same, then the `modelDescription.xml` for `setup_text`, or for
/// the compiled-in text if that is NULL. `setup_file` names the text in errors; NULL means the model's own file name. Returns
/// 0, or 1 after an error was sent. The texts given stay the caller's and are not kept; `context` goes to `receive` unread.
pub type Describe = unsafe extern "C" fn(Text, Text, Text, *mut c_void, Option<Receive>) -> c_int;

/// Name of the symbol of [`CheckSchedule`].
pub const CHECK_SCHEDULE_SYMBOL: &str = "fmi_export_check_schedule_file";

/// `fmi_export_check_schedule_file(model, setup_file, setup_text, schedule, schedule_file, schedule_text, context,
/// receive)`.
///
/// Whether the model takes this text as its `schedule`, one of the [`kind::SCHEDULE_FILE`]s it was introduced with, with this
/// setup: 0, or 1 after an error was sent. Everything else as in [`Describe`]; `schedule_file` names the text in errors; NULL
/// means `schedule` itself.
pub type CheckSchedule =
    unsafe extern "C" fn(Text, Text, Text, Text, Text, Text, *mut c_void, Option<Receive>) -> c_int;

/// Kinds of texts that are received.
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
    /// Name of a schedule file under `resources/`.
    pub const SCHEDULE_FILE: i32 = 6;
    /// Inputs of the model's reference flight: CSV whose first column, `time`, counts steps of the default experiment.
    pub const REFERENCE_INPUTS: i32 = 7;
    /// Purpose of the model, in HTML, for its manual.
    pub const ABOUT: i32 = 8;
    /// A first example in Python, of the FMU `{fmu}`.
    pub const EXAMPLE: i32 = 9;
    /// An example in Python of a loop around the FMU `{fmu}`.
    pub const CLOSED_LOOP: i32 = 10;
    /// Frames and units, in HTML.
    pub const FRAMES: i32 = 11;
}
