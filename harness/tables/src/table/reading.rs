//! A CSV with a first column of numbers that do not fall: times in s, numbers of runs, whatever they are.

use std::{
    collections::BTreeSet,
    io::{BufRead, BufReader, Seek, SeekFrom},
    path::{Path, PathBuf},
};

use csv::{Position, ReaderBuilder, StringRecord, Trim};
use fmi::reference::Cell;
use model_description::{Description, ScalarVariable, names::similar};

/// Name of a first column of times in s.
pub const TIME: &str = "time";
/// Largest table that is read, in bytes: its cells take twice that in memory.
const MAX_BYTES: u64 = 512 << 20;

/// A table by columns.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Table {
    /// The file.
    pub path: PathBuf,
    /// Name of the first column.
    pub key: String,
    /// The first column, which does not fall.
    pub keys: Vec<f64>,
    /// Names of the others.
    pub names: Vec<String>,
    /// The others, each as long as the first.
    pub columns: Vec<Vec<Cell>>,
}

impl Table {
    /// Reads a table; lines that begin with `#` are comments.
    ///
    /// # Errors
    /// What is no table: a column named twice, no row, a row of another length than the header, a first cell that is no number or
    /// that falls; by file, line and column.
    pub fn read(path: &Path) -> Result<Self, String> {
        let file = path.display();
        let failed = |error: &dyn std::fmt::Display| format!("{file}: {error}");
        let opened = files::open_at_most(path, MAX_BYTES).map_err(|error| failed(&error))?;
        let mut reader = ReaderBuilder::new()
            .has_headers(false)
            .comment(Some(b'#'))
            .flexible(true)
            .trim(Trim::All)
            .from_reader(opened);
        let mut table = Self { path: path.to_owned(), ..Self::default() };
        for (row, record) in reader.records().enumerate() {
            let record = record.map_err(|error| match error.kind() {
                csv::ErrorKind::Utf8 { pos: Some(at), .. } => {
                    format!(
                        "{file}:{}: found bytes that are not UTF-8, allowed: UTF-8",
                        line_of(path, Some(at))
                    )
                }
                _ => failed(&error),
            })?;
            let read = if row == 0 { table.begin(&record) } else { table.push(&record) };
            read.map_err(|what| format!("{file}:{}: {what}", line_of(path, record.position())))?;
        }
        match table.keys.len() {
            0 => Err(failed(&"found no row, allowed: a header and at least one row of numbers")),
            _ => Ok(table),
        }
    }

    fn begin(&mut self, record: &StringRecord) -> Result<(), String> {
        let mut names = record.iter().map(str::to_owned);
        // Tables of some programs begin with a mark of their encoding.
        self.key = names.next().unwrap_or_default().trim_start_matches('\u{feff}').to_owned();
        self.names = names.collect();
        let mut known = BTreeSet::new();
        if let Some(twice) = std::iter::once(&self.key).chain(&self.names).find(|name| !known.insert(*name)) {
            return Err(format!("found the column {twice:?} twice, allowed: once"));
        }
        if self.names.is_empty() {
            return Err(format!(
                "found the column {:?} alone, allowed: a column of numbers, as time or run, and at least one more, parted by commas",
                self.key
            ));
        }
        self.columns = vec![Vec::new(); self.names.len()];
        Ok(())
    }

    fn push(&mut self, record: &StringRecord) -> Result<(), String> {
        let (found, allowed) = (record.len(), 1 + self.names.len());
        if found != allowed {
            return Err(format!("found {found} cells, allowed: {allowed}, one for each column"));
        }
        let (name, cell) = (&self.key, record.get(0).unwrap_or_default());
        let key = cell.parse::<f64>().ok().filter(|key| key.is_finite());
        let key = key.ok_or_else(|| format!("{name}: found {cell:?}, allowed: a finite number"))?;
        if let Some(before) = self.keys.last().filter(|before| key < **before) {
            return Err(format!("{name}: found {key} after {before}, allowed: numbers that do not fall"));
        }
        self.keys.push(key);
        for (column, cell) in self.columns.iter_mut().zip(record.iter().skip(1)) {
            column.push(Cell::of_text(cell));
        }
        Ok(())
    }

    /// Names of columns by names, vectors and patterns with `*`, each once; all of them without any.
    ///
    /// # Errors
    /// A pattern that is no column.
    pub fn selected(&self, patterns: &[String]) -> Result<Vec<String>, String> {
        if patterns.is_empty() {
            return Ok(self.names.clone());
        }
        let variable = |name: &String| ScalarVariable { name: name.clone(), ..ScalarVariable::default() };
        let description =
            Description { variables: self.names.iter().map(variable).collect(), ..Description::default() };
        let (mut found, mut known) = (Vec::new(), BTreeSet::new());
        for pattern in patterns {
            let positions = fmi::select(&description, pattern).map_err(|_| self.unknown(pattern))?;
            found.extend(
                positions.into_iter().filter(|at| known.insert(*at)).map(|at| self.names[at].clone()),
            );
        }
        Ok(found)
    }

