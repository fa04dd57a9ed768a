//! What `#[derive(Variables)]` declares is what the builder's table holds: names, references, roles, starts.

use fmi_export::variables::{
    Annotation, Causality, Initial, InterpolationKind, ReadWhere, Variability, VariableRole,
};
use std::collections::BTreeSet;

use fmi_export::{
    BaseType, Boolean, Choice, Declare, DeclareError, Elements, Enumeration, Integer, Interface, Real,
    RealMatrix, RealVector, Text, Variables,
    fmi2::{references, scalar_variables},
};
use model_description::{ScalarVariable, VariableKind};

/// Where the attitude
/// comes from.
#[derive(Clone, Copy, Debug, PartialEq, Enumeration)]
enum AttitudeSource {
    /// Its own guidance.
    Guided,
    /// The commanded attitude.
    #[enumeration(name = "byCommand")]
    Commanded = 4,
    /// Rigid body, torque-free.
    FreeMotion,
}

struct Vehicle {
    mass_kg: f64,
    name: String,
    panel_angles_rad: Vec<f64>,
}

#[derive(Variables)]
#[variables(setup = Vehicle)]
struct VehicleVariables {
    /// Spacecraft mass,
    /// dry plus propellant.
    #[parameter(tunable, unit = "kg", min = 0.0, start = setup.mass_kg)]
    mass: Real,
    /// Inertia about the centre of mass, body frame.
    #[parameter(unit = "kg.m2", start = [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]])]
    inertia: RealMatrix<2, 3>,
    /// Centre of mass, body frame.
    #[parameter(tunable, unit = "m", display = "cm", start = [0.1, 0.2, 0.3])]
    center_of_mass: RealVector<3>,
    /// Where the attitude comes from.
    #[parameter(start = AttitudeSource::Commanded)]
    source: Choice<AttitudeSource>,
    /// Name of the vehicle.
    #[parameter(start = &setup.name)]
    label: Text,
    /// Torque from outside, body frame.
    #[input(unit = "N.m", start = [0.0; 3])]
    #[annotation(
        also_called = "torque[i]",
        limited_by = "centerOfMass[i]",
        rate = "centerOfMass",
        interpolation = "position"
    )]
    #[read_where(option = "source", items = "guided byCommand", set = "guided")]
    external: RealVector<3>,
    /// Whether to dump.
    #[input(start = true)]
    dump_request: Boolean,
    /// Sun elevation.
    #[output(unit = "rad", display = "deg", nominal = 0.5, name = "sun.elevation")]
    sun_elevation: Real,
    /// Dumps so far.
    #[output(initial = exact, start = -1, min = -1, max = 100)]
    count: Integer,
    /// Largest moment of inertia.
    #[calculated_parameter(unit = "kg.m2")]
    largest: Real,
    /// Work value.
    #[local(discrete, unit = "1")]
    work: Real,
    #[group]
    orbit: OrbitVariables,
    #[group(count = setup.panel_angles_rad.len())]
    panel: Vec<PanelVariables>,
    #[group(name = "")]
    flat: OtherVariables,
    #[group(name = "inner", setup = &setup.mass_kg)]
    projected: MassVariables,
}

#[derive(Variables)]
struct OrbitVariables {
    /// Semi-major axis.
    #[parameter(unit = "m", display = "km", start = 1e7)]
    semi_major_axis: Real,
}

#[derive(Variables)]
#[variables(setup = Vehicle)]
struct PanelVariables {
    /// Panel angle.
    #[input(unit = "rad", start = setup.panel_angles_rad[index])]
    #[annotation(limited_by = "panel[k].optics.number", role = "epoch")]
    angle: Real,
    optics: OpticsVariables,
}

#[derive(Variables)]
#[variables(setup = Vehicle)]
struct OpticsVariables {
    /// Number of the panel, seen from a group inside.
    #[parameter(start = index as i32 + 1)]
    number: Integer,
}

#[derive(Variables)]
struct OtherVariables {
    /// A flag.
    #[output]
    flag: Boolean,
}

#[derive(Variables)]
#[variables(setup = f64)]
struct MassVariables {
    /// Half the mass.
    #[parameter(unit = "kg", start = *setup / 2.0)]
    half: Real,
}

