//! Wheels that work about a bias, and wheels in a plane: by closed forms of a constant torque in a fixed attitude.

use models::MomentumPlant;
use nalgebra::Vector3;

use super::named_model::NamedModel;
use super::spacecraft::SIMPLE;

/// Two wheels in the YZ plane, their biases together 3 N m s along +Y.
const PAIR: &str = "
[[wheels]]
axis = [0.0, 0.6, 0.8]
capacity_n_m_s = 4.0
bias_momentum_n_m_s = 2.5

[[wheels]]
axis = [0.0, 0.6, -0.8]
capacity_n_m_s = 4.0
bias_momentum_n_m_s = 2.5
";
/// Fixed in EME2000, and nothing but the applied torque acts.
const HELD: &[(&str, f64)] = &[
    ("attitude.source", 2.0),
    ("command.q[4]", 1.0),
    ("solar.flux", 0.0),
    ("gravityGradient.enabled", 0.0),
    ("aerodynamics.enabled", 0.0),
    ("magnetics.enabled", 0.0),
];
const TORQUE_N_M: [f64; 3] = [2e-4, 3e-4, -1e-4];

fn pair() -> NamedModel<MomentumPlant> {
    NamedModel::with("pair.toml", &format!("{SIMPLE}{PAIR}"))
}

fn held<'a>(more: &[(&'a str, f64)]) -> Vec<(&'a str, f64)> {
    let torques = ["torque.applied[1]", "torque.applied[2]", "torque.applied[3]"].into_iter().zip(TORQUE_N_M);
    HELD.iter().copied().chain(torques).chain(more.iter().copied()).collect()
}

/// Each wheel holds 1.5 N m s beside its bias, so that its pair does along Y and Z: h_1,2 = y / 1.2 +- z / 1.6, at most
/// (1 / 1.2 + 1 / 1.6) h = 35 h / 24 in a cube of half edge h.
#[test]
fn thresholds_are_what_the_wheels_hold_about_the_axes_that_they_span() {
    let flight = &pair();
    let flight = flight.initialize(0.0, &held(&[])).unwrap();
    let expected = Vector3::new(1e9, 1.5 * 24.0 / 35.0, 1.5 * 24.0 / 35.0);
    assert!((flight.vector("dump.threshold") - expected).norm() < 1e-12);
    assert_eq!(flight.real("dump.guaranteedThreshold"), 0.0);
    assert_eq!(flight.real("control.slewRate"), 0.0);
    assert!((flight.vector("momentum.bias") - Vector3::new(0.0, 3.0, 0.0)).norm() < 1e-15);
}

#[test]
fn momentum_and_dumps_count_from_the_bias() {
    let named = pair();
    let mut flight =
        named.initialize(0.0, &held(&[("start.momentum[3]", 0.2), ("start.momentum[1]", 0.4)])).unwrap();
    let (start, torque) = (Vector3::new(0.4, 3.0, 0.2), Vector3::from(TORQUE_N_M));
    let check = |flight: &super::named_model::NamedInstance<'_, MomentumPlant>, expected: Vector3<f64>| {
        assert!(
            (flight.vector("momentum.body") - expected).norm() < 1e-9,
            "{}",
            flight.vector("momentum.body")
        );
        // What no wheel holds is along X, and the wheels hold the rest.
        assert!((flight.vector("momentum.unheld") - Vector3::new(expected.x, 0.0, 0.0)).norm() < 1e-9);
        for (k, sign) in [(1, 1.0), (2, -1.0)] {
            let share = expected.y / 1.2 + sign * expected.z / 1.6;
            assert!((flight.real(&format!("wheel[{k}].momentum")) - share).abs() < 1e-9);
        }
    };
    check(&flight, start);
    flight.step_to(1000.0).unwrap();
    check(&flight, start + torque * 1000.0);
    // Y comes to its threshold first, and goes back to the bias; X grows for ever.
    let threshold = 1.5 * 24.0 / 35.0;
    let dumped_s = threshold / 3e-4;
    flight.step_to(dumped_s + 500.0).unwrap();
    assert_eq!(flight.integer("dump.count"), 1);
    assert!((flight.real("dump.lastTime") - dumped_s).abs() < 1e-5);
    check(&flight, start + torque * (dumped_s + 500.0) - Vector3::y() * threshold);
    // On request all components go to the target from the bias.
    for (axis, target) in [(1, 0.1), (2, -0.2), (3, 0.3)] {
        flight.set(&format!("dump.target[{axis}]"), target);
    }
    flight.set("dump.request", 1.0);
    flight.step_to(dumped_s + 600.0).unwrap();
    check(&flight, Vector3::new(0.1, 2.8, 0.3) + torque * 100.0);
}

