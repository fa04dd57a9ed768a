//! FMU states: kept in memory, and as bytes that another process can read: after the header of [`crate::state_bytes`],
//! [`InstanceState`] and the model's state in postcard's format.

use uuid::Uuid;

use super::Instance;
use super::state::InstanceState;
use crate::fmi2::problem::Problem;
use crate::model::Failure;
use crate::runtime::{ErasedState, unencodable};
use crate::state_bytes::{self, HEADER, check_digest, damaged, wrong_length};
use model_description::call_table::State;

/// A saved instance.
pub(crate) struct SavedState {
    digest: Uuid,
    state: InstanceState,
    model: ErasedState,
}

impl Instance {
    /// `fmi2GetFMUstate`, into `reuse` if given.
    pub(crate) fn save(&mut self, reuse: Option<&mut SavedState>) -> Result<Option<SavedState>, Problem> {
        self.write_pending()?;
        let Some(saved) = reuse else {
            let (digest, state, model) = (self.digest, self.state.clone(), self.runtime.save(None));
            return Ok(Some(SavedState { digest, state, model }));
        };
        self.own(saved)?;
        saved.state.copy_from(&self.state);
        let old = core::mem::replace(&mut saved.model, Box::new(()));
        saved.model = self.runtime.save(Some(old));
        Ok(None)
    }

    /// `fmi2SetFMUstate`.
    pub(crate) fn restore(&mut self, saved: &SavedState) -> Result<(), Problem> {
        self.own(saved)?;
        self.runtime.restore(&saved.model).map_err(damaged)?;
        self.forget_last_step();
        self.deferred.mark_none();
        self.state.copy_from(&saved.state);
        self.warn_of_early_state(saved.state.time_s);
        Ok(())
    }

    /// `fmi2SerializedFMUstateSize`.
    pub(crate) fn serialized_size(&self, saved: &SavedState) -> Result<usize, Problem> {
        self.own(saved)?;
        let state = postcard::serialize_with_flavor(&saved.state, postcard::ser_flavors::Size::default())
            .map_err(|error| damaged(unencodable(error)))?;
        Ok(HEADER + state + self.runtime.encoded_size(&saved.model).map_err(damaged)?)
    }

    /// `fmi2SerializeFMUstate`: `bytes` must hold [`Instance::serialized_size`]; what lies beyond is kept.
    pub(crate) fn serialize(&self, saved: &SavedState, bytes: &mut [u8]) -> Result<(), Problem> {
        // What is written can be read: better refused now than when the flight is gone.
        self.runtime.check(&saved.model).map_err(|failure| {
            Failure::new(format!("the FMU state cannot be written, because it could not be read: {failure}"))
        })?;
        let (given, needed) = (bytes.len(), self.serialized_size(saved)?);
        let Some((header, payload)) =
            bytes.get_mut(..needed).and_then(|all| all.split_at_mut_checked(HEADER))
        else {
            return Err(wrong_length(given, needed as u64).into());
        };
        let used =
            postcard::to_slice(&saved.state, payload).map_err(|error| damaged(unencodable(error)))?.len();
        self.runtime.encode(&saved.model, &mut payload[used..]).map_err(damaged)?;
        state_bytes::seal(header, self.digest, payload);
        Ok(())
    }

    /// `fmi2DeSerializeFMUstate`. Total: any bytes give a state or an error, and no more memory is requested
    /// than the bytes can fill.
    pub(crate) fn deserialize(&self, bytes: &[u8]) -> Result<SavedState, Problem> {
        let payload = state_bytes::unsealed(bytes, self.digest)?;
        let (state, rest) = postcard::take_from_bytes::<InstanceState>(payload)
            .map_err(|error| damaged(format_args!("instance: {error}")))?;
        state.check(&self.access)?;
        let model = self.runtime.decode(rest).map_err(damaged)?;
        let steps_next = state.mode == State::StepComplete
            || (state.mode == State::InitializationMode && !state.needs_initialization);
        let needs_model = steps_next || matches!(state.mode, State::StepFailed | State::Terminated);
        if needs_model && !self.runtime.is_initialized(&model) {
            return Err(damaged(format_args!("state {} without a model state", state.mode)).into());
        }
        if steps_next {
            self.runtime.check_time(&model, state.time_s).map_err(damaged)?;
        }
        Ok(SavedState { digest: self.digest, state, model })
    }

    fn own(&self, saved: &SavedState) -> Result<(), Failure> {
        check_digest(saved.digest, self.digest)
    }
}