fn declare<S, V: Variables<S>>(setup: &S) -> Result<(V, Declared), DeclareError> {
    let mut scope = Declare::new();
    let variables = V::declare(&mut scope, setup, 0)?;
    let interface = scope.finish();
    Ok((variables, Declared { variables: scalar_variables(&interface), interface }))
}

/// What was declared, and its elements in FMI 2.0.
struct Declared {
    variables: Vec<ScalarVariable>,
    interface: Interface,
}

fn vehicle() -> (VehicleVariables, Declared) {
    let setup = Vehicle { mass_kg: 500.0, name: "Prüfling".to_owned(), panel_angles_rad: vec![0.25, 0.5] };
    declare(&setup).unwrap()
}

fn find<'a>(table: &'a Declared, name: &str) -> &'a ScalarVariable {
    table.variables.iter().find(|variable| variable.name == name).unwrap()
}

#[test]
fn names_follow_fields_groups_and_elements() {
    let (_, table) = vehicle();
    let names: Vec<_> = table.variables.iter().map(|variable| variable.name.as_str()).collect();
    let expected = "mass inertia[1,1] inertia[1,2] inertia[1,3] inertia[2,1] inertia[2,2] inertia[2,3] \
        centerOfMass[1] centerOfMass[2] centerOfMass[3] source label external[1] external[2] external[3] \
        dumpRequest sun.elevation count largest work orbit.semiMajorAxis panel[1].angle \
        panel[1].optics.number panel[2].angle panel[2].optics.number flag inner.half";
    assert_eq!(names, expected.split_whitespace().collect::<Vec<_>>());
    assert_eq!(find(&table, "mass").description.as_deref(), Some("Spacecraft mass, dry plus propellant."));
}

#[test]
fn references_are_unique_and_dense_for_each_base_type_in_order() {
    let (variables, table) = vehicle();
    let all: BTreeSet<_> = table.variables.iter().map(|variable| variable.value_reference).collect();
    assert_eq!(all.len(), table.variables.len());
    let mut next = BaseType::ALL.map(references::first);
    for variable in &table.variables {
        let base = variable.kind.base_type() as usize;
        assert_eq!(variable.value_reference, next[base], "{}", variable.name);
        next[base] += 1;
    }
    for (reference, name) in [
        (references::for_variable(variables.mass), "mass"),
        (references::for_variable(variables.inertia.element(1, 0)), "inertia[2,1]"),
        (references::for_variable(variables.center_of_mass.element(2)), "centerOfMass[3]"),
        (references::for_variable(variables.source), "source"),
        (references::for_variable(variables.label), "label"),
        (references::for_variable(variables.external.element(0)), "external[1]"),
        (references::for_variable(variables.dump_request), "dumpRequest"),
        (references::for_variable(variables.sun_elevation), "sun.elevation"),
        (references::for_variable(variables.count), "count"),
        (references::for_variable(variables.largest), "largest"),
        (references::for_variable(variables.work), "work"),
        (references::for_variable(variables.orbit.semi_major_axis), "orbit.semiMajorAxis"),
        (references::for_variable(variables.panel[1].angle), "panel[2].angle"),
        (references::for_variable(variables.panel[1].optics.number), "panel[2].optics.number"),
        (references::for_variable(variables.flat.flag), "flag"),
        (references::for_variable(variables.projected.half), "inner.half"),
    ] {
        assert_eq!(reference, find(&table, name).value_reference, "{name}");
    }
}

#[test]
fn starts_come_from_setup_index_and_literals() {
    let (variables, table) = vehicle();
    let start = &table.interface.start;
    assert_eq!(start.real(variables.mass), 500.0);
    assert_eq!(start.matrix(variables.inertia), [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0]]);
    assert_eq!(start.vector(variables.center_of_mass), [0.1, 0.2, 0.3]);
    assert_eq!(start.choice(variables.source), AttitudeSource::Commanded);
    assert_eq!(start.text(variables.label), "Prüfling");
    assert!(start.boolean(variables.dump_request));
    assert_eq!(start.integer(variables.count), -1);
    assert_eq!(start.real(variables.panel[1].angle), 0.5);
    assert_eq!(start.integer(variables.panel[1].optics.number), 2);
    assert_eq!(start.real(variables.projected.half), 250.0);
    let VariableKind::Real { start, .. } = find(&table, "centerOfMass[2]").kind else { panic!() };
    assert_eq!(start, Some(0.2));
    let VariableKind::Real { start, .. } = find(&table, "sun.elevation").kind else { panic!() };
    assert_eq!(start, None);
}

