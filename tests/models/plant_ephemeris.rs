//! The plant by an ephemeris file: within its stated error of the theory, refused outside its span, exact under cuts.

use models::MomentumPlant;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing, assert_same};
use super::onboard_ephemeris::{FILE, START_S, file};

const CHEBYSHEV: &[(&str, f64)] = &[("ephemeris.source", 4.0)];

fn sun_m(flight: &NamedInstance<'_, MomentumPlant>) -> nalgebra::Vector3<f64> {
    flight.vector("sun.positionInertial")
}

#[test]
fn sun_and_earth_are_where_the_file_has_them() {
    let (text, error_m) = file(10.0 * 86_400.0, 0.0);
    let named = NamedModel::<MomentumPlant>::shipped().with_schedule(FILE, &text);
    let mut fitted = named.initialize(0.0, CHEBYSHEV).unwrap();
    let mut theory = named.initialize(0.0, &[]).unwrap();
    let mut greatest_m = 0.0_f64;
    for step in 1..=60 {
        let end_s = f64::from(step) * 13_000.0;
        for flight in [&mut fitted, &mut theory] {
            flight.step_to(end_s).unwrap();
        }
        for name in ["sun.positionInertial", "earth.positionInertial"] {
            let off_m = (fitted.vector(name) - theory.vector(name)).norm();
            // Positions of 1e11 m are rounded to 2e-5 m, epochs of 3e8 s to 6e-8 s at 50 km/s.
            assert!(off_m < 1.05 * error_m + 0.01, "{name} at {end_s}: {off_m} m of {error_m}");
            greatest_m = greatest_m.max(off_m);
        }
    }
    assert!(greatest_m > 0.3 * error_m, "{greatest_m} of {error_m} m");
    assert_ne!(sun_m(&fitted), sun_m(&theory));
}

#[test]
fn outside_the_span_it_is_refused_by_name() {
    let named = NamedModel::<MomentumPlant>::shipped().with_schedule(FILE, &file(86_400.0, 0.0).0);
    for epoch_s in [START_S - 1.0, START_S + 86_401.0] {
        let text = named.refusal(&[CHEBYSHEV, &[("start.epoch", epoch_s)]].concat());
        assert!(text.contains("start.epoch: found") && text.contains(FILE) && text.contains("sun"), "{text}");
    }
    let mut flight = named.initialize(0.0, CHEBYSHEV).unwrap();
    flight.step_to(86_400.0).unwrap();
    let text = flight.step_to(86_401.0).unwrap_err().to_string();
    assert!(text.contains("the epoch at the end of the step: found") && text.contains(FILE), "{text}");
    let text = named.refusal(&[CHEBYSHEV, &[("orbit.center", 3.0)]].concat());
    assert!(text.contains("ephemeris.toml: found no [[body]] that joins sun with venus"), "{text}");
}

#[test]
fn without_a_file_it_is_vsop87_to_the_bit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let (mut fitted, mut theory) =
        (named.initialize(0.0, CHEBYSHEV).unwrap(), named.initialize(0.0, &[]).unwrap());
    for end_s in [600.0, 50_000.0] {
        for flight in [&mut fitted, &mut theory] {
            flight.step_to(end_s).unwrap();
        }
        assert_same(&fitted, &theory);
    }
}

#[test]
fn neither_cuts_nor_saving_change_a_bit() {
    let named = NamedModel::<MomentumPlant>::shipped().with_schedule(FILE, &file(5.0 * 86_400.0, 0.0).0);
    for disturbed in [0.0, 1.0] {
        let sets = [CHEBYSHEV, &[("orbit.dynamics", 1.0 + disturbed)]].concat();
        let initialize = || named.initialize(0.0, &sets).unwrap();
        assert_cuts_change_nothing(
            initialize,
            [86_400.0, 200_000.0, 5.0 * 86_400.0],
            &[3_000.0, 700.0],
            |_| {},
        );
    }
}

/// Sun and Earth by inputs, with their velocities: what another model is wired to follows, and so does the rate of an attitude
/// that keeps to the Sun.
#[test]
fn given_velocities_of_sun_and_earth_reach_outputs_and_rates() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut theory = named.initialize(0.0, &[]).unwrap();
    theory.step_to(60.0).unwrap();
    let names = ["sun.position", "sun.velocity", "earth.position", "earth.velocity"];
    let outputs = names.map(|name| theory.vector(&format!("{name}Inertial")));
    let given: Vec<(String, f64)> = names
        .iter()
        .zip(&outputs)
        .flat_map(|(name, value)| (0..3).map(move |axis| (format!("{name}[{}]", axis + 1), value[axis])))
        .collect();
    let rate_without = {
        let still: Vec<_> = given.iter().filter(|(name, _)| name.contains("position")).collect();
        let mut sets: Vec<_> = still.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        sets.push(("ephemeris.source", 3.0));
        let mut flight = named.initialize(0.0, &sets).unwrap();
        flight.step_to(60.0).unwrap();
        assert_eq!(flight.vector("sun.velocityInertial"), nalgebra::Vector3::zeros());
        flight.vector("attitude.rate")
    };
    let mut sets: Vec<_> = given.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    sets.push(("ephemeris.source", 3.0));
    let mut flight = named.initialize(0.0, &sets).unwrap();
    flight.step_to(60.0).unwrap();
    for (name, expected) in names.iter().zip(&outputs) {
        let found = flight.vector(&format!("{name}Inertial"));
        assert!((found - expected).norm() < 1e-12 * expected.norm(), "{name}: {found} {expected}");
    }
    let truth = theory.vector("attitude.rate");
    let error = (flight.vector("attitude.rate") - truth).norm();
    assert!(
        error < 1e-10 && (rate_without - truth).norm() > 1e-8,
        "{error} {}",
        (rate_without - truth).norm()
    );
}
