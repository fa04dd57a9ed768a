//! Percentiles of all runs over time: numbers of every run in a file of their own until all are there, then a table.

use std::{
    io,
    ops::Range,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

use files::{Destination, Part};
use fmi::csv;
use tables::percentiles;

use crate::PERCENTILES;

/// Numbers that are in memory at once.
const AT_ONCE: usize = 4_000_000;
const BYTES: u64 = 8;

/// The numbers of every run: its record is what they are and a check, so that a record that is not whole is none.
pub(super) struct Series {
    part: Mutex<Part>,
    output: Destination,
    first: u64,
    /// Numbers of a run: a row of every variable at each time.
    per_run: usize,
}

impl Series {
    /// Series of runs from `first` on, next to the table that is made of them.
    ///
    /// # Errors
    /// A file that is an input, cannot be written, or belongs to a different sweep.
    pub(super) fn open(
        output: Destination,
        first: u64,
        per_run: usize,
        inputs: &[&Path],
    ) -> Result<Option<Self>, String> {
        let part = output.part(inputs)?;
        Ok(part.map(|part| Self { part: Mutex::new(part), output, first, per_run }))
    }

    fn place(&self, run: u64) -> u64 {
        (run - self.first) * (self.per_run as u64 + 1) * BYTES
    }

    /// Keeps the records of an earlier sweep, and gives how many of the first `runs` are whole.
    pub(super) fn keep(&self, runs: u64) -> Result<u64, String> {
        let mut part = self.part.lock().unwrap_or_else(PoisonError::into_inner);
        let mut record = vec![0; (self.per_run + 1) * BYTES as usize];
        let is_whole = |at: &u64| {
            let read = part.read_at(self.place(self.first + at), &mut record);
            let (numbers, check) = record.split_at(record.len() - BYTES as usize);
            read.is_ok() && check == check_of(self.first + at, numbers)
        };
        let whole = (0..runs).take_while(is_whole).count() as u64;
        part.keep(whole * (self.per_run as u64 + 1) * BYTES)
            .map_err(|error| format!("{}: {error}", self.output.path().display()))?;
        Ok(whole)
    }

    /// Puts the numbers of a run there; those that it did not come to are NaN.
    pub(super) fn put(&self, run: u64, numbers: &[f64]) -> Result<(), String> {
        let numbers = numbers.iter().copied().chain(std::iter::repeat(f64::NAN)).take(self.per_run);
        let mut bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
        bytes.extend(check_of(run, &bytes));
        self.part.lock().unwrap_or_else(PoisonError::into_inner).write_at(self.place(run), &bytes)
    }

    /// Writes the table and gives the records, which are of no use once the table of runs is complete.
    pub(super) fn finish(self, runs: u64, (names, times_s): (&[&str], &[f64])) -> Result<Part, String> {
        let mut part = self.part.into_inner().unwrap_or_else(PoisonError::into_inner);
        self.output.fill_durably(|to| {
            write!(to, "time")?;
            for name in names {
                for percent in PERCENTILES {
                    write!(to, ",{}", csv::field(&format!("{name}.p{percent}")))?;
                }
            }
            writeln!(to)?;
            // Whole rows of all runs at a time.
            let rows_at_once = (AT_ONCE / (runs as usize * names.len()).max(1)).max(1);
            for (chunk, times_s) in times_s.chunks(rows_at_once).enumerate() {
                let at = chunk * rows_at_once * names.len();
                let all = read_runs(&mut part, runs, self.per_run, at..at + times_s.len() * names.len())?;
                for (row, time_s) in times_s.iter().enumerate() {
                    write!(to, "{}", csv::Real(*time_s))?;
                    for variable in 0..names.len() {
                        let of_run = |run: &Vec<f64>| run[row * names.len() + variable];
                        let mut values: Vec<f64> = all.iter().map(of_run).filter(|it| !it.is_nan()).collect();
                        for percentile in percentiles(&mut values, PERCENTILES) {
                            write!(to, ",{}", csv::Real(percentile))?;
                        }
                    }
                    writeln!(to)?;
                }
            }
            Ok(())
        })?;
        Ok(part)
    }
}

/// Check of a run's numbers: their hash by Fowler, Noll and Vo (FNV-1a), which begins with the run.
fn check_of(run: u64, numbers: &[u8]) -> [u8; BYTES as usize] {
    let bytes = run.to_le_bytes();
    let hash = bytes.iter().chain(numbers).fold(0xcbf2_9ce4_8422_2325_u64, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    });
    hash.to_le_bytes()
}

/// A range of the numbers of every run.
fn read_runs(part: &mut Part, runs: u64, per_run: usize, range: Range<usize>) -> io::Result<Vec<Vec<f64>>> {
    let mut bytes = vec![0; range.len() * BYTES as usize];
    (0..runs)
        .map(|run| {
            part.read_at((run * (per_run as u64 + 1) + range.start as u64) * BYTES, &mut bytes)?;
            let numbers = bytes.chunks_exact(BYTES as usize);
            Ok(numbers.map(|it| it.try_into().map_or(f64::NAN, f64::from_le_bytes)).collect())
        })
        .collect()
}

/// The table of percentiles beside the one of runs: runs-percentiles.csv.
pub(super) fn percentiles_path(output: &Path) -> PathBuf {
    let stem = output.file_stem().unwrap_or_default().to_string_lossy();
    let extension = output.extension().map_or_else(String::new, |it| format!(".{}", it.to_string_lossy()));
    output.with_file_name(format!("{stem}-percentiles{extension}"))
}
