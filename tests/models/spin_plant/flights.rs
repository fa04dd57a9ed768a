//! SpinPlant through FMI's functions does what its physics does, on any grid.

use client::StatePointer;
use model_description::Status;
use models::SpinPlant;

use super::driver::Spinner;
use crate::named_model::{NamedModel, assert_cuts_change_nothing};

const PERIOD_S: f64 = 12.0;

#[test]
fn the_default_flight_is_the_papers_manoeuvre() {
    let mut spinner = Spinner::new().start();
    let mut most: f64 = 0.0;
    for i in 1..=140 {
        spinner.to(10.0 * f64::from(i));
        most = most.max(spinner.real("nutation.angle"));
    }
    assert_eq!(spinner.integer("burn.pulsesFired"), 114);
    assert!(spinner.boolean("burn.done") && !spinner.boolean("burn.active"));
    assert!((spinner.real("momentum.displacement").to_degrees() - 2.0).abs() < 0.02);
    let envelope = spinner.real("nutation.envelope");
    assert!(most < envelope && most > 0.9 * envelope, "{most} {envelope}");
    assert!((spinner.real("nutation.predicted") / spinner.real("nutation.angle") - 1.0).abs() < 0.1);
    assert!((spinner.real("thruster[8].arm") - 0.40).abs() < 1e-12);
}

#[test]
fn neither_cuts_nor_saving_change_a_bit() {
    let named = NamedModel::<SpinPlant>::shipped();
    let steps_s = [3.7, 0.032, 0.7, 12.0, 280.0];
    assert_cuts_change_nothing(|| named.initialize(0.0, &[]).unwrap(), [60.0], &[0.4, 0.001], |_| {});
    assert_cuts_change_nothing(|| named.initialize(0.0, &[]).unwrap(), [1400.0], &steps_s, |_| {});
    // In the middle of pulses.
    let sets = [("burn.pulseWidth", 1.0), ("inertia[1]", 230.0), ("burn.count", 20.0), ("burn.timing", 3.0)];
    let initialize = || named.initialize(0.0, &sets).unwrap();
    let edge_s = initialize().real("burn.nextEdge");
    let ends_s = (0..12).map(|turn| edge_s + 0.4 + PERIOD_S * f64::from(turn));
    let mut active = 0;
    assert_cuts_change_nothing(initialize, ends_s, &[3.7], |flight| {
        active += i32::from(flight.boolean("burn.active") && flight.boolean("thruster[8].active"));
    });
    assert!(active > 3, "{active}");
}

/// Slow valves, scatter, products of inertia, and pulses from outside beside the burn's; saved in the midst of the rise, of the
/// full thrust and of the tail-off.
#[test]
fn a_state_saved_in_a_ramp_of_the_thrust_continues_to_the_bit() {
    let named = NamedModel::<SpinPlant>::shipped();
    let valves = [("riseTime", 0.4), ("tailOffTime", 0.6), ("minOnTime", 0.02), ("scatter", 0.1)];
    let valves: Vec<(String, f64)> =
        (1..=10).flat_map(|k| valves.map(|(name, value)| (format!("thruster[{k}].{name}"), value))).collect();
    let mut sets: Vec<(&str, f64)> = valves.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    sets.extend([
        ("burn.pulseWidth", 1.0),
        ("productsOfInertia[2]", 3.0),
        ("burn.count", 6.0),
        ("burn.timing", 3.0),
    ]);
    let initialize = || named.initialize(0.0, &sets).unwrap();
    let edge_s = initialize().real("burn.nextEdge");
    let shares = [(0.1, 0.25), (0.6, 1.0), (1.2, 0.5)].map(|(into_s, share)| (edge_s + into_s, share));
    let ends_s = shares.map(|(at_s, _)| at_s).into_iter().chain([100.0]);
    assert_cuts_change_nothing(initialize, ends_s, &[7.0, 0.7], |flight| {
        let Some((_, share)) = shares.iter().find(|(at_s, _)| *at_s == flight.time_s()) else { return };
        let scattered = flight.vector("force.thruster").norm() / (4.448 * share);
        assert!((scattered - 1.0).abs() < 0.4 && scattered != 1.0, "{share}: {scattered}");
    });
}

