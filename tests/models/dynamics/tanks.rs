//! Tanks that run dry: however little they hold, pulses, dumps and burns take what there is, and nothing from nothing.

use client::short_or_long;
use models::MomentumPlant;
use nalgebra::{Matrix3, Vector3};

use super::super::named_model::{NamedModel, assert_same};
use super::super::random::RandomNumbers;
use super::super::spacecraft::{EXHAUST_M_S, SIMPLE, couples};
use super::{DARK, PlantInstance, Start, held_momentum, inertia, initialize, to_inertial};

const FULL: &str = include_str!("../../../fmu-src/resources/messenger-full.toml");
const NO_DUMPS: Start<'_> =
    &[("dump.threshold[1]", 1e9), ("dump.threshold[2]", 1e9), ("dump.threshold[3]", 1e9)];
/// Thrusters by their tank.
const THRUSTERS: [core::ops::RangeInclusive<usize>; 2] = [1..=5, 6..=17];
/// The greatest speed of what leaves a nozzle, in m/s.
const FASTEST_M_S: f64 = 9.806_65 * 320.0;

fn full() -> NamedModel<MomentumPlant> {
    NamedModel::with("messenger-full.toml", FULL)
}

/// A flight whose tanks hold this, in kg, and which has a momentum of about 2 N m s to dump.
fn begin<'a>(
    named: &'a NamedModel<MomentumPlant>,
    source: f64,
    [main_kg, auxiliary_kg]: [f64; 2],
) -> PlantInstance<'a> {
    let tanks: Start<'_> = &[("tank[1].propellant", main_kg), ("tank[2].propellant", auxiliary_kg)];
    let ideal: Start<'_> = &[("start.momentum[1]", 1.5), ("start.momentum[3]", -1.2)];
    let by_torque: Start<'_> = &[("wheel[1].startMomentum", 2.0), ("start.q[4]", 1.0)];
    let held = if source < 3.0 { ideal } else { by_torque };
    initialize(named, &[&[("attitude.source", source)], DARK, NO_DUMPS, tanks, held])
}

fn left_kg(flight: &PlantInstance<'_>) -> [f64; 2] {
    [1, 2].map(|k| flight.real(&format!("tank[{k}].propellantLeft")))
}

fn momentum(flight: &PlantInstance<'_>) -> Vector3<f64> {
    flight.vector("momentum.inertial")
}

/// J w and the rotors' momentum, the inertia without the propellant that is used, which stood in points.
fn formed_momentum(flight: &PlantInstance<'_>, used_kg: [f64; 2]) -> Vector3<f64> {
    let places_m = [Vector3::zeros(), Vector3::new(0.0, 0.0, -0.3)];
    let steiner = |r: &Vector3<f64>| Matrix3::from_diagonal_element(r.norm_squared()) - r * r.transpose();
    let mut moments = (700.0, Vector3::zeros(), inertia());
    for (used_kg, place_m) in used_kg.iter().zip(&places_m) {
        moments.0 -= used_kg;
        moments.1 -= place_m * *used_kg;
        moments.2 -= steiner(place_m) * *used_kg;
    }
    let inertia_kg_m2 = moments.2 - steiner(&(moments.1 / moments.0)) * moments.0;
    to_inertial(flight) * (inertia_kg_m2 * flight.vector("attitude.rate") + held_momentum(flight))
}

/// One step, after which no tank holds less than nothing or less than it held when it fed no longer.
fn step(flight: &mut PlantInstance<'_>, loads_kg: [f64; 2]) {
    let before_kg = left_kg(flight);
    let fed = [1, 2].map(|k| flight.boolean(&format!("tank[{k}].feeds")));
    let end_s = flight.time_s() + 1.0;
    flight.step_to(end_s).unwrap_or_else(|error| panic!("{loads_kg:?} at {end_s}: {error}"));
    let after_kg = left_kg(flight);
    for (k, thrusters) in THRUSTERS.into_iter().enumerate() {
        assert!(after_kg[k] >= 0.0 && after_kg[k] <= before_kg[k], "{before_kg:?} {after_kg:?}");
        assert!(fed[k] || after_kg[k] == before_kg[k], "{before_kg:?} {after_kg:?}");
        if !flight.boolean(&format!("tank[{}].feeds", k + 1)) {
            assert!(thrusters.clone().all(|it| flight.real(&format!("thruster[{it}].thrust")) == 0.0));
        }
    }
    let used_kg: f64 = loads_kg.iter().zip(after_kg).map(|(load, left)| load - left).sum();
    assert!((flight.real("propellant.used") - used_kg).abs() < 1e-15, "{loads_kg:?}");
    assert!((flight.real("mass") + used_kg - 700.0).abs() < 1e-12);
    let delta_v = flight.vector("deltaV").norm();
    assert!(delta_v <= -FASTEST_M_S * (-used_kg / 700.0).ln_1p() + 1e-15, "{delta_v} m/s of {used_kg} kg");
}

