//! The memory that parent and child share: a header, the record of calls, and a ring of words: first with the request, then with frames.
//!
//! A frame is its length in bytes, the token that the parent gave, and what postcard makes of it, padded to whole words. The parent
//! checks all three, for the FMU runs in the child's memory and may write anywhere.

use std::{
    hash::{BuildHasher, Hasher, RandomState},
    io,
    sync::atomic::{AtomicU64, Ordering},
    time::Duration,
};

use fmi::{CALL_RECORD_WORDS, CallRecord, SharedWords};
use serde::{Deserialize, Serialize};
use terminal::Screen;

use super::{
    frame::{Frame, NOT_REQUESTED, Request},
    limits::ResourceLimits,
    system,
};

/// The parent's token, length of the request in bytes, whether the child shall end.
const TOKEN: usize = 0;
const REQUEST: usize = 1;
const CANCEL: usize = 8;
/// The record of calls.
const CALLS: usize = 16;
/// Words sent and words taken; far apart, so that the two processes do not wait for one cache line.
const HEAD: usize = 32;
const TAIL: usize = 48;
/// The ring.
const RING: usize = 64;
/// 4 MiB: the rows of some milliseconds.
pub(super) const RING_WORDS: usize = 1 << 19;
const WORD: usize = size_of::<u64>();
/// Words of a frame before its content.
const FRAME_HEAD: usize = 2;
/// Longest content in bytes; a row of a million Reals fits.
const MAX_BYTES: usize = 1 << 24;
/// How often a child checks whether a full ring has space again, and how much has to be free before it continues.
const PAUSE: Duration = Duration::from_millis(1);
const FREE_WORDS: u64 = RING_WORDS as u64 / 4;

/// Start of a child: its parent's process, its limits, the parent's screen, its task.
#[derive(Serialize, Deserialize)]
struct Start {
    parent: u32,
    limits: ResourceLimits,
    screen: Screen,
    request: Request,
}

/// The child's end.
pub struct Link {
    words: &'static SharedWords,
    token: u64,
    head: u64,
    bytes: Vec<u8>,
    pub(super) screen: Screen,
}

/// Takes the memory that the parent gave as standard input, keeps the parent's limits and ends with the parent.
///
/// # Errors
/// A standard input of something else: such a process is started by another one of the program.
pub fn attach() -> Result<(Link, Request), String> {
    attached().map_err(|error| format!("a parent process starts this: {error}"))
}

fn attached() -> io::Result<(Link, Request)> {
    let file = system::take_stdin()?;
    // For the life of the process: the record of calls is read from anywhere.
    let words: &'static SharedWords = Box::leak(Box::new(SharedWords::map(&file)?));
    drop(file);
    if words.len() != RING + RING_WORDS {
        return Err(io::Error::other("the standard input is not that of a parent"));
    }
    let length = words[REQUEST].load(Ordering::Relaxed) as usize;
    let request = words[RING..].iter().take(length.div_ceil(WORD));
    let bytes: Vec<u8> = request.flat_map(|word| word.load(Ordering::Relaxed).to_le_bytes()).collect();
    let start = bytes.get(..length).and_then(|bytes| postcard::from_bytes(bytes).ok());
    let Start { parent, limits, screen, request } =
        start.ok_or_else(|| io::Error::other("the standard input holds no request"))?;
    system::end_with_parent(parent)?;
    system::restrict(limits)?;
    if let Ok(calls) = <&CallRecord>::try_from(&words[CALLS..CALLS + CALL_RECORD_WORDS]) {
        fmi::record_calls(calls);
    }
    // Where no instruction of the FMU runs yet, nobody else reads the token.
    let token = words[TOKEN].swap(0, Ordering::Relaxed);
    Ok((Link { words, token, head: 0, bytes: Vec::new(), screen }, request))
}

impl Link {
    /// The word by which the parent requests the child's end: other than 0.
    pub fn cancel_word(&self) -> &'static AtomicU64 {
        &self.words[CANCEL]
    }

    fn free(&self) -> u64 {
        let used = self.head.wrapping_sub(self.words[TAIL].load(Ordering::Acquire));
        (RING_WORDS as u64).saturating_sub(used)
    }

    /// Sends a frame; waits while the ring is full.
    ///
    /// # Errors
    /// A frame that is too long.
    pub fn send(&mut self, frame: &Frame<'_>) -> Result<(), String> {
        let mut bytes = std::mem::take(&mut self.bytes);
        bytes.clear();
        bytes.extend([[0; WORD], self.token.to_le_bytes()].as_flattened());
        let mut bytes = postcard::to_extend(frame, bytes).map_err(|error| error.to_string())?;
        let length = bytes.len() - FRAME_HEAD * WORD;
        if length > MAX_BYTES {
            return Err(format!("a row or text of {length} bytes, allowed are {MAX_BYTES}"));
        }
        bytes[..WORD].copy_from_slice(&(length as u64).to_le_bytes());
        bytes.resize(bytes.len().next_multiple_of(WORD), 0);
        let ring = &self.words[RING..];
        let (mut rest, _) = bytes.as_chunks::<WORD>();
        while !rest.is_empty() {
            let at = (self.head % RING_WORDS as u64) as usize;
            let count = (self.free() as usize).min(rest.len()).min(RING_WORDS - at);
            if count == 0 {
                while self.free() < FREE_WORDS {
                    std::thread::sleep(PAUSE);
                }
                continue;
            }
            for (word, value) in ring[at..at + count].iter().zip(rest) {
                word.store(u64::from_le_bytes(*value), Ordering::Relaxed);
            }
            rest = &rest[count..];
            self.head = self.head.wrapping_add(count as u64);
            self.words[HEAD].store(self.head, Ordering::Release);
        }
        self.bytes = bytes;
        Ok(())
    }
}

