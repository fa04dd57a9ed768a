//! Against a grid of targets, and where symmetry says what is best.
use super::*;
use approx::assert_relative_eq;
use nalgebra::Rotation3;
use proptest::prelude::*;

fn best(
    along: &[RotatedMomentum],
    ranges: [ControlAuthority; 2],
    y: f64,
    threshold: &Vector3<f64>,
) -> Vector3<f64> {
    let mut squares = SquareSum::default();
    along.iter().for_each(|at| squares.add(at, threshold));
    best_turned(&squares, ranges, y)
}

#[test]
fn a_turn_about_the_sun_line_alone_asks_for_none() {
    let along: Vec<RotatedMomentum> = (0..36)
        .map(|k| RotatedMomentum {
            turn: *Rotation3::from_axis_angle(&Vector3::y_axis(), f64::from(k) * 0.175).matrix(),
            added_body_n_m_s: Vector3::zeros(),
        })
        .collect();
    let found = best(&along, [[-2.0, 3.0], [-1.0, 4.0]], 0.7, &Vector3::repeat(4.0));
    assert_relative_eq!(found, Vector3::new(0.0, 0.7, 0.0), epsilon = 1e-7);
}

#[test]
fn a_drift_without_a_turn_is_met_half_way() {
    let at = |x: f64, z: f64| RotatedMomentum {
        turn: Matrix3::identity(),
        added_body_n_m_s: Vector3::new(x, 0.0, z),
    };
    // Both components start a drift at zero; equal parts of the thresholds weigh the same.
    let along = [at(0.0, 0.0), at(2.0, -1.0)];
    let found = best(&along, [[-5.0, 5.0]; 2], 0.0, &Vector3::new(4.0, 1.0, 2.0));
    assert_relative_eq!(found.x, -1.0, epsilon = 1e-6);
    assert_relative_eq!(found.z, 0.5, epsilon = 1e-6);
    let short = best(&along, [[-0.25, 5.0], [-5.0, 5.0]], 0.0, &Vector3::new(4.0, 1.0, 2.0));
    assert_eq!(short.x, -0.25);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]
    #[test]
    fn no_other_target_has_less(
        path in proptest::collection::vec((-3.0..3.0_f64, -2.0..2.0_f64, -2.0..2.0_f64), 1..20),
        y in -2.0..2.0_f64,
        width in 0.1..4.0_f64,
    ) {
        let along: Vec<RotatedMomentum> = path
            .iter()
            .map(|(angle, x, z)| RotatedMomentum {
                turn: Rotation3::from_euler_angles(0.1 * x, *angle, 0.1 * z).into_inner(),
                added_body_n_m_s: Vector3::new(*x, 0.5, *z),
            })
            .collect();
        let threshold = Vector3::new(4.0, 1.0, 3.0);
        let all = |h: Vector3<f64>| -> f64 {
            let bodies = along.iter().map(|at| (at.turn * h + at.added_body_n_m_s).component_div(&threshold));
            bodies.map(|body| body.xz().norm_squared()).sum()
        };
        let authority = [-width, 0.6 * width];
        let found = all(best(&along, [authority; 2], y, &threshold));
        let at = |k: u32| authority[0] + (authority[1] - authority[0]) * f64::from(k) / 60.0;
        for (i, j) in (0..=60).flat_map(|i| (0..=60).map(move |j| (i, j))) {
            prop_assert!(all(Vector3::new(at(i), y, at(j))) > found - 1e-6);
        }
    }
}
