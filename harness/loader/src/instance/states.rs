//! Saving, restoring and serialising the whole instance.

use model_description::call_table::Function;

use super::{Instance, State, split};
use crate::{
    Error, Status,
    abi::{Answer, StateKey},
    error::Outcome,
};

impl Instance {
    /// `fmi2GetFMUstate` into a new state. Free it with [`free_state`](Self::free_state), or leave it to drop.
    pub fn save_state(&mut self) -> Result<State, Error> {
        let function = Function::GetFmuState;
        self.allow(function)?;
        let (answer, key) = split(self.component.get_state(None));
        let answer = answer.and_then(|status| gave_state(status, key.flatten()));
        self.finish(function, answer, |symbol| symbol.to_owned())?;
        let key = key.flatten().ok_or_else(|| self.no_state(function.symbol()))?;
        self.checker.saved(key);
        Ok(State(key))
    }

    /// `fmi2GetFMUstate` over an older state of this instance.
    pub fn save_state_over(&mut self, state: State) -> Result<(), Error> {
        let function = Function::GetFmuState;
        self.allow(function)?;
        let (answer, _) = split(self.component.get_state(Some(state.0)));
        self.finish(function, answer, |symbol| symbol.to_owned())?;
        self.checker.saved(state.0);
        Ok(())
    }

    /// `fmi2SetFMUstate`.
    pub fn restore_state(&mut self, state: State) -> Result<(), Error> {
        let function = Function::SetFmuState;
        self.allow(function)?;
        let answer = self.component.set_state(state.0);
        self.finish(function, answer, |symbol| symbol.to_owned())?;
        self.checker.restored(state.0);
        Ok(())
    }

    /// `fmi2FreeFMUstate`.
    pub fn free_state(&mut self, state: State) -> Result<(), Error> {
        let function = Function::FreeFmuState;
        self.allow(function)?;
        let answer = self.component.free_state(state.0);
        self.checker.forget(state.0);
        self.finish(function, answer, |symbol| symbol.to_owned())
    }

    /// `fmi2SerializeFMUstate`.
    pub fn serialize_state(&mut self, state: State) -> Result<Vec<u8>, Error> {
        let function = Function::SerializeFmuState;
        self.allow(function)?;
        let mut bytes = Vec::new();
        let answer = self.component.serialize_state(state.0, &mut bytes);
        self.finish(function, answer, |symbol| symbol.to_owned())?;
        Ok(bytes)
    }

    /// `fmi2DeSerializeFMUstate`: a state of this instance from bytes that any instance of this FMU wrote.
    pub fn deserialize_state(&mut self, bytes: &[u8]) -> Result<State, Error> {
        let function = Function::DeSerializeFmuState;
        self.allow(function)?;
        let (answer, key) = split(self.component.deserialize_state(bytes));
        let answer = answer.and_then(|status| gave_state(status, key.flatten()));
        self.finish(function, answer, |symbol| format!("{symbol}({} bytes)", bytes.len()))?;
        key.flatten().map(State).ok_or_else(|| self.no_state(function.symbol()))
    }

    fn no_state(&self, function: &str) -> Error {
        self.failure(function.to_owned(), Outcome::BadArguments("the FMU gave no state".to_owned()))
    }
}

fn gave_state(status: Status, key: Option<StateKey>) -> Answer {
    if matches!(status, Status::Ok | Status::Warning) && key.is_none() {
        return Err(Outcome::BadArguments(format!("answered {status} but gave no state")));
    }
    Ok(status)
}
