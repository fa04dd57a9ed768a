//! Recorded trajectories under `tests/reference`: a change that moves a number is seen, and made on purpose.
//!
//! Every simulation is a `heliotorque run` of a packed FMU. A value may differ from the recorded one by 1e-12 of its column's
//! largest magnitude (which a reordered sum stays below), a time of an event by 1e-9 s and four units in the last place.
//! After a deliberate change `cargo xtask bless reference` writes the files and their pictures anew.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::support::built;

/// Largest difference relative to the largest magnitude of a column.
const RELATIVE: f64 = 1e-12;
/// Largest difference of the time of an event, in s, beside four units in the last place.
const EVENT_S: f64 = 1e-9;
/// Columns that hold times of events.
const EVENT_TIMES: &[&str] = &["dump.lastTime", "burn.nextEdge", "starTracker.sampleTime"];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("reference")
}

/// Runs `fmu` with `arguments` and compares with `reference/<name>.csv`.
#[track_caller]
fn compare(heliotorque: &Path, fmu: &Path, name: &str, arguments: &[&str]) {
    let scratch = tempfile::tempdir().unwrap();
    let found_path = scratch.path().join("found.csv");
    let bless = std::env::var_os("HELIOTORQUE_BLESS").is_some();
    let mut run = Command::new(heliotorque);
    run.arg("run").arg(fmu).args(["--quiet", "--output"]).arg(&found_path).args(arguments);
    if bless {
        run.arg("--output").arg(folder().join(format!("{name}.svg")));
    }
    let output = run.output().unwrap();
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    let found = fs::read_to_string(&found_path).unwrap();
    let path = folder().join(format!("{name}.csv"));
    if bless {
        fs::write(&path, &found).unwrap();
    }
    let recorded = fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    if let Some(difference) = difference(&recorded, &found) {
        panic!("{name}: {difference}\nIf that is meant: cargo xtask bless reference");
    }
}

fn rows(text: &str) -> (Vec<&str>, Vec<Vec<f64>>) {
    let mut lines = text.lines();
    let names = lines.next().unwrap_or_default().split(',').collect();
    let numbers = |line: &str| line.split(',').map(|cell| cell.parse().unwrap_or(f64::NAN)).collect();
    (names, lines.map(numbers).collect())
}

/// The first difference beyond what is allowed.
fn difference(recorded: &str, found: &str) -> Option<String> {
    let ((names, recorded), (found_names, found)) = (rows(recorded), rows(found));
    if names != found_names || recorded.len() != found.len() {
        return Some(format!(
            "recorded {names:?} in {} rows, found {found_names:?} in {} rows",
            recorded.len(),
            found.len()
        ));
    }
    for (column, name) in names.iter().enumerate() {
        let largest = recorded.iter().map(|row| row[column].abs()).fold(0.0, f64::max);
        for (row, (recorded, found)) in recorded.iter().zip(&found).enumerate() {
            let (recorded, found) = (recorded[column], found[column]);
            let allowed = if EVENT_TIMES.contains(name) {
                EVENT_S + 4.0 * f64::EPSILON * recorded.abs()
            } else {
                RELATIVE * largest
            };
            // Written so that a NaN is a difference.
            let same = (recorded - found).abs() <= allowed;
            if !same {
                return Some(format!(
                    "{name} in row {}: recorded {recorded:e}, found {found:e}, {:e} of the largest magnitude",
                    row + 1,
                    (recorded - found).abs() / largest
                ));
            }
        }
    }
    None
}

#[test]
fn messenger_runs_90_days_as_recorded() {
    let (Some(heliotorque), Some(dist)) = (built("HELIOTORQUE"), built("HELIOTORQUE_DIST")) else { return };
    let arguments = [
        "--stop=90d",
        "--step=600",
        "--every=7h",
        "--set=spacecraft.centerOfMass[3]=-2.54cm",
        "--set=dump.threshold=4,4,4",
        "--record=momentum.body,momentum.inertial,deltaV,torque.solar,torque.gravityGradient",
        "--record=attitude.q,attitude.rate,sun.elevation,sun.litFraction,dump.count,dump.lastTime,dump.impulse",
        "--record=position,velocity,heliocentric.position",
    ];
    compare(&heliotorque, &dist.join("MomentumPlant.fmu"), "messenger-90-days", &arguments);
}

