//! Collocation has the order the theory gives it, keeps quadratic invariants, and forgets nothing when saved.

use nalgebra::{Vector2, Vector3, Vector4};

use super::*;

fn oscillator(_: f64, y: &Vector2<f64>) -> Vector2<f64> {
    Vector2::new(y[1], -y[0])
}

fn end_error<const S: usize, const M: usize>(h: f64) -> f64 {
    let method = Collocation::<S, M>::default();
    let (_, end) = method.solve(0.0, h, &Vector2::new(1.0, 0.0), None, oscillator).unwrap();
    (end - Vector2::new(h.cos(), -h.sin())).norm()
}

#[test]
fn order_is_twice_the_nodes() {
    // One step's error falls with h^(2S+1).
    let order = |coarse: f64, fine: f64| (coarse / fine).log2();
    assert!((order(end_error::<2, 3>(0.4), end_error::<2, 3>(0.2)) - 5.0).abs() < 0.1);
    assert!((order(end_error::<3, 4>(0.8), end_error::<3, 4>(0.4)) - 7.0).abs() < 0.1);
    assert!((order(end_error::<4, 5>(0.9), end_error::<4, 5>(0.45)) - 9.0).abs() < 0.1);
}

#[test]
fn the_midpoint_rule_is_the_simplest_case() {
    // S = 1 is the implicit midpoint rule, solved by hand for y' = -y: (1 - h/2) / (1 + h/2).
    let method = Collocation::<1, 2>::default();
    let rhs = |_: f64, y: &SVector<f64, 1>| -y;
    let (_, end) = method.solve(0.0, 0.5, &SVector::from([1.0]), None, rhs).unwrap();
    assert!((end[0] - 0.75 / 1.25).abs() < 1e-15);
}

#[test]
fn dense_output_is_the_solution_between() {
    let method = Collocation::<10, 11>::default();
    let mut chain = SegmentChain::new(0.5, 0.2, Vector2::new(0.2_f64.cos(), -(0.2_f64.sin())));
    let mut edges = vec![];
    while chain.end_s < 20.0 {
        chain.advance_to(&method, f64::INFINITY, oscillator).unwrap();
        edges.push(chain.end_s);
        for i in 0..=10 {
            let t = chain.start_s + (chain.end_s - chain.start_s) * f64::from(i) / 10.0;
            let (value, rate) = chain.segment.value_and_derivative(t);
            assert!((value - Vector2::new(t.cos(), -t.sin())).norm() < 1e-13);
            assert!((chain.value(t) - value).norm() < 1e-14);
            assert!((rate - oscillator(t, &value)).norm() < 1e-12);
        }
    }
    assert_eq!(edges[..3], [0.5, 1.0, 1.5]);
}

#[test]
fn a_limit_ends_a_segment_and_the_next_one_ends_at_the_edge() {
    let method = Collocation::<10, 11>::default();
    let mut chain = SegmentChain::new(0.5, 0.0, Vector2::new(1.0, 0.0));
    let mut edges = vec![];
    for limit in [0.7, 0.7, 0.7 + 1e-15, 9.0, 1.5, f64::INFINITY] {
        chain.advance_to(&method, limit, oscillator).unwrap();
        let t = chain.end_s;
        edges.push(t);
        assert!((chain.value(chain.end_s) - Vector2::new(t.cos(), -t.sin())).norm() < 1e-13);
    }
    assert_eq!(edges, [0.5, 0.7, 0.7 + 1e-15, 1.0, 1.5, 2.0]);
}

