//! Air and magnetic field about the Earth through the plant: what acts by default, cuts, states, invariants, refusals.

use models::MomentumPlant;
use nalgebra::Vector3;
use physics::environment::dates;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing, assert_same};

const CUBESAT: &str = include_str!("../../fmu-src/resources/examples/cubesat-12u.toml");

fn cubesat() -> NamedModel<MomentumPlant> {
    NamedModel::with("cubesat-12u.toml", CUBESAT)
}

/// Without the laws of the file, whose planet light takes most of the time.
const PLAIN: &[(&str, f64)] = &[("planetLight.enabled", 0.0)];
/// An ellipse of 180 x 2000 km: through every height at which the model of the air changes its form.
const ELLIPSE: &[(&str, f64)] = &[
    ("orbit.semiMajorAxis", 7_468_137.0),
    ("orbit.eccentricity", 0.121_837),
    ("orbit.periapsisArgument", 0.3),
];
const FREE: &[(&str, f64)] = &[("attitude.source", 4.0), ("start.q[4]", 1.0)];

/// Seconds before a midnight UTC, at which the air's model goes on to another day of the year.
fn before_midnight(seconds: f64) -> [(&'static str, f64); 1] {
    [("start.epoch", dates::epoch_s("2024-03-21 UTC").unwrap() - seconds)]
}

fn with(parts: &[&[(&'static str, f64)]]) -> Vec<(&'static str, f64)> {
    parts.concat()
}

#[test]
fn both_act_about_the_earth_unless_they_are_set() {
    let messenger = NamedModel::<MomentumPlant>::shipped();
    let switches = ["aerodynamics.enabled", "magnetics.enabled"];
    let acts = |flight: &NamedInstance<'_, MomentumPlant>| switches.map(|name| flight.boolean(name));
    let orbit = [("orbit.center", 4.0), ("orbit.semiMajorAxis", 6.9e6), ("orbit.eccentricity", 0.0)];
    let flight = messenger.initialize(0.0, &orbit).unwrap();
    assert_eq!((acts(&flight), flight.integer("planet.orientation")), ([true; 2], 2));
    assert!(flight.real("atmosphere.density") > 0.0);
    // Set to the start value of the file's own centre it counts too.
    let off = with(&[&orbit, &[("aerodynamics.enabled", 0.0)]]);
    let flight = messenger.initialize(0.0, &off).unwrap();
    assert_eq!(acts(&flight), [false, true]);
    assert_eq!(flight.real("atmosphere.density"), 0.0);
    let about_mercury = messenger.initialize(0.0, &[]).unwrap();
    assert_eq!((acts(&about_mercury), about_mercury.integer("planet.orientation")), ([false; 2], 1));
}

#[test]
fn neither_cuts_nor_saving_change_a_bit() {
    let named = cubesat();
    for (sets, end_s) in [
        (with(&[PLAIN]), 9_000.0),
        (with(&[PLAIN, &before_midnight(1_800.0)]), 3_600.0),
        (with(&[PLAIN, ELLIPSE]), 9_000.0),
        (with(&[PLAIN, ELLIPSE, &[("orbit.dynamics", 1.0)]]), 9_000.0),
        (with(&[PLAIN, FREE]), 240.0),
        (with(&[PLAIN, FREE, &[("orbit.dynamics", 1.0), ("solver.dynamicsStep", 60.0)]]), 900.0),
    ] {
        let ends_s = [0.4 * end_s, end_s];
        assert_cuts_change_nothing(|| named.initialize(0.0, &sets).unwrap(), ends_s, &[97.0, 600.0], |_| {});
    }
}

#[test]
fn the_fit_along_the_orbit_is_as_good_as_its_tolerance() {
    // The coarse fit against one a thousand times as fine, over all heights; and about midnight UTC, which stands in the middle.
    let named = cubesat();
    let at = |sets: &[(&'static str, f64)], step_s: f64, tolerance: f64| {
        let sets = with(&[PLAIN, sets, &[("orbit.dynamics", 1.0), ("atmosphere.tolerance", tolerance)]]);
        let mut flight = named.initialize(0.0, &sets).unwrap();
        let mut found = Vec::new();
        for k in 1..=240 {
            flight.step_to(step_s * f64::from(k)).unwrap();
            found.push((flight.real("atmosphere.density"), flight.vector("magneticField.inertial")));
        }
        found
    };
    for (sets, step_s) in [(ELLIPSE, 30.0), (&before_midnight(240.0)[..], 2.0)] {
        for ((density, field), (fine, fine_field)) in
            at(sets, step_s, 1e-6).into_iter().zip(at(sets, step_s, 1e-9))
        {
            assert!((density - fine).abs() <= 2e-5 * fine, "{density:e} {fine:e}");
            assert!((field - fine_field).norm() < 1e-5 * field.norm());
        }
    }
}

#[test]
fn a_tunable_set_in_flight_acts_from_the_next_step_on() {
    // On an orbit without disturbance and in a given attitude nothing else differs.
    let named = cubesat();
    let start = |sets: &[(&'static str, f64)]| {
        named.initialize(0.0, &with(&[PLAIN, &[("orbit.dynamics", 1.0)], sets])).unwrap()
    };
    let (set_s, end_s) = (600.0, 660.0);
    let inertial = |flight: &NamedInstance<'_, MomentumPlant>, momentum: &str| {
        flight.to_inertial("attitude.q") * flight.vector(momentum)
    };
    let at = |mut flight: NamedInstance<'_, MomentumPlant>, momentum: &str, value: &str| {
        flight.step_to(set_s).unwrap();
        let before = inertial(&flight, momentum);
        flight.step_to(end_s).unwrap();
        (inertial(&flight, momentum) - before, flight.real(value))
    };
    for (name, value, momentum, shown) in [
        ("dipole.residual[1]", 0.05, "momentum.magnetic", "torque.magnetic[2]"),
        ("spaceWeather.f107", 220.0, "momentum.aerodynamic", "atmosphere.density"),
        ("atmosphere.densityFactor", 2.0, "momentum.aerodynamic", "force.aerodynamic[1]"),
    ] {
        let (kept, kept_shown) = at(start(&[]), momentum, shown);
        let (expected, expected_shown) = at(start(&[(name, value)]), momentum, shown);
        let mut flight = start(&[]);
        flight.step_to(set_s).unwrap();
        let until = inertial(&flight, momentum);
        flight.set(name, value);
        flight.step_to(end_s).unwrap();
        let gained = inertial(&flight, momentum) - until;
        let differs = (expected - kept).norm();
        assert!(differs > 0.05 * kept.norm(), "{name} {kept} {expected}");
        assert_ne!(kept_shown, expected_shown, "{shown}");
        // The fits of both begin at other times, so differ by their tolerance.
        assert!((gained - expected).norm() < 1e-4 * differs, "{name} {gained} {expected}");
        let found = flight.real(shown);
        assert!(
            (found - expected_shown).abs() < 1e-5 * expected_shown.abs(),
            "{name} {found} {expected_shown}"
        );

        // A body that turns freely is elsewhere after other torques: set where it begins, it moves as if it had begun with the value.
        let [kept, begun, mut set] = [&[][..], &[(name, value)], &[]].map(|sets| start(&with(&[FREE, sets])));
        set.set(name, value);
        let [kept, begun, set] = [kept, begun, set].map(|mut flight| {
            flight.step_to(60.0).unwrap();
            inertial(&flight, momentum)
        });
        let differs = (begun - kept).norm();
        assert!(
            differs > 0.05 * kept.norm() && (set - begun).norm() < 1e-6 * differs,
            "{name} {set} {begun}"
        );
    }
}

#[test]
fn the_pole_of_the_parameters_counts_where_the_rotation_is_uniform_alone() {
    let named = cubesat();
    let [iau, uniform] = [2.0, 1.0].map(|orientation| {
        [1.0, 1.2].map(|declination| {
            let pole = [("planet.orientation", orientation), ("planet.poleDeclination", declination)];
            let mut flight = named.initialize(0.0, &with(&[PLAIN, &pole])).unwrap();
            flight.step_to(1_200.0).unwrap();
            flight
        })
    });
    assert_same(&iau[0], &iau[1]);
    for name in ["geodetic.latitude", "atmosphere.density", "magneticField.body[1]", "position[3]"] {
        let [a, b] = [0, 1].map(|i| uniform[i].real(name));
        assert!((a - b).abs() > 1e-6 * a.abs(), "{name} {a} {b}");
    }
}

#[test]
fn air_takes_energy_from_the_orbit_as_its_force_says() {
    let named = cubesat();
    let sets = with(&[PLAIN, &[("magnetics.enabled", 0.0), ("atmosphere.densityFactor", 100.0)]]);
    let mut flight = named.initialize(0.0, &sets).unwrap();
    let height_m = flight.real("geodetic.height");
    let (mut work, mut now_s) = (0.0, 0.0);
    let power = |flight: &NamedInstance<'_, MomentumPlant>| {
        let force = flight.to_inertial("attitude.q") * flight.vector("force.aerodynamic");
        force.dot(&flight.vector("velocity")) / flight.real("mass")
    };
    let energy = |flight: &NamedInstance<'_, MomentumPlant>| {
        let (r, v) = (flight.vector("position"), flight.vector("velocity"));
        let (gm, j2, radius_m) = (3.986_004_355_07e14, 1.082_635_9e-3, 6_378_136.3);
        // The pole of the start epoch is 0.13 deg from Z: taken as Z here, within what is compared.
        let sine = r.z / r.norm();
        let flattening = gm / r.norm() * j2 * (radius_m / r.norm()).powi(2) * 0.5 * (3.0 * sine * sine - 1.0);
        0.5 * v.norm_squared() - gm / r.norm() + flattening
    };
    let begin = energy(&flight);
    let mut before = power(&flight);
    while now_s < 17_000.0 {
        now_s += 10.0;
        flight.step_to(now_s).unwrap();
        let next = power(&flight);
        work += 0.5 * (before + next) * 10.0;
        before = next;
    }
    let lost = energy(&flight) - begin;
    assert!(lost < 0.0 && (lost / work - 1.0).abs() < 0.05, "{lost} {work}");
    assert!(flight.real("geodetic.height") < height_m + 20e3);
}

#[test]
fn drag_is_the_same_in_free_and_in_commanded_attitude() {
    // The orbit of the free body is by Encke's method, that of the other is integrated with the forces.
    let text = CUBESAT.replace("[0.42, 0.001, -0.002]", "[4e9, 0.0, 0.0]");
    let text = text.replace("[0.001, 0.31, 0.0015]", "[0.0, 4e9, 0.0]");
    let text = text.replace("[-0.002, 0.0015, 0.27]", "[0.0, 0.0, 4e9]");
    let named = NamedModel::<MomentumPlant>::with("heavy.toml", &text);
    // The fit's error is far below the tolerance here.
    let position_m = |parts: &[(&'static str, f64)], factor: f64| {
        let sets =
            with(&[PLAIN, parts, &[("atmosphere.densityFactor", factor), ("atmosphere.tolerance", 1e-10)]]);
        let mut flight = named.initialize(0.0, &sets).unwrap();
        flight.simulate_to(6_000.0, 100.0).unwrap();
        flight.vector("position")
    };
    let commanded = &[("attitude.source", 2.0), ("command.q[4]", 1.0)];
    let [free_m, commanded_m] = [FREE, commanded].map(|parts| position_m(parts, 100.0));
    let by_drag_m = (commanded_m - position_m(commanded, 0.0)).norm();
    assert!(by_drag_m > 1e3, "{by_drag_m}");
    assert!(
        (free_m - commanded_m).norm() < 2e-6 * by_drag_m,
        "{} of {by_drag_m}",
        (free_m - commanded_m).norm()
    );
}

#[test]
fn a_free_dipole_swings_in_a_given_field_by_its_closed_form() {
    // J theta'' = -m B sin theta about an axis of inertia: small swings of the period 2 pi sqrt(J / m B).
    let text = CUBESAT.replace("[0.42, 0.001, -0.002]", "[0.42, 0.0, 0.0]");
    let text = text
        .replace("[0.001, 0.31, 0.0015]", "[0.0, 0.31, 0.0]")
        .replace("[-0.002, 0.0015, 0.27]", "[0.0, 0.0, 0.27]");
    let named = NamedModel::<MomentumPlant>::with("swing.toml", &text);
    let (dipole, field, inertia) = (0.5, 4e-5, 0.27);
    let quiet: &[(&str, f64)] = &[
        ("solar.flux", 0.0),
        ("planetLight.enabled", 0.0),
        ("gravityGradient.enabled", 0.0),
        ("aerodynamics.enabled", 0.0),
        ("orbit.dynamics", 1.0),
        ("magneticField.method", 3.0),
        ("magneticField.given[1]", field * 0.02_f64.cos()),
        ("magneticField.given[2]", field * 0.02_f64.sin()),
        ("dipole.residual[1]", dipole),
        ("dipole.residual[2]", 0.0),
        ("dipole.residual[3]", 0.0),
        // One interval of the grid is a fraction of a swing.
        ("solver.dynamicsStep", 60.0),
    ];
    let mut flight = named.initialize(0.0, &with(&[FREE, quiet])).unwrap();
    let period_s = core::f64::consts::TAU * (inertia / (dipole * field)).sqrt();
    // Wheels that rest on their bearings turn with the body; after half a period it is at twice the angle, at rest.
    flight.simulate_to(0.5 * period_s, 10.0).unwrap();
    let turned = flight.to_inertial("attitude.q") * Vector3::x();
    let angle = turned.y.atan2(turned.x);
    assert!((angle - 0.04).abs() < 4e-5 * 0.04 * 30.0, "{angle}");
    let by_field = flight.to_inertial("attitude.q") * flight.vector("momentum.magnetic");
    let total = flight.vector("momentum.inertial");
    assert!((by_field - total).norm() < 1e-9 * dipole * field * period_s, "{by_field} {total}");
}

#[test]
fn the_momentum_of_all_effects_is_what_the_momentum_changed_by() {
    let named = cubesat();
    let mut flight = named.initialize(0.0, &[]).unwrap();
    flight.simulate_to(20_000.0, 500.0).unwrap();
    let names = ["solar", "albedo", "infrared", "thermal", "gravityGradient", "aerodynamic", "magnetic"];
    let sum: Vector3<f64> = names.iter().map(|name| flight.vector(&format!("momentum.{name}"))).sum();
    let total = flight.vector("momentum.body");
    assert!((sum - total).norm() < 1e-9 && total.norm() > 1e-3, "{sum} {total}");
}

#[test]
fn what_no_model_has_is_refused_by_name() {
    let (cubesat, messenger) = (cubesat(), NamedModel::<MomentumPlant>::shipped());
    let on = [("aerodynamics.enabled", 1.0), ("magnetics.enabled", 1.0)];
    for (model, sets, words) in [
        (
            &messenger,
            with(&[&on, &[("atmosphere.method", 2.0), ("magneticField.method", 3.0)]]),
            ["atmosphere.method", "nrlmsise00", "Mercury"],
        ),
        (
            &messenger,
            with(&[&on, &[("atmosphere.method", 3.0), ("magneticField.method", 2.0)]]),
            ["magneticField.method", "igrf14", "Mercury"],
        ),
        (
            &messenger,
            with(&[&on, &[("orbit.center", 6.0), ("magneticField.method", 1.0)]]),
            ["magneticField.method", "dipole", "Mars"],
        ),
        (&messenger, with(&[&[("planet.orientation", 2.0)]]), ["planet.orientation", "iau", "Mercury"]),
        (
            &cubesat,
            with(&[&[("orbit.semiMajorAxis", 6_440e3), ("orbit.eccentricity", 0.0)]]),
            ["height", "m", "100 km"],
        ),
        (&cubesat, with(&[&[("start.epoch", 9.9e8)]]), ["magneticField.method", "start.epoch", "2030"]),
        (&cubesat, with(&[&[("start.epoch", -3.16e9)]]), ["magneticField.method", "start.epoch", "1899"]),
    ] {
        let refusal = model.refusal(&sets);
        for word in words {
            assert!(refusal.contains(word), "{word}: {refusal}");
        }
    }
    for (name, value) in [("spaceWeather.f107", -1.0), ("spaceWeather.ap", 401.0)] {
        assert!(
            cubesat
                .given()
                .iter()
                .any(|(known, (low, high), _)| *known == name && (value < *low || value > *high))
        );
    }
}

/// At 280 km, where air and gravity turn the body by degrees, against a tenth of a second and a tight tolerance.
#[test]
fn a_free_body_in_air_turns_as_its_tolerance_says_at_any_step() {
    let named = cubesat();
    for rate in [[1e-3, 0.0, 0.0], [1e-2, 5e-3, 0.0]] {
        let turned_to = |step_s: f64, tolerance: f64| {
            let orbit = [("orbit.semiMajorAxis", 6.658e6), ("orbit.eccentricity", 0.0)];
            let names = ["start.rate[1]", "start.rate[2]", "start.rate[3]"];
            let rates = [0, 1, 2].map(|i| (names[i], rate[i]));
            let solver = [("solver.dynamicsStep", step_s), ("solver.disturbanceTolerance", tolerance)];
            let mut flight = named.initialize(0.0, &with(&[PLAIN, FREE, &orbit, &rates, &solver])).unwrap();
            flight.simulate_to(400.0, 100.0).unwrap();
            flight.to_inertial("attitude.q")
        };
        let fine = turned_to(0.1, 1e-9);
        for (step_s, tolerance, most_rad) in [(1.0, 1e-5, 1e-5), (10.0, 1e-5, 1e-5), (1.0, 1e-8, 1e-7)] {
            let off_rad = turned_to(step_s, tolerance).angle_to(&fine);
            assert!(off_rad < most_rad, "{rate:?}, {step_s} s, {tolerance:e}: {off_rad:e}");
        }
    }
}
