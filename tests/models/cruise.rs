//! Flight between planets: a flyby of Mercury on the way about the Sun, and what cannot be simulated of it.

use std::collections::BTreeSet;

use client::short_or_long;
use models::MomentumPlant;
use nalgebra::{Rotation3, Vector3};
use physics::bodies::{Body, BodyData};
use physics::constants::{DAY_S, GM_MERCURY_M3_S2, RADIUS_MERCURY_M};
use physics::environment::CartesianState;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::orbit::{
    Attractor, BodyEphemeris, DisturbedOrbit, Elements, GravityModel, NBodyGravity, NBodySettings,
    OrbitMethod,
};

use super::named_model::{NamedModel, assert_cuts_change_nothing};

/// 2008-10-06 08:40, the second flyby of Mercury.
pub(super) const FLYBY_S: f64 = 276_554_400.0;
/// From the start to periapsis.
pub(super) const AHEAD_S: f64 = 10.0 * DAY_S;
const SPEED_M_S: f64 = 5.2e3;
const BODIES: [Body; 5] = [Body::Mercury, Body::Venus, Body::Earth, Body::Mars, Body::Jupiter];

/// The planets, time running back from the flyby.
struct Backward(Ephemeris);

impl BodyEphemeris for Backward {
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState {
        let state = self.0.state(body, FLYBY_S - at_s);
        CartesianState { velocity_m_s: -state.velocity_m_s, ..state }
    }

    fn smooth_until_s(&self, _: f64) -> f64 {
        f64::INFINITY
    }

    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64> {
        self.0.moon_from_earth(FLYBY_S - at_s).position_m
    }
}

/// Ten days before the spacecraft is at this altitude above Mercury, from the Sun; there it goes level, or down by an angle.
pub(super) fn start(altitude_m: f64, down_rad: f64) -> CartesianState {
    let mercury = Ephemeris::default().state(Body::Mercury, FLYBY_S);
    let normal = mercury.position_m.cross(&mercury.velocity_m_s).normalize();
    let outward = mercury.position_m.normalize();
    let radius_m = RADIUS_MERCURY_M + altitude_m;
    let speed_m_s = (SPEED_M_S * SPEED_M_S + 2.0 * GM_MERCURY_M3_S2 / radius_m).sqrt();
    let ahead = Rotation3::new(normal * 0.6) * -outward.cross(&normal);
    let below = Rotation3::new(ahead * 0.2) * ahead.cross(&normal).normalize();
    let at_periapsis = CartesianState {
        position_m: mercury.position_m + below * radius_m,
        velocity_m_s: -(mercury.velocity_m_s + (ahead * down_rad.cos() - below * down_rad.sin()) * speed_m_s),
    };
    let settings = NBodySettings { changes_center: true, cell_s: DAY_S, tolerance_m: 1e-3 };
    let rows = BODIES.iter().map(|body| Attractor::point_mass(body.data()));
    let rows =
        rows.chain([Attractor::point_mass(Body::Sun.data()), Attractor::flattened(Body::Mercury.data())]);
    let model = GravityModel::new(Body::Sun, rows.chain([Attractor::MOON]), true);
    let gravity = NBodyGravity::new(settings, model);
    let mut sky = Backward(Ephemeris::default());
    let mut orbit = DisturbedOrbit::between_bodies(&at_periapsis, 0.0, &gravity).unwrap();
    while orbit.end_s() < AHEAD_S {
        orbit
            .advance_between_bodies(AHEAD_S, &OrbitMethod::default(), &gravity, &mut sky, |_| {
                Vector3::zeros()
            })
            .unwrap();
    }
    let before = orbit.state_at(AHEAD_S);
    CartesianState { velocity_m_s: -before.velocity_m_s, ..before }
}

/// A flight that starts there, light pushing it or not.
pub(super) fn sets(start: &CartesianState, feedback: bool) -> Vec<(&'static str, f64)> {
    let (r, v) = (start.position_m, start.velocity_m_s);
    vec![
        ("start.epoch", FLYBY_S - AHEAD_S),
        ("orbit.center", 2.0),
        ("orbit.source", 2.0),
        ("orbit.dynamics", 3.0),
        ("orbit.position[1]", r.x),
        ("orbit.position[2]", r.y),
        ("orbit.position[3]", r.z),
        ("orbit.velocity[1]", v.x),
        ("orbit.velocity[2]", v.y),
        ("orbit.velocity[3]", v.z),
        ("orbit.radiationFeedback", f64::from(u8::from(feedback))),
        ("encounter.body", 1.0),
    ]
}

