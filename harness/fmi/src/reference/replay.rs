//! Simulates the reference flights of an FMU again.

use std::path::PathBuf;

use crate::{Column, Fmu, InputTable, Options, Recording};

use crate::reference::{
    FOLDER, MANIFEST,
    compare::{Cell, Compared, Difference, differences},
    manifest::{Manifest, Related},
};

/// Tolerance where none is stated: tools with solvers of their own meet it.
const UNSTATED_TOLERANCE: f64 = 1e-3;

/// A flight that was simulated again.
#[derive(Clone, Debug, PartialEq)]
pub struct Replay {
    /// Its file, from the manifest.
    pub source: String,
    /// Rows that were compared.
    pub rows: usize,
    /// Columns that were compared.
    pub columns: usize,
    /// Deviations, the worst first, each with its time in s.
    pub deviations: Vec<(f64, Difference)>,
    /// Greatest deviation allowed, as a fraction of the largest magnitude of a vector or scalar.
    pub tolerance: f64,
    /// Whether the FMU states this tolerance.
    pub is_stated: bool,
    /// Columns that are no variables of the FMU, as where one table serves FMUs of several versions of FMI.
    pub foreign: Vec<String>,
}

impl Replay {
    /// The columns that deviate too much.
    pub fn failures(&self) -> impl Iterator<Item = &(f64, Difference)> {
        self.deviations.iter().filter(|(_, it)| it.fraction > self.tolerance)
    }
}

/// Every flight that the FMU lists, simulated again, or why it cannot be; `None` for an FMU without any list.
///
/// # Errors
/// A list that cannot be read.
pub fn replays(fmu: &Fmu) -> Result<Option<Vec<Result<Replay, String>>>, String> {
    let path = fmu.folder().join(FOLDER).join(MANIFEST);
    if !path.is_file() {
        return Ok(None);
    }
    let in_manifest = |error: &dyn std::fmt::Display| format!("{FOLDER}/{MANIFEST}: {error}");
    let bytes = files::read(&path).map_err(|error| in_manifest(&error))?;
    let manifest = Manifest::read(&bytes).map_err(|error| in_manifest(&error))?;
    let is_flight = |related: &&Related| related.role == "result" && related.kind == "text/csv";
    let flights = manifest.related.iter().filter(is_flight);
    Ok(Some(
        flights
            .map(|flight| simulated(fmu, flight).map_err(|what| format!("{}: {what}", flight.source)))
            .collect(),
    ))
}

/// The path of a file that the manifest names; nothing outside the FMU is read.
fn path_of(fmu: &Fmu, source: &str) -> Result<PathBuf, String> {
    let mut parts: Vec<&str> = FOLDER.split('/').collect();
    for part in source.split('/') {
        match part {
            "" | "." => {}
            ".." => {
                parts.pop().ok_or_else(|| format!("found {source:?}, allowed: a file inside the FMU"))?;
            }
            part => parts.push(part),
        }
    }
    let inside = crate::path_inside(&parts.join("/"))
        .ok_or_else(|| format!("found {source:?}, allowed: a file inside the FMU"))?;
    Ok(fmu.folder().join(inside))
}

fn table(fmu: &Fmu, source: &str) -> Result<(Vec<String>, Vec<Vec<String>>), String> {
    let file = files::open(&path_of(fmu, source)?).map_err(|error| error.to_string())?;
    let mut rows = crate::csv::read_rows(file).map_err(|error| error.to_string())?;
    if rows.len() < 3 {
        return Err(format!("found {} lines, allowed: a header and two times or more", rows.len()));
    }
    let header = rows.remove(0);
    Ok((header, rows))
}

fn simulated(fmu: &Fmu, flight: &Related) -> Result<Replay, String> {
    let (mut header, mut rows) = table(fmu, &flight.source)?;
    let mut times_s = Vec::with_capacity(rows.len());
    for (index, row) in rows.iter().enumerate() {
        let cell = row.first().map_or("", String::as_str);
        let time_s = cell.parse::<f64>().ok().filter(|time_s| time_s.is_finite());
        times_s.push(time_s.ok_or_else(|| format!("line {}: time {cell:?} is no number", index + 2))?);
    }
    let gaps = times_s.windows(2).map(|pair| pair[1] - pair[0]);
    // Two rows at one time stand before and after an event.
    let step_s = gaps.filter(|gap| *gap > 0.0).fold(f64::INFINITY, f64::min);
    let (start_s, stop_s) = (times_s[0], times_s[times_s.len() - 1]);
    let stated = flight.flight.as_ref();
    let inputs = stated.and_then(|it| it.inputs.as_deref()).map(|source| -> Result<InputTable, String> {
        let (header, rows) = table(fmu, source).map_err(|what| format!("{source}: {what}"))?;
        InputTable::parse(fmu.description(), &header, &rows).map_err(|error| format!("{source}: {error}"))
    });
    let inputs = inputs.transpose()?;
    let is_foreign: Vec<bool> =
        header.iter().enumerate().map(|(column, name)| column > 0 && fmu.position(name).is_none()).collect();
    let foreign: Vec<String> =
        header.iter().zip(&is_foreign).filter(|(_, is)| **is).map(|(name, _)| name.clone()).collect();
    // The table of a flight that was recorded with this FMU has its names.
    if let Some(name) = foreign.first().filter(|_| stated.is_some()) {
        return Err(format!("the FMU has no variable {name:?}"));
    }
    for cells in rows.iter_mut().chain([&mut header]) {
        let mut kept = is_foreign.iter().map(|is_foreign| !is_foreign);
        cells.retain(|_| kept.next().unwrap_or(true));
    }
    let record = header[1..].iter().filter_map(|name| fmu.position(name)).collect();
    let options = Options {
        start_s: Some(start_s),
        stop_s: Some(stop_s),
        step_s: Some(step_s),
        inputs: inputs.as_ref(),
        record: Some(record),
        ..Options::default()
    };
    let recording =
        crate::simulate(fmu, options).map_err(|stopped| crate::Error::chain(&stopped.error))?.recording;
    let mut lines = Vec::new();
    let mut row = 0;
    rows.retain(|_| {
        let time_s = times_s[row];
        row += 1;
        let line = ((time_s - start_s) / step_s).round() as usize;
        let meets = recording.times_s.get(line).is_some_and(|at_s| (at_s - time_s).abs() <= 1e-6 * step_s);
        let is_last_at_its_time = times_s.get(row) != Some(&time_s);
        if meets && is_last_at_its_time {
            lines.push(line);
        }
        meets && is_last_at_its_time
    });
    if rows.is_empty() {
        return Err("none of its times is a communication point".to_owned());
    }
    let dated = |it: Difference| (recording.times_s.get(lines[it.row]).copied().unwrap_or(f64::NAN), it);
    let mut deviations: Vec<_> =
        differences(&compared(&header, &rows, &recording, &lines)).into_iter().map(dated).collect();
    deviations.sort_by(|a, b| b.1.fraction.total_cmp(&a.1.fraction));
    Ok(Replay {
        source: flight.source.clone(),
        rows: rows.len(),
        columns: header.len() - 1,
        deviations,
        tolerance: stated.map_or(UNSTATED_TOLERANCE, |it| it.tolerance),
        is_stated: stated.is_some(),
        foreign,
    })
}

