//! The validator finds nothing in valid descriptions and describes what it finds in others.

use model_description::*;
use proptest::prelude::*;

use crate::arbitrary;
use crate::samples::{real, rich, variable};

proptest! {
    #[test]
    fn valid_descriptions_have_no_findings(description in arbitrary::description()) {
        prop_assert_eq!(validate(&description), Vec::new());
    }
}

#[test]
fn the_rich_sample_is_valid() {
    assert_eq!(validate(&rich()), Vec::new());
}

#[test]
fn findings_say_what_was_found_and_what_is_allowed() {
    let mut description = rich();
    if let VariableKind::Real { start, .. } = &mut description.variables[1].kind {
        *start = Some(-4.0);
    }
    let found = validate(&description);
    assert_eq!(found.len(), 1);
    assert_eq!(
        found[0].to_string(),
        "error [start-out-of-range] variable `angle`: start -4 is out of range; allowed is \
         -3.141592653589793 to INF"
    );
}

/// The standard restricts the kinds by the unknown alone (2.2.8).
#[test]
fn a_real_may_have_a_factor_for_a_known_of_any_type() {
    let boolean = |start| VariableKind::Boolean { start, declared_type: None };
    let codes = |known: VariableKind, unknown: VariableKind, kind| {
        let entry = Unknown { index: 2, dependencies: Some(vec![1]), dependencies_kind: Some(vec![kind]) };
        let described = Description {
            variables: vec![
                variable("u", 0, Causality::Input, Variability::Discrete, known),
                variable("y", 1, Causality::Output, Variability::Discrete, unknown),
            ],
            structure: ModelStructure {
                outputs: vec![entry],
                initial_unknowns: vec![Unknown { index: 2, ..Unknown::default() }],
                ..ModelStructure::default()
            },
            ..rich()
        };
        validate(&described).into_iter().map(|finding| (finding.code, finding.severity())).collect::<Vec<_>>()
    };
    use DependencyKind::{Constant, Dependent, Discrete, Fixed, Tunable};
    for kind in [Dependent, Constant, Fixed, Tunable, Discrete] {
        assert_eq!(codes(boolean(Some(true)), real(None, None), kind), [], "{kind}");
        assert_eq!(codes(real(Some(0.0), None), real(None, None), kind), [], "{kind}");
        let of_boolean = codes(boolean(Some(true)), boolean(None), kind);
        let reported = [(Code::DependencyKindReal, Severity::Warning)];
        assert_eq!(of_boolean, if kind == Dependent { &reported[..0] } else { &reported[..] }, "{kind}");
    }
}

#[test]
fn lines_are_those_of_the_elements() {
    let mut description = rich();
    description.variables[2].name = "2nd".to_owned();
    let xml = to_xml(&description);
    let found = parse(xml.as_bytes()).unwrap().findings();
    let line = xml.lines().position(|line| line.contains("\"2nd\"")).unwrap() + 1;
    assert_eq!(found.len(), 1);
    assert_eq!((found[0].code, found[0].line), (Code::IllegalName, Some(line as u32)));
}

#[test]
fn code_words_are_unique_and_rules_are_sentences() {
    for (i, code) in Code::ALL.iter().enumerate() {
        assert!(Code::ALL[..i].iter().all(|other| other.as_str() != code.as_str()), "{code}");
        assert!(code.as_str().bytes().all(|b| b.is_ascii_lowercase() || b == b'-'), "{code}");
        assert!(code.rule().ends_with('.'), "{code}");
    }
}

#[test]
fn date_times_are_those_of_xml_schema() {
    let legal = |text: &str| {
        let description = Description { generation_date_and_time: Some(text.to_owned()), ..rich() };
        validate(&description).is_empty()
    };
    for text in [
        "2026-01-02T03:04:05Z",
        "2024-02-29T23:59:59",
        "2000-02-29T00:00:00Z",
        "-0044-03-15T12:00:00.125-14:00",
        "12026-12-31T24:00:00Z",
    ] {
        assert!(legal(text), "{text}");
    }
    for text in [
        "",
        "2026-01-02",
        "2026-01-02 03:04:05Z",
        "2023-02-29T00:00:00Z",
        "1900-02-29T00:00:00Z",
        "2026-13-01T00:00:00Z",
        "2026-04-31T00:00:00Z",
        "2026-01-02T24:00:01Z",
        "2026-01-02T03:60:05Z",
        "2026-01-02T03:04Z",
        "2026-01-02T03:04:05.Z",
        "2026-01-02T03:04:05+15:00",
        "2026-01-02T03:04:05ZZ",
        "26-01-02T03:04:05Z",
        "2026-1-02T03:04:05Z",
        "Mon Jan  2 03:04:05 2026",
    ] {
        assert!(!legal(text), "{text}");
    }
}

#[test]
fn ten_times_the_faults_take_ten_times_as_long() {
    let seconds = |count: usize| {
        let mut description = rich();
        let template = description.variables[1].clone();
        for index in 0..count {
            let mut variable = template.clone();
            // One name, one reference, a start value out of bounds, an unknown unit: each is a fault.
            if let VariableKind::Real { start, attributes, .. } = &mut variable.kind {
                *start = Some(-4.0 - index as f64);
                attributes.unit = Some(format!("unit{index}"));
            }
            description.variables.push(variable);
        }
        let text = to_xml(&description);
        // The least of some, for the machine has other things to do.
        let once = || {
            let began = std::time::Instant::now();
            let found = parse(text.as_bytes()).unwrap().findings().len();
            assert!(found >= count, "{found}");
            began.elapsed().as_secs_f64()
        };
        (0..3).map(|_| once()).fold(f64::INFINITY, f64::min)
    };
    let (few, many) = (seconds(1_000), seconds(10_000));
    // With a margin for caches; each pair compared once would make a hundred.
    assert!(many < 40.0 * few, "{few} s for 1000, {many} s for 10000");
}
