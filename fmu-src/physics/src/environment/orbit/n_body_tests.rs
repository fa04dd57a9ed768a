//! Between bodies a path is what an independent integrator makes of it, about whatever body it is integrated.

use nalgebra::{Rotation3, SVector, Vector3};

use super::disturbed::{DisturbedOrbit, OrbitIntegrationError};
use super::elements::Elements;
use super::gravity_model::{Attractor, BodyEphemeris, GravityModel};
use super::n_body::{NBodyGravity, NBodySettings};
use super::orbit_method::OrbitMethod;
use super::spheres::Collision;
use super::two_body::TwoBodyOrbit;
use crate::bodies::{Body, BodyData};
use crate::constants::{DAY_S, GM_MERCURY_M3_S2, GM_MOON_M3_S2, GM_SUN_M3_S2, RADIUS_MERCURY_M};
use crate::environment::CartesianState;
use crate::environment::ephemeris::Ephemeris;

/// 2008-10-06 08:40, the second flyby of Mercury.
const FLYBY_S: f64 = 276_554_400.0;

/// The planets of an ephemeris, by a clock that begins at an epoch; one body may move on a conic instead.
struct Sky {
    ephemeris: Ephemeris,
    epoch_s: f64,
    conic: Option<(Body, TwoBodyOrbit)>,
}

impl Sky {
    fn at(epoch_s: f64) -> Self {
        Self { ephemeris: Ephemeris::default(), epoch_s, conic: None }
    }

    /// Mercury moves by the Sun and its own mass, as the list of both has it.
    fn of_two_bodies(epoch_s: f64) -> Self {
        let mut sky = Self::at(epoch_s);
        let mu_m3_s2 = GM_SUN_M3_S2 + GM_MERCURY_M3_S2;
        let orbit = TwoBodyOrbit::from_state(&sky.heliocentric(Body::Mercury, 0.0), mu_m3_s2, 0.0);
        sky.conic = Some((Body::Mercury, orbit.unwrap()));
        sky
    }
}

impl BodyEphemeris for Sky {
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState {
        match self.conic.filter(|(on_it, _)| *on_it == body) {
            Some((_, orbit)) => orbit.state_at(at_s),
            None => self.ephemeris.state(body, self.epoch_s + at_s),
        }
    }

    fn smooth_until_s(&self, at_s: f64) -> f64 {
        Ephemeris::smooth_until_s(self.epoch_s + at_s) - self.epoch_s
    }

    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64> {
        self.ephemeris.moon_from_earth(self.epoch_s + at_s).position_m
    }
}

fn settings() -> NBodySettings {
    NBodySettings { changes_center: true, cell_s: DAY_S, tolerance_m: 1e-3 }
}

fn gravity(settings: NBodySettings, center: Body, attracting: &[Body]) -> NBodyGravity {
    NBodyGravity::new(settings, model(center, attracting, false))
}

/// The Sun, a centre and other bodies as point masses.
fn model(center: Body, attracting: &[Body], relativity: bool) -> GravityModel {
    let bodies = attracting.iter().copied().chain([Body::Sun, center]);
    GravityModel::new(center, bodies.map(|body| Attractor::point_mass(body.data())), relativity)
}

/// Propagates to a time and gives the state there.
fn propagated(
    orbit: &mut DisturbedOrbit,
    gravity: &NBodyGravity,
    sky: &mut Sky,
    to_s: f64,
) -> CartesianState {
    let method = OrbitMethod::default();
    while orbit.end_s() < to_s {
        orbit.advance_between_bodies(f64::INFINITY, &method, gravity, sky, |_| Vector3::zeros()).unwrap();
    }
    orbit.state_at(to_s)
}

