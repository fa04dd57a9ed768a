//! What is lit agrees with cases solved by hand, with rays cast one by one, and with an independent polygon library.

use core::f64::consts::PI;

use approx::assert_relative_eq;
use i_overlay::core::{fill_rule::FillRule, overlay_rule::OverlayRule};
use i_overlay::float::single::SingleFloatOverlay;
use nalgebra::{Rotation3, Unit, Vector2, Vector3};
use proptest::prelude::*;

use super::*;
use crate::numerics::scalar::{Dual64, Scalar};
use crate::spacecraft::{Polygon, Spacecraft, SunshadeModel};
use crate::tests::short_or_long;

fn outline(points: &[[f64; 3]]) -> Outline {
    let polygon = Polygon::new(points.iter().map(|p| Vector3::from(*p)).collect()).unwrap();
    Outline { polygon, hinge: None, two_sided: true }
}

/// A rectangle about `center` with two half edges.
fn rectangle(center: [f64; 3], u: [f64; 3], v: [f64; 3]) -> Outline {
    let [c, u, v] = [center, u, v].map(Vector3::from);
    let polygon = Polygon::new(vec![c - u - v, c + u - v, c + u + v, c - u + v]).unwrap();
    Outline { polygon, hinge: None, two_sided: true }
}

fn lit(outlines: &[Outline], sun: &Vector3<f64>, angles: &[f64]) -> Vec<(f64, Vector3<f64>)> {
    let scene = ShadowScene::new(outlines.to_vec());
    let mut workspace = ShadowWorkspace::default();
    scene.evaluate(&sun.normalize(), angles, &mut workspace);
    outlines
        .iter()
        .enumerate()
        .map(|(i, o)| workspace.lit(i).unwrap_or((o.polygon.area_m2(), o.polygon.centroid_m())))
        .collect()
}

/// A unit shade one metre before the middle of a panel of 4 x 2, the Sun ahead and then aslant.
#[test]
fn a_panel_behind_a_shade_loses_the_shades_shadow() {
    let panel = rectangle([0.0; 3], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let shade = rectangle([0.0, 0.0, 1.0], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0]);
    let both = [panel, shade];
    let ahead = lit(&both, &Vector3::z(), &[]);
    assert_relative_eq!(ahead[0].0, 7.0, epsilon = 1e-8);
    assert_relative_eq!(ahead[0].1, Vector3::zeros(), epsilon = 1e-8);
    assert_relative_eq!(ahead[1].0, 1.0, epsilon = 1e-12);
    // The Sun 0.75 m per metre toward +x: the shadow moves to x from -1.25 to -0.25.
    let aslant = lit(&both, &Vector3::new(0.75, 0.0, 1.0), &[]);
    assert_relative_eq!(aslant[0].0, 7.0, epsilon = 1e-8);
    assert_relative_eq!(aslant[0].1.x, 0.75 / 7.0, epsilon = 1e-8);
    // Farther on, half of the shadow falls beside the panel: x from -2.5 to -1.5.
    let beside = lit(&both, &Vector3::new(2.0, 0.0, 1.0), &[]);
    assert_relative_eq!(beside[0].0, 7.5, epsilon = 1e-8);
    assert_relative_eq!(beside[0].1.x, 0.5 * 1.75 / 7.5, epsilon = 1e-8);
    // From behind the shade is in the panel's shadow, all of it.
    let behind = lit(&both, &-Vector3::z(), &[]);
    assert_eq!(behind[1].0, 0.0);
    assert_relative_eq!(behind[0].0, 8.0, epsilon = 1e-12);
}

