//! Programmes whose answers are known in closed form.

use approx::assert_relative_eq;

use super::*;

fn step(begin: Begin, drift: Vector3<f64>, terms: Vec<(usize, Vector3<f64>)>, limit: f64) -> Step {
    Step { begin, drift, terms, limit }
}

#[test]
fn without_controls_the_excess_is_that_of_the_sum() {
    let steps = (0..4).map(|k| {
        let begin = if k == 0 { Begin::At(Vector3::new(0.0, 3.0, 0.0)) } else { Begin::Follows };
        step(begin, Vector3::x(), Vec::new(), 4.5)
    });
    let program = Program { steps: steps.collect(), ..Program::default() };
    let found = program.solve(Goal::LeastExcess).unwrap();
    assert_relative_eq!(found.excess, 0.5, epsilon = 1e-6);
    assert!(program.solve(Goal::LeastCost).is_none());
}

/// A constant torque T along x over n steps and a control that takes up to c of it away: the end is n (1 - c) T.
#[test]
fn a_control_is_used_as_far_as_it_goes() {
    for (reach, expected) in [(0.25, 7.5), (0.5, 5.0)] {
        let mut steps = Vec::new();
        for k in 0..10 {
            let begin = if k == 0 { Begin::At(Vector3::zeros()) } else { Begin::Follows };
            steps.push(step(begin, Vector3::x(), vec![(k, Vector3::x())], 5.0));
        }
        let program = Program { bounds: vec![[-reach, reach]; 10], steps, ..Program::default() };
        let found = program.solve(Goal::LeastExcess).unwrap();
        assert_relative_eq!(found.excess, expected - 5.0, epsilon = 1e-5);
    }
}

/// Of two controls that work on both axes the least length is the pseudo-inverse: to hold (1, 1) of (3, 4) back with
/// |g| = 1 along each axis.
#[test]
fn the_least_length_meets_the_ball() {
    let terms = vec![(0, Vector3::x()), (1, Vector3::y())];
    let begin = Begin::At(Vector3::new(3.0, 4.0, 0.0));
    let program = Program {
        bounds: vec![[-9.0, 9.0]; 2],
        steps: vec![step(begin, Vector3::zeros(), terms, 4.0)],
        lengths: vec![([0, 1], 1.0)],
        ..Program::default()
    };
    let found = program.solve(Goal::LeastCost).unwrap();
    // The nearest point of the ball is along (3, 4).
    assert_relative_eq!(found.controls[0], -0.6, epsilon = 1e-5);
    assert_relative_eq!(found.controls[1], -0.8, epsilon = 1e-5);
}

#[test]
fn a_free_beginning_is_the_opposite_end() {
    // 8 along x within a ball of 4: from -4 to 4.
    let steps = (0..8).map(|k| {
        let begin = if k == 0 { Begin::Free } else { Begin::Follows };
        step(begin, Vector3::x(), Vec::new(), 4.0)
    });
    let program = Program { steps: steps.collect(), ..Program::default() };
    assert_relative_eq!(program.solve(Goal::LeastExcess).unwrap().excess, 0.0, epsilon = 1e-5);
}

#[test]
fn empty_bounds_have_no_answer() {
    let program = Program { bounds: vec![[1.0, 0.0]], ..Program::default() };
    assert!(program.solve(Goal::LeastExcess).is_none());
}
