//! SpinPlant refuses by name what cannot be simulated, and survives states that belong to no flight.

use fmi_export::{Model, Status};
use models::SpinPlant;
use physics::spin::burn::BurnRequest;
use physics::spin::forecast::Timing;
use physics::spin::geometry::{L1Ephemeris, L1Phases};
use physics::spin::outputs::Outputs;
use physics::spin::plant::{Commands, Directions, MassSource, Plant, Sampling, Start};
use physics::spin::predictions::Predictions;
use physics::spin::rates::Rates;
use physics::spin::spinner;
use physics::spin::train::Shape;

use super::driver::{Spinner, assert_names};

#[test]
fn what_cannot_be_simulated_is_refused_by_name() {
    assert_names(
        &Spinner::new().set_integer("burn.thruster", 11).refusal(),
        &["burn.thruster", "11", "1 to 10"],
    );
    assert_names(
        &Spinner::new().set("burn.pulseWidth", 6.1).refusal(),
        &["burn.pulseWidth", "6.1", "half a turn"],
    );
    assert_names(&Spinner::new().set("inertia[3]", 700.0).refusal(), &["inertia[3]", "triangle"]);
    assert_names(
        &Spinner::new().set("burn.turnsPerPulse", 0.5).set_integer("burn.oppositeThruster", 0).refusal(),
        &["0.5 turns", "opposite"],
    );
    assert_names(
        &Spinner::new().set("burn.angle", 0.0349).set("burn.maxDuration", 600.0).refusal(),
        &["does not fit its limits", "duration", "burn.maxDuration"],
    );
    assert_names(
        &Spinner::new().set("burn.angle", 0.0349).set("burn.maxNutation", 1e-5).refusal(),
        &["does not fit its limits", "nutation", "burn.maxNutation"],
    );
    assert_names(
        &Spinner::new().set_text("burn.group", "rocket").refusal(),
        &["burn.group", "rocket", "spin up"],
    );
    // What no spinner has is refused where it is set, and the instance lives.
    let mut spinner = Spinner::new();
    for (name, value) in [
        ("burn.pulseWidth", -0.5),
        ("burn.pulseWidth", f64::NAN),
        ("inertia[1]", -1.0),
        ("spin.initialRate", 1e5),
        ("limit.spinRate", 1e9),
    ] {
        let at = spinner.at(name);
        let _ = spinner.fmu.take_messages();
        assert_eq!(spinner.fmu.set_real(&[at], &[value]), Status::Discard, "{name} = {value}");
        let text: String = spinner.fmu.take_messages().into_iter().map(|message| message.text).collect();
        assert_names(&text, &[name]);
    }
    spinner.start().to(1.0);
}

/// A step of 1 s that must fail: what the instance says. After Reset it flies as ever.
fn failed_step(mut spinner: Spinner) -> String {
    let _ = spinner.fmu.take_messages();
    assert_eq!(spinner.try_step(1.0), Status::Error);
    let text = spinner.fmu.take_messages().into_iter().map(|message| message.text).collect();
    assert_eq!(spinner.fmu.reset(), Status::Ok);
    spinner.time_s = 0.0;
    let mut spinner = spinner.start();
    spinner.to(10.0);
    assert!(spinner.outputs().iter().all(|value| value.is_finite()));
    text
}

#[test]
fn a_torque_that_no_body_bears_fails_the_first_step_it_acts_in() {
    let sudden =
        failed_step(Spinner::new().set("torque.applied[1]", 1e100).set_integer("burn.plan", 4).start());
    assert_names(&sudden, &["at 0 s", "1e100 N m", "torque.applied", "1e4 rad/s"]);
    // Slowly enough to be followed, but beyond the limit within the step: 353.82 kg m2 turn at 2e4 rad/s after 1 s.
    let fast = failed_step(Spinner::new().set("torque.applied[3]", 7.1e6).start());
    assert_names(&fast, &["rad/s; allowed", "1e4 rad/s", "torque.applied"]);
    // A thruster does not hide it, nor do slopes.
    let mut spinner = Spinner::new().set("torque.applied[2]", -1e100).set_integer("burn.plan", 4).start();
    spinner.fire(8, true);
    assert_names(&failed_step(spinner), &["1e100 N m", "torque.applied"]);
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).start();
    let reference = spinner.at("torque.applied[1]");
    assert_eq!(spinner.fmu.set_input_derivatives(&[reference], &[1], &[1e100]), Status::Ok);
    assert_names(&failed_step(spinner), &["torque.applied"]);
}

/// Every row a master could read while the torque grows tenfold from flight to flight is finite.
#[test]
fn no_step_that_went_well_leaves_a_number_that_is_none() {
    for exponent in 0..100 {
        let torque_n_m = 10.0_f64.powi(exponent);
        let mut spinner =
            Spinner::new().set("torque.applied[1]", torque_n_m).set("torque.applied[3]", torque_n_m).start();
        for i in 0..5 {
            if spinner.fmu.do_step(0.5 * f64::from(i), 0.5) != Status::Ok {
                break;
            }
            let outputs = spinner.outputs();
            assert!(outputs.iter().all(|value| value.is_finite()), "{torque_n_m} N m: {outputs:?}");
        }
    }
}

