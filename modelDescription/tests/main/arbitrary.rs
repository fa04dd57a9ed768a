//! Random valid descriptions: every legal role, every base type, every optional attribute.

use model_description::*;
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;

/// A valid description; what it leaves out of FMI is only what the standard forbids.
pub(crate) fn description() -> impl Strategy<Value = Description> {
    (
        vec(option::of(text()), 7),
        interfaces(),
        vec(unit(), 0..4),
        vec(type_kind(), 0..5),
        vec((text(), option::of(text())), 0..3),
        option::of(experiment()),
        vec(role(), 1..12),
        any::<u64>(),
    )
        .prop_map(
            |(texts, (co_simulation, model_exchange), units, kinds, categories, experiment, roles, seed)| {
                let mut texts = texts.into_iter();
                let mut next = || texts.next().flatten();
                let mut description = Description {
                    model_name: "A model".to_owned(),
                    guid: "{guid}".to_owned(),
                    description: next(),
                    author: next(),
                    version: next(),
                    copyright: next(),
                    license: next(),
                    generation_tool: next(),
                    generation_date_and_time: (seed % 2 == 0)
                        .then(|| "2024-02-29T23:59:59.5+14:00".to_owned()),
                    variable_naming: if seed % 3 == 0 {
                        NamingConvention::Flat
                    } else {
                        NamingConvention::Structured
                    },
                    number_of_event_indicators: (seed % 5 == 0).then_some((seed >> 32) as u32),
                    co_simulation,
                    model_exchange,
                    units: units.into_iter().enumerate().map(|(i, unit)| named_unit(i, unit)).collect(),
                    types: Vec::new(),
                    log_categories: categories
                        .into_iter()
                        .enumerate()
                        .map(|(i, (name, description))| LogCategory {
                            name: format!("{i}{name}"),
                            description,
                        })
                        .collect(),
                    default_experiment: experiment,
                    variables: Vec::new(),
                    structure: ModelStructure::default(),
                    annotation_tool: None,
                };
                for (i, kind) in kinds.into_iter().enumerate() {
                    let (kind, description_of_type) = kind;
                    let kind = with_unit(kind, &description.units, i);
                    let name = format!("Type {i}");
                    description.types.push(SimpleType { name, description: description_of_type, kind });
                }
                for (i, role) in roles.into_iter().enumerate() {
                    let variable = variable(i, role, &description);
                    description.variables.push(variable);
                }
                let is_annotated = description.variables.iter().any(|it| it.annotation.is_some());
                description.annotation_tool = is_annotated.then(|| annotation::TOOL.to_owned());
                description.structure = structure(&description.variables, seed);
                description
            },
        )
}

/// Any text XML can carry, line breaks and markup included.
fn text() -> impl Strategy<Value = String> {
    vec(
        prop_oneof![
            4 => any::<char>().prop_filter("XML cannot carry it", |c| {
                !matches!(c, '\u{0}'..='\u{8}' | '\u{b}' | '\u{c}' | '\u{e}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}')
            }),
            1 => proptest::sample::select(vec!['<', '>', '&', '"', '\'', '\n', '\r', '\t', ' ', ']', ';']),
        ],
        0..8,
    )
    .prop_map(|characters| characters.into_iter().collect())
}

fn finite() -> impl Strategy<Value = f64> {
    any::<u64>().prop_map(f64::from_bits).prop_filter("finite", |value| value.is_finite())
}

fn interfaces() -> impl Strategy<Value = (Option<CoSimulation>, Option<ModelExchange>)> {
    (any::<u16>(), any::<u32>(), "[A-Za-z_][A-Za-z0-9_]{0,5}", 0..3usize).prop_map(
        |(bits, order, name, files)| {
            let bit = |i: u32| bits >> i & 1 == 1;
            let source_files: Vec<String> = (0..files).map(|i| format!("dir/{i}.c")).collect();
            let co_simulation = CoSimulation {
                model_identifier: name.clone(),
                needs_execution_tool: bit(0),
                can_handle_variable_communication_step_size: bit(1),
                can_interpolate_inputs: bit(2),
                max_output_derivative_order: order % 4,
                can_run_asynchronuously: bit(3),
                can_be_instantiated_only_once_per_process: bit(4),
                can_not_use_memory_management_functions: bit(5),
                can_get_and_set_fmu_state: bit(6),
                can_serialize_fmu_state: bit(6) && bit(7),
                provides_directional_derivative: bit(8),
                source_files: source_files.clone(),
            };
            let model_exchange = ModelExchange {
                model_identifier: name,
                needs_execution_tool: bit(9),
                completed_integrator_step_not_needed: bit(10),
                can_be_instantiated_only_once_per_process: bit(11),
                can_not_use_memory_management_functions: bit(12),
                can_get_and_set_fmu_state: true,
                can_serialize_fmu_state: bit(13),
                provides_directional_derivative: bit(14),
                source_files,
            };
            match order % 3 {
                0 => (Some(co_simulation), None),
                1 => (Some(co_simulation), Some(model_exchange)),
                _ => (None, Some(model_exchange)),
            }
        },
    )
}

