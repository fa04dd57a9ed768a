//! Thrusters of the controlled and free plant: pulses, dumps, delta-v, attitude control, tanks.

use fmi_export::fmi2::description_of;
use model_description::SimpleTypeKind;
use models::MomentumPlant;
use nalgebra::{UnitQuaternion, Vector3};

use super::super::named_model::{NamedModel, assert_cuts_change_nothing};
use super::super::spacecraft::{EXHAUST_M_S, SIMPLE, couples, thruster};
use super::{CONTROLLED, DARK, FREE, PlantInstance, Start, initialize, set_quaternion, to_inertial};

const FULL: &str = include_str!("../../../fmu-src/resources/messenger-full.toml");

fn with_thrusters(thrusters: &str) -> NamedModel<MomentumPlant> {
    NamedModel::<MomentumPlant>::with("simple.toml", &format!("{SIMPLE}{thrusters}"))
}

fn momentum(flight: &PlantInstance<'_>) -> Vector3<f64> {
    flight.vector("momentum.inertial")
}

/// No dump comes in between.
const NO_DUMPS: Start<'_> =
    &[("dump.threshold[1]", 1e9), ("dump.threshold[2]", 1e9), ("dump.threshold[3]", 1e9)];

#[test]
fn a_pulse_train_gives_force_times_lever_times_time() {
    for (ramps, lost_s) in [("", 0.0), ("rise_time_s = 0.004\ntail_off_time_s = 0.01", 0.003)] {
        // Along +Z, 0.8 m off the axis along +Y: a torque about +X.
        let named =
            with_thrusters(&(couples("") + &thruster([0.0, 0.8, -1.0], [0.0, 0.0, 1.0], 22.0, ramps)));
        let mut flight = initialize(&named, &[FREE, DARK, NO_DUMPS]);
        let mut on_s = 0.0;
        for step in 0..40 {
            let width_s = 0.002 * f64::from(step % 7) + 0.005;
            flight.set("thruster[13].onDelay", 0.013);
            flight.set("thruster[13].onTime", width_s);
            on_s += width_s + lost_s;
            flight.step_to(0.1 * f64::from(step + 1)).unwrap();
            assert_eq!(flight.real("thruster[13].thrust"), 0.0);
        }
        flight.set("thruster[13].onTime", 0.0);
        // About an axis of inertia from rest: the momentum keeps its direction. Jet damping with flow and force alike:
        // dH/ds = T - (q r^2 / J) H by the time s of full thrust.
        let damping_1_s = 22.0 / EXHAUST_M_S * (0.8 * 0.8 + 1.0) / 200.0;
        let expected = Vector3::x() * (-22.0 * 0.8 / damping_1_s * (-damping_1_s * on_s).exp_m1());
        assert!(
            (momentum(&flight) - expected).norm() < 1e-13 * expected.norm(),
            "{}",
            momentum(&flight) - expected
        );
        assert!((flight.vector("attitude.rate").x - expected.x / 200.0).abs() < 1e-15);
        let used_kg = 22.0 * on_s / EXHAUST_M_S;
        assert!((flight.real("propellant.used") / used_kg - 1.0).abs() < 1e-12);
        assert!((flight.real("mass") + used_kg - 500.0).abs() < 1e-12);
        assert_eq!(flight.integer("thruster[13].pulses"), 40);
    }
}

#[test]
fn thrust_is_never_active_without_thrusters() {
    // None at all, and none of the set.
    for named in [with_thrusters(""), with_thrusters(&couples(""))] {
        let mut flight = initialize(&named, &[FREE, DARK]);
        flight.set("thrust.request", 2.0);
        flight.set("thrust.command", 1.0);
        flight.set("thrust.stop", 600.0);
        for second in 1..=5 {
            flight.step_to(f64::from(second)).unwrap();
            assert!(!flight.boolean("thrust.active"), "{second}");
        }
    }
}

