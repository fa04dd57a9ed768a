//! A description that uses every element and attribute a co-simulation FMU can carry, and is valid.

use model_description::*;

pub(crate) fn variable(
    name: &str,
    value_reference: u32,
    causality: Causality,
    variability: Variability,
    kind: VariableKind,
) -> ScalarVariable {
    ScalarVariable {
        name: name.to_owned(),
        value_reference,
        causality,
        variability,
        kind,
        ..ScalarVariable::default()
    }
}

pub(crate) fn real(start: Option<f64>, unit: Option<&str>) -> VariableKind {
    VariableKind::Real {
        start,
        declared_type: None,
        attributes: RealAttributes { unit: unit.map(str::to_owned), ..RealAttributes::default() },
        derivative: None,
        reinit: None,
    }
}

pub(crate) fn rich() -> Description {
    let mut angle =
        variable("angle", 0, Causality::Input, Variability::Continuous, real(Some(0.25), Some("rad")));
    angle.description = Some("Angle of the <panel> & its \"mirror\"\n\tin the body frame".to_owned());
    if let VariableKind::Real { attributes, declared_type, .. } = &mut angle.kind {
        attributes.display_unit = Some("deg".to_owned());
        attributes.min = Some(-core::f64::consts::PI);
        attributes.max = Some(f64::INFINITY);
        attributes.nominal = Some(1e-7);
        attributes.quantity = Some("Angle".to_owned());
        *declared_type = Some("Angle".to_owned());
    }
    let mut limit = variable(
        "limit",
        0,
        Causality::Parameter,
        Variability::Tunable,
        VariableKind::Integer {
            start: Some(-3),
            declared_type: None,
            quantity: None,
            min: Some(i32::MIN),
            max: Some(i32::MAX),
        },
    );
    limit.initial = Some(Initial::Exact);
    let mut approximate =
        variable("guess", 2, Causality::CalculatedParameter, Variability::Fixed, real(Some(1e300), None));
    approximate.initial = Some(Initial::Approx);
    let item = |name: &str, value, description: Option<&str>| EnumerationItem {
        name: name.to_owned(),
        value,
        description: description.map(str::to_owned),
    };
    let items = vec![item("elements", 1, None), item("inputs", 2, Some("From inputs"))];
    let plain_type = |name: &str, kind| SimpleType { name: name.to_owned(), kind, ..SimpleType::default() };
    let variables = vec![
        variable("time", 9, Causality::Independent, Variability::Continuous, real(None, Some("s"))),
        angle,
        variable("torque[1]", 1, Causality::Output, Variability::Continuous, real(None, Some("N.m"))),
        limit,
        variable(
            "source",
            1,
            Causality::Parameter,
            Variability::Fixed,
            VariableKind::Enumeration {
                start: Some(2),
                declared_type: "Source".to_owned(),
                quantity: None,
                min: Some(1),
                max: Some(2),
            },
        ),
        variable(
            "active",
            0,
            Causality::Output,
            Variability::Discrete,
            VariableKind::Boolean { start: None, declared_type: Some("Flag".to_owned()) },
        ),
        variable(
            "file",
            0,
            Causality::Parameter,
            Variability::Fixed,
            VariableKind::String { start: Some(String::new()), declared_type: None },
        ),
        approximate,
    ];
    Description {
        model_name: "Rich".to_owned(),
        guid: "{8c4e810f-3df3-4a00-8276-176fa3c9f000}".to_owned(),
        description: Some("Everything at once".to_owned()),
        author: Some("Ann & Bob".to_owned()),
        version: Some("1.2".to_owned()),
        copyright: Some("\u{a9} 2026".to_owned()),
        license: Some("MIT OR Apache-2.0".to_owned()),
        generation_tool: Some("heliotorque".to_owned()),
        generation_date_and_time: Some("2026-01-02T03:04:05Z".to_owned()),
        variable_naming: NamingConvention::Structured,
        co_simulation: Some(CoSimulation {
            model_identifier: "Rich".to_owned(),
            can_handle_variable_communication_step_size: true,
            can_interpolate_inputs: true,
            max_output_derivative_order: 1,
            can_get_and_set_fmu_state: true,
            can_serialize_fmu_state: true,
            can_not_use_memory_management_functions: true,
            source_files: vec!["a.c".to_owned(), "b/c.c".to_owned()],
            ..CoSimulation::default()
        }),
        units: ["rad", "s", "N.m"].iter().map(|name| units::find(name).unwrap().to_unit()).collect(),
        types: vec![
            SimpleType {
                name: "Angle".to_owned(),
                description: Some("An angle".to_owned()),
                kind: SimpleTypeKind::Real {
                    attributes: RealAttributes {
                        unit: Some("rad".to_owned()),
                        relative_quantity: true,
                        unbounded: true,
                        ..RealAttributes::default()
                    },
                },
            },
            plain_type("Count", SimpleTypeKind::Integer { quantity: None, min: Some(0), max: None }),
            plain_type("Flag", SimpleTypeKind::Boolean),
            plain_type("Text", SimpleTypeKind::String),
            plain_type("Source", SimpleTypeKind::Enumeration { quantity: None, items }),
        ],
        log_categories: vec![LogCategory {
            name: "logEvents".to_owned(),
            description: Some("Events".to_owned()),
        }],
        default_experiment: Some(DefaultExperiment {
            start_time: Some(0.0),
            stop_time: Some(7_776_000.0),
            tolerance: Some(1e-9),
            step_size: Some(60.0),
        }),
        structure: ModelStructure {
            outputs: vec![
                Unknown {
                    index: 3,
                    dependencies: Some(vec![1, 2]),
                    dependencies_kind: Some(vec![DependencyKind::Dependent, DependencyKind::Tunable]),
                },
                Unknown { index: 6, dependencies: Some(Vec::new()), ..Unknown::default() },
            ],
            ..rules::structure(&variables)
        },
        variables,
        ..Description::default()
    }
}
