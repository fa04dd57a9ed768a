//! Legs and flybys against an independent integrator and figures of a flyby; light at the edge of a sphere; ephemeris files.

use models::MomentumPlant;
use nalgebra::Vector3;
use physics::bodies::Body;
use physics::constants::{DAY_S, GM_MERCURY_M3_S2, GM_SUN_M3_S2, RADIUS_MERCURY_M};
use physics::environment::CartesianState;
use physics::environment::ephemeris::Ephemeris;
use physics::environment::onboard::OnboardTarget;
use physics::environment::orbit::TwoBodyOrbit;
use physics::numerics::Span;

use super::cruise::{AHEAD_S, FLYBY_S, sets, start};
use super::named_model::{NamedInstance, NamedModel};
use super::onboard_ephemeris::{FILE, from_sun_file};

/// Array angles over 200 days, with windmilling.
const PLAN: &str = "[[panels]]\nat = \"2008-03-21T00:40:00 TDB\"\nsunOffset = \"30 deg\"\n\
                    [[panels]]\nat = \"2008-04-20T00:40:00 TDB\"\nsunOffset = \"55 deg\"\nwindmill = \"3 deg\"\n\
                    [[panels]]\nat = \"2008-06-02T00:40:00 TDB\"\nsunOffset = \"-40 deg\"\n\
                    [[panels]]\nat = \"2008-08-15T00:40:00 TDB\"\nsunOffset = \"60 deg\"\nwindmill = \"-2 deg\"\n";
const HOUR_S: f64 = 3600.0;
/// Time between two outputs of a leg.
const STEP_S: f64 = 1800.0;

fn state(flight: &NamedInstance<'_, MomentumPlant>, position: &str, velocity: &str) -> CartesianState {
    CartesianState { position_m: flight.vector(position), velocity_m_s: flight.vector(velocity) }
}

/// Between two states a step apart, by Hermite's cubic.
fn between(from: &CartesianState, to: &CartesianState, share: f64) -> Vector3<f64> {
    let (s, rest) = (share, 1.0 - share);
    from.position_m * (rest * rest * (1.0 + 2.0 * s))
        + to.position_m * (s * s * (3.0 - 2.0 * s))
        + (from.velocity_m_s * (s * rest * rest) - to.velocity_m_s * (s * s * rest)) * STEP_S
}

/// Newton's law for Sun and Mercury, typed a second time, and a constant push.
fn falls(r: &Vector3<f64>, mercury_m: &Vector3<f64>, push_m_s2: &Vector3<f64>) -> Vector3<f64> {
    let toward = |d: Vector3<f64>| d / d.norm().powi(3);
    let from_mercury = toward(mercury_m - r) - toward(*mercury_m);
    toward(-r) * GM_SUN_M3_S2 + from_mercury * GM_MERCURY_M3_S2 + push_m_s2
}

