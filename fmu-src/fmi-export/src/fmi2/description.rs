//! From a model and its setup to the `modelDescription.xml`, the GUID and the parts of an instance.

use std::collections::BTreeSet;
use std::sync::Arc;

use model_description::{
    Causality, CoSimulation, DefaultExperiment, Description, EnumerationItem, NamingConvention,
    RealAttributes, ScalarVariable, SimpleType, SimpleTypeKind, Variability, VariableKind, rules, units,
};
use uuid::Uuid;

use super::references;
use super::structure::structure;
use crate::dependencies::Dependencies;
use crate::library::Entry;
use crate::logger::Category;
use crate::model::{About, Model};
use crate::prepared::{DescribeError, Prepared};
use crate::runtime::Typed;
use crate::start_values::{self, OtherReader, Readers};
use crate::variables::{
    Declare, DeclaredEnumeration, DeclaredType, Element, Interface, SetBits, Values, Variable, Variables,
};

/// Name space of the GUIDs of this exporter.
const NAME_SPACE: Uuid = Uuid::from_u128(0xcc931cc2_33f1_4b24_a08d_a93a9fb26fe9);

/// Memory for what the digest is taken over; a larger interface takes more. Large enough to be a mapping of its own, which
/// leaves no hole in the heap.
const DIGESTED_BYTES: usize = 1 << 18;

/// The entry of a model in a library of FMI 2.0.
pub const fn entry<M: Model>() -> Entry {
    Entry::new::<M>(prepare::<M>, start_names::<M>)
}

/// The description of a model with this setup, GUID included.
pub fn description_of<M: Model>(file: &str, setup_text: &str) -> Result<Description, DescribeError> {
    prepare::<M>(file, setup_text, &[]).map(|prepared| prepared.description)
}

/// The names that start values may have, if the model takes the setup text.
pub(crate) fn start_names<M: Model>(file: &str, setup_text: &str) -> Option<BTreeSet<String>> {
    let setup = M::parse_setup(file, setup_text).ok()?;
    let mut declare = Declare::new();
    M::Variables::declare(&mut declare, &setup, 0).ok()?;
    Some(start_values::settable_names(&scalar_variables(&declare.finish())))
}

