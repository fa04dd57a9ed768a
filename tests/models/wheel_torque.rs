//! wheel[k].torque is the torque that acts: the rate of h + I a.w, whatever makes the body turn.

use models::MomentumPlant;
use nalgebra::Vector3;

use super::named_model::{NamedInstance, NamedModel};
use super::spacecraft::{SIMPLE, couples, thruster};

pub(crate) const WHEELS: usize = 4;
const INERTIA_KG_M2: f64 = 8e-3;

type PlantInstance<'a> = NamedInstance<'a, MomentumPlant>;

/// Rotors of a known inertia without friction, and no dumps.
fn with(more: &[(&str, f64)]) -> Vec<(String, f64)> {
    let wheels = (1..=WHEELS).flat_map(|k| {
        [("inertia", INERTIA_KG_M2), ("coulombFriction", 0.0), ("viscousFriction", 0.0)]
            .map(|(name, value)| (format!("wheel[{k}].{name}"), value))
    });
    let thresholds = (1..=3).map(|axis| (format!("dump.threshold[{axis}]"), 1e9));
    wheels.chain(thresholds).chain(more.iter().map(|(name, value)| ((*name).to_owned(), *value))).collect()
}

pub(crate) fn initialize<'a>(
    named: &'a NamedModel<MomentumPlant>,
    more: &[(&str, f64)],
) -> PlantInstance<'a> {
    let sets = with(more);
    let sets: Vec<_> = sets.iter().map(|(name, value)| (name.as_str(), *value)).collect();
    named.initialize(0.0, &sets).unwrap()
}

/// h + I a.w of each wheel.
pub(crate) fn axial(flight: &PlantInstance<'_>) -> [f64; WHEELS] {
    let rate = flight.vector("attitude.rate");
    core::array::from_fn(|k| {
        let axis: Vector3<f64> = flight.vector(&format!("wheel[{}].axis", k + 1)).normalize();
        flight.real(&format!("wheel[{}].momentum", k + 1)) + INERTIA_KG_M2 * axis.dot(&rate)
    })
}

pub(crate) fn torques(flight: &PlantInstance<'_>) -> [f64; WHEELS] {
    core::array::from_fn(|k| {
        let of = |name: &str| flight.real(&format!("wheel[{}].{name}", k + 1));
        assert!((of("power") - of("torque") * of("speed")).abs() <= 1e-15 * of("power").abs());
        of("torque")
    })
}

/// By central differences of what is left of the momentum, in ideal flight.
#[test]
fn ideal_wheels_turn_by_the_torque_that_is_shown() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let commanded: &[(&str, f64)] = &[
        ("attitude.source", 2.0),
        ("command.q[4]", 1.0),
        ("command.rate[1]", 1e-3),
        ("command.rate[3]", -2e-3),
        ("start.momentum[2]", 2.0),
        ("torque.applied[1]", 1e-3),
    ];
    let guided: &[(&str, f64)] = &[("start.momentum[2]", 2.0), ("guided.slewRate", 2e-3)];
    for (start, times) in [(commanded, &[100.0, 731.0, 2500.0][..]), (guided, &[30.0, 900.0, 3000.0, 9000.0])]
    {
        let mut flight = initialize(&named, start);
        for time_s in times {
            let difference_s = 1.0;
            flight.step_to(time_s - difference_s).unwrap();
            let before = axial(&flight);
            flight.step_to(*time_s).unwrap();
            let shown = torques(&flight);
            flight.step_to(time_s + difference_s).unwrap();
            let after = axial(&flight);
            let most = shown.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
            assert!(most > 1e-8, "{time_s}: {shown:?}");
            for k in 0..WHEELS {
                let expected = (after[k] - before[k]) / (2.0 * difference_s);
                // Differences of 5 N m s lose 1e-15 of it.
                assert!(
                    (shown[k] - expected).abs() < 1e-4 * most + 1e-14,
                    "{time_s}: {} {expected}",
                    shown[k]
                );
            }
        }
    }
}

#[test]
fn controlled_wheels_turn_by_the_torque_that_is_shown() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let turned = [("start.q[4]", 1.0), ("command.q[1]", 0.1), ("command.q[4]", 0.99)];
    let mut flight = initialize(&named, &[&[("attitude.source", 3.0)][..], &turned].concat());
    let mut moved = false;
    for sample in 1..=500 {
        let before = axial(&flight);
        flight.step_to(f64::from(sample) / 50.0).unwrap();
        let (after, shown) = (axial(&flight), torques(&flight));
        for k in 0..WHEELS {
            assert!((shown[k] - (after[k] - before[k]) * 50.0).abs() < 1e-11, "{sample}");
            moved |= shown[k].abs() > 1e-3;
        }
    }
    assert!(moved);
}