/// Two plates of 2 x 2 crossing at right angles along y: at 45 deg each shades one half of the other.
#[test]
fn crossed_plates_shade_each_other() {
    let plates = [
        rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]),
        rectangle([0.0; 3], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]),
    ];
    // At an elevation of tan e = 2 the upright half plate casts a shadow half its height long.
    let found = lit(&plates, &Vector3::new(1.0, 0.0, 2.0), &[]);
    assert_relative_eq!(found[0].0, 3.0, epsilon = 1e-8);
    assert_relative_eq!(found[0].1.x, (2.0 * 0.5 - 1.0 * 0.75) / 3.0, epsilon = 1e-8);
    // On the upright plate the lying one shades what is below: the half that the light would reach through it.
    assert_relative_eq!(found[1].0, 2.0, epsilon = 1e-8);
    assert_relative_eq!(found[1].1.z, 0.5, epsilon = 1e-8);
    let diagonal = lit(&plates, &Vector3::new(1.0, 0.0, 1.0), &[]);
    assert_relative_eq!(diagonal[0].0, 2.0, epsilon = 1e-8);
    assert_relative_eq!(diagonal[1].0, 2.0, epsilon = 1e-8);
}

fn box_faces() -> Vec<Outline> {
    let [x, y, z] = [[1.0, 0.0, 0.0], [0.0, 0.7, 0.0], [0.0, 0.0, 0.4]];
    let neg = |v: [f64; 3]| v.map(|c| -c);
    vec![
        rectangle(x, y, z),
        rectangle(neg(x), z, y),
        rectangle(y, z, x),
        rectangle(neg(y), x, z),
        rectangle(z, x, y),
        rectangle(neg(z), y, x),
    ]
}

#[test]
fn a_convex_body_does_not_shade_its_sunlit_side() {
    let outlines = box_faces();
    let scene = ShadowScene::new(outlines.clone());
    let mut workspace = ShadowWorkspace::default();
    for sun in [[0.3, 0.5, -0.8], [-0.9, 0.1, 0.2], [0.0, 1.0, 0.0]].map(Vector3::from) {
        scene.evaluate(&sun.normalize(), &[], &mut workspace);
        for (i, outline) in outlines.iter().enumerate() {
            if outline.polygon.normal().dot(&sun) > 0.0 {
                assert_eq!(workspace.lit(i), None, "face {i} is touched");
            }
        }
    }
    // With nothing behind its faces the visibility test leaves no pair at all.
    let closed = outlines.into_iter().map(|outline| Outline { two_sided: false, ..outline }).collect();
    let scene = ShadowScene::new(closed);
    assert_eq!(scene.candidate_pairs(), 0);
}