#[test]
fn a_pulse_shorter_than_its_valve_opens_is_flagged() {
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).set("thruster[8].minOnTime", 0.1).start();
    spinner.put("thruster[8].onTime", 0.096);
    spinner.to(1.0);
    assert!(spinner.boolean("thruster[8].tooShort") && spinner.real("propellant.used") == 0.0);
    spinner.put("thruster[8].onTime", 0.128);
    spinner.to(2.0);
    assert!(!spinner.boolean("thruster[8].tooShort") && spinner.real("propellant.used") > 0.0);
}

#[test]
fn held_thrusters_and_pulses_within_steps_have_the_same_edges() {
    let simulate = |drive: &dyn Fn(&mut Spinner)| {
        let mut spinner = Spinner::new().set_integer("burn.plan", 4).start();
        drive(&mut spinner);
        spinner.to(40.0);
        [
            "momentum.inertial[1]",
            "momentum.inertial[2]",
            "nutation.angle",
            "propellant.used",
            "deltaV[1]",
            "deltaV[2]",
        ]
        .map(|name| spinner.real(name))
    };
    let held = simulate(&|spinner| {
        spinner.to(9.6);
        spinner.fire(8, true);
        for i in 1..=10 {
            spinner.to(9.6 + 0.32 * f64::from(i) / 10.0);
        }
        spinner.fire(8, false);
    });
    // 9.59 and 0.33 s are rounded to 32 ms: 300 and 10 of them.
    let pulsed = simulate(&|spinner| {
        spinner.put("thruster[8].onDelay", 9.59);
        spinner.put("thruster[8].onTime", 0.33);
        spinner.to(12.0);
        spinner.put("thruster[8].onTime", 0.0);
    });
    for (a, b) in held.iter().zip(pulsed) {
        assert!((a - b).abs() < 1e-12 * a.abs().max(1.0), "{held:?} {pulsed:?}");
    }
    assert!(held[2] > 1e-4);
}

#[test]
fn a_pulse_beyond_its_step_is_cut_with_a_warning() {
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).start();
    spinner.put("thruster[1].onTime", 3.2);
    spinner.fmu.drain_messages();
    spinner.to(1.0);
    let messages = spinner.fmu.drain_messages();
    assert!(messages.iter().any(|m| m.text.contains("IA") && m.text.contains("cut")), "{messages:?}");
    spinner.put("thruster[1].onTime", 0.0);
    spinner.to(2.0);
    let used = spinner.real("propellant.used");
    assert!((used - 4.448 / (220.0 * 9.80665)).abs() < 1e-12);
}

#[test]
fn an_outside_torque_with_a_slope_is_integrated() {
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).set("damper.timeConstant", 0.0).start();
    let before = spinner.real("spin.rate");
    spinner.put("torque.applied[3]", 0.5);
    let reference = spinner.at("torque.applied[3]");
    assert_eq!(spinner.fmu.set_input_derivatives(&[reference], &[1], &[0.2]), Status::Ok);
    spinner.to(10.0);
    let after = spinner.real("spin.rate");
    assert!((after - before - (5.0 + 10.0) / 353.82).abs() < 1e-12);
    // The slope held for that step alone.
    spinner.to(20.0);
    assert!((spinner.real("spin.rate") - after - 5.0 / 353.82).abs() < 1e-12);
}

#[test]
fn output_derivatives_are_the_slopes_of_the_outputs() {
    slopes_agree(0.0, 0.0);
    // In a long rise of the thrust, about principal axes that are not the body's.
    slopes_agree(20.0, 5.0);
}

