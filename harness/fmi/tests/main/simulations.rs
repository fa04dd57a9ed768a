//! The driver: what it runs equals closed forms, and whatever stops it, what was recorded stays.

use fmi::{Column, Ended, InputTable, Options, Value, simulate};

use crate::probe;

fn real(value: f64) -> Value {
    Value::Real(value)
}

/// A run from 0 to its stop in these steps, in s.
fn over<'a>(stop_s: f64, step_s: f64) -> Options<'a> {
    Options { start_s: Some(0.0), stop_s: Some(stop_s), step_s: Some(step_s), ..Options::default() }
}

#[test]
fn outputs_are_recorded_at_every_point() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let sets = vec![("input.real".to_owned(), real(3.0)), ("parameter.real".to_owned(), real(4.0))];
    let simulation = simulate(&fmu, Options { sets, ..over(2.0, 0.3) }).unwrap();
    assert_eq!(simulation.ended, Ended::AtStop);
    let recording = simulation.recording;
    let expected: Vec<f64> = (0..7).map(|k| f64::from(k) * 0.3).chain([2.0]).collect();
    assert_eq!(recording.times_s, expected);
    for (time_s, integral) in recording.times_s.iter().zip(recording.reals("output.integral").unwrap()) {
        assert!((integral - 3.0 * time_s).abs() < 1e-12, "{time_s}");
    }
    assert_eq!(recording.columns.len(), recording.names.len());
    assert!(matches!(recording.column("output.text"), Some(Column::Text(_))));
    assert!(matches!(recording.column("output.boolean"), Some(Column::Boolean(_))));
    assert!(recording.columns.iter().all(|column| column.numbers().len() == 8));
    assert!(recording.column("parameter.real").is_none(), "only outputs are recorded by default");
}

#[test]
fn an_input_table_drives_the_simulation() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    // u = t up to 4, then 4; a step of 0.5 holds u over each step unless slopes are given.
    let table = InputTable::parse(
        fmu.description(),
        &["time", "input.real", "input.integer"],
        &[vec!["0", "0", "1"], vec!["4", "4", "2"], vec!["8", "4", "3"]],
    )
    .unwrap();
    let integral = |input_derivatives: bool| {
        let record = Some(fmu.select("output.*").unwrap());
        let options = Options { inputs: Some(&table), input_derivatives, record, ..over(8.0, 0.5) };
        let simulation = simulate(&fmu, options).unwrap();
        let counted = simulation.recording.column("output.integer").unwrap().number(16);
        assert_eq!(counted, 2.0, "the value at the start of the last step");
        simulation.recording.reals("output.integral").unwrap()[16]
    };
    // Held: sum of k/2 * 1/2 for k < 8, plus 16. With slopes the ramp is exact: 8 + 16.
    assert!((integral(false) - 23.0).abs() < 1e-12, "{}", integral(false));
    assert!((integral(true) - 24.0).abs() < 1e-12, "{}", integral(true));
}

#[test]
fn a_choice_is_set_by_its_items_name() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let run = |item: &str| {
        let sets = vec![("input.choice".to_owned(), Value::Text(item.to_owned()))];
        let record = Some(fmu.select("output.choice").unwrap());
        simulate(&fmu, Options { sets, record, ..over(1.0, 1.0) })
    };
    let Column::Integer(values) = &run("blue").unwrap().recording.columns[0] else { panic!("no choice") };
    assert_eq!(values.last(), Some(&4));
    let refused = run("violet").unwrap_err().to_string();
    assert!(refused.contains("violet") && refused.contains("blue"), "{refused}");
}

#[test]
fn recording_less_often_keeps_the_last_point() {
    let Some((_folder, fmu)) = probe("Empty").or(probe("AllTypes")) else { return };
    let simulation = simulate(&fmu, Options { record_every_s: Some(4.0), ..over(10.5, 1.0) }).unwrap();
    assert_eq!(simulation.recording.times_s, [0.0, 4.0, 8.0, 10.5]);
}

