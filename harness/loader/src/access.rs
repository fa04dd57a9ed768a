//! Which conditions of the call table the variables of an FMU meet.

use bitflags::bitflags;
use fmi_export::call_table::Condition;
use model_description::{Description, VariableKind, rules};

/// Base type at the C interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Base {
    Real,
    Integer,
    Boolean,
    Text,
}

impl Base {
    pub fn of(kind: &VariableKind) -> Self {
        match kind {
            VariableKind::Real { .. } => Self::Real,
            VariableKind::Integer { .. } | VariableKind::Enumeration { .. } => Self::Integer,
            VariableKind::Boolean { .. } => Self::Boolean,
            VariableKind::String { .. } => Self::Text,
        }
    }
}

bitflags! {
    /// Which of the call table's conditions a variable meets.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct Conditions: u8 {
        const SETTABLE_BEFORE_INITIALIZATION = 1;
        const OUTPUT_OR_INITIAL_UNKNOWN = 1 << 1;
        const SETTABLE_IN_INITIALIZATION = 1 << 2;
        const INPUT_OR_TUNABLE = 1 << 3;
    }
}

impl From<Condition> for Conditions {
    fn from(condition: Condition) -> Self {
        match condition {
            Condition::SettableBeforeInitialization => Self::SETTABLE_BEFORE_INITIALIZATION,
            Condition::OutputOrInitialUnknown => Self::OUTPUT_OR_INITIAL_UNKNOWN,
            Condition::SettableInInitialization => Self::SETTABLE_IN_INITIALIZATION,
            Condition::InputOrTunable => Self::INPUT_OR_TUNABLE,
            // These restrict what the values are good for, not which variables may be read.
            Condition::Debugging | Condition::DebuggingUnlessTerminated => Self::empty(),
        }
    }
}

/// For every value reference, by base type and sorted: which of the table's conditions it meets.
pub(crate) struct AccessTable([Vec<(u32, Conditions)>; 4]);

impl AccessTable {
    pub fn of(description: &Description) -> Self {
        let mut initial_unknown = vec![false; description.variables.len() + 1];
        for unknown in &description.structure.initial_unknowns {
            if let Some(flag) = initial_unknown.get_mut(unknown.index as usize) {
                *flag = true;
            }
        }
        let mut tables: [Vec<(u32, Conditions)>; 4] = Default::default();
        for (position, variable) in description.variables.iter().enumerate() {
            let listed = initial_unknown[position + 1];
            let settable = |phase| rules::settable(variable, phase);
            let mut met = Conditions::empty();
            met.set(Conditions::SETTABLE_BEFORE_INITIALIZATION, settable(rules::Phase::Instantiated));
            met.set(
                Conditions::OUTPUT_OR_INITIAL_UNKNOWN,
                rules::gettable(variable, listed, rules::Phase::InitializationMode),
            );
            met.set(Conditions::SETTABLE_IN_INITIALIZATION, settable(rules::Phase::InitializationMode));
            met.set(Conditions::INPUT_OR_TUNABLE, settable(rules::Phase::StepComplete));
            tables[Base::of(&variable.kind) as usize].push((variable.value_reference, met));
        }
        for table in &mut tables {
            // Aliases share a reference: what one of them may, all may.
            table.sort_unstable_by_key(|row| row.0);
            table.dedup_by(|next, kept| {
                let alias = next.0 == kept.0;
                if alias {
                    kept.1 |= next.1;
                }
                alias
            });
        }
        Self(tables)
    }

    pub fn met(&self, base: Base, reference: u32) -> Option<Conditions> {
        let table = &self.0[base as usize];
        table.binary_search_by_key(&reference, |row| row.0).ok().map(|at| table[at].1)
    }
}
