//! The log has the categories that the master turned on, in text without format characters.

use fmi_export::model_description::Status::{Discard, Error, Ok, Warning};

use super::{fresh, only_message, reference, started};

#[test]
fn events_and_warnings_of_a_model_reach_the_log_when_asked_for() {
    let (mut instance, description) = started("AllTypes");
    let at = |name| reference(&description, name);
    assert_eq!(instance.set_boolean(&[at("input.boolean")], &[1]), Ok);
    assert_eq!(instance.set_integer(&[at("input.integer")], &[-3]), Ok);
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
    let found = instance.take_messages();
    assert_eq!(found.len(), 2, "{found:?}");
    assert_eq!((found[0].status, found[0].category.as_str()), (Ok, "logEvents"));
    assert_eq!(found[0].text, "t = 0 s: input.boolean rose: 100 %% of ##1## %%s %%n");
    assert_eq!((found[1].status, found[1].category.as_str()), (Warning, "logStatusWarning"));

    assert_eq!(instance.set_debug_logging(true, &[c"logEvents"]), Ok);
    for value in [0, 1] {
        assert_eq!(instance.set_boolean(&[at("input.boolean")], &[value]), Ok);
        assert_eq!(instance.do_step(f64::from(value) + 1.0, 1.0), Ok);
    }
    assert!(only_message(&instance).starts_with("t = 2 s"));
    assert_eq!(instance.set_debug_logging(false, &[]), Ok);
    assert_eq!(instance.set_integer(&[at("input.integer")], &[5000]), Discard);
    assert!(instance.take_messages().is_empty());
    assert_eq!(instance.do_step(99.0, 1.0), Error);
    assert!(only_message(&instance).starts_with("fmi2DoStep"));
}

#[test]
fn an_unknown_category_is_a_warning_and_the_known_ones_count() {
    let (mut instance, description) = started("AllTypes");
    assert_eq!(instance.set_debug_logging(true, &[c"logNonsense", c"logStatusDiscard"]), Warning);
    assert_eq!(instance.set_integer(&[reference(&description, "input.integer")], &[5000]), Discard);
    assert_eq!(instance.take_messages().len(), 1);
    assert_eq!(instance.set_debug_logging(true, &[c"logStatusWarning", c"logNonsense"]), Warning);
    let text = only_message(&instance);
    assert!(text.contains("number 2") && text.contains("logEvents, logStatusWarning"), "{text}");
    assert_eq!(instance.do_step(0.0, 1.0), Ok);
}

#[test]
fn nothing_but_unknown_categories_is_nothing_but_errors() {
    let (mut instance, description) = started("AllTypes");
    assert_eq!(instance.set_debug_logging(true, &[c"logNonsense"]), Warning);
    instance.take_messages();
    assert_eq!(instance.set_integer(&[reference(&description, "input.integer")], &[5000]), Discard);
    assert!(instance.take_messages().is_empty());
    assert_eq!(instance.do_step(99.0, 1.0), Error);
    assert!(only_message(&instance).starts_with("fmi2DoStep"));
}

#[test]
fn what_is_logged_is_declared() {
    let (_, description) = fresh("AllTypes");
    let names: Vec<_> = description.log_categories.iter().map(|it| it.name.as_str()).collect();
    assert_eq!(names, ["logEvents", "logStatusWarning", "logStatusDiscard", "logStatusError", "logAll"]);
}
