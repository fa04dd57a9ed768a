//! Sums have the supports' sums, parts within a band the points that are in both.
use super::*;

/// Points of a fixed sequence in a square.
fn scattered(count: usize, seed: u64) -> Vec<Point> {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    };
    (0..count).map(|_| [next(), next()]).collect()
}

fn support(region: &Region, way: Point) -> f64 {
    region.corners.iter().map(|corner| corner[0] * way[0] + corner[1] * way[1]).fold(f64::MIN, f64::max)
}

#[test]
fn sums_reach_as_far_as_their_parts_together() {
    let cases = [(20, 20), (3, 40), (1, 9), (2, 9), (2, 2), (1, 1), (9, 2)];
    for (seed, (m, n)) in cases.into_iter().enumerate() {
        let a = Region::hull(scattered(m, seed as u64 + 1));
        let b = Region::hull(scattered(n, seed as u64 + 77));
        let sum = a.plus(&b);
        for k in 0..360 {
            let (sin, cos) = f64::from(k).to_radians().sin_cos();
            let expected = support(&a, [cos, sin]) + support(&b, [cos, sin]);
            assert!((support(&sum, [cos, sin]) - expected).abs() < 1e-12, "{m} {n} {k}");
        }
        assert!(sum.corners.len() <= a.corners.len() + b.corners.len() + 2);
    }
}

#[test]
fn a_band_keeps_what_is_in_both() {
    let hull = Region::hull(scattered(30, 5));
    let part = hull.within([0.2, 0.3]);
    for point in scattered(2000, 9) {
        let expected = hull.holds(point) && point[0].abs() <= 0.2 && point[1].abs() <= 0.3;
        assert_eq!(part.holds(point), expected, "{point:?}");
    }
    assert!(hull.scaled(1.0, [9.0, 0.0]).within([1.0, 1.0]).corners.is_empty());
    let point = Region::hull([[0.5, 0.5]]);
    assert_eq!(point.within([1.0, 1.0]), point);
    assert!(point.within([0.4, 1.0]).corners.is_empty());
    let segment = Region::hull([[-2.0, 0.0], [2.0, 0.0]]);
    assert_eq!(segment.within([1.0, 1.0]).extent(0), [-1.0, 1.0]);
}

#[test]
fn many_sums_within_a_band_stay_what_they_are() {
    // Symmetric about the first axis, so that along it the set is the interval of its ends.
    let points = scattered(40, 3);
    let mirrored = points.iter().map(|point| [point[0], -point[1]]);
    let step = Region::hull(points.iter().copied().chain(mirrored)).scaled(1e-3, [0.0; 2]);
    let mut all = Region::hull([[0.0, 0.0]]);
    let [mut low, mut high] = [0.0_f64; 2];
    for k in 0..20_000 {
        let light = 1.0 + 0.3 * (f64::from(k) * 1e-3).sin();
        let drift = 6e-4 * (f64::from(k) * 3e-4).sin();
        all = all.plus(&step.scaled(light, [drift, 0.0])).within([1.0, 0.3]);
        let [least, most] = step.extent(0);
        low = (low + drift + light * least).max(-1.0);
        high = (high + drift + light * most).min(1.0);
        let [found_low, found_high] = all.extent(0);
        assert!(
            (found_low - low).abs() < 1e-9 && (found_high - high).abs() < 1e-9,
            "{k}: {low} {high} {all:?}"
        );
        assert!(all.corners.len() < 200);
    }
    assert!(high < 1.0 || low > -1.0);
}

/// Corners of a square as the B-plane has them, and of no polygon.
#[test]
fn a_point_is_held_within_the_corners() {
    let square = Region { corners: vec![[-1e5, -1e4], [1e5, -1e4], [1e5, 2e4], [-1e5, 2e4]] };
    for (point, is) in [([9e4, 0.0], true), ([1.1e5, 0.0], false), ([0.0, -2e4], false)] {
        assert_eq!(square.holds(point), is, "{point:?}");
    }
    let segment = Region { corners: square.corners[..2].to_vec() };
    assert!(!Region::default().holds([0.0; 2]) && !segment.holds([0.0, -1e4]));
}
