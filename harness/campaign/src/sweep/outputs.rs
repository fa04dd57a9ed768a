//! Files of a campaign, looked at before its first run: the table and what an earlier sweep left of it, percentiles, histories.

use std::{
    fs,
    path::{Path, PathBuf},
};

use files::{Destination, Growing, OutputFolder, leads_below, sidecar_of};
use inputs::campaign::file::CampaignFile;
use tables::output::{OutputFile, OutputKind, check_standing};

use super::{
    histories::{HISTORIES, HistoryPlace},
    origin::{Digests, to_toml},
    series::{Series, percentiles_path},
    started::{Counts, OPTION, Started},
    table::{self, LeftRows},
};

/// Outputs of a campaign, opened.
pub(super) enum Opened {
    /// The runs that no row is left of.
    Begun(Box<CampaignFiles>),
    /// Campaign that an earlier sweep completed.
    Complete(Counts),
}

/// Files that are there and locked.
pub(super) struct CampaignFiles {
    /// The table in progress.
    pub growing: Growing,
    /// Its rows that stay.
    pub left: LeftRows,
    /// Numbers of the percentiles.
    pub series: Option<Series>,
    /// The texts beside the table; none beside the standard output.
    pub beside: Option<Beside>,
    /// The folder of histories.
    pub histories: Option<Histories>,
}

/// The texts beside the table, complete and in progress.
pub(super) struct Beside {
    text: String,
    complete: Destination,
    /// Written already.
    begun: PathBuf,
}

impl Beside {
    /// Writes the text of the complete table, and gives the path of the other one.
    pub(super) fn finish(self) -> Result<PathBuf, String> {
        self.complete.fill_durably(|file| file.write_all(self.text.as_bytes()))?;
        Ok(self.begun)
    }
}

/// A folder that takes a table of every run.
pub(super) struct Histories {
    /// The folder, and the files that are not written over.
    pub place: HistoryPlace,
    _created: OutputFolder,
}

impl CampaignFiles {
    /// Opens them, so that nothing is refused once runs are simulated.
    ///
    /// # Errors
    /// A file that is an input, lies elsewhere, belongs to a different sweep, or holds runs of this campaign that were not given up.
    pub(super) fn open(started: &Started<'_>, digests: &Digests) -> Result<Opened, String> {
        let Started { arguments, runs, .. } = started;
        let output = arguments.output.as_path();
        let inputs = started.inputs();
        let destination = Destination::open(output, OPTION, &inputs)?;
        let is_stdout = destination.is_stdout();
        let percentiles = percentiles(started, is_stdout, &inputs)?;
        let complete = sidecar_of(output);
        let part = destination.part_path();
        let begun = part.as_deref().map(sidecar_of);
        if let (true, Some(begun)) = (arguments.resume && destination.existing().is_some(), &begun)
            && part.is_some_and(|part| !part.exists())
        {
            digests.check(&complete)?;
            return completed(started, percentiles, begun).map(Opened::Complete);
        }
        let complete = begun.as_ref().map(|_| Destination::open(&complete, OPTION, &inputs)).transpose()?;
        let mut growing = destination.grow(&inputs)?;
        let mut left = match &begun {
            Some(begun) => rows(started, &mut growing, (begun, digests))?,
            None => LeftRows::default(),
        };
        let per_run = started.campaign.numbers_per_run();
        let series =
            percentiles.map(|it| Series::open(it, runs.start, per_run, &inputs)).transpose()?.flatten();
        if let Some(series) = series.as_ref().filter(|_| left.count() > 0) {
            // Rows count as far as their numbers reach.
            left.truncate(series.keep(left.count())?);
        }
        let histories = histories(started, &inputs)?;
        let beside = begun.zip(complete).map(|(begun, complete)| {
            let text = to_toml(started, digests);
            let at_part = Destination::open(&begun, OPTION, &inputs)?;
            at_part.fill_durably(|file| file.write_all(text.as_bytes()))?;
            Ok::<_, String>(Beside { text, complete, begun })
        });
        Ok(Opened::Begun(Box::new(Self { growing, left, series, beside: beside.transpose()?, histories })))
    }
}

