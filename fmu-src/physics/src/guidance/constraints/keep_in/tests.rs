//! Against a search along the boundary, differences of the attitude, and the words of Table 6.
use std::f64::consts::{FRAC_PI_2, PI};

use approx::assert_relative_eq;

use super::*;
use crate::attitude::{angle_between_rad, direction_from_angles};
use crate::guidance::geometry::moving::{matrix_value, moving, rate};
use crate::guidance::tests::geometry::{Motion, Random, cube_directions, difference_rad_s, nearest_zone};
use crate::tests::short_or_long;

const METHODS: [KeepInMethod; 2] = [KeepInMethod::Nearest, KeepInMethod::Clamp];

fn random_zone(random: &mut Random) -> KeepIn {
    let mut limit_rad = || {
        let free_rad = random.within(0.0, FRAC_PI_2);
        random.one_of(&[free_rad, free_rad, free_rad, 0.2 * free_rad, 0.0, FRAC_PI_2])
    };
    let (azimuth_rad, elevation_rad) = (limit_rad(), limit_rad());
    let axes: Vec<Vector3<f64>> = cube_directions().chain([random.direction() * 3.0]).collect();
    let method = random.one_of(&METHODS);
    let distance_m = f64::INFINITY;
    KeepIn { axis_body: random.one_of(&axes), azimuth_rad, elevation_rad, method, distance_m }
}

fn random_vectors(random: &mut Random) -> PointingVectors {
    let mut vector = || moving(random.direction() * 2.0, random.direction() * 1e-4);
    PointingVectors {
        boresight_body: vector(),
        aimpoint: vector(),
        body_roll: vector(),
        external_roll: vector(),
    }
}

/// The rotation from the zone's frame typed anew: half the turn from -Y to the axis twice over.
fn zone_from_body(axis_body: &Vector3<f64>) -> nalgebra::UnitQuaternion<f64> {
    nalgebra::UnitQuaternion::rotation_between(&-Vector3::y(), axis_body)
        .unwrap_or_else(|| nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), PI))
        .inverse()
}

/// Angle from a direction to the zone, by the part of it that is nearest: inside 0.
fn distance_outside_rad(zone: &KeepIn, sun_body: &Vector3<f64>) -> f64 {
    let angles = SunAngles::from_direction(&(zone_from_body(&zone.axis_body) * sun_body));
    let over_rad = (angles.azimuth_rad.abs() - zone.azimuth_rad).max(0.0);
    let above_rad = (angles.elevation_rad.abs() - zone.elevation_rad).max(0.0);
    // A step along a parallel is as long as the cosine of its elevation.
    (over_rad * angles.elevation_rad.cos()).max(above_rad)
}

#[test]
fn no_command_leaves_the_zone() {
    let mut random = Random(1);
    let (mut worst_rad, mut in_force) = (0.0_f64, 0);
    let count = short_or_long(200_000, 1_000_000);
    for _ in 0..count {
        let (zone, vectors) = (random_zone(&mut random), random_vectors(&mut random));
        let to_sun = moving(random.direction() * 5e10, random.direction() * 5e4);
        let kept = zone.constrained(&vectors, &to_sun).unwrap();
        in_force += u32::from(kept.in_force);
        let sun_body = value(&kept.pointing.to_body(&unit(&to_sun).unwrap()));
        worst_rad = worst_rad.max(distance_outside_rad(&zone, &sun_body));
    }
    assert!(worst_rad < 1e-12, "{worst_rad:e}");
    assert!((count / 2..count / 1000 * 999).contains(&in_force), "{in_force}");
}

#[test]
fn inside_the_zone_the_attitude_keeps_its_bits() {
    let mut random = Random(2);
    for _ in 0..100_000 {
        let (zone, vectors) = (random_zone(&mut random), random_vectors(&mut random));
        let to_sun = moving(random.direction(), random.direction() * 1e-5);
        let free = vectors.pointing().unwrap();
        let kept = zone.constrained(&vectors, &to_sun).unwrap();
        let outside_rad = distance_outside_rad(&zone, &value(&free.to_body(&to_sun)));
        assert!(outside_rad == 0.0 || kept.in_force || outside_rad < 1e-14);
        assert!(outside_rad > 0.0 || !kept.in_force);
        assert!(kept.in_force || kept.pointing == free);
    }
}

