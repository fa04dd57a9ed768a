//! A process that simulates every n-th run of a campaign, with one instance that is reset between runs.

use std::{error, path::Path, sync::atomic::Ordering};

use files::outcome::{Answer, Outcome};
use fmi::{Ended, Error, Fmu, Instance, InstanceOptions, Options, Row, Rows, Status, Value};
use inputs::campaign::file::CampaignFile;
use isolation::{Frame, Link, Runs};
use model_description::{BaseType, Description};

use super::{
    recorded_columns::RecordedColumns,
    resolved::{Campaign, simulated},
};
use crate::{Extremes, run::Subject};

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum RunStatus {
    /// At the stop, within limits.
    Ok,
    /// At the stop, beyond a limit.
    Limit,
    /// The FMU ended it.
    Ended,
    /// A call failed, crashed or hung.
    Failed,
    /// Its process was killed from outside for the first time, which says nothing of the run.
    Killed,
}

impl RunStatus {
    pub(super) const ALL: [Self; 5] = [Self::Ok, Self::Limit, Self::Ended, Self::Failed, Self::Killed];

    /// Whether it has no numbers.
    pub(super) fn has_failed(self) -> bool {
        matches!(self, Self::Failed | Self::Killed)
    }

    /// Its word in the table.
    pub(super) fn word(self) -> &'static str {
        ["ok", "limit", "ended", "failed", "killed"][self as usize]
    }
}

/// Simulates and sends the parent what is kept.
pub fn run(link: Link, runs: &Runs) -> Outcome {
    link.answer(|link| simulate_all(runs, link))
}

/// The last frame once all runs ended; nothing where another process is to go on.
fn simulate_all(runs: &Runs, link: &mut Link) -> Result<Option<Frame<'static>>, Box<dyn error::Error>> {
    let subject = Subject::open(Path::new(&runs.folder))?;
    let Subject::Fmu(fmu) = &subject else { return Err("found a system, allowed: an FMU".into()) };
    let file = CampaignFile::read(Path::new(&runs.campaign))?;
    let campaign = Campaign::resolve(&file, simulated(&file, None)?, &subject)?;
    let is_reset = !runs.is_fresh && fmi::conformance::resets(fmu).unwrap_or(false);
    let mut rows = KeptRows::new(&campaign, fmu.description(), link);
    let mut held: Option<Instance> = None;
    for run in (runs.first..runs.end).step_by(usize::try_from(runs.stride)?) {
        if rows.link.cancel_word().load(Ordering::Relaxed) != 0 {
            return Ok(None);
        }
        // What fails before a run is begun is no fault of that run: another process goes on with it.
        let (mut instance, was_reset) = match held.take() {
            Some(mut instance) if is_reset => match instance.reset() {
                Ok(()) => (instance, true),
                Err(_) => return Ok(None),
            },
            _ => match Instance::new(fmu, "run", &InstanceOptions::default()) {
                Ok(instance) => (instance, false),
                // Where nothing else is left to try, no run can be simulated.
                Err(error) if runs.is_fresh && run == runs.first => return Err(error.into()),
                Err(_) => return Ok(None),
            },
        };
        rows.begin(run, was_reset)?;
        match simulate(&mut instance, &campaign, fmu, run, &mut rows) {
            Ok(Ended::Cancelled) => return Ok(None),
            Ok(ended) => {
                rows.end(ended)?;
                held = Some(instance);
            }
            Err(error) => {
                rows.send(RunStatus::Failed, &Error::chain(&error))?;
                if error.status() == Some(Status::Fatal) {
                    // No instance of a library may be used after it: the parent starts another process.
                    return Ok(None);
                }
            }
        }
    }
    Ok(Some(Frame::Done(Answer::Yes)))
}

fn simulate(
    instance: &mut Instance,
    campaign: &Campaign,
    fmu: &Fmu,
    run: u64,
    rows: &mut KeptRows<'_>,
) -> Result<Ended, Error> {
    let times = campaign.settings.times;
    let mut sets: Vec<(String, Value)> = campaign.settings.sets.clone();
    sets.extend(campaign.sets(fmu.description(), run));
    let cancel_word = rows.link.cancel_word();
    let mut goes_on = |_: f64| cancel_word.load(Ordering::Relaxed) == 0;
    let options = Options {
        start_s: Some(times.start_s),
        stop_s: Some(times.stop_s),
        step_s: Some(times.step_s),
        record_every_s: (!campaign.kept.needs_all_points()).then_some(times.stop_s - times.start_s),
        sets,
        inputs: campaign.settings.inputs.as_ref(),
        record: Some(campaign.kept.positions.clone()),
        progress: Some(&mut goes_on),
        ..Options::default()
    };
    fmi::simulate_with(instance, options, rows)
}

