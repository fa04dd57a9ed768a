//! What sensors see of a nutating spinner, against geometry and statistics.

use approx::assert_relative_eq;
use nalgebra::Vector3;
use std::f64::consts::PI;

use super::{ace, directions, launch, paper_start, undamped};
use crate::attitude::angle_between_rad;
use crate::numerics::noise::{Channel, normal};
use crate::spin::{
    geometry::L1Ephemeris,
    nutation::period_variation_s,
    plant::{Commands, Directions, Outputs, Plant, Sampling},
    tracker::{NutationEstimator, picket_of, searched},
};

#[test]
fn sun_crossing_periods_spread_as_eq_1_says_for_small_nutation() {
    let spinner = ace();
    for beta_deg in [5.0_f64, 10.0, 20.0] {
        let mut start = undamped(1.483);
        start.nutation_rad = 0.01_f64.to_radians();
        let beta = beta_deg.to_radians();
        let sun = Directions { sun_inertial: Vector3::new(0.0, beta.sin(), beta.cos()), ..directions() };
        // Put the momentum, not the body axis, at that Sun angle.
        let mut plant = Plant::start(&spinner, &start, sun, Commands::default(), 0.0).unwrap();
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for i in 1..2000 {
            plant.advance(&spinner, 6.0 * f64::from(i)).unwrap();
            if let Some(period) = plant.sensors.sun.period_s {
                least = least.min(period);
                most = most.max(period);
            }
        }
        // Eq 1 is the greatest change from the mean: the crossing shifts by Theta / (Omega tan beta) either way, and
        // with a ratio near 1.5 it alternates from turn to turn.
        let expected = period_variation_s(start.nutation_rad, PI / 6.0, beta);
        assert_relative_eq!(0.5 * (most - least), expected, max_relative = 0.02);
    }
}

#[test]
fn a_quiet_spinner_crosses_the_sun_once_a_period() {
    let spinner = ace();
    let mut plant = launch(&spinner, &paper_start(1.483));
    plant.advance(&spinner, 1200.5).unwrap();
    let outputs = Outputs::from_plant(&plant, &spinner);
    assert_eq!(plant.sensors.sun.count, 101);
    assert_relative_eq!(outputs.period_s, 12.0, max_relative = 1e-12);
    assert!(outputs.sector_error.abs() < 1e-6);
    assert_relative_eq!(outputs.sun_angle_rad.to_degrees(), 10.0, max_relative = 1e-12);
    assert_relative_eq!(outputs.earth_angle_rad, 0.02_f64.atan(), max_relative = 1e-12);
}

#[test]
fn every_picket_is_searched_once_in_eight_turns() {
    for picket in 0..900 {
        assert_eq!((0..8).filter(|&turn| searched(picket, turn, 8)).count(), 1);
    }
    assert_eq!(picket_of(0.0, 900), 0);
    assert_eq!(picket_of(-1e-9, 900), 899);
    assert_eq!(picket_of(0.4_f64.to_radians() * 1.5, 900), 1);
}

#[test]
fn the_star_is_sampled_every_eight_spins_or_every_96_s() {
    let spinner = ace();
    for (sampling, spacing) in [(Sampling::Spins, 96.0 * 5.0 / 4.9), (Sampling::Clock, 96.0)] {
        let mut start = paper_start(1.483);
        start.spin_rate_rad_s = 4.9 * PI / 30.0;
        start.sampling = sampling;
        let mut plant = launch(&spinner, &start);
        let mut times = Vec::new();
        for i in 1..2000 {
            plant.advance(&spinner, f64::from(i)).unwrap();
            let sample = plant.sensors.sample;
            if times.last() != Some(&sample.time_s) && sample.count > 0 {
                times.push(sample.time_s);
            }
        }
        assert!(times.len() > 18);
        for pair in times.windows(2) {
            assert_relative_eq!(pair[1] - pair[0], spacing, max_relative = 1e-9);
        }
    }
}

#[test]
fn declination_swings_by_the_nutation_angle_either_way() {
    let spinner = ace();
    let mut start = undamped(1.483);
    start.nutation_rad = 0.02_f64.to_radians();
    let mut plant = launch(&spinner, &start);
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 1..10_000 {
        plant.advance(&spinner, 0.01 * f64::from(i)).unwrap();
        let declination = Outputs::from_plant(&plant, &spinner).declination_rad;
        least = least.min(declination);
        most = most.max(declination);
    }
    // Peak to peak twice the nutation angle, for a star near the equator of the momentum.
    assert_relative_eq!(most - least, 2.0 * start.nutation_rad, max_relative = 1e-3);
}

#[test]
fn the_estimator_finds_the_nutation_angle_within_its_own_error() {
    let spinner = ace();
    let mut hits = 0;
    for seed in 0..20 {
        let mut start = undamped(1.478);
        start.nutation_rad = 0.03_f64.to_radians();
        start.seed = seed;
        let mut plant = launch(&spinner, &start);
        plant.advance(&spinner, 4.0 * 3600.0).unwrap();
        let estimate = Outputs::from_plant(&plant, &spinner).estimate;
        assert!(plant.sensors.estimator.count > 100);
        assert!(estimate.sigma_rad.to_degrees() < 0.004);
        hits += i32::from((estimate.nutation_rad - start.nutation_rad).abs() < estimate.sigma_rad);
    }
    // Two thirds of 20 lie within one standard deviation; 8 or fewer would be a chance of one in a hundred.
    assert!(hits > 8, "{hits}");
}