/// Thrusters dump in controlled flight and an engine burns in free flight, the tank far off the axis: centre of mass and inertia
/// change, and the rotors feel the motors alone.
#[test]
fn torques_add_up_to_the_momentum_while_propellant_flows() {
    let wheels: String = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)]
        .map(|(x, y)| Vector3::new(x, y, 1.0).normalize())
        .iter()
        .map(|axis| format!("[[wheels]]\naxis = {:?}\ncapacity_n_m_s = 50.0\n", axis.as_slice()))
        .collect();
    let tank = "position_m = [0.9, -0.7, 0.2]";
    let engine =
        thruster([0.0, 0.01, -1.0], [0.0, 0.0, 1.0], 20.0, "set = \"main\"\nattitude_control = false");
    let text = SIMPLE.replace("position_m = [0.0, 0.0, 0.0]", tank) + &wheels + &engine + &couples("");
    let named = NamedModel::<MomentumPlant>::with("drained.toml", &text);
    let controlled: &[_] = &[("attitude.source", 3.0), ("start.q[4]", 1.0), ("wheel[1].startMomentum", 20.0)];
    let free: &[_] = &[("attitude.source", 4.0), ("start.rate[1]", 0.01), ("start.rate[3]", -0.02)];
    for (start, step_s, input) in [(controlled, 0.02, "dump.request"), (free, 0.5, "thrust.command")] {
        let mut flight = initialize(&named, start);
        flight.set("command.q[4]", 1.0);
        flight.set("thrust.request", 1.0);
        flight.set(input, 1.0);
        let (begin, mut impulse) = (axial(&flight), [0.0; WHEELS]);
        for step in 1..=(20.0_f64 / step_s) as u32 {
            for k in 0..WHEELS {
                let command = 0.01 * (0.3 * f64::from(step) + k as f64).sin();
                flight.set(&format!("wheel[{}].torqueCommand", k + 1), command);
            }
            flight.step_to(f64::from(step) * step_s).unwrap();
            let shown = torques(&flight);
            (0..WHEELS).for_each(|k| impulse[k] += shown[k] * step_s);
        }
        let moved_m = flight.vector("centerOfMass").norm();
        assert!(moved_m > 1e-6, "{moved_m}");
        let off = most_off(&begin, &axial(&flight), &impulse);
        println!("{input}: {off:.1e}, the centre of mass moved by {moved_m:.1e} m");
        assert!(off < 1e-12, "{off}");
    }
}

/// By how much the impulses are off the change of momentum, relative to the greatest change.
pub(crate) fn most_off(begin: &[f64; WHEELS], end: &[f64; WHEELS], impulse: &[f64; WHEELS]) -> f64 {
    let change: [f64; WHEELS] = core::array::from_fn(|k| end[k] - begin[k]);
    let most = |values: [f64; WHEELS]| values.iter().fold(0.0_f64, |most, it| most.max(it.abs()));
    assert!(most(change) > 1e-6, "{change:?}");
    most(core::array::from_fn(|k| impulse[k] - change[k])) / most(change)
}

/// A motor that has failed, one that is requested more than it can, one whose rotor is at its capacity and one that does as it
/// is reported.
#[test]
fn a_motor_shows_what_acts_after_failure_limit_and_capacity() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = initialize(&named, &[("attitude.source", 4.0), ("wheel[3].startMomentum", 7.0)]);
    let capacity = flight.real("wheel[3].capacity");
    let limit = flight.real("wheel[2].maxTorque");
    flight = initialize(&named, &[("attitude.source", 4.0), ("wheel[3].startMomentum", capacity)]);
    for (k, command) in [(1, 0.01), (2, 10.0 * limit), (3, 0.5 * limit), (4, 0.02)] {
        flight.set(&format!("wheel[{k}].torqueCommand"), command);
    }
    flight.set("wheel[1].failed", 1.0);
    for step in 1..=20 {
        let before = axial(&flight);
        flight.step_to(0.01 * f64::from(step)).unwrap();
        let (after, shown) = (axial(&flight), torques(&flight));
        assert_eq!((shown[0], shown[1], shown[3]), (0.0, limit, 0.02));
        assert!(flight.boolean("wheel[3].saturated"));
        for k in 0..WHEELS {
            let expected = (after[k] - before[k]) / 0.01;
            // The held rotor's torque is that at the step's end, of a body that turns ever faster.
            let allowed = if k == 2 { 1e-4 * limit } else { 1e-11 };
            assert!((shown[k] - expected).abs() < allowed, "{step} {k}: {} {expected}", shown[k]);
        }
        // It holds the rotor against the body's acceleration, far from what is commanded.
        assert!(shown[2].abs() < 0.01 * limit && shown[2] != 0.0, "{}", shown[2]);
    }
}
