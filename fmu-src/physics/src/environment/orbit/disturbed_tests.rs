//! An integrated orbit agrees with the closed form where there is one, and drifts as in celestial mechanics.

use core::f64::consts::TAU;

use nalgebra::Vector3;
use proptest::prelude::*;

use super::gravity::tide_m_s2;
use super::*;
use crate::{
    bodies::Body,
    constants::{GM_MERCURY_M3_S2 as MU, GM_SUN_M3_S2, RADIUS_MERCURY_M},
    environment::{CartesianState, kepler_planet::MESSENGER_AS_PRINTED},
};

const SUN: Vector3<f64> = Vector3::new(3.5e10, 4.5e10, 1.0e10);

fn free(_: f64) -> Vector3<f64> {
    Vector3::zeros()
}

/// Sun that stands still at a position from the planet.
#[derive(Clone, Copy)]
struct FixedSun(Vector3<f64>);

impl BodyEphemeris for FixedSun {
    fn heliocentric(&mut self, _: Body, _: f64) -> CartesianState {
        CartesianState { position_m: -self.0, velocity_m_s: Vector3::zeros() }
    }

    fn smooth_until_s(&self, _: f64) -> f64 {
        f64::INFINITY
    }

    fn moon_from_earth_m(&mut self, _: f64) -> Vector3<f64> {
        Vector3::zeros()
    }
}

/// Gravity of a planet alone.
fn alone(gravity: Gravity) -> GravityModel {
    let planet = Attractor::point_mass(Body::Mercury.data()).with_gravity(gravity);
    GravityModel::new(Body::Mercury, [planet], false)
}

/// Gravity of a planet and the tide of the Sun.
fn with_sun(gravity: Gravity) -> GravityModel {
    let planet = Attractor::point_mass(Body::Mercury.data()).with_gravity(gravity);
    GravityModel::new(Body::Mercury, [planet, Attractor::point_mass(Body::Sun.data())], false)
}

/// Simulates until `end_s` at a whole number of segments and returns the state there.
fn simulated(
    elements: Elements,
    segment_length_s: f64,
    end_s: f64,
    model: &GravityModel,
) -> (CartesianState, DisturbedOrbit) {
    let method = OrbitMethod::default();
    let start = elements.state(MU).unwrap();
    let mut orbit = DisturbedOrbit::new(&start, 0.0, segment_length_s, RADIUS_MERCURY_M).unwrap();
    while orbit.end_s() < end_s {
        orbit.advance_to(f64::INFINITY, &method, model, &mut FixedSun(SUN), free).unwrap();
    }
    (orbit.state_at(end_s), orbit)
}

#[test]
fn agrees_with_the_closed_form_between_the_edges_too() {
    let closed = TwoBodyOrbit::from_elements(MESSENGER_AS_PRINTED, MU, 0.0).unwrap();
    let method = OrbitMethod::default();
    for (segment_length_s, stated_m) in [(60.0, 1e-5), (300.0, 1e-4), (600.0, 1.0)] {
        let start = closed.state_at(0.0);
        let mut orbit = DisturbedOrbit::new(&start, 0.0, segment_length_s, RADIUS_MERCURY_M).unwrap();
        let mut worst_m = 0.0_f64;
        while orbit.end_s() < closed.period_s() {
            orbit
                .advance_to(f64::INFINITY, &method, &alone(Gravity::point_mass(MU)), &mut FixedSun(SUN), free)
                .unwrap();
            for i in 0..7 {
                let at_s = orbit.start_s() + segment_length_s * f64::from(i) / 7.0;
                let off_m = (orbit.state_at(at_s).position_m - closed.state_at(at_s).position_m).norm();
                worst_m = worst_m.max(off_m);
            }
        }
        assert!(worst_m < stated_m, "{segment_length_s} s: {worst_m} m");
    }
}

