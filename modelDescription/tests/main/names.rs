//! Structured names follow the grammar of 2.2.9; model identifiers are C identifiers.

use model_description::names::{check_flat, check_structured, is_c_identifier};
use proptest::prelude::*;

#[test]
fn legal_structured_names_pass() {
    for name in [
        "x",
        "_x9",
        "vehicle.engine.speed",
        "a.b.mod[3,4].'#123'.c",
        "resistor12.u",
        "robot.axis.'motor #234'[1]",
        "der(pipe[3,4].T[14],2)",
        "der(pipe[3,4].T[14])",
        "'it\\'s \\\\ fine'",
        "der",
        "momentum.inertial[1]",
    ] {
        assert_eq!(check_structured(name), Ok(()), "{name}");
    }
}

#[test]
fn illegal_structured_names_say_where_and_what() {
    for (name, at, found) in [
        ("", 0, None),
        ("1x", 1, Some('1')),
        ("a b", 2, Some(' ')),
        ("a.", 2, None),
        ("a..b", 3, Some('.')),
        ("a[]", 3, Some(']')),
        ("a[1", 3, None),
        ("a[1;2]", 4, Some(';')),
        ("a[1]b", 5, Some('b')),
        ("a[-1]", 3, Some('-')),
        ("''", 2, Some('\'')),
        ("'a", 2, None),
        ("'a\\x'", 4, Some('x')),
        ("der(x", 5, None),
        ("der(x,)", 7, Some(')')),
        ("der(x)y", 7, Some('y')),
        ("gr\u{fc}n", 3, Some('\u{fc}')),
        ("der(der(x))", 8, Some('(')),
    ] {
        let message = check_structured(name).expect_err(name);
        let expected = match found {
            Some(c) => format!("has {c:?} at character {at}; allowed is "),
            None => format!("ends after {at} characters; allowed is "),
        };
        assert!(message.starts_with(&expected), "{name}: {message}");
    }
}

#[test]
fn flat_names_hold_no_line_breaks() {
    assert_eq!(check_flat("anything goes: \u{fc} (1)"), Ok(()));
    assert!(check_flat("a\nb").unwrap_err().contains("character 2"));
    assert!(check_flat("").is_err());
}

#[test]
fn identifiers_are_those_of_c() {
    for (name, legal) in [
        ("A_B_C", true),
        ("_9", true),
        ("9a", false),
        ("", false),
        ("a-b", false),
        ("a.b", false),
        ("\u{e9}", false),
    ] {
        assert_eq!(is_c_identifier(name), legal, "{name}");
    }
}

proptest! {
    #[test]
    fn any_text_gets_an_answer(name in any::<String>()) {
        let _ = check_structured(&name);
        let _ = check_flat(&name);
    }

    #[test]
    fn names_built_by_the_grammar_pass(
        name in "[a-zA-Z_][a-zA-Z0-9_]{0,3}(\\[[0-9]{1,2}(,[0-9]{1,2}){0,2}\\])?(\\.('[a-z #!(]{1,3}'|[a-z]{1,3})(\\[[0-9]\\])?){0,3}"
    ) {
        prop_assert_eq!(check_structured(&name), Ok(()));
        let derivative = format!("der({name},3)");
        prop_assert_eq!(check_structured(&derivative), Ok(()));
    }
}
