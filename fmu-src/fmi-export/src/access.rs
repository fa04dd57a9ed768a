//! Per variable, computed once: when it may be set and read, its limits, its name.
//!
//! The arrays run parallel to the flat value tables, so a get or set costs one byte and one pair of limits.

use model_description::rules::{Phase, gettable, settable};
use model_description::{Causality, Description, ScalarVariable, SimpleTypeKind, Variability, VariableKind};

/// Settable in `instantiated`.
pub(crate) const SET_INSTANTIATED: u8 = 1;
/// Settable in Initialization Mode.
pub(crate) const SET_INITIALIZATION: u8 = 1 << 1;
/// Settable between steps.
pub(crate) const SET_STEP: u8 = 1 << 2;
/// Readable in Initialization Mode by the letter of the standard.
pub(crate) const GET_INITIALIZATION: u8 = 1 << 3;
/// An input.
pub(crate) const INPUT: u8 = 1 << 4;
/// Written by the master only: what is read is what was set.
pub(crate) const GIVEN: u8 = 1 << 5;
/// Continuous.
pub(crate) const CONTINUOUS: u8 = 1 << 6;
/// An output.
pub(crate) const OUTPUT: u8 = 1 << 7;

/// The four base types of the C interface; an enumeration is an Integer there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum BaseType {
    /// `fmi2Real`.
    Real,
    /// `fmi2Integer`, enumerations included.
    Integer,
    /// `fmi2Boolean`.
    Boolean,
    /// `fmi2String`.
    String,
}

impl BaseType {
    /// Every base type.
    pub const ALL: [Self; 4] = [Self::Real, Self::Integer, Self::Boolean, Self::String];

    /// The standard's word.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Real => "Real",
            Self::Integer => "Integer",
            Self::Boolean => "Boolean",
            Self::String => "String",
        }
    }

    fn of(variable: &ScalarVariable) -> Self {
        match variable.kind {
            VariableKind::Real { .. } => Self::Real,
            VariableKind::Integer { .. } | VariableKind::Enumeration { .. } => Self::Integer,
            VariableKind::Boolean { .. } => Self::Boolean,
            VariableKind::String { .. } => Self::String,
        }
    }
}

/// The access rules of every variable of one model.
#[derive(Debug, Default)]
pub(crate) struct AccessTable {
    flags: [Vec<u8>; 4],
    names: [Vec<String>; 4],
    /// Smallest and largest admitted Real; infinities and NaN are never admitted.
    pub(crate) real_limits: Vec<(f64, f64)>,
    /// Smallest and largest admitted Integer.
    pub(crate) integer_limits: Vec<(i32, i32)>,
    /// Of an enumeration, the item values in ascending order where they have gaps.
    pub(crate) integer_items: Vec<Option<Box<[i32]>>>,
}

impl AccessTable {
    /// The table of a description whose value references are dense per base type.
    ///
    /// The error names a variable out of order or an enumeration without its type.
    pub(crate) fn of(description: &Description) -> Result<Self, String> {
        let mut table = Self::default();
        let unknowns = &description.structure.initial_unknowns;
        for (index, variable) in (1..).zip(&description.variables) {
            let base = BaseType::of(variable) as usize;
            if variable.value_reference as usize != table.flags[base].len() {
                return Err(format!(
                    "variable `{}` has value reference {}, expected {}",
                    variable.name,
                    variable.value_reference,
                    table.flags[base].len()
                ));
            }
            // Listed in ascending order.
            let initial_unknown = unknowns.binary_search_by_key(&index, |unknown| unknown.index).is_ok();
            table.flags[base].push(flags_of(variable, initial_unknown));
            table.names[base].push(variable.name.clone());
            table.push_limits(description, variable)?;
        }
        Ok(table)
    }

    fn push_limits(&mut self, description: &Description, variable: &ScalarVariable) -> Result<(), String> {
        match &variable.kind {
            VariableKind::Real { attributes, .. } => self
                .real_limits
                .push((attributes.min.unwrap_or(f64::MIN), attributes.max.unwrap_or(f64::MAX))),
            VariableKind::Integer { min, max, .. } => {
                self.integer_limits.push((min.unwrap_or(i32::MIN), max.unwrap_or(i32::MAX)));
                self.integer_items.push(None);
            }
            VariableKind::Enumeration { declared_type, .. } => {
                let mut items = items_of(description, declared_type)
                    .ok_or_else(|| format!("variable `{}`: no type `{declared_type}`", variable.name))?;
                items.sort_unstable();
                items.dedup();
                let limits = match (items.first(), items.last()) {
                    (Some(&first), Some(&last)) => (first, last),
                    _ => return Err(format!("type `{declared_type}` has no items")),
                };
                let gapless = i64::from(limits.1) - i64::from(limits.0) + 1 == items.len() as i64;
                self.integer_limits.push(limits);
                self.integer_items.push((!gapless).then(|| items.into_boxed_slice()));
            }
            VariableKind::Boolean { .. } | VariableKind::String { .. } => {}
        }
        Ok(())
    }

    /// The flags of every variable of a base type, by value reference.
    #[inline]
    pub(crate) fn flags(&self, base: BaseType) -> &[u8] {
        &self.flags[base as usize]
    }

    /// Whether the Integer or Enumeration may take `value`.
    #[inline]
    pub(crate) fn admits_integer(&self, reference: usize, value: i32) -> bool {
        let Some(&(min, max)) = self.integer_limits.get(reference) else { return false };
        min <= value
            && value <= max
            && match self.integer_items.get(reference) {
                Some(Some(items)) => items.binary_search(&value).is_ok(),
                _ => true,
            }
    }

    /// The name behind a value reference.
    pub(crate) fn name(&self, base: BaseType, reference: u32) -> Option<&str> {
        self.names[base as usize].get(reference as usize).map(String::as_str)
    }
}

fn items_of(description: &Description, type_name: &str) -> Option<Vec<i32>> {
    description.types.iter().find(|known| known.name == type_name).and_then(|known| match &known.kind {
        SimpleTypeKind::Enumeration { items, .. } => Some(items.iter().map(|item| item.value).collect()),
        _ => None,
    })
}

fn flags_of(variable: &ScalarVariable, initial_unknown: bool) -> u8 {
    let given = matches!(variable.causality, Causality::Input | Causality::Parameter);
    [
        (SET_INSTANTIATED, settable(variable, Phase::Instantiated)),
        (SET_INITIALIZATION, settable(variable, Phase::InitializationMode)),
        (SET_STEP, settable(variable, Phase::StepComplete)),
        (GET_INITIALIZATION, gettable(variable, initial_unknown, Phase::InitializationMode)),
        (INPUT, variable.causality == Causality::Input),
        (GIVEN, given),
        (CONTINUOUS, variable.variability == Variability::Continuous),
        (OUTPUT, variable.causality == Causality::Output),
    ]
    .into_iter()
    .filter(|&(_, holds)| holds)
    .fold(0, |flags, (flag, _)| flags | flag)
}
