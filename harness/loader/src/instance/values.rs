//! Reading and writing variables, by reference, by name, by description.

use model_description::call_table::Function;
use model_description::{BaseType, ScalarVariable, VariableKind};

use super::Instance;
use crate::{Error, Value, parse_value};

impl Instance {
    /// `fmi2GetReal`.
    pub fn get_reals(&mut self, references: &[u32], values: &mut [f64]) -> Result<(), Error> {
        let function = Function::GetReal;
        self.allow_variables(function, references, BaseType::Real)?;
        let answer = self.component.get_real(references, values);
        self.finish(function, answer, |symbol| self.call_text(symbol, references, BaseType::Real))
    }

    /// `fmi2GetInteger`, Enumerations too.
    pub fn get_integers(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Error> {
        let function = Function::GetInteger;
        self.allow_variables(function, references, BaseType::Integer)?;
        let answer = self.component.get_integer(references, values);
        self.finish(function, answer, |symbol| self.call_text(symbol, references, BaseType::Integer))
    }

    /// `fmi2GetBoolean`; 0 is false, anything else true.
    pub fn get_booleans(&mut self, references: &[u32], values: &mut [i32]) -> Result<(), Error> {
        let function = Function::GetBoolean;
        self.allow_variables(function, references, BaseType::Boolean)?;
        let answer = self.component.get_boolean(references, values);
        self.finish(function, answer, |symbol| self.call_text(symbol, references, BaseType::Boolean))
    }

    /// `fmi2GetString`; the texts are copies.
    pub fn get_strings(&mut self, references: &[u32]) -> Result<Vec<String>, Error> {
        let function = Function::GetString;
        self.allow_variables(function, references, BaseType::String)?;
        let mut values = Vec::with_capacity(references.len());
        let answer = self.component.get_string(references, &mut values);
        self.finish(function, answer, |symbol| self.call_text(symbol, references, BaseType::String))?;
        Ok(values)
    }

    /// `fmi2SetReal`.
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), Error> {
        let function = Function::SetReal;
        self.allow_variables(function, references, BaseType::Real)?;
        let answer = self.component.set_real(references, values);
        self.finish(function, answer, |symbol| self.set_text(symbol, references, BaseType::Real, values))
    }

    /// `fmi2SetInteger`, Enumerations too.
    pub fn set_integers(&mut self, references: &[u32], values: &[i32]) -> Result<(), Error> {
        let function = Function::SetInteger;
        self.allow_variables(function, references, BaseType::Integer)?;
        let answer = self.component.set_integer(references, values);
        self.finish(function, answer, |symbol| self.set_text(symbol, references, BaseType::Integer, values))
    }

    /// `fmi2SetBoolean`; 0 is false, 1 true.
    pub fn set_booleans(&mut self, references: &[u32], values: &[i32]) -> Result<(), Error> {
        let function = Function::SetBoolean;
        self.allow_variables(function, references, BaseType::Boolean)?;
        let answer = self.component.set_boolean(references, values);
        self.finish(function, answer, |symbol| self.set_text(symbol, references, BaseType::Boolean, values))
    }

    /// `fmi2SetString`.
    pub fn set_strings(&mut self, references: &[u32], values: &[&str]) -> Result<(), Error> {
        let function = Function::SetString;
        self.allow_variables(function, references, BaseType::String)?;
        let answer = self.component.set_string(references, values);
        self.finish(function, answer, |symbol| self.set_text(symbol, references, BaseType::String, values))
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
