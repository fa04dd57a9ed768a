//! Penumbrae: a straight edge against the circular segment it leaves of the Sun, and rays cast one by one.

use core::f64::consts::PI;

use approx::assert_relative_eq;
use nalgebra::{ComplexField, Vector3};

use super::*;
use crate::numerics::scalar::{Dual64, Scalar};
use crate::spacecraft::Polygon;

/// A rectangle about `center` with two half edges.
fn rectangle([c, u, v]: [Vector3<f64>; 3]) -> Outline {
    let polygon = Polygon::new(vec![c - u - v, c + u - v, c + u + v, c - u + v]).unwrap();
    Outline { polygon, hinge: None, two_sided: true }
}

/// A strip of the plane Z = 0 from `x_m` on, 1 m wide in Y, and a wall `height_m` above that covers X < 0.
fn edge(x_m: [f64; 2], height_m: f64) -> Vec<Outline> {
    let [from, to] = x_m;
    let strip = [Vector3::x() * ((from + to) / 2.0), Vector3::x() * ((to - from) / 2.0), Vector3::y() * 0.5];
    let wall = [Vector3::new(-50.0, 0.0, height_m), Vector3::x() * 50.0, Vector3::y() * 50.0];
    vec![rectangle(strip), rectangle(wall)]
}

fn mean(outlines: &[Outline], sun: &Vector3<f64>, sine: f64) -> Vec<(f64, Vector3<f64>)> {
    let scene = ShadowScene::new(outlines.to_vec());
    let mut workspace = ShadowWorkspace::default();
    scene.evaluate_disc(&SunDisc::new(&sun.normalize(), sine), &[], &mut workspace);
    let whole = |o: &Outline| (o.polygon.area_m2(), o.polygon.centroid_m());
    outlines.iter().enumerate().map(|(i, o)| workspace.lit(i).unwrap_or(whole(o))).collect()
}

/// Of a disc of radius 1 the part beyond a line `u` before its centre.
fn segment(u: f64) -> f64 {
    let u = u.clamp(-1.0, 1.0);
    0.5 + (u * (1.0 - u * u).sqrt() + u.asin()) / PI
}

/// What the wall leaves of a strip: the visible segment of the Sun summed point by point.
fn strip(x_m: [f64; 2], height_m: f64, sine: f64) -> f64 {
    let count = 200_000;
    let step = (x_m[1] - x_m[0]) / f64::from(count);
    (0..count).map(|k| segment((x_m[0] + (f64::from(k) + 0.5) * step) / (height_m * sine)) * step).sum()
}

/// Where the whole penumbra falls on a surface, its mean edge is the point Sun's, and its spread takes an eighth of its
/// half width squared from the first moment.
#[test]
fn an_edge_across_a_wide_surface_leaves_the_suns_segments() {
    let (sine, height_m) = (0.012, 2.0);
    let [(area_m2, center_m), _] = mean(&edge([-0.5, 1.5], height_m), &Vector3::z(), sine)[..] else {
        panic!()
    };
    assert_relative_eq!(area_m2, 1.5, epsilon = 1e-12);
    assert_relative_eq!(area_m2, strip([-0.5, 1.5], height_m, sine), epsilon = 1e-9);
    let half_width_m = height_m * sine;
    let moment_m3 = 1.5 * 1.5 / 2.0 - half_width_m * half_width_m / 8.0;
    // The light falls off with the cosine, and the tangent is not the sine: both to the radius squared.
    assert_relative_eq!(area_m2 * center_m.x, moment_m3, epsilon = half_width_m * half_width_m * sine);
    let point = mean(&edge([-0.5, 1.5], height_m), &Vector3::z(), 0.0);
    assert_relative_eq!(point[0].0 * point[0].1.x, 1.125, epsilon = 1e-12);
}

/// A surface narrower than the penumbra sees part of the Sun: within an eighth of what the segments say, and softer than
/// the all or nothing of a point.
#[test]
fn a_strip_in_the_penumbra_is_partly_lit() {
    let (sine, height_m) = (0.012, 2.0);
    let half_width_m = height_m * sine;
    for (from, width) in
        [(-1.2, 0.2), (-0.9, 0.4), (-0.3, 0.2), (-0.2, 0.8), (0.1, 0.5), (0.6, 0.3), (-1.0, 2.0)]
    {
        let x_m = [from * half_width_m, (from + width) * half_width_m];
        let whole = x_m[1] - x_m[0];
        let found = mean(&edge(x_m, height_m), &Vector3::z(), sine)[0].0 / whole;
        let expected = strip(x_m, height_m, sine) / whole;
        assert!((found - expected).abs() < 0.125, "{x_m:?}: {found} {expected}");
        let hard = mean(&edge(x_m, height_m), &Vector3::z(), 0.0)[0].0 / whole;
        assert!((found - expected).abs() <= (hard - expected).abs() + 1e-12, "{x_m:?}: {found} {hard}");
    }
    let all = mean(&edge([-half_width_m, half_width_m], height_m), &Vector3::z(), sine)[0].0;
    assert_relative_eq!(all, half_width_m, epsilon = 1e-9);
}