#[test]
fn what_lies_back_to_back_casts_no_shadow_on_itself() {
    let front = rectangle([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let back = Outline { polygon: front.polygon.reversed(), hinge: None, two_sided: true };
    assert_eq!(ShadowScene::new(vec![front.clone(), back.clone()]).candidate_pairs(), 0);
    // A plate given with its back as a plate of its own counts once.
    let behind = rectangle([0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]);
    let scene = ShadowScene::new(vec![front, back, behind]);
    let mut workspace = ShadowWorkspace::<f64>::default();
    scene.evaluate(&Vector3::z(), &[], &mut workspace);
    assert_eq!(workspace.clipped_pairs(), 1);
    assert_eq!(workspace.lit(2).unwrap().0, 0.0);
}

/// An L-shaped shade, not convex: its shadow is that of its two rectangles.
#[test]
fn an_outline_that_is_not_convex_casts_its_own_shadow() {
    let panel = rectangle([0.0; 3], [3.0, 0.0, 0.0], [0.0, 3.0, 0.0]);
    let z = 1.0;
    let l =
        outline(&[[0.0, 0.0, z], [2.0, 0.0, z], [2.0, 1.0, z], [1.0, 1.0, z], [1.0, 2.0, z], [0.0, 2.0, z]]);
    let found = lit(&[panel.clone(), l.clone()], &Vector3::z(), &[]);
    assert_relative_eq!(found[0].0, 33.0, epsilon = 1e-8);
    assert_relative_eq!(found[0].1.x, -3.0 * (2.5 / 3.0) / 33.0, epsilon = 1e-8);
    // And an L loses only what is in its own arms: the panel's smaller brother over one arm's end.
    let cap = rectangle([1.5, 0.5, 2.0], [0.25, 0.0, 0.0], [0.0, 5.0, 0.0]);
    let found = lit(&[l, cap], &Vector3::z(), &[]);
    assert_relative_eq!(found[0].0, 2.5, epsilon = 1e-8);
}

#[test]
fn a_turning_panel_shades_at_every_angle() {
    let hinge = Hinge { panel: 0, point_body_m: Vector3::z(), axis_body: Vector3::x() };
    let mut shade = rectangle([0.0, 0.0, 1.0], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0]);
    shade.hinge = Some(hinge);
    let panel = rectangle([0.0; 3], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]);
    for angle in [-1.5, -0.3, 0.0, 0.8, 1.2, PI, 4.0_f64] {
        let found = lit(&[panel.clone(), shade.clone()], &Vector3::z(), &[angle]);
        assert_relative_eq!(found[0].0, 16.0 - angle.cos().abs(), epsilon = 1e-8);
    }
    // The other way round: the panel turns under a fixed shade and gathers its shadow on a slope.
    let turned = lit(
        &[
            rectangle([0.0, 0.0, 1.0], [0.5, 0.0, 0.0], [0.0, 0.5, 0.0]),
            Outline { hinge: Some(Hinge { point_body_m: Vector3::zeros(), ..hinge }), ..panel },
        ],
        &Vector3::z(),
        &[0.5],
    );
    assert_relative_eq!(turned[1].0, 16.0 - 1.0 / 0.5_f64.cos(), epsilon = 1e-8);
}

/// A point in space is lit when no outline is met on the way to the Sun.
fn ray_is_free(outlines: &[Outline], skip: usize, from: &Vector3<f64>, sun: &Vector3<f64>) -> bool {
    outlines.iter().enumerate().filter(|(i, _)| *i != skip).all(|(_, outline)| {
        let vertices = outline.polygon.vertices_m();
        let normal = outline.polygon.normal();
        let distance = normal.dot(&(vertices[0] - from)) / normal.dot(sun);
        if !(distance > 1e-9 && distance.is_finite()) {
            return true;
        }
        let hit = from + sun * distance;
        // A rectangle is left of all its edges.
        !(0..vertices.len()).all(|i| {
            let (a, b) = (vertices[i], vertices[(i + 1) % vertices.len()]);
            normal.dot(&(b - a).cross(&(hit - a))) > 0.0
        })
    })
}

/// Lit area and moments of a quadrilateral from rays spread evenly along no direction (the additive recurrence of the
/// plastic number, Roberts 2018), so that no edge runs along a row of them.
fn cast_rays(outlines: &[Outline], index: usize, sun: &Vector3<f64>, count: usize) -> (f64, Vector3<f64>) {
    let v = outlines[index].polygon.vertices_m();
    let (u, w) = (v[1] - v[0], v[3] - v[0]);
    let cell = u.cross(&w).norm() / count as f64;
    let mut area = 0.0;
    let mut moments = Vector3::zeros();
    for k in 0..count {
        let [a, b] =
            [0.754_877_666_246_692_7, 0.569_840_290_998_053_2].map(|step| (0.5 + k as f64 * step).fract());
        let point = v[0] + u * a + w * b;
        if ray_is_free(outlines, index, &point, sun) {
            area += cell;
            moments += point * cell;
        }
    }
    (area, moments)
}

/// Rectangles scattered at random, some crossing.
fn random_scene() -> impl Strategy<Value = Vec<Outline>> {
    let one = (
        prop::array::uniform3(-1.5..1.5_f64),
        prop::array::uniform3(-3.0..3.0_f64),
        0.2..1.0_f64,
        0.2..1.0_f64,
    )
        .prop_map(|(center, turn, u, v)| {
            let rotation = Rotation3::from_euler_angles(turn[0], turn[1], turn[2]);
            let edge = |e: Vector3<f64>| (rotation * e).into();
            rectangle(center, edge(Vector3::x() * u), edge(Vector3::y() * v))
        });
    prop::collection::vec(one, 2..7)
}

