//! Per variable, computed once: when it may be set and read, its limits, its name.
//!
//! The arrays run parallel to the flat value tables, so a get or set costs a subtraction, two bytes and one pair of
//! limits.

use model_description::call_table::{Condition, State};
use model_description::{
    BaseType, Causality, Description, ScalarVariable, Unknown, Variability, VariableKind, value,
};

use super::problem::Problem;
use super::references;
use crate::variables::Values;

/// Settable in `instantiated`.
pub(crate) const SET_INSTANTIATED: u16 = 1;
/// Settable in Initialization Mode.
pub(crate) const SET_INITIALIZATION: u16 = 1 << 1;
/// Settable between steps.
pub(crate) const SET_STEP: u16 = 1 << 2;
/// Readable in Initialization Mode by the letter of the standard.
pub(crate) const GET_INITIALIZATION: u16 = 1 << 3;
/// An input.
pub(crate) const INPUT: u16 = 1 << 4;
/// Written by the importer only: what is read is what was set.
pub(crate) const SET_BY_IMPORTER: u16 = 1 << 5;
/// Continuous.
pub(crate) const CONTINUOUS: u16 = 1 << 6;
/// An output.
pub(crate) const OUTPUT: u16 = 1 << 7;
/// Has a start value, which is read before Initialization Mode.
pub(crate) const HAS_START: u16 = 1 << 8;

/// The access rules of every variable of one model.
#[derive(Debug, Default)]
pub(crate) struct AccessTable {
    flags: [Vec<u16>; 4],
    names: [Vec<String>; 4],
    /// References in the order of the XML, for what the structure says.
    references: Vec<u32>,
    outputs: Vec<Unknown>,
    initial_unknowns: Vec<Unknown>,
    /// Smallest and largest admitted Real; infinities and NaN are never admitted.
    pub(crate) real_limits: Vec<(f64, f64)>,
    /// Smallest and largest admitted Integer.
    pub(crate) integer_limits: Vec<(i32, i32)>,
    /// The item values of an enumeration that has gaps, in ascending order.
    pub(crate) integer_items: Vec<Option<Box<[i32]>>>,
}

impl AccessTable {
    /// The table of a description whose value references [are dense](references::check_dense).
    pub(crate) fn new(description: &Description) -> Self {
        let mut table = Self {
            references: description.variables.iter().map(|variable| variable.value_reference).collect(),
            outputs: description.structure.outputs.clone(),
            initial_unknowns: description.structure.initial_unknowns.clone(),
            ..Self::default()
        };
        let unknowns = &description.structure.initial_unknowns;
        for (index, variable) in (1..).zip(&description.variables) {
            let base = variable.kind.base_type() as usize;
            // Listed in ascending order.
            let initial_unknown = unknowns.binary_search_by_key(&index, |unknown| unknown.index).is_ok();
            table.flags[base].push(flags_of(variable, initial_unknown));
            table.names[base].push(variable.name.clone());
            table.push_limits(description, variable);
        }
        table
    }

    fn push_limits(&mut self, description: &Description, variable: &ScalarVariable) {
        match &variable.kind {
            VariableKind::Real { attributes, .. } => self
                .real_limits
                .push((attributes.min.unwrap_or(f64::MIN), attributes.max.unwrap_or(f64::MAX))),
            VariableKind::Integer { min, max, .. } => {
                // What the model writes has no limits; an enumeration has its items, whoever writes it.
                let given = matches!(variable.causality, Causality::Input | Causality::Parameter);
                let limits = (min.unwrap_or(i32::MIN), max.unwrap_or(i32::MAX));
                self.integer_limits.push(if given { limits } else { (i32::MIN, i32::MAX) });
                self.integer_items.push(None);
            }
            VariableKind::Enumeration { .. } => {
                let items = value::items(description, variable);
                let mut items: Vec<i32> = items.iter().map(|item| item.value).collect();
                items.sort_unstable();
                items.dedup();
                let least = items.first().copied().unwrap_or(i32::MAX);
                let greatest = items.last().copied().unwrap_or(i32::MIN);
                let gapless = i64::from(greatest) - i64::from(least) + 1 == items.len() as i64;
                self.integer_limits.push((least, greatest));
                self.integer_items.push((!gapless).then(|| items.into_boxed_slice()));
            }
            VariableKind::Boolean { .. } | VariableKind::String { .. } => {}
        }
    }