#[test]
fn flattening_turns_node_and_periapsis_at_the_known_rates() {
    // First-order secular rates: node -3/2 J2 (R/p)^2 n cos i, periapsis 3/4 J2 (R/p)^2 n (5 cos^2 i - 1). The body is
    // made as flat as the Earth, its pole along z.
    let flattening = Flattening { j2: 1e-4, reference_radius_m: 2.44e6, pole: Vector3::z() };
    let gravity = Gravity { mu_m3_s2: MU, flattening: Some(flattening) };
    let elements =
        Elements { eccentricity: 0.3, inclination_rad: 0.9, semi_major_axis_m: 6e6, ..MESSENGER_AS_PRINTED };
    let two_body = TwoBodyOrbit::from_elements(elements, MU, 0.0).unwrap();
    // Elements averaged over ten revolutions at the start and, 200 revolutions later, over ten again.
    let method = OrbitMethod::default();
    let mut orbit = DisturbedOrbit::new(&two_body.state_at(0.0), 0.0, 120.0, 1e6).unwrap();
    let mut mean = [[0.0; 2]; 2];
    let (period_s, samples) = (two_body.period_s(), 1000);
    for (window, mean) in mean.iter_mut().enumerate() {
        for i in 0..samples {
            let at_s = period_s * (200.0 * window as f64 + 10.0 * (f64::from(i) + 0.5) / f64::from(samples));
            while orbit.end_s() < at_s {
                orbit.advance_to(f64::INFINITY, &method, &alone(gravity), &mut FixedSun(SUN), free).unwrap();
            }
            let found = Elements::from_state(&orbit.state_at(at_s), MU).unwrap();
            mean[0] += found.ascending_node_rad / f64::from(samples);
            mean[1] += found.periapsis_argument_rad / f64::from(samples);
        }
    }
    let elapsed_s = 200.0 * period_s;
    let factor = 1e-4
        * (2.44e6 / elements.semi_latus_rectum_m()).powi(2)
        * (MU / elements.semi_major_axis_m.powi(3)).sqrt();
    let cos = elements.inclination_rad.cos();
    let expected = [-1.5 * factor * cos, 0.75 * factor * (5.0 * cos * cos - 1.0)];
    for k in 0..2 {
        let rate = (mean[1][k] - mean[0][k]) / elapsed_s;
        assert!((rate / expected[k] - 1.0).abs() < 5e-3, "{k}: {rate:e} {:e}", expected[k]);
    }
}

#[test]
fn flattening_is_the_gradient_of_its_potential() {
    let flattening =
        Flattening { j2: 1e-3, reference_radius_m: 2.44e6, pole: Vector3::new(2.0, -1.0, 2.0) / 3.0 };
    let gravity = Gravity { mu_m3_s2: MU, flattening: Some(flattening) };
    let potential = |r: Vector3<f64>| {
        let (d, s) = (r.norm(), r.dot(&flattening.pole) / r.norm());
        MU / d * (1.0 - 1e-3 * (2.44e6 / d).powi(2) * (3.0 * s * s - 1.0) / 2.0)
    };
    for r in [Vector3::new(3e6, 1e6, -2e6), Vector3::new(-1e6, 4e6, 2e6)] {
        let found = gravity.acceleration_m_s2(&r);
        let gradient = Vector3::from_fn(|i, _| {
            let mut step = Vector3::zeros();
            step[i] = 300.0;
            (8.0 * (potential(r + step) - potential(r - step)) - potential(r + step * 2.0)
                + potential(r - step * 2.0))
                / 3600.0
        });
        assert!((found - gradient).norm() < 1e-9 * found.norm(), "{found} {gradient}");
    }
}

