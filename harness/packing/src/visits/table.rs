//! Visits of a run, as a table for people and as a CSV file beside that of the recording.

use std::fmt::Write;

use inputs::epoch;

use super::visit::Visit;

/// Name of what is flown where no command of the timeline is in force.
const NO_COMMAND: &str = "-";

/// Columns of the file.
pub const HEADER: &str =
    "name,command,begin,end,date,sun.azimuth,sun.elevation,momentum[1],momentum[2],momentum[3],dumps";

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

    fn date(&self, visit: &Visit) -> Option<String> {
        epoch::date(self.zero_epoch_s? + visit.span_s[0])
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
            let begin = self.date(visit).unwrap_or_else(|| format!("{} s", terminal::short(visit.span_s[0])));
            table.add_row([self.name(visit), &begin, &sun, &gathered, &dumps]);
        }
        let sum = self.visits.iter().map(|visit| visit.gathered_inertial_n_m_s).sum();
        let dumps: i32 = self.visits.iter().map(|visit| visit.dumps).sum();
        table.add_row(["together", "", "", &three(&sum), &dumps.to_string()]);
        table.to_string()
    }

    /// Returns them as CSV, SI.
    pub fn csv(&self) -> String {
        let mut text = format!("{HEADER}\n");
        for visit in self.visits {
            let Visit { row, span_s: [begin_s, end_s], sun_rad: [azimuth_rad, elevation_rad], dumps, .. } =
                visit;
            let [x, y, z] = visit.gathered_inertial_n_m_s.into();
            let (name, date) = (fmi::csv::field(self.name(visit)), self.date(visit).unwrap_or_default());
            let _ = writeln!(
                text,
                "{name},{row},{begin_s},{end_s},{date},{azimuth_rad},{elevation_rad},{x},{y},{z},{dumps}"
            );
        }
        text
    }
}
