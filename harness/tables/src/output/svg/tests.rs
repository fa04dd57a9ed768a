//! What belongs together shares a panel.
use model_description::Annotation;

use super::*;

const SHIP: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Ship" guid="{ship}">
  <CoSimulation modelIdentifier="Ship"/>
  <TypeDefinitions><SimpleType name="Mode"><Enumeration><Item name="nadir" value="1"/><Item name="burn" value="2"/><Item name="safe" value="4"/></Enumeration></SimpleType></TypeDefinitions>
  <ModelVariables>
<ScalarVariable name="push[1]" valueReference="0" causality="input"><Real start="0"/></ScalarVariable>
<ScalarVariable name="push[2]" valueReference="1" causality="input"><Real start="0"/></ScalarVariable>
<ScalarVariable name="angle" valueReference="2" causality="output"><Real unit="rad"/></ScalarVariable>
<ScalarVariable name="load.light[1]" valueReference="4" causality="output"><Real unit="N"/></ScalarVariable>
<ScalarVariable name="load.air[1]" valueReference="5" causality="output"><Real unit="N"/></ScalarVariable>
<ScalarVariable name="mode" valueReference="3" causality="output" variability="discrete"><Enumeration declaredType="Mode"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure/>
</fmiModelDescription>"#;

/// The chart of a recording of these columns at 0 s, 1 s and so on.
fn drawn_chart(columns: &[(&str, Column)], context: &DisplayContext) -> Chart {
    let description = model_description::parse(SHIP.as_bytes()).unwrap().description;
    let rows = columns.first().map_or(0, |(_, column)| column.numbers().len());
    let recording = Recording {
        times_s: (0..rows).map(|row| row as f64).collect(),
        names: columns.iter().map(|(name, _)| (*name).to_owned()).collect(),
        units: vec![String::new(); columns.len()],
        columns: columns.iter().map(|(_, column)| column.clone()).collect(),
    };
    chart(&description, &recording, context, "--record").0
}

/// The labels of each panel of a recording of two points.
fn panels(columns: &[(&str, f64)]) -> Vec<Vec<String>> {
    let columns: Vec<_> =
        columns.iter().map(|(name, last)| (*name, Column::Real(vec![0.0, *last]))).collect();
    let labels = |panel: Panel| panel.series.into_iter().map(|series| series.label).collect();
    drawn_chart(&columns, &DisplayContext::default()).panels.into_iter().map(labels).collect()
}

#[test]
fn the_components_of_vectors_are_named_once_beside_the_title() {
    let real = |last: f64| Column::Real(vec![0.0, last]);
    let names = ["torque[1]", "torque[2]", "torque[3]", "force[1]", "force[2]", "force[3]", "q[4]", "lone"];
    let columns: Vec<_> = names.iter().map(|name| (*name, real(1.0))).collect();
    let chart = drawn_chart(&columns, &DisplayContext::default());
    assert_eq!(chart.legend, ["x", "y", "z"]);
    let labels: Vec<Vec<&str>> = chart
        .panels
        .iter()
        .map(|panel| panel.series.iter().map(|series| series.label.as_str()).collect())
        .collect();
    assert_eq!(labels, [vec![""; 3], vec![""; 3], vec!["w"], vec![""]]);
    let alone = drawn_chart(&columns[..3], &DisplayContext::default());
    assert!(alone.legend.is_empty());
    assert_eq!(alone.panels[0].series[2].label, "z");
}

#[test]
fn what_stays_the_same_has_no_panel() {
    let real = |values: [f64; 2]| Column::Real(values.to_vec());
    let chart = drawn_chart(
        &[("still[1]", real([2.0, 2.0])), ("moves", real([0.0, 1.0])), ("still[2]", real([3.0, 3.0]))],
        &DisplayContext::default(),
    );
    assert_eq!(chart.panels.iter().map(|panel| panel.y_label.as_str()).collect::<Vec<_>>(), ["moves"]);
    let still = drawn_chart(&[("still[1]", real([2.0, 2.0]))], &DisplayContext::default());
    assert_eq!(still.panels.len(), 1, "nothing else is there");
}

#[test]
fn rounding_is_drawn_as_nothing() {
    let real = |values: [f64; 3]| Column::Real(values.to_vec());
    let labels = |columns: &[(&str, Column)]| -> Vec<String> {
        drawn_chart(columns, &DisplayContext::default()).panels.into_iter().map(|it| it.y_label).collect()
    };
    let moves = || ("moves", real([0.0, 1.0, 2.0]));
    let angle = |values| ("angle", real(values));
    assert_eq!(labels(&[angle([9e-17, -2e-17, 4e-17]), moves()]), ["moves"]);
    assert_eq!(labels(&[angle([1e-9, 0.0, 2e-9]), moves()]), ["angle [rad]", "moves"]);
    assert_eq!(labels(&[("far", real([1.5e11, 1.5e11 + 1e-3, 1.5e11])), moves()]), ["moves"]);
    // Small by itself is no rounding.
    assert_eq!(labels(&[("tiny", real([1e-18, 2e-18, 0.0])), moves()]), ["tiny", "moves"]);
    // Beside other loads it is, and has no panel.
    let loads =
        |air: f64| [("load.light[1]", real([0.0, 1e-3, 2e-3])), ("load.air[1]", real([0.0, air, -air]))];
    assert_eq!(labels(&loads(1e-15)), ["load.light [N]"]);
    assert_eq!(labels(&loads(4e-15)), ["load.light [N]", "load.air [N]"]);
    // Within a vector it is, and there its line is straight; so is what is drawn alone.
    let vector = [("force[1]", real([0.0, 1e-3, 2e-3])), ("force[2]", real([1e-19, -1e-19, 0.0]))];
    for columns in [&vector[..], &[angle([9e-17, -2e-17, 4e-17])]] {
        let chart = drawn_chart(columns, &DisplayContext::default());
        let last = chart.panels[0].series.last().unwrap();
        assert!(last.points.iter().all(|(_, value)| *value == 0.0), "{:?}", last.points);
    }
}

