//! A step costs no more than it may, and says what requested more.

use std::time::Instant;

use super::{ace, directions, paper_start, request, train};
use crate::spin::{
    burn_request::BurnRequest,
    plant::{Commands, Plant, Predictions, Sampling, SpinPlantError, Start},
    train::Shape,
};

fn refusal(start: &Start, commands: Commands, end_s: f64) -> String {
    let spinner = ace();
    let begun = Instant::now();
    let mut plant = Plant::start(&spinner, start, directions(), commands, 0.0).unwrap();
    let error = plant.advance(&spinner, end_s).unwrap_err();
    assert!(matches!(error, SpinPlantError::Work(_)), "{error}");
    println!("{:.3} s: {error}", begun.elapsed().as_secs_f64());
    error.to_string()
}

fn limited() -> Start {
    Start { work_limit: 100_000, ..paper_start(1.483) }
}

#[test]
fn steps_that_would_not_end_name_what_asks_for_so_much() {
    let asymmetric = [230.0, 245.0, 353.82];
    let fire = |mask| Commands { fire: mask, ..Commands::default() };
    let clocked = Start { sampling: Sampling::Clock, nominal_rate_rad_s: 1e4, ..limited() };
    for (start, commands, end_s, named) in [
        (limited(), Commands::default(), 1e12, "crossings of Sun and star"),
        (
            Start { inertia_kg_m2: asymmetric, ..limited() },
            Commands::default(),
            1e12,
            "segments of the motion",
        ),
        (clocked, Commands::default(), 1e3, "limit.spinRate"),
        (Start { spin_rate_rad_s: 1e3, ..limited() }, fire(1 << 6 | 1 << 8), 1e5, "spin.initialRate"),
    ] {
        let text = refusal(&start, commands, end_s);
        for part in [named, "solver.workLimit = 100000", "the step came to "] {
            assert!(text.contains(part), "`{part}` is missing from: {text}");
        }
    }
}

/// How far a step came stands in its error: so far a shorter one does come.
#[test]
fn a_step_to_where_a_longer_one_came_ends_well() {
    let spinner = ace();
    let text = refusal(&limited(), Commands::default(), 1e12);
    let reached_s: f64 =
        text.trim_start_matches("the step came to ").split(' ').next().unwrap().parse().unwrap();
    let mut plant = Plant::start(&spinner, &limited(), directions(), Commands::default(), 0.0).unwrap();
    plant.advance(&spinner, 0.99 * reached_s).unwrap();
    // 12 s a turn, in which Sun and star cross.
    assert!(reached_s > 1e5 && reached_s < 2e5, "{reached_s}");
    // The limit counts for each step anew.
    plant.advance(&spinner, 1.98 * reached_s).unwrap();
}

/// Plans are made in bounded time whatever they ask for.
#[test]
fn the_longest_trains_are_planned_in_time() {
    let spinner = ace();
    for (shape, count, angle_rad) in [(Shape::Uniform, 1_000_000, 0.0), (Shape::Split, 114, 0.5)] {
        let mut start = paper_start(1.483);
        start.burn = Some(BurnRequest {
            shape,
            count,
            angle_rad,
            pulse_width_s: 1e-4,
            max_nutation_rad: 3.0,
            ratio_uncertainty: 0.4,
            target_inertial: nalgebra::Vector3::new(0.8, 0.6, 0.0),
            ..request()
        });
        let begun = Instant::now();
        let planned = Plant::start(&spinner, &start, directions(), Commands::default(), 0.0);
        let took_s = begun.elapsed().as_secs_f64();
        println!("{shape:?}: {took_s:.2} s, {:?}", planned.map(|p| Predictions::from_plant(&p).count));
        assert!(took_s < 60.0);
    }
}

/// A train's move is the sum over its pulses, however it is added up.
#[test]
fn the_move_of_a_train_is_the_sum_over_its_pulses() {
    use crate::spin::train::MOST_ORDER;
    let spin = super::paper_spin(1.483);
    let shapes = (1..=MOST_ORDER).map(|order| Shape::Tapered { order }).chain([Shape::Uniform, Shape::Split]);
    for shape in shapes {
        for count in 1..60 {
            let Ok(train) = train(shape, count, 0.064, 1.0, &spin) else { continue };
            let sum: f64 = (0..count)
                .map(|k| {
                    let off = (std::f64::consts::TAU * train.offset_turns(k)).cos();
                    off * spin.manoeuvre_rad(1.7792, train.width_s(k))
                })
                .sum();
            let seen = train.manoeuvre_rad(&spin, 1.7792);
            assert!((seen / sum - 1.0).abs() < 1e-13, "{shape:?} {count}: {seen} {sum}");
        }
    }
}
