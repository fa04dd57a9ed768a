//! Fewest steps against all choices, and the corridor at every time.

use physics::constants::{ASTRONOMICAL_UNIT_M, DAY_S};

use super::*;

const CORRIDOR: Articulation = Articulation { min_suns: 2.0, max_suns: 4.2, target_suns: 3.0 };

/// From 0.31 to 0.69 AU and back, a row each half day.
fn places() -> Vec<(f64, f64)> {
    each(0.5)
}

/// Over 200 days, a row each so many days.
fn each(days: f64) -> Vec<(f64, f64)> {
    let distance_au = |day: f64| 0.5 - 0.19 * (core::f64::consts::TAU * day / 130.0).cos();
    (0..=(200.0 / days).round() as i32)
        .map(|k| days * f64::from(k))
        .map(|day| (day * DAY_S, distance_au(day) * ASTRONOMICAL_UNIT_M))
        .collect()
}

fn holds(steps: &[OffsetStep], places: &[(f64, f64)]) -> bool {
    places.iter().all(|&(at_s, distance_m)| {
        let step = steps.iter().rev().find(|step| step.at_s <= at_s).unwrap();
        let suns = step.offset_rad.cos() / (distance_m / ASTRONOMICAL_UNIT_M).powi(2);
        CORRIDOR.margin_suns(suns) >= -1e-9
    })
}

/// Between rows as at them, extremes of the distance being rows.
#[test]
fn the_corridor_is_kept_up_to_each_step() {
    for days in [0.25, 0.5, 1.0, 2.5] {
        let found = baseline(&CORRIDOR, &each(days), &[], &[]).unwrap();
        assert!(found.len() > 3 && holds(&found, &each(0.01)), "{days} d: {found:?}");
    }
}

/// By trying every set of so many steps: none of fewer steps keeps the corridor, each from the row before on.
#[test]
fn no_choice_has_fewer_steps() {
    let places: Vec<_> = places().into_iter().step_by(20).collect();
    let found = baseline(&CORRIDOR, &places, &[], &[]).unwrap();
    let shares = |from: usize, to: usize| {
        let all = places[from.saturating_sub(1)..to].iter().map(|it| allowed_rad(&CORRIDOR, it.1).unwrap());
        let shared = all.fold(ALL, meet);
        shared[0] <= shared[1]
    };
    let mut fewest = usize::MAX;
    for cuts in 0_u32..1 << (places.len() - 1) {
        let mut from = 0;
        let mut keeps = true;
        for to in 1..=places.len() {
            if to == places.len() || cuts >> (to - 1) & 1 == 1 {
                keeps &= shares(from, to);
                from = to;
            }
        }
        if keeps {
            fewest = fewest.min(cuts.count_ones() as usize + 1);
        }
    }
    assert_eq!(found.len(), fewest);
    assert!(holds(&found, &places));
}

#[test]
fn steps_are_at_edges_of_windows_where_as_many_suffice() {
    let places = places();
    let edges: Vec<f64> = (1..66).map(|k| 3.0 * DAY_S * f64::from(k)).collect();
    let anywhere = baseline(&CORRIDOR, &places, &[], &[]).unwrap();
    let at_edges = baseline(&CORRIDOR, &places, &edges, &[]).unwrap();
    assert_eq!(anywhere.len(), at_edges.len());
    assert!(at_edges[1..].iter().all(|step| edges.contains(&step.at_s)));
    assert!(holds(&anywhere, &places) && holds(&at_edges, &places));
}

#[test]
fn a_distance_without_an_offset_is_named() {
    let far = [(0.0, 0.5 * ASTRONOMICAL_UNIT_M), (DAY_S, 0.71 * ASTRONOMICAL_UNIT_M)];
    let none = baseline(&CORRIDOR, &far, &[], &[]).unwrap_err();
    assert_eq!(none.at_s, DAY_S);
    assert!((none.suns - 0.71_f64.powi(-2)).abs() < 1e-12);
}