/// Describes a model; `others` are the other models that the setup may serve.
pub(crate) fn prepare<M: Model>(
    file: &str,
    setup_text: &str,
    others: &[OtherReader<'_>],
) -> Result<Prepared, DescribeError> {
    let setup = M::parse_setup(file, setup_text)?;
    let mut declare = Declare::new();
    let variables = M::Variables::declare(&mut declare, &setup, 0)?;
    let mut interface = declare.finish();
    let scalars = scalar_variables(&interface);
    let dependencies = M::dependencies(&setup, &variables);
    let about = M::about(&setup);
    let text = |text: &str| (!text.is_empty()).then(|| text.to_owned());
    let mut description = Description {
        model_name: M::NAME.to_owned(),
        description: text(&about.description),
        author: text(&about.author),
        version: text(&about.version),
        copyright: text(&about.copyright),
        license: text(&about.license),
        generation_tool: text(&about.tool)
            .or_else(|| Some(concat!("fmi-export ", env!("CARGO_PKG_VERSION")).to_owned())),
        variable_naming: NamingConvention::Structured,
        types: interface.enumerations.iter().map(simple_type).collect(),
        log_categories: Category::declared(),
        default_experiment: Some(DefaultExperiment {
            start_time: Some(about.start_time_s),
            stop_time: Some(about.stop_time_s),
            tolerance: (about.tolerance > 0.0).then_some(about.tolerance),
            step_size: (about.step_size_s > 0.0).then_some(about.step_size_s),
        }),
        variables: scalars,
        annotation_tool: text(&about.annotation_tool),
        ..Description::default()
    };
    description.units = units_of(&description);
    let readers = Readers::new(M::NAME, file, others);
    let given = M::start_values(&setup);
    let fixed = start_values::apply(&given, &readers, &mut description, &mut interface.start)
        .map_err(DescribeError::Start)?;
    let following = M::following_start_values(&setup, &variables, &interface.start);
    // Nobody gave what follows from others.
    let given = interface.start.set.clone();
    start_values::apply(&following, &readers, &mut description, &mut interface.start)
        .map_err(DescribeError::Start)?;
    interface.start.set = given;
    leave_choices(&mut description.variables, &interface.start.set);
    description.co_simulation = Some(co_simulation::<M>(&description.variables));
    description.structure = structure(&dependencies, &description.variables).map_err(DescribeError::Table)?;
    // Which of them the setup gave stands in the setup.
    let start = Arc::new(interface.start.clone());
    interface.start.mark_none();
    let digest = digest_of::<M>((&interface, &fixed), &dependencies, &about, &setup)?;
    description.guid = format!("{{{digest}}}");
    references::check_dense(&description.variables).map_err(DescribeError::Table)?;
    let tolerance = M::tolerance(&variables);
    let parameters = parameters_of(&description.variables, &interface.start);
    let runtime =
        Box::new(Typed::<M> { setup, variables, start: Arc::clone(&start), parameters, state: None });
    Ok(Prepared { description, start, runtime, digest, tolerance })
}

/// Takes away the items that tools would set where the setup chose one.
fn leave_choices(variables: &mut [ScalarVariable], given: &[SetBits; Element::TABLES]) {
    let is_given = |it: &&ScalarVariable| {
        let base = it.kind.base_type();
        given[base as usize].is_set(references::index(base, it.value_reference))
    };
    let chosen: BTreeSet<String> = variables.iter().filter(is_given).map(|it| it.name.clone()).collect();
    let annotations = variables.iter_mut().filter_map(|it| it.annotation.as_mut());
    for option in annotations.flat_map(|it| &mut it.read_where).filter(|it| chosen.contains(&it.option)) {
        option.set = None;
    }
}

/// Places of the parameters that an importer may set; in `blank` no value is marked as set.
fn parameters_of(variables: &[ScalarVariable], blank: &Values) -> [SetBits; Element::TABLES] {
    let mut places = blank.set.clone();
    for variable in variables.iter().filter(|it| it.causality == Causality::Parameter) {
        let base = variable.kind.base_type();
        places[base as usize].mark(references::index(base, variable.value_reference));
    }
    places
}

/// The elements of every variable, in order, with their start values.
pub fn scalar_variables(interface: &Interface) -> Vec<ScalarVariable> {
    let elements = |variable| Variable::elements(variable).map(move |(name, at)| (variable, name, at));
    let scalar = |(variable, name, element): (&Variable, String, Element)| {
        let role = variable.role;
        ScalarVariable {
            annotation: variable.annotation_of(&name),
            name,
            value_reference: references::for_variable(element),
            description: Some(variable.description.clone()),
            causality: role.causality,
            variability: role.variability,
            initial: role.initial,
            can_handle_multiple_set_per_time_instant: None,
            kind: kind(variable, element, &interface.start),
        }
    };
    interface.variables.iter().flat_map(elements).map(scalar).collect()
}

fn kind(variable: &Variable, element: Element, start: &Values) -> VariableKind {
    let role = variable.role;
    let effective = rules::effective(role.causality, role.variability, role.initial);
    let has_start = rules::start(role.causality, effective) == rules::StartRule::Required;
    let at = Some(element.place as usize).filter(|_| has_start);
    let integer = at.and_then(|at| start.integers.get(at).copied());
    match &variable.kind {
        DeclaredType::Real { unit, display_unit, min, max, nominal } => VariableKind::Real {
            start: at.and_then(|at| start.reals.get(at).copied()),
            declared_type: None,
            attributes: RealAttributes {
                unit: Some(unit.clone()),
                display_unit: display_unit.clone(),
                min: *min,
                max: *max,
                nominal: *nominal,
                ..RealAttributes::default()
            },
            derivative: None,
            reinit: None,
        },
        DeclaredType::Integer { min, max } => VariableKind::Integer {
            start: integer,
            declared_type: None,
            quantity: None,
            min: *min,
            max: *max,
        },
        DeclaredType::Boolean => VariableKind::Boolean {
            start: at.and_then(|at| start.booleans.get(at).copied()),
            declared_type: None,
        },
        DeclaredType::Text => VariableKind::String {
            start: at.and_then(|at| start.strings.get(at).cloned()),
            declared_type: None,
        },
        DeclaredType::Enumeration(name) => VariableKind::Enumeration {
            start: integer,
            declared_type: (*name).to_owned(),
            quantity: None,
            min: None,
            max: None,
        },
    }
}

fn simple_type(declared: &DeclaredEnumeration) -> SimpleType {
    let item = |item: &crate::variables::DeclaredItem| EnumerationItem {
        name: item.name.clone(),
        value: item.value,
        description: Some(item.description.clone()),
    };
    SimpleType {
        name: declared.name.to_owned(),
        description: Some(declared.description.to_owned()),
        kind: SimpleTypeKind::Enumeration {
            quantity: None,
            items: declared.items.iter().map(item).collect(),
        },
    }
}

fn co_simulation<M: Model>(variables: &[ScalarVariable]) -> CoSimulation {
    let can_move = |variable: &ScalarVariable| {
        variable.causality == model_description::Causality::Input
            && variable.variability == Variability::Continuous
    };
    CoSimulation {
        model_identifier: M::NAME.to_owned(),
        can_handle_variable_communication_step_size: true,
        can_interpolate_inputs: variables.iter().any(can_move),
        max_output_derivative_order: u32::from(M::EXTENSIONS.output_rate.is_some()),
        can_not_use_memory_management_functions: true,
        can_get_and_set_fmu_state: true,
        can_serialize_fmu_state: true,
        provides_directional_derivative: M::EXTENSIONS.jacobian_vector_product.is_some(),
        ..CoSimulation::default()
    }
}

/// The units that variables carry, in the order of the unit table.
fn units_of(description: &Description) -> Vec<model_description::Unit> {
    let used = |name: &str| {
        description.variables.iter().any(|variable| match &variable.kind {
            VariableKind::Real { attributes, .. } => attributes.unit.as_deref() == Some(name),
            _ => false,
        })
    };
    units::UNITS.iter().filter(|row| used(row.name)).map(units::KnownUnit::to_unit).collect()
}

/// UUIDv5 of the declarations and those of them that are fixed, the model's `About`, the setup's content, the model's name and optional traits, and the
/// version of its state. Default times do not enter.
fn digest_of<M: Model>(
    interface: (&Interface, &BTreeSet<usize>),
    dependencies: &Dependencies,
    about: &About,
    setup: &M::Setup,
) -> Result<Uuid, DescribeError> {
    let extensions = (M::EXTENSIONS.output_rate.is_some(), M::EXTENSIONS.jacobian_vector_product.is_some());
    let model = (M::NAME, M::STATE_VERSION, extensions);
    let about = (&about.description, &about.author, &about.version, &about.license, about.tolerance);
    let digested = (model, about, interface, dependencies, setup);
    // The same bytes on every platform, texts and lists with their lengths: no two sets of facts share them.
    let bytes = postcard::to_extend(&digested, Vec::with_capacity(DIGESTED_BYTES))
        .map_err(|error| DescribeError::Digest(error.to_string()))?;
    Ok(Uuid::new_v5(&NAME_SPACE, &bytes))
}
