//! The panic boundary around every function that takes an instance, and what a handle is.

use core::cell::UnsafeCell;
use core::ffi::{CStr, c_char, c_int, c_void};
use core::sync::atomic::{AtomicBool, Ordering};
use std::borrow::Cow;
use std::ffi::CString;

use model_description::Status;
use model_description::call_table::{Function, State};
use model_description::functions::types::{CallbackLogger, Component, FmuState};

use super::arguments::null;
use super::instance::Instance;
use super::instance::saved::SavedState;
use super::problem::Problem;
use crate::logger::LogSink;
use crate::panics::contain;

/// Their addresses distinguish this library's handles from those of any other, another copy of this library
/// included, and instances from states.
static MARKS: [u8; 2] = [0; 2];

fn instance_mark() -> *const u8 {
    &raw const MARKS[0]
}

fn state_mark() -> *const u8 {
    &raw const MARKS[1]
}

/// Target of an `fmi2Component`.
#[repr(C)]
struct Handle {
    mark: *const u8,
    /// A call is running. A second one comes from within the logger, or from another thread at once.
    busy: AtomicBool,
    inner: UnsafeCell<Inner>,
}

/// An instance and the strings of it that the importer reads.
pub(super) struct Inner {
    pub(super) instance: Instance,
    pub(super) strings: Strings,
}

/// The C strings that `fmi2GetString` handed out: one a variable, replaced when the variable is read again
/// with another value.
pub(super) struct Strings(Vec<Option<CString>>);

impl Strings {
    /// A C string with this text (NUL replaced) in the slot of the String `index`.
    pub(super) fn hold(&mut self, index: usize, text: &str) -> *const c_char {
        let text = match text.contains('\0') {
            true => Cow::Owned(text.replace('\0', "\u{FFFD}")),
            false => Cow::Borrowed(text),
        };
        if index >= self.0.len() {
            self.0.resize(index + 1, None);
        }
        let slot = &mut self.0[index];
        if slot.as_deref().map(CStr::to_bytes) != Some(text.as_bytes()) {
            *slot = CString::new(text.into_owned()).ok();
        }
        slot.as_deref().map_or(c"".as_ptr(), CStr::as_ptr)
    }
}

/// A new handle.
pub(super) fn handle_of(instance: Instance) -> Component {
    let inner = UnsafeCell::new(Inner { instance, strings: Strings(Vec::new()) });
    let handle = Handle { mark: instance_mark(), busy: AtomicBool::new(false), inner };
    Box::into_raw(Box::new(handle)).cast()
}

/// The handle of a component, unless it is NULL or not ours.
///
/// # Safety
/// A `component` that is not NULL points to a live handle, of whatever FMU.
unsafe fn own<'a>(component: Component) -> Option<&'a Handle> {
    // SAFETY: the caller's promise; a foreign handle is larger than the mark that is read.
    let ours = !component.is_null() && unsafe { component.cast::<*const u8>().read() } == instance_mark();
    // SAFETY: ours and live.
    ours.then(|| unsafe { &*component.cast::<Handle>() })
}

/// Runs one function on one instance: finds it, keeps panics inside, gives the status.
///
/// NULL, a handle of another library, and a call from within a call answer `fmi2Error` without a message,
/// for no logger can be called safely then.
///
/// # Safety
/// As [`own`].
#[inline]
pub(super) unsafe fn call(
    component: Component,
    function: Function,
    body: impl FnOnce(&mut Inner) -> Result<(), Problem>,
) -> c_int {
    // SAFETY: the caller's promise.
    let Some(handle) = (unsafe { own(component) }) else { return Status::Error.code() };
    // Load and store rather than swap: this finds calls from the logger, which are the ones that happen.
    if handle.busy.load(Ordering::Relaxed) {
        return Status::Error.code();
    }
    handle.busy.store(true, Ordering::Relaxed);
    // SAFETY: `busy` was false, so no other call holds the inner part.
    let inner = unsafe { &mut *handle.inner.get() };
    let status = match contain(|| concluded(inner, function, body)) {
        Ok(status) => status,
        Err(text) => panicked(inner, function, &text),
    };
    handle.busy.store(false, Ordering::Relaxed);
    status.code()
}

