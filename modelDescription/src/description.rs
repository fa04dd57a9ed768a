//! The content of a `modelDescription.xml` as plain values (FMI 2.0.5, section 2.2).

/// A whole model description of a co-simulation FMU.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Description {
    /// `modelName`: what tools show.
    pub model_name: String,
    /// `guid`: ties the XML to the binary.
    pub guid: String,
    /// `description`: one sentence about the model.
    pub description: Option<String>,
    /// `author`.
    pub author: Option<String>,
    /// `version` of the model.
    pub version: Option<String>,
    /// `copyright`.
    pub copyright: Option<String>,
    /// `license`: name or one-line text.
    pub license: Option<String>,
    /// `generationTool`.
    pub generation_tool: Option<String>,
    /// `generationDateAndTime`; ours never write it, so that archives are byte-identical.
    pub generation_date_and_time: Option<String>,
    /// `variableNamingConvention`.
    pub variable_naming: NamingConvention,
    /// `numberOfEventIndicators` (model exchange only; read, never written by us).
    pub number_of_event_indicators: Option<u32>,
    /// The `CoSimulation` element.
    pub co_simulation: Option<CoSimulation>,
    /// The `ModelExchange` element; read, never written by our exporter.
    pub model_exchange: Option<ModelExchange>,
    /// `UnitDefinitions`.
    pub units: Vec<Unit>,
    /// `TypeDefinitions`.
    pub types: Vec<SimpleType>,
    /// `LogCategories`.
    pub log_categories: Vec<LogCategory>,
    /// `DefaultExperiment`.
    pub default_experiment: Option<DefaultExperiment>,
    /// `ModelVariables`, in order: index 1 is the first.
    pub variables: Vec<ScalarVariable>,
    /// `ModelStructure`.
    pub structure: ModelStructure,
}

/// `variableNamingConvention` (2.2.9).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum NamingConvention {
    /// Any text.
    #[default]
    Flat,
    /// `a.b[1].c`.
    Structured,
}

/// The `CoSimulation` element and its capability flags (4.3.1).
#[derive(Clone, Debug, PartialEq, Eq, Default)]
#[allow(missing_docs, reason = "the fields are the standard's own attribute names")]
pub struct CoSimulation {
    pub model_identifier: String,
    pub needs_execution_tool: bool,
    pub can_handle_variable_communication_step_size: bool,
    pub can_interpolate_inputs: bool,
    pub max_output_derivative_order: u32,
    pub can_run_asynchronuously: bool,
    pub can_be_instantiated_only_once_per_process: bool,
    pub can_not_use_memory_management_functions: bool,
    pub can_get_and_set_fmu_state: bool,
    pub can_serialize_fmu_state: bool,
    pub provides_directional_derivative: bool,
    /// `SourceFiles`; never written by our exporter.
    pub source_files: Vec<String>,
}

/// The `ModelExchange` element and its capability flags (3.3.1).
#[derive(Clone, Debug, PartialEq, Eq, Default)]
#[allow(missing_docs, reason = "the fields are the standard's own attribute names")]
pub struct ModelExchange {
    pub model_identifier: String,
    pub needs_execution_tool: bool,
    pub completed_integrator_step_not_needed: bool,
    pub can_be_instantiated_only_once_per_process: bool,
    pub can_not_use_memory_management_functions: bool,
    pub can_get_and_set_fmu_state: bool,
    pub can_serialize_fmu_state: bool,
    pub provides_directional_derivative: bool,
    /// `SourceFiles`.
    pub source_files: Vec<String>,
}

/// One `Unit` with its base unit and display units (2.2.2).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Unit {
    /// Name as used in `unit="…"`.
    pub name: String,
    /// Exponents of the SI base units; `None` where the XML gives no `BaseUnit`.
    pub base: Option<BaseUnit>,
    /// Units for people.
    pub display_units: Vec<DisplayUnit>,
}

