//! Draws have the requested mean and deviation, are independent, and belong to seed and number alone.

use approx::assert_relative_eq;

use super::*;

const DRAWS: u64 = 1000;

fn settings() -> ThrusterEventSettings {
    ThrusterEventSettings {
        magnitude_error: 0.02,
        direction_error_rad: 5e-3,
        center_of_mass_shift_m: Vector3::new(1e-3, 2e-3, 0.0),
        seed: 11,
        ..ThrusterEventSettings::default()
    }
}

/// Mean 0 and this standard deviation within four standard errors: s / sqrt(n) of the mean, s / sqrt(2 n) of the deviation.
fn assert_normal(draws: &[f64], sigma: f64) {
    let n = draws.len() as f64;
    let mean = draws.iter().sum::<f64>() / n;
    let deviation = (draws.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
    assert!(mean.abs() < 4.0 * sigma / n.sqrt(), "mean {mean:e} of sigma {sigma:e}");
    assert!((deviation / sigma - 1.0).abs() < 4.0 / (2.0 * n).sqrt(), "{deviation:e}, requested {sigma:e}");
}

#[test]
fn a_thousand_maneuvers_have_the_requested_errors() {
    let delta_v = Vector3::new(3.0, -4.0, 12.0);
    let along = delta_v / 13.0;
    let one = along.cross(&Vector3::z()).normalize();
    let other = along.cross(&one);
    let executed: Vec<_> = (0..DRAWS).map(|k| settings().executed_m_s(&delta_v, k)).collect();
    let share = |it: &Vector3<f64>| it.norm() / 13.0 - 1.0;
    assert_normal(&executed.iter().map(share).collect::<Vec<_>>(), 0.02);
    // Angles about the two axes across.
    let angle = |it: &Vector3<f64>, axis: &Vector3<f64>| {
        let turn = along.cross(it).normalize() * along.angle(it);
        turn.dot(axis)
    };
    let angles = [one, other].map(|axis| executed.iter().map(|it| angle(it, &axis)).collect::<Vec<_>>());
    angles.iter().for_each(|it| assert_normal(it, 5e-3));
    // Products of independent draws have the product of their deviations.
    let products: Vec<_> = angles[0].iter().zip(&angles[1]).map(|(a, b)| a * b).collect();
    let mean = products.iter().sum::<f64>() / DRAWS as f64;
    assert!(mean.abs() < 4.0 * 25e-6 / (DRAWS as f64).sqrt(), "{mean:e}");
}

#[test]
fn a_thousand_shifts_have_the_requested_deviations() {
    let shifts: Vec<_> = (0..DRAWS).filter_map(|k| settings().shift_body_m(k)).collect();
    for (axis, sigma) in [1e-3, 2e-3].into_iter().enumerate() {
        assert_normal(&shifts.iter().map(|it| it[axis]).collect::<Vec<_>>(), sigma);
    }
    assert!(shifts.iter().all(|it| it.z == 0.0));
}

#[test]
fn one_error_alone_leaves_the_other_exact() {
    let delta_v = Vector3::new(0.0, 8.0, -6.0);
    let longer = ThrusterEventSettings { direction_error_rad: 0.0, ..settings() }.executed_m_s(&delta_v, 3);
    assert!(longer.angle(&delta_v) < 1e-15 && (longer.norm() - 10.0).abs() > 1e-3);
    let turned = ThrusterEventSettings { magnitude_error: 0.0, ..settings() }.executed_m_s(&delta_v, 3);
    assert_relative_eq!(turned.norm(), 10.0, max_relative = 1e-14);
    assert!(turned.angle(&delta_v) > 1e-4);
}

#[test]
fn without_deviations_nothing_is_drawn() {
    let delta_v = Vector3::new(0.1, -0.2, 0.3);
    let exact = ThrusterEventSettings { seed: 11, ..ThrusterEventSettings::default() };
    assert_eq!(exact.executed_m_s(&delta_v, 5), delta_v);
    assert_eq!(exact.shift_body_m(5), None);
}

#[test]
fn draws_belong_to_seed_and_number() {
    let delta_v = Vector3::new(0.1, -0.2, 0.3);
    let of = |seed, number| ThrusterEventSettings { seed, ..settings() }.executed_m_s(&delta_v, number);
    assert_eq!(of(1, 4), of(1, 4));
    assert_ne!(of(1, 4), of(1, 5));
    assert_ne!(of(1, 4), of(2, 4));
}

#[test]
fn a_place_among_events_of_one_time_is_kept() {
    let event = |at_s: f64| TimelineEvent {
        line: 1,
        at_s,
        maneuver: None,
        dump: Some(TimelineDump::Requested),
        center_of_mass_body_m: None,
    };
    // Times of a simulation are whole microseconds of an epoch: two of these stand at one.
    let schedule = [1e8 + 5.0, 1e8 + 7.0, 1e8 + 7.000_000_2, 1e8 + 9.0].map(event);
    let events =
        ThrusterEventSettings { schedule: Arc::from(schedule), clock_minus_time_s: 1e8, ..settings() };
    let (mut place, mut times_s) = (LastEvent::before(5.0), Vec::new());
    while let Some(event) = events.next(place) {
        times_s.push(event.at_s - 1e8);
        place.take(events.time_s(event));
    }
    assert_eq!(times_s.len(), 4, "{times_s:?}");
    assert_eq!(events.next_s(LastEvent::until(7.0)), 9.0);
    assert_eq!(events.next_s(LastEvent::before(7.0)), 7.0);
}
