//! Reading and writing variables, by reference, by name, by description.

use model_description::call_table::Function;
use model_description::{BaseType, ScalarVariable, VariableKind};

use super::Instance;
use crate::{
    Error, Value,
    abi::{Answer, Component},
    parse_value,
};

impl Instance {
    /// `fmi2GetReal`.
    pub fn get_reals(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), Error> {
        self.get_by((Function::GetReal, BaseType::Real), references, |it| it.get_real(references, values))
    }

    /// `fmi2GetInteger`, Enumerations too.
    pub fn get_integers(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Error> {
        self.get_by((Function::GetInteger, BaseType::Integer), references, |it| {
            it.get_integer(references, values)
        })
    }

    /// `fmi2GetBoolean`; 0 is false, anything else true.
    pub fn get_booleans(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Error> {
        self.get_by((Function::GetBoolean, BaseType::Boolean), references, |it| {
            it.get_boolean(references, values)
        })
    }

    /// `fmi2GetString`; the texts are copies.
    pub fn get_strings(&mut self, references: &[u32]) -> Result<Vec<String>, Error> {
        let mut values = Vec::with_capacity(references.len());
        let answer = |it: &mut Component| it.get_string(references, &mut values);
        self.get_by((Function::GetString, BaseType::String), references, answer)?;
        Ok(values)
    }

    /// `fmi2SetReal`.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), Error> {
        self.set_by((Function::SetReal, BaseType::Real), references, values, Component::set_real)
    }

    /// `fmi2SetInteger`, Enumerations too.
    pub fn set_integers(&mut self, references: &[u32], values: &[i32]) -> Result<(), Error> {
        self.set_by((Function::SetInteger, BaseType::Integer), references, values, Component::set_integer)
    }

    /// `fmi2SetBoolean`; 0 is false, 1 true.
    pub fn set_booleans(&mut self, references: &[u32], values: &[i32]) -> Result<(), Error> {
        self.set_by((Function::SetBoolean, BaseType::Boolean), references, values, Component::set_boolean)
    }

    /// `fmi2SetString`.
    pub fn set_strings(&mut self, references: &[u32], values: &[&str]) -> Result<(), Error> {
        self.set_by((Function::SetString, BaseType::String), references, values, Component::set_string)
    }

    fn get_by(
        &mut self,
        function: (Function, BaseType),
        references: &[u32],
        answer: impl FnOnce(&mut Component) -> Answer,
    ) -> Result<(), Error> {
        self.access(function, references, answer, |it| it.named(references, function.1))
    }

    fn set_by<T: std::fmt::Debug>(
        &mut self,
        function: (Function, BaseType),
        references: &[u32],
        values: &[T],
        set: fn(&mut Component, &[u32], &[T]) -> Answer,
    ) -> Result<(), Error> {
        let answer = |it: &mut Component| set(it, references, values);
        self.access(function, references, answer, |it| it.assigned(references, function.1, values))
    }

    /// Reads one variable by name.
    pub fn get(&mut self, name: &str) -> Result<Value, Error> {
        let fmu = self.fmu.clone();
        self.get_variable(fmu.variable(name)?)
    }

    /// Reads one Real by name.
    pub fn get_real(&mut self, name: &str) -> Result<f64, Error> {
        match self.get(name)? {
            Value::Real(value) => Ok(value),
            other => Err(Error::Value { variable: name.to_owned(), what: format!("no Real: it is {other}") }),
        }
    }

    /// Reads one variable of the description.
    pub fn get_variable(&mut self, variable: &ScalarVariable) -> Result<Value, Error> {
        let reference = [variable.value_reference];
        Ok(match variable.kind {
            VariableKind::Real { .. } => {
                let mut value = [0.0];
                self.get_reals(&reference, &mut value)?;
                Value::Real(value[0])
            }
            VariableKind::Integer { .. } | VariableKind::Enumeration { .. } => {
                let mut value = [0];
                self.get_integers(&reference, &mut value)?;
                Value::Integer(value[0])
            }
            VariableKind::Boolean { .. } => {
                let mut value = [0];
                self.get_booleans(&reference, &mut value)?;
                Value::Boolean(value[0] != 0)
            }
            VariableKind::String { .. } => {
                Value::Text(self.get_strings(&reference)?.pop().unwrap_or_default())
            }
        })
    }

    /// Writes one variable by name; the value's type must be the variable's.
    pub fn set(&mut self, name: &str, value: &Value) -> Result<(), Error> {
        let fmu = self.fmu.clone();
        self.set_variable(fmu.variable(name)?, value)
    }

    /// Writes one Real by name.
    pub fn set_real(&mut self, name: &str, value: f64) -> Result<(), Error> {
        self.set(name, &Value::Real(value))
    }

    /// Writes one variable of the description; a text names an item of an Enumeration.
    pub fn set_variable(&mut self, variable: &ScalarVariable, value: &Value) -> Result<(), Error> {
        let reference = [variable.value_reference];
        match (&variable.kind, value) {
            (VariableKind::Real { .. }, Value::Real(value)) => self.set_reals(&reference, &[*value]),
            (VariableKind::Integer { .. } | VariableKind::Enumeration { .. }, Value::Integer(value)) => {
                self.set_integers(&reference, &[*value])
            }
            (VariableKind::Enumeration { .. }, Value::Text(item)) => {
                let number = parse_value(self.fmu.description(), variable, item)?;
                self.set_variable(variable, &number)
            }
            (VariableKind::Boolean { .. }, Value::Boolean(value)) => {
                self.set_booleans(&reference, &[i32::from(*value)])
            }
            (VariableKind::String { .. }, Value::Text(value)) => self.set_strings(&reference, &[value]),
            (kind, value) => Err(Error::Value {
                variable: variable.name.clone(),
                what: format!("it is a {}, and {value:?} is not", kind.name()),
            }),
        }
    }
}
