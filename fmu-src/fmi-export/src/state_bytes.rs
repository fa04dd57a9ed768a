//! The header of a saved state: whose it is, how long, and a checksum.
//!
//! Layout, little endian: mark (8), layout version (4), GUID digest (16), payload length (8), checksum of the payload
//! (8), payload.

use core::fmt::Display;

use uuid::Uuid;

use crate::model::Failure;

const MARK: [u8; 8] = *b"FMUSTATE";
const LAYOUT: u32 = 3;
/// Bytes before the payload.
pub(crate) const HEADER: usize = 8 + 4 + 16 + 8 + 8;

/// Why an FMU state is refused: it is well sealed, but its content makes no sense for this model.
pub(crate) fn damaged(what: impl Display) -> Failure {
    Failure::new(format!("the FMU state is damaged: {what}"))
}

/// The refusal of bytes that are cut short.
pub(crate) fn wrong_length(found: usize, expected: u64) -> Failure {
    Failure::new(format!("the FMU state has {found} bytes, expected {expected}"))
}

/// Refuses the state of another model, or of the same model with another setup.
pub(crate) fn check_digest(found: Uuid, expected: Uuid) -> Result<(), Failure> {
    if found == expected {
        return Ok(());
    }
    Err(Failure::new(format!(
        "the FMU state belongs to another model or another setup (GUID digest {found}, expected {expected})"
    )))
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

/// The payload after a valid header of this digest.
pub(crate) fn unsealed(bytes: &[u8], expected: Uuid) -> Result<&[u8], Failure> {
    let short = || wrong_length(bytes.len(), HEADER as u64);
    let (mark, rest) = bytes.split_first_chunk::<8>().ok_or_else(short)?;
    if *mark != MARK {
        return Err(Failure::new(
            "these bytes are no FMU state of this tool: they do not begin with its mark",
        ));
    }
    let (layout, rest) = rest.split_first_chunk::<4>().ok_or_else(short)?;
    let found = u32::from_le_bytes(*layout);
    if found != LAYOUT {
        return Err(Failure::new(format!(
            "the FMU state has layout version {found}, this library reads {LAYOUT}"
        )));
    }
    let (digest, rest) = rest.split_first_chunk::<16>().ok_or_else(short)?;
    check_digest(Uuid::from_bytes(*digest), expected)?;
    let (length, rest) = rest.split_first_chunk::<8>().ok_or_else(short)?;
    let (sum, rest) = rest.split_first_chunk::<8>().ok_or_else(short)?;
    let length = u64::from_le_bytes(*length);
    // A buffer may be longer than the state, never shorter.
    let payload = usize::try_from(length).ok().and_then(|length| rest.get(..length));
    let payload = payload.ok_or_else(|| wrong_length(bytes.len(), length.saturating_add(HEADER as u64)))?;
    match checksum(payload) == u64::from_le_bytes(*sum) {
        true => Ok(payload),
        false => Err(damaged("its checksum does not match")),
    }
}

/// FNV-1a, 64 bits: guards against damage, not against intent.
pub fn checksum(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xCBF2_9CE4_8422_2325, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
    })
}
