//! Outlines known by heart have their area, centre and normal; points that are no outline are refused.

use approx::assert_relative_eq;

use super::*;

fn polygon(points: &[[f64; 3]]) -> Result<Polygon, Refusal> {
    Polygon::new(points.iter().map(|p| Vector3::from(*p)).collect())
}

#[test]
fn an_angle_iron_has_the_area_and_centre_of_its_two_squares() {
    // Three unit squares in an L, in the plane x = 2, normal +x.
    let l = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [1.0, 1.0], [1.0, 2.0], [0.0, 2.0]];
    let l: Vec<[f64; 3]> = l.iter().map(|[y, z]| [2.0, *y, *z]).collect();
    let polygon = polygon(&l).unwrap();
    assert_relative_eq!(polygon.area_m2(), 3.0, epsilon = 1e-14);
    assert_relative_eq!(polygon.normal(), Vector3::x(), epsilon = 1e-15);
    let middle = (0.5 + 1.5 + 0.5) / 3.0;
    assert_relative_eq!(polygon.centroid_m(), Vector3::new(2.0, middle, middle), epsilon = 1e-14);
    assert_relative_eq!(polygon.reversed().normal(), -Vector3::x(), epsilon = 1e-15);
}

#[test]
fn corners_in_whole_millimetres_are_moved_onto_the_plane_through_them() {
    // A pentagon in a plane askew, as exact and as rounded numbers.
    let normal = Vector3::new(0.36, 0.48, 0.8);
    let east = Vector3::new(0.8, -0.6, 0.0);
    let north = normal.cross(&east);
    let corner = |k: u32| {
        let angle = f64::from(k) * 0.4 * core::f64::consts::PI;
        Vector3::new(1.0, 2.0, 3.0) + east * angle.cos() * 0.7 + north * angle.sin() * 0.7
    };
    let exact = Polygon::new((0..5).map(corner).collect()).unwrap();
    assert_eq!(exact.off_plane_m(), 0.0);
    let in_mm = |v: Vector3<f64>| v.map(|x| (x * 1e3).round() / 1e3);
    let rounded: Vec<_> = (0..5).map(corner).map(in_mm).collect();
    let polygon = Polygon::new(rounded.clone()).unwrap();
    let off_m = polygon.off_plane_m();
    assert!((1e-5..0.87e-3).contains(&off_m), "{off_m}");
    for (vertex, given) in polygon.vertices_m().iter().zip(&rounded) {
        let moved_m = vertex - given;
        assert!(moved_m.norm() <= off_m * (1.0 + 1e-9) && moved_m.cross(&polygon.normal()).norm() < 1e-15);
        assert!(polygon.normal().dot(&(vertex - polygon.centroid_m())).abs() < 1e-15);
    }
    assert!(polygon.normal().angle(&exact.normal()) < 1e-3);
    assert_relative_eq!(polygon.area_m2(), exact.area_m2(), max_relative = 2e-3);
    // In the plane already: another reading moves nothing.
    assert_eq!(Polygon::new(polygon.vertices_m().to_vec()).unwrap().off_plane_m(), 0.0);
    // A millimetre and a half is no rounding, nor is half a millimetre on a chip of 2 cm.
    let bent = |size: f64, off: f64| {
        let corners = [[0.0, 0.0, off], [size, 0.0, -off], [size, size, off], [0.0, size, -off]];
        self::polygon(&corners)
    };
    assert!(bent(1.0, 0.9e-3).is_ok() && bent(1.0, 1.5e-3).is_err() && bent(0.02, 0.5e-3).is_err());
}

#[test]
fn what_is_no_outline_is_refused_with_the_reason() {
    let says = |points: &[[f64; 3]], text: &str| {
        let error = polygon(points).unwrap_err().to_string();
        assert!(error.contains(text), "{error}");
    };
    says(&[[0.0; 3], [1.0, 0.0, 0.0]], "2 vertices, allowed: at least 3");
    says(&[[0.0; 3], [1.0, 0.0, 0.0], [f64::NAN, 1.0, 0.0]], "vertex 3 that is not finite");
    says(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0; 3]], "vertices 1 and 3 in one place");
    says(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]], "vertices on one line");
    let bent = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.1], [0.0, 1.0, 0.0]];
    says(&bent, "off the plane");
    let bow_tie = [[0.0, 0.0, 0.0], [1.0, 1.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    says(&bow_tie, "edges 1 and 3 cross");
    let touching = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    says(&touching, "cross or touch");
    let spike = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]];
    says(&spike, "edges 1 and 2 cross");
}