/// Takes the rows of a run and sends what is kept of them.
struct KeptRows<'a> {
    campaign: &'a Campaign,
    kept: &'a RecordedColumns,
    /// Base type and place in a row of every recorded variable.
    places: Vec<(BaseType, usize)>,
    link: &'a mut Link,
    /// Communication points so far.
    points: u64,
    finals: Vec<f64>,
    extremes: Vec<Extremes>,
    /// The first limit that was broken.
    broken: Option<String>,
}

impl<'a> KeptRows<'a> {
    fn new(campaign: &'a Campaign, described: &Description, link: &'a mut Link) -> Self {
        let kept = &campaign.kept;
        let mut counts = [0; 4];
        let place = |position: &usize| {
            let base = described.variables[*position].kind.base_type();
            counts[base as usize] += 1;
            (base, counts[base as usize] - 1)
        };
        Self {
            campaign,
            kept,
            places: kept.positions.iter().map(place).collect(),
            link,
            points: 0,
            finals: vec![f64::NAN; kept.finals.len()],
            extremes: vec![Extremes::default(); kept.extremes.len()],
            broken: None,
        }
    }

    fn value(&self, row: &Row<'_>, column: usize) -> f64 {
        match self.places[column] {
            (BaseType::Real, place) => row.reals[place],
            (BaseType::Integer, place) => f64::from(row.integers[place]),
            (BaseType::Boolean, place) => f64::from(u8::from(row.booleans[place] != 0)),
            (BaseType::String, _) => f64::NAN,
        }
    }

    fn begin(&mut self, run: u64, was_reset: bool) -> Result<(), String> {
        self.points = 0;
        self.finals.fill(f64::NAN);
        self.extremes.fill(Extremes::default());
        self.broken = None;
        self.link.send(&Frame::RunStarted(run, was_reset))
    }

    fn end(&mut self, ended: Ended) -> Result<(), String> {
        let status = match (ended, &self.broken) {
            (Ended::ByItself, _) => RunStatus::Ended,
            (_, Some(_)) => RunStatus::Limit,
            (_, None) => RunStatus::Ok,
        };
        let reason = self.broken.take().unwrap_or_default();
        self.send(status, &reason)
    }

    /// Sends the recorded values; a failed run has none.
    fn send(&mut self, status: RunStatus, reason: &str) -> Result<(), String> {
        let numbers = if status == RunStatus::Failed {
            vec![f64::NAN; self.kept.count()]
        } else {
            let extremes = self.extremes.iter();
            let extremes = extremes.flat_map(|it| [it.min, it.max, it.largest, it.time_of_largest_s]);
            self.finals.iter().copied().chain(extremes).collect()
        };
        self.link.send(&Frame::RunEnded(status as u8, numbers.into(), reason.into()))
    }

    fn check_limits(&mut self, row: &Row<'_>) {
        if self.broken.is_some() {
            return;
        }
        self.broken = self.kept.limits.iter().find_map(|(column, limit)| {
            let value = self.value(row, *column);
            let is_kept =
                limit.min.is_none_or(|min| value >= min) && limit.max.is_none_or(|max| value <= max);
            let time = terminal::short(row.time_s);
            (!is_kept).then(|| format!("{}: found {} at {time} s", limit.at, terminal::short(value)))
        });
    }
}

impl Rows for KeptRows<'_> {
    fn take(&mut self, row: &Row<'_>) -> Result<(), Error> {
        for (place, column) in self.kept.finals.iter().enumerate() {
            self.finals[place] = self.value(row, *column);
        }
        for (place, column) in self.kept.extremes.iter().enumerate() {
            let value = self.value(row, *column);
            self.extremes[place].update(row.time_s, value);
        }
        self.check_limits(row);
        let point = self.points;
        self.points += 1;
        if !self.kept.percentiles.is_empty() && self.campaign.percentile_points.contain(point) {
            let values: Vec<f64> =
                self.kept.percentiles.iter().map(|column| self.value(row, *column)).collect();
            self.link.send(&Frame::Numbers(values.into())).map_err(Error::Rows)?;
        }
        if self.kept.histories > 0 && self.campaign.history_points.contain(point) {
            self.link.send(&Frame::Row(row.clone())).map_err(Error::Rows)?;
        }
        Ok(())
    }
}