#[test]
fn a_long_thrust_follows_the_rocket_equation() {
    // Four through the centre of mass: no torque.
    let main: String = [(0.5, 0.5), (-0.5, 0.5), (-0.5, -0.5), (0.5, -0.5)]
        .iter()
        .map(|&(x, y)| thruster([x, y, -1.0], [0.0, 0.0, 1.0], 22.0, "set = \"own\""))
        .collect();
    let named = with_thrusters(&(couples("") + &main));
    let mut flight = initialize(&named, &[FREE, DARK]);
    flight.set("thrust.request", 1.0);
    flight.set("thrust.command", 1.0);
    flight.set("thrust.stop", 600.123_456);
    for second in 1..=700 {
        flight.step_to(f64::from(second)).unwrap();
        assert_eq!(flight.boolean("thrust.active"), second <= 600);
    }
    let used_kg = 88.0 * 600.123_456 / EXHAUST_M_S;
    assert!((flight.real("propellant.used") / used_kg - 1.0).abs() < 1e-12);
    let delta_v = EXHAUST_M_S * (500.0 / (500.0 - used_kg)).ln();
    assert!((flight.vector("deltaV").z / delta_v - 1.0).abs() < 1e-12, "{}", flight.vector("deltaV"));
    assert!((flight.vector("accelerometer.deltaV").z / delta_v - 1.0).abs() < 1e-12);
    assert!(momentum(&flight).norm() < 1e-9);
}

#[test]
fn sets_are_the_files_own_in_its_order() {
    let along = |axis: [f64; 3], force_n: f64, more: &str| thruster([0.0; 3], axis, force_n, more);
    let thrusters = along([0.0, 0.0, 1.0], 5.0, "name = \"F1\"\nset = \"fine\"")
        + &along([1.0, 0.0, 0.0], 100.0, "name = \"M1\"\nset = \"main\"\nattitude_control = false")
        + &along([0.0, 0.0, 1.0], 7.0, "name = \"F2\"\nset = \"fine\"");
    let (fine, main) = (("fine", Vector3::z() * 12.0), ("main", Vector3::x() * 100.0));
    let spare = ("spare", Vector3::zeros());
    for (order, sets) in [("", vec![fine, main]), ("sets = [\"spare\", \"main\"]", vec![spare, main, fine])] {
        let text = format!("{order}{SIMPLE}{thrusters}{}", couples(""));
        let described = description_of::<MomentumPlant>("simple.toml", &text).unwrap();
        let requests = described.types.iter().find(|it| it.name == "ThrustRequest").unwrap();
        let SimpleTypeKind::Enumeration { items, .. } = &requests.kind else { panic!("{requests:?}") };
        let names: Vec<_> = items.iter().map(|item| (item.value, item.name.as_str())).collect();
        let expected = std::iter::once("none").chain(sets.iter().map(|(name, _)| *name));
        assert_eq!(names, (0..).zip(expected).collect::<Vec<_>>());
        let meanings: Vec<_> = items.iter().filter_map(|item| item.description.as_deref()).collect();
        assert!(
            meanings.contains(&"Thrusters F1, F2.") && meanings.contains(&"Thrusters M1."),
            "{meanings:?}"
        );
        let named = NamedModel::<MomentumPlant>::with("simple.toml", &text);
        for (item, (name, force_n)) in (1..).zip(&sets) {
            let mut flight = initialize(&named, &[FREE, DARK]);
            flight.set("thrust.request", f64::from(item));
            flight.set("thrust.command", 1.0);
            flight.step_to(1.0).unwrap();
            assert!((flight.vector("force.thruster") - force_n).norm() < 1e-9, "{name}");
        }
    }
}

