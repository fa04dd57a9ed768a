//! Runs an FMU from start to stop and records it.

use model_description::call_table::Condition;
use model_description::{Causality, Description, Initial, ScalarVariable, Variability, rules};

use crate::{
    Error, Fmu, InputTable, Instance, InstanceOptions, LogMessage, RecordedPoints, Recording, Status, Times,
    Value,
    apart::{MAX_HALVINGS, step_apart},
    recorder::{Collector, Reader, Rows},
    watch::{Watch, Watcher},
};

/// Extent of a simulation. `Options::default()` runs the FMU's default experiment and records its outputs.
#[derive(Default)]
pub struct Options<'a> {
    /// Start in s; otherwise the default experiment's, otherwise 0.
    pub start_s: Option<f64>,
    /// Stop in s; otherwise the default experiment's, otherwise one second after the start.
    pub stop_s: Option<f64>,
    /// Communication step in s; otherwise the default experiment's, otherwise a hundredth of the run.
    pub step_s: Option<f64>,
    /// Tolerance of the experiment; otherwise the default experiment's.
    pub tolerance: Option<f64>,
    /// Record the point nearest to each multiple of this time, in s; otherwise every point.
    pub record_every_s: Option<f64>,
    /// Record at these times instead, in s, which grow from the start on: a step that one of them cuts is taken in pieces,
    /// inputs still change at communication points alone. For FMUs that take steps of any size.
    pub record_at_s: Option<&'a [f64]>,
    /// Values set before the run, by name.
    pub sets: Vec<(String, Value)>,
    /// Inputs over time.
    pub inputs: Option<&'a InputTable>,
    /// Hands the slopes of the input table over as input derivatives, where the FMU takes them.
    pub input_derivatives: bool,
    /// Positions in `ModelVariables` to record; `None` means every output.
    pub record: Option<Vec<usize>>,
    /// Position of an Integer that counts events: a step in which it rises by more than one is taken again in halves, and
    /// recorded at them, until the events stand apart. For FMUs with states, without input derivatives.
    pub apart: Option<usize>,
    /// Looks at the instance at every communication point and at times between them, recording nothing. Without times of its own to
    /// record, a counter of events and input derivatives.
    pub watcher: Option<&'a mut dyn Watcher>,
    /// How to instantiate.
    pub instance: InstanceOptions,
    /// Called with the time in s after every step; returns whether the run goes on.
    pub progress: Option<&'a mut dyn FnMut(f64) -> bool>,
}

/// Times whose distance is a smaller part of a step than this are one.
const SAME: f64 = 1e-9;

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
pub enum Ended {
    /// The stop time was reached.
    AtStop,
    /// The simulation was cancelled.
    Cancelled,
    /// The FMU ended by itself (fmi2Terminated).
    ByItself,
}

/// A run that an error stopped; what was recorded until then is kept.
#[derive(Debug, thiserror::Error)]
#[error("{error}")]
pub struct Stopped {
    /// The error.
    #[source]
    pub error: Error,
    /// Everything up to the last good step.
    pub partial: Recording,
}

impl From<Error> for Box<Stopped> {
    fn from(error: Error) -> Self {
        Box::new(Stopped { error, partial: Recording::default() })
    }
}

/// A finished run.
#[derive(Debug)]
pub struct Simulation {
    /// Recorded rows.
    pub recording: Recording,
    /// Why it ended.
    pub ended: Ended,
    /// Messages of the instance's log (the last thousand).
    pub messages: Vec<LogMessage>,
}

/// Runs an FMU and records it.
///
/// Communication points are `start + k*step`; the last step ends at the stop time. Inputs are set at the start
/// of each step, and only if their value changed. A recorded Real that is NaN is an error.
pub fn simulate(fmu: &Fmu, options: Options<'_>) -> Result<Simulation, Box<Stopped>> {
    // Options are checked before the FMU is instantiated.
    let collector = collector(fmu, &options)?;
    let mut instance = Instance::new(fmu, "run", &options.instance)?;
    let (recording, ended) = record(&mut instance, options, collector)?;
    Ok(Simulation { recording, ended, messages: instance.messages() })
}

/// As [`simulate`], with an instance that was just made or reset.
pub fn simulate_instance(
    instance: &mut Instance,
    options: Options<'_>,
) -> Result<(Recording, Ended), Box<Stopped>> {
    let collector = collector(instance.fmu(), &options)?;
    record(instance, options, collector)
}

fn record(
    instance: &mut Instance,
    mut options: Options<'_>,
    (mut collector, positions): (Collector, Vec<usize>),
) -> Result<(Recording, Ended), Box<Stopped>> {
    options.record = Some(positions);
    match simulate_with(instance, options, &mut collector) {
        Ok(ended) => Ok((collector.into_recording(), ended)),
        Err(error) => Err(Box::new(Stopped { error, partial: collector.into_recording() })),
    }
}

