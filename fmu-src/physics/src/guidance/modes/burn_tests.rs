//! Burns of a point mass: direction with each correction over seeds, magnitude with and without prediction, powered turns,
//! and what ends a burn.

use nalgebra::Vector3;

use super::sample_inputs::SampleInputs;
use super::system::GuidanceState;
use crate::attitude::Attitude;
use crate::attitude::control::AccelerometerSettings;
use crate::constants::DEG_RAD;
use crate::guidance::burn::delta_v::{BurnPhase, BurnSettings};
use crate::guidance::burn::velocity_path::VelocityPath;
use crate::guidance::pointing::command::Scenario;
use crate::guidance::tests::burn::{
    BurnFlight, ephemeris, guidance_settings, sample_inputs, settings, still_inputs,
};

/// Where a path ends.
fn end_m_s(path: &VelocityPath) -> Vector3<f64> {
    path.point(path.length_m_s()).velocity_m_s
}

/// Root mean square over seeds 1 to 16 of the true direction's error with these corrections, in deg.
fn direction_error_deg(predictive: bool, reactive: bool, bias_m_s2: f64) -> f64 {
    let squares = (1..=16).map(|seed| {
        let mut flight = BurnFlight::new(seed);
        (flight.settings.predictive, flight.settings.reactive) = (predictive, reactive);
        flight.accelerometers.bias_m_s2 = bias_m_s2;
        let end = end_m_s(&flight.settings.path.unwrap());
        let simulated = flight.simulated(140);
        (simulated.velocity_m_s.angle(&end) / DEG_RAD).powi(2)
    });
    (squares.sum::<f64>() / 16.0).sqrt()
}

#[test]
fn each_correction_points_better_and_both_best() {
    let [none, theta, beta, both] = [(false, false), (true, false), (false, true), (true, true)]
        .map(|(theta, beta)| direction_error_deg(theta, beta, 1.5e-5));
    // Without correction the misalignment stays; beta alone leaves what it needs to turn by it: the misalignment times
    // look-ahead over the burn's duration.
    assert!((none - 0.75).abs() < 0.05, "{none} deg");
    assert!((beta - 0.75 * 10.0 * 0.088 / 10.0).abs() < 0.01, "{beta} deg");
    assert!(theta < 0.1 && both < 0.02, "{theta} and {both} deg");
    assert!(none > beta && beta > both && theta > both, "{none}, {theta}, {beta}, {both} deg");
    // The bias is not seen: over the burn's duration it is a velocity across, about each of two axes.
    let biased = direction_error_deg(true, true, 1e-4);
    let expected = 1e-4 * 113.5 * 2.0_f64.sqrt() / 10.0 / DEG_RAD;
    assert!((biased / expected - 1.0).abs() < 0.4, "{biased} deg, expected about {expected}");
}

#[test]
fn the_thrust_direction_is_found() {
    for seed in 1..=8 {
        let mut flight = BurnFlight::new(seed);
        (flight.thrust.jitter_rad, flight.thrust.drift_rad) = (0.0, 0.0);
        flight.accelerometers = AccelerometerSettings::default();
        let simulated = flight.simulated(140);
        let found = simulated.guidance.burn.thrust_body(&flight.settings);
        let off = found.cross(&simulated.thrust_body).norm();
        assert!(off < 1e-9, "{off} rad");
        assert!(found.angle(&Vector3::z()) > 0.7 * DEG_RAD);
        // By the accelerometers the burn ends where it really does.
        let error_m_s = simulated.guidance.burn.velocity_m_s - simulated.velocity_m_s;
        assert!(error_m_s.norm() < 1e-4, "{error_m_s}");
    }
}