#[test]
fn a_tank_runs_dry_and_blowdown_weakens() {
    let file =
        format!("{SIMPLE}ullage_m3 = 0.02\ndensity_kg_m3 = 1000.0\nallowed_pressure_pa = [6e5, 3e6]\n");
    let main: String = (0..2)
        .map(|k| {
            thruster(
                [0.0, if k == 0 { 0.5 } else { -0.5 }, -1.0],
                [0.0, 0.0, 1.0],
                100.0,
                "set = \"lva\"\nattitude_control = false",
            )
        })
        .collect();
    let named = NamedModel::<MomentumPlant>::with("blowdown.toml", &format!("{file}{}{main}", couples("")));
    let mut flight = initialize(&named, &[FREE, DARK]);
    flight.set("thrust.request", 1.0);
    flight.set("thrust.command", 1.0);
    let time_s: f64 = 60.0;
    flight.simulate_to(time_s, 1.0).unwrap();
    // rho (sqrt(V^2 + 2 c V t / rho) - V) with the flow c at the start.
    let flow = 200.0 / EXHAUST_M_S;
    let used = 1000.0 * ((0.02_f64.powi(2) + 2.0 * flow * 0.02 * time_s / 1000.0).sqrt() - 0.02);
    // Within a segment of 20 ms thrust and flow are linear.
    let off = flight.real("propellant.used") / used - 1.0;
    assert!(off.abs() < 6e-9, "{off}");
    let pressure = 2e6 * 0.02 / (0.02 + used / 1000.0);
    assert!((flight.real("tank[1].pressureActual") / pressure - 1.0).abs() < 6e-9);
    let off = flight.vector("force.thruster").z / (200.0 * pressure / 2e6) - 1.0;
    assert!(off.abs() < 6e-9, "{off}");
    // 6e5 Pa are left at 46.7 kg, before it is empty: then nothing fires.
    flight.simulate_to(3_000.0, 5.0).unwrap();
    assert!(!flight.boolean("tank[1].feeds"));
    assert_eq!(flight.vector("force.thruster"), Vector3::zeros());
    let left = flight.real("tank[1].propellantLeft");
    assert!((50.0 - 0.02 * (2e6 / 6e5 - 1.0) * 1000.0 - left).abs() < 0.01, "{left}");

    let named = with_thrusters(&(couples("") + &main));
    let mut flight = initialize(&named, &[FREE, DARK, &[("tank[1].propellant", 3.0)]]);
    flight.set("thrust.request", 1.0);
    flight.set("thrust.command", 1.0);
    flight.simulate_to(100.0, 7.0).unwrap();
    assert_eq!(flight.real("tank[1].propellantLeft"), 0.0);
    assert!((flight.real("propellant.used") - 3.0).abs() < 1e-12 && !flight.boolean("tank[1].feeds"));
    assert!((flight.vector("deltaV").z - EXHAUST_M_S * (500.0_f64 / 497.0).ln()).abs() < 1e-9);
}

#[test]
fn a_dump_in_controlled_flight_is_that_of_guided_flight() {
    let named = NamedModel::<MomentumPlant>::with("messenger-full.toml", FULL);
    let target = Vector3::new(0.4, -0.3, 0.2);
    let quiet: Start<'_> = &[("solar.flux", 0.0), ("gravityGradient.enabled", 0.0)];
    let exact: Vec<(String, f64)> = (1..=17).map(|k| (format!("thruster[{k}].scatter"), 0.0)).collect();
    let exact: Vec<(&str, f64)> = exact.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let held: Start<'_> = &[("wheel[1].startMomentum", 3.0), ("wheel[2].startMomentum", -1.5)];
    let mut simulated = initialize(&named, &[CONTROLLED, quiet, held, &exact]);
    simulated.step_to(10.0).unwrap();
    let before = momentum(&simulated);
    let ask = |flight: &mut PlantInstance<'_>| {
        flight.set_elements("dump.target", target.iter());
        flight.set("dump.request", 1.0);
    };
    ask(&mut simulated);
    let mut greatest_rad = 0.0_f64;
    for second in 11..=400 {
        simulated.step_to(f64::from(second)).unwrap();
        greatest_rad = greatest_rad.max(to_inertial(&simulated).angle_to(&UnitQuaternion::identity()));
    }
    let (is_active, count) = (simulated.boolean("dump.active"), simulated.integer("dump.count"));
    assert!(!is_active && count == 1, "{is_active} {count} {}", momentum(&simulated) - target);
    // The smallest pulse: 4.4 N for 20 ms at 0.9 m or so, as a vector.
    let smallest = 4.4 * 0.021 * 1.0;
    assert!((momentum(&simulated) - target).norm() < smallest, "{}", momentum(&simulated) - target);
    assert!((momentum(&simulated) - before - simulated.vector("dump.impulse")).norm() < 1e-6);
    assert!(greatest_rad < 0.5_f64.to_radians(), "{}", greatest_rad.to_degrees());

    let at: Vec<(String, f64)> = (0..3).map(|i| (format!("start.momentum[{}]", i + 1), before[i])).collect();
    let at: Vec<(&str, f64)> = at.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    let commanded: Start<'_> = &[("attitude.source", 2.0)];
    let mut ideal = initialize(&named, &[commanded, quiet, &at]);
    ask(&mut ideal);
    ideal.step_to(10.0).unwrap();
    let (impulse, ideal_impulse) = (simulated.vector("dump.impulse"), ideal.vector("dump.impulse"));
    assert!((impulse - ideal_impulse).norm() < smallest, "{impulse} {ideal_impulse}");
    let (used, ideal_used) = (simulated.real("propellant.used"), ideal.real("propellant.used"));
    assert!((used / ideal_used - 1.0).abs() < 0.1, "{used} {ideal_used}");
    assert!((ideal.real("mass") + ideal_used - 700.0).abs() < 1e-9);
    let pushed = ideal.vector("dump.deltaV");
    assert!((ideal.vector("deltaV") - pushed).norm() < 1e-12 && pushed.norm() < 0.05);
}