#[test]
fn quadratic_invariants_survive_coarse_segments() {
    // A tumbling triaxial body with its quaternion: |q|, |H| and the energy are quadratic, segments are far too long
    // for accuracy.
    let inertia = Vector3::new(1.0, 2.0, 3.0);
    let rhs = |_: f64, y: &SVector<f64, 7>| {
        let w = Vector3::new(y[0], y[1], y[2]);
        let q = Vector4::new(y[3], y[4], y[5], y[6]);
        let dw = -w.cross(&inertia.component_mul(&w)).component_div(&inertia);
        let v = q.xyz();
        let dv = (w * q.w - w.cross(&v)) * 0.5;
        SVector::from([dw.x, dw.y, dw.z, dv.x, dv.y, dv.z, -0.5 * w.dot(&v)])
    };
    let method = Collocation::<3, 4>::default();
    let start = SVector::from([0.3, 1.0, 0.4, 0.0, 0.0, 0.0, 1.0]);
    let mut chain = SegmentChain::new(0.4, 0.0, start);
    let invariants = |y: &SVector<f64, 7>| {
        let w = Vector3::new(y[0], y[1], y[2]);
        let h = inertia.component_mul(&w);
        (h.norm_squared(), h.dot(&w), y.fixed_rows::<4>(3).norm_squared())
    };
    let before = invariants(&start);
    for _ in 0..5000 {
        chain.advance_to(&method, f64::INFINITY, rhs).unwrap();
    }
    let after = invariants(&chain.value(chain.end_s));
    assert!((after.0 / before.0 - 1.0).abs() < 1e-12);
    assert!((after.1 / before.1 - 1.0).abs() < 1e-12);
    assert!((after.2 - 1.0).abs() < 1e-12);
}

#[test]
fn saved_and_restored_to_the_bit() {
    let method = Collocation::<6, 7>::default();
    let mut chain = SegmentChain::new(0.3, 0.1, Vector2::new(1.0, 0.0));
    for _ in 0..5 {
        chain.advance_to(&method, f64::INFINITY, oscillator).unwrap();
    }
    let text = toml::to_string(&chain).unwrap();
    let mut restored: SegmentChain<2, 7> = toml::from_str(&text).unwrap();
    assert_eq!(restored, chain);
    for _ in 0..20 {
        chain.advance_to(&method, f64::INFINITY, oscillator).unwrap();
        restored.advance_to(&method, f64::INFINITY, oscillator).unwrap();
    }
    assert_eq!(restored, chain);
}

#[test]
fn edges_are_whole_multiples_after_a_cut() {
    let method = Collocation::<6, 7>::default();
    let mut chain = SegmentChain::new(60.0, 0.0, Vector2::new(1.0, 0.0));
    let rhs = |_: f64, y: &Vector2<f64>| -y * 0.01;
    chain.advance_to(&method, f64::INFINITY, rhs).unwrap();
    let at = chain.value(17.0);
    // Within a segment the error of degree 6 is about 0.3^7 / (2^6 7!), at its end next to none.
    assert!((at[0] - (-0.17_f64).exp()).abs() < 1e-9);
    chain.cut(17.0, at);
    assert_eq!((chain.end_s, chain.value(17.0)), (17.0, at));
    chain.advance_to(&method, f64::INFINITY, rhs).unwrap();
    assert_eq!((chain.start_s, chain.end_s), (17.0, 60.0));
    chain.cut(60.0, chain.value(60.0));
    chain.advance_to(&method, f64::INFINITY, rhs).unwrap();
    assert_eq!(chain.end_s, 120.0);
    assert!((chain.value(chain.end_s)[0] - (-1.2_f64).exp()).abs() < 1e-9);
    // A start a hair before an edge, and negative times.
    let mut chain = SegmentChain::new(0.1, 0.3, Vector2::new(1.0, 0.0));
    chain.advance_to(&method, f64::INFINITY, rhs).unwrap();
    assert_eq!(chain.end_s, 0.4);
    let mut chain = SegmentChain::new(60.0, -30.0, Vector2::new(1.0, 0.0));
    chain.advance_to(&method, f64::INFINITY, rhs).unwrap();
    assert_eq!(chain.end_s, 0.0);
}

#[test]
fn what_cannot_be_integrated_is_named() {
    let method = Collocation::<4, 5>::default();
    let stiff = |_: f64, y: &SVector<f64, 1>| -y * 1e4;
    let error = method.solve(0.0, 1.0, &SVector::from([1.0]), None, stiff).unwrap_err();
    assert!(error.to_string().contains("make it shorter"), "{error}");
    let broken = |t: f64, y: &SVector<f64, 1>| y * if t > 0.5 { f64::NAN } else { 1.0 };
    let error = method.solve(0.0, 1.0, &SVector::from([1.0]), None, broken).unwrap_err();
    assert!(matches!(error, IntegrationError::NotFinite { .. }));
}