/// Root mean square over seeds of the error of the magnitude, in m/s.
fn magnitude_error_m_s(stops_between: bool, delta_v_m_s: f64) -> f64 {
    let squares = (1..=16).map(|seed| {
        let mut flight = BurnFlight::new(seed);
        flight.settings = settings(Vector3::x() * (delta_v_m_s + 0.005 * seed as f64));
        flight.accelerometers = AccelerometerSettings::default();
        flight.stops_between = stops_between;
        let simulated = flight.simulated(140);
        let requested = flight.settings.path.unwrap().length_m_s();
        (simulated.velocity_m_s.norm() - requested).powi(2)
    });
    (squares.sum::<f64>() / 16.0).sqrt()
}

#[test]
fn cut_off_is_predicted_between_samples() {
    // Thrust that ends a sample after the magnitude is reached has half a second's acceleration too much in the mean, and a
    // second's for the way to the spacecraft.
    let late = magnitude_error_m_s(false, 10.0);
    assert!((0.044..0.2).contains(&late), "{late} m/s");
    let predicted = magnitude_error_m_s(true, 10.0);
    assert!(predicted < 1e-4, "{predicted} m/s");
}

#[test]
fn a_short_burn_ends_by_the_nominal_acceleration() {
    let mut flight = BurnFlight::new(3);
    flight.settings = settings(Vector3::x() * 0.03);
    flight.accelerometers = AccelerometerSettings::default();
    flight.samples_per_exchange = 1;
    let simulated = flight.simulated(20);
    // It begins one exchange after its command, and the prediction does not know.
    assert!((simulated.velocity_m_s.norm() - 0.03).abs() < 1.01 * 0.088 * 0.02, "{}", simulated.velocity_m_s);
}

/// A powered turn by 40 deg that adds about 200 m/s.
fn powered_turn() -> VelocityPath {
    let coefficients =
        [Vector3::new(200.0, 0.0, 0.0), Vector3::new(-10.0, 60.0, 10.0), Vector3::new(-5.0, 10.0, 5.0)];
    VelocityPath::cubic(coefficients).unwrap()
}

#[test]
fn a_powered_turn_is_followed() {
    let mut flight = BurnFlight::new(5);
    flight.settings.path = Some(powered_turn());
    flight.settings.nominal.acceleration_m_s2 = 0.66;
    flight.thrust.force_n = 660.0;
    flight.thrust.exhaust_m_s = 3100.0;
    flight.accelerometers = AccelerometerSettings::default();
    let simulated = flight.simulated(400);
    let end = end_m_s(&flight.settings.path.unwrap());
    let error = simulated.velocity_m_s - end;
    assert!(simulated.velocity_m_s.angle(&end) < 0.01 * DEG_RAD, "{error}");
    assert!(error.norm() < 0.05, "{error}");
    assert!(simulated.farthest_m_s < 0.1, "{} m/s", simulated.farthest_m_s);
    // 40 deg in 320 s, and not at once.
    let mean = 40.0 * DEG_RAD / 320.0;
    assert!((mean..3.0 * mean).contains(&simulated.fastest_rad_s), "{} rad/s", simulated.fastest_rad_s);
}

/// A burn under way on its path without errors, `count` samples after the start, exactly as long as it may be.
fn under_way(burn: &BurnSettings, count: u32) -> (GuidanceState, SampleInputs) {
    let settings = guidance_settings(*burn);
    let mut guidance = GuidanceState::new(Attitude::default(), 0.0);
    let mut inputs = still_inputs();
    for _ in 0..count {
        guidance.sample(&settings, &inputs, |_| None);
        let command = guidance.command;
        let next_s = guidance.next_sample_s;
        inputs = sample_inputs(command.attitude_at(next_s), inputs.delta_v_body_m_s);
        if guidance.burn.stop_s().is_some() {
            inputs.delta_v_body_m_s += Vector3::z() * 0.088;
        }
    }
    (guidance, inputs)
}