/// Modified midpoint with extrapolation (Gragg, Bulirsch, Stoer) over steps as short as their own error requires: another
/// method than collocation, with equations from the Sun alone, in which planets are read and nothing else.
fn independent(
    mut y: SVector<f64, 6>,
    [mut at_s, to_s]: [f64; 2],
    mut acceleration: impl FnMut(f64, &SVector<f64, 6>) -> Vector3<f64>,
) -> SVector<f64, 6> {
    const COLUMNS: usize = 8;
    let mut rate = |at_s: f64, y: &SVector<f64, 6>| {
        let a = acceleration(at_s, y);
        SVector::from([y[3], y[4], y[5], a.x, a.y, a.z])
    };
    let mut step_s = (to_s - at_s).signum() * 3600.0;
    while at_s != to_s {
        let whole_s = if (to_s - at_s).abs() <= step_s.abs() { to_s - at_s } else { step_s };
        let mut table: Vec<SVector<f64, 6>> = Vec::new();
        let mut error_m = f64::INFINITY;
        for column in 0..COLUMNS {
            let count = 2 * (column + 1);
            let h = whole_s / count as f64;
            let (mut before, mut now) = (y, y + rate(at_s, &y) * h);
            for k in 1..count {
                let next = before + rate(at_s + h * k as f64, &now) * (2.0 * h);
                (before, now) = (now, next);
            }
            let smooth = (now + before + rate(at_s + whole_s, &now) * h) * 0.5;
            let mut row = vec![smooth];
            for back in 1..=column {
                let ratio = (count as f64 / (2 * (column + 1 - back)) as f64).powi(2);
                row.push(row[back - 1] + (row[back - 1] - table[back - 1]) / (ratio - 1.0));
            }
            if column > 0 {
                error_m = (row[column] - row[column - 1]).fixed_rows::<3>(0).norm();
            }
            table = row;
        }
        let last = table[COLUMNS - 1];
        let allowed_m = 1e-7_f64.max(1e-15 * y.fixed_rows::<3>(0).norm());
        if error_m > allowed_m {
            step_s = 0.5 * whole_s;
        } else {
            (at_s, y) = (if whole_s == to_s - at_s { to_s } else { at_s + whole_s }, last);
            step_s = if error_m < 1e-3 * allowed_m { 1.5 * whole_s } else { whole_s };
        }
    }
    y
}

fn packed(state: &CartesianState) -> SVector<f64, 6> {
    SVector::from_fn(|i, _| if i < 3 { state.position_m[i] } else { state.velocity_m_s[i - 3] })
}

/// Acceleration from the Sun by Newton's law, typed a second time.
fn newton(sky: &mut Sky, bodies: &[Body], at_s: f64, y: &SVector<f64, 6>) -> Vector3<f64> {
    let r = Vector3::new(y[0], y[1], y[2]);
    let mut sum = -r * GM_SUN_M3_S2 / r.norm().powi(3);
    for body in bodies {
        let gm = body.data().gm_m3_s2;
        let p = sky.heliocentric(*body, at_s).position_m;
        sum += (p - r) * gm / (p - r).norm().powi(3) - p * gm / p.norm().powi(3);
    }
    sum
}

/// Half-way between Venus and Mercury, some 0.5 AU from the Sun.
fn cruise() -> CartesianState {
    CartesianState {
        position_m: Vector3::new(7.0e10, 2.0e10, 1.0e10),
        velocity_m_s: Vector3::new(-8.0e3, 4.0e4, 1.2e4),
    }
}

#[test]
fn two_bodies_keep_energy_and_angular_momentum() {
    let gravity = gravity(settings(), Body::Sun, &[]);
    let (mut sky, start) = (Sky::at(FLYBY_S), cruise());
    let mut orbit = DisturbedOrbit::between_bodies(&start, 0.0, &gravity).unwrap();
    let energy =
        |s: &CartesianState| s.velocity_m_s.norm_squared() / 2.0 - GM_SUN_M3_S2 / s.position_m.norm();
    let momentum = |s: &CartesianState| s.position_m.cross(&s.velocity_m_s);
    for day in 1..=200 {
        let state = propagated(&mut orbit, &gravity, &mut sky, f64::from(day) * DAY_S);
        assert!((energy(&state) / energy(&start) - 1.0).abs() < 1e-12, "{day}");
        let moved = (momentum(&state) - momentum(&start)).norm() / momentum(&start).norm();
        assert!(moved < 1e-12, "{day}: {moved}");
    }
}