#[test]
fn the_estimator_is_exact_without_noise_and_silent_without_samples() {
    let mut estimator = NutationEstimator::default();
    assert_eq!(estimator.estimate(0.0).sigma_rad, PI);
    for k in 0..9 {
        let phase = 0.37 * f64::from(k);
        estimator.add(phase, 0.2 + 3e-4 * (phase - 1.1).cos());
    }
    let estimate = estimator.estimate(0.0);
    assert_relative_eq!(estimate.nutation_rad, 3e-4, max_relative = 1e-9);
    assert_eq!(estimate.sigma_rad, 0.0);
}

#[test]
fn draws_are_normal_and_depend_on_seed_channel_and_event_alone() {
    let draws: Vec<f64> = (0..20_000).map(|event| normal(7, Channel::StarTracker, event)).collect();
    let mean = draws.iter().sum::<f64>() / 20_000.0;
    let variance = draws.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / 20_000.0;
    let tail = draws.iter().filter(|x| x.abs() > 1.96).count() as f64 / 20_000.0;
    assert!(mean.abs() < 0.03 && (variance - 1.0).abs() < 0.04 && (tail - 0.05).abs() < 0.006);
    assert_eq!(draws[5], normal(7, Channel::StarTracker, 5));
    assert_ne!(draws[5], normal(8, Channel::StarTracker, 5));
    assert_ne!(draws[5], normal(7, Channel::SunSensor, 5));
}

#[test]
fn sun_and_earth_of_the_l1_orbit_stand_where_the_geometry_puts_them() {
    let mut orbit = ace().l1_orbit;
    let day = 86_400.0;
    let at = |orbit: &crate::spin::geometry::L1Orbit, t: f64| orbit.sun_earth(&Default::default(), t);
    // Without an amplitude Sun and Earth are opposite and turn by 0.9829 deg a day.
    orbit.amplitude_m = [0.0; 3];
    let (now, later) = (at(&orbit, 0.0), at(&orbit, day));
    assert_relative_eq!(angle_between_rad(&now.sun_inertial, &-now.earth_inertial), 0.0, epsilon = 1e-12);
    assert_relative_eq!(
        angle_between_rad(&now.earth_inertial, &later.earth_inertial).to_degrees(),
        0.9829,
        max_relative = 1e-12
    );
    // With it the Earth wanders by the amplitude over the distance.
    let orbit = ace().l1_orbit;
    let mut most: f64 = 0.0;
    for i in 0..400 {
        let seen = at(&orbit, f64::from(i) * day);
        most = most.max(angle_between_rad(&seen.sun_inertial, &-seen.earth_inertial));
    }
    let expected = (2.64071e8_f64.hypot(1.57406e8) / 1.5e9).atan();
    assert!(most < expected * 1.1 && most > 0.8 * expected, "{most} {expected}");
}

#[test]
fn directions_on_the_l1_orbit_do_not_depend_on_the_grid() {
    let spinner = ace();
    let mut start = paper_start(1.483);
    start.l1 = Some(L1Ephemeris { orbit: spinner.l1_orbit, phases: Default::default() });
    // Spin axis a little off the Sun.
    let sun = spinner.l1_orbit.sun_earth(&Default::default(), 0.0).sun_inertial;
    let axis = Vector3::z().cross(&sun).normalize();
    let q = crate::attitude::Quaternion::turn(&axis, angle_between_rad(&Vector3::z(), &sun) + 0.1);
    start.attitude = q.0;
    let launch = || launch(&spinner, &start);
    let mut whole = launch();
    whole.advance(&spinner, 4000.0).unwrap();
    let mut cut = launch();
    for i in 1..=4000 {
        cut.advance(&spinner, f64::from(i)).unwrap();
    }
    assert_eq!(Outputs::from_plant(&whole, &spinner), Outputs::from_plant(&cut, &spinner));
    assert!(whole.sensors.sun.count > 330);
}

#[test]
fn the_sector_error_is_what_a_spin_divided_by_the_period_before_is_off() {
    let spinner = ace();
    let mut start = undamped(1.4);
    start.nutation_rad = 1.0_f64.to_radians();
    let mut plant = launch(&spinner, &start);
    let (mut crossings, mut most) = (Vec::new(), 0.0_f64);
    for i in 1..2000 {
        plant.advance(&spinner, 0.1 * f64::from(i)).unwrap();
        let seen_s = plant.sensors.sun.last_s;
        if crossings.last() != seen_s.as_ref() {
            crossings.extend(seen_s);
        }
        let [.., a, b, c] = crossings[..] else { continue };
        let outputs = Outputs::from_plant(&plant, &spinner);
        assert_relative_eq!(outputs.period_s, c - b, max_relative = 1e-12);
        assert_relative_eq!(outputs.period_change_s, (c - b) - (b - a), epsilon = 1e-12);
        // Sectors of the width learnt in one spin, counted over the next.
        let width_s = (b - a) / 16_384.0;
        assert_relative_eq!(outputs.sector_error, (c - b) / width_s - 16_384.0, epsilon = 1e-6);
        most = most.max(outputs.sector_error.abs());
    }
    assert!(crossings.len() > 15 && most > 10.0, "{most}");
}

