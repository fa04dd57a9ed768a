//! Legs simulated between Sun and planets under a push of light: the flight with the velocity that was found is simulated anew.

use inputs::leg::{ArcBranch, FlybyAimpoint};
use nalgebra::Vector3;
use physics::{
    bodies::Body,
    constants::{ASTRONOMICAL_UNIT_M, DAY_S, GM_MERCURY_M3_S2, GM_SUN_M3_S2, RADIUS_MERCURY_M},
    environment::{
        CartesianState, dates,
        ephemeris::Ephemeris,
        orbit::{
            Attractor, BPlane, BodyEphemeris, DisturbedOrbit, GravityModel, NBodyGravity, NBodySettings,
            OrbitMethod, TwoBodyOrbit,
        },
    },
};

use super::*;
use crate::{
    Failure,
    orbit::{LambertArc, LambertError},
};

/// 2008-01-14 19:05 TDB, the first flyby of Mercury.
const FLYBY_S: f64 = 253_609_500.0;
const LEAD_S: f64 = 21_600.0;
/// Acceleration by light at 1 AU, m/s2.
const LIGHT_M_S2: f64 = 6e-8;

/// The planets, by a clock that is 0 at the flyby.
struct Sky(Ephemeris);

impl BodyEphemeris for Sky {
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState {
        self.0.state(body, FLYBY_S + at_s)
    }

    fn smooth_until_s(&self, at_s: f64) -> f64 {
        Ephemeris::smooth_until_s(FLYBY_S + at_s) - FLYBY_S
    }

    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64> {
        self.0.moon_from_earth(FLYBY_S + at_s).position_m
    }
}

struct Flights<'a> {
    task: &'a LegTask,
    sky: Sky,
}

impl Flights<'_> {
    /// States at these times of a flight with or without Mercury.
    fn states(
        &mut self,
        velocity_m_s: &Vector3<f64>,
        times_s: &[f64],
        mercury: bool,
    ) -> Result<Vec<CartesianState>, Failure> {
        let settings = NBodySettings { changes_center: true, cell_s: DAY_S, tolerance_m: 1e-3 };
        let all = [Body::Venus, Body::Earth, Body::Jupiter].into_iter();
        let all = all.chain(mercury.then_some(Body::Mercury)).chain([Body::Sun]);
        let rows = all.map(|body| Attractor::point_mass(body.data()));
        let gravity = NBodyGravity::new(settings, GravityModel::new(Body::Sun, rows, false));
        let start = CartesianState { position_m: self.task.position_m, velocity_m_s: *velocity_m_s };
        let mut orbit = DisturbedOrbit::between_bodies(&start, self.task.start_s, &gravity)?;
        let method = OrbitMethod::default();
        let push = |position_m: &Vector3<f64>| {
            let distance_m = position_m.norm();
            position_m * (LIGHT_M_S2 * (ASTRONOMICAL_UNIT_M / distance_m).powi(2) / distance_m)
        };
        let mut states = Vec::new();
        for &time_s in times_s {
            while orbit.end_s() < time_s {
                let here = orbit.state_at(orbit.end_s()).position_m;
                orbit.advance_between_bodies(f64::INFINITY, &method, &gravity, &mut self.sky, |_| {
                    push(&here)
                })?;
            }
            states.push(orbit.state_at(time_s));
        }
        Ok(states)
    }
}

impl SimulatesLeg for Flights<'_> {
    fn unattracted_m(&mut self, velocity_m_s: &Vector3<f64>) -> Result<Vector3<f64>, Failure> {
        Ok(self.states(velocity_m_s, &[self.task.arrival_s], false)?[0].position_m)
    }

    fn approach(&mut self, velocity_m_s: &Vector3<f64>) -> Result<Approach, Failure> {
        let arrival_s = self.task.arrival_s;
        let times_s: Vec<f64> = (-42..=-1).map(|k| arrival_s + 600.0 * f64::from(k)).collect();
        let states = self.states(velocity_m_s, &times_s, true)?;
        let rows = times_s.iter().zip(states).map(|(&time_s, state)| {
            let state = from_mercury(&state, &self.sky.heliocentric(Body::Mercury, time_s));
            ApproachRow { time_s, state, b_plane: BPlane::from_state(&state, GM_MERCURY_M3_S2).unwrap() }
        });
        let rows = rows.collect();
        Ok(Approach { rows, closest: None, mu_m3_s2: GM_MERCURY_M3_S2, radius_m: RADIUS_MERCURY_M })
    }

    fn progress(&mut self, _: &str) {}
}

fn from_mercury(state: &CartesianState, mercury: &CartesianState) -> CartesianState {
    CartesianState {
        position_m: state.position_m - mercury.position_m,
        velocity_m_s: state.velocity_m_s - mercury.velocity_m_s,
    }
}

fn task(days: f64, aimpoint: FlybyAimpoint) -> LegTask {
    LegTask {
        position_m: Vector3::new(-0.3, -0.45, -0.21) * ASTRONOMICAL_UNIT_M,
        start_s: -days * DAY_S,
        arrival_s: 0.0,
        aimpoint,
        lead_s: LEAD_S,
        revolutions: None,
        velocity_before_m_s: None,
        body: Sky(Ephemeris::default()).heliocentric(Body::Mercury, 0.0),
        mu_m3_s2: GM_MERCURY_M3_S2,
        radius_m: RADIUS_MERCURY_M,
        tolerance_m: 1.0,
    }
}

