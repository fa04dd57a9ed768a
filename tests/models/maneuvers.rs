//! A maneuver adds its velocity at one time, takes its propellant, brings the dump that goes with it, and is refused by name.

use models::MomentumPlant;
use nalgebra::Vector3;
use physics::constants::GM_MERCURY_M3_S2 as MU;

use super::named_model::{NamedInstance, NamedModel, assert_cuts_change_nothing, assert_same};

pub(crate) const MESSENGER_FULL: &str = include_str!("../../fmu-src/resources/messenger-full.toml");
const STANDARD_GRAVITY_M_S2: f64 = 9.80665;
const LVA_ISP_S: f64 = 316.0;
const C22_ISP_S: f64 = 234.0;
/// Items of `maneuver.thrusters`.
const NONE: f64 = 0.0;
const LVA: f64 = 1.0;
const C22: f64 = 2.0;
const MONO4: f64 = 3.0;

/// Errors of execution and shifts of the centre of mass.
pub(crate) const ERRORS: [(&str, f64); 5] = [
    ("maneuver.magnitudeError", 0.01),
    ("maneuver.directionError", 5e-3),
    ("spacecraft.centerOfMassShift[1]", 2e-3),
    ("spacecraft.centerOfMassShift[2]", 1e-3),
    ("spacecraft.centerOfMassShift[3]", 3e-3),
];

type Plant<'m> = NamedInstance<'m, MomentumPlant>;

pub(crate) fn full() -> NamedModel<MomentumPlant> {
    NamedModel::with("messenger-full.toml", MESSENGER_FULL)
}

fn with<'a>(parts: &[&[(&'a str, f64)]]) -> Vec<(&'a str, f64)> {
    parts.concat()
}

/// A maneuver in a step that ends so much later.
fn maneuver(flight: &mut Plant<'_>, delta_v: &Vector3<f64>, step_s: f64) {
    flight.set("maneuver.request", 0.0);
    flight.step_to(flight.time_s() + 1.0).unwrap();
    flight.set("maneuver.request", 1.0);
    flight.set_elements("maneuver.deltaV", delta_v.iter());
    flight.step_to(flight.time_s() + step_s).unwrap();
}

/// The same to this share of it.
fn assert_near(found: f64, expected: f64, share: f64) {
    assert!((found - expected).abs() <= share * expected.abs(), "{found:e} instead of {expected:e}");
}

/// Energy in m2/s2 and angular momentum in m2/s of a mass unit.
fn integrals(position: &Vector3<f64>, velocity: &Vector3<f64>) -> (f64, Vector3<f64>) {
    (0.5 * velocity.norm_squared() - MU / position.norm(), position.cross(velocity))
}

fn state(flight: &Plant<'_>) -> [Vector3<f64>; 2] {
    ["position", "velocity"].map(|name| flight.vector(name))
}

#[test]
fn it_happens_where_the_step_begins_and_once() {
    let named = full();
    let mut flight = named.initialize(100.0, &[("start.momentum[2]", 1.5)]).unwrap();
    assert_eq!((flight.integer("maneuver.count"), flight.real("maneuver.lastTime")), (0, -1.0));
    flight.set_elements("dump.target", &[0.1, -0.2, 0.3]);
    flight.step_to(7200.0).unwrap();
    let before = flight.vector("deltaV");
    let delta_v = Vector3::new(1.0, -2.0, 0.5);
    flight.set("maneuver.request", 1.0);
    flight.set_elements("maneuver.deltaV", delta_v.iter());
    flight.step_to(7200.0 + 1e-3).unwrap();
    assert_eq!((flight.integer("maneuver.count"), flight.real("maneuver.lastTime")), (1, 7200.0));
    assert_eq!(flight.vector("maneuver.executed"), delta_v);
    // The dump pushes a little too.
    let dumped = flight.vector("dump.deltaV");
    assert!((flight.vector("deltaV") - before - delta_v - dumped).norm() < 1e-9, "{dumped:?}");
    assert_eq!((flight.integer("dump.count"), flight.real("dump.lastTime")), (1, 7200.0));
    assert!((flight.vector("momentum.body") - Vector3::new(0.1, -0.2, 0.3)).amax() < 1e-6);
    // What stays set is no new request.
    flight.step_to(20_000.0).unwrap();
    assert_eq!((flight.integer("maneuver.count"), flight.integer("dump.count")), (1, 1));
}

