//! The content of a `SystemStructure.ssd` and of parameter sets as plain values (SSP 1.0, sections 5 and 6).

use model_description::{DefaultExperiment, EnumerationItem, Unit};

/// The description of a system, where it begins in an SSP.
pub const SSD_FILE: &str = "SystemStructure.ssd";

/// A system of components.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Structure {
    /// The system's name.
    pub name: String,
    /// The system's own connectors.
    pub connectors: Vec<Connector>,
    /// Its components, in the order in which a master calls them.
    pub components: Vec<Component>,
    /// Connections between connectors.
    pub connections: Vec<Connection>,
    /// Parameters of all components, named `component.parameter`.
    pub bindings: Vec<Binding>,
    /// Enumerations that connectors name.
    pub enumerations: Vec<Enumeration>,
    /// Units that connectors name.
    pub units: Vec<Unit>,
    /// When to start, stop and step; SSP has no place for the step but an annotation.
    pub experiment: DefaultExperiment,
}

/// A component: one FMU.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Component {
    /// Its name in the system.
    pub name: String,
    /// Path of its FMU in the archive.
    pub source: String,
    /// Connectors that it has in the system.
    pub connectors: Vec<Connector>,
    /// Its parameters.
    pub bindings: Vec<Binding>,
    /// Line in the file.
    pub line: u32,
}

/// A connector: of a component a variable of its FMU, of the system what its connections join to that.
#[derive(Clone, Debug, PartialEq)]
pub struct Connector {
    /// The variable's name.
    pub name: String,
    /// Its role.
    pub kind: ConnectorKind,
    /// Its type, where it is reported.
    pub signal: Option<Signal>,
    /// Line in the file.
    pub line: u32,
}

/// The role of a connector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[allow(missing_docs, reason = "the standard's own words")]
pub enum ConnectorKind {
    Input,
    Output,
    Parameter,
    CalculatedParameter,
    Inout,
}

impl ConnectorKind {
    /// All with the standard's words.
    pub const WORDS: [(Self, &'static str); 5] = [
        (Self::Input, "input"),
        (Self::Output, "output"),
        (Self::Parameter, "parameter"),
        (Self::CalculatedParameter, "calculatedParameter"),
        (Self::Inout, "inout"),
    ];

    /// The standard's word.
    pub fn word(self) -> &'static str {
        Self::WORDS.iter().find(|(kind, _)| *kind == self).map_or("", |(_, word)| word)
    }
}

/// The type of a connector.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Signal {
    /// A Real in a unit.
    Real {
        /// The unit; otherwise the variable's.
        unit: Option<String>,
    },
    /// An Integer.
    Integer,
    /// A Boolean.
    Boolean,
    /// A String.
    Text,
    /// An Enumeration of the system.
    Enumeration {
        /// Name of the enumeration.
        name: String,
    },
    /// Binary data.
    Binary,
}

impl Signal {
    /// The standard's word.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Real { .. } => "Real",
            Self::Integer => "Integer",
            Self::Boolean => "Boolean",
            Self::Text => "String",
            Self::Enumeration { .. } => "Enumeration",
            Self::Binary => "Binary",
        }
    }
}

/// An Enumeration of the system.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Enumeration {
    /// Its name.
    pub name: String,
    /// Its items.
    pub items: Vec<EnumerationItem>,
}

/// A connection from an output to an input; the system's own inputs and outputs are seen from within.
#[derive(Clone, Debug, PartialEq)]
pub struct Connection {
    /// End that the value comes from.
    pub start: End,
    /// End that it goes to.
    pub end: End,
    /// Transformation of the value on the way.
    pub transformation: Option<Linear>,
    /// Whether units are not converted.
    pub suppress_unit_conversion: bool,
    /// Line in the file.
    pub line: u32,
}

/// One end of a connection.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct End {
    /// The component; `None` is the system itself.
    pub component: Option<String>,
    /// The connector.
    pub connector: String,
}

impl std::fmt::Display for End {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.component {
            Some(component) => write!(f, "{component}.{}", self.connector),
            None => f.write_str(&self.connector),
        }
    }
}

/// y = factor x + offset.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs, reason = "the standard's own words")]
pub struct Linear {
    pub factor: f64,
    pub offset: f64,
}

/// Parameters of a system or of a component.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Binding {
    /// The file with the values, relative to the archive; otherwise they stand in `sets`.
    pub source: Option<String>,
    /// Goes before every name.
    pub prefix: String,
    /// The values.
    pub sets: Vec<ParameterSet>,
    /// How their names and values become those of the component or system; otherwise as they are.
    pub mapping: Option<Mapping>,
    /// Line in the file.
    pub line: u32,
}

/// A parameter mapping (SSP 1.0, section 5.5).
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Mapping {
    /// The file with the entries, relative to the archive; otherwise they stand in `entries`.
    pub source: Option<String>,
    /// The entries.
    pub entries: Vec<MappingEntry>,
}

/// An entry of a parameter mapping.
#[derive(Clone, Debug, PartialEq)]
pub struct MappingEntry {
    /// The parameter's name in its source, with the binding's prefix.
    pub source: String,
    /// The parameter's name in the component or system.
    pub target: String,
    /// Transformation of the value.
    pub transformation: Option<Transformation>,
    /// Whether units are not converted.
    pub suppress_unit_conversion: bool,
    /// Line in the file.
    pub line: u32,
}

/// Transformation of a value by a mapping entry.
#[derive(Clone, Debug, PartialEq)]
pub enum Transformation {
    /// Factor and offset of a Real, in the unit of the target.
    Linear(Linear),
    /// Pairs of Booleans: value in the source, value in the target.
    Boolean(Vec<(bool, bool)>),
    /// Pairs of Integers; the target may be an Enumeration's number.
    Integer(Vec<(i32, i32)>),
    /// Pairs of names of an Enumeration's items.
    Enumeration(Vec<(String, String)>),
}

/// A set of parameters with their values.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct ParameterSet {
    /// Its name.
    pub name: String,
    /// The parameters.
    pub parameters: Vec<Parameter>,
    /// Units that they name.
    pub units: Vec<Unit>,
}

/// A parameter.
#[derive(Clone, Debug, PartialEq)]
pub struct Parameter {
    /// Its name.
    pub name: String,
    /// Its value.
    pub value: Written,
    /// Line in the file.
    pub line: u32,
}

/// The value of a parameter as it is written.
#[derive(Clone, Debug, PartialEq)]
pub enum Written {
    /// A Real.
    Real {
        /// The number.
        value: f64,
        /// Its unit; otherwise the variable's.
        unit: Option<String>,
    },
    /// An Integer.
    Integer(i32),
    /// A Boolean.
    Boolean(bool),
    /// A String.
    Text(String),
    /// The name of an item.
    Enumeration(String),
}

impl Written {
    /// The standard's word for its type.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Real { .. } => "Real",
            Self::Integer(_) => "Integer",
            Self::Boolean(_) => "Boolean",
            Self::Text(_) => "String",
            Self::Enumeration(_) => "Enumeration",
        }
    }
}
