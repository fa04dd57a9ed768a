//! What only the log by itself shows; its categories are tested through the C functions.
use std::sync::{Arc, Mutex};

use super::*;

#[derive(Clone, Default)]
struct Recorder(Arc<Mutex<Vec<String>>>);

impl LogSink for Recorder {
    fn write(&self, _instance_name: &CStr, _status: Status, _category: &CStr, message: &CStr) {
        self.0.lock().unwrap().push(message.to_str().unwrap().to_owned());
    }
}

#[test]
fn format_characters_and_nul_are_defused() {
    let lines = Recorder::default();
    let logger = Logger::new(Box::new(lines.clone()), c"probe", true);
    logger.log(Status::Error, format_args!("100 %s of #r1# and {}", "a\0b"));
    assert_eq!(*lines.0.lock().unwrap(), ["100 %%s of ##r1## and a\u{FFFD}b"]);
}