#[test]
fn the_momentum_is_the_integral_of_all_torques() {
    let named = NamedModel::<MomentumPlant>::with("messenger-full.toml", FULL);
    let held: Start<'_> = &[("wheel[1].startMomentum", 4.0), ("wheel[3].startMomentum", 2.0)];
    let mut flight = initialize(&named, &[CONTROLLED, held]);
    flight.step_to(1.0).unwrap();
    flight.set("dump.request", 1.0);
    let begin = momentum(&flight);
    let (mut sum, mut most) = (Vector3::zeros(), 0.0_f64);
    // Steps far shorter than the valves' ramps, the torque taken as linear over each.
    let step_s = 2e-4;
    let inertial = |flight: &PlantInstance<'_>| to_inertial(flight) * flight.vector("torque.total");
    let mut before = inertial(&flight);
    for k in 1..=30_000 {
        flight.step_to(1.0 + f64::from(k) * step_s).unwrap();
        let now = inertial(&flight);
        sum += (before + now) * (0.5 * step_s);
        before = now;
        most = most.max(flight.vector("torque.thruster").norm());
    }
    assert!(most > 1.0 && flight.boolean("dump.active"));
    let change = momentum(&flight) - begin;
    // The valves' corners within a step are all that the rule misses.
    assert!((change - sum).norm() < 1e-3 * change.norm(), "{} of {}", (change - sum).norm(), change.norm());
}

#[test]
fn thrusters_hold_the_attitude_of_a_large_burn() {
    let named = NamedModel::<MomentumPlant>::with("messenger-full.toml", FULL);
    let offset: Start<'_> = &[("spacecraft.centerOfMass[1]", 0.02)];
    let mut flight = initialize(&named, &[CONTROLLED, DARK, offset]);
    set_quaternion(&mut flight, "command.q", &UnitQuaternion::identity());
    flight.step_to(5.0).unwrap();
    flight.set("thrust.request", 1.0);
    flight.set("thrust.command", 1.0);
    let angle =
        |flight: &PlantInstance<'_>| to_inertial(flight).angle_to(&UnitQuaternion::identity()).to_degrees();
    let (mut greatest, mut late) = (0.0_f64, 0.0_f64);
    for k in 1..=600 {
        flight.step_to(5.0 + 0.1 * f64::from(k)).unwrap();
        greatest = greatest.max(angle(&flight));
        if k > 300 {
            late = late.max(angle(&flight));
        }
    }
    let torque = flight.vector("force.thruster").z * 0.02;
    assert!(torque > 12.8, "{torque}");
    println!("660 N, 2 cm off: at most {greatest:.3} deg, after 30 s {late:.4} deg");
    assert!(greatest < 2.0 && late < 0.1, "{greatest} {late}");
    assert!(flight.integer("thruster[2].pulses") > 100, "those of 22 N hold it");
    // 13 N m for a minute would have left 780 N m s.
    assert!(momentum(&flight).norm() < 5.0, "{}", momentum(&flight));
}

