//! FMI call in progress, recorded in memory that another process can read.

use std::{
    fs::File,
    io::Write,
    sync::{
        OnceLock,
        atomic::{AtomicU64, Ordering},
    },
};

use model_description::{Status, call_table::Function, describe};

/// The words of a [`CallRecord`]: the call in progress (0: none), how many were begun, the last one begun, its
/// arguments, which instance they are made to.
pub const CALL_RECORD_WORDS: usize = 6;

/// Record of the calls of this process.
pub type CallRecord = [AtomicU64; CALL_RECORD_WORDS];

static RECORD: OnceLock<&'static CallRecord> = OnceLock::new();

/// From now on records every call that this process makes; the first record stays.
pub fn record_calls(record: &'static CallRecord) {
    let _ = RECORD.set(record);
}

static LOG: OnceLock<File> = OnceLock::new();

/// From now on writes every recorded call with its answer to a file, a line each; the first file stays.
pub fn log_calls(file: File) {
    let _ = LOG.set(file);
}

/// Writes to the log of calls. A full disk does not end the simulation.
fn log(text: &str) {
    let _ = LOG.get().map(|mut file| file.write_all(text.as_bytes()));
}

/// Logs the answer of the call in progress.
#[inline]
pub(crate) fn log_status(status: Option<Status>) {
    if LOG.get().is_some() {
        log(&status.map_or_else(|| " unknown status".to_owned(), |status| format!(" {status}")));
    }
}

/// The number of a function.
pub(crate) const fn number(function: Function) -> u64 {
    function as u64 + 1
}

/// Loading the shared library, and a heliotorque library's own functions: no functions of the standard.
pub(crate) const LOADING: u64 = Function::ALL.len() as u64 + 1;
pub(crate) const DESCRIBING: u64 = LOADING + 1;
pub(crate) const CHECKING: u64 = LOADING + 2;
const LOADING_TEXT: &str = "loading the shared library";
const DO_STEP: u64 = number(Function::DoStep);

/// From now on calls are recorded as made to this instance, counted from 0; with one alone nothing needs to be said.
#[inline]
pub fn record_instance(number: usize) {
    if let Some([.., instance]) = RECORD.get() {
        instance.store(number as u64 + 1, Ordering::Relaxed);
    }
}

/// A call in progress, until it is dropped.
pub(crate) struct CallInProgress(Option<&'static CallRecord>);

/// Records a call.
#[inline]
pub(crate) fn enter(number: u64) -> CallInProgress {
    enter_with(number, [0.0, 0.0])
}

/// Records a call with its two times in s.
#[inline]
pub(crate) fn enter_with(number: u64, times_s: [f64; 2]) -> CallInProgress {
    let record = RECORD.get().copied();
    if let Some([in_progress, begun, last, first_time, second_time, _]) = record {
        first_time.store(times_s[0].to_bits(), Ordering::Relaxed);
        second_time.store(times_s[1].to_bits(), Ordering::Relaxed);
        last.store(number, Ordering::Relaxed);
        begun.store(begun.load(Ordering::Relaxed).wrapping_add(1), Ordering::Relaxed);
        in_progress.store(number, Ordering::Release);
    }
    if let (Some(record), Some(_)) = (record, LOG.get()) {
        let RecordedCalls { in_progress, instance, .. } = recorded_calls(record);
        let of = instance.map_or_else(String::new, |instance| format!("instance {instance}: "));
        log(&format!("{of}{}", in_progress.unwrap_or_default()));
    }
    CallInProgress(record)
}

impl Drop for CallInProgress {
    #[inline]
    fn drop(&mut self) {
        if let Some([in_progress, ..]) = self.0 {
            in_progress.store(0, Ordering::Release);
            if LOG.get().is_some() {
                log("\n");
            }
        }
    }
}

/// The calls of a [`CallRecord`]; a process that writes over the record may leave any numbers in it.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct RecordedCalls {
    /// The call in progress, with its times.
    pub in_progress: Option<String>,
    /// The call begun last.
    pub last: Option<String>,
    /// The instance, counted from 0, where one was named.
    pub instance: Option<usize>,
}

/// Reads the record of another process.
pub fn recorded_calls(record: &CallRecord) -> RecordedCalls {
    let [in_progress, _, last, first_time, second_time, instance] = record;
    let [first_s, second_s] =
        [first_time, second_time].map(|time| f64::from_bits(time.load(Ordering::Relaxed)));
    let call = |number: u64| match number {
        LOADING => Some(LOADING_TEXT.to_owned()),
        DESCRIBING => Some(describe::SYMBOL.to_owned()),
        CHECKING => Some(describe::CHECK_SCHEDULE_SYMBOL.to_owned()),
        DO_STEP => {
            Some(format!("fmi2DoStep(currentCommunicationPoint={first_s}, communicationStepSize={second_s})"))
        }
        _ => {
            let function = Function::ALL.get(usize::try_from(number).ok()?.checked_sub(1)?)?;
            Some(function.symbol().to_owned())
        }
    };
    RecordedCalls {
        in_progress: call(in_progress.load(Ordering::Acquire)),
        last: call(last.load(Ordering::Relaxed)),
        instance: usize::try_from(instance.load(Ordering::Relaxed)).ok().and_then(|it| it.checked_sub(1)),
    }
}

/// The call in progress: its number, and how many were begun. While both stay, it is the same call.
pub fn call_in_progress(record: &CallRecord) -> Option<(u64, u64)> {
    let [in_progress, begun, ..] = record;
    let number = in_progress.load(Ordering::Acquire);
    (number != 0).then(|| (number, begun.load(Ordering::Relaxed)))
}

/// Begin of the last step, in s.
pub fn step_begin_s(record: &CallRecord) -> Option<f64> {
    let [_, _, last, first_time, ..] = record;
    (last.load(Ordering::Relaxed) == DO_STEP).then(|| f64::from_bits(first_time.load(Ordering::Relaxed)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_of_any_words_is_read() {
        let record = CallRecord::default();
        assert_eq!(recorded_calls(&record), RecordedCalls::default());
        for word in &record {
            word.store(u64::MAX, Ordering::Relaxed);
        }
        assert_eq!(recorded_calls(&record).in_progress, None);
        record[0].store(number(Function::Reset), Ordering::Relaxed);
        assert_eq!(recorded_calls(&record).in_progress.as_deref(), Some("fmi2Reset"));
        record[1].store(7, Ordering::Relaxed);
        assert_eq!(call_in_progress(&record), Some((number(Function::Reset), 7)));
        record[2].store(LOADING, Ordering::Relaxed);
        assert_eq!(recorded_calls(&record).last.as_deref(), Some(LOADING_TEXT));
        record[2].store(DO_STEP, Ordering::Relaxed);
        assert!(recorded_calls(&record).last.is_some_and(|call| call.starts_with("fmi2DoStep(")));
    }
}