fn suns() -> impl Strategy<Value = Vector3<f64>> {
    (-PI..PI, -1.0..1.0_f64).prop_map(|(a, z)| {
        let rho = (1.0 - z * z).sqrt();
        Vector3::new(rho * a.cos(), rho * a.sin(), z)
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(short_or_long(8, 24)))]
    #[test]
    fn rays_cast_one_by_one_find_the_same(outlines in random_scene(), sun in suns()) {
        let found = lit(&outlines, &sun, &[]);
        for (i, outline) in outlines.iter().enumerate() {
            // At grazing light a shadow's edge is long, and the rays are few along it.
            prop_assume!(outline.polygon.normal().dot(&sun).abs() > 0.1);
            let (area, moments) = cast_rays(&outlines, i, &sun, 200_000);
            let whole = outline.polygon.area_m2();
            prop_assert!((found[i].0 - area).abs() < 1e-3 * whole, "{} {area} of {whole}", found[i].0);
            prop_assert!((found[i].1 * found[i].0 - moments).norm() < 4e-3 * whole);
        }
    }
}

proptest! {
    /// The shadows on one plane, subtracted by a library of polygons on an integer grid.
    #[test]
    fn a_polygon_library_finds_the_same(outlines in random_scene(), sun in suns()) {
        let receiver = rectangle([0.0, 0.0, -4.0], [2.5, 0.0, 0.0], [0.0, 2.5, 0.0]);
        prop_assume!(sun.z > 0.3);
        let flat = |v: &Vector3<f64>| { let p = v - sun * ((v.z + 4.0) / sun.z); [p.x, p.y] };
        let subject: Vec<[f64; 2]> = receiver.polygon.vertices_m().iter().map(flat).collect();
        let shadows: Vec<Vec<[f64; 2]>> = outlines
            .iter()
            .map(|outline| {
                let mut shadow: Vec<_> = outline.polygon.vertices_m().iter().map(flat).collect();
                if outline.polygon.normal().dot(&sun) < 0.0 {
                    shadow.reverse();
                }
                shadow
            })
            .collect();
        let pieces = subject.overlay(&shadows, OverlayRule::Difference, FillRule::NonZero);
        let area: f64 = pieces.iter().flatten().map(|contour| {
            (0..contour.len()).map(|i| {
                let (a, b) = (contour[i], contour[(i + 1) % contour.len()]);
                Vector2::from(a).perp(&Vector2::from(b)) / 2.0
            }).sum::<f64>()
        }).sum();
        let mut all = vec![receiver];
        all.extend(outlines);
        let found = lit(&all, &sun, &[]);
        prop_assert!((found[0].0 - area).abs() < 1e-6, "{} {area}", found[0].0);
    }

    #[test]
    fn light_changes_little_as_the_sun_moves_little(
        outlines in random_scene(), sun in suns(), axis in suns(),
    ) {
        let step = 1e-7;
        let turned = Rotation3::from_axis_angle(&Unit::new_normalize(axis), step) * sun;
        let (before, after) = (lit(&outlines, &sun, &[]), lit(&outlines, &turned, &[]));
        for (i, outline) in outlines.iter().enumerate() {
            // The power on the surface is continuous; where it looks along its own plane the side changes.
            let cos = outline.polygon.normal().dot(&sun).abs();
            let cos_turned = outline.polygon.normal().dot(&turned).abs();
            prop_assert!((before[i].0 * cos - after[i].0 * cos_turned).abs() < 1e-5);
            prop_assert!((before[i].1 * before[i].0 * cos - after[i].1 * after[i].0 * cos_turned).norm() < 3e-5);
        }
    }

    #[test]
    fn derivatives_are_slopes(outlines in random_scene(), sun in suns(), by in prop::array::uniform3(-1.0..1.0_f64)) {
        let mut outlines = outlines;
        outlines[0].hinge = Some(Hinge { panel: 0, point_body_m: Vector3::zeros(), axis_body: Vector3::x() });
        let scene = ShadowScene::new(outlines.clone());
        let exact = evaluate(&scene, &sun, by, Dual64::new(0.0, 1.0));
        let (near, far) = (1e-6, 2e-6);
        let at = |h: f64| evaluate(&scene, &sun, by, h);
        let quotient = |i: usize, h: f64| (at(h)[i].0 - at(-h)[i].0) / (2.0 * h);
        for (i, exact) in exact.iter().enumerate().take(outlines.len()) {
            let slope = quotient(i, near);
            // Away from edges, where a vertex appears or goes.
            prop_assume!((slope - quotient(i, far)).abs() < 1e-6);
            let scale = 1.0 + exact.0.eps.abs();
            prop_assert!((slope - exact.0.eps).abs() < 1e-6 * scale, "{slope} {}", exact.0.eps);
        }
    }
}