/// Collector of a run and the positions of its variables.
///
/// # Errors
/// Invalid times, or more points than the memory limit allows.
fn collector(fmu: &Fmu, options: &Options<'_>) -> Result<(Collector, Vec<usize>), Error> {
    let positions = options.record.clone().unwrap_or_else(|| outputs(fmu.description()));
    let collector = Collector::new(fmu.description(), &positions);
    let times = Times::from_fmu(fmu, options.start_s, options.stop_s, options.step_s)?;
    let points = match options.record_at_s {
        Some(record_at_s) => record_at_s.len() as u64,
        None => RecordedPoints::new(&times, options.record_every_s)?.count(),
    };
    collector.fits(points)?;
    Ok((collector, positions))
}

/// As [`simulate`], with the rows handed on as they are recorded. Also gives what the instance logged.
pub fn simulate_into(
    fmu: &Fmu,
    options: Options<'_>,
    rows: &mut dyn Rows,
) -> Result<(Ended, Vec<LogMessage>), Error> {
    let mut instance = Instance::new(fmu, "run", &options.instance)?;
    let ended = simulate_with(&mut instance, options, rows)?;
    Ok((ended, instance.messages()))
}

/// As [`simulate_into`], with an instance that was just made or reset.
pub fn simulate_with(
    instance: &mut Instance,
    mut options: Options<'_>,
    rows: &mut dyn Rows,
) -> Result<Ended, Error> {
    let fmu = &instance.fmu().clone();
    let times = Times::from_fmu(fmu, options.start_s, options.stop_s, options.step_s)?;
    let recorded = RecordedPoints::new(&times, options.record_every_s)?;
    let positions = options.record.take().unwrap_or_else(|| outputs(fmu.description()));
    let mut reader = Reader::new(fmu, &positions);
    let mut record = |instance: &mut Instance, time_s: f64| reader.read(instance, time_s, rows);
    run_steps(fmu, instance, (&times, recorded), &mut options, &mut record)
}

fn run_steps(
    fmu: &Fmu,
    instance: &mut Instance,
    (times, recorded): (&Times, RecordedPoints),
    options: &mut Options<'_>,
    record: &mut dyn FnMut(&mut Instance, f64) -> Result<(), Error>,
) -> Result<Ended, Error> {
    let default = fmu.description().default_experiment;
    let tolerance = options.tolerance.or_else(|| default.and_then(|default| default.tolerance));
    instance.setup_experiment(tolerance, times.start_s, Some(times.stop_s))?;
    initialize(instance, options.sets.iter().map(|(name, value)| (name, value)))?;
    let mut inputs = options.inputs.map(|table| InputSetter::new(fmu, table, options.input_derivatives));
    if let Some(inputs) = &mut inputs {
        inputs.set(instance, times.start_s, true)?;
    }
    instance.exit_initialization_mode()?;
    let mut cuts =
        options.record_at_s.map(|times_s| Cuts { left_s: times_s, resolution_s: SAME * times.step_s });
    match &mut cuts {
        Some(cuts) => cuts.take_until(times.start_s, |time_s| record(instance, time_s))?,
        None => record(instance, times.start_s)?,
    }

    let resolution_s = SAME * times.step_s;
    let is_watched = cuts.is_none() && options.apart.is_none() && !options.input_derivatives;
    let watcher = options.watcher.take().filter(|_| is_watched);
    let begin = |watcher| Watch::begin(watcher, instance, [times.start_s, resolution_s]);
    let mut watch = watcher.map(begin).transpose()?;
    let counter = options.apart.map(|position| fmu.description().variables[position].value_reference);
    let steps = times.steps();
    for k in 0..steps {
        let time_s = times.point_s(k);
        let end_s = times.point_s(k + 1);
        if let Some(inputs) = &mut inputs {
            inputs.set(instance, time_s, false)?;
            inputs.set_slopes(instance, [time_s, end_s])?;
        }
        // Every step but the last has the step size itself: not each difference of two points is it to the bit.
        let step_s = if k + 1 == steps { end_s - time_s } else { times.step_s };
        let stepped = match (&mut cuts, counter, &mut watch) {
            (Some(cuts), ..) => cuts.step(instance, [time_s, end_s], record),
            (None, None, Some(watch)) => watch.step(instance, time_s, step_s),
            (None, None, None) => instance.do_step(time_s, step_s, true),
            (None, Some(counter), _) => {
                step_apart(instance, (counter, 1), (time_s, step_s), MAX_HALVINGS, record)
            }
        };
        if let Err(error) = stepped {
            if error.status() == Some(Status::Discard) && instance.terminated().unwrap_or(false) {
                let last_s = instance.last_successful_time().unwrap_or(time_s);
                if last_s > time_s {
                    record(instance, last_s)?;
                }
                return Ok(Ended::ByItself);
            }
            return Err(error);
        }
        let cancelled = options.progress.as_mut().is_some_and(|goes_on| !goes_on(end_s));
        if cuts.is_none() && (recorded.contain(k + 1) || cancelled) {
            record(instance, end_s)?;
        }
        if cancelled && k + 1 < steps {
            return Ok(Ended::Cancelled);
        }
    }
    instance.terminate()?;
    Ok(Ended::AtStop)
}

