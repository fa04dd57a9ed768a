//! Declaration of a variable. An array is one variable; its elements are counted row by row.

use core::fmt::Write;

use model_description::{Annotation, BaseType, Causality, Initial, Variability};
use serde::{Serialize, Serializer};

/// Causality, variability and initial of a declaration (FMI 2.0.5, 2.2.7; FMI 3.0, 2.4.7.4).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Role {
    /// Causality.
    pub causality: Causality,
    /// Variability.
    pub variability: Variability,
    /// `initial` where it differs from the standard's default.
    pub initial: Option<Initial>,
}

/// By the standard's words.
impl Serialize for Role {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let Self { causality, variability, initial } = self;
        (causality.as_str(), variability.as_str(), initial.map(Initial::as_str)).serialize(serializer)
    }
}

/// A declared variable; its start values stand in [`Interface::start`](super::Interface::start).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Variable {
    /// Full structured name, of an array without indices.
    pub name: String,
    /// Meaning of the variable, with frame and convention.
    pub description: String,
    /// Causality, variability and `initial`.
    pub role: Role,
    /// Number of elements along each axis; none of a scalar.
    pub dimensions: Vec<usize>,
    /// The first element; the others follow it.
    pub first: Element,
    /// Type with its attributes.
    pub kind: DeclaredType,
    /// Relations to other variables and role, for tools; an element's own indices stand for `[i]` in its names.
    ///
    /// Not serialised: it does not enter the GUID, for a simulation does not depend on it.
    #[serde(skip)]
    pub annotation: Option<Annotation>,
}

/// Type of a variable.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub enum DeclaredType {
    /// A floating-point number.
    Real {
        /// Unit from the unit table.
        unit: String,
        /// Display unit of that unit.
        display_unit: Option<String>,
        /// Smallest value.
        min: Option<f64>,
        /// Largest value.
        max: Option<f64>,
        /// Typical magnitude.
        nominal: Option<f64>,
    },
    /// A whole number.
    Integer {
        /// Smallest value.
        min: Option<i32>,
        /// Largest value.
        max: Option<i32>,
    },
    /// A truth value.
    Boolean,
    /// A text.
    Text,
    /// An item of the enumeration of this name.
    Enumeration(&'static str),
}

impl DeclaredType {
    /// Type of the table of values.
    pub(super) const fn base_type(&self) -> BaseType {
        match self {
            Self::Real { .. } => BaseType::Real,
            Self::Integer { .. } | Self::Enumeration(_) => BaseType::Integer,
            Self::Boolean => BaseType::Boolean,
            Self::Text => BaseType::String,
        }
    }
}

/// One scalar, by its place in the table of values of its type; Enumerations share the Integers' table.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Element {
    /// The type.
    pub base: BaseType,
    /// Its place.
    pub place: u32,
}

impl Element {
    /// Number of tables of values.
    pub(crate) const TABLES: usize = BaseType::ALL.len();

    /// The table, by the order of the base types.
    pub(crate) const fn table(self) -> usize {
        self.base as usize
    }
}

/// By the number of the table.
impl Serialize for Element {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.base as u32, self.place).serialize(serializer)
    }
}

impl Variable {
    /// Number of elements.
    pub fn count(&self) -> usize {
        self.dimensions.iter().product()
    }

    /// The elements with their names: `x`, `x[2]`, `x[1,3]`.
    pub fn elements(&self) -> impl Iterator<Item = (String, Element)> + '_ {
        (0..self.count()).map(|at| {
            let place = self.first.place + at as u32;
            (self.element_name(at), Element { place, ..self.first })
        })
    }

    /// Returns the annotation of the element of this name.
    pub(crate) fn annotation_of(&self, element: &str) -> Option<Box<Annotation>> {
        let mut annotation = Box::new(self.annotation.clone()?);
        if !self.dimensions.is_empty() {
            let indices = element.strip_prefix(self.name.as_str()).unwrap_or_default();
            replace_in_names(&mut annotation, "[i]", indices);
        }
        Some(annotation)
    }

    /// Returns the name of an element, counted row by row.
    pub(super) fn element_name(&self, at: usize) -> String {
        let mut name = String::with_capacity(self.name.len() + 4 * self.dimensions.len());
        name.push_str(&self.name);
        let mut count = self.count();
        for (position, length) in self.dimensions.iter().enumerate() {
            count /= length;
            // Writing to a String cannot fail.
            let _ = write!(name, "{}{}", if position == 0 { '[' } else { ',' }, at / count % length + 1);
        }
        if !self.dimensions.is_empty() {
            name.push(']');
        }
        name
    }
}

/// Replaces a part of all names that an annotation holds.
pub(super) fn replace_in_names(annotation: &mut Annotation, from: &str, to: &str) {
    if let Some(output) = &mut annotation.also_called {
        *output = output.replace(from, to);
    }
    annotation.own_names_mut().for_each(|name| *name = name.replace(from, to));
}

/// Enumeration type, by default of a Rust enum.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct EnumerationType<T = &'static [Item]> {
    /// Name of the type.
    pub name: &'static str,
    /// Subject of the choice.
    pub description: &'static str,
    /// The items in the order of declaration.
    pub items: T,
}

/// An item of an enumeration.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Item<T = &'static str> {
    /// Name.
    pub name: T,
    /// Value.
    pub value: i32,
    /// Meaning of the item.
    pub description: T,
}

/// An enumeration type as an interface has it: the items of its Rust type, behind them those of the setup.
pub type DeclaredEnumeration = EnumerationType<Vec<DeclaredItem>>;

/// An item of a declared enumeration.
pub type DeclaredItem = Item<String>;

impl From<EnumerationType> for DeclaredEnumeration {
    fn from(own: EnumerationType) -> Self {
        Self {
            name: own.name,
            description: own.description,
            items: own.items.iter().map(DeclaredItem::from).collect(),
        }
    }
}

impl From<&Item> for DeclaredItem {
    fn from(item: &Item) -> Self {
        Self { name: item.name.to_owned(), value: item.value, description: item.description.to_owned() }
    }
}