#[test]
fn rows_stand_at_the_times_that_are_given() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    // u = t, held over each step of 0.5 s.
    let rows = [vec!["0", "0"], vec!["4", "4"]];
    let table = InputTable::parse(fmu.description(), &["time", "input.real"], &rows).unwrap();
    let record = Some(fmu.select("output.integral").unwrap());
    // Within steps, several in one, at a communication point but for rounding, and at the stop.
    let at_s = [0.0, 0.2, 0.3, 0.7, 1.5 - 1e-12, 1.5 + 0.1, 2.0];
    let options = Options { inputs: Some(&table), record, record_at_s: Some(&at_s), ..over(2.0, 0.5) };
    let recording = simulate(&fmu, options).unwrap().recording;
    assert_eq!(recording.times_s, at_s);
    let integral = |time_s: f64| {
        let steps = (time_s / 0.5 + 1e-9).floor();
        0.125 * steps * (steps - 1.0) + 0.5 * steps * (time_s - 0.5 * steps)
    };
    for (time_s, found) in at_s.iter().zip(recording.reals("output.integral").unwrap()) {
        assert!((integral(*time_s) - found).abs() < 1e-11, "{time_s}: {found}");
    }
}

#[test]
fn cancelling_keeps_what_was_simulated() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    let mut progress = |time_s: f64| time_s < 5.0;
    let simulation = simulate(&fmu, Options { progress: Some(&mut progress), ..over(100.0, 1.0) }).unwrap();
    assert_eq!(simulation.ended, Ended::Cancelled);
    let last_s = *simulation.recording.times_s.last().unwrap();
    assert_eq!(last_s, 5.0);
    let rows = simulation.recording.times_s.len();
    assert!(simulation.recording.columns.iter().all(|it| it.numbers().len() == rows));
}

/// Inputs under which the Panicking probe meets `fault` from 3 s on.
fn fault_at_3_s(fmu: &fmi::Fmu, fault: &str) -> InputTable {
    let variable = fmu.variable("fault").unwrap();
    let item = fmi::parse_value(fmu.description(), variable, fault).unwrap();
    let rows = [vec!["0".to_owned(), "1".to_owned()], vec!["3".to_owned(), item.to_string()]];
    InputTable::parse(fmu.description(), &["time".to_owned(), "fault".to_owned()], &rows).unwrap()
}

#[test]
fn an_fmu_that_ends_by_itself_is_no_error() {
    let Some((_folder, fmu)) = probe("Panicking") else { return };
    let table = fault_at_3_s(&fmu, "terminateStep");
    let simulation = simulate(&fmu, Options { inputs: Some(&table), ..over(10.0, 1.0) }).unwrap();
    assert_eq!(simulation.ended, Ended::ByItself);
    assert!(*simulation.recording.times_s.last().unwrap() <= 4.0);
}

#[test]
fn an_error_on_the_way_keeps_what_was_simulated() {
    let Some((_folder, fmu)) = probe("Panicking") else { return };
    let table = fault_at_3_s(&fmu, "failStep");
    let stopped = simulate(&fmu, Options { inputs: Some(&table), ..over(10.0, 1.0) }).unwrap_err();
    assert_eq!(stopped.partial.times_s, [0.0, 1.0, 2.0, 3.0]);
    assert!(stopped.to_string().contains("fmi2DoStep(currentCommunicationPoint=3"), "{stopped}");
}

#[test]
fn what_cannot_be_set_is_refused_before_the_simulation() {
    let Some((_folder, fmu)) = probe("AllTypes") else { return };
    for name in ["output.real", "role.outputConstant", "no.such.name"] {
        let sets = vec![(name.to_owned(), real(1.0))];
        let stopped = simulate(&fmu, Options { sets, ..Options::default() }).unwrap_err();
        assert!(stopped.to_string().contains(name), "{stopped}");
        assert!(stopped.partial.times_s.is_empty());
    }
}
