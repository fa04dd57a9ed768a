//! The builder behind `#[derive(Variables)]`: checks declarations and gives each variable its place in the tables of values.

use core::marker::PhantomData;
use std::collections::BTreeSet;

use model_description::{Annotation, Causality, labels::LABEL_END, units};

use super::check;
use super::handle::{Boolean, Choice, Enumeration, Integer, Real, RealMatrix, RealVector, Text};
use super::interface::Interface;
use super::variable::{
    DeclaredEnumeration, DeclaredItem, DeclaredType, Element, Role, Variable, replace_in_names,
};

/// Magnitude up to which every Real may be set that declares no limit itself, in its unit. Beyond, products of what was set are
/// soon no finite numbers, and saved states would hold what no simulation can go on with.
pub const GREATEST_SET: f64 = 1e100;

/// Why a declaration is wrong; names the variable.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("variable `{name}`: {problem}")]
pub struct DeclareError {
    /// Full structured name.
    pub name: String,
    /// The fault, and the declarations that are allowed.
    pub problem: String,
}

/// Declaration of a Real scalar, vector or matrix.
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

/// Declaration of an Integer, Boolean, String or Enumeration.
#[derive(Clone, Copy, Debug)]
pub struct ScalarSpec<'a> {
    /// Last name segment.
    pub name: &'a str,
    /// Description.
    pub description: &'a str,
    /// Role.
    pub role: Role,
}

/// Collects declarations; see [`super::Variables`].
#[derive(Debug, Default)]
pub struct Declare {
    prefix: String,
    /// Label of the group that is being declared, with the text between label and descriptions.
    label: String,
    /// Annotation of the next variable.
    annotation: Option<Annotation>,
    names: BTreeSet<String>,
    interface: Interface,
}

impl Declare {
    /// An empty builder.
    pub fn new() -> Self {
        Self::default()
    }

    /// Returns the interface of all declarations.
    pub fn finish(mut self) -> Interface {
        self.interface.start.mark_none();
        self.interface
    }

    /// Declares a nested group under `prefix.name.`; an empty name adds no prefix.
    pub fn group<T>(
        &mut self,
        name: &str,
        declare: impl FnOnce(&mut Self) -> Result<T, DeclareError>,
    ) -> Result<T, DeclareError> {
        let outer = self.prefix.len();
        let label = self.label.clone();
        if !name.is_empty() {
            self.prefix.push_str(name);
            self.prefix.push('.');
        }
        let result = declare(self);
        self.prefix.truncate(outer);
        self.label = label;
        result
    }

    /// Begins every description of the group being declared with what the user calls it: `label: description`.
    pub fn label(&mut self, label: &str) {
        self.label = format!("{label}{LABEL_END}");
    }

    /// Annotates the variable that is declared next. In its names `[k]` stands for the index of the innermost counted group, `[i]`
    /// for the indices of the array's element.
    pub fn annotate(&mut self, mut annotation: Annotation) -> &mut Self {
        if let Some((before, _)) = self.prefix.rsplit_once(']')
            && let Some(at) = before.rfind('[')
        {
            replace_in_names(&mut annotation, "[k]", &format!("{}]", &before[at..]));
        }
        self.annotation = Some(annotation);
        self
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
        self.push_reals(spec, &[], start.as_ref().map(core::slice::from_ref)).map(Real)
    }

    /// Declares `x[1]`..`x[N]`.
    pub fn real_vector<const N: usize>(
        &mut self,
        spec: &RealSpec<'_>,
        start: Option<[f64; N]>,
    ) -> Result<RealVector<N>, DeclareError> {
        self.push_reals(spec, &[N], start.as_ref().map(|it| it.as_slice())).map(RealVector)
    }

