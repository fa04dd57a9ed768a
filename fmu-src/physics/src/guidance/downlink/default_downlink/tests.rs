//! The choice by its table against the choice made anew, and what MESSENGER's antennas are known to do.
use super::*;
use crate::guidance::pointing::antenna::tests::{antennas, fan, fixed_along, quadrants};
use crate::guidance::tests::geometry::Random;

#[test]
fn messenger_changes_its_antenna_at_90_deg_alone() {
    let law = DefaultDownlink::new(&quadrants());
    assert_eq!(law.first, EarthBoresight::Behind);
    assert_eq!(law.changes, [(0.0, EarthBoresight::Ahead)]);
    for cosine in [-1.0, -0.3, -1e-300, 0.0, 1e-300, 0.7, 1.0] {
        let expected = if cosine > 0.0 { EarthBoresight::Behind } else { EarthBoresight::Ahead };
        assert_eq!((law.boresight(cosine), law.margin(cosine)), (expected, cosine));
    }
    assert!(!law.moves_the_sun());
    // Without antennas the same.
    let without = DefaultDownlink::default();
    assert_eq!((without.first, without.changes), (law.first, law.changes));
}

#[test]
fn one_fixed_antenna_looks_at_the_earth_always() {
    let axis_body = Vector3::new(0.0, 0.6, 0.8);
    let law = DefaultDownlink::new(&antennas(&[fixed_along(axis_body)]));
    assert_eq!((law.first, law.changes.len()), (EarthBoresight::Fixed(axis_body), 0));
    assert!(law.moves_the_sun() && law.margin(0.2) == f64::INFINITY);
}

#[test]
fn of_two_fixed_antennas_the_one_that_leaves_the_sun_nearer_looks() {
    let (near, far) = (Vector3::new(0.0, -0.8, 0.6), Vector3::z());
    let law = DefaultDownlink::new(&antennas(&[fixed_along(far), fixed_along(near)]));
    // 36.87 and 90 deg from -Y: midway lies 63.43 deg.
    let midway_rad = 0.5 * (0.6_f64.asin() + FRAC_PI_2);
    assert_eq!((law.first, law.changes.len()), (EarthBoresight::Fixed(near), 1));
    assert!((law.changes[0].0 - midway_rad.cos()).abs() < 1e-15);
    assert_eq!(law.changes[0].1, EarthBoresight::Fixed(far));
}

#[test]
fn the_table_says_at_every_angle_what_is_chosen_there() {
    let mut random = Random(31);
    let (mut most, mut compared) = (0, 0);
    for _ in 0..2_000 {
        let list: Vec<_> = (0..1 + (random.within(0.0, 5.99) as usize))
            .map(|_| {
                if random.within(0.0, 1.0) < 0.5 {
                    return fixed_along(random.direction());
                }
                let from_deg = random.within(-180.0, 180.0).round();
                fan(from_deg, from_deg + random.one_of(&[10.0, 45.0, 90.0, 121.0, 180.0, 360.0]))
            })
            .collect();
        let all = antennas(&list);
        let law = DefaultDownlink::new(&all);
        most = most.max(law.changes.len());
        for _ in 0..50 {
            let separation_rad = random.within(0.0, PI);
            let is_edge = law.changes.iter().any(|(at, _)| (at.acos() - separation_rad).abs() < 1e-7);
            if is_edge {
                continue;
            }
            compared += 1;
            assert_eq!(law.boresight(separation_rad.cos()), chosen(&all, separation_rad), "{list:?}");
        }
    }
    assert!(most > 8 && compared > 90_000, "{most} {compared}");
}
