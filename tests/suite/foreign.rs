//! The harness runs an FMU that others built: FMPy's container, whose C library loads our plant in turn.

use fmi::{Fmu, Options, simulate};

use crate::support::{built, names, ok, silent};

const STEP_S: f64 = 600.0;
const DAYS: f64 = 10.0;

#[test]
fn a_foreign_fmu_runs_in_our_harness_to_our_numbers() {
    let Some(path) = built("HELIOTORQUE_FOREIGN_FMU") else { return };
    let fmu = Fmu::open(path).unwrap();
    let options = Options { stop_s: Some(DAYS * 86_400.0), step_s: Some(STEP_S), ..Options::default() };
    let simulation = simulate(&fmu, options).unwrap();
    let recording = simulation.recording;
    let names = names("MomentumPlant");
    let (mut plant, mut value) = (silent("MomentumPlant"), [0.0]);
    ok(plant.start(0.0, None));
    for (row, time_s) in recording.times_s.iter().enumerate().skip(1) {
        ok(plant.do_step(time_s - STEP_S, STEP_S));
        for axis in [1, 3] {
            ok(plant.get_real(&[names.real(&format!("momentum.body[{axis}]"))], &mut value));
            let column = recording.column(&format!("plant.momentum.body[{axis}]")).unwrap();
            assert_eq!(column.number(row), value[0], "axis {axis} at {time_s} s");
        }
    }
    assert_eq!(recording.times_s.len(), (DAYS * 86_400.0 / STEP_S) as usize + 1);
    assert!(value[0].abs() > 0.01, "the simulation moved nothing");
}