    /// Declares `x[1,1]`..`x[R,C]`, row by row.
    pub fn real_matrix<const R: usize, const C: usize>(
        &mut self,
        spec: &RealSpec<'_>,
        start: Option<[[f64; C]; R]>,
    ) -> Result<RealMatrix<R, C>, DeclareError> {
        self.push_reals(spec, &[R, C], start.as_ref().map(|it| it.as_flattened())).map(RealMatrix)
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
        let at = self.scalar(spec, DeclaredType::Integer { min, max }, start.is_some())?;
        self.interface.start.integers.push(start.unwrap_or(0));
        Ok(Integer(at))
    }

    /// Declares a Boolean.
    pub fn boolean(&mut self, spec: &ScalarSpec<'_>, start: Option<bool>) -> Result<Boolean, DeclareError> {
        let at = self.scalar(spec, DeclaredType::Boolean, start.is_some())?;
        self.interface.start.booleans.push(start.unwrap_or(false));
        Ok(Boolean(at))
    }

    /// Declares a String.
    pub fn text(&mut self, spec: &ScalarSpec<'_>, start: Option<&str>) -> Result<Text, DeclareError> {
        self.checked(spec.name, check::text("start", start.unwrap_or_default()))?;
        let at = self.scalar(spec, DeclaredType::Text, start.is_some())?;
        self.interface.start.strings.push(start.unwrap_or_default().to_owned());
        Ok(Text(at))
    }

    /// Declares an Enumeration, whose values are in the Integer table; `further` are items of the setup behind those of `E`, which
    /// makes variants of their values.
    pub fn choice<E: Enumeration>(
        &mut self,
        spec: &ScalarSpec<'_>,
        start: Option<E>,
        further: Vec<DeclaredItem>,
    ) -> Result<Choice<E>, DeclareError> {
        let first = self.enumeration_type::<E>(spec.name, further)?;
        if spec.role.causality == Causality::Input {
            self.checked(spec.name, check::has_none(E::TYPE.items))?;
        }
        let at = self.scalar(spec, DeclaredType::Enumeration(E::TYPE.name), start.is_some())?;
        self.interface.start.integers.push(start.map_or(first, E::value));
        Ok(Choice(at, PhantomData))
    }

    /// Adds the type of `E` with further items where it is new; the value of its first item.
    fn enumeration_type<E: Enumeration>(
        &mut self,
        name: &str,
        further: Vec<DeclaredItem>,
    ) -> Result<i32, DeclareError> {
        let mut declared = DeclaredEnumeration::from(E::TYPE);
        declared.items.extend(further);
        self.checked(name, check::items(&declared.items))?;
        if let Some(item) = declared.items.iter().find(|item| E::from_value(item.value).is_none()) {
            let problem = format!("its enumeration has no variant of the item `{}`", item.name);
            return Err(self.error(name, problem));
        }
        let first = declared.items.first().map_or(1, |item| item.value);
        match self.interface.enumerations.iter().find(|known| known.name == declared.name) {
            Some(known) if *known == declared => {}
            Some(_) => {
                let problem = format!("two different enumerations are named `{}`", declared.name);
                return Err(self.error(name, problem));
            }
            None if self.names.contains(declared.name) => {
                let problem = format!("its enumeration is named `{}` as a variable is", declared.name);
                return Err(self.error(name, problem));
            }
            None => self.interface.enumerations.push(declared),
        }
        Ok(first)
    }

