//! The builder behind `#[derive(Variables)]`: turns declarations into XML variables, start values and access rules.

use core::marker::PhantomData;
use std::collections::BTreeSet;

use model_description::{
    BaseType, Causality, Initial, RealAttributes, ScalarVariable, SimpleType, SimpleTypeKind, Variability,
    VariableKind, rules, units,
};

use super::check;
use super::handle::{Boolean, Choice, Enumeration, Integer, Real, RealMatrix, RealVector, Text};
use super::values::Values;
use crate::fmi2::references;

/// Why a declaration is wrong; names the variable.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("variable `{name}`: {problem}")]
pub struct DeclareError {
    /// Full structured name.
    pub name: String,
    /// What is wrong and what is allowed.
    pub problem: String,
}

/// Causality, variability and initial of a declaration.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Role {
    /// Causality.
    pub causality: Causality,
    /// Variability.
    pub variability: Variability,
    /// `initial` where it differs from the standard's default.
    pub initial: Option<Initial>,
}

/// What is declared of a Real scalar, vector or matrix.
#[derive(Clone, Copy, Debug)]
pub struct RealSpec<'a> {
    /// Last name segment.
    pub name: &'a str,
    /// Description.
    pub description: &'a str,
    /// Role.
    pub role: Role,
    /// Unit from the unit table.
    pub unit: &'a str,
    /// Display unit of that unit.
    pub display_unit: Option<&'a str>,
    /// `min`.
    pub min: Option<f64>,
    /// `max`.
    pub max: Option<f64>,
    /// `nominal`.
    pub nominal: Option<f64>,
}

/// What is declared of an Integer, Boolean, String or Enumeration.
#[derive(Clone, Copy, Debug)]
pub struct ScalarSpec<'a> {
    /// Last name segment.
    pub name: &'a str,
    /// Description.
    pub description: &'a str,
    /// Role.
    pub role: Role,
}

/// Everything declared: the XML variables in order, start values, types and units used.
#[derive(Clone, Debug, Default)]
pub struct Table {
    /// XML variables in declaration order.
    pub variables: Vec<ScalarVariable>,
    /// Enumeration types used, in order of first use.
    pub types: Vec<SimpleType>,
    /// Start values (0, false, "" where none is declared).
    pub start: Values,
}

/// Collects declarations; see [`super::Variables`].
#[derive(Debug, Default)]
pub struct Declare {
    prefix: String,
    names: BTreeSet<String>,
    table: Table,
}

impl Declare {
    /// An empty builder.
    pub fn new() -> Self {
        Self::default()
    }

    /// What was declared.
    pub fn finish(self) -> Table {
        self.table
    }

    /// Declares a nested group under `prefix.name.`; an empty name adds no prefix.
    pub fn group<T>(
        &mut self,
        name: &str,
        declare: impl FnOnce(&mut Self) -> Result<T, DeclareError>,
    ) -> Result<T, DeclareError> {
        let outer = self.prefix.len();
        if !name.is_empty() {
            self.prefix.push_str(name);
            self.prefix.push('.');
        }
        let result = declare(self);
        self.prefix.truncate(outer);
        result
    }

    /// Declares `count` groups `prefix.name[1].` to `prefix.name[count].`
    pub fn groups<T>(
        &mut self,
        name: &str,
        count: usize,
        mut declare: impl FnMut(&mut Self, usize) -> Result<T, DeclareError>,
    ) -> Result<Vec<T>, DeclareError> {
        (0..count)
            .map(|index| self.group(&format!("{name}[{}]", index + 1), |scope| declare(scope, index)))
            .collect()
    }

    /// Declares a Real; `start` must be given where the role demands one.
    pub fn real(&mut self, spec: &RealSpec<'_>, start: Option<f64>) -> Result<Real, DeclareError> {
        self.push_real(spec, spec.name, start)
    }