#[test]
fn without_its_dump_it_leaves_the_momentum() {
    let named = full();
    let sets = [("start.momentum[2]", 1.5), ("maneuver.dump", 0.0)];
    let [mut flight, mut other] = [0, 1].map(|_| named.initialize(0.0, &sets).unwrap());
    for flight in [&mut flight, &mut other] {
        flight.step_to(7200.0).unwrap();
    }
    flight.set("maneuver.request", 1.0);
    flight.set("maneuver.deltaV[1]", 3.0);
    for flight in [&mut flight, &mut other] {
        flight.step_to(7201.0).unwrap();
    }
    assert_eq!((flight.integer("maneuver.count"), flight.integer("dump.count")), (1, 0));
    // In a second the torque, 1e-5 N m, is another by at most itself.
    assert!((flight.vector("momentum.inertial") - other.vector("momentum.inertial")).norm() < 1e-4);
}

#[test]
fn propellant_is_that_of_the_rocket_equation() {
    let named = full();
    let delta_v = Vector3::new(3.0, 4.0, -12.0);
    // Thrust of each set is along one axis, so that its specific impulse is its thrusters'.
    for (set, isp_s, tank) in [(LVA, LVA_ISP_S, 1), (C22, C22_ISP_S, 1), (NONE, f64::INFINITY, 1)] {
        let sets = [("maneuver.thrusters", set), ("maneuver.dump", 0.0)];
        let mut flight = named.initialize(0.0, &sets).unwrap();
        let mut mass_kg = flight.real("mass");
        for _ in 0..2 {
            maneuver(&mut flight, &delta_v, 600.0);
            mass_kg *= (-13.0 / (STANDARD_GRAVITY_M_S2 * isp_s)).exp();
            assert_near(flight.real("mass"), mass_kg, 1e-13);
        }
        let used_kg = named.initialize(0.0, &sets).unwrap().real("mass") - mass_kg;
        let left_kg = flight.real(&format!("tank[{tank}].propellantLeft"));
        let loaded_kg = flight.real(&format!("tank[{tank}].propellant"));
        assert!((flight.real("propellant.used") - used_kg).abs() < 1e-10);
        assert!((loaded_kg - left_kg - used_kg).abs() < 1e-10);
    }
}

#[test]
fn a_file_without_thrusters_takes_no_propellant() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &[]).unwrap();
    assert_eq!(flight.integer("maneuver.thrusters"), C22 as i32);
    let mass_kg = flight.real("mass");
    maneuver(&mut flight, &Vector3::new(0.0, 10.0, 0.0), 600.0);
    assert_eq!((flight.integer("maneuver.count"), flight.real("mass")), (1, mass_kg));
}

#[test]
fn the_orbit_after_it_has_the_energy_and_angular_momentum_of_the_new_velocity() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // In closed form, and integrated without flattening, tide, light and heat.
    let alone = [("planet.j2", 0.0), ("orbit.sunTide", 0.0), ("orbit.radiationFeedback", 0.0)];
    let integrated = with(&[&[("orbit.dynamics", 2.0)], &alone]);
    for (sets, tolerance) in [(vec![], 1e-11), (integrated, 1e-10)] {
        let mut flight = named.initialize(0.0, &sets).unwrap();
        for (end_s, delta_v) in [
            (5000.0, Vector3::new(20.0, 0.0, -5.0)),
            (40_000.0, Vector3::new(-3.0, 30.0, 1.0)),
            (50_000.0, Vector3::new(0.0, -8.0, 9.0)),
        ] {
            flight.step_to(end_s).unwrap();
            let [position, velocity] = state(&flight);
            let (energy, momentum) = integrals(&position, &(velocity + delta_v));
            flight.set("maneuver.request", 1.0);
            flight.set_elements("maneuver.deltaV", delta_v.iter());
            for later_s in [1e-3, 3000.0, 8000.0] {
                flight.step_to(end_s + later_s).unwrap();
                flight.set("maneuver.request", 0.0);
                let [position, velocity] = state(&flight);
                let found = integrals(&position, &velocity);
                assert_near(found.0, energy, tolerance);
                assert!((found.1 - momentum).norm() < tolerance * momentum.norm());
            }
        }
        assert_eq!(flight.integer("maneuver.count"), 3);
    }
}

