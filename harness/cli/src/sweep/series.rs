//! Percentiles of all runs over time: numbers of every run in a file of their own until all are there, then a table.

use std::{
    fs::{self, File, OpenOptions},
    io::{self, Read, Seek, SeekFrom, Write},
    ops::Range,
    path::{Path, PathBuf},
    sync::{Mutex, PoisonError},
};

use campaign::{PERCENTILES, percentiles};
use files::Destination;
use loader::csv;

/// Numbers that are in memory at once.
const AT_ONCE: usize = 4_000_000;
const BYTES: u64 = 8;

/// The numbers of every run.
pub(super) struct Series {
    path: PathBuf,
    file: Mutex<File>,
    first: u64,
    /// Numbers of a run: a row of every variable at each time.
    per_run: usize,
}

impl Series {
    /// Opens the file; what it holds of runs before stays.
    pub(super) fn open(
        path: PathBuf,
        runs: &Range<u64>,
        per_run: usize,
        keeps: bool,
    ) -> Result<Self, String> {
        let mut options = OpenOptions::new();
        let file = options.read(true).write(true).create(true).truncate(!keeps).open(&path);
        let file = file.map_err(|error| format!("{}: {error}", path.display()))?;
        Ok(Self { path, file: Mutex::new(file), first: runs.start, per_run })
    }

    /// Puts the numbers of a run there; those that it did not come to are NaN.
    pub(super) fn put(&self, run: u64, numbers: &[f64]) -> Result<(), String> {
        let numbers = numbers.iter().copied().chain(std::iter::repeat(f64::NAN)).take(self.per_run);
        let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
        let place = (run - self.first) * self.per_run as u64 * BYTES;
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let written = file.seek(SeekFrom::Start(place)).and_then(|_| file.write_all(&bytes));
        written.map_err(|error| format!("{}: {error}", self.path.display()))
    }

    /// Writes the table and removes the file.
    pub(super) fn finish(
        self,
        runs: u64,
        (names, times_s): (&[&str], &[f64]),
        output: Destination,
    ) -> Result<(), String> {
        let mut file = self.file.into_inner().unwrap_or_else(PoisonError::into_inner);
        output.fill(|to| {
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
                let all = read_runs(&mut file, runs, self.per_run, at..at + times_s.len() * names.len())?;
                for (row, time_s) in times_s.iter().enumerate() {
                    write!(to, "{}", csv::Real(*time_s))?;
                    for variable in 0..names.len() {
                        let of_run = |run: &Vec<f64>| run[row * names.len() + variable];
                        let mut values: Vec<f64> = all.iter().map(of_run).filter(|it| !it.is_nan()).collect();
                        for percentile in percentiles(&mut values) {
                            write!(to, ",{}", csv::Real(percentile))?;
                        }
                    }
                    writeln!(to)?;
                }
            }
            Ok(())
        })?;
        fs::remove_file(&self.path).map_err(|error| format!("{}: {error}", self.path.display()))
    }
}

/// A range of the numbers of every run.
fn read_runs(file: &mut File, runs: u64, per_run: usize, range: Range<usize>) -> io::Result<Vec<Vec<f64>>> {
    let mut bytes = vec![0; range.len() * BYTES as usize];
    (0..runs)
        .map(|run| {
            file.seek(SeekFrom::Start((run * per_run as u64 + range.start as u64) * BYTES))?;
            file.read_exact(&mut bytes)?;
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