    /// Declares `x[1]`..`x[N]`.
    pub fn real_vector<const N: usize>(
        &mut self,
        spec: &RealSpec<'_>,
        start: Option<[f64; N]>,
    ) -> Result<RealVector<N>, DeclareError> {
        let first = self.table.start.reals.len() as u32;
        for i in 0..N {
            let name = format!("{}[{}]", spec.name, i + 1);
            self.push_real(spec, &name, start.map(|values| values[i]))?;
        }
        Ok(RealVector(first))
    }

    /// Declares `x[1,1]`..`x[R,C]`, row by row.
    pub fn real_matrix<const R: usize, const C: usize>(
        &mut self,
        spec: &RealSpec<'_>,
        start: Option<[[f64; C]; R]>,
    ) -> Result<RealMatrix<R, C>, DeclareError> {
        let first = self.table.start.reals.len() as u32;
        for r in 0..R {
            for c in 0..C {
                let name = format!("{}[{},{}]", spec.name, r + 1, c + 1);
                self.push_real(spec, &name, start.map(|values| values[r][c]))?;
            }
        }
        Ok(RealMatrix(first))
    }

    /// Declares an Integer.
    pub fn integer(
        &mut self,
        spec: &ScalarSpec<'_>,
        start: Option<i32>,
        min: Option<i32>,
        max: Option<i32>,
    ) -> Result<Integer, DeclareError> {
        self.checked(spec.name, check::range(start, min, max))?;
        let index = self.table.start.integers.len() as u32;
        let kind = VariableKind::Integer { start, declared_type: None, quantity: None, min, max };
        self.push(spec.name, spec.description, spec.role, index, kind)?;
        self.table.start.integers.push(start.unwrap_or(0));
        Ok(Integer(index))
    }

    /// Declares a Boolean.
    pub fn boolean(&mut self, spec: &ScalarSpec<'_>, start: Option<bool>) -> Result<Boolean, DeclareError> {
        let index = self.table.start.booleans.len() as u32;
        let kind = VariableKind::Boolean { start, declared_type: None };
        self.push(spec.name, spec.description, spec.role, index, kind)?;
        self.table.start.booleans.push(start.unwrap_or(false));
        Ok(Boolean(index))
    }

    /// Declares a String.
    pub fn text(&mut self, spec: &ScalarSpec<'_>, start: Option<&str>) -> Result<Text, DeclareError> {
        let index = self.table.start.strings.len() as u32;
        self.checked(spec.name, check::text("start", start.unwrap_or_default()))?;
        let kind = VariableKind::String { start: start.map(str::to_owned), declared_type: None };
        self.push(spec.name, spec.description, spec.role, index, kind)?;
        self.table.start.strings.push(start.unwrap_or_default().to_owned());
        Ok(Text(index))
    }

    /// Declares an Enumeration; its values live in the Integer table.
    pub fn choice<E: Enumeration>(
        &mut self,
        spec: &ScalarSpec<'_>,
        start: Option<E>,
    ) -> Result<Choice<E>, DeclareError> {
        let first = self.enumeration_type::<E>(spec.name)?;
        if spec.role.causality == Causality::Input {
            self.checked(spec.name, check::has_none(&E::items()))?;
        }
        let index = self.table.start.integers.len() as u32;
        let kind = VariableKind::Enumeration {
            start: start.map(E::value),
            declared_type: E::TYPE_NAME.to_owned(),
            quantity: None,
            min: None,
            max: None,
        };
        self.push(spec.name, spec.description, spec.role, index, kind)?;
        self.table.start.integers.push(start.map_or(first, E::value));
        Ok(Choice(index, PhantomData))
    }