#[test]
fn two_hundred_days_are_those_of_an_independent_integrator() {
    let bodies = [Body::Mercury, Body::Venus, Body::Earth, Body::Mars, Body::Jupiter];
    for attracting in [&bodies[..1], &bodies[..]] {
        let gravity = gravity(settings(), Body::Sun, attracting);
        let mut sky = Sky::at(FLYBY_S - 200.0 * DAY_S);
        let mut orbit = DisturbedOrbit::between_bodies(&cruise(), 0.0, &gravity).unwrap();
        let found = propagated(&mut orbit, &gravity, &mut sky, 200.0 * DAY_S);
        let expected = independent(packed(&cruise()), [0.0, 200.0 * DAY_S], |at_s, y| {
            newton(&mut sky, attracting, at_s, y)
        });
        let off_m = (packed(&found) - expected).fixed_rows::<3>(0).norm();
        assert!(off_m < 1.0, "{attracting:?}: {off_m} m");
        // The planets count: without them it is elsewhere.
        let alone =
            independent(packed(&cruise()), [0.0, 200.0 * DAY_S], |at_s, y| newton(&mut sky, &[], at_s, y));
        assert!((alone - expected).fixed_rows::<3>(0).norm() > 1e4);
    }
}

/// On the way to Mercury: periapsis at 200 km, 5.2 km/s far from it, 10 d before periapsis, from the Sun.
fn before_flyby(sky: &mut Sky, bodies: &[Body], radius_m: f64) -> CartesianState {
    let periapsis_s = 10.0 * DAY_S;
    let speed_m_s = (5.2e3_f64.powi(2) + 2.0 * GM_MERCURY_M3_S2 / radius_m).sqrt();
    let mercury = sky.heliocentric(Body::Mercury, periapsis_s);
    let normal = mercury.position_m.cross(&mercury.velocity_m_s).normalize();
    let across = mercury.velocity_m_s.normalize();
    let toward = across.cross(&normal);
    let state = CartesianState {
        position_m: mercury.position_m + across * radius_m,
        velocity_m_s: mercury.velocity_m_s + toward * speed_m_s,
    };
    let y = independent(packed(&state), [periapsis_s, 0.0], |at_s, y| newton(sky, bodies, at_s, y));
    CartesianState {
        position_m: Vector3::new(y[0], y[1], y[2]),
        velocity_m_s: Vector3::new(y[3], y[4], y[5]),
    }
}

#[test]
fn a_flyby_is_the_same_about_the_sun_and_about_the_planet() {
    let bodies = [Body::Mercury];
    let mut sky = Sky::of_two_bodies(FLYBY_S - 10.0 * DAY_S);
    let start = before_flyby(&mut sky, &bodies, RADIUS_MERCURY_M + 2e5);
    let [changing, staying] = [true, false]
        .map(|changes_center| gravity(NBodySettings { changes_center, ..settings() }, Body::Sun, &bodies));
    let (mut centers, mut lowest_m) = (Vec::new(), f64::INFINITY);
    let mut orbit = DisturbedOrbit::between_bodies(&start, 0.0, &changing).unwrap();
    let mut time_s = 0.0;
    let end_s = 13.0 * DAY_S;
    while time_s < end_s {
        time_s += 120.0;
        let state = propagated(&mut orbit, &changing, &mut sky, time_s);
        let mercury = sky.heliocentric(Body::Mercury, time_s);
        lowest_m = lowest_m.min((state - mercury).position_m.norm() - RADIUS_MERCURY_M);
        let center = orbit.integration_center().unwrap();
        if centers.last().is_none_or(|(last, _)| *last != center) {
            centers.push((center, (state - mercury).position_m.norm()));
        }
    }
    assert!((lowest_m - 2e5).abs() < 3e4, "{lowest_m}");
    let order: Vec<Body> = centers.iter().map(|(body, _)| *body).collect();
    assert_eq!(order, [Body::Sun, Body::Mercury, Body::Sun]);
    // 0.3871 AU (m / M)^(2/5), to where one looks after it.
    for (_, distance_m) in &centers[1..] {
        assert!((distance_m - 1.124e8).abs() < 1e6, "{distance_m}");
    }
    let mut alone = DisturbedOrbit::between_bodies(&start, 0.0, &staying).unwrap();
    let other = propagated(&mut alone, &staying, &mut sky, end_s);
    assert_eq!(alone.integration_center(), Some(Body::Sun));
    let found = orbit.state_at(end_s);
    let apart_m = (found - other).position_m.norm();
    assert!(apart_m < 1.0, "{apart_m} m");
    let expected = independent(packed(&start), [0.0, end_s], |at_s, y| newton(&mut sky, &bodies, at_s, y));
    let off_m = (packed(&found) - expected).fixed_rows::<3>(0).norm();
    assert!(off_m < 5.0, "{off_m} m");
}