#[test]
fn downlinks_and_periapses_are_those_of_the_new_orbit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // The integrated orbit finds its periapses as it passes them.
    let alone = [("planet.j2", 0.0), ("orbit.sunTide", 0.0), ("orbit.radiationFeedback", 0.0)];
    let integrated = with(&[&[("orbit.dynamics", 2.0)], &alone]);
    for every in [1.0, 2.0, 3.0] {
        let sets = [("guided.downlinkEvery", every), ("guided.slewRate", 3e-3)];
        let mut closed = named.initialize(0.0, &sets).unwrap();
        let mut found = named.initialize(0.0, &with(&[&integrated, &sets])).unwrap();
        let mut downlinks = 0;
        for number in 1..=200 {
            for flight in [&mut closed, &mut found] {
                // One along the velocity, one against it, one at a periapsis nearly.
                let share = match number {
                    21 => 0.02,
                    70 => -0.03,
                    111 => 0.01,
                    _ => 0.0,
                };
                flight.set("maneuver.request", f64::from(u8::from(share != 0.0)));
                if share != 0.0 {
                    let delta_v = flight.vector("velocity") * share;
                    flight.set_elements("maneuver.deltaV", delta_v.iter());
                }
                // Beside whole orbits, where rounding decides which one it is.
                flight.step_to(f64::from(number) * 3600.0 + 17.0).unwrap();
            }
            let apart_m = (closed.vector("position") - found.vector("position")).norm();
            assert!(apart_m < 1.0, "{number}: {apart_m}");
            let [since_s, other_s] = [&closed, &found].map(|it| it.real("orbit.timeSincePeriapsis"));
            assert!((since_s - other_s).abs() < 1e-2, "{number}: {since_s} {other_s}");
            let turned = closed.to_inertial("attitude.q").angle_to(&found.to_inertial("attitude.q"));
            assert!(turned < 1e-5, "{number}: {turned}");
            downlinks += i32::from(closed.vector("sun.direction").y < -0.999_999);
        }
        assert!(downlinks > 10, "{downlinks}");
    }
}

#[test]
fn a_place_that_is_given_stays_and_one_that_is_given_anew_rules() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let place = [("orbit.position[1]", 4e6), ("orbit.velocity[2]", 3500.0)];
    let mut held = named.initialize(0.0, &with(&[&[("orbit.source", 3.0)], &place])).unwrap();
    maneuver(&mut held, &Vector3::new(0.0, 5.0, 0.0), 600.0);
    assert_eq!(state(&held), [Vector3::new(4e6, 0.0, 0.0), Vector3::new(0.0, 3500.0, 0.0)]);
    assert_eq!(held.vector("maneuver.executed"), Vector3::new(0.0, 5.0, 0.0));
    let mut moving = named.initialize(0.0, &with(&[&[("orbit.source", 2.0)], &place])).unwrap();
    maneuver(&mut moving, &Vector3::new(0.0, 50.0, 0.0), 600.0);
    let begin_s = moving.time_s();
    moving.set("orbit.position[1]", 5e6);
    moving.step_to(begin_s + 1000.0).unwrap();
    let (energy, _) = integrals(&Vector3::new(5e6, 0.0, 0.0), &Vector3::new(0.0, 3500.0, 0.0));
    let [position, velocity] = state(&moving);
    assert_near(integrals(&position, &velocity).0, energy, 1e-11);
}

