//! What a run leaves: time and one typed column per recorded variable.

use std::io::{self, Write};

/// Values of one variable at every recorded time.
#[derive(Clone, Debug, PartialEq)]
pub enum Column {
    /// Reals, in the variable's unit.
    Real(Vec<f64>),
    /// Integers and Enumerations.
    Integer(Vec<i32>),
    /// Booleans.
    Boolean(Vec<bool>),
    /// Strings.
    Text(Vec<String>),
}

impl Column {
    /// The value of a row as a number: Booleans are 0 and 1, texts NaN.
    pub fn number(&self, row: usize) -> f64 {
        match self {
            Self::Real(values) => values.get(row).copied().unwrap_or(f64::NAN),
            Self::Integer(values) => values.get(row).map_or(f64::NAN, |value| f64::from(*value)),
            Self::Boolean(values) => values.get(row).map_or(f64::NAN, |value| f64::from(u8::from(*value))),
            Self::Text(_) => f64::NAN,
        }
    }

    /// All values as numbers.
    pub fn numbers(&self) -> Vec<f64> {
        match self {
            Self::Real(values) => values.clone(),
            Self::Integer(values) => values.iter().map(|value| f64::from(*value)).collect(),
            Self::Boolean(values) => values.iter().map(|value| f64::from(u8::from(*value))).collect(),
            Self::Text(values) => vec![f64::NAN; values.len()],
        }
    }

    fn write(&self, row: usize, to: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Real(values) => write_real(values.get(row).copied().unwrap_or(f64::NAN), to),
            Self::Integer(values) => write!(to, "{}", values.get(row).copied().unwrap_or_default()),
            Self::Boolean(values) => {
                write!(to, "{}", u8::from(values.get(row).copied().unwrap_or_default()))
            }
            Self::Text(values) => {
                write!(to, "{}", csv_field(values.get(row).map_or("", String::as_str)))
            }
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

/// A recorded run.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Recording {
    /// Times in s.
    pub times_s: Vec<f64>,
    /// Names of the columns.
    pub names: Vec<String>,
    /// Units of the columns; empty where a variable has none.
    pub units: Vec<String>,
    /// The values, one column per name, each as long as `times_s`.
    pub columns: Vec<Column>,
}

impl Recording {
    /// The column of a variable.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.names.iter().position(|candidate| candidate == name).map(|index| &self.columns[index])
    }

    /// The values of a Real.
    pub fn reals(&self, name: &str) -> Option<&[f64]> {
        match self.column(name)? {
            Column::Real(values) => Some(values),
            _ => None,
        }
    }

    /// Writes CSV: a header `time,name,...`, then one row per time; Booleans as 0 and 1, Reals so that they read
    /// back to the same bits.
    pub fn write_csv(&self, to: &mut dyn Write) -> io::Result<()> {
        self.write_header(to)?;
        self.write_rows(0..self.times_s.len(), to)?;
        to.flush()
    }

    /// Writes the header of the CSV.
    pub fn write_header(&self, to: &mut dyn Write) -> io::Result<()> {
        write!(to, "time")?;
        for name in &self.names {
            write!(to, ",{}", csv_field(name))?;
        }
        writeln!(to)
    }

    /// Writes these rows of the CSV.
    pub fn write_rows(&self, rows: std::ops::Range<usize>, to: &mut dyn Write) -> io::Result<()> {
        for row in rows {
            write_real(self.times_s.get(row).copied().unwrap_or(f64::NAN), to)?;
            for column in &self.columns {
                write!(to, ",")?;
                column.write(row, to)?;
            }
            writeln!(to)?;
        }
        Ok(())
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
        recording.write_csv(&mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        assert!(text.starts_with("time,a,\"b,\"\"c\"\"\"\n"), "{text}");
        for (line, value) in text.lines().skip(1).zip(values) {
            let cell: f64 = line.split(',').nth(1).unwrap().parse().unwrap();
            assert_eq!(cell.to_bits(), value.to_bits(), "{line}");
            assert!(line.ends_with(",\"x,y\""));
        }
    }
}
