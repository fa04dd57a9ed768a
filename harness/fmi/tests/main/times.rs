//! Communication points carry no accumulated error and the last one is the stop time itself.

use fmi::{Options, RecordedPoints, Times, simulate};
use model_description::DefaultExperiment;

use crate::{description, folder};

fn times(start: Option<f64>, stop: Option<f64>, step: Option<f64>) -> Result<Times, String> {
    let (_folder, fmu) = folder(&description());
    Times::from_fmu(&fmu, start, stop, step).map_err(|error| error.to_string())
}

#[test]
fn the_default_experiment_fills_in() {
    let default = times(None, None, None).unwrap();
    assert_eq!(default, Times { start_s: 0.0, stop_s: 10.0, step_s: 0.1 });
    assert_eq!(default.steps(), 100);
    assert_eq!(times(None, Some(5.0), None).unwrap().steps(), 50);

    // Without one, something that just runs.
    let mut bare = description();
    bare.default_experiment = None;
    let (_folder, fmu) = folder(&bare);
    let bare = Times::from_fmu(&fmu, None, None, None).unwrap();
    assert_eq!((bare.start_s, bare.stop_s, bare.steps()), (0.0, 1.0, 100));
}

#[test]
fn points_are_products() {
    let times = times(Some(0.0), Some(7_776_000.0), Some(0.1)).unwrap();
    for k in [0, 1, 3, 7, 1_234_567, 77_759_999] {
        // One rounding of the product; the sum of k steps is off by thousands of them.
        let exact_tenths = k as f64;
        assert!((times.point_s(k) * 10.0 - exact_tenths).abs() <= exact_tenths * f64::EPSILON, "{k}");
    }
    assert_eq!(times.point_s(times.steps()), 7_776_000.0);
    assert!((0..times.steps()).step_by(999_983).all(|k| times.point_s(k) < times.point_s(k + 1)));
}

#[test]
fn the_last_step_is_shortened_but_rounding_makes_no_extra_one() {
    let uneven = times(Some(-1.0), Some(1.0), Some(0.75)).unwrap();
    let points: Vec<f64> = (0..=uneven.steps()).map(|k| uneven.point_s(k)).collect();
    assert_eq!(points, [-1.0, -0.25, 0.5, 1.0]);
    for step in [0.1, 0.3 / 3.0, 1.0 / 30.0, 1e-3, 0.7] {
        let stop = 3000.0 * step;
        assert_eq!(times(None, Some(stop), Some(step)).unwrap().steps(), 3000, "{step}");
    }
    assert_eq!(times(None, Some(1.0), Some(5.0)).unwrap().steps(), 1);
}

#[test]
fn times_that_make_no_run_name_their_flag() {
    for (start, stop, step, expected) in [
        (None, Some(0.0), None, "--stop"),
        (Some(11.0), None, None, "--start"),
        (None, Some(f64::NAN), None, "--stop"),
        (None, Some(f64::INFINITY), None, "--stop"),
        (None, None, Some(0.0), "--step"),
        (None, None, Some(-1.0), "--step"),
        (None, None, Some(f64::NAN), "--step"),
        (None, None, Some(1e-13), "--step"),
        (Some(1e300), Some(2e300), Some(1.0), "--step"),
    ] {
        let error = times(start, stop, step).unwrap_err();
        assert!(error.contains(expected), "{error} does not name {expected}");
    }
}

#[test]
fn an_fmu_of_one_step_size_gets_no_shortened_step() {
    let mut fixed = description();
    fixed.co_simulation.as_mut().unwrap().can_handle_variable_communication_step_size = false;
    fixed.default_experiment =
        Some(DefaultExperiment { step_size: Some(0.3), ..fixed.default_experiment.unwrap_or_default() });
    let (_folder, fmu) = folder(&fixed);
    let error = Times::from_fmu(&fmu, None, Some(1.0), None).unwrap_err().to_string();
    assert!(error.contains("does not divide"), "{error}");
    assert!(Times::from_fmu(&fmu, None, Some(1.2), None).is_ok());
}

#[test]
fn more_points_than_memory_is_given_for_are_refused_before_the_simulation() {
    // The folder has no library: what would be simulated fails for that reason.
    let (_folder, fmu) = folder(&description());
    let simulate = |stop_s: f64, step_s: f64, record_every_s: Option<f64>, record: Option<Vec<usize>>| {
        let times = Options { stop_s: Some(stop_s), step_s: Some(step_s), ..Options::default() };
        simulate(&fmu, Options { record_every_s, record, ..times }).unwrap_err().to_string()
    };
    // Two outputs and the time are 24 bytes a point, so that 41,666,666 points stay within 1e9 bytes.
    let error = simulate(5.0, 1e-9, None, None);
    for part in
        ["5000000001 points of 2 variables", "allowed are 41666666 points", "--every", "--record", "--step"]
    {
        assert!(error.contains(part), "{error} lacks {part}");
    }
    assert!(simulate(41_666_666.0, 1.0, None, None).contains("41666667 points"));
    for error in [
        simulate(41_666_665.0, 1.0, None, None),
        simulate(5.0, 1e-9, Some(1e-6), None),
        simulate(1e12, 1.0, Some(1e5), None),
        simulate(100_000_000.0, 1.0, None, Some(vec![])),
    ] {
        assert!(error.contains("no shared library"), "{error}");
    }
    for every_s in [-1.0, f64::NAN] {
        assert!(simulate(5.0, 1.0, Some(every_s), None).contains("--every"), "{every_s}");
    }
}

#[test]
fn the_point_nearest_to_each_multiple_is_recorded() {
    for (stop_s, step_s, every_s) in [
        (1000.0, 60.0, 100.0),
        (60.0, 0.3, 1.0),
        (600.0, 60.0, 120.0),
        (10.0, 1.0, 0.25),
        (90.0, 0.1, 0.7),
        (7.0, 1.0, 100.0),
    ] {
        let times = Times::new(0.0, stop_s, step_s).unwrap();
        let recorded = RecordedPoints::new(&times, Some(every_s)).unwrap();
        let found: Vec<u64> = (0..=times.steps()).filter(|k| recorded.contain(*k)).collect();
        assert_eq!(found.len() as u64, recorded.count(), "{step_s}, {every_s}");
        // By looking at every point; steps longer than the time are recorded all.
        let mut expected = vec![times.steps()];
        let multiples = (0..)
            .map(|n| f64::from(n) * every_s.max(step_s))
            .take_while(|at_s| *at_s < stop_s + 0.499 * step_s);
        for at_s in multiples {
            let distance = |k: &u64| (*k as f64 * step_s - at_s).abs();
            let nearest =
                (0..=times.steps()).min_by(|a, b| distance(a).total_cmp(&distance(b)).then(b.cmp(a)));
            expected.extend(nearest);
        }
        expected.sort_unstable();
        expected.dedup();
        assert_eq!(found, expected, "{step_s}, {every_s}");
    }
}
