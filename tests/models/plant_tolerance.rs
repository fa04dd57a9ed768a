//! A tolerance given to `fmi2SetupExperiment` is `solver.tolerance`, unless the user set that.

use client::InProcess;
use fmi_export::Library;
use fmi_export::fmi2::entry;
use model_description::Status::Ok;
use models::{Guidance, MomentumPlant};

static LIBRARY: Library = Library { entries: &[entry::<MomentumPlant>(), entry::<Guidance>()] };

/// A tolerance loose enough to change results.
const LOOSE: f64 = 1e-3;

fn reference(name: &str) -> u32 {
    let variables = LIBRARY.describe(LIBRARY.find("MomentumPlant").unwrap(), None, None).unwrap().variables;
    variables.iter().find(|it| it.name == name).unwrap().value_reference
}

/// With a tolerance of the experiment, and what the user set `solver.tolerance` to.
fn enter(plant: &mut InProcess, experiment: Option<f64>, set: Option<f64>, set_late: bool) {
    let tolerance = [reference("solver.tolerance")];
    let put = |plant: &mut InProcess| set.map(|it| assert_eq!(plant.set_real(&tolerance, &[it]), Ok));
    if !set_late {
        put(plant);
    }
    match experiment {
        Some(it) => assert_eq!(plant.setup_experiment_with_tolerance(it, 0.0), Ok),
        None => assert_eq!(plant.setup_experiment(0.0, None), Ok),
    }
    // Long cells, which only the tolerance divides.
    assert_eq!(plant.set_real(&[reference("solver.step")], &[43_200.0]), Ok);
    assert_eq!(plant.enter_initialization_mode(), Ok);
    if set_late {
        put(plant);
    }
    assert_eq!(plant.exit_initialization_mode(), Ok);
}

fn momentum_bits(plant: &mut InProcess) -> [u64; 3] {
    let first = reference("momentum.body[1]");
    let mut values = [0.0; 3];
    assert_eq!(plant.get_real(&[first, first + 1, first + 2], &mut values), Ok);
    values.map(f64::to_bits)
}

fn simulated(plant: &mut InProcess, from: u32) -> [u64; 3] {
    for i in from..4 {
        assert_eq!(plant.do_step(f64::from(i) * 21_600.0, 21_600.0), Ok, "{:?}", plant.drain_messages());
    }
    momentum_bits(plant)
}

fn flight(experiment: Option<f64>, set: Option<f64>, set_late: bool) -> [u64; 3] {
    let mut plant = InProcess::from_library(&LIBRARY, "MomentumPlant").unwrap();
    enter(&mut plant, experiment, set, set_late);
    simulated(&mut plant, 0)
}

#[test]
fn the_experiments_tolerance_counts_where_the_user_set_none() {
    let (default, loose) = (flight(None, None, false), flight(None, Some(LOOSE), false));
    assert_ne!(default, loose);
    assert_eq!(flight(Some(LOOSE), None, false), loose);
    // What the user sets goes before, in whatever order, be it the default.
    for set_late in [false, true] {
        assert_eq!(flight(Some(1e-14), Some(LOOSE), set_late), loose);
        assert_eq!(flight(Some(LOOSE), Some(1e-10), set_late), default);
    }
    // Masters give back the tolerance of the default experiment.
    let default_experiment =
        LIBRARY.describe(LIBRARY.find("MomentumPlant").unwrap(), None, None).unwrap().default_experiment;
    assert_eq!(flight(default_experiment.unwrap().tolerance, None, false), default);
    // No number is no tolerance, and one beyond the parameter's limits is the nearest within.
    assert_eq!(flight(Some(f64::NAN), None, false), default);
    assert_eq!(flight(Some(0.0), None, false), default);
    assert_eq!(flight(Some(100.0), None, false), flight(None, Some(1.0), false));
}

#[test]
fn the_experiments_tolerance_is_part_of_the_state_and_a_reset_forgets_it() {
    let loose = flight(None, Some(LOOSE), false);
    let mut plant = InProcess::from_library(&LIBRARY, "MomentumPlant").unwrap();
    enter(&mut plant, Some(LOOSE), None, false);
    assert_eq!(plant.do_step(0.0, 21_600.0), Ok);
    let (status, bytes) = plant.state_bytes();
    assert_eq!(status, Ok);
    let mut other = InProcess::from_library(&LIBRARY, "MomentumPlant").unwrap();
    let (status, mut state) = other.deserialize(&bytes);
    assert_eq!((status, other.set_state(&state)), (Ok, Ok));
    assert_eq!(other.free_state(&mut state), Ok);
    assert!(state.is_null());
    let mut read = [0.0];
    assert_eq!(other.get_real(&[reference("solver.tolerance")], &mut read), Ok);
    assert_eq!(read, [LOOSE]);
    assert_eq!(simulated(&mut other, 1), loose);
    assert_eq!(simulated(&mut plant, 1), loose);
    assert_eq!(plant.reset(), Ok);
    enter(&mut plant, None, None, false);
    assert_eq!(simulated(&mut plant, 0), flight(None, None, false));
}