#[test]
fn a_segment_that_ends_next_to_an_edge_goes_over_it() {
    let bodies = [Body::Mercury];
    let mut sky = Sky::at(FLYBY_S - 10.0 * DAY_S);
    let start = before_flyby(&mut sky, &bodies, RADIUS_MERCURY_M + 2e5);
    let gravity = gravity(settings(), Body::Sun, &bodies);
    let method = OrbitMethod::default();
    let mut advance = |orbit: &mut DisturbedOrbit, limit_s: f64| {
        orbit.advance_between_bodies(limit_s, &method, &gravity, &mut sky, |_| Vector3::zeros()).unwrap();
        orbit.integration_center().unwrap()
    };
    let mut orbit = DisturbedOrbit::between_bodies(&start, 0.0, &gravity).unwrap();
    for other in [Body::Mercury, Body::Sun] {
        let mut before = orbit;
        while orbit.integration_center() != Some(other) {
            before = orbit;
            advance(&mut orbit, f64::INFINITY);
        }
        let edge_s = orbit.start_s();
        // The last segment before it again, to its very edge and a millimetre before and behind it.
        let mut last = before;
        while last.end_s() < edge_s {
            before = last;
            advance(&mut last, edge_s);
        }
        for off_s in [-2e-7, 0.0, 2e-7] {
            let mut cut = before;
            advance(&mut cut, edge_s + off_s);
            assert!((cut.end_s() - edge_s).abs() < 3e-7, "{}", cut.end_s() - edge_s);
            assert_eq!(advance(&mut cut, f64::INFINITY), other, "{off_s}");
        }
    }
}

#[test]
fn positions_count_from_the_given_body_whatever_the_path_is_integrated_about() {
    // The same path given from Mercury, beyond whose sphere it begins, and from the Sun.
    let bodies = [Body::Mercury];
    let mut sky = Sky::of_two_bodies(FLYBY_S - 10.0 * DAY_S);
    let start = before_flyby(&mut sky, &bodies, RADIUS_MERCURY_M + 2e5);
    let from_sun = gravity(settings(), Body::Sun, &bodies);
    let from_mercury = gravity(settings(), Body::Mercury, &bodies);
    let mut one = DisturbedOrbit::between_bodies(&start, 0.0, &from_sun).unwrap();
    let from = start - sky.heliocentric(Body::Mercury, 0.0);
    let mut other = DisturbedOrbit::between_bodies(&from, 0.0, &from_mercury).unwrap();
    for hour in 1..300 {
        let time_s = f64::from(hour) * 3600.0;
        let expected =
            propagated(&mut one, &from_sun, &mut sky, time_s) - sky.heliocentric(Body::Mercury, time_s);
        let found = propagated(&mut other, &from_mercury, &mut sky, time_s);
        assert_eq!(one.integration_center(), other.integration_center());
        // An epoch resolves 6e-8 s, in which Mercury moves by 3 mm. Once the planet has turned it, what the start is rounded by
        // grows.
        let within_m = if hour < 239 { 1e-2 } else { 1.0 };
        let apart_m = (found - expected).position_m.norm();
        assert!(apart_m < within_m, "{hour}: {apart_m} m");
    }
}

/// Attracting bodies, and the body that the spacecraft orbits.
struct Case {
    center: BodyData,
    planets: Vec<Body>,
    moon: bool,
    relativity: bool,
    start: CartesianState,
}

impl Case {
    fn gravity(&self, changes_center: bool) -> NBodyGravity {
        let settings = NBodySettings { changes_center, ..settings() };
        let bodies = self.planets.iter().map(|body| *body.data()).chain([*Body::Sun.data(), self.center]);
        let rows =
            bodies.map(|data| Attractor::point_mass(&data)).chain(self.moon.then_some(Attractor::MOON));
        NBodyGravity::new(settings, GravityModel::new(self.center.body, rows, self.relativity))
    }