#[test]
fn no_point_of_the_boundary_is_nearer() {
    let mut random = Random(3);
    let mut edges = [0; 3];
    for _ in 0..4000 {
        let zone = KeepIn { method: KeepInMethod::Nearest, ..random_zone(&mut random) };
        let to_body = zone_from_body(&zone.axis_body).inverse();
        let sun_body = random.direction();
        let Some(point) = zone.boundary_point(&fixed(sun_body)).unwrap() else { continue };
        let offered_rad = angle_between_rad(&value(&point), &sun_body);
        let steps = 200;
        for step in -steps..=steps {
            let share = f64::from(step) / f64::from(steps);
            let (a, e) = (zone.azimuth_rad, zone.elevation_rad);
            for (azimuth_rad, elevation_rad) in
                [(a, share * e), (-a, share * e), (share * a, e), (share * a, -e)]
            {
                let other = to_body * direction_from_angles(SunAngles { azimuth_rad, elevation_rad });
                let other_rad = angle_between_rad(&other, &sun_body);
                assert!(offered_rad <= other_rad + 1e-13, "{zone:?} {sun_body} {offered_rad} {other_rad}");
            }
        }
        let at = zone.angles(&value(&point)).unwrap();
        let on_meridian = (at.azimuth_rad.abs() - zone.azimuth_rad).abs() * at.elevation_rad.cos() < 1e-14;
        let on_parallel = (at.elevation_rad.abs() - zone.elevation_rad).abs() < 1e-14;
        assert!(on_meridian || on_parallel);
        edges[usize::from(on_parallel) + usize::from(on_meridian && on_parallel)] += 1;
    }
    assert!(edges.iter().all(|count| *count > 100), "{edges:?}");
}

#[test]
fn clamping_cuts_both_angles() {
    let mut random = Random(4);
    for _ in 0..10_000 {
        let zone = KeepIn { method: KeepInMethod::Clamp, ..random_zone(&mut random) };
        let sun_body = random.direction();
        let Some(point) = zone.boundary_point(&fixed(sun_body)).unwrap() else { continue };
        let angles = SunAngles::from_direction(&(zone_from_body(&zone.axis_body) * sun_body));
        let cut = SunAngles {
            azimuth_rad: angles.azimuth_rad.clamp(-zone.azimuth_rad, zone.azimuth_rad),
            elevation_rad: angles.elevation_rad.clamp(-zone.elevation_rad, zone.elevation_rad),
        };
        let expected = zone_from_body(&zone.axis_body).inverse() * direction_from_angles(cut);
        assert_relative_eq!(value(&point), expected, epsilon = 1e-13);
    }
}

#[test]
fn the_zones_frame_is_a_rotation_of_the_body_to_the_axis() {
    let near = [1e-3, 1e-8, 1e-12, 1e-17]
        .into_iter()
        .flat_map(|d| [Vector3::new(d, 1.0, -d), Vector3::new(d, -1.0, -d), Vector3::new(0.0, 1.0, d)]);
    for axis_body in cube_directions().chain(near) {
        let zone = KeepIn { axis_body, ..nearest_zone(0.1, 0.1) };
        let matrix = zone.body_from_zone().unwrap();
        assert_relative_eq!(matrix * matrix.transpose(), Matrix3::identity(), epsilon = 1e-15);
        assert_relative_eq!(matrix.determinant(), 1.0, epsilon = 1e-15);
        assert_relative_eq!(matrix * -Vector3::y(), axis_body.normalize(), epsilon = 1e-15);
        let cosine = -axis_body.normalize().y;
        assert_relative_eq!(matrix.trace(), 1.0 + 2.0 * cosine, epsilon = 1e-15);
    }
    let about = |axis_body| KeepIn { axis_body, ..nearest_zone(0.1, 0.1) }.body_from_zone();
    assert_eq!(about(-Vector3::y()), Some(Matrix3::identity()));
    assert_eq!(about(Vector3::y()), Some(Matrix3::from_diagonal(&Vector3::new(-1.0, -1.0, 1.0))));
    assert_eq!(about(Vector3::zeros()), None);
}

#[test]
fn the_old_boresight_comes_as_near_to_its_aimpoint_as_a_turn_about_the_sun_allows() {
    let mut random = Random(6);
    for _ in 0..2000 {
        let (zone, vectors) = (random_zone(&mut random), random_vectors(&mut random));
        let to_sun = moving(random.direction(), random.direction() * 1e-5);
        let kept = zone.constrained(&vectors, &to_sun).unwrap();
        if !kept.in_force {
            continue;
        }
        let to_inertial = matrix_value(&kept.pointing.inertial_from_body);
        let boresight = to_inertial * value(&vectors.boresight_body);
        let off_rad = angle_between_rad(&boresight, &value(&vectors.aimpoint));
        for turn_deg in [-120.0, -10.0, -1e-2, 1e-2, 10.0, 180.0_f64] {
            let turn = nalgebra::Rotation3::from_scaled_axis(value(&to_sun) * turn_deg.to_radians());
            let other_rad = angle_between_rad(&(turn * boresight), &value(&vectors.aimpoint));
            assert!(off_rad <= other_rad + 1e-12);
        }
    }
}