/// The star passes the slit when its azimuth in the body is that of the boresight, 90 deg.
#[test]
fn a_star_is_sampled_where_it_passes_the_boresight_also_after_another_is_chosen() {
    let mut spinner = ace();
    spinner.star_tracker.every = 1;
    spinner.star_tracker.noise_deg = 0.0;
    let star = |azimuth_deg: f64, declination_deg: f64| {
        let (azimuth, declination) = (azimuth_deg.to_radians(), declination_deg.to_radians());
        let (sin, cos) = azimuth.sin_cos();
        let star_inertial = Vector3::new(cos * declination.cos(), sin * declination.cos(), declination.sin());
        Directions { star_inertial, ..directions() }
    };
    let mut plant =
        Plant::start(&spinner, &paper_start(1.483), star(210.0, 3.0), Commands::default(), 0.0).unwrap();
    // 30 deg a second: from 90 to 210 deg in 4 s.
    plant.advance(&spinner, 26.0).unwrap();
    assert_relative_eq!(
        Outputs::from_plant(&plant, &spinner).declination_rad.to_degrees(),
        3.0,
        max_relative = 1e-12
    );
    let seen = plant.sensors.sample;
    assert_eq!(seen.count, 2);
    assert_relative_eq!(seen.time_s, 16.0, max_relative = 1e-12);
    assert_relative_eq!(seen.declination_rad.to_degrees(), 3.0, max_relative = 1e-12);
    // At 26 s the boresight is at 150 deg; a star at 240 deg comes 3 s later, the old one would in 2 s.
    plant.command(Commands::default(), star(240.0, -9.9));
    plant.advance(&spinner, 28.5).unwrap();
    assert_eq!(plant.sensors.sample.count, 2);
    plant.advance(&spinner, 30.0).unwrap();
    let seen = plant.sensors.sample;
    assert_eq!(seen.count, 3);
    assert_relative_eq!(seen.time_s, 29.0, max_relative = 1e-12);
    assert_relative_eq!(seen.declination_rad.to_degrees(), -9.9, max_relative = 1e-12);
    // The field of view is 20 deg, 10 to either side.
    plant.command(Commands::default(), star(240.0, 10.1));
    plant.advance(&spinner, 90.0).unwrap();
    assert_eq!(plant.sensors.sample.count, 3);
}

#[test]
fn a_pulse_begins_the_estimate_anew() {
    let mut spinner = ace();
    spinner.star_tracker.noise_deg = 0.0;
    let mut start = undamped(1.478);
    start.nutation_rad = 0.05_f64.to_radians();
    let mut plant = launch(&spinner, &start);
    plant.advance(&spinner, 4.0 * 3600.0).unwrap();
    let before = Outputs::from_plant(&plant, &spinner);
    assert_relative_eq!(before.estimate.nutation_rad, before.nutation_rad, max_relative = 0.01);
    plant.command(Commands { fire: 1 << 7, ..Commands::default() }, directions());
    plant.advance(&spinner, 4.0 * 3600.0 + 0.2).unwrap();
    plant.command(Commands::default(), directions());
    plant.advance(&spinner, 4.0 * 3600.0 + 3.0).unwrap();
    assert_eq!(plant.sensors.estimator.count, 0);
    plant.advance(&spinner, 8.0 * 3600.0).unwrap();
    let after = Outputs::from_plant(&plant, &spinner);
    assert!((after.nutation_rad - before.nutation_rad).abs() > 0.2 * before.nutation_rad);
    assert_relative_eq!(after.estimate.nutation_rad, after.nutation_rad, max_relative = 0.01);
}

/// The estimator's own error is the spread of its estimates, also where phases leave most of the turn unseen.
#[test]
fn the_stated_error_is_the_spread_of_estimates() {
    let noise = 1e-4;
    for towards in [0.6_f64, 2.2] {
        let phases: Vec<f64> = (0..12).map(|k| 0.15 * f64::from(k)).collect();
        let (mut squares, mut stated) = (0.0, 0.0);
        let trials = 4000_u32;
        for trial in 0..trials {
            let mut estimator = NutationEstimator::default();
            for (k, phase) in (0_u64..).zip(&phases) {
                let draw = normal(3, Channel::StarTracker, 12 * u64::from(trial) + k);
                estimator.add(*phase, 0.1 + 1e-2 * (phase - towards).cos() + noise * draw);
            }
            let estimate = estimator.estimate(noise);
            squares += (estimate.nutation_rad - 1e-2).powi(2);
            stated += estimate.sigma_rad;
        }
        let spread = (squares / f64::from(trials)).sqrt();
        assert_relative_eq!(stated / f64::from(trials), spread, max_relative = 0.05);
    }
}
