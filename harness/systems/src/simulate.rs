//! Runs a system from start to stop and hands the recorded rows on.

use fmi::{Ended, Error, InputTable, LogMessage, Options, Rows, Value};

use crate::{
    joint::ConnectedVariable,
    master::{FirstExchange, Master, Running, Stepped},
    recorder::Recorder,
    system::System,
};

/// Runs a system in this order of components, with connected outputs counting in the first step as `way` says. Times that
/// are not given are those of its default experiment; names and positions are those of its description, and what is set wins
/// over its parameters. Inputs are held over each step: slopes and events that are to stand apart are for one FMU.
///
/// Communication points are `start + k*step`; the last step ends at the stop time. The first row is of the start. Also gives
/// what the instances logged.
///
/// # Errors
/// The first call that failed, with the component's name as the instance's.
pub fn simulate_into(
    system: &System,
    way: (Master, FirstExchange),
    mut options: Options<'_>,
    rows: &mut dyn Rows,
) -> Result<(Ended, Vec<LogMessage>), Error> {
    let times = system.times(options.start_s, options.stop_s, options.step_s)?;
    let recorded = fmi::RecordedPoints::new(&times, options.record_every_s)?;
    let positions = options.record.take().unwrap_or_else(|| fmi::outputs(system.description()));
    let mut recorder = Recorder::new(system, &positions);
    let mut inputs = options.inputs.map(|table| HeldInputs::new(system, table)).transpose()?;
    let mut sets = own_sets(system, &options.sets)?;
    if let Some(inputs) = &mut inputs {
        sets.extend(inputs.at_start(times.start_s));
    }
    let mut running = Running::start(system, way, &times, (&options.instance, options.tolerance), &sets)?;
    recorder.record(running.instances(), times.start_s, rows)?;
    let steps = times.steps();
    for k in 0..steps {
        let (time_s, end_s) = (times.point_s(k), times.point_s(k + 1));
        if let Some(inputs) = &mut inputs {
            inputs.set(&mut running, time_s)?;
        }
        // Every step but the last has the step size itself: not each difference of two points is it to the bit.
        let step_s = if k + 1 == steps { end_s - time_s } else { times.step_s };
        if let Stepped::Ended(ended_s) = running.step(time_s, step_s)? {
            if ended_s > time_s {
                recorder.record(running.instances(), ended_s, rows)?;
            }
            return Ok((Ended::ByItself, running.messages()));
        }
        let cancelled = options.progress.as_mut().is_some_and(|goes_on| !goes_on(end_s));
        if recorded.contain(k + 1) || cancelled {
            recorder.record(running.instances(), end_s, rows)?;
        }
        if cancelled && k + 1 < steps {
            return Ok((Ended::Cancelled, running.messages()));
        }
    }
    running.terminate()?;
    Ok((Ended::AtStop, running.messages()))
}

/// Values by component and its variable's name. A connected input is refused: its value would not last.
fn own_sets(system: &System, sets: &[(String, Value)]) -> Result<Vec<(usize, String, Value)>, Error> {
    let variables = &system.description().variables;
    let mut own = Vec::new();
    for (name, value) in sets {
        let position = variables.iter().position(|it| it.name == *name);
        let position = position.ok_or_else(|| Error::Value {
            variable: name.clone(),
            what: "the system has no such variable".to_owned(),
        })?;
        for place in system.places(position) {
            refuse_connected(system, place.at, name)?;
            let (number, at) = place.at;
            own.push((
                number,
                system.parts()[number].fmu.description().variables[at].name.clone(),
                place.convert(value),
            ));
        }
    }
    Ok(own)
}

fn refuse_connected(system: &System, input: (usize, usize), name: &str) -> Result<(), Error> {
    let Some(joint) = system.joints().iter().find(|joint| joint.to == input) else { return Ok(()) };
    let part = &system.parts()[joint.from.0];
    let output = &part.fmu.description().variables[joint.from.1].name;
    Err(Error::Value {
        variable: name.to_owned(),
        what: format!("it is connected to {}.{output}, allowed: open inputs and parameters", part.name),
    })
}

/// Open inputs from a table, each set only when it changes.
struct HeldInputs<'a> {
    table: &'a InputTable,
    /// Column of the table and a variable that it goes to.
    columns: Vec<(usize, ConnectedVariable)>,
    names: Vec<String>,
    last: Vec<Option<Value>>,
}

impl<'a> HeldInputs<'a> {
    fn new(system: &System, table: &'a InputTable) -> Result<Self, Error> {
        let (mut columns, mut names) = (Vec::new(), Vec::new());
        for (column, position) in table.positions().enumerate() {
            for place in system.places(position) {
                refuse_connected(system, place.at, &system.description().variables[position].name)?;
                columns.push((column, place));
                names.push(system.parts()[place.at.0].fmu.description().variables[place.at.1].name.clone());
            }
        }
        let last = vec![None; columns.len()];
        Ok(Self { table, columns, names, last })
    }

    /// The values of the start, which initialization takes.
    fn at_start(&mut self, time_s: f64) -> Vec<(usize, String, Value)> {
        let columns = self.columns.iter().zip(&self.names);
        let at =
            |(column, place): (usize, ConnectedVariable)| place.convert(&self.table.value(column, time_s));
        columns.map(|(column, name)| (column.1.at.0, name.clone(), at(*column))).collect()
    }

    fn set(&mut self, running: &mut Running, time_s: f64) -> Result<(), Error> {
        for (last, (column, place)) in self.last.iter_mut().zip(&self.columns) {
            let (number, position) = place.at;
            let value = place.convert(&self.table.value(*column, time_s));
            if last.as_ref() != Some(&value) {
                let instance = &mut running.instances()[number];
                let fmu = instance.fmu().clone();
                instance.set_variable(&fmu.description().variables[position], &value)?;
                *last = Some(value);
            }
        }
        Ok(())
    }
}