    /// Acceleration from the centre by Newton's law, typed a second time: what the list does to the spacecraft less what it does to the
    /// centre.
    fn relative(&self, sky: &mut Sky, at_s: f64, y: &SVector<f64, 6>) -> Vector3<f64> {
        let [s, v] = [0, 3].map(|at| Vector3::new(y[at], y[at + 1], y[at + 2]));
        let c = sky.heliocentric(self.center.body, at_s);
        let mut others = vec![(-c.position_m, GM_SUN_M3_S2)];
        for body in self.planets.iter().filter(|body| **body != self.center.body) {
            let p = sky.heliocentric(*body, at_s).position_m;
            others.push((p - c.position_m, body.data().gm_m3_s2));
        }
        if self.moon {
            let earth = sky.heliocentric(Body::Earth, at_s).position_m;
            others.push((earth + sky.moon_from_earth_m(at_s) - c.position_m, GM_MOON_M3_S2));
        }
        let mut sum = -s * self.center.gm_m3_s2 / s.norm().powi(3);
        for (p, gm) in others {
            sum += ((p - s) / (p - s).norm().powi(3) - p / p.norm().powi(3)) * gm;
        }
        if self.relativity {
            let schwarzschild = |r: Vector3<f64>, v: Vector3<f64>| {
                let c2 = 299_792_458.0_f64.powi(2);
                let turned = r * (4.0 * GM_SUN_M3_S2 / r.norm() - v.dot(&v)) + v * (4.0 * r.dot(&v));
                turned * GM_SUN_M3_S2 / (c2 * r.norm().powi(3))
            };
            sum += schwarzschild(c.position_m + s, c.velocity_m_s + v)
                - schwarzschild(c.position_m, c.velocity_m_s);
        }
        sum
    }
}

/// An orbit of the file's own body, on an ellipse that nothing but the Sun disturbs, as large as Bennu.
fn bennu() -> (BodyData, TwoBodyOrbit) {
    let data = BodyData { gm_m3_s2: 4.892, radius_m: 245.0, ..*Body::Custom.data() };
    let elements = Elements {
        semi_major_axis_m: 1.6842e11,
        eccentricity: 0.2037,
        true_anomaly_rad: 0.7,
        ..Elements::circle(0.0, 0.1055)
    };
    (data, TwoBodyOrbit::from_elements(elements, GM_SUN_M3_S2, 0.0).unwrap())
}

#[test]
fn with_any_body_off_it_is_a_flight_under_the_list_alone() {
    let planets = [Body::Mercury, Body::Venus, Body::Earth, Body::Mars, Body::Jupiter];
    let (bennu, ellipse) = bennu();
    let [earth, mercury] = [*Body::Earth.data(), *Body::Mercury.data()];
    // What is off: a planet by its index, the Moon (5), relativity (6), all (7), nothing (8).
    for (center, radius_m, cases) in [
        (earth, 7e6, vec![5]),
        (earth, 4.2164e7, vec![5, 7]),
        (mercury, 4e6, vec![1, 6]),
        (bennu, 1.5e3, vec![1, 7, 8]),
        (earth, 1.5e9, vec![5, 8]),
    ] {
        for off in cases {
            let on = |index: usize| index != off && off != 7;
            let kept = (0..5).filter(|index| on(*index)).map(|index| planets[index]);
            let own = [center.body].into_iter().filter(|body| *body != Body::Custom);
            let planets = kept.filter(|body| *body != center.body).chain(own);
            let mut start = CartesianState::on_circle(radius_m, center.gm_m3_s2);
            start = start.along(&Rotation3::from_euler_angles(0.9, 0.2, 0.4).into_inner());
            let case = Case { center, planets: planets.collect(), moon: on(5), relativity: on(6), start };
            let mut sky = Sky::at(FLYBY_S);
            if center.body == Body::Custom {
                sky.conic = Some((Body::Custom, ellipse));
            }
            let gravity = case.gravity(radius_m < 1e9);
            let mut orbit = DisturbedOrbit::between_bodies(&case.start, 0.0, &gravity).unwrap();
            let end_s = 10.0 * DAY_S;
            let found = propagated(&mut orbit, &gravity, &mut sky, end_s);
            let expected =
                independent(packed(&case.start), [0.0, end_s], |at_s, y| case.relative(&mut sky, at_s, y));
            let off_m = (packed(&found) - expected).fixed_rows::<3>(0).norm();
            assert!(off_m < 1.0, "{} at {radius_m:e} m without {off}: {off_m} m", center.name);
        }
    }
}

