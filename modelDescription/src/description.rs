//! The content of a `modelDescription.xml` as plain values (FMI 2.0.5, section 2.2).

use crate::element::{element, elements};
use crate::{Annotation, Causality, DependencyKind, Initial, NamingConvention, Variability, VariableRole};

element! {
    /// A whole model description of a co-simulation FMU.
    #[derive(Default)]
    pub struct Description {
        /// Name of the model as tools show it.
        model_name: String = required "modelName",
        /// Ties the XML to the binary.
        guid: String = required "guid",
        /// One sentence about the model.
        description: Option<String> = optional "description",
        author: Option<String> = optional "author",
        /// Version of the model.
        version: Option<String> = optional "version",
        copyright: Option<String> = optional "copyright",
        /// Name or one-line text.
        license: Option<String> = optional "license",
        generation_tool: Option<String> = optional "generationTool",
        /// Ours never write it, so that archives are byte-identical.
        generation_date_and_time: Option<String> = optional "generationDateAndTime",
        variable_naming: NamingConvention = or(NamingConvention::Flat) "variableNamingConvention",
        /// Model exchange only; read, never written by us.
        number_of_event_indicators: Option<u32> = optional "numberOfEventIndicators",
        ;
        /// The `CoSimulation` element.
        co_simulation: Option<CoSimulation>,
        /// The `ModelExchange` element; read, never written by our exporter.
        model_exchange: Option<ModelExchange>,
        /// `UnitDefinitions`.
        units: Vec<Unit>,
        /// `TypeDefinitions`.
        types: Vec<SimpleType>,
        /// `LogCategories`.
        log_categories: Vec<LogCategory>,
        /// `DefaultExperiment`.
        default_experiment: Option<DefaultExperiment>,
        /// `ModelVariables`, in order: index 1 is the first.
        variables: Vec<ScalarVariable>,
        /// `ModelStructure`.
        structure: ModelStructure,
        /// Tool that the annotations of variables are for; without one they are not written.
        annotation_tool: Option<String>,
    }
}

impl Description {
    /// The variables with a role.
    pub fn with_role(&self, role: VariableRole) -> impl Iterator<Item = &ScalarVariable> {
        self.variables.iter().filter(move |it| it.role() == Some(role))
    }
}

element! {
    /// The `CoSimulation` element and its capability flags (4.3.1).
    #[derive(Eq, Default)]
    pub struct CoSimulation {
        model_identifier: String = required "modelIdentifier",
        needs_execution_tool: bool = or(false) "needsExecutionTool",
        can_handle_variable_communication_step_size: bool = or(false) "canHandleVariableCommunicationStepSize",
        can_interpolate_inputs: bool = or(false) "canInterpolateInputs",
        max_output_derivative_order: u32 = or(0) "maxOutputDerivativeOrder",
        can_run_asynchronuously: bool = or(false) "canRunAsynchronuously",
        can_be_instantiated_only_once_per_process: bool = or(false) "canBeInstantiatedOnlyOncePerProcess",
        can_not_use_memory_management_functions: bool = or(false) "canNotUseMemoryManagementFunctions",
        can_get_and_set_fmu_state: bool = or(false) "canGetAndSetFMUstate",
        can_serialize_fmu_state: bool = or(false) "canSerializeFMUstate",
        provides_directional_derivative: bool = or(false) "providesDirectionalDerivative",
        ;
        /// `SourceFiles`; never written by our exporter.
        source_files: Vec<String>,
    }
}

element! {
    /// The `ModelExchange` element and its capability flags (3.3.1).
    #[derive(Eq, Default)]
    pub struct ModelExchange {
        model_identifier: String = required "modelIdentifier",
        needs_execution_tool: bool = or(false) "needsExecutionTool",
        completed_integrator_step_not_needed: bool = or(false) "completedIntegratorStepNotNeeded",
        can_be_instantiated_only_once_per_process: bool = or(false) "canBeInstantiatedOnlyOncePerProcess",
        can_not_use_memory_management_functions: bool = or(false) "canNotUseMemoryManagementFunctions",
        can_get_and_set_fmu_state: bool = or(false) "canGetAndSetFMUstate",
        can_serialize_fmu_state: bool = or(false) "canSerializeFMUstate",
        provides_directional_derivative: bool = or(false) "providesDirectionalDerivative",
        ;
        /// `SourceFiles`.
        source_files: Vec<String>,
    }
}

