//! FMU states that an instance holds, named by keys that outlive no state.

use std::{
    ffi::c_void,
    ptr,
    sync::atomic::{AtomicU64, Ordering},
};

use model_description::functions::types::FmuState;

use crate::error::Outcome;

/// Names a state held by an instance.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StateKey {
    component: u64,
    slot: usize,
    generation: u64,
}

/// A place for one FMU state; `generation` distinguishes a freed one from its successor.
struct Slot {
    state: FmuState,
    generation: u64,
}

/// States of one instance.
pub(super) struct States {
    slots: Vec<Slot>,
    number: u64,
}

impl States {
    /// No states of the next instance.
    pub(super) fn new() -> Self {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        Self { slots: Vec::new(), number: NUMBER.fetch_add(1, Ordering::Relaxed) }
    }

    /// The state of a key.
    pub(super) fn get(&self, key: StateKey) -> Result<*mut c_void, Outcome> {
        let slot = self.slots.get(key.slot).filter(|_| key.component == self.number);
        slot.filter(|slot| slot.generation == key.generation).map(|slot| slot.state).ok_or_else(|| {
            Outcome::BadArguments("the state belongs to another instance or was freed".to_owned())
        })
    }

    /// Takes out the state of a key, which names none from then on.
    pub(super) fn take(&mut self, key: StateKey) -> Result<*mut c_void, Outcome> {
        let state = self.get(key)?;
        self.slots[key.slot] = Slot { state: ptr::null_mut(), generation: key.generation + 1 };
        Ok(state)
    }

    /// Keeps a state and gives its key; `None` for NULL.
    pub(super) fn keep(&mut self, state: *mut c_void) -> Option<StateKey> {
        if state.is_null() {
            return None;
        }
        let free = self.slots.iter().position(|slot| slot.state.is_null());
        let slot = free.unwrap_or_else(|| {
            self.slots.push(Slot { state, generation: 0 });
            self.slots.len() - 1
        });
        self.slots[slot].state = state;
        Some(StateKey { component: self.number, slot, generation: self.slots[slot].generation })
    }

    /// The states that were not freed.
    pub(super) fn held(&self) -> impl Iterator<Item = FmuState> {
        self.slots.iter().map(|slot| slot.state).filter(|state| !state.is_null())
    }
}