fn evaluate<T: Scalar>(
    scene: &ShadowScene,
    sun: &Vector3<f64>,
    by: [f64; 3],
    seed: T,
) -> Vec<(T, Vector3<T>)> {
    let moved = sun.map(T::constant) + Vector3::from(by.map(|x| seed * x));
    let mut workspace = ShadowWorkspace::default();
    scene.evaluate(&(moved / moved.dot(&moved).sqrt()), &[seed * 0.7 + 0.4], &mut workspace);
    let none = (T::constant(0.0), Vector3::zeros());
    (0..7).map(|i| workspace.lit(i).unwrap_or(none)).collect()
}

/// Surfaces of the example that people copy from: its bus, shade and panels share corners and edges.
fn orbiter() -> Vec<Outline> {
    let text = include_str!("../../../../resources/examples/mercury-orbiter.toml");
    let spacecraft = Spacecraft::from_toml("mercury-orbiter.toml", text).unwrap();
    let plates = spacecraft.plates_body(SunshadeModel::Plates);
    let fixed = plates.iter().map(|plate| Outline {
        polygon: plate.polygon.clone().unwrap(),
        hinge: None,
        two_sided: plate.faces.rear_optics.is_some(),
    });
    let turning = spacecraft.panels.iter().enumerate().map(|(index, panel)| Outline {
        polygon: panel.polygon.clone().unwrap(),
        hinge: Some(Hinge { panel: index, point_body_m: panel.center_body_m, axis_body: panel.axis_body }),
        two_sided: panel.faces.rear_optics.is_some(),
    });
    fixed.chain(turning).collect()
}

/// An outline at the panels' angles.
fn posed(outline: &Outline, angles_rad: &[f64]) -> Polygon {
    outline.hinge.map_or(outline.polygon.clone(), |hinge| {
        let turn = Rotation3::from_axis_angle(&Unit::new_normalize(hinge.axis_body), angles_rad[hinge.panel]);
        outline.polygon.moved(|v| hinge.point_body_m + turn * (v - hinge.point_body_m))
    })
}