#[test]
fn a_flyby_is_counted_where_it_is_and_its_asymptote_follows_from_position_and_velocity() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &sets(&start(2e5, 0.0), false)).unwrap();
    let mut centers = vec![flight.integer("orbit.currentCenter")];
    assert_eq!((flight.integer("encounter.count"), flight.real("encounter.lastTime")), (0, -1.0));
    let (mut at_periapsis_m, mut six_hours_before_m) = (0.0, 0.0);
    let mut nearest_m = f64::INFINITY;
    for minute in (0..17_280).step_by(20) {
        let time_s = 60.0 * f64::from(minute);
        flight.simulate_to(time_s, 1e9).unwrap();
        let center = flight.integer("orbit.currentCenter");
        if centers.last() != Some(&center) {
            centers.push(center);
        }
        let planet_m = flight.vector("encounter.position");
        let relative = CartesianState {
            position_m: flight.vector("position") - planet_m,
            velocity_m_s: flight.vector("velocity") - flight.vector("encounter.velocity"),
        };
        let distance_m = relative.position_m.norm();
        nearest_m = nearest_m.min(distance_m);
        assert!((flight.real("encounter.distance") - distance_m).abs() < 1e-3);
        assert!((flight.vector("planet.positionBody").norm() - distance_m).abs() < 1e-3);
        if distance_m < 1.3e8 {
            assert!(flight.boolean("encounter.hyperbolic"));
            let (b_t_m, b_r_m, excess_m_s) = by_elements(&relative);
            let size_m = b_t_m.hypot(b_r_m);
            let found = ["encounter.bT", "encounter.bR"].map(|name| flight.real(name));
            assert!(
                (found[0] - b_t_m).hypot(found[1] - b_r_m) < 1e-9 * size_m,
                "{minute} {found:?} {b_t_m} {b_r_m}"
            );
            assert!((flight.real("encounter.excessSpeed") / excess_m_s - 1.0).abs() < 1e-9);
            match time_s - AHEAD_S {
                -21_600.0 => six_hours_before_m = found[0],
                0.0 => at_periapsis_m = found[0],
                _ => {}
            }
        }
        // At the very time of periapsis rounding says on which side it is.
        if time_s != AHEAD_S {
            let is_over = time_s > AHEAD_S;
            assert_eq!(flight.integer("encounter.count"), i32::from(is_over), "{minute}");
        }
    }
    assert_eq!(centers, [2, 1, 2]);
    assert!(
        (flight.real("encounter.lastTime") - AHEAD_S).abs() < 1.0,
        "{}",
        flight.real("encounter.lastTime")
    );
    let altitude_m = flight.real("encounter.lastAltitude");
    assert!((altitude_m - 2e5).abs() < 100.0, "{altitude_m}");
    assert!((nearest_m - RADIUS_MERCURY_M - 2e5).abs() < 1e3, "{nearest_m}");
    // The Sun's tide moves the osculating asymptote by tens of kilometres in the last six hours.
    let moved_m = (at_periapsis_m - six_hours_before_m).abs();
    assert!((1e4..6e4).contains(&moved_m), "{moved_m}");
}

/// B.T, B.R and the speed far away by classical elements in the ecliptic's frame: the plane's node and inclination turn the
/// asymptote, which stands pi less the half angle between asymptotes before periapsis.
fn by_elements(relative: &CartesianState) -> (f64, f64, f64) {
    let obliquity_rad = (84_381.448_f64 / 3600.0).to_radians();
    let to_ecliptic = Rotation3::from_axis_angle(&Vector3::x_axis(), -obliquity_rad);
    let ecliptic = CartesianState {
        position_m: to_ecliptic * relative.position_m,
        velocity_m_s: to_ecliptic * relative.velocity_m_s,
    };
    let elements = Elements::from_state(&ecliptic, GM_MERCURY_M3_S2).unwrap();
    let e = elements.eccentricity;
    let axis_m = -elements.semi_major_axis_m;
    let b_m = axis_m * (e * e - 1.0).sqrt();
    let in_plane = |angle_rad: f64| {
        Rotation3::from_axis_angle(&Vector3::z_axis(), elements.ascending_node_rad)
            * Rotation3::from_axis_angle(&Vector3::x_axis(), elements.inclination_rad)
            * Vector3::new(angle_rad.cos(), angle_rad.sin(), 0.0)
    };
    // Where it comes from stands at this true anomaly before periapsis.
    let from_rad = elements.periapsis_argument_rad - (-1.0 / e).acos();
    let s = -in_plane(from_rad);
    // Across it in the plane, on the side of periapsis.
    let b = in_plane(from_rad + core::f64::consts::FRAC_PI_2);
    let t = s.cross(&Vector3::z()).normalize();
    (b_m * b.dot(&t), b_m * b.dot(&s.cross(&t)), (GM_MERCURY_M3_S2 / axis_m).sqrt())
}

