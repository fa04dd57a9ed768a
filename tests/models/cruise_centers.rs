//! Flight between planets by where positions count from: about a planet as about the Sun, and against the disturbed orbit.

use models::MomentumPlant;
use nalgebra::Vector3;
use physics::bodies::Body;
use physics::constants::DAY_S;
use physics::environment::CartesianState;
use physics::environment::ephemeris::Ephemeris;

use super::cruise::{FLYBY_S, sets};
use super::named_model::NamedModel;

/// Beyond its sphere a path is integrated about the Sun, wherever positions count from.
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

/// Four revolutions about Mercury under one list, Sun, flattening and light: two integrators, two ways to have the Sun's tide.
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
    let disturbed_m = position_m(2.0, &[]);
    let sun_alone = [
        ("orbit.attraction.venus", 0.0),
        ("orbit.attraction.earth", 0.0),
        ("orbit.attraction.moon", 0.0),
        ("orbit.attraction.mars", 0.0),
        ("orbit.attraction.jupiter", 0.0),
        ("orbit.relativity", 0.0),
    ];
    let off_m = (position_m(3.0, &sun_alone) - disturbed_m).norm();
    let round_m = (position_m(3.0, &[&sun_alone[..], &[("planet.j2", 0.0)]].concat()) - disturbed_m).norm();
    println!("{off_m} m apart, {round_m} m without flattening");
    assert!(off_m < 1e-3 && round_m > 1e5, "{off_m} {round_m}");
}

/// Position, velocity and the position 100 s later, in the plane, by universal variables in 60 digits; 1 - e is 1e-6, 1e-8, 0, -1e-8.
#[rustfmt::skip]
#[allow(clippy::unreadable_literal, reason = "a table")]
const NEAR_PARABOLAS: [[f64; 7]; 4] = [
        [924895.8493919158, -13042344.779671494, 5322.500326802432, 5713.305690585593, 100.0, 1456118.1033426567, -12459075.167236002],
        [924896.2467242477, -13042350.382621562, 5322.499009483432, 5713.309559049022, 100.0, 1456118.369925154, -12459080.39348249],
        [924896.2507377054, -13042350.439217016, 5322.498996177184, 5713.309598124401, 100.0, 1456118.3726179067, -12459080.446272857],
        [924896.254751163, -13042350.495812466, 5322.498982870938, 5713.309637199782, 100.0, 1456118.3753106594, -12459080.499063222],
];

#[test]
fn near_a_parabola_two_body_motion_is_exact() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for [x_m, y_m, vx_m_s, vy_m_s, after_s, then_x_m, then_y_m] in NEAR_PARABOLAS {
        let mut flight = named
            .initialize(
                0.0,
                &[
                    ("orbit.center", 4.0),
                    ("orbit.source", 2.0),
                    ("orbit.position[1]", x_m),
                    ("orbit.position[2]", y_m),
                    ("orbit.velocity[1]", vx_m_s),
                    ("orbit.velocity[2]", vy_m_s),
                ],
            )
            .unwrap();
        flight.step_to(after_s).unwrap();
        let then_m = Vector3::new(then_x_m, then_y_m, 0.0);
        let off = (flight.vector("position") - then_m).norm() / then_m.norm();
        assert!(off < 1e-11, "{off:e} from {x_m} {y_m}");
    }
}
