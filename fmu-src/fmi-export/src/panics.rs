//! A panic stays inside: caught, turned into text, and its payload dropped.

use core::cell::Cell;
use std::any::Any;
use std::panic::{AssertUnwindSafe, PanicHookInfo, catch_unwind, set_hook};
use std::sync::Once;

/// Source location of the last panic of a thread.
#[derive(Clone, Copy)]
struct PanicLocation {
    file: [u8; Self::LONGEST],
    line: u32,
}

impl PanicLocation {
    const LONGEST: usize = 96;
}

thread_local! {
    // Without a destructor, which would keep the library in memory after it is unloaded.
    static PLACE: Cell<Option<PanicLocation>> = const { Cell::new(None) };
}

/// For a shared library, whose every panic is contained: nothing goes to standard error. The standard hook, if RUST_BACKTRACE
/// is set, would also map the library's file into memory for good.
pub fn silence() {
    static ONCE: Once = Once::new();
    // Neither captures anything, so nothing is allocated that an unloaded library would leak.
    ONCE.call_once(|| set_hook(Box::new(note)));
}

fn note(info: &PanicHookInfo<'_>) {
    let place = info.location().map(|location| {
        let mut file = [0; PanicLocation::LONGEST];
        // The end of a long path identifies the file better than its beginning.
        let bytes = location.file().as_bytes();
        let end = &bytes[bytes.len().saturating_sub(PanicLocation::LONGEST)..];
        file[..end.len()].copy_from_slice(end);
        PanicLocation { file, line: location.line() }
    });
    PLACE.set(place);
}

/// Runs `body`; a panic becomes its text.
///
/// Whatever `body` borrowed may be half changed after a panic: the caller must not use it further, except to
/// drop it or to read plain data.
#[inline]
pub(crate) fn contain<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(body)).map_err(text_of)
}

/// The text of a panic. Dropping the payload may panic in turn; then that payload is dropped if it is text, else leaked.
#[cold]
fn text_of(payload: Box<dyn Any + Send>) -> String {
    let mut text = match (payload.downcast_ref::<&str>(), payload.downcast_ref::<String>()) {
        (Some(text), _) => (*text).to_owned(),
        (_, Some(text)) => text.clone(),
        _ => "a payload that is no text".to_owned(),
    };
    if let Some(PanicLocation { file, line }) = PLACE.take() {
        let file = String::from_utf8_lossy(&file);
        text.push_str(&format!(" ({}, line {line})", file.trim_end_matches('\0')));
    }
    if let Err(second) = catch_unwind(AssertUnwindSafe(|| drop(payload))) {
        // Text is dropped without a panic; anything else may panic again.
        if !second.is::<String>() && !second.is::<&str>() {
            core::mem::forget(second);
        }
    }
    text
}