#[test]
fn a_direction_too_short_or_too_long_is_refused_where_it_is_used() {
    let with = |name: &str, value: f64, orbit: bool| {
        let source = if orbit { 2 } else { 1 };
        let mut spinner = Spinner::new().set_integer("geometry.source", source);
        for axis in 1..=3 {
            spinner.put(&format!("{name}[{axis}]"), value);
        }
        spinner
    };
    for name in ["sun.direction", "earth.direction", "star.direction"] {
        assert_names(&with(name, 1e-120, false).refusal(), &[name, "1e-120", "length"]);
        assert_names(&with(name, 1e100, false).refusal(), &[name, "1e100", "length"]);
        // In flight as well, by value and by slope.
        let mut spinner = Spinner::new().start();
        (1..=3).for_each(|axis| spinner.put(&format!("{name}[{axis}]"), 1e-120));
        assert_names(&failed_step(spinner), &[name, "1e-120"]);
        let mut spinner = Spinner::new().start();
        let references = [1, 2, 3].map(|axis| spinner.at(&format!("{name}[{axis}]")));
        // Longer than 1e100 after a second, by the root of 3.
        assert_eq!(spinner.fmu.set_input_derivatives(&references, &[1; 3], &[1e100; 3]), Status::Ok);
        assert_names(&failed_step(spinner), &[name]);
    }
    // The L1 orbit has Sun and Earth of its own.
    for name in ["sun.direction", "earth.direction"] {
        with(name, 1e-120, true).start().to(10.0);
    }
    assert_names(&with("star.direction", 1e-120, true).refusal(), &["star.direction"]);
}

#[test]
fn states_torn_at_random_are_refused_or_simulated_on_without_panic_or_hang() {
    let spinner = SpinPlant::parse_setup("default", SpinPlant::DEFAULT_SETUP).unwrap();
    let mut seed = 1_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 33) as usize
    };
    let (mut refused, mut simulated) = (0, 0);
    for (triaxial, at_s) in [(false, 50.0), (true, 50.0), (true, 10.22)] {
        let start = flight(&spinner, triaxial);
        let (commands, directions) = (Commands::none(), directions());
        let mut plant = Plant::start(&spinner, &start, directions, commands, 0.0).unwrap();
        plant.advance(&spinner, at_s).unwrap();
        let bytes = postcard::to_allocvec(&plant).unwrap();
        for _ in 0..1500 {
            let mut torn = bytes.clone();
            for _ in 0..1 + random() % 3 {
                let at = random() % torn.len();
                torn[at] = random() as u8;
            }
            let Ok(mut other) = postcard::from_bytes::<Plant>(&torn) else { continue };
            if fmi_export::check_finite(&other).is_err() || SpinPlant::check_state(&spinner, &other).is_err()
            {
                refused += 1;
                continue;
            }
            simulated += 1;
            let now_s = other.time_s();
            let _ = other.advance(&spinner, now_s + 30.0);
            let _ = (Outputs::of(&other, &spinner), Rates::of(&other, &spinner), Predictions::of(&other));
        }
    }
    assert!(refused > 50 && simulated > 500, "{refused} {simulated}");
}

fn directions() -> Directions {
    Directions {
        sun_inertial: nalgebra::Vector3::new(0.6, 0.0, 0.8),
        earth_inertial: -nalgebra::Vector3::z(),
        star_inertial: nalgebra::Vector3::x(),
    }
}

fn flight(spinner: &spinner::Spinner, triaxial: bool) -> Start {
    Start {
        inertia_kg_m2: [if triaxial { 230.0 } else { 238.58 }, 238.58, 353.82],
        products_kg_m2: [0.0; 3],
        mass_source: MassSource::Fixed,
        propellant_kg: 97.5,
        execution: Default::default(),
        spin_rate_rad_s: std::f64::consts::PI / 6.0,
        attitude: [0.0, 0.0, 0.0, 1.0],
        nutation_rad: 1e-3,
        nutation_phase_rad: 0.0,
        damper_time_constant_s: 34_200.0,
        burn: Some(BurnRequest {
            shape: Shape::Uniform,
            timing: Timing::TruePhase,
            start_s: 0.0,
            thruster: 8,
            opposite_thruster: 10,
            group: String::new(),
            pulse_width_s: 2.0,
            turns_per_pulse: 1.0,
            count: 10,
            angle_rad: 0.0,
            resolution_s: 0.032,
            target_inertial: nalgebra::Vector3::x(),
            spin_rate_error: 0.0,
            ratio_error: 0.0,
            ratio_uncertainty: 0.0,
            max_nutation_rad: 0.0,
            max_duration_s: 0.0,
        }),
        l1: triaxial.then(|| L1Ephemeris { orbit: spinner.l1_orbit, phases: L1Phases::default() }),
        sampling: Sampling::Clock,
        nominal_rate_rad_s: std::f64::consts::PI / 6.0,
        seed: 3,
        work_limit: 10_000_000,
    }
}