#[test]
fn segments_keep_the_jacobi_like_energy_of_flattening() {
    // Point mass and flattening are conservative, and the momentum along the pole is constant.
    let flattening = Flattening::from_body(Body::Mercury.data());
    let gravity = Gravity { flattening: Some(flattening), ..Gravity::point_mass(MU) };
    let energy = |s: &CartesianState| {
        let (d, sin) = (s.position_m.norm(), s.position_m.normalize().dot(&flattening.pole));
        let j2 = flattening.j2 * (flattening.reference_radius_m / d).powi(2) * (3.0 * sin * sin - 1.0) / 2.0;
        s.velocity_m_s.norm_squared() / 2.0 - MU / d * (1.0 - j2)
    };
    let momentum = |s: &CartesianState| s.position_m.cross(&s.velocity_m_s).dot(&flattening.pole);
    let start = MESSENGER_AS_PRINTED.state(MU).unwrap();
    let (end, _) = simulated(MESSENGER_AS_PRINTED, 300.0, 30.0 * 86_400.0, &alone(gravity));
    assert!((energy(&end) / energy(&start) - 1.0).abs() < 1e-11);
    assert!((momentum(&end) / momentum(&start) - 1.0).abs() < 1e-12);
}

#[test]
fn the_tide_is_the_difference_of_two_pulls() {
    // Far out the plain difference is accurate; close in the tide is the linear field 3 s (s.r) - r over s^3.
    let pull = |d: Vector3<f64>| d * (GM_SUN_M3_S2 / d.norm().powi(3));
    let far = Vector3::new(1e10, -8e9, 5e9);
    let plain = pull(SUN - far) - pull(SUN);
    assert!((tide_m_s2(&far, &SUN, GM_SUN_M3_S2) - plain).norm() < 1e-14 * pull(SUN).norm());
    let close = Vector3::new(300.0, -200.0, 500.0);
    let unit = SUN.normalize();
    let linear = (unit * 3.0 * unit.dot(&close) - close) * (GM_SUN_M3_S2 / SUN.norm().powi(3));
    assert!((tide_m_s2(&close, &SUN, GM_SUN_M3_S2) - linear).norm() < 1e-7 * linear.norm());
}

#[test]
fn a_constant_push_moves_the_orbit_as_it_should() {
    // In free fall without gravity to speak of, a constant acceleration is a parabola.
    let gravity = Gravity::point_mass(1e-3);
    let start = CartesianState {
        position_m: Vector3::new(1e9, 0.0, 0.0),
        velocity_m_s: Vector3::new(0.0, 10.0, 0.0),
    };
    let push = Vector3::new(1e-6, 2e-6, -3e-6);
    let method = OrbitMethod::default();
    let mut orbit = DisturbedOrbit::new(&start, 50.0, 600.0, 0.0).unwrap();
    while orbit.end_s() < 6000.0 {
        orbit.advance_to(f64::INFINITY, &method, &alone(gravity), &mut FixedSun(SUN), |_| push).unwrap();
    }
    let elapsed_s = 5950.0;
    let expected = start.position_m + start.velocity_m_s * elapsed_s + push * (0.5 * elapsed_s * elapsed_s);
    assert!((orbit.state_at(6000.0).position_m - expected).norm() < 1e-6);
    orbit.cut(5700.0, &Vector3::new(0.0, 0.0, 1.0));
    let kicked = orbit.state_at(5700.0).velocity_m_s;
    assert!((kicked - (start.velocity_m_s + push * 5650.0 + Vector3::z())).norm() < 1e-12);
    orbit.advance_to(f64::INFINITY, &method, &alone(gravity), &mut FixedSun(SUN), |_| push).unwrap();
    assert_eq!((orbit.start_s(), orbit.end_s()), (5700.0, 6000.0));
}

#[test]
fn halving_the_segment_changes_nothing_that_matters() {
    let (coarse, _) = simulated(
        MESSENGER_AS_PRINTED,
        300.0,
        864_000.0,
        &with_sun(Gravity::from_body(Body::Mercury.data())),
    );
    let (fine, orbit) = simulated(
        MESSENGER_AS_PRINTED,
        150.0,
        864_000.0,
        &with_sun(Gravity::from_body(Body::Mercury.data())),
    );
    assert!((coarse.position_m - fine.position_m).norm() < 0.02);
    // The disturbances are no more than they should be: the undisturbed spacecraft is some tens of kilometres away.
    let plain = TwoBodyOrbit::from_elements(MESSENGER_AS_PRINTED, MU, 0.0).unwrap().state_at(864_000.0);
    let apart_m = (plain.position_m - fine.position_m).norm();
    assert!((1e3..1e6).contains(&apart_m), "{apart_m}");
    let text = toml::to_string(&orbit).unwrap();
    assert_eq!(toml::from_str::<DisturbedOrbit>(&text).unwrap(), orbit);
}