#[test]
fn thrusters_stand_in_for_failed_wheels() {
    let named = NamedModel::<MomentumPlant>::with("messenger-full.toml", FULL);
    let mut flight = initialize(&named, &[CONTROLLED, DARK]);
    for k in [1, 2] {
        flight.set(&format!("wheel[{k}].failed"), 1.0);
    }
    let target = UnitQuaternion::new(Vector3::new(0.2, -0.1, 0.3));
    set_quaternion(&mut flight, "command.q", &target);
    flight.simulate_to(600.0, 1.0).unwrap();
    let off = to_inertial(&flight).angle_to(&target).to_degrees();
    println!("two wheels failed: {off:.4} deg off after a turn of 21 deg");
    assert!(off < 0.2, "{off}");
    assert!(flight.real("propellant.used") > 0.0);
}

#[test]
fn cutting_and_saving_change_no_bit() {
    let named = NamedModel::<MomentumPlant>::with("messenger-full.toml", FULL);
    let held: Start<'_> = &[
        ("wheel[1].startMomentum", 3.0),
        ("thrust.misalignment", 0.01),
        ("thrust.drift", 1e-5),
        ("thrust.jitter", 1e-3),
        ("accelerometer.noise", 1e-4),
    ];
    let initialize = || {
        let mut flight = initialize(&named, &[CONTROLLED, held]);
        flight.set("dump.request", 1.0);
        flight
    };
    assert_cuts_change_nothing(initialize, [30.0, 60.0, 90.0], &[0.9, 0.013, 0.25, 7.0], |flight| {
        if flight.time_s() == 60.0 {
            flight.set("thrust.request", 2.0);
            flight.set("thrust.command", 1.0);
            flight.set("thrust.stop", 75.321);
        }
    });
}

#[test]
fn what_cannot_fire_is_refused_or_flagged() {
    let message = with_thrusters(&couples("")).refusal(&[("tank[1].propellant", 600.0)]);
    assert!(message.contains("tank[k].propellant") && message.contains("500"), "{message}");
    let bounded = with_thrusters(&format!("allowed_pressure_pa = [1e6, 3e6]\n{}", couples("")));
    let message = bounded.refusal(&[("tank[1].pressure", 5e5)]);
    assert!(message.contains("tank[1].pressure") && message.contains("1000000"), "{message}");

    let named = with_thrusters(&(couples("min_on_time_s = 0.02")));
    let mut flight = initialize(&named, &[FREE, DARK, NO_DUMPS]);
    flight.set("thruster[1].onTime", 0.019);
    flight.step_to(1.0).unwrap();
    assert!(flight.boolean("thruster[1].tooShort") && flight.integer("thruster[1].pulses") == 0);
    flight.set("thruster[1].onTime", 3.0);
    flight.set("thrust.request", 1.0);
    flight.set("thrust.command", 1.0);
    flight.step_to(2.0).unwrap();
    flight.step_to(3.0).unwrap();
    let warnings = named.warnings();
    assert_eq!(
        warnings.iter().filter(|it| it.contains("thruster[1].onDelay and onTime reach beyond")).count(),
        1,
        "{warnings:?}"
    );
    assert_eq!(
        warnings.iter().filter(|it| it.contains("thrust.request asks for")).count(),
        1,
        "{warnings:?}"
    );
    // Cut at each step and commanded anew there, it fires through.
    assert_eq!(flight.integer("thruster[1].pulses"), 1);
    // An arm of 1 m about X, with jet damping.
    let damping_1_s = 5.0 / EXHAUST_M_S / 200.0;
    let expected = -5.0 / damping_1_s * (-damping_1_s * 2.0).exp_m1();
    assert!((momentum(&flight).norm() - expected).abs() < 1e-9, "{}", momentum(&flight).norm());
}

