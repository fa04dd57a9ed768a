//! Telemetry is read by line, and what it must not hold is named.

use std::fs;

use super::super::Telemetry;

const HEADER: &str = "time,momentum.inertial[1],momentum.inertial[2],momentum.inertial[3],dump.count";

fn read(text: &str) -> Result<Telemetry, String> {
    let scratch = tempfile::tempdir().unwrap();
    let path = scratch.path().join("t.csv");
    fs::write(&path, text).unwrap();
    Telemetry::read(&path).map_err(|error| error.to_string())
}

#[test]
fn rows_are_read_in_any_order_of_columns() {
    let text = "# a recording\ndump.count,momentum.inertial[3],time,momentum.inertial[1],momentum.inertial[2]\n\
                0,3,0,1,2\n0,3.5,10,1e-1,2\n1,0,20,0,0\n1,0,30.5,0,0\n";
    let telemetry = read(text).unwrap();
    assert_eq!(telemetry.times_s, [0.0, 10.0, 20.0, 30.5]);
    assert_eq!(telemetry.momentum_inertial_n_m_s[1].as_slice(), [0.1, 2.0, 3.5]);
    assert_eq!(telemetry.dumps, [0, 0, 1, 1]);
    assert_eq!(telemetry.lines, [3, 4, 5, 6]);
    let without =
        "time,momentum.inertial[1],momentum.inertial[2],momentum.inertial[3]\n0,1,2,3\n1,1,2,3\n2,1,2,3\n";
    assert_eq!(read(without).unwrap().dumps, [0, 0, 0]);
    // Columns that it does not need may hold anything, twice too.
    let more = without.replace("]\n", "],mode,mode\n").replace(",3\n", ",3,true,\n");
    assert_eq!(read(&more).unwrap(), Telemetry { lines: vec![2, 3, 4], ..read(without).unwrap() });
}

#[test]
fn what_telemetry_must_not_hold_is_named_by_line() {
    for (rows, parts) in [
        (
            "0,1,2,3,0\n1,1,,3,0\n2,1,2,3,0",
            [":3: momentum.inertial[2]: found nothing", "a number in every row"],
        ),
        ("0,1,2,3,0\n1,1,2\n2,1,2,3,0", [":3: momentum.inertial[3]: found nothing", "a number in every row"]),
        ("0,1,2,3,0\n1,NaN,2,3,0", [":3: momentum.inertial[1]: found \"NaN\"", "allowed: a finite number"]),
        ("0,1,2,3,0\n1,inf,2,3,0", [":3: momentum.inertial[1]: found \"inf\"", "allowed: a finite number"]),
        ("0,1,2,3,0\n1,1,2,3,0,9", [":3: found 6 cells", "allowed: 5"]),
        ("0,1,2,3,0\n5,1,2,3,0\n5,1,2,3,0", [":4: time: found 5 s after 5 s", "allowed: times that grow"]),
        ("0,1,2,3,2\n5,1,2,3,1", [":3: dump.count: found 1 after 2", "allowed: a count that stays or rises"]),
        ("0,1,2,3,0.5", [":2: dump.count: found 0.5", "allowed: a whole number from 0"]),
        (
            "0,1,2,3,0\n1,1,2,3,1\n2,1,2,3,1",
            ["found 3 rows in 2 arcs", "allowed: at least 2 rows more than arcs"],
        ),
        ("", ["found 0 rows in 0 arcs", "allowed: at least 2 rows"]),
    ] {
        let found = read(&format!("{HEADER}\n{rows}\n")).unwrap_err();
        parts.iter().for_each(|part| assert!(found.contains(part), "{found} lacks {part}"));
    }
    for (header, part) in [
        (HEADER.replace("time", "time,time"), "found the column time twice"),
        (HEADER.replace("momentum.inertial[2],", ""), "found no column momentum.inertial[2]"),
        (HEADER.replace("inertial", "body"), "found no column momentum.inertial[1], allowed: time, momentum"),
    ] {
        let found = read(&format!("{header}\n")).unwrap_err();
        assert!(found.contains(part), "{found} lacks {part}");
    }
}