/// A dump, then a burn with pulses and another dump; the greatest share of the momentum that is not the impulse of the thrusters
/// since a dump began, or not that of body and rotors where no thruster fires.
fn flown(named: &NamedModel<MomentumPlant>, source: f64, random: &mut RandomNumbers) -> f64 {
    let loads_kg = [0, 1].map(|_| match random.below(8) {
        0 => 0.0,
        _ => 10_f64.powf(random.between(-8.0, 0.0)),
    });
    let mut flight = begin(named, source, loads_kg);
    let (burn_s, pulsed) = (random.between(18.0, 30.0), 1 + random.below(17));
    flight.set("thrust.request", random.whole(1, 3));
    flight.set_elements("dump.target", &random.direction().map(|it| 0.5 * it));
    let mut worst = 0.0_f64;
    let mut begun = (0, to_inertial(&flight), momentum(&flight));
    for second in 0..40 {
        let is_requested = second % 20 > 0;
        flight.set("dump.request", f64::from(u8::from(is_requested)));
        if second % 20 == 1 {
            begun = (flight.integer("dump.count"), to_inertial(&flight), momentum(&flight));
        }
        let pushes = (15..36).contains(&second);
        flight.set("thrust.command", f64::from(u8::from(pushes)));
        flight.set("thrust.stop", burn_s);
        flight
            .set(&format!("thruster[{pulsed}].onTime"), if pushes { random.between(0.0, 1.2) } else { 0.0 });
        let (before, used_kg) = (momentum(&flight), flight.real("propellant.used"));
        step(&mut flight, loads_kg);
        let now = momentum(&flight);
        let size = 8.0 + now.norm();
        let (count, to_inertial, at_begin) = begun;
        let has_begun = flight.integer("dump.count") > count;
        if has_begun && (source < 3.0 || second < 15 || flight.boolean("dump.active")) {
            let dumped = to_inertial * flight.vector("dump.impulse");
            worst = worst.max((now - at_begin - dumped).norm() / size);
        }
        let is_fed = flight.real("propellant.used") > used_kg;
        assert!(is_fed || (now - before).norm() < 1e-14 * size, "{loads_kg:?} at {second}");
        assert!(source > 2.0 || !is_fed || has_begun && second % 20 == 1, "{loads_kg:?} at {second}");
        if source > 2.0 && (1..=17).all(|k| flight.real(&format!("thruster[{k}].thrust")) == 0.0) {
            let left_kg = left_kg(&flight);
            let formed = formed_momentum(&flight, [0, 1].map(|k| loads_kg[k] - left_kg[k]));
            worst = worst.max((now - formed).norm() / size);
        }
    }
    worst
}

#[test]
fn no_load_of_the_tanks_ends_a_flight_or_gives_more_than_it_holds() {
    let named = full();
    let mut random = RandomNumbers(7);
    for source in [1.0, 2.0, 3.0, 4.0] {
        let flights = (0..short_or_long(6, 200)).map(|_| flown(&named, source, &mut random));
        let worst = flights.fold(0.0, f64::max);
        println!("attitude.source {source}: {worst:.1e} of the momentum is not accounted for");
        assert!(worst < 1e-12, "{source}: {worst}");
    }
}

/// The auxiliary tank alone feeds thrusters that give torque about every axis, either way.
#[test]
fn a_dump_goes_as_far_as_there_is_propellant() {
    let target = Vector3::new(0.1, 0.2, -0.1);
    for source in [1.0, 2.0, 3.0, 4.0] {
        let dump = |loads_kg: [f64; 2]| {
            let named = full();
            let mut flight = begin(&named, source, loads_kg);
            flight.step_to(1.0).unwrap();
            let before = momentum(&flight);
            let to_inertial = to_inertial(&flight);
            let (mut after, mut used_kg) = (Vec::new(), Vec::new());
            for request in 0..2 {
                flight.set_elements("dump.target", target.iter());
                flight.set("dump.request", 1.0);
                flight.simulate_to(200.0 * f64::from(request + 1), 1.0).unwrap();
                flight.set("dump.request", 0.0);
                flight.simulate_to(200.0 * f64::from(request + 1) + 1.0, 1.0).unwrap();
                assert!(!flight.boolean("dump.active"));
                after.push(momentum(&flight));
                used_kg.push(flight.real("propellant.used"));
            }
            let said =
                named.warnings().iter().filter(|it| it.contains("nothing feeds the thrusters")).count();
            let left = (after[0] - to_inertial * target).norm() / (before - to_inertial * target).norm();
            assert!(left < 0.1 || after[0] == after[1], "a second dump {source} {loads_kg:?}");
            (left, flight.integer("dump.count"), used_kg[0], said)
        };
        let (left, count, needed_kg, said) = dump([60.0, 9.0]);
        // By pulses less than the shortest one is left.
        let allowed = if source > 2.0 { 0.1 } else { 1e-12 };
        assert!(left < allowed && (count, said) == (2, 0), "{source}: {left} {count} {said}");
        assert_eq!(dump([0.0, 0.0]), (1.0, 0, 0.0, 1), "{source}");
        let (left, count, used_kg, said) = dump([0.0, 1e-3]);
        let expected = 1.0 - 1e-3 / needed_kg;
        assert!((left - expected).abs() < allowed, "{source}: {left} {expected}");
        assert_eq!((count, used_kg, said), (1, 1e-3, 1), "{source} {left}");
    }
}

