//! The probes declare what their tests need: every legal role, nothing invalid, states that belong to a setup. What they compute
//! the tests of fmi-export show through the C functions.
#![allow(clippy::unwrap_used, clippy::expect_used, clippy::panic, reason = "tests")]

use std::collections::BTreeSet;

use client::NamedInstance;
use fmi_export::Model;
use fmi_export::variables::{Causality, Variability};
use model_description::{rules::INITIAL_TABLE, validate};
use probe::{AllTypes, LIBRARY};

#[test]
fn every_legal_role_but_the_independent_one_is_there() {
    let variables = NamedInstance::from_library(&LIBRARY, "AllTypes").description.variables;
    let roles: BTreeSet<_> = variables.iter().map(|it| (it.causality, it.variability)).collect();
    let legal = INITIAL_TABLE.iter().map(|row| (row.causality, row.variability));
    assert_eq!(roles, legal.filter(|(causality, _)| *causality != Causality::Independent).collect());
    assert!(roles.contains(&(Causality::Output, Variability::Constant)));
    let names: Vec<_> = variables.iter().map(|it| it.name.as_str()).collect();
    for name in ["parameter.matrix[2,3]", "tunable.text", "output.vector[3]", "channel[2].gain"] {
        assert!(names.contains(&name), "{name}");
    }
}

#[test]
fn what_is_described_is_valid() {
    for entry in LIBRARY.entries {
        let findings = validate(&entry.describe(None, None).unwrap());
        assert!(findings.is_empty(), "{}: {findings:?}", entry.name);
    }
}

#[test]
fn a_state_of_other_channels_is_refused() {
    let setup = |text| AllTypes::parse_setup("test", text).unwrap();
    // Start time, count of steps, flag, integral, and of each output its gain and slope.
    let state = |outputs: usize| -> probe::all_types::State {
        let fields = (0.0, 0, false, [0.0; 3], vec![(1.0, 0.0); outputs]);
        postcard::from_bytes(&postcard::to_stdvec(&fields).unwrap()).unwrap()
    };
    assert!(AllTypes::check_state(&setup(AllTypes::DEFAULT_SETUP), &state(12)).is_ok());
    assert!(AllTypes::check_state(&setup("label = ''"), &state(12)).is_err());
    let error = AllTypes::parse_setup("file.toml", "label = 1").unwrap_err().to_string();
    assert!(error.starts_with("file.toml: "), "{error}");
}
