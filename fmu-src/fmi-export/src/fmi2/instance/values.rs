//! Getting and setting variables: everything is checked before anything is written.

use super::{Instance, once};
use crate::fmi2::access::{
    AccessTable, GET_INITIALIZATION, HAS_START, INPUT, SET_BY_IMPORTER, SET_INITIALIZATION, SET_INSTANTIATED,
    SET_STEP,
};
use crate::fmi2::problem::Problem;
use crate::fmi2::references;
use model_description::call_table::State;
use model_description::{BaseType, Status};

/// `fmi2GetXXX` of a base type.
macro_rules! getter {
    ($name:ident, $base:ident, $table:ident, $stored:ty) => {
        impl Instance {
            /// One of `fmi2GetXXX`: `read` makes a value of the one at a place in the table.
            #[inline]
            pub(crate) fn $name<V>(
                &mut self,
                references: &[u32],
                values: &mut [V],
                mut read: impl FnMut(usize, &$stored) -> V,
            ) -> Result<(), Problem> {
                if self.reading_needs_preparation() {
                    self.prepare_reading(BaseType::$base, references)?;
                }
                if !self.deferred.pending.is_empty() {
                    self.write_read(BaseType::$base, references)?;
                }
                let table = &self.state.values.$table;
                for (&reference, value) in references.iter().zip(values) {
                    let index = references::index(BaseType::$base, reference);
                    match table.get(index) {
                        Some(stored) => *value = read(index, stored),
                        None => return Err(self.access.unknown(BaseType::$base, reference)),
                    }
                }
                self.conclude_reading()
            }
        }
    };
}

/// `fmi2SetXXX` of a base type: how a value is checked, compared with the stored one, and written.
macro_rules! setter {
    ($name:ident, $base:ident, $table:ident, $value:ty,
     check: $check:expr, differs: $differs:expr, write: $write:expr) => {
        impl Instance {
            /// One of `fmi2SetXXX`.
            pub(crate) fn $name(&mut self, references: &[u32], values: &[$value]) -> Result<(), Problem> {
                let needed = self.settable_flag();
                let (mut lenient, mut differs, mut is_first) = (false, false, false);
                let table = &self.state.values.$table;
                let set = &self.state.values.set[BaseType::$base as usize];
                let flags = self.access.flags(BaseType::$base);
                for (&reference, value) in references.iter().zip(values) {
                    let index = references::index(BaseType::$base, reference);
                    let (Some(&flags), Some(stored)) = (flags.get(index), table.get(index)) else {
                        return Err(self.access.unknown(BaseType::$base, reference));
                    };
                    if flags & needed == 0 {
                        let state = self.state.mode;
                        if state != State::Instantiated || flags & INPUT == 0 {
                            return Err(self.access.not_settable(BaseType::$base, reference, state));
                        }
                        lenient = true;
                    }
                    $check(&self.access, reference, value)?;
                    differs |= $differs(stored, value);
                    is_first |= !set.is_set(index);
                }
                if lenient {
                    self.note_input_before_initialization();
                }
                if differs || is_first {
                    self.before_change();
                    let table = &mut self.state.values.$table;
                    let set = &mut self.state.values.set[BaseType::$base as usize];
                    for (&reference, value) in references.iter().zip(values) {
                        let index = references::index(BaseType::$base, reference);
                        if let Some(stored) = table.get_mut(index) {
                            $write(stored, value);
                        }
                        if is_first {
                            set.mark(index);
                        }
                    }
                }
                Ok(())
            }
        }
    };
}

getter!(get_real, Real, reals, f64);
getter!(get_integer, Integer, integers, i32);
getter!(get_boolean, Boolean, booleans, bool);
getter!(get_string, String, strings, String);

setter!(set_real, Real, reals, f64,
    check: |access: &AccessTable, reference: u32, value: &f64| {
        match access.real_limits.get(references::index(BaseType::Real, reference)) {
            // Written so that NaN fails.
            Some(&(min, max)) if min <= *value && *value <= max => Ok(()),
            _ => Err(access.real_out_of_range(reference, *value)),
        }
    },
    differs: |stored: &f64, value: &f64| stored.to_bits() != value.to_bits(),
    write: |stored: &mut f64, value: &f64| *stored = *value);

setter!(set_integer, Integer, integers, i32,
    check: |access: &AccessTable, reference: u32, value: &i32| {
        match access.admits_integer(references::index(BaseType::Integer, reference), *value) {
            true => Ok(()),
            false => Err(access.integer_out_of_range(reference, *value)),
        }
    },
    differs: |stored: &i32, value: &i32| stored != value,
    write: |stored: &mut i32, value: &i32| *stored = *value);

