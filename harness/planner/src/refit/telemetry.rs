//! The history of momentum that is fitted: a CSV with time, momentum and, if there is one, the count of dumps; its other columns are not
//! read.

use std::path::Path;

use nalgebra::Vector3;

use crate::Failure;

const TIME: &str = "time";
/// Total momentum, EME2000, in N m s.
pub const MOMENTUM: [&str; 3] = ["momentum.inertial[1]", "momentum.inertial[2]", "momentum.inertial[3]"];
const DUMPS: &str = "dump.count";
const ALLOWED: &str = "time, momentum.inertial[1], [2], [3], and dump.count where dumps fall";

/// Rows of a history; each arc between dumps has a start momentum of its own.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Telemetry {
    /// In s of simulation time; they grow.
    pub times_s: Vec<f64>,
    /// EME2000, in N m s.
    pub momentum_inertial_n_m_s: Vec<Vector3<f64>>,
    /// Dumps so far.
    pub dumps: Vec<i32>,
    /// Line of the file by row, from 1.
    pub lines: Vec<u64>,
}

/// Positions of the columns that are read.
struct Columns {
    time: usize,
    momentum: [usize; 3],
    dumps: Option<usize>,
    names: Vec<String>,
}

impl Columns {
    fn new(names: Vec<String>) -> Result<Self, String> {
        let is_read = |name: &str| name == TIME || name == DUMPS || MOMENTUM.contains(&name);
        let mut read = names.iter().enumerate().filter(|(_, name)| is_read(name));
        if let Some((_, twice)) = read.find(|(at, name)| names[..*at].contains(name)) {
            return Err(format!("found the column {twice} twice, allowed: once"));
        }
        let position = |name: &str| names.iter().position(|it| it == name);
        let required =
            |name: &str| position(name).ok_or_else(|| format!("found no column {name}, allowed: {ALLOWED}"));
        let [x, y, z] = MOMENTUM.map(required);
        Ok(Self { time: required(TIME)?, momentum: [x?, y?, z?], dumps: position(DUMPS), names })
    }
}

impl Telemetry {
    /// Reads a table; lines that begin with `#` are comments.
    ///
    /// # Errors
    /// Columns that are missing or there twice, cells that are missing or no finite numbers, times that do not grow, a count of dumps that falls; by line.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let file = path.display().to_string();
        let failed = |error: &dyn std::fmt::Display| format!("{file}: {error}: see --telemetry");
        let opened = files::open_at_most(path, files::MAX_TABLE_BYTES).map_err(|error| failed(&error))?;
        // A row with fewer cells than the header is a gap, reported with its column.
        let mut reader = csv::ReaderBuilder::new()
            .comment(Some(b'#'))
            .flexible(true)
            .trim(csv::Trim::All)
            .from_reader(opened);
        let header = reader.headers().map_err(|error| failed(&error))?;
        let line = header.position().map_or(1, csv::Position::line);
        let columns = Columns::new(header.iter().map(str::to_owned).collect())
            .map_err(|what| format!("{file}:{line}: {what}"))?;
        let mut telemetry = Self::default();
        for record in reader.records() {
            let record = record.map_err(|error| failed(&error))?;
            let line = record.position().map_or(0, csv::Position::line);
            telemetry.push(&columns, &record, line).map_err(|what| format!("{file}:{line}: {what}"))?;
        }
        telemetry.check_count(&file)?;
        Ok(telemetry)
    }

    fn push(&mut self, columns: &Columns, record: &csv::StringRecord, line: u64) -> Result<(), String> {
        let name = |column: usize| &columns.names[column];
        if record.len() > columns.names.len() {
            let [found, allowed] = [record.len(), columns.names.len()];
            return Err(format!("found {found} cells, allowed: {allowed}, one for each column"));
        }
        let number = |column: usize| -> Result<f64, String> {
            let cell = record.get(column).unwrap_or_default();
            if cell.is_empty() {
                return Err(format!(
                    "{}: found nothing, allowed: a number in every row; a time without a value has no row",
                    name(column)
                ));
            }
            cell.parse::<f64>()
                .ok()
                .filter(|value| value.is_finite())
                .ok_or_else(|| format!("{}: found {cell:?}, allowed: a finite number", name(column)))
        };
        let time_s = number(columns.time)?;
        if let Some(before_s) = self.times_s.last().filter(|before_s| time_s <= **before_s) {
            return Err(format!(
                "time: found {time_s} s after {before_s} s, allowed: times that grow from row to row"
            ));
        }
        let [x, y, z] = columns.momentum.map(number);
        let momentum_inertial_n_m_s = Vector3::new(x?, y?, z?);
        let dumps = match columns.dumps {
            None => 0,
            Some(column) => {
                let count = number(column)?;
                let whole = (count.fract() == 0.0 && (0.0..=f64::from(i32::MAX)).contains(&count))
                    .then_some(count as i32);
                let count =
                    whole.ok_or_else(|| format!("{DUMPS}: found {count}, allowed: a whole number from 0"))?;
                match self.dumps.last() {
                    Some(before) if count < *before => {
                        let allowed = "a count that stays or rises";
                        return Err(format!("{DUMPS}: found {count} after {before}, allowed: {allowed}"));
                    }
                    _ => count,
                }
            }
        };
        self.times_s.push(time_s);
        self.momentum_inertial_n_m_s.push(momentum_inertial_n_m_s);
        self.dumps.push(dumps);
        self.lines.push(line);
        Ok(())
    }

    /// Two rows more than arcs are six numbers more than start momenta, for four parameters.
    fn check_count(&self, file: &str) -> Result<(), String> {
        let arcs = arcs(&[&self.dumps]);
        let (rows, count) = (self.times_s.len(), arcs.len());
        if rows >= count + MIN_ROWS {
            return Ok(());
        }
        let of_arcs = if count == 1 { "1 arc".to_owned() } else { format!("{count} arcs") };
        Err(format!(
            "{file}: found {rows} rows in {of_arcs} between dumps, allowed: at least {MIN_ROWS} rows more than arcs"
        ))
    }
}

/// Rows that a history has beyond one for each arc, at least.
pub(super) const MIN_ROWS: usize = 2;

/// Rows of each arc; one ends where any of the counts rises.
pub(super) fn arcs(counts: &[&Vec<i32>]) -> Vec<std::ops::Range<usize>> {
    let rows = counts.iter().map(|counts| counts.len()).min().unwrap_or(0);
    let begins = |row: &usize| *row == 0 || counts.iter().any(|counts| counts[*row] != counts[*row - 1]);
    let starts: Vec<usize> = (0..rows).filter(begins).collect();
    let ends = starts.iter().skip(1).copied().chain([rows]);
    starts.iter().copied().zip(ends).map(|(start, end)| start..end).collect()
}