type UnitParts = (String, Option<([i8; 8], f64, f64)>, Vec<(f64, f64)>);

fn unit() -> impl Strategy<Value = UnitParts> {
    let factor = || finite().prop_filter("not 0", |factor| *factor != 0.0);
    (text(), option::of((any::<[i8; 8]>(), factor(), finite())), vec((factor(), finite()), 0..3))
}

fn named_unit(i: usize, (name, base, displays): UnitParts) -> Unit {
    let base = base.map(|(exponents, factor, offset)| {
        let [kg, m, s, a, k, mol, cd, rad] = exponents.map(i32::from);
        BaseUnit { kg, m, s, a, k, mol, cd, rad, factor, offset }
    });
    let display = |(j, (factor, offset))| DisplayUnit { name: format!("display {j}"), factor, offset };
    Unit {
        name: format!("{name} {i}"),
        base,
        display_units: displays.into_iter().enumerate().map(display).collect(),
    }
}

fn experiment() -> impl Strategy<Value = DefaultExperiment> {
    let positive = || option::of(finite().prop_map(f64::abs).prop_filter("above 0", |value| *value > 0.0));
    (option::of(finite()), option::of(finite()), positive(), positive()).prop_map(
        |(start_time, stop_time, tolerance, step_size)| DefaultExperiment {
            start_time,
            stop_time: stop_time.map(|stop| stop.max(start_time.unwrap_or(0.0))),
            tolerance,
            step_size,
        },
    )
}

fn type_kind() -> impl Strategy<Value = (SimpleTypeKind, Option<String>)> {
    let kind = prop_oneof![
        (option::of(text()), any::<[bool; 2]>(), option::of(1e-9..1e9)).prop_map(
            |(quantity, flags, nominal)| {
                SimpleTypeKind::Real {
                    attributes: RealAttributes {
                        quantity,
                        relative_quantity: flags[0],
                        unbounded: flags[1],
                        nominal,
                        ..RealAttributes::default()
                    },
                }
            }
        ),
        (option::of(text()), option::of(..0i32), option::of(0i32..))
            .prop_map(|(quantity, min, max)| SimpleTypeKind::Integer { quantity, min, max }),
        Just(SimpleTypeKind::Boolean),
        Just(SimpleTypeKind::String),
        (option::of(text()), vec((text(), option::of(text())), 1..4), any::<i16>()).prop_map(
            |(quantity, items, first)| SimpleTypeKind::Enumeration {
                quantity,
                items: items
                    .into_iter()
                    .zip(0i32..)
                    .map(|((name, description), i)| EnumerationItem {
                        name: format!("{name}{i}"),
                        value: i32::from(first) + 3 * i,
                        description,
                    })
                    .collect(),
            }
        ),
    ];
    (kind, option::of(text()))
}

fn with_unit(kind: SimpleTypeKind, units: &[Unit], i: usize) -> SimpleTypeKind {
    match kind {
        SimpleTypeKind::Real { mut attributes } if !units.is_empty() => {
            let unit = &units[i % units.len()];
            attributes.unit = Some(unit.name.clone());
            attributes.display_unit = unit.display_units.first().map(|display| display.name.clone());
            SimpleTypeKind::Real { attributes }
        }
        other => other,
    }
}

/// Row of the table, kind, bits for the rest, start, what lies around it, an integer, a text, a description.
type Role = (usize, u8, u16, f64, (f64, f64), i32, String, Option<String>);

fn role() -> impl Strategy<Value = Role> {
    let row = 0..rules::INITIAL_TABLE.len();
    let description = option::of(text());
    (row, 0..5u8, any::<u16>(), finite(), (finite(), finite()), any::<i32>(), text(), description)
}