/// Area of the part of `index` that the Sun lights, seen along the light: everything that stands before it is projected
/// and subtracted by the library.
fn lit_along_the_light(polygons: &[Polygon], index: usize, sun: &Vector3<f64>) -> f64 {
    let across = if sun.x.abs() < 0.7 { Vector3::x() } else { Vector3::y() };
    let u = sun.cross(&across).normalize();
    let w = sun.cross(&u);
    let seen = |points: &[Vector3<f64>]| -> Vec<[f64; 2]> {
        let mut seen: Vec<_> = points.iter().map(|p| [p.dot(&u), p.dot(&w)]).collect();
        if doubled_area(&seen) < 0.0 {
            seen.reverse();
        }
        seen
    };
    let receiver = &polygons[index];
    let sunward = receiver.normal() * receiver.normal().dot(sun).signum();
    let height = |p: &Vector3<f64>| sunward.dot(&(p - receiver.centroid_m()));
    let shadows: Vec<Vec<[f64; 2]>> = polygons
        .iter()
        .enumerate()
        .filter(|(other, _)| *other != index)
        .map(|(_, polygon)| {
            let vertices = polygon.vertices_m();
            let mut above = Vec::new();
            for (k, to) in vertices.iter().enumerate() {
                let from = &vertices[(k + vertices.len() - 1) % vertices.len()];
                let (before, after) = (height(from), height(to));
                if before * after < 0.0 {
                    above.push(from + (to - from) * (before / (before - after)));
                }
                if after > 0.0 {
                    above.push(*to);
                }
            }
            seen(&above)
        })
        .filter(|shadow| doubled_area(shadow) > 1e-9)
        .collect();
    let left = seen(receiver.vertices_m()).overlay(&shadows, OverlayRule::Difference, FillRule::NonZero);
    left.iter().flatten().map(|contour| doubled_area(contour) / 2.0).sum()
}

fn doubled_area(contour: &[[f64; 2]]) -> f64 {
    (0..contour.len())
        .map(|i| Vector2::from(contour[i]).perp(&Vector2::from(contour[(i + 1) % contour.len()])))
        .sum()
}

#[test]
fn the_example_orbiter_is_lit_as_a_polygon_library_finds_all_over_the_sphere() {
    let outlines = orbiter();
    let scene = ShadowScene::new(outlines.clone());
    let (mut plain, mut dual) = (ShadowWorkspace::default(), ShadowWorkspace::default());
    let count = 4000;
    let mut shadowed = 0;
    for k in 0..count {
        // Fibonacci's points, and directions along and between the axes among them.
        let (z, azimuth) =
            (1.0 - 2.0 * (f64::from(k) + 0.5) / f64::from(count), f64::from(k) * 2.399_963_229_728_653);
        let even = Vector3::new((z * 1e3).round(), (azimuth % 3.0).round(), (azimuth % 2.0).round());
        let sun = match k % 10 {
            0 if even.norm() > 0.0 => even.normalize(),
            _ => Vector3::new(azimuth.cos() * (1.0 - z * z).sqrt(), azimuth.sin() * (1.0 - z * z).sqrt(), z),
        };
        let angles_rad = [[0.0, 0.0], [0.6, -0.6], [PI, 2.5], [-1.2, 0.3]][k as usize % 4];
        scene.evaluate(&sun, &angles_rad, &mut plain);
        let seeded = |value: f64| Dual64::new(value, 0.3);
        scene.evaluate(&sun.map(seeded), &angles_rad.map(seeded), &mut dual);
        let polygons: Vec<Polygon> = outlines.iter().map(|outline| posed(outline, &angles_rad)).collect();
        for (i, polygon) in polygons.iter().enumerate() {
            let whole = polygon.area_m2();
            let cos = polygon.normal().dot(&sun);
            if cos.abs() < 1e-9 || (cos < 0.0 && !outlines[i].two_sided) {
                continue;
            }
            let found = plain.lit(i).map_or(whole, |lit| lit.0);
            let expected = lit_along_the_light(&polygons, i, &sun);
            assert!(
                (found * cos.abs() - expected).abs() < 1e-6,
                "{i} at {sun:?}: {} {expected}",
                found * cos.abs()
            );
            let with_slopes = dual.lit(i).map_or(whole, |lit| lit.0.value());
            assert!((with_slopes - found).abs() < 1e-9 * whole, "{i} at {sun:?}: {with_slopes} {found}");
            shadowed += u32::from(found < 0.999 * whole);
        }
    }
    assert!(shadowed > 3000, "{shadowed}");
}
