//! `heliotorque sweep`: many runs of a mission or an FMU whose values vary, and what is kept of each.

mod description;
mod file;
mod options;
mod origin;
mod pool;
mod resolved;
mod schema;
mod series;
mod table;
mod worker;

use std::{
    error::Error,
    fs,
    ops::Range,
    path::{Path, PathBuf},
    process::ExitCode,
    sync::{
        atomic::{AtomicBool, Ordering},
        mpsc,
    },
    thread,
    time::Instant,
};

use files::{Destination, Growing, part_of, sidecar_of};
use loader::{InputTable, csv};
use model_description::Description;

use file::CampaignFile;
pub(crate) use options::Sweep;
use origin::Digests;
use pool::Pool;
use resolved::Campaign;
use series::Series;
use table::RunTable;
use worker::RunStatus;
pub(crate) use worker::{SweepInChild, run as run_in_child};

use crate::{
    interrupt::{self, INTERRUPTED},
    outcome::{self, Outcome},
    run::Subject,
};

/// What names the table.
const OPTION: &str = "--output";

/// A campaign file that was read without an FMU, in a line.
///
/// # Errors
/// Everything wrong in it.
pub(crate) fn checked(path: &Path) -> Result<String, String> {
    let file = CampaignFile::read(path)?;
    let runs = file.runs.as_ref().map_or_else(String::new, |at| format!("{} runs, ", at.it));
    let varied = file.vary.len();
    Ok(format!("{runs}{varied} variables vary; `heliotorque sweep --dry-run` prints the values of every run"))
}

/// Simulates a campaign.
pub(crate) fn run(arguments: &Sweep) -> Outcome {
    let file = CampaignFile::read(&arguments.campaign)?;
    let simulated = resolved::simulated(&file, arguments.template.as_deref())?;
    let (subject, _scratch) = simulated.open()?;
    subject.check_libraries()?;
    let Subject::Fmu(fmu) = &subject else {
        let found = "found a system, allowed: an FMU, or a mission of one";
        return Err(format!("{}: {found}", file.simulated.display()).into());
    };
    let described = fmu.description();
    let campaign = Campaign::resolve(&file, simulated, &subject)?;
    let runs = resolved::range(arguments, &campaign)?;
    campaign.check(&file, described, &runs)?;
    if !arguments.quiet {
        let warnings = campaign.settings.inputs.iter().flat_map(InputTable::coarse_turns);
        warnings.for_each(|warning| terminal::note(&format!("warning: {warning}")));
    }
    let sweep = Started { arguments, file: &file, campaign: &campaign, described, runs };
    if arguments.dry_run { sweep.print_values(fmu.folder()) } else { sweep.carry_out(fmu.folder()) }
}

/// A campaign of which everything was accepted.
struct Started<'a> {
    arguments: &'a Sweep,
    file: &'a CampaignFile,
    campaign: &'a Campaign,
    described: &'a Description,
    runs: Range<u64>,
}

/// How many runs ended how.
#[derive(Default)]
struct Counts([u64; 4]);