#[test]
fn roles_and_attributes_reach_the_table() {
    let (_, table) = vehicle();
    for (name, causality, variability, initial) in [
        ("mass", Causality::Parameter, Variability::Tunable, None),
        ("source", Causality::Parameter, Variability::Fixed, None),
        ("external[3]", Causality::Input, Variability::Continuous, None),
        ("dumpRequest", Causality::Input, Variability::Discrete, None),
        ("sun.elevation", Causality::Output, Variability::Continuous, None),
        ("count", Causality::Output, Variability::Discrete, Some(Initial::Exact)),
        ("largest", Causality::CalculatedParameter, Variability::Fixed, None),
        ("work", Causality::Local, Variability::Discrete, None),
    ] {
        let variable = find(&table, name);
        assert_eq!(
            (variable.causality, variable.variability, variable.initial),
            (causality, variability, initial)
        );
    }
    let VariableKind::Real { attributes, .. } = &find(&table, "sun.elevation").kind else { panic!() };
    assert_eq!(attributes.unit.as_deref(), Some("rad"));
    assert_eq!(attributes.display_unit.as_deref(), Some("deg"));
    assert_eq!(attributes.nominal, Some(0.5));
    let VariableKind::Real { attributes, .. } = &find(&table, "mass").kind else { panic!() };
    assert_eq!((attributes.min, attributes.max), (Some(0.0), Some(1e100)));
    let VariableKind::Integer { min, max, .. } = find(&table, "count").kind else { panic!() };
    assert_eq!((min, max), (Some(-1), Some(100)));
}

#[test]
fn annotations_name_the_same_element_and_the_same_group() {
    let (_, table) = vehicle();
    let annotation = |name: &str| find(&table, name).annotation.as_deref().cloned().unwrap();
    let text = |text: &str| Some(text.to_owned());
    let option = ReadWhere {
        option: "source".to_owned(),
        items: vec!["guided".into(), "byCommand".into()],
        set: text("guided"),
    };
    let expected = Annotation {
        also_called: text("torque[3]"),
        limited_by: text("centerOfMass[3]"),
        interpolation: Some(InterpolationKind::Position),
        rate: text("centerOfMass"),
        read_where: vec![option],
        ..Annotation::default()
    };
    assert_eq!(annotation("external[3]"), expected);
    assert_eq!(annotation("panel[2].angle").limited_by, text("panel[2].optics.number"));
    assert_eq!(annotation("panel[2].angle").role, Some(VariableRole::Epoch));
    assert_eq!(find(&table, "dumpRequest").annotation, None);
}

#[test]
fn an_array_is_one_variable() {
    let (variables, table) = vehicle();
    let find = |name| table.interface.variables.iter().find(|variable| variable.name == name).unwrap();
    assert!(find("mass").dimensions.is_empty());
    assert_eq!(
        (find("centerOfMass").dimensions.as_slice(), find("inertia").dimensions.as_slice()),
        (&[3][..], &[2, 3][..])
    );
    let (name, last) = find("inertia").elements().last().unwrap();
    assert_eq!(
        (name.as_str(), Elements::from(last)),
        ("inertia[2,3]", variables.inertia.element(1, 2).into())
    );
    assert_eq!(variables.center_of_mass.index_of(variables.center_of_mass.element(2)), Some(2));
    assert_eq!(variables.center_of_mass.index_of(variables.inertia.element(0, 0)), None);
}

#[test]
fn enumeration_items_follow_variants_and_discriminants() {
    let (_, table) = vehicle();
    let [source] = table.interface.enumerations.as_slice() else { panic!() };
    assert_eq!(source.name, "AttitudeSource");
    assert_eq!(source.description, "Where the attitude comes from.");
    let items: Vec<_> = source.items.iter().map(|item| (item.name.as_str(), item.value)).collect();
    assert_eq!(items, [("guided", 1), ("byCommand", 4), ("freeMotion", 5)]);
    for value in -1..8 {
        let back = AttitudeSource::from_value(value).map(Enumeration::value);
        assert_eq!(back, [1, 4, 5].contains(&value).then_some(value));
    }
}