#[test]
fn counts_and_flags_are_staircases_on_whole_numbers() {
    let chart = drawn_chart(
        &[("count", Column::Integer(vec![0, 0, 2])), ("flag", Column::Boolean(vec![false, true, true]))],
        &DisplayContext::default(),
    );
    for panel in &chart.panels {
        assert!(panel.is_whole && panel.series[0].mark == Mark::Steps, "{}", panel.y_label);
    }
    assert!(
        !drawn_chart(&[("x", Column::Real(vec![0.0, 1.0]))], &DisplayContext::default()).panels[0].is_whole
    );
}

#[test]
fn eclipses_are_spans_of_a_sun_that_is_not_whole() {
    let recording = |lit: &[f64]| Recording {
        times_s: (0..lit.len()).map(|row| 60.0 * row as f64).collect(),
        names: vec!["plant.lit".to_owned()],
        units: vec![String::new()],
        columns: vec![Column::Real(lit.to_vec())],
    };
    let annotation = Annotation { role: Some(VariableRole::LitFraction), ..Annotation::default() };
    let lit = ScalarVariable {
        name: "plant.lit".to_owned(),
        annotation: Some(Box::new(annotation)),
        ..ScalarVariable::default()
    };
    let described = Description { variables: vec![lit], ..Description::default() };
    let spans = |recording: &Recording| eclipses(&described, recording, 60.0);
    assert_eq!(spans(&recording(&[1.0, 0.4, 0.0, 1.0, 1.0, 0.9])), [(1.0, 3.0), (5.0, 5.0)]);
    assert_eq!(spans(&recording(&[1.0, 1.0])), []);
    assert_eq!(spans(&Recording::default()), []);
    assert_eq!(eclipses(&Description::default(), &recording(&[0.5]), 60.0), []);
}

#[test]
fn a_group_shares_a_panel_wherever_its_variables_stand() {
    let wheels = ["momentum", "speed", "torque"]
        .map(|quantity| ["wheel[1].", "wheel[2]."].map(|wheel| format!("{wheel}{quantity}")));
    let order: Vec<(&str, f64)> =
        (0..2).flat_map(|wheel| wheels.iter().map(move |names| (names[wheel].as_str(), 1.0))).collect();
    assert_eq!(order[1].0, "wheel[1].speed");
    assert_eq!(panels(&order), wheels.map(Vec::from));
    // An eighth line opens a panel of its own.
    let many: Vec<String> = (1..=8).map(|k| format!("plate[{k}].temperature")).collect();
    let many: Vec<(&str, f64)> = many.iter().map(|name| (name.as_str(), 1.0)).collect();
    let counts: Vec<usize> = panels(&many).iter().map(Vec::len).collect();
    assert_eq!(counts, [COLOURS.len(), 1]);
}

#[test]
fn inputs_that_nobody_used_are_not_drawn() {
    let all = [("push[1]", 0.0), ("push[2]", 2.0), ("torque[1]", 0.0)];
    assert_eq!(panels(&all), [["y"]]);
    assert_eq!(panels(&all[..1]), [["x"]], "nothing else is there");
}

#[test]
fn vectors_and_counted_quantities_are_groups() {
    for (name, expected) in [
        ("torque.solar[2]", "torque.solar"),
        ("plate[12].temperature", "plate.temperature"),
        ("plate[12].force[3]", "plate[12].force"),
        ("sun.litFraction", "sun.litFraction"),
    ] {
        assert_eq!(group(name), expected);
    }
}

#[test]
fn enumerations_are_drawn_by_the_names_of_the_items_that_they_take() {
    let chart = drawn_chart(&[("mode", Column::Integer(vec![4, 1, 4]))], &DisplayContext::default());
    assert_eq!(chart.panels[0].names, [(1.0, "nadir".to_owned()), (4.0, "safe".to_owned())]);
    assert!(
        drawn_chart(&[("count", Column::Integer(vec![4, 1]))], &DisplayContext::default()).panels[0]
            .names
            .is_empty()
    );
}

#[test]
fn a_flight_with_dates_has_them_on_its_axis() {
    let zero_epoch_s = physics::environment::dates::epoch_s("2011-04-06 UTC").ok();
    let columns = [("moves", Column::Real((0..=10).map(f64::from).collect()))];
    let chart = drawn_chart(&columns, &DisplayContext::default().dated(zero_epoch_s));
    assert_eq!(chart.x_label, "UTC, from 2011-04-06");
    assert_eq!(chart.x_names[..2], [(0.0, "04-06".to_owned()), (1.0, "00:00:01".to_owned())]);
    assert!(drawn_chart(&columns, &DisplayContext::default()).x_names.is_empty());
}
