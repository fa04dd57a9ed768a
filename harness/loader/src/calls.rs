//! Which FMI call is under way, told to whoever watches this process from outside.

use std::sync::{
    OnceLock,
    atomic::{AtomicU64, Ordering},
};

use crate::SYMBOLS;

/// The words of a [`CallMark`]: the call under way (0: none), how many were begun, the last one begun, its arguments.
pub const MARK_WORDS: usize = 5;

/// What is done to a library beside calling the standard's functions.
const OTHERS: [&str; 1] = ["loading the shared library"];

/// Where the calls of this process are marked.
pub type CallMark = [AtomicU64; MARK_WORDS];

static MARK: OnceLock<&'static CallMark> = OnceLock::new();

/// From now on marks every call that this process makes; the first mark stays.
pub fn mark_calls(mark: &'static CallMark) {
    let _ = MARK.set(mark);
}

/// The number of a symbol; a name that there is not does not compile.
pub(crate) const fn number(symbol: &str) -> u64 {
    let mut at = 0;
    while at < SYMBOLS.len() {
        if is_same(SYMBOLS[at], symbol) {
            return at as u64 + 1;
        }
        at += 1;
    }
    assert!(is_same(symbol, OTHERS[0]), "no such call");
    SYMBOLS.len() as u64 + 1
}

const fn is_same(one: &str, two: &str) -> bool {
    let (one, two) = (one.as_bytes(), two.as_bytes());
    let mut at = 0;
    while at < one.len() && at < two.len() && one[at] == two[at] {
        at += 1;
    }
    at == one.len() && at == two.len()
}

/// Loading the library.
pub(crate) const LOADING: u64 = number(OTHERS[0]);
const DO_STEP: u64 = number("fmi2DoStep");

/// A call under way, until it is dropped.
pub(crate) struct UnderWay(Option<&'static CallMark>);

/// Marks a call.
#[inline]
pub(crate) fn enter(number: u64) -> UnderWay {
    enter_with(number, [0.0, 0.0])
}

/// Marks a call with its two times in s.
#[inline]
pub(crate) fn enter_with(number: u64, times_s: [f64; 2]) -> UnderWay {
    let mark = MARK.get().copied();
    if let Some([under_way, begun, last, first_time, second_time]) = mark {
        first_time.store(times_s[0].to_bits(), Ordering::Relaxed);
        second_time.store(times_s[1].to_bits(), Ordering::Relaxed);
        last.store(number, Ordering::Relaxed);
        begun.store(begun.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
        under_way.store(number, Ordering::Release);
    }
    UnderWay(mark)
}

impl Drop for UnderWay {
    #[inline]
    fn drop(&mut self) {
        if let Some([under_way, ..]) = self.0 {
            under_way.store(0, Ordering::Release);
        }
    }
}

/// What a mark says; its numbers may be anything.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Marked {
    /// The call under way, with its times.
    pub under_way: Option<String>,
    /// The call begun last.
    pub last: Option<String>,
}

/// Reads the mark of another process.
pub fn read_mark(mark: &CallMark) -> Marked {
    let [under_way, _, last, first_time, second_time] = mark;
    let [first_s, second_s] =
        [first_time, second_time].map(|time| f64::from_bits(time.load(Ordering::Relaxed)));
    let call = |number: u64| {
        let index = usize::try_from(number).ok()?.checked_sub(1)?;
        let name = *SYMBOLS.iter().chain(&OTHERS).nth(index)?;
        Some(if number == DO_STEP {
            format!("{name}(currentCommunicationPoint={first_s}, communicationStepSize={second_s})")
        } else {
            name.to_owned()
        })
    };
    Marked { under_way: call(under_way.load(Ordering::Acquire)), last: call(last.load(Ordering::Relaxed)) }
}

/// The call under way: its number, and how many were begun. While both stay, it is the same call.
pub fn call_under_way(mark: &CallMark) -> Option<(u64, u64)> {
    let [under_way, begun, ..] = mark;
    let number = under_way.load(Ordering::Acquire);
    (number != 0).then(|| (number, begun.load(Ordering::Relaxed)))
}

/// Where the last step begins, in s.
pub fn step_begin_s(mark: &CallMark) -> Option<f64> {
    let [_, _, last, first_time, _] = mark;
    (last.load(Ordering::Relaxed) == DO_STEP).then(|| f64::from_bits(first_time.load(Ordering::Relaxed)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_names_the_call_whatever_stands_in_it() {
        let mark = CallMark::default();
        assert_eq!(read_mark(&mark), Marked::default());
        for word in &mark {
            word.store(u64::MAX, Ordering::Relaxed);
        }
        assert_eq!(read_mark(&mark).under_way, None);
        mark[0].store(number("fmi2Reset"), Ordering::Relaxed);
        assert_eq!(read_mark(&mark).under_way.as_deref(), Some("fmi2Reset"));
        mark[1].store(7, Ordering::Relaxed);
        assert_eq!(call_under_way(&mark), Some((number("fmi2Reset"), 7)));
        mark[2].store(LOADING, Ordering::Relaxed);
        assert_eq!(read_mark(&mark).last.as_deref(), Some(OTHERS[0]));
    }
}