#[test]
fn the_commanded_rate_turns_the_thrust_along_the_path() {
    let burn = BurnSettings { path: Some(powered_turn()), ..settings(Vector3::x()) };
    let (mut guidance, inputs) = under_way(&burn, 900);
    let before = guidance.command;
    guidance.sample(&guidance_settings(burn), &inputs, |_| None);
    let after = guidance.command;
    let turn = before.attitude_at(900.0 - 1.0).rotation_vector_to(&after.attitude_at(900.0));
    let mean = (before.rate_body_rad_s + after.rate_body_rad_s) * 0.5;
    assert!(turn.norm() > 1e-4, "{turn}");
    assert!((turn - mean).norm() < 1e-3 * turn.norm(), "{turn} {mean}");
}

#[test]
fn before_and_after_a_burn_the_attitude_is_held() {
    let burn = settings(Vector3::new(8.0, -2.0, 1.0));
    let direction = Vector3::new(8.0, -2.0, 1.0).normalize();
    let (waiting, _) = under_way(&burn, 5);
    assert_eq!(waiting.burn.phase, BurnPhase::Waiting { since_s: 0.0, refused: false });
    assert!(!waiting.burn.is_missed());
    let pointed = waiting.command.attitude_at(5.0).to_inertial(&Vector3::z());
    assert!(pointed.angle(&direction) < 1e-12);
    let (ended, _) = under_way(&burn, 150);
    assert_eq!(ended.burn.phase, BurnPhase::Ended { timed_out: false });
    assert!(!ended.burn.is_requested() && ended.burn.stop_s().is_none());
    let pointed = ended.command.attitude_at(150.0).to_inertial(&Vector3::z());
    assert!(pointed.angle(&direction) < 1e-3);
    assert_eq!(ended.command.rate_body_rad_s, Vector3::zeros());
}

#[test]
fn a_burn_without_acceleration_times_out() {
    let burn = BurnSettings { timeout_s: 20.5, ..settings(Vector3::x() * 10.0) };
    let all = guidance_settings(burn);
    let mut guidance = GuidanceState::new(Attitude::default(), 0.0);
    let inputs = still_inputs();
    for second in 0..60 {
        guidance.sample(&all, &inputs, |_| None);
        let expected = (5..26).contains(&second).then_some(25.5);
        assert_eq!(guidance.burn.stop_s(), expected, "{second} s");
        assert!(guidance.is_valid());
    }
    assert_eq!(guidance.burn.phase, BurnPhase::Ended { timed_out: true });
}

#[test]
fn a_burn_interrupted_does_not_go_on_by_itself() {
    let burn = settings(Vector3::x() * 10.0);
    let all = guidance_settings(burn);
    let (burning, inputs) = under_way(&burn, 30);
    assert!(burning.burn.stop_s().is_some());
    // No attitude: Earth Acquisition, and promotion after it.
    let mut guidance = burning;
    let mut lost = inputs;
    lost.sensed.estimate = None;
    guidance.sample(&all, &lost, |_| None);
    assert_eq!(guidance.burn.phase, BurnPhase::Ended { timed_out: false });
    let mut promoted = inputs;
    promoted.sensed.request = Some(super::mode::Mode::Operational);
    for _ in 0..10 {
        guidance.sample(&all, &promoted, |_| None);
        assert_eq!(guidance.burn.stop_s(), None);
    }
    // Another scenario ends it, the same one again is another burn.
    let mut guidance = burning;
    let mut other = inputs;
    other.command.scenario = Some(Scenario::Nadir);
    guidance.sample(&all, &other, |_| None);
    assert_eq!(guidance.burn.phase, BurnPhase::Ended { timed_out: false });
    guidance.sample(&all, &inputs, |_| None);
    assert!(guidance.burn.stop_s().is_some());
    assert_eq!(guidance.burn.velocity_m_s, Vector3::zeros());
    // An entry of a timeline that continues with its scenario does not begin it anew, one that names it does.
    let mut guidance = burning;
    let mut planned = inputs;
    planned.entries.scenario = Some(7.0);
    guidance.sample(&all, &planned, |_| None);
    assert_eq!(guidance.burn.velocity_m_s, Vector3::zeros());
    planned.entries.scenario = None;
    planned.delta_v_body_m_s += Vector3::z() * 0.088;
    guidance.sample(&all, &planned, |_| None);
    assert!(guidance.burn.velocity_m_s.norm() > 0.08);
}

