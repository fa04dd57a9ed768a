//! A split train moves the momentum as far as it says, whatever the ratio leaves of its halves.

use super::{ace, directions, launch, paper_spin, paper_start, request, train, undamped};
use crate::spin::{
    burn_request::BurnRequest,
    forecast::Timing,
    plant::{Commands, Outputs, Plant, Predictions},
    train::{Shape, TrainError},
};

/// Planned and simulated move of a train for 2 deg, in rad, and the nutation it leaves.
fn simulated(ratio: f64, turns_per_pulse: f64) -> (f64, f64, f64) {
    let spinner = ace();
    let mut start = undamped(ratio);
    start.burn = Some(BurnRequest {
        shape: Shape::Split,
        timing: Timing::TruePhase,
        count: 0,
        angle_rad: 2.0_f64.to_radians(),
        turns_per_pulse,
        ..request()
    });
    let mut plant = launch(&spinner, &start);
    let planned = Predictions::from_plant(&plant);
    plant.advance(&spinner, planned.duration_s + 60.0).unwrap();
    let outputs = Outputs::from_plant(&plant, &spinner);
    assert!(!outputs.burn_active);
    (planned.manoeuvre_rad, outputs.momentum_displacement_rad, outputs.nutation_rad)
}

#[test]
fn a_split_train_turns_by_what_it_plans() {
    // Once a turn two pulses more are two thirds of a hundredth of the turn.
    for (turns, ratios) in [
        (1.0, [1.4, 1.45, 1.471, 1.483, 1.494, 1.55, 1.6]),
        (0.5, [1.45, 1.46, 1.471, 1.483, 1.494, 1.53, 1.55]),
    ] {
        for ratio in ratios {
            let (planned, moved, nutation) = simulated(ratio, turns);
            assert!((moved / planned - 1.0).abs() < 1e-3, "{ratio}: {planned} planned, {moved} simulated");
            assert!((moved.to_degrees() - 2.0).abs() < 0.02, "{ratio}: {} deg", moved.to_degrees());
            // What one pulse leaves is 0.017 deg.
            assert!(nutation.to_degrees() < 1e-4, "{ratio}: {} deg left", nutation.to_degrees());
        }
    }
}

#[test]
fn an_angle_that_no_split_train_reaches_is_refused() {
    // A gain of 0.498 turns a turn: the longer the train, the farther apart its halves.
    let mut start = paper_start(1.498);
    start.burn = Some(BurnRequest { shape: Shape::Split, count: 0, angle_rad: 0.035, ..request() });
    let error = Plant::start(&ace(), &start, directions(), Commands::default(), 0.0).unwrap_err().to_string();
    for part in ["burn.angle", "0.035 rad", "split", "1.498"] {
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn halves_that_undo_each_other_are_refused() {
    // Nutation gains a third of a turn a turn: the halves never point less than half a turn apart.
    let spin = paper_spin(4.0 / 3.0);
    let error = train(Shape::Split, 114, 0.032, 1.0, &spin).unwrap_err();
    assert!(matches!(error, TrainError::OffsetHalves { .. }), "{error}");
    assert!(error.to_string().contains("0.500 turns apart with inertia ratio 1.3333"), "{error}");
}
