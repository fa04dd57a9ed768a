//! The log has the categories that the master turned on, in text without format characters.

use std::ffi::CStr;

use fmi_export::model_description::Status::{Discard, Error, Ok, Warning};

use super::{fresh, only_message, reference, started};

#[test]
fn events_and_warnings_of_a_model_reach_the_log_when_requested() {
    let (mut instance, description) = started("AllTypes");
    let at = |name| reference(&description, name);
    assert_eq!(instance.set_boolean(&[at("input.boolean")], &[1]), Ok);
    assert_eq!(instance.set_integer(&[at("input.integer")], &[-3]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    let found = instance.drain_messages();
    assert_eq!(found.len(), 2, "{found:?}");
    assert_eq!((found[0].status, found[0].category.as_str()), (Ok, "logEvents"));
    assert_eq!(found[0].text, "t = 0 s: input.boolean rose: 100 %% of ##1## %%s %%n");
    assert_eq!((found[1].status, found[1].category.as_str()), (Warning, "logStatusWarning"));

    assert_eq!(instance.set_integer(&[at("input.integer")], &[3]), Ok);
    assert_eq!(instance.set_debug_logging(true, &[c"logEvents"]), Ok);
    for value in [0, 1] {
        assert_eq!(instance.set_boolean(&[at("input.boolean")], &[value]), Ok);
        assert_eq!(instance.do_step(f64::from(value) + 1.0, 1.0), Ok);
    }
    assert!(only_message(&instance).starts_with("t = 2 s"));
    assert_eq!(instance.set_debug_logging(true, &[c"logAll"]), Ok);
    assert_eq!(instance.set_boolean(&[at("input.boolean")], &[0]), Ok);
    assert_eq!(instance.do_step(3.0, 1.0), Ok);
    assert_eq!(instance.set_boolean(&[at("input.boolean")], &[1]), Ok);
    assert_eq!(instance.do_step(4.0, 1.0), Ok);
    assert!(only_message(&instance).starts_with("t = 4 s"));
    assert_eq!(instance.set_debug_logging(false, &[]), Ok);
    for value in [0, 1] {
        assert_eq!(instance.set_boolean(&[at("input.boolean")], &[value]), Ok);
        assert_eq!(instance.do_step(f64::from(value) + 5.0, 1.0), Ok);
    }
    assert!(instance.drain_messages().is_empty());
}

/// FMPy and others instantiate with debug logging off and show nothing but what reaches their logger.
#[test]
fn the_reason_of_a_discard_a_warning_and_an_error_reach_the_log_with_debug_logging_off() {
    for off in [&[][..], &[c"logEvents"], &[c"logStatusError"]] {
        let (mut instance, description) = started("AllTypes");
        let integer = [reference(&description, "input.integer")];
        assert_eq!(instance.set_debug_logging(false, off), Ok);
        assert_eq!(instance.set_integer(&integer, &[5000]), Discard);
        let discarded = instance.drain_messages();
        assert_eq!(discarded.len(), 1, "{discarded:?}");
        assert_eq!((discarded[0].status, discarded[0].category.as_str()), (Discard, "logStatusDiscard"));
        assert!(discarded[0].text.contains("`input.integer`"), "{discarded:?}");
        assert_eq!(instance.set_integer(&integer, &[-3]), Ok);
        assert_eq!(instance.do_step(0.0, 1.0), Ok);
        let warned = instance.drain_messages();
        assert_eq!(warned.len(), 1, "{warned:?}");
        assert_eq!((warned[0].status, warned[0].category.as_str()), (Warning, "logStatusWarning"));
        assert_eq!(instance.do_step(99.0, 1.0), Error);
        assert!(only_message(&instance).starts_with("fmi2DoStep"));
    }
}

/// What importers do every day and the standard does not foresee is no warning.
#[test]
fn reads_in_initialization_and_after_a_set_are_events() {
    for on in [true, false] {
        let (mut instance, description) = fresh("AllTypes");
        let at = |name| [reference(&description, name)];
        assert_eq!(instance.set_debug_logging(on, &[]), Ok);
        assert_eq!(instance.set_real(&at("input.real"), &[1.0]), Ok);
        assert_eq!(instance.setup_experiment(0.0, None), Ok);
        assert_eq!(instance.enter_initialization_mode(), Ok);
        assert_eq!(instance.get_real(&at("input.real"), &mut [0.0]), Ok);
        assert_eq!(instance.exit_initialization_mode(), Ok);
        assert_eq!(instance.do_step(0.0, 1.0), Ok);
        assert_eq!(instance.set_real(&at("input.real"), &[2.0]), Ok);
        assert_eq!(instance.get_real(&at("output.real"), &mut [0.0]), Ok);
        let found = instance.drain_messages();
        let parts = ["set before Initialization Mode", "read in Initialization Mode", "after a set"];
        assert_eq!(found.len(), if on { parts.len() } else { 0 }, "{found:?}");
        for (message, part) in found.iter().zip(parts) {
            assert_eq!((message.status, message.category.as_str()), (Ok, "logEvents"), "{found:?}");
            assert!(message.text.contains(part), "{found:?}");
        }
    }
}

#[test]
fn an_unknown_category_is_a_warning_and_the_known_ones_count() {
    let (mut instance, description) = started("AllTypes");
    let mut event_at = |point_s: f64, categories: &[&CStr]| {
        assert_eq!(instance.set_debug_logging(true, categories), Warning);
        let text = only_message(&instance);
        assert!(text.contains("known are logEvents, logStatusWarning"), "{text}");
        let number = categories.iter().position(|it| *it == c"logNonsense").unwrap() + 1;
        assert!(text.contains(&format!("number {number}")), "{text}");
        for value in [0, 1] {
            assert_eq!(instance.set_boolean(&[reference(&description, "input.boolean")], &[value]), Ok);
            assert_eq!(instance.do_step(point_s + f64::from(value), 1.0), Ok);
        }
        instance.drain_messages().len()
    };
    assert_eq!(event_at(0.0, &[c"logNonsense", c"logEvents"]), 1);
    assert_eq!(event_at(2.0, &[c"logStatusDiscard", c"logNonsense"]), 0);
}

#[test]
fn nothing_but_unknown_categories_is_no_event() {
    let (mut instance, description) = started("AllTypes");
    assert_eq!(instance.set_debug_logging(true, &[c"logNonsense"]), Warning);
    instance.drain_messages();
    assert_eq!(instance.set_boolean(&[reference(&description, "input.boolean")], &[1]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    assert!(instance.drain_messages().is_empty());
}

#[test]
fn what_is_logged_is_declared() {
    let (_, description) = fresh("AllTypes");
    let names: Vec<_> = description.log_categories.iter().map(|it| it.name.as_str()).collect();
    let statuses = ["logStatusWarning", "logStatusDiscard", "logStatusError", "logStatusFatal"];
    assert_eq!(names, [&["logEvents"], &statuses[..], &["logAll"]].concat());
}