    /// The flags of every variable of a base type, by value reference.
    #[inline]
    pub(crate) fn flags(&self, base: BaseType) -> &[u16] {
        &self.flags[base as usize]
    }

    /// The flags of the variable with a value reference.
    pub(crate) fn flags_at(&self, base: BaseType, reference: u32) -> Option<u16> {
        self.flags(base).get(references::index(base, reference)).copied()
    }

    /// The least and the greatest value of the Real with a value reference.
    pub(crate) fn limits_at(&self, reference: u32) -> (f64, f64) {
        let limits = self.real_limits.get(references::index(BaseType::Real, reference));
        limits.copied().unwrap_or((f64::MIN, f64::MAX))
    }

    /// Whether the Integer or Enumeration at `index` may take `value`.
    #[inline]
    pub(crate) fn admits_integer(&self, index: usize, value: i32) -> bool {
        let Some(&(min, max)) = self.integer_limits.get(index) else { return false };
        min <= value
            && value <= max
            && match self.integer_items.get(index) {
                Some(Some(items)) => items.binary_search(&value).is_ok(),
                _ => true,
            }
    }

    /// The first Real that is no finite number, with its reference; `None` costs one pass without branches.
    #[inline]
    pub(crate) fn first_not_finite(&self, values: &Values) -> Option<(u32, f64)> {
        // A NaN or an infinity makes the sum not finite. So does an overflow of finite numbers, which the search excludes.
        // Eight partial sums vectorize.
        let (chunks, rest) = values.reals.as_chunks::<8>();
        let mut lanes = [0.0; 8];
        for chunk in chunks {
            for (lane, value) in lanes.iter_mut().zip(chunk) {
                *lane += value;
            }
        }
        let sum = lanes.iter().sum::<f64>() + rest.iter().sum::<f64>();
        if sum.is_finite() { None } else { Self::find_not_finite(values) }
    }

    #[cold]
    fn find_not_finite(values: &Values) -> Option<(u32, f64)> {
        let numbered = (references::first(BaseType::Real)..).zip(&values.reals);
        numbered.map(|(reference, &value)| (reference, value)).find(|(_, value)| !value.is_finite())
    }

    /// The references that the Real `reference` depends on: after initialization if `initially`, else at a step's end.
    /// `None` where that is not declared.
    pub(crate) fn dependencies(&self, reference: u32, initially: bool) -> Option<Vec<u32>> {
        let index = self.references.iter().position(|it| *it == reference)? as u32 + 1;
        let unknowns = if initially { &self.initial_unknowns } else { &self.outputs };
        let indices = unknowns.iter().find(|unknown| unknown.index == index)?.dependencies.as_ref()?;
        let reference = |index: &u32| self.references.get(*index as usize - 1).copied();
        Some(indices.iter().filter_map(reference).collect())
    }

    /// A variable for messages.
    pub(crate) fn named(&self, base: BaseType, reference: u32) -> String {
        match self.name(base, reference) {
            Some(name) => format!("`{name}` ({base} value reference {reference})"),
            None => format!("{base} value reference {reference}"),
        }
    }

    /// The refusal of a reference that no variable of this type has.
    #[cold]
    pub(crate) fn unknown(&self, base: BaseType, reference: u32) -> Problem {
        let other = references::base_type(reference).filter(|other| self.name(*other, reference).is_some());
        let (first, count) = (references::first(base), self.flags(base).len());
        match (other, count) {
            (Some(other), _) => Problem::error(format_args!("{} is no {base}", self.named(other, reference))),
            (None, 0) => Problem::error(format_args!(
                "unknown value reference {reference}: this model has no {base} variables"
            )),
            (None, _) => Problem::error(format_args!(
                "unknown {base} value reference {reference}: this model has {first} to {}",
                first as usize + count - 1
            )),
        }
    }

