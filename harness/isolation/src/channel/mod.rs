//! The memory that parent and child share: a header, the record of calls, and a ring of words with frames.
//!
//! A frame is its kind and length, the token that the parent gave, and the payload. The parent checks all three, for
//! the FMU runs in the child's memory and may write anywhere.

use std::{
    hash::{BuildHasher, Hasher, RandomState},
    io,
    sync::atomic::{AtomicU64, Ordering},
    time::Duration,
};

use fmi::{CALL_RECORD_WORDS, CallRecord, SharedWords};

use super::system;

/// The parent's token, its process, the child's limits (0: none), whether it shall end.
const TOKEN: usize = 0;
const PARENT: usize = 1;
const MEMORY: usize = 2;
const FILES: usize = 3;
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
/// Fault of a frame that was not requested.
pub const NOT_REQUESTED: &str = "it sent what was not requested";
/// Longest payload; a row of a million Reals fits.
const MAX_WORDS: usize = 1 << 21;
/// How often a child checks whether a full ring has space again, and how much has to be free before it continues.
const PAUSE: Duration = Duration::from_millis(1);
const FREE_WORDS: u64 = RING_WORDS as u64 / 4;

/// The child's end.
pub struct Link {
    words: &'static SharedWords,
    token: u64,
    head: u64,
    frame: Vec<u64>,
}

impl Link {
    /// Takes the memory that the parent gave as standard input, keeps the parent's limits and ends with the parent.
    /// `command` is what starts such a child.
    pub fn attach(command: &str) -> Result<Self, String> {
        Self::attached().map_err(|error| format!("`{command}` starts this: {error}"))
    }

    fn attached() -> io::Result<Self> {
        let file = system::take_stdin()?;
        // For the life of the process: the record of calls is read from anywhere.
        let words: &'static SharedWords = Box::leak(Box::new(SharedWords::map(&file)?));
        drop(file);
        if words.len() != RING + RING_WORDS {
            return Err(io::Error::other("the standard input is not that of a parent"));
        }
        let value = |index: usize| words[index].load(Ordering::Relaxed);
        system::end_with_parent(value(PARENT))?;
        system::restrict(value(MEMORY), value(FILES))?;
        if let Ok(calls) = <&CallRecord>::try_from(&words[CALLS..CALLS + CALL_RECORD_WORDS]) {
            fmi::record_calls(calls);
        }
        // Where no instruction of the FMU runs yet, nobody else reads the token.
        let token = words[TOKEN].swap(0, Ordering::Relaxed);
        Ok(Self { words, token, head: 0, frame: Vec::new() })
    }

    /// The word by which the parent requests the child's end: other than 0.
    pub fn cancel_word(&self) -> &'static AtomicU64 {
        &self.words[CANCEL]
    }

    fn free(&self) -> u64 {
        let used = self.head.wrapping_sub(self.words[TAIL].load(Ordering::Acquire));
        (RING_WORDS as u64).saturating_sub(used)
    }

    /// Sends a frame; waits while the ring is full.
    pub fn send(&mut self, kind: u8, payload: impl FnOnce(&mut Vec<u64>)) -> Result<(), String> {
        let mut frame = std::mem::take(&mut self.frame);
        frame.clear();
        frame.extend([0, self.token]);
        payload(&mut frame);
        let length = frame.len() - 2;
        if length > MAX_WORDS {
            return Err(format!("a row or text of {length} words, allowed are {MAX_WORDS}"));
        }
        frame[0] = u64::from(kind) | (length as u64) << 8;
        let ring = &self.words[RING..];
        let mut rest = frame.as_slice();
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
                word.store(*value, Ordering::Relaxed);
            }
            rest = &rest[count..];
            self.head = self.head.wrapping_add(count as u64);
            self.words[HEAD].store(self.head, Ordering::Release);
        }
        self.frame = frame;
        Ok(())
    }
}

/// Appends a text to a payload.
pub fn push_text(payload: &mut Vec<u64>, text: &str) {
    push_bytes(payload, text.as_bytes());
}

