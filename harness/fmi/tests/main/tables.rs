//! Input tables: linear between rows, held where discrete, jumps kept; bad tables named by line.

use fmi::{InputTable, Times, Value};

use crate::{description, folder};

fn table(rows: &[&[&str]]) -> Result<InputTable, String> {
    let (_folder, fmu) = folder(&description());
    let (header, rows) = rows.split_first().unwrap();
    let rows: Vec<Vec<&str>> = rows.iter().map(|row| row.to_vec()).collect();
    InputTable::parse(fmu.description(), header, &rows).map_err(|error| error.to_string())
}

fn number(table: &InputTable, column: usize, time_s: f64) -> f64 {
    table.value(column, time_s).to_f64()
}

#[test]
fn continuous_inputs_are_interpolated_and_discrete_ones_held() {
    let table = table(&[
        &["time", "drive.push", "drive.held", "drive.on"],
        &["0", "0", "10", "false"],
        &["2", "4 m", "20", "true"],
        &["4", "400cm", "30", "0"],
    ])
    .unwrap();
    for (time_s, push, held, on) in [
        (-1.0, 0.0, 10.0, 0.0),
        (0.0, 0.0, 10.0, 0.0),
        (1.0, 2.0, 10.0, 0.0),
        (1.999, 3.998, 10.0, 0.0),
        (2.0, 4.0, 20.0, 1.0),
        (3.0, 4.0, 20.0, 1.0),
        (9.0, 4.0, 30.0, 0.0),
    ] {
        assert!((number(&table, 0, time_s) - push).abs() < 1e-12, "push at {time_s}");
        assert_eq!(number(&table, 1, time_s), held, "held at {time_s}");
        assert_eq!(table.value(2, time_s), Value::Boolean(on == 1.0), "on at {time_s}");
    }
    for (start_s, slope) in [(0.0, 2.0), (2.0, 0.0), (-1.0, 0.0), (9.0, 0.0), (1.5, 1.0)] {
        assert_eq!(table.slope(0, [start_s, start_s + 1.0]), Some(slope), "slope at {start_s}");
    }
    assert_eq!(table.slope(1, [1.0, 2.0]), None);
}

#[test]
fn two_rows_at_one_time_make_a_jump() {
    let table =
        table(&[&["time", "drive.push"], &["0", "0"], &["1", "1"], &["1", "5"], &["2", "5"]]).unwrap();
    assert!((number(&table, 0, 1.0 - 1e-9) - 1.0).abs() < 1e-8);
    assert_eq!(number(&table, 0, 1.0), 5.0);
    // Up to the jump alone.
    for (step_s, slope) in [([1.0, 2.0], 0.0), ([0.5, 1.0], 1.0), ([0.5, 1.5], 1.0)] {
        assert_eq!(table.slope(0, step_s), Some(slope), "slope over {step_s:?}");
    }
}

#[test]
fn held_values_between_two_communication_points_are_named() {
    let rows: &[&[&str]] = &[
        &["time", "drive.push", "drive.held", "drive.on"],
        &["0", "0", "1", "true"],
        &["3", "1", "1", "false"],
        &["12", "0", "2", "true"],
        &["15", "9", "1", "false"],
        &["25", "0", "3", "false"],
        &["28", "0", "4", "false"],
        &["31", "0", "4", "true"],
        &["33", "0", "4", "false"],
    ];
    let table = table(rows).unwrap();
    let description = description();
    let lines = |step_s: f64| table.lost_pulses(&description, &Times::new(0.0, 40.0, step_s).unwrap());
    // What is continuous is not lost; a staircase neither: 3 is passed on the way from 1 to 4.
    let [held, on] = &lines(10.0)[..] else { panic!("{:?}", lines(10.0)) };
    assert!(
        held.starts_with(
            "drive.held is 2 from 12 s to 15 s alone, between the communication points at 10 s and 20 s: "
        ),
        "{held}"
    );
    assert!(held.contains("at most 3 s"), "{held}");
    assert!(
        on.starts_with("drive.on is true from 12 s to 15 s alone") && on.contains("1 more like it"),
        "{on}"
    );
    assert!(on.contains("at most 2 s does (now 10 s)"), "{on}");
    let [on] = &lines(3.0)[..] else { panic!("{:?}", lines(3.0)) };
    assert!(on.starts_with("drive.on is true from 31 s to 33 s alone"), "{on}");
    assert!(lines(2.0).is_empty());
}

#[test]
fn bad_tables_are_named_by_line_and_column() {
    let cases: [(&[&[&str]], &str); 10] = [
        (&[&[]], "empty"),
        (&[&["t", "drive.push"], &["0", "0"]], "must be time"),
        (&[&["time", "drive.push"]], "no rows"),
        (&[&["time", "drive.puhs"], &["0", "0"]], "near it: drive.push"),
        (&[&["time", "position[1]"], &["0", "0"]], "position[1] cannot change"),
        (&[&["time", "ship.arm[1]"], &["0", "0"]], "ship.arm[1] cannot change"),
        (&[&["time", "drive.push", "drive.push"], &["0", "0", "0"]], "stands twice"),
        (&[&["time", "drive.push"], &["0", "0"], &["1"]], "line 3 has 1 cells, the header has 2"),
        (&[&["time", "drive.push"], &["0", "0"], &["-1", "0"]], "line 3: time -1 is before"),
        (&[&["time", "drive.push"], &["0", "x"]], "line 2: drive.push"),
    ];
    for (rows, expected) in cases {
        let error = table(rows).unwrap_err();
        assert!(error.contains(expected), "{error} lacks {expected}");
    }
    for time in ["nan", "inf", "soon", ""] {
        assert!(table(&[&["time", "drive.push"], &[time, "0"]]).unwrap_err().contains("is no number"));
    }
}
