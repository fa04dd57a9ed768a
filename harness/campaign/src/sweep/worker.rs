//! A process that simulates every n-th run of a campaign, with one instance that is reset between runs.

use std::{
    path::PathBuf,
    sync::atomic::{AtomicBool, Ordering},
};

use files::outcome::{Answer, Outcome};
use fmi::{Ended, Error, Fmu, Instance, InstanceOptions, Options, Row, Rows, Status, Value};
use inputs::campaign::file::CampaignFile;
use isolation::{Link, push_text};
use model_description::{BaseType, Description};

use super::resolved::{Campaign, Kept, simulated};
use crate::{
    Extremes,
    run::{Subject, push_row},
};

/// Runs of a campaign for one process.
#[derive(Clone, Debug)]
pub struct SweepInChild {
    /// The campaign
    pub campaign: PathBuf,
    /// The folder that the FMU was unpacked into
    pub unpacked_in: PathBuf,
    /// The first run
    pub first: u64,
    /// Distance of the runs
    pub stride: u64,
    /// The first run that is not simulated
    pub end: u64,
    /// A new instance a run
    pub fresh: bool,
}

/// Kinds of frames: a run begins, a row of its history, a row of its percentiles, its end, the end of all, a failure before any.
pub(super) const BEGUN: u8 = 1;
pub(super) const ROW: u8 = 2;
pub(super) const POINT: u8 = 3;
pub(super) const ENDED: u8 = 4;
pub(super) const ALL_ENDED: u8 = 5;
pub(super) const REFUSED: u8 = 6;

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
}

impl RunStatus {
    pub(super) const ALL: [Self; 4] = [Self::Ok, Self::Limit, Self::Ended, Self::Failed];

    /// Its word in the table.
    pub(super) fn word(self) -> &'static str {
        ["ok", "limit", "ended", "failed"][self as usize]
    }
}

/// Simulates and sends the parent what is kept.
pub fn run(arguments: &SweepInChild) -> Outcome {
    let mut link = Link::attach("heliotorque sweep")?;
    if let Err(error) = simulate_all(arguments, &mut link) {
        let text = Error::chain(error.as_ref());
        link.send(REFUSED, |payload| push_text(payload, &text))?;
    }
    Ok(Answer::Yes)
}

fn simulate_all(arguments: &SweepInChild, link: &mut Link) -> Result<(), Box<dyn std::error::Error>> {
    let subject = Subject::open(&arguments.unpacked_in)?;
    let Subject::Fmu(fmu) = &subject else { return Err("found a system, allowed: an FMU".into()) };
    let file = CampaignFile::read(&arguments.campaign)?;
    let campaign = Campaign::resolve(&file, simulated(&file, None)?, &subject)?;
    let is_reset = !arguments.fresh && fmi::conformance::resets(fmu).unwrap_or(false);
    let mut rows = KeptRows::new(&campaign, fmu.description(), link);
    let mut held: Option<Instance> = None;
    let runs = (arguments.first..arguments.end).step_by(usize::try_from(arguments.stride)?);
    for run in runs {
        if rows.link.cancel_word().load(Ordering::Relaxed) != 0 {
            return Ok(());
        }
        // What fails before a run is begun is no fault of that run: another process goes on with it.
        let (mut instance, was_reset) = match held.take() {
            Some(mut instance) if is_reset => match instance.reset() {
                Ok(()) => (instance, true),
                Err(_) => return Ok(()),
            },
            _ => match Instance::new(fmu, "run", &InstanceOptions::default()) {
                Ok(instance) => (instance, false),
                // Where nothing else is left to try, no run can be simulated.
                Err(error) if arguments.fresh && run == arguments.first => return Err(error.into()),
                Err(_) => return Ok(()),
            },
        };
        rows.begin(run, was_reset)?;
        match simulate(&mut instance, &campaign, fmu, run, &mut rows) {
            Ok(Ended::Cancelled) => return Ok(()),
            Ok(ended) => {
                rows.end(ended)?;
                held = Some(instance);
            }
            Err(error) => {
                rows.send(RunStatus::Failed, &Error::chain(&error))?;
                if error.status() == Some(Status::Fatal) {
                    // No instance of a library may be used after it: the parent starts another process.
                    return Ok(());
                }
            }
        }
    }
    link.send(ALL_ENDED, |_| {})?;
    Ok(())
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
    let cancel = AtomicBool::new(false);
    let mut check_cancel = |_: f64| cancel.store(cancel_word.load(Ordering::Relaxed) != 0, Ordering::Relaxed);
    check_cancel(0.0);
    let options = Options {
        start_s: Some(times.start_s),
        stop_s: Some(times.stop_s),
        step_s: Some(times.step_s),
        record_every_s: (!campaign.kept.needs_all_points()).then_some(times.stop_s - times.start_s),
        sets,
        inputs: campaign.settings.inputs.as_ref(),
        record: Some(campaign.kept.positions.clone()),
        progress: Some(&mut check_cancel),
        cancel: Some(&cancel),
        ..Options::default()
    };
    fmi::simulate_with(instance, options, rows)
}

/// Takes the rows of a run and sends what is kept of them.
struct KeptRows<'a> {
    campaign: &'a Campaign,
    kept: &'a Kept,
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
        self.link.send(BEGUN, |payload| payload.extend([run, u64::from(was_reset)]))
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
        let (finals, extremes) = (&self.finals, &self.extremes);
        self.link.send(ENDED, |payload| {
            payload.push(status as u64);
            let extremes = extremes.iter().flat_map(|it| [it.min, it.max, it.largest, it.time_of_largest_s]);
            let kept = |number: f64| if status == RunStatus::Failed { f64::NAN } else { number };
            payload.extend(finals.iter().copied().chain(extremes).map(|number| kept(number).to_bits()));
            push_text(payload, reason);
        })
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
            let values: Vec<u64> =
                self.kept.percentiles.iter().map(|column| self.value(row, *column).to_bits()).collect();
            self.link.send(POINT, |payload| payload.extend(values)).map_err(Error::Rows)?;
        }
        if self.kept.histories > 0 && self.campaign.history_points.contain(point) {
            self.link.send(ROW, |payload| push_row(payload, row)).map_err(Error::Rows)?;
        }
        Ok(())
    }
}
