//! The table of runs: rows in the order of their numbers, whatever order they come in.

use std::{collections::BTreeMap, fmt::Write as _, path::Path};

use files::Growing;
use loader::csv::{self, Real};
use model_description::Description;

use super::{pool::RunResult, resolved::Campaign};

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
    /// From this run on; what stands in the file before stays.
    pub(super) fn new(campaign: &'a Campaign, file: Growing, next: u64) -> Self {
        Self { campaign, file, next, waiting: BTreeMap::new() }
    }

    /// Writes the header.
    pub(super) fn begin(&mut self, described: &Description) -> Result<(), String> {
        self.file.append(header(self.campaign, described).as_bytes())
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

/// Rows and bytes of whole rows of a table in progress, where it has this header and the runs of this campaign.
///
/// # Errors
/// A table of something else.
pub(super) fn whole_rows(
    path: &Path,
    header: &str,
    (campaign, first): (&Campaign, u64),
) -> Result<(u64, u64), String> {
    let shown = path.display();
    let bytes = files::read(path).map_err(|error| format!("{shown}: {error}"))?;
    if bytes.is_empty() {
        return Ok((0, 0));
    }
    if !bytes.starts_with(header.as_bytes()) {
        return Err(format!("{shown}: found other columns, allowed: those of this campaign"));
    }
    let (mut rows, mut end) = (0, header.len());
    while let Some(length) = row_length(&bytes[end..]) {
        let expected = values(campaign, first + rows);
        if !bytes[end..].starts_with(format!("{expected},").as_bytes()) {
            return Err(format!("{shown}: found another run {}, allowed: {expected}", first + rows));
        }
        rows += 1;
        end += length;
    }
    Ok((rows, end as u64))
}

/// Length of the row at the beginning, its line break counted; `None` where it is not whole. Quoted fields hold no line break: they are
/// written without.
fn row_length(bytes: &[u8]) -> Option<usize> {
    bytes.iter().position(|byte| *byte == b'\n').map(|at| at + 1)
}
