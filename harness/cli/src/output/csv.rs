//! The CSV of `run --output` (RFC 4180): a header `time,name,...`, then one row per time.
//!
//! Booleans are 0 and 1, and Reals read back to the same bits. The file grows during the simulation.

use std::{
    error::Error,
    io::{self, Write},
    ops::Range,
    path::PathBuf,
};

use files::Growing;
use loader::{Column, Recording};
use model_description::Description;

use super::exporter::Exporter;

/// Rows that are written at once.
const ROWS_AT_ONCE: usize = 64;

/// A table that grows.
pub struct Csv {
    file: Growing,
    /// Rows in the file; `None` before the header.
    rows: Option<usize>,
    bytes: Vec<u8>,
}

impl Csv {
    /// Writes into an empty file.
    pub fn new(file: Growing) -> Self {
        Self { file, rows: None, bytes: Vec::new() }
    }
}

impl Exporter for Csv {
    fn update(&mut self, recording: &Recording) -> Result<(), String> {
        let rows = recording.times_s.len();
        let text = |error: io::Error| error.to_string();
        if self.rows.is_none() && rows > 0 {
            self.bytes.clear();
            write_header(recording, &mut self.bytes).map_err(text)?;
            self.file.append(&self.bytes)?;
            self.rows = Some(0);
        }
        while let Some(from) = self.rows.filter(|from| *from < rows) {
            let to = rows.min(from + ROWS_AT_ONCE);
            self.bytes.clear();
            write_rows(recording, from..to, &mut self.bytes).map_err(text)?;
            self.file.append(&self.bytes)?;
            self.rows = Some(to);
        }
        Ok(())
    }

    fn finish(
        mut self: Box<Self>,
        _described: &Description,
        recording: &Recording,
    ) -> Result<(), Box<dyn Error>> {
        self.update(recording)?;
        Ok(self.file.finish()?)
    }

    fn leave(mut self: Box<Self>, _described: &Description, recording: &Recording) -> Option<PathBuf> {
        let _ = self.update(recording);
        self.file.leave()
    }
}

fn write_header(recording: &Recording, to: &mut dyn Write) -> io::Result<()> {
    write!(to, "time")?;
    for name in &recording.names {
        write!(to, ",{}", csv_field(name))?;
    }
    writeln!(to)
}

fn write_rows(recording: &Recording, rows: Range<usize>, to: &mut dyn Write) -> io::Result<()> {
    for row in rows {
        write_real(recording.times_s.get(row).copied().unwrap_or(f64::NAN), to)?;
        for column in &recording.columns {
            write!(to, ",")?;
            write_value(column, row, to)?;
        }
        writeln!(to)?;
    }
    Ok(())
}

fn write_value(column: &Column, row: usize, to: &mut dyn Write) -> io::Result<()> {
    match column {
        Column::Real(values) => write_real(values.get(row).copied().unwrap_or(f64::NAN), to),
        Column::Integer(values) => write!(to, "{}", values.get(row).copied().unwrap_or_default()),
        Column::Boolean(values) => {
            write!(to, "{}", u8::from(values.get(row).copied().unwrap_or_default()))
        }
        Column::Text(values) => {
            write!(to, "{}", csv_field(values.get(row).map_or("", String::as_str)))
        }
    }
}

/// The shortest text that reads back to the same bits.
fn write_real(value: f64, to: &mut dyn Write) -> io::Result<()> {
    let magnitude = value.abs();
    if magnitude == 0.0 || (1e-5..1e16).contains(&magnitude) || !value.is_finite() {
        write!(to, "{value}")
    } else {
        write!(to, "{value:e}")
    }
}

/// Quotes a CSV field where it has to be (RFC 4180).
fn csv_field(text: &str) -> std::borrow::Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\"")).into()
    } else {
        text.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_reads_back_to_the_same_bits() {
        let values = vec![0.1 + 0.2, -0.0, 5e-324, f64::MAX, 1.0 / 3.0, 6.02e23, 1e-5];
        let recording = Recording {
            times_s: (0..values.len()).map(|k| k as f64 * 0.1).collect(),
            names: vec!["a".to_owned(), "b,\"c\"".to_owned()],
            units: vec![String::new(); 2],
            columns: vec![Column::Real(values.clone()), Column::Text(vec!["x,y".to_owned(); values.len()])],
        };
        let mut bytes = Vec::new();
        write_header(&recording, &mut bytes).unwrap();
        write_rows(&recording, 0..values.len(), &mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.starts_with("time,a,\"b,\"\"c\"\"\"\n"), "{text}");
        for (line, value) in text.lines().skip(1).zip(values) {
            let cell: f64 = line.split(',').nth(1).unwrap().parse().unwrap();
            assert_eq!(cell.to_bits(), value.to_bits(), "{line}");
            assert!(line.ends_with(",\"x,y\""));
        }
    }
}
