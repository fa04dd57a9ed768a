//! From a model and its setup to a description, a GUID and the parts of an instance.

use std::collections::BTreeSet;

use model_description::{
    CoSimulation, DefaultExperiment, Description, NamingConvention, VariableKind, digest, units,
};
use uuid::Uuid;

use crate::fmi2::access::AccessTable;
use crate::fmi2::library::Entry;
use crate::fmi2::logger::Category;
use crate::fmi2::start::{self, Readers};
use crate::model::{Model, SetupError};
use crate::runtime::{Capabilities, Parts, Typed};
use crate::variables::{Declare, DeclareError, Table, Variables};

/// Name space of the GUIDs: UUIDv5 of "https://fmi-standard.org/heliotorque" in the URL name space.
const NAME_SPACE: &[u8] = b"https://fmi-standard.org/heliotorque";

/// Why a model cannot be described.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DescribeError {
    /// The setup text is refused.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// A declaration is refused.
    #[error(transparent)]
    Declare(#[from] DeclareError),
    /// The declarations do not fit together.
    #[error("{0}")]
    Table(String),
    /// Start values of the setup that no variable takes, one a line.
    #[error("{0}")]
    Start(String),
    /// The setup cannot enter the GUID.
    #[error("the setup cannot be digested: {0}")]
    Digest(String),
    /// The model panicked.
    #[error("the model panicked: {0}")]
    Panic(String),
}

/// The description of a model with this setup, GUID included.
pub fn description_of<M: Model>(file: &str, setup_text: &str) -> Result<Description, DescribeError> {
    prepare::<M>(file, setup_text, &[]).map(|prepared| prepared.description)
}

fn said(text: String) -> Option<String> {
    (!text.is_empty()).then_some(text)
}

/// A description and the instance parts behind it.
pub(crate) struct Prepared {
    pub(crate) description: Description,
    pub(crate) parts: Parts,
}

/// The names that start values may have, if the model takes the setup text.
pub(crate) fn start_names<M: Model>(file: &str, setup_text: &str) -> Option<BTreeSet<String>> {
    let setup = M::parse_setup(file, setup_text).ok()?;
    let mut declare = Declare::new();
    M::Variables::declare(&mut declare, &setup, 0).ok()?;
    Some(start::settable_names(&declare.finish().variables))
}

/// Describes a model; `library` holds the models that the setup may serve beside it.
pub(crate) fn prepare<M: Model>(
    file: &str,
    setup_text: &str,
    library: &[Entry],
) -> Result<Prepared, DescribeError> {
    let setup = M::parse_setup(file, setup_text)?;
    let mut declare = Declare::new();
    let variables = M::Variables::declare(&mut declare, &setup, 0)?;
    let Table { variables: declared, types, start: mut start_values, .. } = declare.finish();
    let structure = M::dependencies(&setup, &variables).structure(&declared).map_err(DescribeError::Table)?;
    let about = M::about(&setup);
    let mut description = Description {
        model_name: M::NAME.to_owned(),
        description: said(about.description),
        author: said(about.author),
        version: said(about.version),
        license: said(about.license),
        generation_tool: Some(concat!("fmi-export ", env!("CARGO_PKG_VERSION")).to_owned()),
        variable_naming: NamingConvention::Structured,
        co_simulation: Some(co_simulation::<M>()),
        types,
        log_categories: Category::declared(),
        default_experiment: Some(DefaultExperiment {
            start_time: Some(about.start_time_s),
            stop_time: Some(about.stop_time_s),
            tolerance: (about.tolerance > 0.0).then_some(about.tolerance),
            step_size: (about.step_size_s > 0.0).then_some(about.step_size_s),
        }),
        structure,
        variables: declared,
        ..Description::default()
    };
    description.units = units_of(&description);
    let readers = Readers::new(M::NAME, library, file, setup_text);
    start::apply(&M::start_values(&setup), &readers, &mut description, &mut start_values)
        .map_err(DescribeError::Start)?;
    let digest = digest_of::<M>(&description, &setup)?;
    description.guid = format!("{{{digest}}}");
    let access = AccessTable::of(&description).map_err(DescribeError::Table)?;
    let capabilities = Capabilities {
        max_output_derivative_order: M::MAX_OUTPUT_DERIVATIVE_ORDER,
        interpolates_inputs: M::CAN_INTERPOLATE_INPUTS,
    };
    let runtime = Box::new(Typed::<M> { setup, variables, state: None });
    Ok(Prepared { description, parts: Parts { access, start: start_values, runtime, digest, capabilities } })
}

fn co_simulation<M: Model>() -> CoSimulation {
    CoSimulation {
        model_identifier: M::NAME.to_owned(),
        can_handle_variable_communication_step_size: true,
        can_interpolate_inputs: M::CAN_INTERPOLATE_INPUTS,
        max_output_derivative_order: M::MAX_OUTPUT_DERIVATIVE_ORDER,
        can_not_use_memory_management_functions: true,
        can_get_and_set_fmu_state: true,
        can_serialize_fmu_state: true,
        provides_directional_derivative: M::PROVIDES_DIRECTIONAL_DERIVATIVE,
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

/// UUIDv5 of the interface, the setup's content, the model's name and the version of its state.
fn digest_of<M: Model>(description: &Description, setup: &M::Setup) -> Result<Uuid, DescribeError> {
    let setup = postcard::to_allocvec(setup).map_err(|error| DescribeError::Digest(error.to_string()))?;
    let canonical = digest::canonical(description);
    let mut bytes = Vec::with_capacity(canonical.len() + setup.len() + 64);
    // Each part with its length, so that no two sets of parts share their bytes.
    for part in [canonical.as_bytes(), &setup, M::NAME.as_bytes(), &M::STATE_VERSION.to_le_bytes()] {
        bytes.extend_from_slice(&(part.len() as u64).to_le_bytes());
        bytes.extend_from_slice(part);
    }
    let name_space = Uuid::new_v5(&Uuid::NAMESPACE_URL, NAME_SPACE);
    Ok(Uuid::new_v5(&name_space, &bytes))
}
