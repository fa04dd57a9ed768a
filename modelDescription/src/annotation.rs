//! Annotations of a variable (2.2.7) for tools that connect, simulate and draw it: relations to other variables, and roles.

use crate::element::element;
use crate::{InterpolationKind, VariableRole};

/// Name of the tool whose annotations the reader keeps.
pub const TOOL: &str = "io.github.heliotorque";

element! {
    /// `Variable` below `Tool`, in the annotations of a variable.
    #[derive(Eq, Default)]
    pub struct Annotation {
        /// Output of another FMU that suits this input, next to one of its own name.
        also_called: Option<String> = optional "alsoCalled",
        /// Variable that bounds the magnitude of this one.
        limited_by: Option<String> = optional "limitedBy",
        /// Role in a simulation.
        role: Option<VariableRole> = optional "role",
        /// Interpolation between rows of a table.
        interpolation: Option<InterpolationKind> = optional "interpolation",
        /// Derivative by time, of an attitude the vector of its body rate.
        rate: Option<String> = optional "rate",
        ;
        /// Options that this input depends on: it is read where each of them stands at one of its items.
        read_where: Vec<ReadWhere>,
    }
}

element! {
    /// Option by which an input is read.
    #[derive(Eq, Default)]
    pub struct ReadWhere {
        /// Enumeration of the same FMU.
        option: String = required "option",
        /// Names or numbers of the items at which the input is read.
        items: Vec<String> = required "items",
        /// Item to set where the input is connected and nobody chose one.
        set: Option<String> = optional "set",
    }
}

impl Annotation {
    /// The names of variables of the same FMU.
    pub fn own_names_mut(&mut self) -> impl Iterator<Item = &mut String> {
        let options = self.read_where.iter_mut().map(|it| &mut it.option);
        self.limited_by.iter_mut().chain(&mut self.rate).chain(options)
    }
}
