//! What reaches the master is what was logged, only in the categories it turned on.
use std::sync::{Arc, Mutex};

use super::*;

type Lines = Arc<Mutex<Vec<(Status, String, String)>>>;

struct Recorder(Lines);

impl LogSink for Recorder {
    fn write(&self, instance_name: &CStr, status: Status, category: &CStr, message: &CStr) {
        assert_eq!(instance_name, c"probe");
        let text = |c: &CStr| c.to_str().unwrap().to_owned();
        self.0.lock().unwrap().push((status, text(category), text(message)));
    }
}

fn logger(on: bool) -> (Logger, Lines) {
    let lines = Lines::default();
    (Logger::new(Box::new(Recorder(lines.clone())), c"probe", on), lines)
}

fn log_all(logger: &Logger) {
    for status in [Status::Ok, Status::Warning, Status::Discard, Status::Error] {
        logger.log(status, format_args!("{status:?}"));
    }
}

fn categories(lines: &Lines) -> Vec<String> {
    lines.lock().unwrap().drain(..).map(|(_, category, _)| category).collect()
}

#[test]
fn format_characters_and_nul_are_defused() {
    let (logger, lines) = logger(true);
    logger.log(Status::Error, format_args!("100 %s of #r1# and {}", "a\0b"));
    assert_eq!(lines.lock().unwrap()[0].2, "100 %%s of ##r1## and a\u{FFFD}b");
}

#[test]
fn events_wait_to_be_asked_for_and_the_rest_always_passes() {
    const REST: [&str; 3] = ["logStatusWarning", "logStatusDiscard", "logStatusError"];
    let (logger, lines) = logger(false);
    let assert_events = |expected: bool| {
        log_all(&logger);
        let found = categories(&lines);
        assert_eq!(found.iter().any(|it| it == "logEvents"), expected, "{found:?}");
        assert_eq!(found[usize::from(expected)..], REST);
    };
    assert_events(false);
    logger.enable(true, []);
    assert_events(true);
    logger.enable(true, [Category::Events]);
    assert_events(true);
    logger.enable(true, [Category::Discard]);
    assert_events(false);
    logger.enable(true, [Category::All]);
    assert_events(true);
    logger.enable(false, [Category::Events]);
    assert_events(false);
}

#[test]
fn nothing_is_formatted_while_its_category_is_off() {
    struct PanicsWhenFormatted;
    impl fmt::Display for PanicsWhenFormatted {
        fn fmt(&self, _: &mut fmt::Formatter<'_>) -> fmt::Result {
            panic!("formatted")
        }
    }
    let (logger, _) = logger(false);
    logger.log(Status::Ok, format_args!("{PanicsWhenFormatted}"));
}
