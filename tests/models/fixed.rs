//! Values that a spacecraft file fixes are local constants, and dependencies are those of that choice.

use fmi_export::Model;
use fmi_export::model_description::{
    Causality, Description, Initial, ScalarVariable, Unknown, Variability, VariableKind, rules,
};
use models::{MomentumPlant, SpinPlant};

use super::named_model::described;

const FULL: &str = include_str!("../../fmu-src/resources/messenger-full.toml");

fn with(entries: &str) -> Description {
    let text = format!("{}\n[fixed]\n{entries}\n", MomentumPlant::DEFAULT_SETUP);
    described::<MomentumPlant>("my.toml", &text).unwrap()
}

fn variable<'a>(description: &'a Description, name: &str) -> &'a ScalarVariable {
    description.variables.iter().find(|it| it.name == name).unwrap()
}

/// Names of what an unknown of a list depends on.
fn listed(description: &Description, unknowns: &[Unknown], name: &str) -> Vec<String> {
    let at = description.variables.iter().position(|it| it.name == name).unwrap() as u32 + 1;
    let unknown = unknowns.iter().find(|it| it.index == at).unwrap();
    let name = |index: &u32| description.variables[*index as usize - 1].name.clone();
    unknown.dependencies.as_ref().unwrap().iter().map(name).collect()
}

/// In steps.
fn acts_on(description: &Description, output: &str) -> Vec<String> {
    listed(description, &description.structure.outputs, output)
}

/// In initialization.
fn begins_with(description: &Description, unknown: &str) -> Vec<String> {
    listed(description, &description.structure.initial_unknowns, unknown)
}

#[test]
fn a_fixed_choice_is_a_local_constant_and_no_command_acts_at_once() {
    let open = described::<MomentumPlant>("my.toml", MomentumPlant::DEFAULT_SETUP).unwrap();
    let fixed = with(
        "\"attitude.source\" = \"controlled\"\n\"command.source\" = \"inputs\"\n\"orbit.source\" = \"elements\"\n\
         \"ephemeris.source\" = \"vsop87\"",
    );
    assert_eq!(open.variables.len(), fixed.variables.len());
    let source = variable(&fixed, "attitude.source");
    assert_eq!((source.causality, source.variability), (Causality::Local, Variability::Constant));
    assert_eq!(rules::effective_initial(source), Some(Initial::Exact));
    assert!(matches!(source.kind, VariableKind::Enumeration { start: Some(3), .. }));
    for output in ["attitude.q[1]", "estimate.q[1]", "momentum.body[1]", "sun.sensedValid"] {
        let [before, after] = [&open, &fixed].map(|it| acts_on(it, output));
        assert!(before.iter().any(|name| name == "command.q[1]"), "{output}: {before:?}");
        assert!(!after.iter().any(|name| name.starts_with("command.")), "{output}: {after:?}");
    }
    assert!(acts_on(&fixed, "wheel[1].torque").iter().any(|name| name == "command.q[1]"));
    // It is where the flight begins, unless the file says where that is.
    let begins_commanded = |description: &Description| {
        begins_with(description, "attitude.q[1]").iter().any(|name| name == "command.q[1]")
    };
    assert!(begins_commanded(&fixed));
    let given = "\"attitude.source\" = \"controlled\"\n\"command.source\" = \"inputs\"\n\"orbit.source\" = \"elements\"\n\
                 \"ephemeris.source\" = \"vsop87\"\n\"start.q[4]\" = 1\n\"start.attitude\" = ";
    assert!(!begins_commanded(&with(&format!("{given}\"automatic\""))));
    assert!(begins_commanded(&with(&format!("{given}\"guided\""))));
    let listed = fixed.structure.initial_unknowns.iter().flat_map(|it| it.dependencies.iter().flatten());
    for known in listed {
        let known = &fixed.variables[*known as usize - 1];
        assert_ne!(known.variability, Variability::Constant, "{}", known.name);
    }
}

#[test]
fn a_body_that_guidance_never_turns_begins_without_it() {
    let begins_guided = |entries: &str, unknown: &str| {
        begins_with(&with(entries), unknown).iter().any(|name| name.starts_with("guided."))
    };
    let controlled =
        |command: &str| format!("\"attitude.source\" = \"controlled\"\n\"command.source\" = \"{command}\"");
    for unknown in ["attitude.q[1]", "estimate.q[1]", "force.solar[1]"] {
        assert!(begins_guided("", unknown) && begins_guided(&controlled("guidance"), unknown), "{unknown}");
        assert!(!begins_guided(&controlled("inputs"), unknown), "{unknown}");
        let free = "\"attitude.source\" = \"free\"";
        assert!(begins_guided(free, unknown), "{unknown}");
        let given = format!("{free}\n\"start.attitude\" = \"given\"");
        assert!(!begins_guided(&given, unknown), "{unknown}");
        assert!(
            begins_guided(&format!("{free}\n\"start.q[4]\" = 1"), unknown),
            "{unknown}: start.attitude is open"
        );
    }
}

#[test]
fn light_begins_with_wheels_where_the_body_may_turn_by_torque() {
    let begins_failed = |fixed: &str| {
        let description =
            described::<MomentumPlant>("my.toml", &format!("{FULL}\n[fixed]\n{fixed}\n")).unwrap();
        begins_with(&description, "torque.solar[1]").iter().any(|name| name == "wheel[1].failed")
    };
    assert!(begins_failed("") && begins_failed("\"attitude.source\" = \"controlled\""));
    assert!(!begins_failed("\"attitude.source\" = \"commanded\""));
}

#[test]
fn the_guid_follows_what_is_fixed() {
    let entry = "\"attitude.source\" = \"controlled\"";
    // The default, fixed, is another FMU too.
    let default = with("\"attitude.source\" = \"guided\"").guid;
    let fixed = with(entry).guid;
    let open = described::<MomentumPlant>("my.toml", MomentumPlant::DEFAULT_SETUP).unwrap().guid;
    assert!(open != default && default != fixed && fixed != open);
    assert!(
        described::<SpinPlant>("my.toml", &format!("{}\n[fixed]\nseed = 3\n", SpinPlant::DEFAULT_SETUP))
            .is_ok_and(|it| variable(&it, "seed").causality == Causality::Local)
    );
}

#[test]
fn what_no_model_has_is_refused_with_its_line() {
    let text = format!("{}\n[fixed]\n\"attitude.sourc\" = 3\n", MomentumPlant::DEFAULT_SETUP);
    let refused = described::<MomentumPlant>("my.toml", &text).unwrap_err();
    assert!(refused.contains("fixed.\"attitude.sourc\"") && refused.contains("attitude.source"), "{refused}");
}
