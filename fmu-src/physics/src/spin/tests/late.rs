//! A manoeuvre is the same manoeuvre whenever it begins, within what the spacing of doubles leaves of its edges.

use super::{ace, directions, paper_start, request};
use crate::attitude::angle_between_rad;
use crate::numerics::spacing::spacing;
use crate::spin::{
    burn_request::BurnRequest,
    forecast::Timing,
    plant::{Commands, Outputs, Plant, Predictions, Start},
};

/// A flight of 1600 s from `start_s` with 114 pulses, and what it shows.
fn simulated(inertia_kg_m2: [f64; 3], timing: Timing, start_s: f64) -> crate::spin::plant::Outputs {
    let spinner = ace();
    let burn = Some(BurnRequest { timing, start_s, ..request() });
    let start = Start { inertia_kg_m2, burn, damper_time_constant_s: 0.0, ..paper_start(1.483) };
    let mut plant = Plant::start(&spinner, &start, directions(), Commands::default(), start_s).unwrap();
    for i in 1..=16 {
        plant.advance(&spinner, start_s + 100.0 * f64::from(i)).unwrap();
    }
    Outputs::from_plant(&plant, &spinner)
}

#[test]
fn a_manoeuvre_begun_late_fires_every_pulse_and_turns_the_axis_as_at_0() {
    let axisymmetric = [353.82 / 1.483, 353.82 / 1.483, 353.82];
    for inertia_kg_m2 in [axisymmetric, [230.0, 245.0, 353.82]] {
        for timing in [Timing::Clock, Timing::SunCrossing, Timing::TruePhase] {
            let at_0 = simulated(inertia_kg_m2, timing, 0.0);
            assert!(at_0.burn_done && at_0.pulses_fired == 114, "{timing:?}");
            for start_s in [-800.0, 1e6, 3e6, 1e8, 1e9] {
                let late = simulated(inertia_kg_m2, timing, start_s);
                assert_eq!((late.pulses_fired, late.burn_done), (114, true), "{timing:?} {start_s}");
                let apart_rad =
                    angle_between_rad(&late.state.momentum_inertial, &at_0.state.momentum_inertial);
                println!("{inertia_kg_m2:?} {timing:?} {start_s}: {apart_rad:e} rad");
                // Each edge is off by up to half the spacing of doubles, so that a pulse of 0.032 s is too long or too short
                // by up to all of it; if all were so the same way, the axis would turn too far by that share.
                let edge_s = spacing(start_s);
                let allowed_rad = 1e-10 + at_0.momentum_displacement_rad * edge_s * (1.0 / 0.032 + 0.6);
                assert!(apart_rad <= allowed_rad, "{timing:?} {start_s}: {apart_rad:e} > {allowed_rad:e}");
            }
        }
    }
}

#[test]
fn a_burn_that_waits_for_11_days_fires_every_pulse() {
    let spinner = ace();
    for timing in [Timing::Clock, Timing::SunCrossing, Timing::TruePhase] {
        let mut start = paper_start(1.483);
        start.burn = Some(BurnRequest { timing, start_s: 1e6, ..request() });
        let mut plant = Plant::start(&spinner, &start, directions(), Commands::default(), 0.0).unwrap();
        plant.advance(&spinner, 1e6 + 1600.0).unwrap();
        let outputs = Outputs::from_plant(&plant, &spinner);
        assert_eq!((outputs.pulses_fired, outputs.burn_done), (114, true), "{timing:?}");
        let expected = Predictions::from_plant(&plant).manoeuvre_rad;
        assert!((outputs.momentum_displacement_rad / expected - 1.0).abs() < 2e-3, "{timing:?}");
        // A crossing of the Sun in every turn.
        let turns = (1e6 + 1600.0) / 12.0;
        assert!((plant.sensors.sun.count as f64 - turns).abs() < 3.0, "{}", plant.sensors.sun.count);
    }
}

#[test]
fn a_time_at_which_doubles_are_too_far_apart_is_refused() {
    let spinner = ace();
    let mut plant =
        Plant::start(&spinner, &paper_start(1.483), directions(), Commands::default(), 1e16).unwrap();
    let error = plant.advance(&spinner, 1e16 + 100.0).unwrap_err().to_string();
    for part in ["10000000000000000 s", "2e0 s apart", "nearer to time 0"] {
        assert!(error.contains(part), "{error}");
    }
}