    /// Declares a scalar or an array with its start values row by row; the place of the first element.
    fn push_reals(
        &mut self,
        spec: &RealSpec<'_>,
        dimensions: &[usize],
        start: Option<&[f64]>,
    ) -> Result<u32, DeclareError> {
        let RealSpec { name, description, role, unit, display_unit, mut min, mut max, nominal } = *spec;
        if matches!(role.causality, Causality::Input | Causality::Parameter) {
            min = min.or(Some(-GREATEST_SET));
            max = max.or(Some(GREATEST_SET));
        }
        let first = if dimensions.is_empty() { name.to_owned() } else { first_element(name, dimensions) };
        let known = units::find(unit)
            .ok_or_else(|| self.error(&first, format!("unit `{unit}` is not in the unit table")))?;
        if let Some(display) = display_unit
            && !known.has_display(display)
        {
            return Err(self.error(&first, format!("`{display}` is no display unit of `{unit}`")));
        }
        for (what, value) in [("min", min), ("max", max), ("nominal", nominal)] {
            self.checked(&first, check::finite(what, value))?;
        }
        self.checked(&first, check::range(None, min, max))?;
        if let Some(nominal) = nominal
            && nominal <= 0.0
        {
            return Err(self.error(&first, format!("nominal is {nominal}; it must be above 0")));
        }
        let kind = DeclaredType::Real {
            unit: unit.to_owned(),
            display_unit: display_unit.map(str::to_owned),
            min,
            max,
            nominal,
        };
        let scalar = ScalarSpec { name, description, role };
        let variable = self.variable(&scalar, dimensions, kind);
        for (at, &value) in start.unwrap_or_default().iter().enumerate() {
            let checked =
                check::finite("start", Some(value)).and_then(|()| check::range(Some(value), min, max));
            checked.map_err(|problem| DeclareError { name: variable.element_name(at), problem })?;
        }
        let (Element { place, .. }, count) = (variable.first, variable.count());
        self.add(variable, start.is_some())?;
        match start {
            Some(values) => self.interface.start.reals.extend(values),
            None => self.interface.start.reals.resize(place as usize + count, 0.0),
        }
        Ok(place)
    }

    /// Declares a scalar that is no Real; its place in the table of its type.
    fn scalar(
        &mut self,
        spec: &ScalarSpec<'_>,
        kind: DeclaredType,
        has_start: bool,
    ) -> Result<u32, DeclareError> {
        let variable = self.variable(spec, &[], kind);
        let Element { place, .. } = variable.first;
        self.add(variable, has_start)?;
        Ok(place)
    }

    /// A variable whose elements follow those declared so far.
    fn variable(&mut self, spec: &ScalarSpec<'_>, dimensions: &[usize], kind: DeclaredType) -> Variable {
        let base = kind.base_type();
        Variable {
            name: format!("{}{}", self.prefix, spec.name),
            description: format!("{}{}", self.label, spec.description),
            role: spec.role,
            dimensions: dimensions.to_vec(),
            first: Element { base, place: self.interface.start.lengths()[base as usize] as u32 },
            kind,
            annotation: self.annotation.take(),
        }
    }

    fn add(&mut self, variable: Variable, has_start: bool) -> Result<(), DeclareError> {
        let is_real = matches!(variable.kind, DeclaredType::Real { .. });
        let of_all = check::role(variable.role, is_real, has_start)
            .and_then(|()| check::text("description", &variable.description))
            .and_then(|()| match variable.description.trim().is_empty() {
                true => Err("needs a description".to_owned()),
                false => Ok(()),
            });
        for (full, _) in variable.elements() {
            let problem = match check::name(&full).and_then(|()| of_all.clone()) {
                Err(problem) => problem,
                Ok(()) if self.interface.enumerations.iter().any(|known| known.name == full) => {
                    "an enumeration type has this name".to_owned()
                }
                Ok(()) if self.names.contains(&full) => "is declared twice".to_owned(),
                Ok(()) => {
                    self.names.insert(full);
                    continue;
                }
            };
            return Err(DeclareError { name: full, problem });
        }
        self.interface.variables.push(variable);
        Ok(())
    }

    fn checked(&self, name: &str, result: check::Checked) -> Result<(), DeclareError> {
        result.map_err(|problem| self.error(name, problem))
    }

    fn error(&self, name: &str, problem: String) -> DeclareError {
        DeclareError { name: format!("{}{name}", self.prefix), problem }
    }
}

/// `x[1]` or `x[1,1]`: where a problem of a whole array is reported.
fn first_element(name: &str, dimensions: &[usize]) -> String {
    format!("{name}[{}]", vec!["1"; dimensions.len()].join(","))
}