    /// The refusal of a set in a state that does not admit it.
    #[cold]
    pub(crate) fn not_settable(&self, base: BaseType, reference: u32, state: State) -> Problem {
        let when = match self.flags_at(base, reference).unwrap_or(0) {
            f if f & (SET_STEP | INPUT) != 0 => "before a step",
            f if f & (SET_INSTANTIATED | SET_INITIALIZATION) != 0 => "before the end of Initialization Mode",
            _ => "never",
        };
        let name = self.named(base, reference);
        Problem::error(format_args!("{name} may not be set in the state {state}: it may be set {when}"))
    }

    /// The refusal of a read before Initialization Mode of a variable that has no start value.
    #[cold]
    pub(crate) fn not_started(&self, base: BaseType, reference: u32) -> Problem {
        let name = self.named(base, reference);
        Problem::error(format_args!(
            "{name} has no start value: it may be read from Initialization Mode on, before that only variables with a start \
             value"
        ))
    }

    /// The refusal of a Real outside its limits, or not finite.
    #[cold]
    pub(crate) fn real_out_of_range(&self, reference: u32, value: f64) -> Problem {
        let name = self.named(BaseType::Real, reference);
        let allowed = match self.limits_at(reference) {
            (f64::MIN, f64::MAX) => "any finite value".to_owned(),
            (min, f64::MAX) => format!("any finite value from {min:?} up"),
            (f64::MIN, max) => format!("any finite value up to {max:?}"),
            (min, max) => format!("{min:?} to {max:?}"),
        };
        Problem::discard(format_args!("{name} was set to {value:?}, allowed is {allowed}"))
    }

    /// The refusal of an Integer outside its limits, or of an unknown item.
    #[cold]
    pub(crate) fn integer_out_of_range(&self, reference: u32, value: i32) -> Problem {
        let index = references::index(BaseType::Integer, reference);
        let allowed = match (self.integer_items.get(index), self.integer_limits.get(index)) {
            (Some(Some(items)), _) => format!("allowed are {items:?}"),
            (_, Some((min, max))) => format!("allowed is {min} to {max}"),
            _ => "allowed is any".to_owned(),
        };
        Problem::discard(format_args!(
            "{} was set to {value}, {allowed}",
            self.named(BaseType::Integer, reference)
        ))
    }

    /// The name of the variable with a value reference of any type.
    pub(crate) fn any_name(&self, reference: u32) -> Option<&str> {
        self.name(references::base_type(reference)?, reference)
    }

    /// The name of the variable with a value reference.
    pub(crate) fn name(&self, base: BaseType, reference: u32) -> Option<&str> {
        self.names[base as usize].get(references::index(base, reference)).map(String::as_str)
    }
}

fn flags_of(variable: &ScalarVariable, initial_unknown: bool) -> u16 {
    let meets = |condition: Condition| condition.admits(variable, initial_unknown);
    let set_by_importer = matches!(variable.causality, Causality::Input | Causality::Parameter);
    [
        (SET_INSTANTIATED, meets(Condition::SettableBeforeInitialization)),
        (SET_INITIALIZATION, meets(Condition::SettableInInitialization)),
        (SET_STEP, meets(Condition::InputOrTunable)),
        (GET_INITIALIZATION, meets(Condition::OutputOrInitialUnknown)),
        (INPUT, variable.causality == Causality::Input),
        (SET_BY_IMPORTER, set_by_importer),
        (CONTINUOUS, variable.variability == Variability::Continuous),
        (OUTPUT, variable.causality == Causality::Output),
        (HAS_START, value::start(variable).is_some()),
    ]
    .into_iter()
    .filter(|&(_, holds)| holds)
    .fold(0, |flags, (flag, _)| flags | flag)
}
