//! Flight between planets by where positions count from: about a planet as about the Sun, and against the disturbed orbit.

use models::MomentumPlant;
use nalgebra::Vector3;
use physics::bodies::Body;
use physics::constants::DAY_S;
use physics::environment::CartesianState;
use physics::environment::ephemeris::Ephemeris;

use super::cruise::{FLYBY_S, sets};
use super::named_model::NamedModel;

/// The planet's acceleration that its frame falls with is the second derivative of its path: the Sun and all others are in it.
#[test]
fn two_hundred_days_counted_from_venus_are_those_counted_from_the_sun() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let (mut ephemeris, start_s) = (Ephemeris::default(), FLYBY_S - 200.0 * DAY_S);
    let start = CartesianState {
        position_m: Vector3::new(7.0e10, 2.0e10, 1.0e10),
        velocity_m_s: Vector3::new(-8.0e3, 4.0e4, 1.2e4),
    };
    let from_sun_m = |center: f64, origins: [CartesianState; 2]| {
        // Downlink throughout, which is the default about the Sun alone.
        let about = [("start.epoch", start_s), ("orbit.center", center), ("guided.phase", 2.0)];
        let sets = [&sets(&(start - origins[0]), true)[..], &about];
        let mut flight = named.initialize(0.0, &sets.concat()).unwrap();
        flight.step_to(200.0 * DAY_S).unwrap();
        flight.vector("position") + origins[1].position_m
    };
    let nowhere = CartesianState { position_m: Vector3::zeros(), velocity_m_s: Vector3::zeros() };
    let venus = [start_s, FLYBY_S].map(|at_s| ephemeris.state(Body::Venus, at_s));
    let [sun_m, venus_m] = [from_sun_m(2.0, [nowhere; 2]), from_sun_m(3.0, venus)];
    let off_m = (venus_m - sun_m).norm();
    println!("{off_m} m apart");
    assert!(off_m < 1.0, "{off_m}");
}

/// Four revolutions about Mercury, flattening and light among what acts: two integrators, two ways to have the Sun's tide.
#[test]
fn an_orbit_about_mercury_between_the_planets_is_the_disturbed_one() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let position_m = |dynamics: f64, more: &[(&'static str, f64)]| {
        let about = [("start.epoch", FLYBY_S), ("orbit.center", 1.0), ("orbit.dynamics", dynamics)];
        let sets = [&about[..], more];
        let mut flight = named.initialize(0.0, &sets.concat()).unwrap();
        flight.step_to(2.0 * DAY_S).unwrap();
        flight.vector("position")
    };
    let relativity = ("orbit.relativity", 1.0);
    let disturbed_m = position_m(2.0, &[]);
    let off_m = (position_m(3.0, &[relativity]) - disturbed_m).norm();
    let round_m = (position_m(3.0, &[relativity, ("planet.j2", 0.0)]) - disturbed_m).norm();
    println!("{off_m} m apart, {round_m} m without flattening");
    assert!(off_m < 5.0 && round_m > 1e5, "{off_m} {round_m}");
}