/// By the opposite the component goes to the other side of the bias.
#[test]
fn the_opposite_threshold_lies_beyond_the_bias() {
    let named = pair();
    let mut flight =
        named.initialize(0.0, &held(&[("dump.reinitTo", 1.0), ("dump.reinitFraction", 0.5)])).unwrap();
    let threshold = 1.5 * 24.0 / 35.0;
    flight.step_to(threshold / 3e-4 + 1.0).unwrap();
    let expected = 3.0 - 0.5 * threshold + 3e-4;
    assert!((flight.vector("momentum.body").y - expected).abs() < 1e-8);
}

/// A wheel beyond its capacity holds no more than that.
#[test]
fn what_lies_beyond_the_capacities_is_not_held() {
    let named = pair();
    let sets = held(&[("start.momentum[2]", 3.0), ("dump.threshold[2]", 1e9)]);
    let flight = named.initialize(0.0, &sets).unwrap();
    // 6 N m s along Y are 5 in each wheel of 4, which hold 4.8 of it.
    assert!((flight.vector("momentum.unheld") - Vector3::new(0.0, 1.2, 0.0)).norm() < 1e-12);
    assert!(flight.boolean("wheel[1].saturated") && flight.boolean("wheel[2].saturated"));
}

/// Wheels turn about their bias from the start; the biases of four in a pyramid that come to nothing stay while the controller
/// balances the rest.
#[test]
fn a_flight_by_torque_begins_and_stays_at_the_bias() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // The axes are (1, 1, 1), (-1, 1, 1), (1, 1, -1), (-1, 1, -1) in some order over the root of 3: signs of the sum that vanishes.
    let axes: Vec<Vector3<f64>> = {
        let flight = named.initialize(0.0, &[]).unwrap();
        (1..=4).map(|k| flight.vector(&format!("wheel[{k}].axis"))).collect()
    };
    let sign = |k: usize| (axes[k].x * axes[k].z).signum();
    let biases: Vec<(String, f64)> =
        (0..4).map(|k| (format!("wheel[{}].biasMomentum", k + 1), 2.0 * sign(k))).collect();
    let mut sets: Vec<(&str, f64)> = biases.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    sets.extend([
        ("attitude.source", 3.0),
        ("start.q[4]", 1.0),
        ("solar.flux", 0.0),
        ("gravityGradient.enabled", 0.0),
    ]);
    sets.extend([("command.q[4]", 1.0), ("control.balanceTime", 20.0)]);
    let mut flight = named.initialize(0.0, &sets).unwrap();
    assert!(flight.vector("momentum.bias").norm() < 1e-12);
    flight.simulate_to(200.0, 10.0).unwrap();
    for k in 0..4 {
        let (name, expected) = (format!("wheel[{}]", k + 1), 2.0 * sign(k));
        assert_eq!(flight.real(&format!("{name}.startMomentum")), expected);
        assert!((flight.real(&format!("{name}.momentum")) - expected).abs() < 1e-3, "{k}");
    }
}

#[test]
fn a_bias_beyond_the_capacity_is_refused() {
    let named = pair();
    for source in [2.0, 4.0] {
        let refusal = named.refusal(&[("attitude.source", source), ("wheel[2].biasMomentum", -4.5)]);
        assert!(refusal.contains("wheel[2].biasMomentum: found -4.5 N.m.s, allowed: up to 4.0"), "{refusal}");
    }
    let text = format!("{SIMPLE}{}", PAIR.replacen("2.5", "4.5", 1));
    let refused = super::named_model::described::<MomentumPlant>("pair.toml", &text).unwrap_err();
    assert!(refused.contains("wheels[1].bias_momentum_n_m_s") && refused.contains("4.5"), "{refused}");
}
