//! Shares against a search over all distributions, and against the rhombic dodecahedron of a pyramid.

use approx::assert_relative_eq;
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::{random, random_unit};
use crate::attitude::control::{Allocation, WheelAllocator};

const BOTH: [Allocation; 2] = [Allocation::PseudoInverse, Allocation::LeastMaximum];

fn pyramid() -> Vec<Vector3<f64>> {
    let c = (1.0f64 / 3.0).sqrt();
    [(c, c), (c, -c), (-c, -c), (-c, c)].iter().map(|&(x, z)| Vector3::new(x, c, z)).collect()
}

/// Arrays of three to six wheels: without order, with three in a plane, with parallel and opposite ones.
fn arrays() -> Vec<Vec<Vector3<f64>>> {
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    let skew = Vector3::new(1.0, 2.0, -2.0) / 3.0;
    let random_axes = |first: u64, count: u64| (first..first + count).map(random_unit).collect();
    vec![
        pyramid(),
        vec![x, y, z],
        vec![x, y, z, skew],
        vec![x, y, Vector3::new(0.6, 0.8, 0.0), z],
        vec![x, y, Vector3::new(0.6, 0.8, 0.0), Vector3::new(0.8, -0.6, 0.0), z],
        vec![x, x, y, z],
        vec![x, -x, y, -y, z, skew],
        random_axes(100, 3),
        random_axes(110, 4),
        random_axes(120, 5),
        random_axes(130, 6),
    ]
}

fn shares(array: &WheelAllocator, method: Allocation, vector: &Vector3<f64>, count: usize) -> Vec<f64> {
    let mut shares = vec![f64::NAN; count];
    array.distribute(method, vector, &mut shares);
    shares
}

fn largest(shares: &[f64]) -> f64 {
    shares.iter().fold(0.0, |most, share| share.abs().max(most))
}

/// Directions in which shares can change without changing their sum: an orthonormal basis of the null space.
fn null_space(axes: &[Vector3<f64>]) -> Vec<DVector<f64>> {
    let a = DMatrix::from_fn(3, axes.len(), |row, column| axes[column][row]);
    let inverse = (&a * a.transpose()).try_inverse().unwrap();
    let projector = DMatrix::identity(axes.len(), axes.len()) - a.transpose() * inverse * &a;
    let mut basis: Vec<DVector<f64>> = Vec::new();
    for column in projector.column_iter() {
        let mut rest = column.clone_owned();
        for _ in 0..2 {
            for known in &basis {
                rest -= known * known.dot(&rest);
            }
        }
        if rest.norm() > 1e-6 {
            basis.push(rest.normalize());
        }
    }
    assert_eq!(basis.len(), axes.len() - 3);
    basis
}

/// Least greatest magnitude over `start` plus any combination of `basis`, a convex function, by nested sections.
fn search(start: &DVector<f64>, basis: &[DVector<f64>], reach: f64) -> f64 {
    let Some((first, rest)) = basis.split_first() else { return start.amax() };
    let at = |c: f64| search(&(start + first * c), rest, reach);
    let ratio = 0.5 * (5.0_f64.sqrt() - 1.0);
    let (mut low, mut high) = (-reach, reach);
    let (mut c, mut d) = (high - ratio * (high - low), low + ratio * (high - low));
    let (mut at_c, mut at_d) = (at(c), at(d));
    while high - low > 1e-7 * reach {
        if at_c < at_d {
            (high, d, at_d) = (d, c, at_c);
            c = high - ratio * (high - low);
            at_c = at(c);
        } else {
            (low, c, at_c) = (c, d, at_d);
            d = low + ratio * (high - low);
            at_d = at(d);
        }
    }
    at_c.min(at_d)
}

#[test]
fn shares_add_up_to_the_vector_to_rounding() {
    for axes in arrays() {
        let array = WheelAllocator::new(&axes, |_| true).unwrap();
        for number in 0..300 {
            let vector = random(number);
            for method in BOTH {
                let shares = shares(&array, method, &vector, axes.len());
                let sum: Vector3<f64> = shares.iter().zip(&axes).map(|(share, axis)| axis * *share).sum();
                let scale = vector.norm() + largest(&shares);
                assert!((sum - vector).norm() < 4e-15 * scale, "{method:?} {sum} {vector}");
            }
        }
    }
}

#[test]
fn the_greatest_share_is_the_least_that_a_search_finds() {
    for axes in arrays() {
        let array = WheelAllocator::new(&axes, |_| true).unwrap();
        let basis = null_space(&axes);
        let cases = if basis.len() < 3 { 40 } else { 3 };
        for number in 0..cases {
            let vector = random(number);
            let found = largest(&shares(&array, Allocation::LeastMaximum, &vector, axes.len()));
            let start = DVector::from_vec(shares(&array, Allocation::PseudoInverse, &vector, axes.len()));
            let least = search(&start, &basis, 3.0 * start.norm());
            // The search's points are within 1e-7 of its reach, and it never falls below the minimum.
            assert!(found <= least * (1.0 + 1e-14), "{found} {least}");
            assert!(found >= least - 1e-6 * start.norm(), "{found} {least}");
            assert_relative_eq!(array.least_maximum(&vector), found, max_relative = 1e-13);
        }
    }
}