impl Started<'_> {
    /// The table of the runs' values.
    fn print_values(&self, folder: &Path) -> Outcome {
        let Self { arguments, file, campaign, runs, .. } = self;
        let is_given = arguments.output != Path::new(options::OUTPUT);
        let output = if is_given { arguments.output.as_path() } else { Path::new("-") };
        let names = campaign.design.varied().iter().map(|it| csv::field(&it.name).into_owned());
        let header: Vec<String> = ["run".to_owned()].into_iter().chain(names).collect();
        let destination = Destination::open(output, OPTION, &self.inputs())?;
        let is_stdout = destination.is_stdout();
        destination.fill(|to| {
            writeln!(to, "{}", header.join(","))?;
            runs.clone().try_for_each(|run| writeln!(to, "{}", table::values(campaign, run)))
        })?;
        if !is_stdout {
            self.write_beside(&sidecar_of(output), &Digests::of(file, campaign, folder)?)?;
        }
        Ok(ExitCode::SUCCESS)
    }

    fn carry_out(&self, folder: &Path) -> Outcome {
        let Self { arguments, file, campaign, described, runs } = self;
        let output = arguments.output.as_path();
        let digests = Digests::of(file, campaign, folder)?;
        let part = part_of(output);
        let inputs = self.inputs();
        let destination = Destination::open(output, OPTION, &inputs)?;
        let is_stdout = destination.is_stdout();
        if arguments.resume && !is_stdout && !part.exists() && output.exists() {
            self.check_digests(&sidecar_of(output), &digests)?;
            return outcome::printed(&format!("{}: complete already", output.display()));
        }
        let header = table::header(campaign, described);
        let (done, bytes) = if arguments.resume && !is_stdout && part.exists() {
            self.check_digests(&sidecar_of(&part), &digests)?;
            table::whole_rows(&part, &header, (campaign, runs.start))?
        } else {
            (0, 0)
        };
        let mut growing = destination.grow(&inputs)?;
        let series = self.series(is_stdout, done > 0)?;
        let histories = self.histories()?;
        if !is_stdout {
            self.write_beside(&sidecar_of(&part), &digests)?;
        }
        if bytes > 0 {
            growing.keep(bytes)?;
        }
        let mut table = RunTable::new(campaign, growing, runs.start + done);
        if bytes == 0 {
            table.begin(described)?;
        }
        let is_over = AtomicBool::new(false);
        let left = table.next..runs.end;
        let cores = || thread::available_parallelism().map_or(1, |it| it.get() as u64);
        let workers = arguments.workers.map_or_else(cores, u64::from).min((left.end - left.start).max(1));
        let pool = Pool {
            file: &arguments.campaign,
            campaign,
            described,
            folder,
            runs: left,
            workers,
            timeout_s: arguments.timeout,
            histories: histories.as_deref(),
            series: series.as_ref(),
            is_over: &is_over,
        };
        let began = Instant::now();
        let counts = self.simulate(&pool, &mut table)?;
        let next = table.next;
        if table.file.has_lost_reader() {
            return Ok(ExitCode::SUCCESS);
        }
        let growing = table.file;
        if next < runs.end {
            return self.interrupted(growing, next);
        }
        growing.finish()?;
        if !is_stdout {
            self.write_beside(&sidecar_of(output), &digests)?;
            let _ = fs::remove_file(sidecar_of(&part));
        }
        self.finish_series(series, is_stdout)?;
        if !arguments.quiet {
            let simulated = (runs.end - runs.start) - done;
            let lines =
                [counts.text(), format!("{simulated} runs in {:.3} s", began.elapsed().as_secs_f64())];
            lines.iter().for_each(|line| terminal::note(line));
        }
        Ok(if counts.have_none_failed() { ExitCode::SUCCESS } else { ExitCode::FAILURE })
    }

    /// Files that are read, so not written over.
    fn inputs(&self) -> Vec<&Path> {
        let mut inputs = self.campaign.simulated.reads();
        inputs.push(&self.arguments.campaign);
        inputs.extend(self.file.table.as_deref());
        inputs
    }

    fn simulate(&self, pool: &Pool<'_>, table: &mut RunTable<'_>) -> Result<Counts, Box<dyn Error>> {
        let mut counts = Counts::default();
        let total = self.runs.end - self.runs.start;
        let progress = terminal::progress(total, "runs", self.arguments.quiet);
        progress.set_position(table.next - self.runs.start);
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
                counts.0[result.status as usize] += 1;
                written = written.and_then(|()| table.take(&result));
                if written.is_err() || table.file.has_lost_reader() {
                    pool.is_over.store(true, Ordering::Relaxed);
                }
                progress.inc(1);
            }
            let outcomes = followed
                .into_iter()
                .map(|it| it.join().unwrap_or_else(|_| Err("a thread panicked".to_owned())));
            outcomes.fold(written, |so_far, outcome| so_far.and(outcome))
        });
        progress.finish_and_clear();
        outcome?;
        Ok(counts)
    }

    fn interrupted(&self, growing: Growing, next: u64) -> Outcome {
        let kept = growing.leave().map(|path| {
            let rows = next - self.runs.start;
            format!("\n{rows} rows so far: {}; --resume goes on with them", path.display())
        });
        terminal::note(&format!("interrupted before run {next}{}", kept.unwrap_or_default()));
        Ok(if interrupt::raised() { ExitCode::from(INTERRUPTED) } else { ExitCode::FAILURE })
    }

    fn check_digests(&self, path: &Path, digests: &Digests) -> Result<(), String> {
        let found = files::read_text(path).ok().and_then(|text| Digests::read(&text));
        let of = match found {
            Some(found) if found == *digests => return Ok(()),
            Some(found) if found.campaign != digests.campaign => "another campaign",
            Some(_) => "another FMU",
            None => "no digests",
        };
        let allowed = "those of this campaign and FMU: without --resume it begins anew";
        Err(format!("{}: found {of}, allowed: {allowed}", path.display()))
    }

    fn write_beside(&self, path: &Path, digests: &Digests) -> Result<(), String> {
        let text = origin::to_toml((self.file, self.campaign, digests), self.described, &self.runs);
        Destination::open(path, OPTION, &[])?.fill(|file| file.write_all(text.as_bytes()))
    }

    fn series(&self, is_stdout: bool, keeps: bool) -> Result<Option<Series>, String> {
        let variables = self.campaign.kept.percentiles.len();
        if variables == 0 {
            return Ok(None);
        }
        if is_stdout {
            terminal::note(
                "percentiles are not written: they stand beside a table, and --output is the standard output",
            );
            return Ok(None);
        }
        let path = series::percentiles_path(&self.arguments.output);
        let per_run =
            variables * usize::try_from(self.campaign.percentile_points.count()).unwrap_or(usize::MAX);
        Series::open(part_of(&path), &self.runs, per_run, keeps).map(Some)
    }

    fn finish_series(&self, series: Option<Series>, is_stdout: bool) -> Result<(), String> {
        let Some(series) = series.filter(|_| !is_stdout) else { return Ok(()) };
        let Campaign { settings, kept, percentile_points, .. } = self.campaign;
        let names: Vec<&str> = kept
            .percentiles
            .iter()
            .map(|column| self.described.variables[kept.positions[*column]].name.as_str())
            .collect();
        let times = settings.times;
        let points = (0..=times.steps()).filter(|k| percentile_points.contain(*k));
        let times_s: Vec<f64> = points.map(|k| times.point_s(k)).collect();
        let path = series::percentiles_path(&self.arguments.output);
        let output = Destination::open(&path, OPTION, &self.inputs())?;
        series.finish(self.runs.end - self.runs.start, (&names, &times_s), output)
    }

    /// The folder of histories, made where it is not there.
    fn histories(&self) -> Result<Option<PathBuf>, String> {
        let Some(at) = &self.file.keep.histories else { return Ok(None) };
        fs::create_dir_all(&at.it)
            .map_err(|error| self.file.problem(at, &format!("{}: {error}", at.it.display())))?;
        Ok(Some(at.it.clone()))
    }
}

impl Counts {
    fn have_none_failed(&self) -> bool {
        self.0[RunStatus::Failed as usize] == 0
    }

    fn text(&self) -> String {
        let counts = RunStatus::ALL.iter().zip(self.0).filter(|(_, count)| *count > 0);
        counts.map(|(status, count)| format!("{count} {}", status.word())).collect::<Vec<_>>().join(", ")
    }
}
