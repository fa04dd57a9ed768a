//! Recordings and tables of inputs as CSV (RFC 4180): a header `time,name,...`, then one row per time.
//!
//! Booleans are 0 and 1, and Reals read back to the same bits, -0.0 as 0. Lines that begin with `#` are comments.

use std::{
    fmt,
    io::{self, Read, Write},
    ops::Range,
};

use crate::{Recording, Value};

/// The cells of all lines.
///
/// # Errors
/// What cannot be read or is not UTF-8.
pub fn read_rows(from: impl Read) -> Result<Vec<Vec<String>>, csv::Error> {
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(from);
    reader.records().map(|record| Ok(record?.iter().map(str::to_owned).collect())).collect()
}

/// Writes the header.
///
/// # Errors
/// Those of the writer.
pub fn write_header(recording: &Recording, columns: usize, to: &mut dyn Write) -> io::Result<()> {
    write!(to, "time")?;
    for name in recording.names.iter().take(columns) {
        write!(to, ",{}", field(name))?;
    }
    writeln!(to)
}

/// Writes these rows of the first columns.
///
/// # Errors
/// Those of the writer.
pub fn write_rows(
    recording: &Recording,
    columns: usize,
    rows: Range<usize>,
    to: &mut dyn Write,
) -> io::Result<()> {
    for row in rows {
        write!(to, "{}", Real(recording.times_s.get(row).copied().unwrap_or(f64::NAN)))?;
        for column in recording.columns.iter().take(columns) {
            write!(to, ",{}", cell(column.value(row).as_ref()))?;
        }
        writeln!(to)?;
    }
    Ok(())
}

/// A value as the cell of a table; one that is not there is NaN.
fn cell(value: Option<&Value>) -> String {
    match value {
        Some(Value::Real(value)) => Real(*value).to_string(),
        Some(Value::Boolean(value)) => u8::from(*value).to_string(),
        Some(Value::Text(text)) => field(text).into_owned(),
        Some(Value::Integer(value)) => value.to_string(),
        None => Real(f64::NAN).to_string(),
    }
}

/// A Real as the shortest text that reads back to the same bits; 0 has no sign, for none of its readers tells the two apart.
#[derive(Clone, Copy, Debug)]
pub struct Real(pub f64);

impl fmt::Display for Real {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(value) = self;
        let magnitude = value.abs();
        if magnitude == 0.0 || (1e-5..1e16).contains(&magnitude) || !value.is_finite() {
            write!(f, "{}", value + 0.0)
        } else {
            write!(f, "{value:e}")
        }
    }
}

/// A text as a field, quoted where it has to be (RFC 4180).
pub fn field(text: &str) -> std::borrow::Cow<'_, str> {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\"")).into()
    } else {
        text.into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Column;

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
        write_header(&recording, recording.columns.len(), &mut bytes).unwrap();
        write_rows(&recording, recording.columns.len(), 0..values.len(), &mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.starts_with("time,a,\"b,\"\"c\"\"\"\n"), "{text}");
        for (line, value) in text.lines().skip(1).zip(values) {
            let cell: f64 = line.split(',').nth(1).unwrap().parse().unwrap();
            // A zero loses its sign: its readers compare numbers, and people took -0 for a small number.
            assert_eq!(cell.to_bits(), (value + 0.0).to_bits(), "{line}");
            assert!(line.ends_with(",\"x,y\""));
        }
    }
}