/// Time and distance of the closest approach, by every second about the arrival.
fn closest(task: &LegTask, velocity_m_s: &Vector3<f64>) -> (f64, f64) {
    let times_s: Vec<f64> = (-120..=120).map(|k| task.arrival_s + f64::from(k)).collect();
    let mut flights = Flights { task, sky: Sky(Ephemeris::default()) };
    let states = flights.states(velocity_m_s, &times_s, true).unwrap();
    let distances = times_s.iter().zip(states).map(|(&time_s, state)| {
        let mercury = flights.sky.heliocentric(Body::Mercury, time_s);
        (time_s, (state.position_m - mercury.position_m).norm())
    });
    distances.fold((f64::NAN, f64::INFINITY), |least, it| if it.1 < least.1 { it } else { least })
}

#[test]
fn a_flight_with_the_velocity_found_passes_at_the_altitude_and_time_of_the_aim() {
    let aimpoint = FlybyAimpoint::Altitude { altitude_m: 2e5, angle_rad: 0.6 };
    let direct = task(26.0, aimpoint);
    let revolving = LegTask { revolutions: Some((1, ArcBranch::Left)), ..task(160.0, aimpoint) };
    for task in [direct, revolving] {
        let mut flights = Flights { task: &task, sky: Sky(Ephemeris::default()) };
        let leg = shoot(&task, &mut flights).unwrap();
        assert!(leg.rounds[1] <= 8, "{:?}", leg.rounds);
        let (at_s, distance_m) = closest(&task, &leg.velocity_m_s);
        // The altitude is that of the hyperbola ten minutes before: the tide moves it by metres until then.
        assert!((distance_m - RADIUS_MERCURY_M - 2e5).abs() < 300.0, "{distance_m}");
        assert!((at_s - task.arrival_s).abs() <= 1.0, "{at_s}");
        let angle_rad = leg.encounter.b_m.y.atan2(leg.encounter.b_m.x);
        assert!((angle_rad - 0.6).abs() < 1e-6, "{angle_rad}");
    }
}

#[test]
fn an_aim_by_components_is_met_six_hours_before() {
    let task = task(40.0, FlybyAimpoint::Plane { b_t_m: -4.1e6, b_r_m: 1.3e6 });
    let mut flights = Flights { task: &task, sky: Sky(Ephemeris::default()) };
    let leg = shoot(&task, &mut flights).unwrap();
    let before_s = leg.encounter.arrival_s - LEAD_S;
    let state = flights.states(&leg.velocity_m_s, &[before_s], true).unwrap()[0];
    let mercury = flights.sky.heliocentric(Body::Mercury, before_s);
    let found = BPlane::from_state(&from_mercury(&state, &mercury), GM_MERCURY_M3_S2).unwrap();
    let miss_m = (found.b_t_m + 4.1e6).hypot(found.b_r_m - 1.3e6);
    assert!(miss_m < 2.0, "{miss_m}");
}

#[test]
fn what_cannot_be_is_refused_before_a_flight_to_the_body() {
    let refused = |task: LegTask| {
        let mut flights = Flights { task: &task, sky: Sky(Ephemeris::default()) };
        shoot(&task, &mut flights).unwrap_err()
    };
    let inside = refused(task(40.0, FlybyAimpoint::Altitude { altitude_m: -1.0, angle_rad: 0.0 }));
    assert!(matches!(inside, LegError::Inside { .. }), "{inside}");
    let inside = refused(task(40.0, FlybyAimpoint::Plane { b_t_m: 1e6, b_r_m: 1e6 }));
    assert!(inside.to_string().contains("the path ends in it"), "{inside}");
    let aimpoint = FlybyAimpoint::Altitude { altitude_m: 2e5, angle_rad: 0.0 };
    let short = refused(LegTask { revolutions: Some((1, ArcBranch::Left)), ..task(40.0, aimpoint) });
    assert!(matches!(short, LegError::Lambert(LambertError::TooShort { revolutions: 1, .. })), "{short}");
    // Half an astronomical unit in half a day: 1700 km/s.
    let fast = refused(task(0.5, aimpoint));
    assert!(matches!(fast, LegError::Fast { speed_km_s, .. } if speed_km_s > 1e3), "{fast}");
    let mercury = Sky(Ephemeris::default()).heliocentric(Body::Mercury, 0.0);
    let opposite = refused(LegTask { position_m: mercury.position_m * -1.2, ..task(80.0, aimpoint) });
    assert!(opposite.to_string().starts_with("found places 180.000 deg apart"), "{opposite}");
}