/// Couples of 1 m, weak ones from the first tank and strong ones from the second.
#[test]
fn the_next_thrusters_dump_what_the_weakest_are_not_fed_for() {
    let second = "[[tanks]]\nname = \"second\"\nposition_m = [0.0, 0.0, 0.0]\npropellant_kg = 1.0\n";
    let strong = couples("tank = \"second\"").replace("force_n = 5.0", "force_n = 22.0");
    let file = format!("{}{second}{}{strong}", SIMPLE, couples("tank = \"first\""));
    let file = file.replacen("[[tanks]]", "[[tanks]]\nname = \"first\"", 1);
    let named = NamedModel::<MomentumPlant>::with("two tanks", &file);
    let ideal: Start<'_> = &[("start.momentum[1]", 2.0)];
    let turning: Start<'_> = &[("start.rate[1]", 0.01), ("start.q[4]", 1.0)];
    for (source, held) in [(2.0, ideal), (4.0, turning)] {
        let tank: Start<'_> =
            &[("attitude.source", source), ("tank[1].propellant", 3e-4), ("dump.torque", 0.5)];
        let mut flight = initialize(&named, &[tank, held, DARK, NO_DUMPS]);
        flight.step_to(1.0).unwrap();
        flight.set("dump.request", 1.0);
        flight.simulate_to(30.0, 1.0).unwrap();
        assert_eq!(left_kg(&flight)[0], 0.0);
        let off = flight.real("propellant.used") / (2.0 / EXHAUST_M_S) - 1.0;
        // Jet damping takes some of the momentum of a body that turns.
        let allowed = if source < 3.0 { 1e-12 } else { 2e-5 };
        assert!(off.abs() < allowed && momentum(&flight).norm() < allowed, "{off} {}", momentum(&flight));
        let unserved = named.warnings().iter().filter(|it| it.contains("thrusters")).count();
        assert_eq!((flight.integer("dump.count"), unserved), (1, 0), "{:?}", named.warnings());
    }
}

/// While thrusters burn, dump, and in the tail-off after each.
#[test]
fn a_state_with_valves_open_is_read_back_and_goes_on_alike() {
    let named = full();
    for source in [3.0, 4.0] {
        let mut flight = begin(&named, source, [60.0, 9.0]);
        let mut seen = [false; 4];
        for step in 1..=900 {
            let time_s = 0.004 * f64::from(step);
            flight.set("dump.request", f64::from(u8::from(step > 250)));
            flight.set("thrust.request", 2.0);
            flight.set("thrust.command", f64::from(u8::from(step < 200)));
            flight.set("thruster[7].onTime", if step % 20 == 10 { 0.004 } else { 0.0 });
            flight.step_to(time_s).unwrap();
            let thrust_n = flight.real("thruster[2].thrust");
            let is_burning = flight.boolean("thrust.active");
            let modes =
                [is_burning, flight.boolean("dump.active"), thrust_n > 0.0 && !is_burning, thrust_n > 0.0];
            let is_new = modes.iter().zip(&seen).any(|(mode, seen)| *mode && !seen);
            if is_new || step % 100 == 0 {
                let mut restored = flight.with_state(&flight.state_bytes()).expect("a state of a flight");
                let mut whole = flight.restored();
                for it in [&mut restored, &mut whole] {
                    it.simulate_to(time_s + 0.1, 0.05).unwrap();
                }
                assert_same(&whole, &restored);
            }
            seen.iter_mut().zip(modes).for_each(|(seen, mode)| *seen |= mode);
        }
        assert_eq!(seen, [true; 4], "{source}");
    }
}