/// Times at which rows are recorded, wherever the communication points are.
struct Cuts<'a> {
    /// Times to come, in s.
    left_s: &'a [f64],
    /// A time this near to a communication point is that point.
    resolution_s: f64,
}

impl Cuts<'_> {
    /// Takes a step in pieces that end at the times in it.
    fn step(
        &mut self,
        instance: &mut Instance,
        [start_s, end_s]: [f64; 2],
        record: &mut dyn FnMut(&mut Instance, f64) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let mut now_s = start_s;
        while let Some(next_s) =
            self.left_s.first().copied().filter(|next_s| end_s - next_s > self.resolution_s)
        {
            if next_s - now_s > self.resolution_s {
                instance.do_step(now_s, next_s - now_s, true)?;
                now_s = next_s;
            }
            self.take_until(next_s, |time_s| record(instance, time_s))?;
        }
        instance.do_step(now_s, end_s - now_s, true)?;
        self.take_until(end_s, |time_s| record(instance, time_s))
    }

    /// Records those up to a time.
    fn take_until(
        &mut self,
        end_s: f64,
        mut record: impl FnMut(f64) -> Result<(), Error>,
    ) -> Result<(), Error> {
        while let [next_s, later_s @ ..] = self.left_s
            && *next_s <= end_s + self.resolution_s
        {
            record(*next_s)?;
            self.left_s = later_s;
        }
        Ok(())
    }
}

/// Enters initialization mode with these values set, before it or in it.
///
/// # Errors
/// A call that fails, a variable that cannot be set.
pub fn initialize<'v>(
    instance: &mut Instance,
    sets: impl Iterator<Item = (&'v String, &'v Value)> + Clone,
) -> Result<(), Error> {
    let fmu = instance.fmu().clone();
    for early in [true, false] {
        for (name, value) in sets.clone() {
            if set_early(fmu.variable(name)?)? == early {
                instance.set(name, value)?;
            }
        }
        if early {
            instance.enter_initialization_mode()?;
        }
    }
    Ok(())
}

/// Positions of all outputs in `ModelVariables`.
pub fn outputs(description: &Description) -> Vec<usize> {
    let variables = &description.variables;
    (0..variables.len()).filter(|&position| variables[position].causality == Causality::Output).collect()
}

/// Whether the variable is set right after instantiation (else: in initialization mode).
///
/// # Errors
/// A variable that cannot be set.
pub fn set_early(variable: &ScalarVariable) -> Result<bool, Error> {
    let initial = rules::effective_initial(variable);
    let settable = variable.variability != Variability::Constant
        && (variable.causality == Causality::Input
            || matches!(initial, Some(Initial::Exact | Initial::Approx)));
    if !settable {
        return Err(Error::Value {
            variable: variable.name.clone(),
            what: "it cannot be set: only parameters, inputs and start values can".to_owned(),
        });
    }
    Ok(variable.causality != Causality::Input)
}

/// Sets inputs from a table, each only when it changes.
struct InputSetter<'a> {
    table: &'a InputTable,
    variables: Vec<&'a ScalarVariable>,
    last: Vec<Option<Value>>,
    slopes: bool,
}

impl<'a> InputSetter<'a> {
    fn new(fmu: &'a Fmu, table: &'a InputTable, slopes: bool) -> Self {
        let variables: Vec<_> =
            table.positions().map(|position| &fmu.description().variables[position]).collect();
        let last = vec![None; variables.len()];
        let can = fmu.description().co_simulation.as_ref().is_some_and(|it| it.can_interpolate_inputs);
        Self { table, variables, last, slopes: slopes && can }
    }

    fn set(&mut self, instance: &mut Instance, time_s: f64, initializing: bool) -> Result<(), Error> {
        for (column, variable) in self.variables.iter().enumerate() {
            // A tunable parameter keeps its start value through initialization mode if it is not exact.
            if initializing && !Condition::SettableInInitialization.admits(variable, false) {
                continue;
            }
            let value = self.table.value(column, time_s);
            if self.last[column].as_ref() != Some(&value) {
                instance.set_variable(variable, &value)?;
                self.last[column] = Some(value);
            }
        }
        Ok(())
    }

    fn set_slopes(&self, instance: &mut Instance, step_s: [f64; 2]) -> Result<(), Error> {
        let slope = |(column, variable): (usize, &&ScalarVariable)| {
            let slope = self.table.slope(column, step_s).filter(|slope| self.slopes && *slope != 0.0)?;
            Some((variable.value_reference, slope))
        };
        let (references, values): (Vec<u32>, Vec<f64>) =
            self.variables.iter().enumerate().filter_map(slope).unzip();
        if references.is_empty() {
            return Ok(());
        }
        instance.set_input_derivatives(&references, &vec![1; references.len()], &values)
    }
}