#[test]
fn two_hundred_days_under_light_are_those_of_an_independent_integrator() {
    let named = NamedModel::<MomentumPlant>::shipped().with_schedule("timeline.toml", PLAN);
    let start = CartesianState {
        position_m: Vector3::new(7.0e10, 2.0e10, 1.0e10),
        velocity_m_s: Vector3::new(-8.0e3, 4.0e4, 1.2e4),
    };
    let mut sets = sets(&start, true);
    sets.extend([
        ("start.epoch", FLYBY_S - 200.0 * DAY_S),
        ("panel[1].control", 4.0),
        ("panel[2].control", 4.0),
    ]);
    sets.extend([
        ("orbit.attraction.venus", 0.0),
        ("orbit.attraction.earth", 0.0),
        ("orbit.attraction.moon", 0.0),
        ("orbit.attraction.mars", 0.0),
        ("orbit.attraction.jupiter", 0.0),
        ("orbit.relativity", 0.0),
    ]);
    let mut flight = named.initialize(0.0, &sets).unwrap();
    let [mut light, mut dark] = [[start.position_m, start.velocity_m_s]; 2];
    let mut mercury = state(&flight, "encounter.position", "encounter.velocity");
    let mut pushed = flight.vector("deltaV");
    for step in 1..=9600 {
        flight.step_to(f64::from(step) * STEP_S).unwrap();
        let next = state(&flight, "encounter.position", "encounter.velocity");
        // The velocity that light gives in a step, spread over it.
        let push_m_s2 = (flight.vector("deltaV") - pushed) / STEP_S;
        pushed = flight.vector("deltaV");
        for (path, push_m_s2) in [(&mut light, push_m_s2), (&mut dark, Vector3::zeros())] {
            // Runge and Kutta's method of fourth order in quarters of an hour.
            for half in 0..2 {
                let h = STEP_S / 2.0;
                let rate = |part: f64, [r, v]: &[Vector3<f64>; 2]| {
                    let mercury_m = between(&mercury, &next, (f64::from(half) + part) / 2.0);
                    [*v, falls(r, &mercury_m, &push_m_s2)]
                };
                let ahead = |[dr, dv]: &[Vector3<f64>; 2], h: f64| [path[0] + dr * h, path[1] + dv * h];
                let k1 = rate(0.0, path);
                let k2 = rate(0.5, &ahead(&k1, h / 2.0));
                let k3 = rate(0.5, &ahead(&k2, h / 2.0));
                let k4 = rate(1.0, &ahead(&k3, h));
                *path = [0, 1].map(|i| path[i] + (k1[i] + (k2[i] + k3[i]) * 2.0 + k4[i]) * (h / 6.0));
            }
        }
        mercury = next;
    }
    let found = state(&flight, "position", "velocity");
    let (off_m, off_m_s) = ((found.position_m - light[0]).norm(), (found.velocity_m_s - light[1]).norm());
    assert!(off_m < 1.0 && off_m_s < 1e-6, "{off_m} m, {off_m_s} m/s");
    // Light counts for thousands of kilometres.
    assert!((found.position_m - dark[0]).norm() > 1e6);
}

/// A hyperbola of excess velocity `excess_m_s` that passes Mercury at a periapsis of `radius_m` on the side of T, from the
/// planet, at a time after periapsis in s.
fn hyperbola(excess_m_s: &Vector3<f64>, radius_m: f64, at_s: f64) -> CartesianState {
    let obliquity_rad = (84_381.448_f64 / 3600.0).to_radians();
    let north = Vector3::new(0.0, -obliquity_rad.sin(), obliquity_rad.cos());
    let (s, speed_m_s) = (excess_m_s.normalize(), excess_m_s.norm());
    let t = s.cross(&north).normalize();
    let e = 1.0 + radius_m * speed_m_s * speed_m_s / GM_MERCURY_M3_S2;
    let (cosine, sine) = (1.0 / e, (1.0 - 1.0 / (e * e)).sqrt());
    let periapsis_m_s = (speed_m_s * speed_m_s + 2.0 * GM_MERCURY_M3_S2 / radius_m).sqrt();
    let at_periapsis = CartesianState {
        position_m: (s * cosine + t * sine) * radius_m,
        velocity_m_s: (s * sine - t * cosine) * periapsis_m_s,
    };
    TwoBodyOrbit::from_state(&at_periapsis, GM_MERCURY_M3_S2, 0.0).unwrap().state_at(at_s)
}