#[inline]
fn concluded(
    inner: &mut Inner,
    function: Function,
    body: impl FnOnce(&mut Inner) -> Result<(), Problem>,
) -> Status {
    let usable = !inner.instance.poisoned || function == Function::FreeFmuState;
    let result = match usable {
        true => inner.instance.guard(function).and_then(|()| body(inner)),
        false => Err(Problem::error(
            "a panic ended this instance before; only fmi2FreeInstance and fmi2FreeFMUstate still work",
        )),
    };
    inner.instance.conclude(function, result)
}

#[cold]
fn panicked(inner: &mut Inner, function: Function, text: &str) -> Status {
    // No call but free works from here on.
    inner.instance.poisoned = true;
    inner.instance.state.mode = State::Error;
    let logger = &inner.instance.logger;
    // The logger itself may have been what panicked.
    let _ = contain(|| logger.log(Status::Error, format_args!("{}: panic: {text}", function.symbol())));
    Status::Error
}

/// `fmi2FreeInstance`.
///
/// # Safety
/// As [`own`]; the component is not used again.
pub(super) unsafe fn free(component: Component) {
    // SAFETY: the caller's promise.
    let Some(handle) = (unsafe { own(component) }) else { return };
    if handle.busy.load(Ordering::Relaxed) {
        return;
    }
    // SAFETY: ours, made by `handle_of`, not in a call, and never used again.
    let handle = unsafe { Box::from_raw(component.cast::<Handle>()) };
    let Instance { logger, runtime, .. } = handle.inner.into_inner().instance;
    if let Err(text) = contain(|| drop(runtime)) {
        let symbol = Function::FreeInstance.symbol();
        let _ = contain(|| logger.log(Status::Error, format_args!("{symbol}: panic: {text}")));
    }
    let _ = contain(|| drop(logger));
}

/// Target of an `fmi2FMUstate`.
#[repr(C)]
pub(super) struct StateHandle {
    mark: *const u8,
    saved: SavedState,
}

/// A new state handle.
pub(super) fn state_handle_of(saved: SavedState) -> FmuState {
    Box::into_raw(Box::new(StateHandle { mark: state_mark(), saved })).cast()
}

/// The saved state of an FMU state.
///
/// # Safety
/// A `state` that is not NULL points to a live FMU state, of whatever FMU, that nobody else uses meanwhile.
pub(super) unsafe fn saved<'a>(state: FmuState) -> Result<&'a mut SavedState, Problem> {
    if state.is_null() {
        return Err(null("FMUstate"));
    }
    // SAFETY: the caller's promise; a foreign state is larger than the mark that is read.
    if unsafe { state.cast::<*const u8>().read() } != state_mark() {
        return Err(Problem::argument("FMUstate", "was not made by this library"));
    }
    // SAFETY: ours and live.
    Ok(unsafe { &mut (*state.cast::<StateHandle>()).saved })
}

/// Frees a state that [`saved`] accepts.
///
/// # Safety
/// As [`saved`]; the state is not used again.
pub(super) unsafe fn free_state(state: FmuState) -> Result<(), Problem> {
    // SAFETY: the caller's promise.
    unsafe { saved(state) }?;
    // SAFETY: ours, made by `state_handle_of`, and never used again.
    drop(unsafe { Box::from_raw(state.cast::<StateHandle>()) });
    Ok(())
}

/// The importer's logger with its environment.
pub(super) struct ImporterLogger {
    pub(super) logger: CallbackLogger,
    pub(super) environment: *mut c_void,
}

// SAFETY: the environment is only handed back to the importer's own logger, in calls that the importer makes, from
// threads that it chooses.
unsafe impl Send for ImporterLogger {}

impl LogSink for ImporterLogger {
    fn write(&self, instance_name: &CStr, status: Status, category: &CStr, message: &CStr) {
        // SAFETY: the pointer is valid until the instance is freed (2.1.5); the message holds no format
        // directive, so no further argument is read.
        unsafe {
            (self.logger)(
                self.environment,
                instance_name.as_ptr(),
                status.code(),
                category.as_ptr(),
                message.as_ptr(),
            );
        }
    }
}