#[test]
fn neither_cuts_nor_saving_change_a_bit_of_a_flyby() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets = sets(&start(2e5, 0.0), true);
    let mut centers = BTreeSet::new();
    let step_s = short_or_long(7_200.0, 600.0);
    // In between: before the sphere, within it before and after periapsis, behind it.
    let ends_s = [9.0, 9.9, 10.002, 10.1, 12.0].map(|day| day * DAY_S).into_iter();
    assert_cuts_change_nothing(
        || named.initialize(0.0, &sets).unwrap(),
        ends_s,
        &[step_s],
        |flight| {
            centers.insert(flight.integer("orbit.currentCenter"));
        },
    );
    assert_eq!(centers.into_iter().collect::<Vec<_>>(), [1, 2]);
    // Ten days and that step; another altitude, so that cells and edges lie elsewhere.
    let sets = self::sets(&start(5e5, 0.0), true);
    assert_cuts_change_nothing(
        || named.initialize(0.0, &sets).unwrap(),
        [20.0 * DAY_S],
        &[step_s, 10.0 * DAY_S],
        |_| (),
    );
}

#[test]
fn light_moves_it_as_its_pressure_says() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let start = start(2e5, 0.0);
    let [mut pushed, mut free] =
        [true, false].map(|feedback| named.initialize(0.0, &sets(&start, feedback)).unwrap());
    let time_s = 8.0 * DAY_S;
    pushed.step_to(time_s).unwrap();
    free.step_to(time_s).unwrap();
    let moved_m = (pushed.vector("position") - free.vector("position")).norm();
    // Half the mean acceleration times the square of time; the Sun's tide changes it by some per cent.
    let mean_m_s2 = pushed.vector("deltaV").norm() / time_s;
    assert!((moved_m / (0.5 * mean_m_s2 * time_s * time_s) - 1.0).abs() < 0.1, "{moved_m}");
}

#[test]
fn a_planet_in_the_way_is_named_and_what_cannot_be_is_refused() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let start = start(1.0, 0.5);
    let mut flight = named.initialize(0.0, &sets(&start, false)).unwrap();
    let error = flight.step_to(11.0 * DAY_S).unwrap_err().to_string();
    assert!(["hits Mercury", "m/s", "at 86"].iter().all(|word| error.contains(word)), "{error}");
    let with = |others: &[(&'static str, f64)]| [&sets(&start, false)[..], others].concat();
    let says = |others: &[(&'static str, f64)], words: &[&str]| {
        let text = named.refusal(&with(others));
        assert!(words.iter().all(|word| text.contains(word)), "{words:?}: {text}");
    };
    let mercury = Ephemeris::default().state(Body::Mercury, FLYBY_S - AHEAD_S);
    let [x, y, z] = mercury.position_m.into();
    says(
        &[("orbit.position[1]", x + 1e6), ("orbit.position[2]", y), ("orbit.position[3]", z)],
        &["centre of Mercury", "radius of 2439400 m"],
    );
    says(&[("ephemeris.source", 2.0)], &["ephemeris.source", "kepler", "nBody", "vsop87"]);
    says(&[("ephemeris.source", 3.0)], &["ephemeris.source", "inputs", "nBody", "vsop87"]);
    let about_mercury = [
        ("orbit.center", 1.0),
        ("orbit.position[1]", 1e8),
        ("orbit.position[2]", 0.0),
        ("orbit.position[3]", 0.0),
    ];
    says(&about_mercury, &["encounter.body", "Mercury", "orbit.center"]);
}

#[test]
fn parameters_of_the_planet_are_those_of_the_encounter() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let flight = named.initialize(0.0, &sets(&start(2e5, 0.0), false)).unwrap();
    let BodyData { gm_m3_s2, radius_m, .. } = *Body::Mercury.data();
    assert_eq!(flight.real("planet.gravitationalParameter"), gm_m3_s2);
    assert_eq!(flight.real("planet.radius"), radius_m);
    // Without one they are the Sun's.
    let mut without = sets(&start(2e5, 0.0), false);
    without.retain(|(name, _)| *name != "encounter.body");
    let flight = named.initialize(0.0, &without).unwrap();
    assert!(flight.real("planet.radius") > 6e8);
    assert_eq!((flight.real("encounter.distance"), flight.real("encounter.lastTime")), (0.0, -1.0));
    // An encounter has no effect in other dynamics, and a warning reports that.
    assert!(!named.warnings().iter().any(|it| it.contains("encounter.body")));
    let circle = [("orbit.center", 2.0), ("encounter.body", 1.0)];
    let flight = named.initialize(0.0, &circle).unwrap();
    assert!(flight.real("planet.radius") > 6e8);
    assert!(named.warnings().iter().any(|it| it.contains("encounter.body") && it.contains("nBody")));
}