#[test]
fn impact_and_bad_starts_are_named() {
    let falling =
        Elements { semi_major_axis_m: 5e6, eccentricity: 0.6, true_anomaly_rad: 3.0, ..MESSENGER_AS_PRINTED };
    let start = falling.state(MU).unwrap();
    let mut orbit = DisturbedOrbit::new(&start, 0.0, 60.0, RADIUS_MERCURY_M).unwrap();
    let method = OrbitMethod::default();
    let error = loop {
        if let Err(error) = orbit.advance_to(
            f64::INFINITY,
            &method,
            &alone(Gravity::point_mass(MU)),
            &mut FixedSun(SUN),
            free,
        ) {
            break error;
        }
    };
    assert!(error.to_string().contains("inside the planet of radius 2439400 m"), "{error}");
    // The orbit still stands where it was, above the surface.
    assert!(orbit.state_at(orbit.end_s()).position_m.norm() > RADIUS_MERCURY_M);
    let say = |state: &CartesianState, segment_length_s| {
        DisturbedOrbit::new(state, 0.0, segment_length_s, 2e6).unwrap_err().to_string()
    };
    assert!(say(&CartesianState::default(), 60.0).contains("inside the planet"));
    assert!(say(&start, 0.0).contains("segment length in s is 0"));
    let lost = CartesianState { position_m: Vector3::new(f64::NAN, 0.0, 0.0), ..start };
    assert!(say(&lost, 60.0).contains("position or velocity is NaN"));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn asking_often_changes_no_bit(at in prop::collection::vec(0.0..5000.0f64, 1..20)) {
        let (expected, _) = simulated(MESSENGER_AS_PRINTED, 60.0, 5000.0, &with_sun(Gravity::from_body(Body::Mercury.data())));
        let method = OrbitMethod::default();
        let mut at = at;
        at.sort_by(f64::total_cmp);
        at.push(5000.0);
        let start = MESSENGER_AS_PRINTED.state(MU).unwrap();
        let mut orbit = DisturbedOrbit::new(&start, 0.0, 60.0, RADIUS_MERCURY_M).unwrap();
        for at_s in at {
            while orbit.end_s() < at_s {
                orbit.advance_to(f64::INFINITY, &method, &with_sun(Gravity::from_body(Body::Mercury.data())), &mut FixedSun(SUN), free).unwrap();
            }
            orbit.state_at(at_s);
        }
        prop_assert_eq!(orbit.state_at(5000.0), expected);
    }

    #[test]
    fn rotating_everything_rotates_the_orbit(angle in 0.0..TAU) {
        let turn = nalgebra::Rotation3::from_axis_angle(&Vector3::y_axis(), angle);
        let turned_gravity = |g: Gravity| Gravity {
            flattening: g.flattening.map(|f| Flattening { pole: turn * f.pole, ..f }),
            ..g
        };
        let start = MESSENGER_AS_PRINTED.state(MU).unwrap();
        let turned = CartesianState { position_m: turn * start.position_m, velocity_m_s: turn * start.velocity_m_s };
        let method = OrbitMethod::default();
        let end = |start: &CartesianState, gravity: &Gravity, sun: Vector3<f64>| {
            let mut orbit = DisturbedOrbit::new(start, 0.0, 120.0, RADIUS_MERCURY_M).unwrap();
            for _ in 0..60 {
                orbit.advance_to(f64::INFINITY, &method, &with_sun(*gravity), &mut FixedSun(sun), free).unwrap();
            }
            orbit.state_at(7200.0).position_m
        };
        let plain = end(&start, &Gravity::from_body(Body::Mercury.data()), SUN);
        let other = end(&turned, &turned_gravity(Gravity::from_body(Body::Mercury.data())), turn * SUN);
        prop_assert!((turn * plain - other).norm() < 1e-5);
    }
}