#[test]
fn steps_of_any_length_and_saving_change_no_bit() {
    let named = full();
    let more = [
        ("orbit.dynamics", 2.0),
        ("guided.downlinkEvery", 1.0),
        ("dump.threshold[1]", 0.2),
        ("dump.threshold[2]", 0.2),
        ("dump.threshold[3]", 0.2),
    ];
    for dynamics in [0, 1] {
        let sets = with(&[&ERRORS, &more[dynamics..]]);
        let initialize = || named.initialize(0.0, &sets).unwrap();
        let ends_s = (1..=12).map(|number| 12_345.0 * f64::from(number));
        let mut centers = Vec::new();
        assert_cuts_change_nothing(initialize, ends_s, &[600.0, 4321.0], |flight| {
            let number = (flight.time_s() / 12_345.0).round() as i32;
            flight.set("maneuver.request", f64::from(u8::from(number % 2 == 0)));
            flight.set_elements("maneuver.deltaV", &[0.3, 0.1 * f64::from(number), -0.2]);
            centers.push(flight.vector("centerOfMass"));
        });
        centers.dedup();
        assert!(centers.len() > 8, "{}", centers.len());
    }
}

#[test]
fn without_deviations_the_seed_moves_no_bit() {
    let named = full();
    let mut flights = [1.0, 77.0].map(|seed| named.initialize(0.0, &[("noise.seed", seed)]).unwrap());
    for flight in &mut flights {
        for _ in 0..3 {
            maneuver(flight, &Vector3::new(0.3, -0.1, 0.2), 5000.0);
        }
    }
    let [one, other] = &flights;
    assert_same(one, other);
    assert_eq!(one.vector("maneuver.executed"), Vector3::new(0.3, -0.1, 0.2));
    // With them it moves the maneuver.
    let executed = [1.0, 77.0].map(|seed| {
        let mut flight = named.initialize(0.0, &with(&[&ERRORS, &[("noise.seed", seed)]])).unwrap();
        maneuver(&mut flight, &Vector3::new(0.3, -0.1, 0.2), 600.0);
        flight.vector("maneuver.executed")
    });
    assert_ne!(executed[0], executed[1]);
}