/// The rows with which a sweep goes on.
fn rows(
    started: &Started<'_>,
    growing: &mut Growing,
    (beside, digests): (&Path, &Digests),
) -> Result<LeftRows, String> {
    let Started { arguments, campaign, described, runs, .. } = started;
    let bytes = growing.left()?;
    if bytes.is_empty() {
        return Ok(LeftRows::default());
    }
    let part = &beside.with_extension("");
    let header = table::header(campaign, described);
    let read = |bytes| LeftRows::read(part, bytes, &header, (campaign, runs.start));
    if arguments.resume {
        digests.check(beside)?;
        return read(bytes);
    }
    if !arguments.fresh && digests.check(beside).is_ok() {
        let count = read(bytes).map_or(0, |left| left.count());
        if count > 0 {
            return Err(format!(
                "{}: found {count} runs of this campaign, allowed: --resume, which goes on with them, or --fresh, which begins anew",
                part.display()
            ));
        }
    }
    Ok(LeftRows::default())
}

/// How the runs of a complete table ended; what a kill left beside it goes.
fn completed(
    started: &Started<'_>,
    percentiles: Option<Destination>,
    begun: &Path,
) -> Result<Counts, String> {
    let Started { arguments, campaign, described, runs, .. } = started;
    let output = arguments.output.as_path();
    let anew = "with --fresh it begins anew";
    if let Some(missing) = percentiles.as_ref().filter(|it| it.existing().is_none()) {
        return Err(format!(
            "{}: found no percentiles, allowed: those of the complete table: {anew}",
            missing.path().display()
        ));
    }
    let bytes = files::read(output).map_err(|error| format!("{}: {error}", output.display()))?;
    let rows = LeftRows::read(output, bytes, &table::header(campaign, described), (campaign, runs.start))?;
    let (found, allowed) = (rows.count(), runs.end - runs.start);
    if found != allowed {
        return Err(format!("{}: found {found} rows, allowed: {allowed}: {anew}", output.display()));
    }
    let mut counts = Counts::default();
    rows.statuses().for_each(|status| counts.add(status));
    percentiles.map(|it| it.part(&[])).transpose()?.flatten().map(files::Part::remove).transpose()?;
    files::remove(begun)?;
    Ok(counts)
}

/// The table of percentiles, if there is one.
fn percentiles(
    started: &Started<'_>,
    is_stdout: bool,
    inputs: &[&Path],
) -> Result<Option<Destination>, String> {
    if started.campaign.kept.percentiles.is_empty() {
        return Ok(None);
    }
    if is_stdout {
        terminal::note(
            "percentiles are not written: they stand beside a table, and --output is the standard output",
        );
        return Ok(None);
    }
    Destination::open(&percentiles_path(&started.arguments.output), OPTION, inputs).map(Some)
}

/// Refuses histories elsewhere than below the campaign.
pub(super) fn check_histories(file: &CampaignFile) -> Result<(), String> {
    let home = file.file.parent().unwrap_or(Path::new(""));
    match file.histories().filter(|at| !leads_below(&at.it, home)) {
        Some(at) => {
            let found =
                format!("found {}, allowed: a folder in the campaign's own or below", at.it.display());
            Err(file.problem(at, &found))
        }
        None => Ok(()),
    }
}

/// The folder of histories, made where it is not there; the files that stand in it are such tables.
fn histories(started: &Started<'_>, inputs: &[&Path]) -> Result<Option<Histories>, String> {
    let Started { file, campaign, described, runs, .. } = started;
    let Some(at) = file.histories() else { return Ok(None) };
    let home = file.file.parent().unwrap_or(Path::new(""));
    let created = OutputFolder::create(&at.it, HISTORIES).map_err(|error| file.problem(at, &error))?;
    let inputs = inputs.iter().map(|path| (*path).to_owned()).collect();
    let place = HistoryPlace { folder: at.it.clone(), inputs };
    let header = campaign.history_header(described);
    let is_ours = |run: &u64| runs.contains(run);
    let entries = fs::read_dir(&at.it).map_err(|error| file.problem(at, &error.to_string()))?;
    let numbers = entries.flatten().filter_map(|entry| {
        entry.file_name().to_str()?.strip_prefix("run-")?.strip_suffix(".csv")?.parse().ok()
    });
    for run in std::iter::once(runs.start).chain(numbers.filter(is_ours)) {
        let destination = place.destination(run)?;
        let output = OutputFile {
            path: destination.path().to_owned(),
            option: HISTORIES,
            home: Some(home.to_owned()),
        };
        check_standing(&output, &destination, OutputKind::History(header.as_bytes()))?;
    }
    Ok(Some(Histories { place, _created: created }))
}