#[test]
fn the_orbiter_runs_10_days_with_every_effect_as_recorded() {
    let (Some(heliotorque), Some(dist)) = (built("HELIOTORQUE"), built("HELIOTORQUE_DIST")) else { return };
    let scratch = tempfile::tempdir().unwrap();
    let fmu = scratch.path().join("Orbiter.fmu");
    let resources = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("fmu-src").join("resources");
    let packed = Command::new(&heliotorque)
        .args(["pack", "--name", "Orbiter", "--per-plate", "--template"])
        .arg(dist.join("MomentumPlant.fmu"))
        .arg("--spacecraft")
        .arg(resources.join("examples").join("mercury-orbiter.toml"))
        .arg("--output")
        .arg(&fmu)
        .output()
        .unwrap();
    assert!(packed.status.success(), "{}", String::from_utf8_lossy(&packed.stderr));
    let arguments = [
        "--stop=10d",
        "--step=60",
        "--every=1h",
        "--set=planetLight.enabled=true",
        "--set=thermal.enabled=true",
        "--set=shadowing.enabled=true",
        "--set=orbit.dynamics=disturbed",
        "--set=dump.threshold[1]=4",
        "--set=dump.threshold[2]=4",
        "--set=dump.threshold[3]=4",
        "--set=dump.reinitTo=opposite",
        "--record=momentum.body,momentum.inertial,deltaV,position,velocity,attitude.q,sun.litFraction",
        "--record=torque.solar,torque.albedo,torque.infrared,torque.thermal,torque.gravityGradient",
        "--record=force.solar,force.albedo,force.infrared,force.thermal",
        "--record=plate[1].temperature,plate[2].temperature,dump.count,dump.lastTime",
    ];
    compare(&heliotorque, &fmu, "orbiter-10-days", &arguments);
}

#[test]
fn ace_runs_its_manoeuvre_as_recorded() {
    let (Some(heliotorque), Some(dist)) = (built("HELIOTORQUE"), built("HELIOTORQUE_DIST")) else { return };
    let arguments = [
        "--stop=1400",
        "--step=1",
        "--every=10",
        "--record=attitude.q,attitude.rate,momentum.inertial,nutation.angle,nutation.predicted,spin.rate,spin.period",
        "--record=spinAxis.displacement,burn.pulsesFired,burn.nextEdge,deltaV,mass,starTracker.sampleTime",
    ];
    compare(&heliotorque, &dist.join("SpinPlant.fmu"), "ace-manoeuvre", &arguments);
}

/// Sun and planet all around the spacecraft, its panels at any angle: a row a geometry.
fn geometries() -> String {
    use core::fmt::Write;
    let mut table = "time".to_owned();
    for name in ["sun.positionBody", "planet.positionBody"] {
        for axis in 1..=3 {
            write!(table, ",{name}[{axis}]").unwrap();
        }
    }
    table.push_str(",panel[1].angle,panel[2].angle\n");
    // Directions at equal areas along a spiral; whole numbers, so that every machine writes the same text.
    for row in 0..240 {
        let place = |offset: i64, distance: f64| {
            let phase = (row * 137 + offset * 71) % 360;
            let height = ((row * 59 + offset * 31) % 199 - 99) as f64 / 100.0;
            let (sine, cosine) = (phase as f64).to_radians().sin_cos();
            let across = (1.0 - height * height).sqrt();
            [across * cosine, across * sine, height].map(|it| (it * distance).round())
        };
        let sun = place(0, 4.6e10 + 1e8 * row as f64);
        let planet = place(5, 2.7e6 + 5e4 * row as f64);
        write!(table, "{row}").unwrap();
        for value in sun.into_iter().chain(planet) {
            write!(table, ",{value}").unwrap();
        }
        writeln!(table, ",{},{}", (row * 7 % 63 - 31) as f64 / 10.0, (row * 11 % 63 - 31) as f64 / 10.0)
            .unwrap();
    }
    table
}

#[test]
fn disturbance_torque_is_as_recorded_over_a_grid() {
    let (Some(heliotorque), Some(dist)) = (built("HELIOTORQUE"), built("HELIOTORQUE_DIST")) else { return };
    let scratch = tempfile::tempdir().unwrap();
    let inputs = scratch.path().join("inputs.csv");
    fs::write(&inputs, geometries()).unwrap();
    let input = format!("--input={}", inputs.display());
    let arguments =
        ["--start=0", "--stop=239", "--step=1", &input, "--record=force.*,torque.*,sun.litFraction"];
    compare(&heliotorque, &dist.join("DisturbanceTorque.fmu"), "disturbance-grid", &arguments);
}

#[test]
fn a_difference_beyond_what_is_allowed_is_seen() {
    let recorded = "time,a,dump.lastTime\n0,1,-1\n1,1000,1e6\n";
    assert_eq!(difference(recorded, recorded), None);
    let moved = |from: &str, to: &str| difference(recorded, &recorded.replace(from, to));
    assert_eq!(moved("0,1,", "0,1.0000000009,"), None);
    assert!(moved("0,1,", "0,1.0000000011,").unwrap().contains("a in row 1"));
    assert_eq!(moved("1e6", "1000000.000000001"), None);
    assert!(moved("1e6", "1000000.000000003").unwrap().contains("dump.lastTime in row 2"));
    assert!(moved("1000", "NaN").is_some());
    assert!(moved("1,1000,1e6\n", "").unwrap().contains("rows"));
}
