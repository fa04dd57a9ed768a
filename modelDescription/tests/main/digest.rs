//! The canonical text ignores what does not touch the interface and sees everything else.

use model_description::digest::canonical;
use model_description::*;

use crate::samples::rich;

#[test]
fn names_tools_dates_and_timelines_do_not_enter() {
    let mut other = rich();
    other.guid = "other".to_owned();
    other.model_name = "MyCraft".to_owned();
    other.co_simulation.as_mut().unwrap().model_identifier = "MyCraft".to_owned();
    other.generation_tool = None;
    other.generation_date_and_time = None;
    other.default_experiment.as_mut().unwrap().start_time = None;
    other.default_experiment.as_mut().unwrap().stop_time = Some(1.0);
    other.default_experiment.as_mut().unwrap().step_size = Some(1.0);
    assert_eq!(canonical(&other), canonical(&rich()));
}

#[test]
fn every_other_fact_enters() {
    type Change = (&'static str, fn(&mut Description));
    let changes: &[Change] = &[
        ("flag", |d| d.co_simulation.as_mut().unwrap().can_interpolate_inputs = false),
        ("unit", |d| d.units[0].display_units[0].factor += 1e-13),
        ("type", |d| d.types.swap(0, 1)),
        ("category", |d| d.log_categories.clear()),
        ("tolerance", |d| d.default_experiment.as_mut().unwrap().tolerance = None),
        ("variable order", |d| d.variables.swap(1, 2)),
        ("variable name", |d| d.variables[1].name.push('x')),
        ("reference", |d| d.variables[1].value_reference += 1),
        ("causality", |d| d.variables[1].causality = Causality::Local),
        ("start", |d| {
            if let VariableKind::Real { start, .. } = &mut d.variables[1].kind {
                *start = start.map(f64::next_up);
            }
        }),
        ("structure", |d| d.structure.outputs[0].dependencies = None),
        ("empty structure", |d| d.structure.outputs[1].dependencies = None),
    ];
    let base = canonical(&rich());
    for (what, change) in changes {
        let mut other = rich();
        change(&mut other);
        assert_ne!(canonical(&other), base, "{what}");
    }
}

#[test]
fn texts_cannot_pose_as_structure() {
    let mut one = rich();
    one.author = Some("x\nversion 3:1.2".to_owned());
    one.version = None;
    let mut two = rich();
    two.author = Some("x".to_owned());
    assert_ne!(canonical(&one), canonical(&two));
}
