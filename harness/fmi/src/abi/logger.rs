//! The callbacks an importer gives, and where an instance's messages arrive.

use std::{
    collections::VecDeque,
    ffi::{c_char, c_int, c_void},
    sync::{Mutex, MutexGuard, PoisonError},
};

use model_description::Status;

use super::text::text;
use crate::LogMessage;

pub(super) type FixedLogger =
    unsafe extern "C" fn(*mut c_void, *const c_char, c_int, *const c_char, *const c_char);

/// Messages kept per instance; older ones go first.
const MESSAGES_KEPT: usize = 1000;

/// Buffer of an instance's messages; its address is the `componentEnvironment`.
#[derive(Default)]
pub(super) struct MessageBuffer {
    messages: Mutex<VecDeque<LogMessage>>,
}

impl MessageBuffer {
    pub(super) fn messages(&self) -> MutexGuard<'_, VecDeque<LogMessage>> {
        self.messages.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Takes a message of the FMU that runs in this instance.
///
/// The standard's logger is variadic, which stable Rust cannot define; a caller's further arguments are left
/// unread, which the calling conventions in use (System V, Win64, AAPCS64 Linux) permit.
pub(super) unsafe extern "C" fn log_message(
    environment: *mut c_void,
    _instance: *const c_char,
    status: c_int,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the environment is NULL or the buffer given to fmi2Instantiate, which outlives the instance; the
    // texts are NULL or end with a zero byte.
    unsafe {
        let Some(buffer) = environment.cast::<MessageBuffer>().as_ref() else { return };
        let text = unescape(&text(message).unwrap_or_default());
        let message = LogMessage {
            status: Status::from_code(status).unwrap_or(Status::Error),
            category: super::text::text(category),
            text,
        };
        let mut messages = buffer.messages();
        if messages.len() >= MESSAGES_KEPT {
            messages.pop_front();
        }
        messages.push_back(message);
    }
}

fn unescape(text: &str) -> String {
    text.replace("%%", "%").replace("##", "#")
}