element! {
    /// One `Unit` with its base unit and display units (2.2.2).
    #[derive(Default)]
    pub struct Unit {
        /// As used in `unit="…"`.
        name: String = required "name",
        ;
        /// Exponents of the SI base units; `None` where the XML gives no `BaseUnit`.
        base: Option<BaseUnit>,
        /// Units for people.
        display_units: Vec<DisplayUnit>,
    }
}

element! {
    /// `BaseUnit`: value_si = factor * value + offset.
    #[derive(Copy)]
    pub struct BaseUnit {
        kg: i32 = or(0) "kg",
        m: i32 = or(0) "m",
        s: i32 = or(0) "s",
        a: i32 = or(0) "A",
        k: i32 = or(0) "K",
        mol: i32 = or(0) "mol",
        cd: i32 = or(0) "cd",
        rad: i32 = or(0) "rad",
        factor: f64 = or(1.0) "factor",
        offset: f64 = or(0.0) "offset",
    }
}

impl Default for BaseUnit {
    fn default() -> Self {
        Self { kg: 0, m: 0, s: 0, a: 0, k: 0, mol: 0, cd: 0, rad: 0, factor: 1.0, offset: 0.0 }
    }
}

impl BaseUnit {
    fn exponents_mut(&mut self) -> [(&'static str, &mut i32); 8] {
        let Self { kg, m, s, a, k, mol, cd, rad, .. } = self;
        [("kg", kg), ("m", m), ("s", s), ("A", a), ("K", k), ("mol", mol), ("cd", cd), ("rad", rad)]
    }

    /// The SI base units' symbols with their exponents.
    pub fn exponents(mut self) -> [(&'static str, i32); 8] {
        self.exponents_mut().map(|(symbol, exponent)| (symbol, *exponent))
    }

    /// Reads the exponents by their symbols.
    pub fn from_exponents<E>(
        mut exponent: impl FnMut(&'static str) -> Result<i32, E>,
        factor: f64,
        offset: f64,
    ) -> Result<Self, E> {
        let mut unit = Self { factor, offset, ..Self::default() };
        for (symbol, power) in unit.exponents_mut() {
            *power = exponent(symbol)?;
        }
        Ok(unit)
    }
}

element! {
    /// `DisplayUnit`: value_display = factor * value_unit + offset.
    pub struct DisplayUnit {
        name: String = required "name",
        factor: f64 = or(1.0) "factor",
        offset: f64 = or(0.0) "offset",
    }
}

element! {
    /// A `SimpleType` (2.2.3).
    #[derive(Default)]
    pub struct SimpleType {
        /// As used in `declaredType="…"`.
        name: String = required "name",
        /// Meaning of the type.
        description: Option<String> = optional "description",
        ;
        /// Kind and attributes.
        kind: SimpleTypeKind,
    }
}

elements! {
    /// Kind of a `SimpleType`, with its attributes.
    #[derive(Default)]
    pub enum SimpleTypeKind {
        /// Real with its attributes.
        Real {
            attributes: RealAttributes = nested,
        }
        /// Integer with limits and quantity.
        Integer {
            quantity: Option<String> = optional "quantity",
            min: Option<i32> = optional "min",
            max: Option<i32> = optional "max",
        }
        /// Boolean.
        #[default]
        Boolean
        /// String.
        String
        /// Enumeration with its items.
        Enumeration {
            quantity: Option<String> = optional "quantity",
            items: Vec<EnumerationItem> = child,
        }
    }
}

element! {
    /// `Item` of an enumeration.
    #[derive(Eq)]
    pub struct EnumerationItem {
        name: String = required "name",
        value: i32 = required "value",
        description: Option<String> = optional "description",
    }
}

impl EnumerationItem {
    /// Whether a word is its name or its value.
    pub fn is_called(&self, word: &str) -> bool {
        word == self.name || word.parse() == Ok(self.value)
    }

    /// Whether it is one of those that words name.
    pub fn is_among(&self, words: &[String]) -> bool {
        words.iter().any(|word| self.is_called(word))
    }
}

element! {
    /// `Category` of `LogCategories`.
    #[derive(Eq)]
    pub struct LogCategory {
        name: String = required "name",
        description: Option<String> = optional "description",
    }
}

element! {
    /// `DefaultExperiment`; times in seconds.
    #[derive(Copy, Default)]
    pub struct DefaultExperiment {
        start_time: Option<f64> = optional "startTime",
        stop_time: Option<f64> = optional "stopTime",
        tolerance: Option<f64> = optional "tolerance",
        step_size: Option<f64> = optional "stepSize",
    }
}

element! {
    /// One `ScalarVariable`.
    #[derive(Default)]
    pub struct ScalarVariable {
        /// Unique name.
        name: String = required "name",
        /// Dense per base type in ours.
        value_reference: u32 = required "valueReference",
        /// Meaning of the variable, with frame and convention.
        description: Option<String> = optional "description",
        causality: Causality = or(Causality::Local) "causality",
        variability: Variability = or(Variability::Continuous) "variability",
        /// As written; `None` means the table's default (see `rules`).
        initial: Option<Initial> = optional "initial",
        can_handle_multiple_set_per_time_instant: Option<bool> = optional "canHandleMultipleSetPerTimeInstant",
        ;
        /// Base type and its attributes.
        kind: VariableKind,
        /// `Annotations` of [`Description::annotation_tool`].
        annotation: Option<Box<Annotation>>,
    }
}

impl ScalarVariable {
    /// The annotated role.
    pub fn role(&self) -> Option<VariableRole> {
        self.annotation.as_ref().and_then(|it| it.role)
    }
}

elements! {
    /// Base type of a variable with its attributes.
    pub enum VariableKind {
        Real {
            declared_type: Option<String> = optional "declaredType",
            /// Unit, limits and the rest.
            attributes: RealAttributes = nested,
            start: Option<f64> = optional "start",
            /// 1-based index of the variable this one differentiates.
            derivative: Option<u32> = optional "derivative",
            /// Model exchange only.
            reinit: Option<bool> = optional "reinit",
        }
        Integer {
            declared_type: Option<String> = optional "declaredType",
            quantity: Option<String> = optional "quantity",
            min: Option<i32> = optional "min",
            max: Option<i32> = optional "max",
            start: Option<i32> = optional "start",
        }
        Boolean {
            declared_type: Option<String> = optional "declaredType",
            start: Option<bool> = optional "start",
        }
        String {
            declared_type: Option<String> = optional "declaredType",
            start: Option<String> = optional "start",
        }
        /// Its values are Integers at the interface.
        Enumeration {
            declared_type: String = required "declaredType",
            quantity: Option<String> = optional "quantity",
            min: Option<i32> = optional "min",
            max: Option<i32> = optional "max",
            start: Option<i32> = optional "start",
        }
    }
}

impl Default for VariableKind {
    /// `<Boolean/>`.
    fn default() -> Self {
        Self::Boolean { start: None, declared_type: None }
    }
}

element! {
    /// Attributes shared by Real variables and Real types (2.2.3).
    #[derive(Default)]
    pub struct RealAttributes {
        quantity: Option<String> = optional "quantity",
        unit: Option<String> = optional "unit",
        display_unit: Option<String> = optional "displayUnit",
        relative_quantity: bool = or(false) "relativeQuantity",
        min: Option<f64> = optional "min",
        max: Option<f64> = optional "max",
        nominal: Option<f64> = optional "nominal",
        unbounded: bool = or(false) "unbounded",
    }
}

/// `ModelStructure` (2.2.8).
#[derive(Clone, Debug, PartialEq, Default)]
#[allow(missing_docs, reason = "the fields are the standard's own element names")]
pub struct ModelStructure {
    pub outputs: Vec<Unknown>,
    pub derivatives: Vec<Unknown>,
    pub initial_unknowns: Vec<Unknown>,
}

element! {
    /// `Unknown` of the model structure.
    #[derive(Eq, Default)]
    pub struct Unknown {
        /// 1-based index into the variables.
        index: u32 = required "index",
        /// Indices of the knowns that it depends on; `None` (absent) means all of them, an empty list none.
        dependencies: Option<Vec<u32>> = optional "dependencies",
        /// As long as `dependencies` when present.
        dependencies_kind: Option<Vec<DependencyKind>> = optional "dependenciesKind",
    }
}