/// MESSENGER's second flyby (paper 003): from a heliocentric ellipse of 0.315 to 0.70 AU, inward, at 5.2 km/s; aimed at 200 km
/// by the hyperbola six hours before.
#[test]
fn the_suns_tide_moves_an_aim_of_200_km_to_223_km() {
    const AU_M: f64 = 149_597_870_700.0;
    let named = NamedModel::<MomentumPlant>::shipped();
    let (lead_s, mut ephemeris) = (6.0 * HOUR_S, Ephemeris::default());
    let mercury = ephemeris.state(Body::Mercury, FLYBY_S);
    let (least_m, most_m, r_m) = (0.315 * AU_M, 0.70 * AU_M, mercury.position_m.norm());
    let outward = mercury.position_m / r_m;
    let across = mercury.position_m.cross(&mercury.velocity_m_s).normalize().cross(&outward);
    let along_m_s = (2.0 * GM_SUN_M3_S2 * least_m * most_m / (least_m + most_m)).sqrt() / r_m;
    let speed_squared = GM_SUN_M3_S2 * (2.0 / r_m - 2.0 / (least_m + most_m));
    let inward_m_s = (speed_squared - along_m_s * along_m_s).sqrt();
    let excess_m_s = across * along_m_s - outward * inward_m_s - mercury.velocity_m_s;
    assert!((excess_m_s.norm() - 5.2e3).abs() < 100.0, "{}", excess_m_s.norm());
    let solution = hyperbola(&excess_m_s, RADIUS_MERCURY_M + 2e5, -lead_s);
    let mut sets = sets(&(solution + ephemeris.state(Body::Mercury, FLYBY_S - lead_s)), true);
    sets.extend([("start.epoch", FLYBY_S - lead_s), ("prediction.refresh", DAY_S)]);
    let mut flight = named.initialize(0.0, &sets).unwrap();
    let aimed_m = ["encounter.bT", "encounter.bR"].map(|name| flight.real(name));
    let (arrival_s, altitude_m) = (flight.real("prediction.arrival"), flight.real("prediction.altitude"));
    assert!(aimed_m[0] > 3e6 && aimed_m[1].abs() < 1e3, "{aimed_m:?}");
    flight.step_to(arrival_s).unwrap();
    let there_m = ["encounter.bT", "encounter.bR"].map(|name| flight.real(name));
    // The paper's geometry, to what its ellipse is rounded to.
    assert!(((there_m[0] - aimed_m[0]) / 25e3 - 1.0).abs() < 0.08, "{there_m:?} {aimed_m:?}");
    assert!((altitude_m - 223e3).abs() < 4e3, "{altitude_m}");
    // The hyperbola six hours before leads to 200 km, the one there to where it is.
    let altitude_of = |b_t_m: f64, b_r_m: f64| {
        let half_axis_m = GM_MERCURY_M3_S2 / excess_m_s.norm_squared();
        (half_axis_m * half_axis_m + b_t_m * b_t_m + b_r_m * b_r_m).sqrt() - half_axis_m - RADIUS_MERCURY_M
    };
    assert!((altitude_of(aimed_m[0], aimed_m[1]) - 2e5).abs() < 1.0);
}

#[test]
fn nothing_has_a_kink_where_the_centre_changes() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mercury = Ephemeris::default().state(Body::Mercury, FLYBY_S);
    let outward = mercury.position_m.normalize();
    // In the planet's half-shadow, inward over the edge of its sphere.
    let start = CartesianState {
        position_m: mercury.position_m + outward * 1.145e8 + outward.cross(&Vector3::z()) * 2.4e6,
        velocity_m_s: mercury.velocity_m_s - outward * 5e3,
    };
    let mut sets = sets(&start, true);
    sets.extend([("start.epoch", FLYBY_S), ("planetLight.enabled", 1.0), ("thermal.enabled", 1.0)]);
    sets.extend([("solver.disturbanceTolerance", 1e-8)]);
    let mut flight = named.initialize(0.0, &sets).unwrap();
    let (mut centers, mut rows) = (Vec::new(), Vec::new());
    let names = ["torque.gravityGradient", "force.solar", "force.infrared", "force.thermal"];
    for step in 0..80 {
        flight.step_to(10.0 * f64::from(step)).unwrap();
        centers.push(flight.integer("orbit.currentCenter"));
        let mut row: Vec<f64> = names.iter().flat_map(|name| flight.vector(name).data.0[0]).collect();
        row.extend([flight.real("sun.litFraction"), flight.real("encounter.bT")]);
        rows.push(row);
    }
    centers.dedup();
    assert_eq!(centers, [2, 1]);
    let lit = rows[0][12];
    assert!((0.1..0.95).contains(&lit), "{lit}");
    for (k, three) in rows.windows(3).enumerate() {
        for group in [0..3, 3..6, 6..9, 9..12, 12..13, 13..14] {
            let size = |row: &[f64]| row[group.clone()].iter().map(|x| x * x).sum::<f64>().sqrt();
            let bend: Vec<f64> = (0..14).map(|i| three[0][i] - 2.0 * three[1][i] + three[2][i]).collect();
            let (bent, all) = (size(&bend), size(&three[1]));
            assert!(all > 0.0 && bent < 1e-5 * all, "{k} {group:?}: {bent} of {all}");
        }
    }
}

