//! What is painted last is what a ray meets first.
use super::*;
use crate::surface::Finish;

/// A box with open boxes, panels and a dish around it: rectangles of any attitude that do not cross.
fn spacecraft() -> Vec<Surface> {
    let rectangle = |middle: [f64; 3], a: [f64; 3], b: [f64; 3]| {
        let [middle, a, b] = [middle, a, b].map(Vector::from);
        let corners = vec![middle - a - b, middle + a - b, middle + a + b, middle - a + b];
        Surface::facet(corners, Finish::Plate, 0).unwrap()
    };
    let mut all = Vec::new();
    for sign in [-1.0, 1.0] {
        all.extend([
            rectangle([0.7 * sign, 0.0, 0.0], [0.0, 0.6 * sign, 0.0], [0.0, 0.0, 0.8]),
            rectangle([0.0, 0.6 * sign, 0.0], [0.0, 0.0, 0.8 * sign], [0.7, 0.0, 0.0]),
            rectangle([0.0, 0.0, 0.8 * sign], [0.7 * sign, 0.0, 0.0], [0.0, 0.6, 0.0]),
            rectangle([2.0 * sign, 0.0, 0.1], [1.0, 0.0, 0.0], [0.0, 0.4, -0.5 * sign]),
        ]);
    }
    all.push(rectangle([0.1, -1.2, 0.3], [0.9, 0.2, 0.0], [0.0, 0.0, 0.9]));
    all.push(rectangle([0.0, 0.1, 1.4], [0.5, 0.0, 0.2], [0.0, 0.5, 0.0]));
    all
}

#[test]
fn the_surface_painted_last_is_the_first_on_the_ray() {
    let all = spacecraft();
    let mut compared = 0;
    for (viewer, is_perspective) in [
        ([0.52, -0.75, 0.42], true),
        ([0.52, -0.75, -0.42], true),
        ([-0.4, 0.8, 0.3], true),
        ([0.9, 0.1, 0.2], false),
        ([0.3, -0.2, -0.8], false),
    ] {
        let target_m = Vector::new(0.1, -0.1, 0.05);
        let camera = Camera::new(Vector::from(viewer), target_m, 6.5, is_perspective).unwrap();
        let order = camera.painting_order(&all);
        let outlines: Vec<Vec<Flat>> = all
            .iter()
            .map(|surface| surface.corners.iter().map(|corner| camera.flat(*corner)).collect())
            .collect();
        for (i, j) in (-60..60).flat_map(|i| (-30..30).map(move |j| (i, j))) {
            let seen = (0.05013 * f64::from(i), 0.05007 * f64::from(j));
            let painted = order.iter().rev().copied().find(|index| contains(&outlines[*index], seen));
            // Without any projection: from the eye, or far away, through the point of the picture plane.
            let plane = target_m + seen.0 * camera.right + seen.1 * camera.up;
            let from = match camera.eye_m {
                Some(eye_m) => target_m + eye_m * camera.viewer,
                None => plane + 100.0 * camera.viewer,
            };
            let ray = plane - from;
            let met = all.iter().enumerate().filter_map(|(index, surface)| {
                let part = -height_m(surface, from) / surface.normal.dot(&ray);
                let at = from + part * ray - surface.corners[0];
                // Every outline is a rectangle.
                let [a, b] = [1, 3].map(|k| surface.corners[k] - surface.corners[0]);
                let inside = [a, b].iter().all(|edge| {
                    let share = at.dot(edge) / edge.norm_squared();
                    (0.0..=1.0).contains(&share)
                });
                (inside && part > 0.0).then_some((index, part))
            });
            let nearest = met.min_by(|one, other| one.1.total_cmp(&other.1)).map(|(index, _)| index);
            assert_eq!(painted, nearest, "{seen:?} from {viewer:?}");
            compared += usize::from(nearest.is_some());
        }
    }
    assert!(compared > 2000, "{compared}");
}
