//! Saving, restoring and serialising the whole instance.

use model_description::call_table::Function;

use super::{Instance, State};
use crate::{
    Error,
    abi::{Component, StateKey},
    error::Outcome,
};

impl Instance {
    /// `fmi2GetFMUstate` into a new state. Free it with [`free_state`](Self::free_state), or leave it to drop.
    pub fn save_state(&mut self) -> Result<State, Error> {
        let key = self.call_for(Function::GetFmuState, Component::get_state, |_| String::new())?;
        let key = self.given(Function::GetFmuState, key)?;
        self.checker.saved(key);
        Ok(State(key))
    }

    /// `fmi2SetFMUstate`.
    pub fn restore_state(&mut self, state: State) -> Result<(), Error> {
        self.call_plain(Function::SetFmuState, |it| it.set_state(state.0))?;
        self.checker.restored(state.0);
        Ok(())
    }

    /// `fmi2FreeFMUstate`.
    pub fn free_state(&mut self, state: State) -> Result<(), Error> {
        self.call_plain(Function::FreeFmuState, |it| it.free_state(state.0))?;
        self.checker.forget(state.0);
        Ok(())
    }

    /// `fmi2SerializeFMUstate`.
    pub fn serialize_state(&mut self, state: State) -> Result<Vec<u8>, Error> {
        let mut bytes = Vec::new();
        self.call_plain(Function::SerializeFmuState, |it| it.serialize_state(state.0, &mut bytes))?;
        Ok(bytes)
    }

    /// `fmi2DeSerializeFMUstate`: a state of this instance from bytes that any instance of this FMU wrote.
    pub fn deserialize_state(&mut self, bytes: &[u8]) -> Result<State, Error> {
        let answer = |it: &mut Component| it.deserialize_state(bytes);
        let shown = |_: &Self| format!("({} bytes)", bytes.len());
        let key = self.call_for(Function::DeSerializeFmuState, answer, shown)?;
        self.given(Function::DeSerializeFmuState, key).map(State)
    }

    /// The state that a good answer came with.
    fn given(&self, function: Function, key: Option<StateKey>) -> Result<StateKey, Error> {
        let what = "the answer is good, but the FMU gave no state".to_owned();
        key.ok_or_else(|| self.failure(function.symbol().to_owned(), Outcome::BadArguments(what)))
    }
}