#[test]
fn a_file_places_all_that_attracts_over_the_whole_flight_or_is_refused() {
    let mut ephemeris = Ephemeris::default();
    let mut file = |targets: &[OnboardTarget], days: f64| {
        from_sun_file(targets, Span::new(FLYBY_S - AHEAD_S, FLYBY_S - AHEAD_S + days * DAY_S), &mut ephemeris)
    };
    use OnboardTarget::{Earth, Jupiter, Mars, Mercury, Moon, Venus};
    let all = [Mercury, Venus, Earth, Mars, Jupiter, Moon];
    let begin = start(2e5, 0.0);
    let by_file =
        [&sets(&begin, false)[..], &[("ephemeris.source", 4.0), ("prediction.refresh", DAY_S)]].concat();
    let with_file = |text: &str| NamedModel::<MomentumPlant>::shipped().with_schedule(FILE, text);
    for lacking in all {
        let others: Vec<_> = all.into_iter().filter(|target| *target != lacking).collect();
        // The Moon counts from the Earth.
        let others = if lacking == Earth { vec![Mercury, Venus, Mars, Jupiter] } else { others };
        let text = with_file(&file(&others, 12.0)).refusal(&by_file);
        assert!(text.contains(FILE) && text.contains(&lacking.to_string()), "{lacking}: {text}");
    }
    // Not attracted by it, the flight needs no Moon.
    let without_moon = with_file(&file(&all[..5], 12.0));
    without_moon.initialize(0.0, &[&by_file[..], &[("orbit.attraction.moon", 0.0)]].concat()).unwrap();
    let named = with_file(&file(&all, 12.0));
    let early = [&by_file[..], &[("start.epoch", FLYBY_S - AHEAD_S - DAY_S)]].concat();
    let text = named.refusal(&early);
    assert!(text.contains("start.epoch: found") && text.contains("places"), "{text}");
    let mut flight = named.initialize(0.0, &by_file).unwrap();
    let reference = NamedModel::<MomentumPlant>::shipped();
    let mut by_theory = reference.initialize(0.0, &sets(&begin, false)).unwrap();
    assert!(flight.boolean("prediction.valid"));
    for days in [9.0, 11.0] {
        flight.step_to(days * DAY_S).unwrap();
        by_theory.step_to(days * DAY_S).unwrap();
        let off_m = (flight.vector("position") - by_theory.vector("position")).norm();
        // What the planet turns of metres before it grows behind it.
        assert!(off_m < if days < AHEAD_S / DAY_S { 50.0 } else { 5e3 }, "{days}: {off_m}");
    }
    let error = flight.step_to(12.5 * DAY_S).unwrap_err().to_string();
    assert!(error.contains("the epoch at the end of the step: found") && error.contains(FILE), "{error}");
    // Nothing is predicted beyond the file.
    let short =
        with_file(&file(&all, 8.0)).initialize(0.0, &by_file).map(|it| it.boolean("prediction.valid"));
    assert_eq!(short.ok(), Some(false));
}
