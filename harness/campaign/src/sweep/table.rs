//! The table of runs: rows in the order of their numbers, whatever order they come in.

use std::{collections::BTreeMap, fmt::Write as _, path::Path};

use files::Growing;
use fmi::csv::{self, Real};
use model_description::Description;

use super::{pool::RunResult, resolved::Campaign, worker::RunStatus};

/// Rows in order.
pub(super) struct RunTable<'a> {
    campaign: &'a Campaign,
    pub file: Growing,
    /// The first run that is not written.
    pub next: u64,
    /// Runs that ended before those in front of them.
    waiting: BTreeMap<u64, String>,
}

/// The header of the table.
pub(super) fn header(campaign: &Campaign, described: &Description) -> String {
    let varied = campaign.design.varied().iter().map(|it| it.name.clone());
    let kept = campaign.kept.columns(described).into_iter().map(|(name, _)| name);
    let names = ["run".to_owned()].into_iter().chain(varied).chain(kept);
    let names = names.chain(["status", "reason"].map(str::to_owned));
    let fields: Vec<String> = names.map(|name| csv::field(&name).into_owned()).collect();
    format!("{}\n", fields.join(","))
}

/// The number of a run and its values.
pub(super) fn values(campaign: &Campaign, run: u64) -> String {
    let mut row = run.to_string();
    for value in campaign.design.values(run) {
        let _ = write!(row, ",{}", Real(value));
    }
    row
}

impl<'a> RunTable<'a> {
    /// Continues in a file with the rows that were left of runs from `first` on; without any, with the header.
    pub(super) fn continued(
        campaign: &'a Campaign,
        described: &Description,
        (mut file, left): (Growing, &LeftRows),
        first: u64,
    ) -> Result<Self, String> {
        let (rows, bytes) = left.kept();
        let waiting = left.behind().map(|(at, row)| (first + at, row)).collect();
        if bytes > 0 {
            file.keep(bytes as u64)?;
        } else {
            file.append(header(campaign, described).as_bytes())?;
        }
        Ok(Self { campaign, file, next: first + rows as u64, waiting })
    }

    /// Takes a run; writes it once all before it are there.
    pub(super) fn take(&mut self, result: &RunResult) -> Result<(), String> {
        let mut row = values(self.campaign, result.run);
        for number in &result.numbers {
            let _ = if number.is_nan() { write!(row, ",") } else { write!(row, ",{}", Real(*number)) };
        }
        let reason = result.reason.lines().map(str::trim).collect::<Vec<_>>().join("; ");
        let _ = writeln!(row, ",{},{}", result.status.word(), csv::field(&reason));
        self.waiting.insert(result.run, row);
        let mut rows = String::new();
        while let Some(row) = self.waiting.remove(&self.next) {
            rows.push_str(&row);
            self.next += 1;
        }
        if rows.is_empty() { Ok(()) } else { self.file.append(rows.as_bytes()) }
    }
}

/// Rows that an earlier sweep of the same campaign left.
#[derive(Default)]
pub(super) struct LeftRows {
    bytes: Vec<u8>,
    /// The end of the header.
    begin: usize,
    /// End of each row, and status of its run.
    rows: Vec<(usize, RunStatus)>,
}

impl LeftRows {
    /// The whole rows of a table in progress, where it has this header and the runs of this campaign; a header that is not whole is none.
    ///
    /// # Errors
    /// A table of something else.
    pub(super) fn read(
        shown: &Path,
        bytes: Vec<u8>,
        header: &str,
        (campaign, first): (&Campaign, u64),
    ) -> Result<Self, String> {
        let shown = shown.display();
        if header.as_bytes().starts_with(&bytes) && bytes.len() < header.len() {
            return Ok(Self::default());
        }
        if !bytes.starts_with(header.as_bytes()) {
            return Err(format!("{shown}: found other columns, allowed: those of this campaign"));
        }
        let mut left = Self { bytes, begin: header.len(), rows: Vec::new() };
        let mut begin = left.begin;
        while let Some(length) = row_length(&left.bytes[begin..]) {
            let row = String::from_utf8_lossy(&left.bytes[begin..begin + length]);
            let run = first + left.rows.len() as u64;
            let expected = values(campaign, run);
            if !row.starts_with(&format!("{expected},")) {
                return Err(format!("{shown}: found another run {run}, allowed: {expected}"));
            }
            // Numbers hold no comma; behind them stand how the run ended and the reason.
            let word =
                row.split(',').nth(1 + campaign.varied.len() + campaign.kept.count()).unwrap_or_default();
            let status = RunStatus::ALL.into_iter().find(|status| status.word() == word);
            let status =
                status.ok_or_else(|| format!("{shown}: run {run}: found {word:?}, allowed: how it ended"))?;
            begin += length;
            left.rows.push((begin, status));
        }
        Ok(left)
    }

    /// How many there are.
    pub(super) fn count(&self) -> u64 {
        self.rows.len() as u64
    }

    /// Forgets all but the first rows.
    pub(super) fn truncate(&mut self, rows: u64) {
        self.rows.truncate(usize::try_from(rows).unwrap_or(usize::MAX));
    }

    /// How the runs ended whose rows stay.
    pub(super) fn statuses(&self) -> impl Iterator<Item = RunStatus> {
        self.rows.iter().map(|(_, status)| *status).filter(|status| *status != RunStatus::Killed)
    }

    /// Places of rows whose process was killed from outside.
    pub(super) fn killed(&self) -> impl Iterator<Item = u64> {
        let killed = self.rows.iter().enumerate().filter(|(_, (_, status))| *status == RunStatus::Killed);
        killed.map(|(at, _)| at as u64)
    }

    /// How many rows stand before one that is simulated again, and the bytes up to there.
    fn kept(&self) -> (usize, usize) {
        let rows = self.rows.iter().take_while(|(_, status)| *status != RunStatus::Killed).count();
        (rows, if rows == 0 { self.begin } else { self.rows[rows - 1].0 })
    }

    /// The rows behind that one, by place.
    fn behind(&self) -> impl Iterator<Item = (u64, String)> {
        let places = (self.kept().0 + 1..self.rows.len()).filter(|at| self.rows[*at].1 != RunStatus::Killed);
        let text = |at: usize| &self.bytes[self.rows[at - 1].0..self.rows[at].0];
        places.map(move |at| (at as u64, String::from_utf8_lossy(text(at)).into_owned()))
    }
}

/// Length of the row at the beginning, its line break counted; `None` where it is not whole. Quoted fields hold no line break: they are
/// written without.
fn row_length(bytes: &[u8]) -> Option<usize> {
    bytes.iter().position(|byte| *byte == b'\n').map(|at| at + 1)
}
