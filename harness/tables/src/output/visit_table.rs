//! Visits of a run, as a table for people and as a CSV file beside that of the recording.

use std::{
    io::{self, Write},
    path::Path,
};

use files::Destination;
use inputs::epoch;

use super::{
    file::OutputFile,
    standing::{self, OutputKind},
    visit::Visit,
};

/// Name of what is flown where no command of the timeline is in force.
const NO_COMMAND: &str = "-";

/// Columns of the file.
const HEADER: [&str; 11] = [
    "name",
    "command",
    "begin",
    "end",
    "date",
    "sun.azimuth",
    "sun.elevation",
    "momentum[1]",
    "momentum[2]",
    "momentum[3]",
    "dumps",
];

/// Visits with the names of the timeline's commands.
pub struct VisitTable<'a> {
    /// The visits.
    pub visits: &'a [Visit],
    /// Name of each command.
    pub names: &'a [String],
    /// Epoch of time 0 in s past J2000 TDB, where the flight has dates.
    pub zero_epoch_s: Option<f64>,
}

impl VisitTable<'_> {
    fn name(&self, visit: &Visit) -> &str {
        let row = usize::try_from(visit.row).ok().and_then(|row| row.checked_sub(1));
        row.and_then(|row| self.names.get(row)).map_or(NO_COMMAND, String::as_str)
    }

    fn begin(&self, visit: &Visit) -> String {
        let date = self.zero_epoch_s.and_then(|zero_epoch_s| epoch::date(zero_epoch_s + visit.span_s[0]));
        date.unwrap_or_else(|| format!("{} s", terminal::short(visit.span_s[0])))
    }

    /// A line each, and what they add up to.
    pub fn shown(&self) -> String {
        let header = ["visit", "begin", "Sun az, el (deg)", "momentum gathered (N.m.s, EME2000)", "dumps"];
        let mut table = terminal::table(&header);
        let three = |vector: &nalgebra::Vector3<f64>| {
            let size = vector.amax();
            let shown = |it: f64| terminal::rounded(if it.abs() < 1e-12 * size { 0.0 } else { it });
            vector.iter().map(|it| shown(*it)).collect::<Vec<_>>().join(", ")
        };
        for visit in self.visits {
            let sun = visit.sun_rad.map(|it| format!("{:.2}", it.to_degrees())).join(", ");
            let (gathered, dumps) = (three(&visit.gathered_inertial_n_m_s), visit.dumps.to_string());
            table.add_row([self.name(visit), &self.begin(visit), &sun, &gathered, &dumps]);
        }
        let sum = self.visits.iter().map(|visit| visit.gathered_inertial_n_m_s).sum();
        let dumps: i32 = self.visits.iter().map(|visit| visit.dumps).sum();
        table.add_row(["together", "", "", &three(&sum), &dumps.to_string()]);
        table.to_string()
    }

    /// Writes them as CSV, SI.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let mut rows = csv::Writer::from_writer(out);
        rows.write_record(HEADER)?;
        for visit in self.visits {
            let date = self.zero_epoch_s.and_then(|zero_epoch_s| epoch::date(zero_epoch_s + visit.span_s[0]));
            let numbers = [visit.span_s, visit.sun_rad].concat();
            let mut numbers = numbers.iter().chain(&visit.gathered_inertial_n_m_s).map(f64::to_string);
            let mut row = vec![self.name(visit).to_owned(), visit.row.to_string()];
            row.extend(numbers.by_ref().take(2));
            row.push(date.unwrap_or_default());
            row.extend(numbers);
            row.push(visit.dumps.to_string());
            rows.write_record(row)?;
        }
        rows.flush()
    }
}

/// Opens the file of the visits beside a table, NAME-visits.csv for NAME.csv; nothing stands beside the standard output.
///
/// # Errors
/// A file that is none, an input, or none of a run where a mission names the table.
pub fn open_visits(table: &OutputFile, inputs: &[&Path]) -> Result<Option<Destination>, String> {
    if table.path == Path::new("-") {
        return Ok(None);
    }
    let stem = table.path.file_stem().unwrap_or_default().to_string_lossy();
    let file = OutputFile { path: table.path.with_file_name(format!("{stem}-visits.csv")), ..table.clone() };
    let destination = Destination::open(&file.path, file.option, inputs)?;
    standing::check(&file, &destination, OutputKind::Table(HEADER.join(",").as_bytes()))?;
    Ok(Some(destination))
}