/// The columns of a table beside those of a recording; `rows` of the table belong to `lines` of the recording.
fn compared(
    header: &[String],
    rows: &[Vec<String>],
    recording: &Recording,
    lines: &[usize],
) -> Vec<Compared> {
    let of = |(index, name): (usize, &String)| {
        let column = recording.column(name)?;
        let texts = rows.iter().map(|row| row.get(index).map_or("", String::as_str));
        Some(Compared {
            name: name.clone(),
            expected: texts.map(|text| expected(column, text)).collect(),
            found: lines.iter().map(|line| found(column, *line)).collect(),
        })
    };
    header.iter().enumerate().skip(1).filter_map(of).collect()
}

/// A cell of a table as the variable's type has it: an Integer is right or wrong.
fn expected(column: &Column, text: &str) -> Cell {
    let exact = |text: &str| Cell::Exact(text.to_owned());
    match (column, text) {
        (Column::Real(_), _) => text.parse().map_or_else(|_| exact(text), Cell::Real),
        (Column::Integer(_), _) => {
            Cell::Exact(text.parse::<i32>().map_or_else(|_| text.to_owned(), |number| number.to_string()))
        }
        // Others write the words.
        (Column::Boolean(_), "true") => exact("1"),
        (Column::Boolean(_), "false") => exact("0"),
        (Column::Boolean(_) | Column::Text(_), _) => exact(text),
    }
}

fn found(column: &Column, line: usize) -> Cell {
    match column {
        Column::Real(values) => Cell::Real(values[line]),
        Column::Integer(values) => Cell::Exact(values[line].to_string()),
        Column::Boolean(values) => Cell::Exact(u8::from(values[line]).to_string()),
        Column::Text(values) => Cell::Exact(values[line].clone()),
    }
}

#[cfg(test)]
mod tests {
    //! Tables against a recording with a column of each type.

    use super::*;

    fn deviations(cells: [[&str; 6]; 3]) -> Vec<(String, f64)> {
        let recording = Recording {
            times_s: vec![0.0, 1.0, 2.0],
            names: ["x", "zero", "n", "b", "s"].map(str::to_owned).to_vec(),
            units: vec![String::new(); 5],
            columns: vec![
                Column::Real(vec![1.0, 2.0, 4.0]),
                Column::Real(vec![0.0, 0.0, 0.0]),
                Column::Integer(vec![1, 2, 3]),
                Column::Boolean(vec![true, false, true]),
                Column::Text(vec!["a".to_owned(), "b".to_owned(), "c".to_owned()]),
            ],
        };
        let header = ["time", "x", "zero", "n", "b", "s"].map(str::to_owned);
        let rows: Vec<Vec<String>> = cells.iter().map(|row| row.map(str::to_owned).to_vec()).collect();
        let found = differences(&compared(&header, &rows, &recording, &[0, 1, 2]));
        found.into_iter().map(|it| (it.name, it.fraction)).collect()
    }

    #[test]
    fn what_is_the_same_deviates_by_nothing() {
        let same = [
            ["0", "1", "0", "1", "1", "a"],
            ["1", "2", "-0", "2", "false", "b"],
            ["2", "4.0", "0", "3", "true", "c"],
        ];
        assert_eq!(deviations(same), []);
    }

    #[test]
    fn each_kind_of_column_is_judged() {
        let other = [
            ["0", "1.5", "0", "1", "1", "a"],
            ["1", "2", "1e-300", "7", "1", "b"],
            ["2", "5", "0", "3", "1", "x"],
        ];
        let expected =
            [("x", 0.2), ("zero", 1.0), ("n", f64::INFINITY), ("b", f64::INFINITY), ("s", f64::INFINITY)];
        assert_eq!(deviations(other), expected.map(|(name, deviation)| (name.to_owned(), deviation)));
    }

    #[test]
    fn what_is_no_number_is_as_far_off_as_can_be() {
        let torn =
            [["0", "1", "0", "1", "1", "a"], ["1", "", "0", "2", "0", "b"], ["2", "4", "0", "3", "1", "c"]];
        assert_eq!(deviations(torn), [("x".to_owned(), f64::INFINITY)]);
    }
}
