//! Conserved momentum, and the momentum of the guided flight.

use client::short_or_long;

use super::super::named_model::{NamedModel, assert_cuts_change_nothing};
use super::{CONTROLLED, DARK, FREE, GUIDANCE, Start, formed_momentum, inertia, initialize, with};
use models::MomentumPlant;
use nalgebra::Vector3;

const SPINNING: Start<'_> = &[
    ("start.rate[1]", 1e-3),
    ("start.rate[2]", -2e-3),
    ("start.rate[3]", 1.5e-3),
    ("wheel[1].startMomentum", 2.0),
    ("wheel[2].startMomentum", -1.0),
    ("wheel[4].startMomentum", 0.5),
];

#[test]
fn momentum_is_conserved_in_controlled_flight() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = initialize(&named, &[CONTROLLED, DARK, SPINNING]);
    let start = flight.vector("momentum.inertial");
    assert!(start.norm() > 1.0);
    let mut worst = 0.0_f64;
    for minute in 1..=short_or_long(120, 1440) {
        flight.step_to(60.0 * f64::from(minute)).unwrap();
        let [formed, reported] = [formed_momentum(&flight), flight.vector("momentum.inertial")];
        worst = worst.max((formed - reported).norm()).max((reported - start).norm());
    }
    assert!(worst < 1e-12 * start.norm(), "{worst:e}");
    // It holds its attitude: the wheels have what the body had.
    assert!(flight.vector("attitude.rate").norm() < 1e-9, "{}", flight.vector("attitude.rate"));
}

#[test]
fn energy_is_kept_with_locked_wheels() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let locked = [1, 2, 3, 4].map(|k| format!("wheel[{k}].locked"));
    let locked: Vec<(&str, f64)> = locked.iter().map(|name| (name.as_str(), 1.0)).collect();
    let mut flight = initialize(&named, &[FREE, DARK, &SPINNING[..3], &locked]);
    let energy = |rate: Vector3<f64>| 0.5 * rate.dot(&(inertia() * rate));
    let start = energy(flight.vector("attitude.rate"));
    flight.simulate_to(short_or_long(7_200.0, 86_400.0), 600.0).unwrap();
    let now = energy(flight.vector("attitude.rate"));
    assert!((now / start - 1.0).abs() < 1e-10, "{:e}", now / start - 1.0);
}

#[test]
fn days_of_control_add_up_to_what_guided_flight_does() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let slewing: Start<'_> = &[("guided.slewRate", 2e-3), ("control.rate", 10.0)];
    let mut controlled = initialize(&named, &[CONTROLLED, GUIDANCE, slewing]);
    let h = controlled.vector("momentum.body");
    let start = [("start.momentum[1]", h.x), ("start.momentum[2]", h.y), ("start.momentum[3]", h.z)];
    let mut guided = initialize(&named, &[slewing, &start]);
    let (mut largest, mut worst) = (0.0_f64, 0.0_f64);
    for step in 1..=short_or_long(120, 960) {
        let time_s = 360.0 * f64::from(step);
        controlled.step_to(time_s).unwrap();
        guided.step_to(time_s).unwrap();
        let [a, b] = [&controlled, &guided].map(|flight| flight.vector("momentum.inertial"));
        largest = largest.max(b.norm());
        worst = worst.max((a - b).norm());
    }
    println!("{worst} of {largest}");
    assert!(worst < 0.01 * largest, "{worst} of {largest}");
}

#[test]
fn how_the_flight_is_cut_changes_no_bit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let noisy: Start<'_> = &[
        ("starTracker.noise[1]", 1e-5),
        ("starTracker.noise[2]", 2e-5),
        ("starTracker.noise[3]", 1e-5),
        ("gyro.noise", 1e-6),
        ("gyro.drift", 1e-8),
        ("sunSensor[4].noise", 1e-3),
        ("wheel[1].coulombFriction", 1e-3),
        ("wheel[2].viscousFriction", 1e-5),
        ("planetLight.enabled", 1.0),
        ("thermal.enabled", 1.0),
    ];
    let start = with(&[CONTROLLED, GUIDANCE, noisy, SPINNING]);
    let ends_s = [0.0, 0.017, 5.5, 33.333, 120.0];
    let initialize = || named.initialize(-0.3, &start).unwrap();
    assert_cuts_change_nothing(initialize, ends_s, &[1.1, 0.02, 0.013, 1.0, 7.0], |_| {});
}

#[test]
fn disturbances_taken_once_a_second_add_up_to_those_of_a_tenth() {
    // Light, planet light and recoil on an orbit at low altitude, through slews and eclipses.
    let named = NamedModel::<MomentumPlant>::shipped();
    let lit: Start<'_> = &[
        ("planetLight.enabled", 1.0),
        ("thermal.enabled", 1.0),
        ("guided.slewRate", 5e-3),
        ("guided.downlinkStart", 600.0),
        ("guided.downlinkEnd", 1_200.0),
        ("guided.downlinkEvery", 1.0),
    ];
    let simulate = |step_s: f64| {
        let mut flight = initialize(&named, &[CONTROLLED, GUIDANCE, lit, &[("solver.dynamicsStep", step_s)]]);
        let mut history = Vec::new();
        for minute in 1..=short_or_long(21, 30) {
            flight.step_to(60.0 * f64::from(minute)).unwrap();
            history.push(["momentum.inertial", "deltaV"].map(|name| flight.vector(name)));
        }
        history
    };
    let (coarse, fine) = (simulate(1.0), simulate(0.1));
    let largest = |of: fn(&[Vector3<f64>; 2]) -> Vector3<f64>| {
        let size = fine.iter().map(|it| of(it).norm()).fold(0.0, f64::max);
        let off = coarse.iter().zip(&fine).map(|(a, b)| (of(a) - of(b)).norm()).fold(0.0, f64::max);
        off / size
    };
    let (momentum, delta_v) = (largest(|it| it[0]), largest(|it| it[1]));
    println!("{momentum:e} {delta_v:e}");
    assert!(momentum < 2e-6 && delta_v < 2e-7, "{momentum:e} {delta_v:e}");
}

#[test]
fn a_force_moves_a_disturbed_orbit_as_it_does_in_commanded_flight() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let disturbed: Start<'_> =
        &[("orbit.dynamics", 2.0), ("gravityGradient.enabled", 0.0), ("solar.flux", 0.0)];
    let simulate = |source: Start<'_>| {
        let mut flight = initialize(&named, &[disturbed, source]);
        for (until_s, force_n) in [(300.0, 2.0), (723.0, -1.0), (1_800.0, 0.0)] {
            flight.set("force.applied[1]", force_n);
            flight.set("force.applied[3]", 0.5 * force_n);
            flight.simulate_to(until_s, 30.0).unwrap();
        }
        flight.vector("position")
    };
    let (free, commanded, quiet) = (simulate(FREE), simulate(&[("attitude.source", 2.0)]), {
        let mut flight = initialize(&named, &[disturbed]);
        flight.simulate_to(1_800.0, 30.0).unwrap();
        flight.vector("position")
    });
    let moved = (free - quiet).norm();
    assert!(moved > 100.0, "{moved}");
    // Commanded flight integrates segments of minutes, free flight of a second.
    assert!((free - commanded).norm() < 1e-5 * moved, "{} of {moved}", (free - commanded).norm());
}