#[test]
fn a_sun_on_an_axis_is_kept_in() {
    let mut random = Random(8);
    for axis in cube_directions().map(|axis| axis.normalize()) {
        for _ in 0..200 {
            let zone = KeepIn { axis_body: -Vector3::y(), ..random_zone(&mut random) };
            if let Some(point) = zone.boundary_point(&fixed(axis)).unwrap() {
                let found = value(&point);
                assert!(distance_outside_rad(&zone, &found) < 1e-14, "{axis} {zone:?} {found}");
                assert!(rate(&point) == Vector3::zeros());
            }
        }
    }
}

#[test]
fn rounding_about_an_axis_does_not_choose_the_boundary_point() {
    let mut random = Random(9);
    let zone = nearest_zone(0.26, 0.22);
    for axis in [Vector3::z(), -Vector3::z(), Vector3::y()] {
        for method in METHODS {
            let at = |noise: Vector3<f64>| {
                let zone = KeepIn { method, ..zone };
                value(&zone.boundary_point(&fixed((axis + noise).normalize())).unwrap().unwrap())
            };
            let exact = at(Vector3::zeros());
            for _ in 0..200 {
                let found = at(random.direction() * 1e-16);
                assert!((found - exact).norm() < 1e-12, "{axis} {method:?}: {found} {exact}");
            }
        }
    }
}

#[test]
fn the_clamp_is_up_to_half_a_degree_farther_in_the_quarter_about_the_axis() {
    let zone = |method| KeepIn {
        axis_body: -Vector3::y(),
        azimuth_rad: 15.0_f64.to_radians(),
        elevation_rad: 13.0_f64.to_radians(),
        method,
        distance_m: f64::INFINITY,
    };
    let mut farthest_deg = 0.0_f64;
    for azimuth_deg in 0..90 {
        for elevation_deg in 0..90 {
            let [azimuth_rad, elevation_rad] =
                [azimuth_deg, elevation_deg].map(|it| f64::from(it).to_radians());
            let sun = direction_from_angles(SunAngles { azimuth_rad, elevation_rad });
            let off_rad = |method| {
                let point = zone(method).boundary_point(&fixed(sun)).unwrap();
                point.map(|point| angle_between_rad(&value(&point), &sun))
            };
            let both = off_rad(KeepInMethod::Clamp).zip(off_rad(KeepInMethod::Nearest));
            let excess_rad = both.map_or(0.0, |(clamp, nearest)| clamp - nearest);
            assert!(excess_rad > -1e-14);
            farthest_deg = farthest_deg.max(excess_rad.to_degrees());
        }
    }
    assert!((0.4..0.5).contains(&farthest_deg), "{farthest_deg}");
}

/// Edge and quadrant of a boundary point; what changes at a corner or where two points are as near.
fn edge(zone: &KeepIn, sun_body: &Vector3<f64>) -> [i8; 4] {
    let at = SunAngles::from_direction(&(zone_from_body(&zone.axis_body) * sun_body));
    let side = |x: f64| if x.abs() < 1e-9 { 0 } else { x.signum() as i8 };
    [
        side(at.azimuth_rad * at.elevation_rad.cos()),
        side(at.elevation_rad),
        i8::from((zone.azimuth_rad - at.azimuth_rad.abs()) * at.elevation_rad.cos() > 1e-12),
        i8::from(at.elevation_rad.abs() < zone.elevation_rad - 1e-12),
    ]
}

#[test]
fn the_rate_is_the_difference_of_the_attitude() {
    let mut random = Random(7);
    let (mut compared, mut switching) = (0, 0);
    for _ in 0..5000 {
        let zone = random_zone(&mut random);
        let motions = [(); 5].map(|()| Motion::random(&mut random));
        let at = |time_s: f64| {
            let [boresight_body, aimpoint, body_roll, external_roll, to_sun] =
                motions.map(|motion| motion.at(time_s));
            let vectors = PointingVectors { boresight_body, aimpoint, body_roll, external_roll };
            let kept = zone.constrained(&vectors, &to_sun).filter(|kept| kept.in_force)?;
            Some((kept.pointing, edge(&zone, &value(&kept.pointing.to_body(&to_sun)))))
        };
        let Some((pointing, edge)) = at(0.0) else { continue };
        let found = pointing.frame().rate_body_rad_s;
        let step_s = (3e-4 / found.norm()).min(0.1);
        let same_edge = |t: f64| at(t).filter(|(_, other)| *other == edge).map(|(pointing, _)| pointing);
        let Some(expected) = difference_rad_s(same_edge, step_s) else {
            switching += 1;
            continue;
        };
        let error = (found - expected).norm() / expected.norm().max(1e-5);
        assert!(error < 1e-7, "{error:e} {zone:?}");
        compared += 1;
    }
    assert!(compared > 3000 && switching < 50, "{compared} {switching}");
}