    /// The name of one column, or of the first one.
    ///
    /// # Errors
    /// A name that is no column, and a vector or pattern of several.
    pub fn one(&self, name: &str) -> Result<String, String> {
        if name == self.key {
            return Ok(self.key.clone());
        }
        match &self.selected(&[name.to_owned()])?[..] {
            [one] => Ok(one.clone()),
            several => Err(format!(
                "{}: found {} columns of the name {name:?}, allowed: one, as {:?}",
                self.path.display(),
                several.len(),
                several.first().map_or("", String::as_str)
            )),
        }
    }

    fn unknown(&self, name: &str) -> String {
        let near = similar(name, self.names.iter().map(String::as_str));
        let allowed = match near[..] {
            [] => self.names.iter().take(3).map(String::as_str).collect::<Vec<_>>().join(", ") + " and so on",
            _ => near.join(", "),
        };
        format!("{}:1: found no column {name:?}, allowed: its columns, as {allowed}", self.path.display())
    }

    /// A column by its name.
    pub fn column(&self, name: &str) -> Option<&[Cell]> {
        self.names.iter().position(|it| it == name).map(|at| self.columns[at].as_slice())
    }

    /// The numbers of a column, or of the first one; what is no number is NaN.
    pub fn numbers(&self, name: &str) -> Option<Vec<f64>> {
        if name == self.key {
            return Some(self.keys.clone());
        }
        self.column(name).map(|cells| cells.iter().map(number).collect())
    }
}

/// Line of a record, which the reader places before the comments and empty lines that it skips.
fn line_of(path: &Path, position: Option<&Position>) -> u64 {
    let Some(position) = position else { return 0 };
    let mut rest = match files::open(path) {
        Ok(file) => BufReader::new(file),
        Err(_) => return position.line(),
    };
    if rest.seek(SeekFrom::Start(position.byte())).is_err() {
        return position.line();
    }
    let is_skipped = |line: &Vec<u8>| line.starts_with(b"#") || matches!(line[..], [] | [b'\r']);
    let skipped = rest.split(b'\n').map_while(Result::ok).take_while(is_skipped).count();
    position.line() + skipped as u64
}

fn number(cell: &Cell) -> f64 {
    match cell {
        Cell::Real(value) => *value,
        Cell::Exact(_) => f64::NAN,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &[u8]) -> Result<Table, String> {
        let scratch = tempfile::tempdir().unwrap();
        let path = scratch.path().join("a.csv");
        std::fs::write(&path, text).unwrap();
        let read = Table::read(&path);
        read.map_err(|error| error.replace(path.to_str().unwrap(), "a.csv"))
    }

    #[test]
    fn cells_are_numbers_or_texts() {
        let table = read(b"\xef\xbb\xbfrun, x ,\"y,z\"\n# remark\n0,1e3,ok\n0,,true\n2,NaN,1\n").unwrap();
        assert_eq!((table.key.as_str(), &table.keys[..]), ("run", &[0.0, 0.0, 2.0][..]));
        assert_eq!(table.names, ["x", "y,z"]);
        assert_eq!(table.column("x").unwrap()[..2], [Cell::Real(1000.0), Cell::Exact(String::new())]);
        assert_eq!(table.column("y,z").unwrap()[1], Cell::Real(1.0));
        assert!(table.numbers("x").unwrap()[1].is_nan());
        assert_eq!(table.numbers("run"), Some(vec![0.0, 0.0, 2.0]));
        assert_eq!(table.numbers("y"), None);
    }

    #[test]
    fn what_is_no_table_is_reported_by_line() {
        for (text, part) in [
            (&b""[..], "a.csv: found no row"),
            (b"time,x\n", "a.csv: found no row"),
            (b"time\n0\n", "a.csv:1: found the column \"time\" alone"),
            (b"time,x,x\n0,1,2\n", "a.csv:1: found the column \"x\" twice"),
            (b"time,time\n0,1\n", "a.csv:1: found the column \"time\" twice"),
            (b"time,x\n0,1\n\n# remark\nsoon,2\n", "a.csv:5: time: found \"soon\""),
            (b"time,x\n0,1\ninf,2\n", "a.csv:3: time: found \"inf\""),
            (b"time,x\n1,1\n0.5,2\n", "a.csv:3: time: found 0.5 after 1"),
            (b"time,x\n0,1\n1\n", "a.csv:3: found 1 cells, allowed: 2"),
            (b"time,x\n0,1,2\n", "a.csv:2: found 3 cells, allowed: 2"),
            (b"time,x\n0,\xe4\n", "a.csv:2: found bytes that are not UTF-8"),
        ] {
            let refused = read(text).unwrap_err();
            assert!(refused.starts_with(part), "{refused}");
        }
    }
}