/// Rays from points of a tilted panel to points of the Sun, past a shade before it.
#[test]
fn a_shade_before_a_panel_leaves_what_rays_find() {
    let sine = 0.03;
    let panel = [Vector3::new(0.1, 0.05, 0.0), Vector3::new(1.2, 0.0, 0.2), Vector3::new(0.0, 0.8, 0.0)];
    let shade = [Vector3::new(0.0, 0.1, 1.5), Vector3::new(0.5, 0.1, 0.0), Vector3::new(-0.1, 0.4, 0.1)];
    let sun = Vector3::new(0.25, -0.15, 1.0).normalize();
    let across = sun.cross(&Vector3::x()).normalize();
    let other = sun.cross(&across);
    let [center, u, v] = panel;
    let normal = u.cross(&v).normalize();
    let shade_normal = shade[1].cross(&shade[2]);
    let (mut light, mut lit, mut moment) = (0.0, 0.0, Vector3::zeros());
    let (rays, cells) = (400, 120);
    for ray in 0..rays {
        let (radius, angle) =
            (((f64::from(ray) + 0.5) / f64::from(rays)).sqrt(), 2.399_963_229_728_653 * f64::from(ray));
        let off = (across * angle.cos() + other * angle.sin()) * (radius * sine);
        let toward = sun * (1.0 - off.norm_squared()).sqrt() + off;
        let cos = toward.dot(&normal);
        light += cos * f64::from(cells * cells);
        for cell in 0..cells * cells {
            let place = |k: i32| (f64::from(k) + 0.5) / f64::from(cells) * 2.0 - 1.0;
            let from = center + u * place(cell % cells) + v * place(cell / cells);
            let hit =
                from + toward * ((shade[0] - from).dot(&shade_normal) / toward.dot(&shade_normal)) - shade[0];
            // Components along the shade's half edges, which are not at right angles.
            let (a, b) = (hit.cross(&shade[2]).dot(&shade_normal), shade[1].cross(&hit).dot(&shade_normal));
            let size = shade_normal.norm_squared();
            if (a / size).abs() > 1.0 || (b / size).abs() > 1.0 {
                lit += cos;
                moment += from * cos;
            }
        }
    }
    let area_m2 = 4.0 * u.cross(&v).norm();
    let (found, found_center) = mean(&[rectangle(panel), rectangle(shade)], &sun, sine)[0];
    assert!(found < 0.9 * area_m2, "{found}");
    assert_relative_eq!(found, area_m2 * lit / light, max_relative = 1e-4);
    assert_relative_eq!(found_center, moment / lit, epsilon = 2e-4);
}

/// A disc without width is the point; slopes are those of differences; any direction of the Sun has a disc.
#[test]
fn a_disc_is_the_point_where_it_has_no_width_and_its_slopes_are_exact() {
    let outlines = edge([-0.5, 1.5], 2.0);
    let scene = ShadowScene::new(outlines.clone());
    let sun = Vector3::new(0.1, 0.2, 1.0).normalize();
    let mut workspace = ShadowWorkspace::default();
    scene.evaluate(&sun, &[], &mut workspace);
    let point = workspace.lit(0).unwrap();
    let none = mean(&outlines, &sun, 0.0)[0];
    assert_relative_eq!(none.0, point.0, max_relative = 1e-14);
    assert_relative_eq!(none.1, point.1, epsilon = 1e-14);

    let toward = Vector3::new(0.3, 0.1, -0.2);
    let at = |h: f64| mean(&outlines, &(sun + toward * h), 0.02 + h)[0].0;
    let seed = Dual64::new(0.0, 1.0);
    let moved = sun.map(Dual64::constant) + toward.map(|x| seed * x);
    let mut dual = ShadowWorkspace::default();
    let center = moved / ComplexField::sqrt(moved.dot(&moved));
    scene.evaluate_disc(&SunDisc::new(&center, seed + 0.02), &[], &mut dual);
    let slope = dual.lit(0).unwrap().0.eps;
    assert_relative_eq!(slope, (at(1e-6) - at(-1e-6)) / 2e-6, max_relative = 1e-6);

    for center in
        [Vector3::new(-0.48, 0.64, -0.6), Vector3::y(), -Vector3::y(), Vector3::new(0.48, -0.64, 0.6)]
    {
        let disc = SunDisc::new(&center, 0.02);
        let (mut sum, mut weights) = (Vector3::zeros(), 0.0);
        for number in 0..7 {
            let (direction, weight) = disc.direction(number);
            assert_relative_eq!(direction.norm(), 1.0, epsilon = 1e-14);
            sum += direction * weight;
            weights += weight;
        }
        assert_relative_eq!(weights, 1.0);
        // The mean direction is the centre, shortened by what a sphere's cap loses.
        assert_relative_eq!(sum, center * sum.norm(), epsilon = 1e-14);
    }
}
