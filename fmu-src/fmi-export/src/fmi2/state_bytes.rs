//! FMU states: kept in memory, and as bytes that another process can read.
//!
//! Layout of the bytes, little endian: mark (8), layout version (4), GUID digest (16), payload length (8),
//! checksum of the payload (8), payload: [`InstanceState`] and the model's state in postcard's format.

use uuid::Uuid;

use crate::fmi2::instance::Instance;
use crate::fmi2::instance::{InstanceState, content};
use crate::fmi2::problem::{Problem, StateMismatch};
use crate::runtime::{ErasedState, unencodable};
use model_description::call_table::{Function, State};

const MARK: [u8; 8] = *b"FMUSTATE";
const LAYOUT: u32 = 3;
const HEADER: usize = 8 + 4 + 16 + 8 + 8;

/// A saved instance.
pub(crate) struct SavedState {
    digest: Uuid,
    state: InstanceState,
    model: ErasedState,
}

impl Instance {
    /// `fmi2GetFMUstate`, into `reuse` if given.
    pub(crate) fn save(&mut self, reuse: Option<&mut SavedState>) -> Result<Option<SavedState>, Problem> {
        self.guard(Function::GetFmuState)?;
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
        self.guard(Function::SetFmuState)?;
        self.own(saved)?;
        self.runtime.restore(&saved.model).map_err(StateMismatch::from)?;
        self.forget_last_step();
        self.state.copy_from(&saved.state);
        self.warn_of_early_state(saved.state.time_s);
        Ok(())
    }

    /// `fmi2SerializedFMUstateSize`.
    pub(crate) fn serialized_size(&self, saved: &SavedState) -> Result<usize, Problem> {
        self.guard(Function::SerializedFmuStateSize)?;
        self.size(saved)
    }

    fn size(&self, saved: &SavedState) -> Result<usize, Problem> {
        self.own(saved)?;
        let state = postcard::serialize_with_flavor(&saved.state, postcard::ser_flavors::Size::default())
            .map_err(|error| StateMismatch::from(unencodable(error)))?;
        Ok(HEADER + state + self.runtime.encoded_size(&saved.model).map_err(StateMismatch::from)?)
    }

    /// `fmi2SerializeFMUstate`: `bytes` must hold [`Instance::serialized_size`]; what lies beyond is kept.
    pub(crate) fn serialize(&self, saved: &SavedState, bytes: &mut [u8]) -> Result<(), Problem> {
        self.guard(Function::SerializeFmuState)?;
        // What is written can be read: better refused now than when the flight is gone.
        self.runtime.check(&saved.model).map_err(|failure| StateMismatch::Unreadable(failure.to_string()))?;
        let (given, needed) = (bytes.len(), self.size(saved)?);
        let Some((header, payload)) =
            bytes.get_mut(..needed).and_then(|all| all.split_at_mut_checked(HEADER))
        else {
            return Err(StateMismatch::Length { found: given as u64, expected: needed as u64 }.into());
        };
        let used = postcard::to_slice(&saved.state, payload)
            .map_err(|error| StateMismatch::from(unencodable(error)))?
            .len();
        self.runtime.encode(&saved.model, &mut payload[used..]).map_err(StateMismatch::from)?;
        let length = payload.len() as u64;
        let parts: [&[u8]; 5] = [
            &MARK,
            &LAYOUT.to_le_bytes(),
            saved.digest.as_bytes(),
            &length.to_le_bytes(),
            &checksum(payload).to_le_bytes(),
        ];
        for (to, from) in header.iter_mut().zip(parts.into_iter().flatten()) {
            *to = *from;
        }
        Ok(())
    }

    /// `fmi2DeSerializeFMUstate`. Total: any bytes give a state or an error, and no more memory is requested
    /// than the bytes can fill.
    pub(crate) fn deserialize(&self, bytes: &[u8]) -> Result<SavedState, Problem> {
        self.guard(Function::DeSerializeFmuState)?;
        let payload = self.unsealed(bytes)?;
        let (state, rest) = postcard::take_from_bytes::<InstanceState>(payload)
            .map_err(|error| content(format!("instance: {error}")))?;
        state.check(&self.access)?;
        let model = self.runtime.decode(rest).map_err(StateMismatch::from)?;
        let steps_next = state.mode == State::StepComplete
            || (state.mode == State::InitializationMode && !state.needs_initialization);
        let needs_model = steps_next || matches!(state.mode, State::StepFailed | State::Terminated);
        if needs_model && !self.runtime.is_initialized(&model) {
            return Err(content(format!("state {} without a model state", state.mode.name())).into());
        }
        if steps_next {
            self.runtime.check_time(&model, state.time_s).map_err(StateMismatch::from)?;
        }
        Ok(SavedState { digest: self.digest, state, model })
    }

    /// The payload behind a valid header.
    fn unsealed<'a>(&self, bytes: &'a [u8]) -> Result<&'a [u8], StateMismatch> {
        let short = || StateMismatch::Length { found: bytes.len() as u64, expected: HEADER as u64 };
        let (mark, rest) = bytes.split_first_chunk::<8>().ok_or_else(short)?;
        if *mark != MARK {
            return Err(StateMismatch::Mark);
        }
        let (layout, rest) = rest.split_first_chunk::<4>().ok_or_else(short)?;
        let found = u32::from_le_bytes(*layout);
        if found != LAYOUT {
            return Err(StateMismatch::Version { found, expected: LAYOUT });
        }
        let (digest, rest) = rest.split_first_chunk::<16>().ok_or_else(short)?;
        let found = Uuid::from_bytes(*digest);
        if found != self.digest {
            return Err(StateMismatch::Guid { found, expected: self.digest });
        }
        let (length, rest) = rest.split_first_chunk::<8>().ok_or_else(short)?;
        let (sum, rest) = rest.split_first_chunk::<8>().ok_or_else(short)?;
        let length = u64::from_le_bytes(*length);
        // A buffer may be longer than the blob, never shorter.
        let payload =
            usize::try_from(length).ok().and_then(|length| rest.get(..length)).ok_or_else(|| {
                let expected = length.saturating_add(HEADER as u64);
                StateMismatch::Length { found: bytes.len() as u64, expected }
            })?;
        if checksum(payload) == u64::from_le_bytes(*sum) { Ok(payload) } else { Err(StateMismatch::Checksum) }
    }

    fn own(&self, saved: &SavedState) -> Result<(), StateMismatch> {
        if saved.digest == self.digest {
            Ok(())
        } else {
            Err(StateMismatch::Guid { found: saved.digest, expected: self.digest })
        }
    }
}

/// FNV-1a, 64 bits: guards against damage, not against intent.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}
