//! `heliotorque sweep`: many runs of a mission or an FMU whose values vary, and what is kept of each.

mod histories;
pub mod options;
mod origin;
mod outputs;
mod pool;
mod recorded_columns;
mod repeated;
mod resolved;
mod series;
mod started;
mod table;
mod worker;

use std::{
    error::Error,
    ops::Range,
    path::Path,
    sync::{
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
    thread,
    time::Instant,
};

use files::{
    Destination, Growing, Part, Scratch,
    outcome::{self, Answer, Outcome},
    sidecar_of,
};
use fmi::{Fmu, csv};
use inputs::{campaign::file::CampaignFile, library::Library};
use isolation::{interrupt, large};

use crate::run::{Settings, Subject};
pub use options::Sweep;
use origin::{Digests, to_toml};
use outputs::{Beside, CampaignFiles, Opened};
use pool::{Attempt, Pool};
use repeated::Sample;
use resolved::Campaign;
use series::Series;
use started::{Counts, OPTION, Started};
use table::RunTable;
use worker::RunStatus;
pub use worker::run as run_in_child;

/// A campaign file in a line, after all that the command does before its first run.
///
/// # Errors
/// Refusals of the command.
pub fn checked(path: &Path, library: Library<'_>) -> Result<String, Box<dyn Error>> {
    let file = CampaignFile::read(path)?;
    let unjudged = library.unjudged(file.simulated())?;
    if unjudged.is_none() {
        Accepted::new(&file, library.template(), None)?;
    }
    let runs = file.runs.as_ref().map_or_else(String::new, |at| format!("{} runs, ", at.it));
    let varied = file.vary.len();
    Ok(format!(
        "{runs}{varied} variables vary; `heliotorque sweep --dry-run` prints the values of every run{}",
        unjudged.unwrap_or_default()
    ))
}

/// Simulates a campaign.
pub fn run(arguments: &Sweep) -> Outcome {
    let file = CampaignFile::read(&arguments.campaign)?;
    let Accepted { campaign, runs, fmu, _scratch } =
        Accepted::new(&file, arguments.template.as_deref(), arguments.runs.as_ref())?;
    if !arguments.quiet {
        let Settings { inputs, times, .. } = &campaign.settings;
        let warnings = inputs.iter().flat_map(|it| it.warnings(fmu.description(), times));
        warnings.for_each(|warning| terminal::note(&format!("warning: {warning}")));
    }
    let sweep = Started { arguments, file: &file, campaign: &campaign, described: fmu.description(), runs };
    if arguments.dry_run { print_values(&sweep, fmu.folder()) } else { carry_out(&sweep, fmu.folder()) }
}

/// A campaign that its FMU takes.
struct Accepted {
    campaign: Campaign,
    runs: Range<u64>,
    fmu: Fmu,
    // The packed FMU of a mission, as long as it is in use.
    _scratch: Option<Scratch>,
}

impl Accepted {
    /// Opens the mission or FMU, and finds every name and value of the campaign in it.
    ///
    /// # Errors
    /// Whatever is refused, by the flag or the campaign's line.
    fn new(
        file: &CampaignFile,
        template: Option<&Path>,
        runs: Option<&Range<u64>>,
    ) -> Result<Self, Box<dyn Error>> {
        let simulated = resolved::simulated(file, template)?;
        let (subject, scratch) = simulated.open()?;
        subject.check_libraries()?;
        let campaign = Campaign::resolve(file, simulated, &subject)?;
        let Subject::Fmu(fmu) = subject else {
            let found = "found a system, allowed: an FMU, or a mission of one";
            return Err(format!("{}: {found}", file.simulated().display()).into());
        };
        let runs = resolved::range(runs, &campaign)?;
        campaign.check(file, fmu.description(), &runs)?;
        outputs::check_histories(file)?;
        Ok(Self { campaign, runs, fmu, _scratch: scratch })
    }
}

/// The table of the runs' values.
fn print_values(started: &Started<'_>, folder: &Path) -> Outcome {
    let Started { arguments, file, campaign, runs, .. } = started;
    let is_given = arguments.output != Path::new(options::OUTPUT);
    let output = if is_given { arguments.output.as_path() } else { Path::new("-") };
    let names = campaign.design.varied().iter().map(|it| csv::field(&it.name).into_owned());
    let header: Vec<String> = ["run".to_owned()].into_iter().chain(names).collect();
    let destination = Destination::open(output, OPTION, &started.inputs())?;
    let is_stdout = destination.is_stdout();
    destination.fill(|to| {
        writeln!(to, "{}", header.join(","))?;
        runs.clone().try_for_each(|run| writeln!(to, "{}", table::values(campaign, run)))
    })?;
    if !is_stdout {
        let digests = Digests::new(file, campaign, folder, runs)?;
        let beside = Destination::open(&sidecar_of(output), OPTION, &started.inputs())?;
        beside.fill_durably(|file| file.write_all(to_toml(started, &digests).as_bytes()))?;
    }
    Ok(Answer::Yes)
}

fn carry_out(started: &Started<'_>, folder: &Path) -> Outcome {
    let Started { arguments, file, campaign, described, runs } = started;
    let digests = Digests::new(file, campaign, folder, runs)?;
    let files = match CampaignFiles::open(started, &digests)? {
        Opened::Begun(files) => files,
        Opened::Complete(counts) => return complete(started, &counts),
    };
    let CampaignFiles { growing, left, series, beside, histories, .. } = *files;
    let again: Vec<u64> = left.killed().map(|at| runs.start + at).collect();
    let done = left.count() - again.len() as u64;
    let mut counts = Counts::default();
    left.statuses().for_each(|status| counts.add(status));
    let mut table = RunTable::continued(campaign, described, (growing, &left), runs.start)?;
    let rest = runs.start + left.count()..runs.end;
    drop(left);
    let cores = || thread::available_parallelism().map_or(1, |it| it.get() as u64);
    let workers = arguments.workers.map_or_else(cores, u64::from).min((rest.end - rest.start).max(1));
    let is_over = AtomicBool::new(false);
    let pool = Pool {
        started,
        folder,
        runs: rest,
        workers,
        attempt: Attempt::First,
        limits: large(workers),
        histories: histories.as_ref().map(|it| &it.place),
        series: series.as_ref(),
        is_over: &is_over,
    };
    let began = Instant::now();
    let progress = terminal::progress(runs.end - runs.start, "runs", arguments.quiet);
    progress.set_position(done);
    let mut taken = Taken { counts, sample: Sample::new(&pool), killed: Vec::new() };
    for run in again {
        simulate(&pool.alone(run, Attempt::Again), &mut table, (&mut taken, &progress))?;
    }
    simulate(&pool, &mut table, (&mut taken, &progress))?;
    progress.finish_and_clear();
    if table.file.has_lost_reader() {
        return Ok(Answer::Yes);
    }
    let next = table.next;
    if next < runs.end {
        return interrupted(started, table.file, next);
    }
    if let (Some(run), Some(_)) = (taken.killed.first(), &beside) {
        let part = table.file.leave().unwrap_or_default();
        return Err(format!(
            "{}: run {run}: its process was killed from outside: --resume simulates it again",
            part.display()
        )
        .into());
    }
    taken.sample.warn(&pool)?;
    finish(started, table.file, series, beside)?;
    if !arguments.quiet {
        let simulated = (runs.end - runs.start) - done;
        let lines =
            [taken.counts.text(), format!("{simulated} runs in {:.3} s", began.elapsed().as_secs_f64())];
        lines.iter().for_each(|line| terminal::note(line));
    }
    Ok(taken.counts.status())
}

/// Reports a campaign that an earlier sweep completed.
fn complete(started: &Started<'_>, counts: &Counts) -> Outcome {
    let text = format!("{}: complete already: {}", started.arguments.output.display(), counts.text());
    outcome::printed(&text).map(|_| counts.status())
}

/// Gives the files their names, the table last: what was killed between is taken up again.
fn finish(
    started: &Started<'_>,
    growing: Growing,
    series: Option<Series>,
    beside: Option<Beside>,
) -> Result<(), Box<dyn Error>> {
    let records = series.map(|series| finish_series(started, series)).transpose()?;
    let begun = beside.map(Beside::finish).transpose()?;
    growing.finish()?;
    records.map(Part::remove).transpose()?;
    begun.as_deref().map(files::remove).transpose()?;
    Ok(())
}

fn interrupted(started: &Started<'_>, growing: Growing, next: u64) -> Outcome {
    let kept = growing.leave().map(|path| {
        let rows = next - started.runs.start;
        format!("\n{rows} rows so far: {}; --resume goes on with them", path.display())
    });
    terminal::note(&format!("interrupted before run {next}{}", kept.unwrap_or_default()));
    Ok(if interrupt::raised() { Answer::Interrupted } else { Answer::No })
}

fn finish_series(started: &Started<'_>, series: Series) -> Result<Part, String> {
    let Campaign { settings, kept, percentile_points, .. } = started.campaign;
    let names: Vec<&str> = kept
        .percentiles
        .iter()
        .map(|column| started.described.variables[kept.positions[*column]].name.as_str())
        .collect();
    let times = settings.times;
    let points = (0..=times.steps()).filter(|k| percentile_points.contain(*k));
    let times_s: Vec<f64> = points.map(|k| times.point_s(k)).collect();
    series.finish(started.runs.end - started.runs.start, (&names, &times_s))
}

/// Results of the runs that ended.
struct Taken {
    counts: Counts,
    sample: Sample,
    /// Runs whose process was killed from outside.
    killed: Vec<u64>,
}

/// Simulates the runs of a pool and writes their rows.
fn simulate(
    pool: &Pool<'_>,
    table: &mut RunTable<'_>,
    (taken, progress): (&mut Taken, &terminal::ProgressBar),
) -> Result<(), Box<dyn Error>> {
    let outcome = thread::scope(|scope| {
        let (sender, results) = mpsc::channel();
        let followed: Vec<_> = (0..pool.workers)
            .map(|worker| {
                let sender = sender.clone();
                scope.spawn(move || {
                    let outcome = pool.follow(worker, &sender);
                    if outcome.is_err() {
                        pool.is_over.store(true, Ordering::Relaxed);
                    }
                    outcome
                })
            })
            .collect();
        drop(sender);
        let mut written = Ok(());
        for result in results {
            taken.counts.add(result.status);
            taken.sample.take(&result);
            taken.killed.extend((result.status == RunStatus::Killed).then_some(result.run));
            written = written.and_then(|()| table.take(&result));
            if written.is_err() || table.file.has_lost_reader() {
                pool.is_over.store(true, Ordering::Relaxed);
            }
            progress.inc(1);
        }
        let outcomes =
            followed.into_iter().map(|it| it.join().unwrap_or_else(|_| Err("a thread panicked".to_owned())));
        outcomes.fold(written, |so_far, outcome| so_far.and(outcome))
    });
    Ok(outcome?)
}