#[test]
fn no_thrust_without_direction_or_off_the_aim() {
    let none = BurnSettings { path: None, ..settings(Vector3::x()) };
    let (guidance, _) = under_way(&none, 20);
    assert_eq!(guidance.burn.stop_s(), None);
    assert!(guidance.status.degenerate);
    // A keep-in zone that the burn's direction leaves no room in.
    let toward_sun = crate::guidance::geometry::moving::value(&ephemeris().to_sun()).normalize() * 10.0;
    let burn = settings(toward_sun);
    let mut all = guidance_settings(burn);
    all.modes.operational.keep_in = Some(all.keep_in);
    let mut guidance = GuidanceState::new(Attitude::default(), 0.0);
    for _ in 0..20 {
        guidance.sample(&all, &still_inputs(), |_| None);
    }
    assert!(guidance.status.sun_keep_in && !guidance.status.reachable);
    assert_eq!(guidance.burn.phase, BurnPhase::Waiting { since_s: 0.0, refused: true });
}

#[test]
fn a_burn_that_cannot_begin_says_so_and_times_out() {
    let toward_sun = crate::guidance::geometry::moving::value(&ephemeris().to_sun()).normalize() * 10.0;
    let burn = BurnSettings { timeout_s: 20.0, wait_s: 20.0, ..settings(toward_sun) };
    let none = BurnSettings { path: None, ..burn };
    for burn in [burn, none] {
        let mut all = guidance_settings(burn);
        all.modes.operational.keep_in = Some(all.keep_in);
        let mut guidance = GuidanceState::new(Attitude::default(), 0.0);
        for second in 0..40 {
            guidance.sample(&all, &still_inputs(), |_| None);
            // Due at 5 s.
            assert_eq!(guidance.burn.is_missed(), second >= 5, "{second}");
            assert_eq!(guidance.burn.is_requested(), second < 25, "{second}");
            assert_eq!(guidance.burn.stop_s(), None);
        }
        assert_eq!(guidance.burn.phase, BurnPhase::Ended { timed_out: true });
    }
    // The zone gives way while the burn waits.
    let mut all = guidance_settings(BurnSettings { timeout_s: 1e3, wait_s: 1e3, ..burn });
    let mut guidance = GuidanceState::new(Attitude::default(), 0.0);
    for second in 0..12 {
        all.modes.operational.keep_in = (second < 9).then_some(all.keep_in);
        guidance.sample(&all, &still_inputs(), |_| None);
        assert_eq!(guidance.burn.is_missed(), (5..9).contains(&second), "{second}");
        assert_eq!(guidance.burn.stop_s().is_some(), second >= 9, "{second}");
    }
}

#[test]
fn a_burn_that_another_scenario_ends_before_it_began_says_so() {
    let burn = settings(Vector3::x() * 10.0);
    let all = guidance_settings(burn);
    let (waiting, inputs) = under_way(&burn, 3);
    let mut other = inputs;
    other.command.scenario = Some(Scenario::Nadir);
    let mut lost = inputs;
    lost.sensed.estimate = None;
    for ending in [other, lost] {
        let mut guidance = waiting;
        guidance.sample(&all, &ending, |_| None);
        assert_eq!(guidance.burn.phase, BurnPhase::Ended { timed_out: true });
        assert!(guidance.burn.is_missed() && !guidance.burn.is_requested());
        // Commanded anew it is another burn.
        if ending.sensed.estimate.is_some() {
            guidance.sample(&all, &inputs, |_| None);
            assert!(!guidance.burn.is_missed() && guidance.burn.is_requested());
        }
    }
}
