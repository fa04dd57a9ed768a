//! What enters the GUID holds every declared fact, and texts cannot pose as structure.
use std::collections::BTreeSet;

use model_description::{Causality, Variability};

use super::*;
use crate::dependencies::Dependencies;
use crate::knowns;
use crate::variables::{
    Annotation, Declare, DeclaredType, EnumerationType, Integer, Item, Real, RealSpec, RealVector, Role,
    ScalarSpec,
};

struct Handles {
    input: RealVector<2>,
    output: Real,
    count: Integer,
}

fn declared() -> (Interface, Dependencies, Handles) {
    let role = |causality| Role { causality, variability: Variability::Discrete, initial: None };
    let (input, output) = (role(Causality::Input), role(Causality::Output));
    let real = |name, role| RealSpec {
        name,
        description: "A value.",
        role,
        unit: "m",
        display_unit: Some("km"),
        min: None,
        max: Some(5.0),
        nominal: None,
    };
    let mut scope = Declare::new();
    let handles = Handles {
        input: scope.real_vector(&real("input", input), Some([0.5, 1.0])).unwrap(),
        output: scope.real(&real("output", output), None).unwrap(),
        count: {
            let spec = ScalarSpec { name: "count", description: "A number.", role: input };
            scope.integer(&spec, Some(1), None, None).unwrap()
        },
    };
    let mut dependencies = Dependencies::new();
    dependencies.output(handles.output, handles.input, handles.input);
    (scope.finish(), dependencies, handles)
}

fn digested(interface: &Interface, dependencies: &Dependencies) -> Vec<u8> {
    postcard::to_allocvec(&(interface, dependencies)).unwrap()
}

#[test]
fn every_fact_enters() {
    type Change = (&'static str, fn(&mut Interface, &mut Dependencies, &Handles));
    let changes: &[Change] = &[
        ("order", |it, _, _| it.variables.swap(0, 1)),
        ("name", |it, _, _| it.variables[0].name.push('x')),
        ("description", |it, _, _| it.variables[0].description.push('x')),
        ("causality", |it, _, _| it.variables[0].role.causality = Causality::Local),
        ("variability", |it, _, _| it.variables[0].role.variability = Variability::Continuous),
        ("initial", |it, _, _| {
            it.variables[1].role.initial = Some(model_description::Initial::Approx);
        }),
        ("dimensions", |it, _, _| it.variables[0].dimensions = vec![1, 2]),
        ("place", |it, _, _| it.variables[0].first.place = 1),
        ("limit", |it, _, _| {
            if let DeclaredType::Real { max, .. } = &mut it.variables[0].kind {
                *max = max.map(f64::next_up);
            }
        }),
        ("unit", |it, _, _| {
            if let DeclaredType::Real { display_unit, .. } = &mut it.variables[0].kind {
                *display_unit = None;
            }
        }),
        ("type", |it, _, _| it.variables[2].kind = DeclaredType::Enumeration("E")),
        ("enumeration", |it, _, _| {
            it.enumerations.push(EnumerationType { name: "E", description: "D", items: &[][..] }.into());
        }),
        ("start of an element", |it, _, h| {
            it.start.set_real(h.input.element(1), 1.0_f64.next_up());
        }),
        ("start of an Integer", |it, _, h| it.start.set_integer(h.count, 2)),
        ("dependency in steps", |_, table, h| table.output(h.output, h.count, knowns![])),
        ("dependency at the start", |_, table, h| table.output(h.output, knowns![], h.count)),
    ];
    let (base, table, _) = declared();
    let base = digested(&base, &table);
    for (what, change) in changes {
        let (mut interface, mut table, handles) = declared();
        change(&mut interface, &mut table, &handles);
        assert_ne!(digested(&interface, &table), base, "{what}");
    }
}

#[test]
fn annotations_do_not_enter() {
    let (base, table, _) = declared();
    let (mut interface, _, _) = declared();
    let limited = Annotation { limited_by: Some("output".to_owned()), ..Annotation::default() };
    interface.variables[0].annotation = Some(limited);
    assert_eq!(digested(&interface, &table), digested(&base, &table));
}

#[test]
fn every_fact_of_an_item_enters() {
    const BASE: Item = Item { name: "one", value: 1, description: "The first." };
    const ITEMS: [&[Item]; 5] = [
        &[BASE],
        &[Item { name: "two", ..BASE }],
        &[Item { value: 2, ..BASE }],
        &[Item { description: "The last.", ..BASE }],
        &[BASE, BASE],
    ];
    let texts: BTreeSet<Vec<u8>> = ITEMS
        .iter()
        .map(|items| {
            let (mut interface, table, _) = declared();
            interface
                .enumerations
                .push(EnumerationType { name: "E", description: "D", items: *items }.into());
            digested(&interface, &table)
        })
        .collect();
    assert_eq!(texts.len(), ITEMS.len());
}

#[test]
fn texts_cannot_pose_as_structure() {
    let (mut one, table, _) = declared();
    one.variables[0].description = "x\ncausality 5:input".to_owned();
    let (mut two, _, _) = declared();
    two.variables[0].description = "x".to_owned();
    assert_ne!(digested(&one, &table), digested(&two, &table));
}