/// A main engine alone can be simulated; the dumps there are come by dump.torque, as without thrusters, and that is reported.
#[test]
fn thrusters_that_cannot_turn_the_body_leave_dumps_to_dump_torque() {
    let engine = thruster([0.0, 0.0, -1.0], [0.0, 0.0, 1.0], 22.0, "");
    let reported = |named: &NamedModel<MomentumPlant>| {
        named.warnings().iter().filter(|it| it.contains("no torque about") && it.contains("dump")).count()
    };
    // 20 N m s about X, beyond the default thresholds: in free flight they are off unless set.
    let turning: Start<'_> = &[("start.rate[1]", 0.1), ("dump.torque", 0.5)];
    let named = with_thrusters(&engine);
    let mut flight = initialize(&named, &[FREE, DARK, turning]);
    flight.simulate_to(5.0, 1.0).unwrap();
    assert_eq!((flight.integer("dump.count"), reported(&named)), (0, 0));
    // To -9 N m s by 0.5 N m.
    let thresholds: Start<'_> = &[
        ("dump.threshold[1]", 10.0),
        ("dump.threshold[2]", 10.0),
        ("dump.threshold[3]", 10.0),
        ("dump.reinitTo", 1.0),
    ];
    let mut flight = initialize(&named, &[FREE, DARK, turning, thresholds]);
    flight.simulate_to(57.0, 1.0).unwrap();
    assert!(flight.boolean("dump.active"));
    flight.simulate_to(60.0, 1.0).unwrap();
    assert!(!flight.boolean("dump.active") && flight.integer("dump.count") == 1);
    assert!((momentum(&flight) - Vector3::x() * -9.0).norm() < 1e-9, "{}", momentum(&flight));
    assert_eq!((flight.real("propellant.used"), reported(&named)), (0.0, 1));
    // In an attitude that is followed ideally at once.
    let named = with_thrusters(&engine);
    let mut flight =
        initialize(&named, &[&[("attitude.source", 2.0)], DARK, &[("start.momentum[1]", 20.0)], thresholds]);
    flight.simulate_to(5.0, 1.0).unwrap();
    assert_eq!((flight.integer("dump.count"), reported(&named)), (1, 1));
    assert_eq!((flight.real("propellant.used"), flight.vector("dump.deltaV")), (0.0, Vector3::zeros()));
}

/// The centre of mass moves onto the line of a thruster that alone gives +X.
#[test]
fn a_dump_without_thrusters_after_the_centre_of_mass_moved_is_reported() {
    let one_sided: String = (0..3)
        .flat_map(|axis| [1.0, -1.0].map(|side| (axis, side)))
        .map(|(axis, side)| {
            let (mut at, mut force) = ([0.0; 3], [0.0; 3]);
            (at[(axis + 1) % 3], force[(axis + 2) % 3]) = (side, 1.0);
            thruster(at, force, 5.0, "")
        })
        .collect();
    let ideal: Start<'_> = &[("attitude.source", 2.0), ("start.momentum[1]", 3.0)];
    let free: Start<'_> = &[("attitude.source", 4.0), ("start.rate[1]", 0.015)];
    for start in [ideal, free] {
        let named = with_thrusters(&one_sided);
        let mut flight = initialize(&named, &[start, DARK]);
        let dump = |flight: &mut PlantInstance<'_>| {
            flight.set("dump.request", 1.0);
            let end_s = flight.time_s() + 200.0;
            flight.simulate_to(end_s, 1.0).unwrap();
            flight.set("dump.request", 0.0);
            flight.simulate_to(end_s + 1.0, 1.0).unwrap();
            flight.real("propellant.used")
        };
        let served_kg = dump(&mut flight);
        let warnings = |named: &NamedModel<MomentumPlant>| {
            named.warnings().iter().filter(|it| it.contains("no torque about +X")).count()
        };
        assert!(served_kg > 0.0 && warnings(&named) == 0, "{served_kg}");
        flight.set("spacecraft.centerOfMass[2]", 1.0);
        flight.set("dump.target[1]", 1.0);
        assert_eq!(dump(&mut flight), served_kg);
        assert_eq!((flight.integer("dump.count"), warnings(&named)), (2, 1));
    }
}
