//! Settings that cannot be simulated are refused by name, with what was found and what is allowed.

use models::MomentumPlant;

use super::named_model::NamedModel;

fn says(sets: &[(&str, f64)], words: &[&str]) {
    let text = NamedModel::<MomentumPlant>::shipped().refusal(sets);
    assert!(words.iter().all(|word| text.contains(word)), "{words:?}: {text}");
}

#[test]
fn orbits_inside_planet_or_sun() {
    says(
        &[("orbit.semiMajorAxis", 5e6)],
        &["orbit.semiMajorAxis", "1300000 m", "planet.radius is 2439400 m"],
    );
    says(
        &[("orbit.center", 2.0), ("orbit.semiMajorAxis", 6e8)],
        &["orbit.semiMajorAxis", "the Sun", "695700000 m"],
    );
    // What is left at its default follows the centre.
    for center in [2.0, 3.0, 4.0, 6.0, 7.0] {
        let named = NamedModel::<MomentumPlant>::shipped();
        named.initialize(0.0, &[("orbit.center", center)]).unwrap().step_to(86_400.0).unwrap();
    }
    // Above the Sun's surface it is simulated.
    let named = NamedModel::<MomentumPlant>::shipped();
    let far = [("orbit.center", 2.0), ("orbit.semiMajorAxis", 6e10), ("orbit.eccentricity", 0.2)];
    named.initialize(0.0, &far).unwrap().step_to(86_400.0).unwrap();
    let near = [("orbit.source", 2.0), ("orbit.position[1]", 1e8), ("orbit.velocity[2]", 4e5)];
    says(&[&[("orbit.center", 2.0)][..], &near].concat(), &["inside the planet or the Sun", "orbit.*"]);
    // The Sun at the planet's centre, the spacecraft outside both.
    let planet = [
        ("orbit.source", 2.0),
        ("orbit.position[1]", 1e10),
        ("orbit.velocity[2]", 50.0),
        ("ephemeris.source", 3.0),
        ("sun.position[3]", 1e-4),
        ("eclipse.method", 4.0),
        ("planetLight.enabled", 1.0),
    ];
    says(&planet, &["the planet inside the Sun", "sun.position"]);
}

#[test]
fn elements_that_are_no_orbit() {
    let elements = |axis_m: f64, eccentricity: f64| {
        [("orbit.semiMajorAxis", axis_m), ("orbit.eccentricity", eccentricity)]
    };
    for axis_m in [-6e6, 6e6] {
        let words = ["orbit.eccentricity", "parabola", "orbit.source inputs (2)", "orbit.velocity"];
        says(&elements(axis_m, 1.0), &words);
    }
    says(&elements(6e6, 1.8), &["orbit.semiMajorAxis", "6000000", "below 0 for a hyperbola"]);
    says(&elements(-6e6, 0.1), &["orbit.semiMajorAxis", "-6000000", "above 0 for an ellipse"]);
    says(
        &[&elements(-6e6, 1.8)[..], &[("orbit.trueAnomaly", 2.5)]].concat(),
        &["asymptotes", "orbit.trueAnomaly"],
    );
    says(&elements(-6e6, 1.2), &["the periapsis at 1200000 m", "planet.radius"]);
    // A hyperbola that passes the planet is simulated, with downlinks that no second periapsis repeats.
    let named = NamedModel::<MomentumPlant>::shipped();
    named.initialize(0.0, &elements(-6e6, 1.8)).unwrap().step_to(86_400.0).unwrap();
}

#[test]
fn a_sun_line_that_nothing_gives() {
    let sun_line = ("orbit.frame", 5.0);
    says(&[sun_line, ("orbit.center", 2.0)], &["orbit.frame", "sunLine (5)", "orbit.center sun (2)"]);
    let given = [("ephemeris.source", 3.0), ("sun.position[1]", 5e10), ("sun.velocity[2]", 4e4)];
    says(&[&[sun_line][..], &given].concat(), &["orbit.frame", "ephemeris.source inputs (3)"]);
}

#[test]
fn strategies_without_a_downlink_or_with_downlinks_that_overlap() {
    let strategy = ("momentum.strategy", 2.0);
    let never = [("guided.downlinkEvery", 0.0)];
    let empty = [("guided.downlinkStart", 7_200.0), ("guided.downlinkEnd", 7_200.0)];
    let overlapping =
        [("guided.downlinkEvery", 1.0), ("guided.downlinkStart", 0.0), ("guided.downlinkEnd", 50_000.0)];
    for (sets, found) in [(&never[..], "no downlink"), (&empty, "no downlink"), (&overlapping, "overlap")] {
        says(
            &[&[strategy], sets].concat(),
            &["momentum.strategy", "guided.downlinkEvery", found, "dumpsOnly"],
        );
        NamedModel::<MomentumPlant>::shipped().initialize(0.0, sets).unwrap().step_to(86_400.0).unwrap();
    }
    // One window after the start serves a strategy.
    let once = [&[strategy, ("guided.downlinkReference", 2.0)][..], &overlapping, &never].concat();
    NamedModel::<MomentumPlant>::shipped().initialize(0.0, &once).unwrap().step_to(86_400.0).unwrap();
}

#[test]
fn downlinks_that_end_before_they_begin() {
    let backwards = [("guided.downlinkStart", 36_000.0), ("guided.downlinkEnd", 7_200.0)];
    says(&backwards, &["guided.downlinkStart", "guided.downlinkEnd", "36000.0", "7200.0", "allowed"]);
    let never = [&backwards[..], &[("guided.downlinkEvery", 0.0)]].concat();
    NamedModel::<MomentumPlant>::shipped().initialize(0.0, &never).unwrap().step_to(86_400.0).unwrap();
}

#[test]
fn inertias_no_body_has() {
    says(&[("spacecraft.inertia[1,1]", 5e4)], &["spacecraft.inertia is [[50000.0", "triangle inequality"]);
}

#[test]
fn epochs_beyond_the_theory_of_the_planets() {
    says(&[("start.epoch", 1e12)], &["start.epoch", "1000000000000.0", "allowed", "VSOP87"]);
}

#[test]
fn thresholds_the_torque_outruns() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let sets = [("dump.threshold[1]", 1e-6), ("torque.applied[1]", 1.0)];
    let mut flight = named.initialize(0.0, &sets).unwrap();
    let failure = flight.step_to(600.0).unwrap_err().to_string();
    assert!(failure.contains("1000 dumps") && failure.contains("dump.threshold"), "{failure}");
}