#[test]
fn the_pseudo_inverse_has_the_smallest_norm() {
    for axes in arrays() {
        let array = WheelAllocator::new(&axes, |_| true).unwrap();
        let shares = DVector::from_vec(shares(&array, Allocation::PseudoInverse, &random(3), axes.len()));
        for direction in null_space(&axes) {
            assert!(direction.dot(&shares).abs() < 1e-14 * shares.norm(), "{shares}");
        }
    }
}

#[test]
fn the_envelope_of_a_pyramid_is_a_rhombic_dodecahedron() {
    // Four diagonals of a cube sum to that body; its faces are |x| + |y| = 4/sqrt 3 and the like.
    let array = WheelAllocator::new(&pyramid(), |_| true).unwrap();
    for number in 0..500 {
        let v = random(number).abs();
        let expected = (v.x + v.y).max(v.y + v.z).max(v.x + v.z) * 3.0_f64.sqrt() / 4.0;
        assert_relative_eq!(array.least_maximum(&random(number)), expected, max_relative = 1e-14);
    }
}

#[test]
fn shares_change_continuously() {
    // The steepest slope of a linear piece is bounded by the worst-conditioned pair of axes; a jump would not shrink
    // with the step.
    for axes in arrays() {
        let array = WheelAllocator::new(&axes, |_| true).unwrap();
        let greatest_change = |steps: u32| {
            let mut most: f64 = 0.0;
            for line in 0..20 {
                let (from, to) = (random(2 * line), random(2 * line + 1));
                let at = |step: u32| {
                    let vector = from + (to - from) * (f64::from(step) / f64::from(steps));
                    shares(&array, Allocation::LeastMaximum, &vector, axes.len())
                };
                let mut last = at(0);
                for step in 1..=steps {
                    let next = at(step);
                    most = last.iter().zip(&next).fold(most, |most, (a, b)| most.max((a - b).abs()));
                    last = next;
                }
            }
            most
        };
        let (coarse, fine) = (greatest_change(500), greatest_change(5000));
        assert!(fine < 0.12 * coarse, "{axes:?}: {coarse} {fine}");
    }
}

#[test]
fn three_wheels_go_on_after_one_fails() {
    for failed in 0..4 {
        let axes = pyramid();
        let array = WheelAllocator::new(&axes, |wheel| wheel != failed).unwrap();
        let left: Vec<Vector3<f64>> = (0..4).filter(|&wheel| wheel != failed).map(|w| axes[w]).collect();
        let only = Matrix3::from_columns(&left).try_inverse().unwrap();
        for number in 0..50 {
            let vector = random(number);
            let expected = only * vector;
            for method in BOTH {
                let shares = shares(&array, method, &vector, 4);
                assert_eq!(shares[failed], 0.0);
                let found: Vec<f64> = (0..4).filter(|&wheel| wheel != failed).map(|w| shares[w]).collect();
                assert_relative_eq!(
                    Vector3::from_row_slice(&found),
                    expected,
                    epsilon = 1e-14 * vector.norm() * 4.0
                );
            }
        }
    }
}

#[test]
fn wheels_that_do_not_span_are_no_array() {
    let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
    assert!(WheelAllocator::new(&[], |_| true).is_none());
    assert!(WheelAllocator::new(&[x, y], |_| true).is_none());
    assert!(WheelAllocator::new(&[x, y, Vector3::new(0.6, 0.8, 0.0), -x], |_| true).is_none());
    assert!(WheelAllocator::new(&[x, y, z], |wheel| wheel != 2).is_none());
    assert!(WheelAllocator::new(&[x, y, Vector3::new(0.6, 0.8, 1e-9)], |_| true).is_none());
    assert!(WheelAllocator::new(&[x, y, z * f64::NAN], |_| true).is_none());
    assert!(WheelAllocator::new(&[x, y, Vector3::zeros()], |_| true).is_none());
}

#[test]
fn axes_nearly_in_a_plane_still_add_up() {
    let tilt = 1e-4_f64;
    let axes = vec![
        Vector3::x(),
        Vector3::new(tilt.cos(), tilt.sin(), 0.0),
        Vector3::y(),
        Vector3::new(0.6, 0.8, tilt).normalize(),
        Vector3::z(),
    ];
    let array = WheelAllocator::new(&axes, |_| true).unwrap();
    for number in 0..300 {
        let vector = random(number);
        let shares = shares(&array, Allocation::LeastMaximum, &vector, axes.len());
        let sum: Vector3<f64> = shares.iter().zip(&axes).map(|(share, axis)| axis * *share).sum();
        assert!((sum - vector).norm() < 1e-14 * vector.norm(), "{sum} {vector}");
        assert!(largest(&shares) <= array.least_maximum(&vector) * (1.0 + 1e-9));
    }
}