setter!(set_boolean, Boolean, booleans, i32,
    check: |access: &AccessTable, reference: u32, value: &i32| match value {
        0 | 1 => Ok(()),
        _ => Err(Problem::discard(format_args!(
            "{} was set to {value}, allowed are 0 (fmi2False) and 1 (fmi2True)",
            access.named(BaseType::Boolean, reference)
        ))),
    },
    differs: |stored: &bool, value: &i32| i32::from(*stored) != *value,
    write: |stored: &mut bool, value: &i32| *stored = *value == 1);

/// A String at the interface: `None` where the caller's text is not UTF-8.
pub(crate) type MaybeText<'a> = Option<&'a str>;

setter!(set_string, String, strings, MaybeText<'_>,
    check: |access: &AccessTable, reference: u32, value: &MaybeText<'_>| match value {
        Some(_) => Ok(()),
        None => Err(Problem::discard(format_args!(
            "{} was set to text that is not UTF-8",
            access.named(BaseType::String, reference)
        ))),
    },
    differs: |stored: &String, value: &MaybeText<'_>| *value != Some(stored.as_str()),
    write: |stored: &mut String, value: &MaybeText<'_>| value.unwrap_or_default().clone_into(stored));

impl Instance {
    /// The warning that goes with values read before Initialization Mode.
    #[inline]
    fn conclude_reading(&self) -> Result<(), Problem> {
        match self.state.mode {
            State::Instantiated => Err(Problem::warning(
                "variables are read before Initialization Mode, which FMI 2.0 does not allow: answered with their start \
                 values, or what was set since",
            )),
            _ => Ok(()),
        }
    }

    /// The flag that a variable needs to be set now. The guard has admitted the state.
    #[inline]
    fn settable_flag(&self) -> u16 {
        match self.state.mode {
            State::Instantiated => SET_INSTANTIATED,
            State::InitializationMode => SET_INITIALIZATION,
            _ => SET_STEP,
        }
    }

    /// Whether a read must compute or log something first.
    #[inline]
    fn reading_needs_preparation(&self) -> bool {
        match self.state.mode {
            State::StepComplete => {
                self.state.at_last_step.is_some() && self.reported & once::OUTPUT_AFTER_SET == 0
            }
            State::Instantiated | State::InitializationMode => true,
            _ => false,
        }
    }

    #[cold]
    fn prepare_reading(&mut self, base: BaseType, references: &[u32]) -> Result<(), Problem> {
        let flags = self.access.flags(base);
        let mut all = u16::MAX;
        for &reference in references {
            match flags.get(references::index(base, reference)) {
                Some(flags) => all &= flags,
                None => return Err(self.access.unknown(base, reference)),
            }
        }
        if self.state.mode == State::Instantiated {
            let without = |it: &&u32| flags[references::index(base, **it)] & HAS_START == 0;
            return references
                .iter()
                .find(without)
                .map_or(Ok(()), |it| Err(self.access.not_started(base, *it)));
        }
        let only_given = all & SET_BY_IMPORTER != 0;
        if self.state.mode == State::StepComplete {
            if !only_given {
                self.log_once(
                    once::OUTPUT_AFTER_SET,
                    Status::Ok,
                    format_args!(
                        "outputs are read after a set and before the next step: they belong to the last communication point"
                    ),
                );
            }
            return Ok(());
        }
        if all & GET_INITIALIZATION == 0 {
            self.log_once(
                once::READ_IN_INITIALIZATION,
                Status::Ok,
                format_args!(
                    "variables that are neither outputs nor InitialUnknowns are read in Initialization Mode: the standard does not allow it, answered all the same"
                ),
            );
        }
        if only_given { Ok(()) } else { self.initialize_if_needed() }
    }

    /// Called when a set is about to write a different value, or one for the first time.
    #[inline]
    fn before_change(&mut self) {
        match self.state.mode {
            State::InitializationMode => self.state.needs_initialization = true,
            State::StepComplete if self.state.at_last_step.is_none() => {
                let mut values = core::mem::take(&mut self.spare);
                values.clone_from(&self.state.values);
                self.state.at_last_step = Some(values);
            }
            _ => {}
        }
    }

    #[cold]
    fn note_input_before_initialization(&mut self) {
        self.log_once(
            once::INPUT_BEFORE_INITIALIZATION,
            Status::Ok,
            format_args!(
                "inputs are set before Initialization Mode: the standard does not allow it, accepted all the same"
            ),
        );
    }
}