fn slopes_agree(rise_s: f64, product_kg_m2: f64) {
    let mut spinner = Spinner::new()
        .set_integer("burn.plan", 4)
        .set("start.nutation", 0.05)
        .set("inertia[1]", 225.0)
        .set("damper.timeConstant", 300.0)
        .set("thruster[2].riseTime", rise_s)
        .set("productsOfInertia[1]", product_kg_m2)
        .set("productsOfInertia[3]", -product_kg_m2)
        .start();
    spinner.fire(2, true);
    spinner.put("torque.applied[1]", 0.3);
    spinner.to(7.0);
    let mut state = StatePointer::null();
    assert_eq!(spinner.fmu.get_state(&mut state), Status::Ok);
    let names = [
        "attitude.q[1]",
        "attitude.q[4]",
        "attitude.rate[1]",
        "attitude.rate[3]",
        "momentum.inertial[2]",
        "momentum.body[1]",
        "momentum.displacement",
        "spinAxis.inertial[1]",
        "spinAxis.displacement",
        "spin.rate",
        "nutation.angle",
        "nutation.phase",
        "sun.angle",
        "earth.angle",
        "starTracker.declinationTrue",
        "deltaV[2]",
        "energy",
        "propellant.used",
        "propellant.left",
        "mass",
        "force.thruster[1]",
        "torque.thruster[3]",
    ];
    let references: Vec<u32> = names.iter().map(|name| spinner.at(name)).collect();
    let mut slopes = vec![0.0; names.len()];
    let orders = vec![1; names.len()];
    assert_eq!(spinner.fmu.get_output_derivatives(&references, &orders, &mut slopes), Status::Ok);
    let mut sample = |time_s: f64| {
        assert_eq!(spinner.fmu.set_state(&state), Status::Ok);
        spinner.time_s = 7.0;
        spinner.to(time_s);
        names.map(|name| spinner.real(name))
    };
    let h = 0.01;
    let [y1, y2, y3, y4] = [1.0, 2.0, 3.0, 4.0].map(|k| sample(7.0 + k * h));
    assert_eq!(spinner.fmu.set_state(&state), Status::Ok);
    let y0 = names.map(|name| spinner.real(name));
    for (i, name) in names.iter().enumerate() {
        // One-sided differences of the fourth order.
        let slope = (-25.0 * y0[i] + 48.0 * y1[i] - 36.0 * y2[i] + 16.0 * y3[i] - 3.0 * y4[i]) / (12.0 * h);
        assert!((slope - slopes[i]).abs() < 2e-7 * slope.abs().max(1.0), "{name}: {} {slope}", slopes[i]);
    }
}

#[test]
fn on_the_l1_orbit_the_earth_leaves_the_antenna_by_the_lines_rate() {
    let mut spinner = Spinner::new().set_integer("burn.plan", 4).set_integer("geometry.source", 2);
    for axis in 1..=3 {
        spinner.put(&format!("geometry.amplitude[{axis}]"), 0.0);
    }
    // The spin axis on the Sun at longitude 0 from the Earth: along -X.
    for (i, q) in [0.0, -0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt()].into_iter().enumerate() {
        spinner.put(&format!("start.q[{}]", i + 1), q);
    }
    let mut spinner = spinner.start();
    assert!(spinner.real("sun.angle") < 1e-7 && spinner.real("earth.angle") < 1e-7);
    spinner.to(3.0 * 86_400.0);
    assert!((spinner.real("earth.angle").to_degrees() - 3.0 * 0.9829).abs() < 1e-6);
    assert!(!spinner.boolean("limit.earthAngleViolated"));
    spinner.to(4.0 * 86_400.0);
    assert!(spinner.boolean("limit.earthAngleViolated") && spinner.boolean("limit.anyViolated"));
}

#[test]
fn the_seed_chooses_the_noise_and_nothing_else() {
    let seen = |seed: i32| {
        let mut spinner = Spinner::new().set_integer("burn.plan", 4).set_integer("seed", seed).start();
        spinner.to(600.0);
        let noisy = ["sunSensor.angle", "starTracker.declination"].map(|name| spinner.real(name).to_bits());
        (noisy, ["sun.angle", "starTracker.declinationTrue"].map(|name| spinner.real(name).to_bits()))
    };
    let (one, other) = (seen(7), seen(8));
    assert_eq!(one, seen(7));
    assert!(one.0[0] != other.0[0] && one.0[1] != other.0[1]);
    assert_eq!(one.1, other.1);
}

/// Sampled every eight spins, a ratio of 1.483 shows 11.864 turns as 0.136 of one the other way.
#[test]
fn nutation_shows_in_the_time_the_paper_gives() {
    let mut spinner = Spinner::new()
        .set_integer("burn.plan", 4)
        .set("inertia[1]", 353.82 / 1.483)
        .set("inertia[2]", 353.82 / 1.483)
        .start();
    let found_s = spinner.real("starTracker.observationTime");
    assert!((found_s - 8.0 * 12.0 / 0.136).abs() < 1e-6, "{found_s}");
}
