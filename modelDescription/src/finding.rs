//! Findings of the reader and the validator: codes, severities, lines.

use core::fmt;

use crate::words::words;

words! {
    /// How bad a finding is.
    pub enum Severity, as_str {
        /// Legal or harmless, but probably not meant.
        Warning => "warning",
        /// Against the standard or its XML schema.
        Error => "error",
    }
}

macro_rules! codes {
    ($($variant:ident $word:literal $severity:ident $rule:literal)+) => {
        words! {
            /// Code of a fault; its word never changes its meaning.
            pub enum Code, as_str {
                $(#[doc = $rule] $variant => $word,)+
            }
        }

        impl Code {
            /// How bad it is.
            pub const fn severity(self) -> Severity {
                match self {
                    $(Self::$variant => Severity::$severity),+
                }
            }

            /// The rule that is broken, in one sentence.
            pub const fn rule(self) -> &'static str {
                match self {
                    $(Self::$variant => $rule),+
                }
            }
        }
    };
}

codes! {
    Encoding "encoding" Error "The file is encoded in UTF-8."
    Malformed "malformed" Error "The file is well-formed XML 1.0."
    TooLarge "too-large" Error "Size, depth and attribute count stay within what any real model needs."
    Root "root" Error "The root element is fmiModelDescription."
    Version "version" Error "fmiVersion is 2.0."
    MissingElement "missing-element" Error "Elements that the schema requires are present."
    DuplicateElement "duplicate-element" Error "Elements that the schema allows once stand once."
    MissingAttribute "missing-attribute" Error "Attributes that the schema requires are present."
    BadValue "bad-value" Error "Attribute values have the type that the schema gives."
    ElementOrder "element-order" Error "Elements stand in the order of the schema."
    EmptyList "empty-list" Error "Lists have at least one entry, or are left out."
    UnknownElement "unknown-element" Error "Elements are those of the schema."
    UnknownAttribute "unknown-attribute" Error "Attributes are those of the schema."
    UnexpectedText "unexpected-text" Error "Elements hold no text."
    DuplicateTool "duplicate-tool" Error "Tool names are unique within a list of annotations (2.2.6)."

    NoInterface "no-interface" Error "At least one of CoSimulation and ModelExchange is present (2.2.1)."
    EmptyText "empty-text" Warning "modelName and guid say something (2.2.1)."
    IllegalCharacter "illegal-character" Error "Texts hold only characters that XML 1.0 can carry."
    DateTime "date-time" Error "generationDateAndTime is an xs:dateTime (2.2.1)."
    ModelIdentifier "model-identifier" Error "modelIdentifier is a C identifier (3.3.1, 4.3.1)."
    SerializeWithoutState "serialize-without-state" Error "canSerializeFMUstate needs canGetAndSetFMUstate (4.3.1)."
    DuplicateSourceFile "duplicate-source-file" Error "A source file is listed once (4.3.1)."

    DuplicateUnit "duplicate-unit" Error "Unit names are unique (2.2.2)."
    DuplicateDisplayUnit "duplicate-display-unit" Error "Display unit names are unique within their unit (2.2.2)."
    UnitConversion "unit-conversion" Error "Factors are finite and not 0, offsets finite (2.2.2)."
    UndefinedUnit "undefined-unit" Error "Units are defined in UnitDefinitions (2.2.2)."
    UndefinedDisplayUnit "undefined-display-unit" Error "Display units are defined for the unit (2.2.2)."
    DisplayUnitWithoutUnit "display-unit-without-unit" Error "A display unit needs a unit (2.2.3)."

    DuplicateType "duplicate-type" Error "Type names are unique (2.2.3)."
    TypeNameIsVariable "type-name-is-variable" Error "Type names differ from all variable names (2.2.3)."
    EnumerationEmpty "enumeration-empty" Error "An enumeration has at least one item (2.2.3)."
    DuplicateItem "duplicate-item" Error "Item names and values are unique within their enumeration (2.2.3)."
    DuplicateCategory "duplicate-category" Error "Log category names are unique (2.2.4)."
    MinAboveMax "min-above-max" Error "max is at least min (2.2.3)."
    LimitNotANumber "limit-not-a-number" Error "min and max are numbers (2.2.3)."
    Nominal "nominal" Error "nominal is finite and above 0 (2.2.3)."

    StopBeforeStart "stop-before-start" Error "stopTime is not before startTime (2.2.5)."
    StepSize "step-size" Error "stepSize is finite and above 0 (2.2.5)."
    Tolerance "tolerance" Error "tolerance is finite and above 0 (2.2.5)."
    ExperimentTime "experiment-time" Error "startTime and stopTime are finite (2.2.5)."

    NoVariables "no-variables" Error "There is at least one variable (2.2.7)."
    DuplicateName "duplicate-name" Error "Variable names are unique (2.2.7)."
    IllegalName "illegal-name" Error "Names follow the declared naming convention (2.2.9)."
    CausalityVariability "causality-variability" Error "Causality and variability form an allowed pair (2.2.7)."
    ContinuousNotReal "continuous-not-real" Error "Only Real variables are continuous (2.2.7)."
    InitialForbidden "initial-forbidden" Error "Inputs and the independent variable have no initial (2.2.7)."
    InitialNotAllowed "initial-not-allowed" Error "initial is one that the table allows (2.2.7)."
    StartMissing "start-missing" Error "Inputs, and initial exact and approx, have a start (2.2.7)."
    StartForbidden "start-forbidden" Error "Calculated variables and the independent have no start (2.2.7)."
    StartOutOfRange "start-out-of-range" Error "start lies within min and max (2.2.7)."
    StartNotFinite "start-not-finite" Error "start is a number, infinite only where min or max is (2.2.7)."
    StartNotAnItem "start-not-an-item" Error "An enumeration starts with one of its items (2.2.7)."
    DeclaredTypeUndefined "declared-type-undefined" Error "Declared types are defined in TypeDefinitions (2.2.7)."
    DeclaredTypeKind "declared-type-kind" Error "The declared type has the variable's base type (2.2.7)."
    LimitsBeyondType "limits-beyond-type" Warning "Limits of a variable lie within those of its type (2.2.7)."
    SeveralIndependent "several-independent" Error "At most one variable is independent (2.2.7)."
    DerivativeIndex "derivative-index" Error "derivative names another variable by its index (2.2.7)."
    DerivativeKind "derivative-kind" Error "What is differentiated is a continuous Real (2.2.7)."
    Reinit "reinit" Error "reinit stands only on continuous states of a model-exchange FMU (2.2.7)."
    MultipleSet "multiple-set" Error "canHandleMultipleSetPerTimeInstant stands only on inputs of a model-exchange FMU (2.2.7)."
    Annotation "annotation" Warning "Annotations of io.github.heliotorque have its attributes and name variables and items of the FMU."
    AliasStart "alias-start" Error "At most one variable of an alias set has a start (2.2.7)."
    AliasSettable "alias-settable" Error "At most one variable of an alias set can be set (2.2.7)."
    AliasConstant "alias-constant" Error "An alias set is constant as a whole or not at all, with one value (2.2.7)."
    AliasUnit "alias-unit" Warning "Variables of an alias set have one unit (2.2.7)."

    StructureIndex "structure-index" Error "Entries of the model structure name a variable (2.2.8)."
    StructureDuplicate "structure-duplicate" Error "A list of the model structure names a variable once (2.2.8)."
    OutputMissing "output-missing" Error "Outputs lists every output (2.2.8)."
    OutputExtra "output-extra" Error "Outputs lists outputs only (2.2.8)."
    DerivativeEntry "derivative-entry" Error "Derivatives lists variables with the attribute derivative (2.2.8)."
    DerivativeUnlisted "derivative-unlisted" Warning "Derivatives of a model-exchange FMU lists every state derivative (2.2.8)."
    InitialUnknownMissing "initial-unknown-missing" Error "InitialUnknowns lists every unknown of initialization (2.2.8)."
    InitialUnknownExtra "initial-unknown-extra" Error "InitialUnknowns lists unknowns of initialization only (2.2.8)."
    InitialUnknownOrder "initial-unknown-order" Error "InitialUnknowns is ordered by index (2.2.8)."
    DependencyIndex "dependency-index" Error "dependencies name variables (2.2.8)."
    DependencyOrder "dependency-order" Error "dependencies ascend without duplicates (2.2.8)."
    DependencyKnown "dependency-known" Warning "dependencies name what the unknown may depend on (2.2.8)."
    DependencyKindCount "dependency-kind-count" Error "dependenciesKind is as long as dependencies (2.2.8)."
    DependencyKindAlone "dependency-kind-alone" Error "dependenciesKind needs dependencies (2.2.8)."
    DependencyKindInitial "dependency-kind-initial" Error "Kinds of InitialUnknowns are dependent or constant (2.2.8)."
    DependencyKindReal "dependency-kind-real" Warning "Kinds other than dependent are for Real unknowns (2.2.8)."
}

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// The broken rule.
    pub code: Code,
    /// The variable or element, for example ``variable `x` ``.
    pub subject: String,
    /// Line in the XML, 1-based, where the description was read from one.
    pub line: Option<u32>,
    /// The text, with what was found and what is allowed.
    pub message: String,
}

impl Finding {
    /// How bad it is.
    pub fn severity(&self) -> Severity {
        self.code.severity()
    }
}

impl fmt::Display for Finding {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(line) = self.line {
            write!(formatter, "line {line}: ")?;
        }
        let Self { code, subject, message, .. } = self;
        write!(formatter, "{} [{code}] {subject}: {message}", self.severity())
    }
}

/// Lines of the elements of a description in its XML: 1-based, 0 where there is no element.
///
/// The lists are as long as the lists of the [`crate::Description`].
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[allow(missing_docs, reason = "the fields are the standard's own element names")]
pub struct Lines {
    pub root: u32,
    pub model_exchange: u32,
    pub co_simulation: u32,
    pub units: Vec<u32>,
    pub types: Vec<u32>,
    pub log_categories: Vec<u32>,
    pub default_experiment: u32,
    pub model_variables: u32,
    pub variables: Vec<u32>,
    pub outputs: Vec<u32>,
    pub derivatives: Vec<u32>,
    pub initial_unknowns: Vec<u32>,
}