    /// Adds the type definition of `E` where it is new; the value of its first item.
    fn enumeration_type<E: Enumeration>(&mut self, name: &str) -> Result<i32, DeclareError> {
        let items = E::items();
        self.checked(name, check::items(&items))?;
        let first = items.first().map_or(1, |item| item.value);
        let declared = SimpleType {
            name: E::TYPE_NAME.to_owned(),
            description: Some(E::DESCRIPTION.to_owned()),
            kind: SimpleTypeKind::Enumeration { quantity: None, items },
        };
        match self.table.types.iter().find(|known| known.name == E::TYPE_NAME) {
            Some(known) if *known == declared => {}
            Some(_) => {
                let problem = format!("two different enumerations are named `{}`", E::TYPE_NAME);
                return Err(self.error(name, problem));
            }
            None if self.names.contains(E::TYPE_NAME) => {
                let problem = format!("its enumeration is named `{}` as a variable is", E::TYPE_NAME);
                return Err(self.error(name, problem));
            }
            None => self.table.types.push(declared),
        }
        Ok(first)
    }

    fn push_real(
        &mut self,
        spec: &RealSpec<'_>,
        name: &str,
        start: Option<f64>,
    ) -> Result<Real, DeclareError> {
        let RealSpec { unit, display_unit, min, max, nominal, .. } = *spec;
        let known = units::find(unit)
            .ok_or_else(|| self.error(name, format!("unit `{unit}` is not in the unit table")))?;
        if let Some(display) = display_unit
            && !known.has_display(display)
        {
            return Err(self.error(name, format!("`{display}` is no display unit of `{unit}`")));
        }
        let given = [("start", start), ("min", min), ("max", max), ("nominal", nominal)];
        for (what, value) in given {
            self.checked(name, check::finite(what, value))?;
        }
        self.checked(name, check::range(start, min, max))?;
        if let Some(nominal) = nominal
            && nominal <= 0.0
        {
            return Err(self.error(name, format!("nominal is {nominal}; it must be above 0")));
        }
        let index = self.table.start.reals.len() as u32;
        let attributes = RealAttributes {
            unit: Some(unit.to_owned()),
            display_unit: display_unit.map(str::to_owned),
            min,
            max,
            nominal,
            ..RealAttributes::default()
        };
        let kind =
            VariableKind::Real { start, declared_type: None, attributes, derivative: None, reinit: None };
        self.push(name, spec.description, spec.role, index, kind)?;
        self.table.start.reals.push(start.unwrap_or(0.0));
        Ok(Real(index))
    }

    fn push(
        &mut self,
        name: &str,
        description: &str,
        role: Role,
        index: u32,
        kind: VariableKind,
    ) -> Result<(), DeclareError> {
        let full = format!("{}{name}", self.prefix);
        let mut variable = ScalarVariable {
            name: full.clone(),
            value_reference: index,
            description: Some(description.to_owned()),
            causality: role.causality,
            variability: role.variability,
            initial: role.initial,
            can_handle_multiple_set_per_time_instant: None,
            kind,
        };
        let base = variable.kind.base_type();
        if index >= references::MOST {
            let problem =
                format!("is one {} too many; at most {} are allowed", base.name(), references::MOST);
            return Err(self.error(name, problem));
        }
        variable.value_reference = references::first(base) + index;
        let is_real = base == BaseType::Real;
        self.checked(name, check::name(&full))?;
        self.checked(name, check::role(role, is_real, rules::has_start(&variable)))?;
        self.checked(name, check::text("description", description))?;
        if description.trim().is_empty() {
            return Err(self.error(name, "needs a description".to_owned()));
        }
        if self.table.types.iter().any(|known| known.name == full) {
            return Err(self.error(name, "an enumeration type has this name".to_owned()));
        }
        if !self.names.insert(full) {
            return Err(self.error(name, "is declared twice".to_owned()));
        }
        self.table.variables.push(variable);
        Ok(())
    }

    fn checked(&self, name: &str, result: check::Checked) -> Result<(), DeclareError> {
        result.map_err(|problem| self.error(name, problem))
    }

    fn error(&self, name: &str, problem: String) -> DeclareError {
        DeclareError { name: format!("{}{name}", self.prefix), problem }
    }
}