fn variable(i: usize, role: Role, so_far: &Description) -> ScalarVariable {
    let (row, kind, bits, start, around, integer, text, description) = role;
    let mut row = rules::INITIAL_TABLE[row];
    let independent_exists = so_far.variables.iter().any(|v| v.causality == Causality::Independent);
    if row.causality == Causality::Independent && independent_exists {
        row = rules::INITIAL_TABLE[0];
    }
    let bit = |i: u32| bits >> i & 1 == 1;
    let initial = row.rule.allowed.get(bits as usize % (row.rule.allowed.len() + 1)).copied();
    let effective = rules::effective(row.causality, row.variability, initial);
    let started = rules::start(row.causality, effective) == rules::StartRule::Required;
    let of_kind = |is_kind: fn(&SimpleTypeKind) -> bool| {
        so_far.types.iter().filter(|known| is_kind(&known.kind)).nth(bits as usize % 2)
    };
    let name_of = |known: Option<&SimpleType>| known.map(|known| known.name.clone());
    let enumeration = of_kind(|kind| matches!(kind, SimpleTypeKind::Enumeration { .. }));
    let kind = if row.variability == Variability::Continuous { 0 } else { kind };
    let kind = match (kind, enumeration.map(|known| (&known.name, &known.kind))) {
        (1, _) => VariableKind::Integer {
            start: started.then_some(integer),
            declared_type: None,
            quantity: bit(1).then(|| text.clone()),
            min: bit(2).then_some(integer.min(-5)),
            max: bit(3).then_some(integer.max(5)),
        },
        (2, _) => VariableKind::Boolean {
            start: started.then_some(bit(1)),
            declared_type: name_of(of_kind(|kind| *kind == SimpleTypeKind::Boolean)),
        },
        (3, _) => VariableKind::String {
            start: started.then(|| text.clone()),
            declared_type: name_of(of_kind(|kind| *kind == SimpleTypeKind::String)),
        },
        (4, Some((name, SimpleTypeKind::Enumeration { items, .. }))) => VariableKind::Enumeration {
            start: started.then(|| items[0].value),
            declared_type: name.clone(),
            quantity: bit(1).then(|| text.clone()),
            min: bit(2).then(|| items[0].value),
            max: bit(3).then(|| items[items.len() - 1].value),
        },
        _ => {
            let mut attributes = RealAttributes {
                quantity: bit(1).then(|| text.clone()),
                relative_quantity: bit(2),
                unbounded: bit(3),
                min: bit(4).then_some(start.min(around.0)),
                max: bit(5).then_some(start.max(around.1)),
                nominal: bit(6).then_some(2.5e-3),
                ..RealAttributes::default()
            };
            if bit(7)
                && let Some(unit) = so_far.units.last()
            {
                attributes.unit = Some(unit.name.clone());
                attributes.display_unit = unit.display_units.last().map(|display| display.name.clone());
            }
            let declared_type = name_of(of_kind(|kind| matches!(kind, SimpleTypeKind::Real { .. })));
            VariableKind::Real {
                start: started.then_some(start),
                declared_type,
                attributes,
                derivative: None,
                reinit: None,
            }
        }
    };
    let model_exchange = so_far.model_exchange.is_some();
    let annotation = bit(10).then(|| {
        let is_real = |kind: &VariableKind| matches!(kind, VariableKind::Real { .. });
        let earlier = so_far.variables.iter().rev().find(|it| is_real(&it.kind)).map(|it| it.name.clone());
        let is_input = row.causality == Causality::Input;
        let options = so_far.variables.iter().filter(|it| is_input && !value::items(so_far, it).is_empty());
        let read_where = options.map(|option| ReadWhere {
            option: option.name.clone(),
            items: value::items(so_far, option).iter().map(|item| item.value.to_string()).collect(),
            set: bit(11).then(|| value::items(so_far, option)[0].name.clone()),
        });
        Box::new(Annotation {
            also_called: (is_input && bit(12)).then(|| format!("<other> \"{i}\"")),
            limited_by: earlier.clone(),
            role: (is_real(&kind) && bit(13)).then_some(VariableRole::ALL[i % 3]),
            interpolation: (is_real(&kind) && bit(14)).then_some(InterpolationKind::ALL[i % 3]),
            rate: earlier.filter(|_| bit(15)),
            read_where: read_where.collect(),
        })
    });
    ScalarVariable {
        annotation,
        name: format!("group[{i}].'x {i}'"),
        value_reference: i as u32,
        description,
        causality: row.causality,
        variability: row.variability,
        initial,
        can_handle_multiple_set_per_time_instant: (model_exchange
            && row.causality == Causality::Input
            && bit(8))
        .then_some(bit(9)),
        kind,
    }
}

fn structure(variables: &[ScalarVariable], seed: u64) -> ModelStructure {
    let mut structure = rules::structure(variables);
    let indices: Vec<u32> = (1..).zip(variables).map(|(index, _)| index).collect();
    let known = |index: &u32| {
        let v = &variables[*index as usize - 1];
        matches!(v.causality, Causality::Input | Causality::Independent)
    };
    let lists = structure.outputs.iter_mut().chain(&mut structure.initial_unknowns);
    for (i, unknown) in lists.enumerate() {
        let bits = seed.rotate_left(i as u32);
        if bits & 1 == 1 {
            let dependencies: Vec<u32> =
                indices.iter().copied().filter(|index| known(index) && bits >> index & 1 == 1).collect();
            unknown.dependencies_kind =
                (bits & 2 == 2).then(|| vec![DependencyKind::Dependent; dependencies.len()]);
            unknown.dependencies = Some(dependencies);
        }
    }
    structure
}