/// The parent's end.
pub(super) struct Inbox {
    words: SharedWords,
    token: u64,
    tail: u64,
    // The frame that comes in: its head, then its content.
    frame: Vec<u8>,
}

impl Inbox {
    /// The memory with the child's request and limits, and the file to hand to the child.
    ///
    /// # Errors
    /// No such memory; a request longer than it.
    pub(super) fn create(request: Request, limits: ResourceLimits) -> io::Result<(std::fs::File, Self)> {
        let (file, words) = SharedWords::create(RING + RING_WORDS)?;
        let token = RandomState::new().build_hasher().finish();
        let screen = terminal::screen();
        let start = Start { parent: std::process::id(), limits, screen, request };
        let mut bytes = postcard::to_stdvec(&start).map_err(io::Error::other)?;
        words[TOKEN].store(token, Ordering::Relaxed);
        words[REQUEST].store(bytes.len() as u64, Ordering::Relaxed);
        bytes.resize(bytes.len().next_multiple_of(WORD), 0);
        let (values, _) = bytes.as_chunks::<WORD>();
        if values.len() > RING_WORDS {
            return Err(io::Error::other("the arguments are too long"));
        }
        for (word, value) in words[RING..].iter().zip(values) {
            word.store(u64::from_le_bytes(*value), Ordering::Relaxed);
        }
        Ok((file, Self { words, token, tail: 0, frame: Vec::new() }))
    }

    /// Requests the child's end.
    pub(super) fn cancel(&self) {
        self.words[CANCEL].store(1, Ordering::Relaxed);
    }

    /// The record of calls.
    pub(super) fn calls(&self) -> Option<&CallRecord> {
        <&CallRecord>::try_from(&self.words[CALLS..CALLS + CALL_RECORD_WORDS]).ok()
    }

    /// Hands every frame that has come to `take`, whose error ends it; gives the number of words that came.
    ///
    /// # Errors
    /// Memory that the child wrote over; a frame that is none.
    pub(super) fn drain(
        &mut self,
        take: &mut dyn FnMut(Frame<'_>) -> Result<(), String>,
    ) -> Result<usize, String> {
        const BROKEN: &str = "it wrote over the memory that carries its results";
        let head = self.words[HEAD].load(Ordering::Acquire);
        let came = head.wrapping_sub(self.tail);
        if came > RING_WORDS as u64 {
            return Err(BROKEN.to_owned());
        }
        let mut left = came as usize;
        while left > 0 {
            let whole = match self.frame.first_chunk() {
                Some(length) => FRAME_HEAD + content_bytes(length).ok_or(BROKEN)?.div_ceil(WORD),
                None => 1,
            };
            let at = (self.tail % RING_WORDS as u64) as usize;
            let count = (whole - self.frame.len() / WORD).min(left).min(RING_WORDS - at);
            let from = self.frame.len();
            self.frame.resize(from + count * WORD, 0);
            let (places, _) = self.frame[from..].as_chunks_mut();
            for (place, word) in places.iter_mut().zip(&self.words[RING + at..]) {
                *place = word.load(Ordering::Relaxed).to_le_bytes();
            }
            self.tail = self.tail.wrapping_add(count as u64);
            left -= count;
            let ([length, token, ..], _) = self.frame.as_chunks::<WORD>() else { continue };
            let length = content_bytes(length).ok_or(BROKEN)?;
            if self.frame.len() / WORD < FRAME_HEAD + length.div_ceil(WORD) {
                continue;
            }
            if *token != self.token.to_le_bytes() {
                return Err(BROKEN.to_owned());
            }
            let content = &self.frame[FRAME_HEAD * WORD..][..length];
            match postcard::take_from_bytes(content) {
                Ok((frame, [])) => take(frame)?,
                _ => return Err(NOT_REQUESTED.to_owned()),
            }
            self.frame.clear();
            // The child may continue while the rest is taken.
            self.words[TAIL].store(self.tail, Ordering::Release);
        }
        self.words[TAIL].store(self.tail, Ordering::Release);
        Ok(came as usize)
    }
}

/// Length of a frame's content, in bytes; `None` for one beyond all measure.
fn content_bytes(word: &[u8; WORD]) -> Option<usize> {
    usize::try_from(u64::from_le_bytes(*word)).ok().filter(|bytes| *bytes <= MAX_BYTES)
}

#[cfg(test)]
mod tests;