/// `BaseUnit`: value_si = factor * value + offset.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the fields are the SI base units' own symbols")]
pub struct BaseUnit {
    pub kg: i32,
    pub m: i32,
    pub s: i32,
    pub a: i32,
    pub k: i32,
    pub mol: i32,
    pub cd: i32,
    pub rad: i32,
    pub factor: f64,
    pub offset: f64,
}

impl Default for BaseUnit {
    fn default() -> Self {
        Self { kg: 0, m: 0, s: 0, a: 0, k: 0, mol: 0, cd: 0, rad: 0, factor: 1.0, offset: 0.0 }
    }
}

impl BaseUnit {
    /// The SI base units' symbols with their exponents.
    pub fn exponents(&self) -> [(&'static str, i32); 8] {
        [
            ("kg", self.kg),
            ("m", self.m),
            ("s", self.s),
            ("A", self.a),
            ("K", self.k),
            ("mol", self.mol),
            ("cd", self.cd),
            ("rad", self.rad),
        ]
    }

    /// Of exponents that are read by their symbols.
    pub fn of<E>(
        mut exponent: impl FnMut(&'static str) -> Result<i32, E>,
        factor: f64,
        offset: f64,
    ) -> Result<Self, E> {
        Ok(Self {
            kg: exponent("kg")?,
            m: exponent("m")?,
            s: exponent("s")?,
            a: exponent("A")?,
            k: exponent("K")?,
            mol: exponent("mol")?,
            cd: exponent("cd")?,
            rad: exponent("rad")?,
            factor,
            offset,
        })
    }
}

/// `DisplayUnit`: value_display = factor * value_unit + offset.
#[derive(Clone, Debug, PartialEq)]
#[allow(missing_docs, reason = "the fields are the standard's own attribute names")]
pub struct DisplayUnit {
    pub name: String,
    pub factor: f64,
    pub offset: f64,
}

/// A `SimpleType` (2.2.3).
#[derive(Clone, Debug, PartialEq)]
pub struct SimpleType {
    /// Name as used in `declaredType="…"`.
    pub name: String,
    /// What it means.
    pub description: Option<String>,
    /// Kind and attributes.
    pub kind: SimpleTypeKind,
}

/// What a `SimpleType` is.
#[derive(Clone, Debug, PartialEq)]
pub enum SimpleTypeKind {
    /// Real with its attributes.
    Real(RealAttributes),
    /// Integer with limits and quantity.
    Integer {
        /// `quantity`.
        quantity: Option<String>,
        /// `min`.
        min: Option<i32>,
        /// `max`.
        max: Option<i32>,
    },
    /// Boolean.
    Boolean,
    /// String.
    String,
    /// Enumeration with its items.
    Enumeration {
        /// `quantity`.
        quantity: Option<String>,
        /// The items.
        items: Vec<EnumerationItem>,
    },
}

/// `Item` of an enumeration.
#[derive(Clone, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the fields are the standard's own attribute names")]
pub struct EnumerationItem {
    pub name: String,
    pub value: i32,
    pub description: Option<String>,
}

/// `Category` of `LogCategories`.
#[derive(Clone, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the fields are the standard's own attribute names")]
pub struct LogCategory {
    pub name: String,
    pub description: Option<String>,
}

/// `DefaultExperiment`; times in seconds.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
#[allow(missing_docs, reason = "the fields are the standard's own attribute names")]
pub struct DefaultExperiment {
    pub start_time: Option<f64>,
    pub stop_time: Option<f64>,
    pub tolerance: Option<f64>,
    pub step_size: Option<f64>,
}

/// `causality` (2.2.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the standard's own words")]
pub enum Causality {
    Parameter,
    CalculatedParameter,
    Input,
    Output,
    #[default]
    Local,
    Independent,
}

/// `variability` (2.2.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the standard's own words")]
pub enum Variability {
    Constant,
    Fixed,
    Tunable,
    Discrete,
    #[default]
    Continuous,
}

/// `initial` (2.2.7).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[allow(missing_docs, reason = "the standard's own words")]
pub enum Initial {
    Exact,
    Approx,
    Calculated,
}

/// One `ScalarVariable`.
#[derive(Clone, Debug, PartialEq)]
pub struct ScalarVariable {
    /// Unique name.
    pub name: String,
    /// Value reference, dense per base type in ours.
    pub value_reference: u32,
    /// What it means, with frame and convention.
    pub description: Option<String>,
    /// Causality.
    pub causality: Causality,
    /// Variability.
    pub variability: Variability,
    /// `initial` as written; `None` means the table's default (see `rules`).
    pub initial: Option<Initial>,
    /// `canHandleMultipleSetPerTimeInstant`.
    pub can_handle_multiple_set_per_time_instant: Option<bool>,
    /// Base type and its attributes.
    pub kind: VariableKind,
}

/// Base type of a variable with its attributes.
#[derive(Clone, Debug, PartialEq)]
pub enum VariableKind {
    /// `Real`.
    Real {
        /// `start`.
        start: Option<f64>,
        /// `declaredType`.
        declared_type: Option<String>,
        /// Unit, limits and the rest.
        attributes: RealAttributes,
        /// `derivative`: 1-based index of the variable this one differentiates.
        derivative: Option<u32>,
        /// `reinit` (model exchange only).
        reinit: Option<bool>,
    },
    /// `Integer`.
    Integer {
        /// `start`.
        start: Option<i32>,
        /// `declaredType`.
        declared_type: Option<String>,
        /// `quantity`.
        quantity: Option<String>,
        /// `min`.
        min: Option<i32>,
        /// `max`.
        max: Option<i32>,
    },
    /// `Boolean`.
    Boolean {
        /// `start`.
        start: Option<bool>,
        /// `declaredType`.
        declared_type: Option<String>,
    },
    /// `String`.
    String {
        /// `start`.
        start: Option<String>,
        /// `declaredType`.
        declared_type: Option<String>,
    },
    /// `Enumeration`; its values are Integers at the interface.
    Enumeration {
        /// `start`.
        start: Option<i32>,
        /// `declaredType`, required.
        declared_type: String,
        /// `quantity`.
        quantity: Option<String>,
        /// `min`.
        min: Option<i32>,
        /// `max`.
        max: Option<i32>,
    },
}

/// Attributes shared by Real variables and Real types (2.2.3).
#[derive(Clone, Debug, PartialEq, Default)]
#[allow(missing_docs, reason = "the fields are the standard's own attribute names")]
pub struct RealAttributes {
    pub quantity: Option<String>,
    pub unit: Option<String>,
    pub display_unit: Option<String>,
    pub relative_quantity: bool,
    pub min: Option<f64>,
    pub max: Option<f64>,
    pub nominal: Option<f64>,
    pub unbounded: bool,
}

/// `ModelStructure` (2.2.8).
#[derive(Clone, Debug, PartialEq, Default)]
#[allow(missing_docs, reason = "the fields are the standard's own element names")]
pub struct ModelStructure {
    pub outputs: Vec<Unknown>,
    pub derivatives: Vec<Unknown>,
    pub initial_unknowns: Vec<Unknown>,
}

/// `Unknown` of the model structure.
#[derive(Clone, Debug, PartialEq, Eq, Default)]
pub struct Unknown {
    /// 1-based index into the variables.
    pub index: u32,
    /// What it depends on; `None` (absent) means everything, an empty list nothing.
    pub dependencies: Option<Vec<u32>>,
    /// `dependenciesKind`, as long as `dependencies` when present.
    pub dependencies_kind: Option<Vec<DependencyKind>>,
}

/// One entry of `dependenciesKind`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the standard's own words")]
pub enum DependencyKind {
    Dependent,
    Constant,
    Fixed,
    Tunable,
    Discrete,
}
