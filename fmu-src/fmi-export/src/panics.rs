//! A panic stays inside: caught, turned into text, and its payload buried.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// Runs `body`; a panic becomes its text.
///
/// Whatever `body` borrowed may be half changed after a panic: the caller must not use it further, except to
/// drop it or to read plain data.
#[inline]
pub(crate) fn contain<T>(body: impl FnOnce() -> T) -> Result<T, String> {
    catch_unwind(AssertUnwindSafe(body)).map_err(bury)
}

/// The text of a panic. Dropping the payload may panic in turn; then that payload is leaked.
#[cold]
fn bury(payload: Box<dyn Any + Send>) -> String {
    let text = match (payload.downcast_ref::<&str>(), payload.downcast_ref::<String>()) {
        (Some(text), _) => (*text).to_owned(),
        (_, Some(text)) => text.clone(),
        _ => "a payload that is no text".to_owned(),
    };
    if let Err(second) = catch_unwind(AssertUnwindSafe(|| drop(payload))) {
        core::mem::forget(second);
    }
    text
}