#[test]
fn every_thruster_event_moves_the_centre_of_mass() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &ERRORS).unwrap();
    let nominal = flight.vector("centerOfMass");
    assert_eq!(nominal, flight.vector("spacecraft.centerOfMass"));
    let mut shifts = Vec::new();
    for number in 0..400 {
        let input = if number % 2 == 0 { "maneuver.request" } else { "dump.request" };
        flight.set(input, 1.0);
        flight.set("maneuver.deltaV[1]", if number % 4 == 0 { 1e-3 } else { -1e-3 });
        flight.step_to(flight.time_s() + 1.0).unwrap();
        flight.set(input, 0.0);
        flight.step_to(flight.time_s() + 1.0).unwrap();
        shifts.push(flight.vector("centerOfMass") - nominal);
    }
    for (axis, sigma) in [2e-3, 1e-3, 3e-3].into_iter().enumerate() {
        let n = shifts.len() as f64;
        let mean = shifts.iter().map(|it| it[axis]).sum::<f64>() / n;
        let deviation = (shifts.iter().map(|it| (it[axis] - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt();
        assert!(mean.abs() < 4.0 * sigma / n.sqrt(), "{axis} {mean:e}");
        assert!((deviation / sigma - 1.0).abs() < 4.0 / (2.0 * n).sqrt(), "{axis} {deviation:e}");
    }
}

#[test]
fn a_shift_turns_the_force_of_sunlight_into_torque() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let plain = [("gravityGradient.enabled", 0.0), ("orbit.center", 2.0), ("attitude.source", 2.0)];
    let simulate = |sigma_m: f64| {
        let sets = with(&[&plain, &[("spacecraft.centerOfMassShift[3]", sigma_m)]]);
        let mut flight = named.initialize(0.0, &sets).unwrap();
        flight.set("dump.request", 1.0);
        flight.step_to(600.0).unwrap();
        flight
    };
    let (still, moved) = (simulate(0.0), simulate(0.01));
    let shift = moved.vector("centerOfMass") - still.vector("centerOfMass");
    assert!(shift.z.abs() > 1e-4 && shift.x == 0.0);
    let torque = moved.vector("torque.solar") - still.vector("torque.solar");
    let expected = -shift.cross(&still.vector("force.solar"));
    assert!((torque - expected).norm() < 1e-12 * expected.norm() + 1e-18, "{torque:?} {expected:?}");
}

#[test]
fn a_request_without_velocity_warns_and_does_nothing() {
    let named = full();
    let [mut requested, mut other] = [0, 1].map(|_| named.initialize(0.0, &[]).unwrap());
    for flight in [&mut requested, &mut other] {
        flight.step_to(600.0).unwrap();
    }
    requested.set("maneuver.request", 1.0);
    // Anything that is set ends the present segment.
    other.set("thrust.stop", 5.0);
    for flight in [&mut requested, &mut other] {
        flight.step_to(1200.0).unwrap();
    }
    assert_same(&requested, &other);
    let warnings = named.warnings();
    let found = warnings.iter().filter(|it| it.contains("maneuver.deltaV = (0, 0, 0) m/s")).count();
    assert_eq!(found, 1, "{warnings:?}");
}

#[test]
fn what_cannot_be_executed_is_refused_by_name() {
    let named = full();
    let refusal = |sets: &[(&str, f64)], delta_v: [f64; 3]| {
        let mut flight = named.initialize(0.0, sets).unwrap();
        flight.step_to(1.0).unwrap();
        flight.set("maneuver.request", 1.0);
        flight.set_elements("maneuver.deltaV", &delta_v);
        flight.step_to(2.0).unwrap_err().to_string()
    };
    let mut bystander = named.initialize(0.0, &[]).unwrap();
    for source in [3.0, 4.0] {
        let found = refusal(&[("attitude.source", source), ("start.q[4]", 1.0)], [1.0, 0.0, 0.0]);
        let names = ["controlled", "maneuver.request", "thrust.request", "guided (1) and commanded (2)"];
        assert!(names.iter().all(|it| found.contains(it)), "{found}");
    }
    let found = refusal(&[], [1.0, f64::NAN, 0.0]);
    assert!(found.contains("finite") && found.contains("maneuver.deltaV"), "{found}");
    let found = refusal(&[("maneuver.thrusters", MONO4)], [0.0, 0.0, 5000.0]);
    assert!(found.contains("kg from tank") && found.contains("maneuver.thrusters"), "{found}");
    // The others live on.
    bystander.step_to(600.0).unwrap();
    let shift = [("attitude.source", 3.0), ("spacecraft.centerOfMassShift[2]", 1e-3)];
    assert!(named.refusal(&shift).contains("spacecraft.centerOfMassShift"));
}

#[test]
fn a_velocity_that_stops_the_spacecraft_has_no_orbit() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &[]).unwrap();
    flight.step_to(1.0).unwrap();
    let back = -flight.vector("velocity");
    flight.set("maneuver.request", 1.0);
    flight.set_elements("maneuver.deltaV", back.iter());
    let found = flight.step_to(2.0).unwrap_err().to_string();
    assert!(found.contains("no orbit begins"), "{found}");
}

#[test]
fn a_commanded_flight_maneuvers_too() {
    let named = full();
    let mut flight = named.initialize(0.0, &[("attitude.source", 2.0), ("command.kind", 1.0)]).unwrap();
    flight.set_elements("command.q", &[0.0, 0.0, 0.0, 1.0]);
    maneuver(&mut flight, &Vector3::new(0.0, 0.0, 2.0), 600.0);
    assert_eq!((flight.integer("maneuver.count"), flight.integer("dump.count")), (1, 1));
}