#[test]
fn relativity_turns_an_ellipse_as_einstein_says() {
    let (a, e) = (5.790_905e10, 0.205_63);
    let start = CartesianState {
        position_m: Vector3::x() * (a * (1.0 - e)),
        velocity_m_s: Vector3::y() * (GM_SUN_M3_S2 / a * (1.0 + e) / (1.0 - e)).sqrt(),
    };
    let gravity = NBodyGravity::new(settings(), model(Body::Sun, &[], true));
    let (mut sky, days) = (Sky::at(0.0), 880.0);
    let mut orbit = DisturbedOrbit::between_bodies(&start, 0.0, &gravity).unwrap();
    let state = propagated(&mut orbit, &gravity, &mut sky, days * DAY_S);
    let (r, v) = (state.position_m, state.velocity_m_s);
    let toward = v.cross(&r.cross(&v)) / GM_SUN_M3_S2 - r.normalize();
    let turned_arcsec = toward.y.atan2(toward.x).to_degrees() * 3600.0;
    // 42.98 arc seconds a century.
    let expected_arcsec = 42.98 * days / 36_525.0;
    assert!((turned_arcsec / expected_arcsec - 1.0).abs() < 0.02, "{turned_arcsec} {expected_arcsec}");
}

#[test]
fn bodies_in_the_way_are_named() {
    let bodies = [Body::Mercury];
    let mut sky = Sky::at(FLYBY_S - 10.0 * DAY_S);
    for changes_center in [true, false] {
        let gravity = gravity(NBodySettings { changes_center, ..settings() }, Body::Sun, &bodies);
        let start = before_flyby(&mut sky, &bodies, RADIUS_MERCURY_M - 1e5);
        let mut orbit = DisturbedOrbit::between_bodies(&start, 0.0, &gravity).unwrap();
        let method = OrbitMethod::default();
        let error = loop {
            let no_light = |_: f64| Vector3::zeros();
            match orbit.advance_between_bodies(f64::INFINITY, &method, &gravity, &mut sky, no_light) {
                Ok(_) => assert!(orbit.end_s() < 11.0 * DAY_S),
                Err(error) => break error,
            }
        };
        let OrbitIntegrationError::Collision(Collision::Impact { at_s, name, speed_m_s, .. }) = error else {
            panic!("{error}");
        };
        // At the surface: vis viva.
        let expected_m_s = (5.2e3_f64.powi(2) + 2.0 * GM_MERCURY_M3_S2 / RADIUS_MERCURY_M).sqrt();
        assert_eq!(name, "Mercury");
        assert!((speed_m_s / expected_m_s - 1.0).abs() < 1e-3, "{speed_m_s}");
        assert!((0.0..600.0).contains(&(10.0 * DAY_S - at_s)), "{at_s}");
    }
    let gravity = gravity(settings(), Body::Sun, &bodies);
    let mercury = sky.heliocentric(Body::Mercury, 0.0);
    let inside = CartesianState { position_m: mercury.position_m + Vector3::x() * 1e6, ..mercury };
    let mut orbit = DisturbedOrbit::between_bodies(&inside, 0.0, &gravity).unwrap();
    let error = orbit
        .advance_between_bodies(DAY_S, &OrbitMethod::default(), &gravity, &mut sky, |_| Vector3::zeros())
        .unwrap_err();
    assert!(error.to_string().contains("centre of Mercury, allowed is more than its radius"), "{error}");
}

#[test]
fn a_restored_path_goes_on_to_the_bit() {
    let bodies = [Body::Mercury, Body::Venus];
    let mut sky = Sky::at(FLYBY_S - 10.0 * DAY_S);
    let start = before_flyby(&mut sky, &bodies, RADIUS_MERCURY_M + 2e5);
    let gravity = gravity(settings(), Body::Sun, &bodies);
    let mut orbit = DisturbedOrbit::between_bodies(&start, 0.0, &gravity).unwrap();
    // Within Mercury's sphere, before periapsis.
    propagated(&mut orbit, &gravity, &mut sky, 9.9 * DAY_S);
    assert_eq!(orbit.integration_center(), Some(Body::Mercury));
    let text = toml::to_string(&orbit).unwrap();
    let mut restored: DisturbedOrbit = toml::from_str(&text).unwrap();
    assert!(restored.is_valid());
    let mut other_sky = Sky::at(FLYBY_S - 10.0 * DAY_S);
    let found = propagated(&mut restored, &gravity, &mut other_sky, 12.0 * DAY_S);
    assert_eq!(found, propagated(&mut orbit, &gravity, &mut sky, 12.0 * DAY_S));
}