#[test]
fn a_flyby_turns_by_what_its_hyperbola_turns() {
    // Paper 003's second flyby: 200 km, 5.2 km/s, 2452 m/s; two states far out on an orbit in closed form.
    let flyby = Flyby::new(RADIUS_MERCURY_M + 2e5, 5.2e3, GM_MERCURY_M3_S2);
    let b_m = impact_parameter_m(RADIUS_MERCURY_M + 2e5, 5.2e3, GM_MERCURY_M3_S2);
    let far_m = 1e13;
    let start = CartesianState {
        position_m: Vector3::new(-far_m, b_m, 0.0),
        velocity_m_s: Vector3::new((5.2e3_f64.powi(2) + 2.0 * GM_MERCURY_M3_S2 / far_m).sqrt(), 0.0, 0.0),
    };
    let orbit = TwoBodyOrbit::from_state(&start, GM_MERCURY_M3_S2, 0.0).unwrap();
    let end = orbit.state_at(2.0 * orbit.periapsis_epoch_s(0));
    let change_m_s = (end.velocity_m_s - start.velocity_m_s).norm();
    assert!((change_m_s / flyby.delta_v_m_s - 1.0).abs() < 1e-5, "{change_m_s} {flyby:?}");
    assert!((end.velocity_m_s.angle(&start.velocity_m_s) - flyby.turn_rad).abs() < 1e-5);
    assert!((flyby.delta_v_m_s - 2452.0).abs() < 20.0, "{flyby:?}");
}

#[test]
fn a_hyperbola_has_one_closest_distance_for_its_b() {
    for distance_m in [2.5e6, 1e7, 1e9] {
        let b_m = impact_parameter_m(distance_m, 5.2e3, GM_MERCURY_M3_S2);
        assert!((closest_distance_m(b_m, 5.2e3, GM_MERCURY_M3_S2) / distance_m - 1.0).abs() < 1e-12);
    }
}

/// A vector of a shipped leg file, `[depart]`, in SI.
fn shipped(number: u32, key: &str, unit: &str, factor: f64) -> Vector3<f64> {
    let file = format!("../../fmu-src/resources/examples/legs/messenger-flyby{number}.toml");
    let leg: toml::Table = std::fs::read_to_string(file).unwrap().parse().unwrap();
    let parts = leg["depart"][key].as_array().unwrap().iter();
    let parts =
        parts.map(|part| part.as_str().unwrap().strip_suffix(unit).unwrap().trim().parse::<f64>().unwrap());
    Vector3::from_iterator(parts) * factor
}

/// What the heads of the shipped leg files say of their places, to the kilometre and millimetre a second that stand there.
#[test]
fn places_of_the_shipped_legs_are_where_their_files_say() {
    let mut sky = Ephemeris::default();
    let mut at = |body: Body, date: &str| sky.state(body, dates::epoch_s(date).unwrap());
    let (first, second) = ("2008-01-14T19:04:00 UTC", "2008-10-06T08:40:00 UTC");
    let epoch_s = |date: &str| dates::epoch_s(date).unwrap();

    let (venus, mercury) = (at(Body::Venus, "2007-06-05T23:08:00 UTC"), at(Body::Mercury, first));
    let arc = LambertArc {
        from_m: venus.position_m,
        to_m: mercury.position_m,
        time_s: epoch_s(first) - epoch_s("2007-06-05T23:08:00 UTC"),
        north: venus.position_m.cross(&venus.velocity_m_s),
        mu_m3_s2: GM_SUN_M3_S2,
    };
    let velocity_m_s = arc.revolving(1, ArcBranch::Left).unwrap().from_m_s;
    let start = CartesianState { velocity_m_s, ..venus };
    let orbit = TwoBodyOrbit::from_state(&start, GM_SUN_M3_S2, epoch_s("2007-06-05T23:08:00 UTC")).unwrap();
    let place = orbit.state_at(epoch_s("2007-12-19T00:00:00 UTC"));
    assert!((place.position_m - shipped(1, "position", "km", 1e3)).amax() <= 501.0);
    assert!((place.velocity_m_s - shipped(1, "velocity", "m/s", 1.0)).amax() <= 0.51e-3);

    let mercury = at(Body::Mercury, second);
    let [perihelion_m, aphelion_m] = [0.315, 0.70].map(|distance| distance * ASTRONOMICAL_UNIT_M);
    let momentum = (2.0 * GM_SUN_M3_S2 * perihelion_m * aphelion_m / (perihelion_m + aphelion_m)).sqrt();
    let (up, distance_m) = (mercury.position_m.normalize(), mercury.position_m.norm());
    let across_m_s = momentum / distance_m;
    let speed_squared = GM_SUN_M3_S2 * (2.0 / distance_m - 2.0 / (perihelion_m + aphelion_m));
    let inward_m_s = (speed_squared - across_m_s * across_m_s).sqrt();
    let ahead = mercury.position_m.cross(&mercury.velocity_m_s).normalize().cross(&up);
    let end = CartesianState { velocity_m_s: ahead * across_m_s - up * inward_m_s, ..mercury };
    let orbit = TwoBodyOrbit::from_state(&end, GM_SUN_M3_S2, epoch_s(second)).unwrap();
    let place = orbit.state_at(epoch_s("2008-03-19T00:00:00 UTC"));
    assert!((place.position_m - shipped(2, "position", "km", 1e3)).amax() <= 501.0);
}
