//! The header of a saved state: whose it is, how long, and a checksum.
//!
//! Layout, little endian: mark (8), layout version (4), GUID digest (16), payload length (8), checksum of the payload
//! (8), payload.

use uuid::Uuid;

use crate::model::Failure;

const MARK: [u8; 8] = *b"FMUSTATE";
const LAYOUT: u32 = 3;
/// Bytes before the payload.
pub(crate) const HEADER: usize = 8 + 4 + 16 + 8 + 8;

/// Why an FMU state or its bytes are refused.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum StateMismatch {
    /// Not produced by this export tool.
    #[error("these bytes are no FMU state of this tool: they do not begin with its mark")]
    Mark,
    /// A layout this library does not know.
    #[error("the FMU state has layout version {found}, this library reads {expected}")]
    Version {
        /// In the bytes.
        found: u32,
        /// What can be read.
        expected: u32,
    },
    /// Another model, or the same model with another setup.
    #[error(
        "the FMU state belongs to another model or another setup (GUID digest {found}, expected {expected})"
    )]
    Guid {
        /// In the state.
        found: uuid::Uuid,
        /// Of this instance.
        expected: uuid::Uuid,
    },
    /// Cut short or padded.
    #[error("the FMU state has {found} bytes, expected {expected}")]
    Length {
        /// Bytes given.
        found: u64,
        /// Bytes announced or needed.
        expected: u64,
    },
    /// Damaged.
    #[error("the FMU state is damaged: its checksum does not match")]
    Checksum,
    /// Of a flight with numbers that no simulation can go on with.
    #[error("the FMU state cannot be written, because it could not be read: {0}")]
    Unreadable(String),
    /// Well sealed, but its content makes no sense for this model.
    #[error("the FMU state is damaged: {0}")]
    Content(String),
}

impl From<Failure> for StateMismatch {
    fn from(failure: Failure) -> Self {
        Self::Content(failure.to_string())
    }
}

/// Writes the header of a payload.
pub(crate) fn seal(header: &mut [u8], digest: Uuid, payload: &[u8]) {
    let length = payload.len() as u64;
    let parts: [&[u8]; 5] = [
        &MARK,
        &LAYOUT.to_le_bytes(),
        digest.as_bytes(),
        &length.to_le_bytes(),
        &checksum(payload).to_le_bytes(),
    ];
    for (to, from) in header.iter_mut().zip(parts.into_iter().flatten()) {
        *to = *from;
    }
}

/// The payload behind a valid header of this digest.
pub(crate) fn unsealed(bytes: &[u8], expected: Uuid) -> Result<&[u8], StateMismatch> {
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
    if found != expected {
        return Err(StateMismatch::Guid { found, expected });
    }
    let (length, rest) = rest.split_first_chunk::<8>().ok_or_else(short)?;
    let (sum, rest) = rest.split_first_chunk::<8>().ok_or_else(short)?;
    let length = u64::from_le_bytes(*length);
    // A buffer may be longer than the state, never shorter.
    let payload = usize::try_from(length).ok().and_then(|length| rest.get(..length)).ok_or_else(|| {
        let expected = length.saturating_add(HEADER as u64);
        StateMismatch::Length { found: bytes.len() as u64, expected }
    })?;
    if checksum(payload) == u64::from_le_bytes(*sum) { Ok(payload) } else { Err(StateMismatch::Checksum) }
}

/// FNV-1a, 64 bits: guards against damage, not against intent.
fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}