/// Appends bytes to a payload.
pub(super) fn push_bytes(payload: &mut Vec<u64>, bytes: &[u8]) {
    payload.push(bytes.len() as u64);
    payload.extend(bytes.chunks(8).map(|chunk| {
        let mut bytes = [0; 8];
        bytes[..chunk.len()].copy_from_slice(chunk);
        u64::from_le_bytes(bytes)
    }));
}

/// A payload, read from its beginning on.
pub struct Payload<'a>(&'a [u64]);

impl<'a> Payload<'a> {
    /// The next word.
    pub fn word(&mut self) -> Option<u64> {
        let (first, rest) = self.0.split_first()?;
        self.0 = rest;
        Some(*first)
    }

    /// The next words.
    pub fn words(&mut self, count: usize) -> Option<&'a [u64]> {
        let (words, rest) = self.0.split_at_checked(count)?;
        self.0 = rest;
        Some(words)
    }

    /// The next text.
    pub fn text(&mut self) -> Option<String> {
        Some(String::from_utf8_lossy(&self.bytes()?).into_owned())
    }

    /// The next bytes.
    pub fn bytes(&mut self) -> Option<Vec<u8>> {
        let length = usize::try_from(self.word()?).ok()?;
        let words = self.words(length.div_ceil(8))?;
        Some(words.iter().flat_map(|word| word.to_le_bytes()).take(length).collect())
    }

    /// Whether everything was read.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

/// The parent's end.
pub(super) struct Inbox {
    words: SharedWords,
    token: u64,
    tail: u64,
    // The frame that comes in: its head, then its payload.
    frame: Vec<u64>,
}

impl Inbox {
    /// The memory, and the file to hand to the child; limits in bytes and files.
    pub(super) fn create(memory: Option<u64>, files: Option<u64>) -> io::Result<(std::fs::File, Self)> {
        let (file, words) = SharedWords::create(RING + RING_WORDS)?;
        let token = RandomState::new().build_hasher().finish();
        let head = [
            (TOKEN, token),
            (PARENT, u64::from(std::process::id())),
            (MEMORY, memory.unwrap_or(0)),
            (FILES, files.unwrap_or(0)),
        ];
        for (index, value) in head {
            words[index].store(value, Ordering::Relaxed);
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
    pub(super) fn drain(
        &mut self,
        take: &mut dyn FnMut(u8, Payload<'_>) -> Result<(), String>,
    ) -> Result<usize, String> {
        const BROKEN: &str = "it wrote over the memory that carries its results";
        let head = self.words[HEAD].load(Ordering::Acquire);
        let came = head.wrapping_sub(self.tail);
        if came > RING_WORDS as u64 {
            return Err(BROKEN.to_owned());
        }
        let mut left = came as usize;
        while left > 0 {
            let expected = match self.frame.first() {
                Some(head) => 2 + (head >> 8) as usize - self.frame.len(),
                None => 1,
            };
            let at = (self.tail % RING_WORDS as u64) as usize;
            let count = expected.min(left).min(RING_WORDS - at);
            let part = &self.words[RING + at..RING + at + count];
            self.frame.extend(part.iter().map(|word| word.load(Ordering::Relaxed)));
            self.tail = self.tail.wrapping_add(count as u64);
            left -= count;
            if let [head, ..] = self.frame.as_slice()
                && head >> 8 > MAX_WORDS as u64
            {
                return Err(BROKEN.to_owned());
            }
            if let [head, token, payload @ ..] = self.frame.as_slice()
                && payload.len() as u64 == head >> 8
            {
                if *token != self.token {
                    return Err(BROKEN.to_owned());
                }
                take((head & 0xff) as u8, Payload(payload))?;
                self.frame.clear();
                // The child may continue while the rest is taken.
                self.words[TAIL].store(self.tail, Ordering::Release);
            }
        }
        self.words[TAIL].store(self.tail, Ordering::Release);
        Ok(came as usize)
    }
}

#[cfg(test)]
mod tests;
