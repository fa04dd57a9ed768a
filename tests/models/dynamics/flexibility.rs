//! Flexible modes, propellant and rotors out of balance at the model's face: what adds up, what cutting changes, what is refused.

use fmi_export::Model;
use models::MomentumPlant;
use nalgebra::Vector3;

use super::super::named_model::{NamedModel, assert_cuts_change_nothing};
use super::{CONTROLLED, DARK, FREE, GUIDANCE, Start, initialize, to_inertial, with};

const SWINGING: &str = r"
[[flexible_modes]]
frequency_hz = 0.7
damping = 0.004
coupling_sqrt_kg_m = [2.0, -5.0, 8.0]
[[flexible_modes]]
frequency_hz = 2.3
coupling_sqrt_kg_m = [-1.0, 6.0, 1.0]
[[slosh]]
mass_kg = 60.0
length_m = 0.3
pivot_m = [0.0, 0.2, -0.4]
axis = [0.0, 0.0, 1.0]
damping = 0.01
";

/// Two rotors out of balance, a slow and a fast one.
const UNBALANCED: Start<'_> = &[
    ("wheel[1].staticImbalance", 2e-5),
    ("wheel[1].position[1]", 0.4),
    ("wheel[1].position[3]", -0.6),
    ("wheel[1].startMomentum", 0.8),
    ("wheel[3].staticImbalance", 1e-5),
    ("wheel[3].position[2]", 0.5),
    ("wheel[3].startMomentum", -0.1),
];

fn swinging() -> NamedModel<MomentumPlant> {
    NamedModel::with("swinging", &format!("{}{SWINGING}", MomentumPlant::DEFAULT_SETUP))
}

#[test]
fn torque_and_force_reported_are_what_momentum_and_velocity_change_by() {
    let named = swinging();
    let spinning: Start<'_> = &[("start.rate[1]", 2e-3), ("start.rate[3]", -1e-3)];
    let pushed: Start<'_> =
        &[("force.applied[1]", 4.0), ("force.applied[3]", -60.0), ("torque.applied[2]", 0.2)];
    let mut flight = initialize(&named, &[FREE, DARK, UNBALANCED, spinning, pushed]);
    let reported = |flight: &super::PlantInstance<'_>| {
        [to_inertial(flight) * flight.vector("torque.total"), flight.vector("acceleration")]
    };
    let reached =
        |flight: &super::PlantInstance<'_>| [flight.vector("momentum.inertial"), flight.vector("deltaV")];
    let start = reached(&flight);
    let mut sums = [Vector3::zeros(); 2];
    // Simpson's rule over steps of 2 ms; the rotors turn at up to 63 rad/s.
    let step_s = 2e-3;
    for step in 0..2_500 {
        let time_s = step_s * f64::from(step);
        let begin = reported(&flight);
        flight.step_to(time_s + 0.5 * step_s).unwrap();
        let middle = reported(&flight);
        flight.step_to(time_s + step_s).unwrap();
        let end = reported(&flight);
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum += (begin[k] + middle[k] * 4.0 + end[k]) * (step_s / 6.0);
        }
    }
    for ((sum, end), start) in sums.iter().zip(reached(&flight)).zip(start) {
        let changed = end - start;
        assert!((sum - changed).norm() < 1e-6 * changed.norm(), "{sum} {changed}");
    }
    // Each of them counts.
    assert!(flight.real("slosh[1].angle[1]").hypot(flight.real("slosh[1].angle[2]")) > 0.03);
    assert!(flight.real("flexibleMode[1].displacement").abs() > 1e-5);
    let applied = Vector3::new(4.0, 0.0, -60.0);
    assert!((flight.vector("force.total") - applied).norm() > 0.05);
    assert!((flight.vector("torque.total") - Vector3::y() * 0.2).norm() > 0.1);
}

/// Momentum by source adds up to the change of the momentum, with rotors out of balance and swinging propellant.
#[test]
fn the_budget_of_the_momentum_closes() {
    let named = swinging();
    let spinning: Start<'_> = &[("start.rate[1]", 2e-3), ("start.rate[3]", -1e-3)];
    let pushed: Start<'_> =
        &[("force.applied[1]", 4.0), ("force.applied[3]", -60.0), ("torque.applied[2]", 0.2)];
    let mut flight = initialize(&named, &[FREE, UNBALANCED, spinning, pushed]);
    let start = flight.vector("momentum.inertial");
    flight.simulate_to(30.0, 0.7).unwrap();
    let rows = flight.output_bits().into_iter().filter_map(|(name, _)| {
        let row = name.strip_prefix("momentum.")?.strip_suffix("[1]")?;
        (!["body", "inertial"].contains(&row)).then(|| flight.vector(&format!("momentum.{row}")))
    });
    let budget = to_inertial(&flight) * rows.sum::<Vector3<f64>>();
    let changed = flight.vector("momentum.inertial") - start;
    assert!((budget - changed).norm() < 1e-11 * changed.norm(), "{budget} {changed}");
    for row in ["imbalance", "slosh"] {
        let size = flight.vector(&format!("momentum.{row}")).norm();
        assert!(size > 1e-4 && flight.vector(&format!("torque.{row}")).norm() > 1e-4, "{row}: {size}");
    }
}

#[test]
fn how_the_flight_is_cut_changes_no_bit() {
    let named = swinging();
    let noisy: Start<'_> =
        &[("starTracker.noise[1]", 1e-5), ("gyro.noise", 1e-6), ("wheel[1].coulombFriction", 1e-3)];
    let pushed: Start<'_> = &[("force.applied[2]", 3.0), ("force.applied[3]", -40.0)];
    let start = with(&[CONTROLLED, GUIDANCE, noisy, UNBALANCED, pushed]);
    let initialize = || named.initialize(-0.3, &start).unwrap();
    assert_cuts_change_nothing(
        initialize,
        [0.0, 0.017, 5.5, 13.333, 20.0],
        &[0.7, 0.02, 0.013, 1.0],
        |flight| {
            assert!(
                flight.real("flexibleMode[2].displacement") != 0.0 && flight.real("slosh[1].angle[2]") != 0.0
            );
        },
    );
}

#[test]
fn nothing_swings_where_the_attitude_is_followed_ideally() {
    let (named, shipped) = (swinging(), NamedModel::<MomentumPlant>::shipped());
    for source in [1.0, 2.0] {
        let chosen = [("attitude.source", source), ("force.applied[3]", -40.0)];
        let start = with(&[&chosen, &UNBALANCED[..3]]);
        let [swinging, rigid] = [&named, &shipped].map(|named| {
            let mut flight = named.initialize(0.0, &start).unwrap();
            flight.simulate_to(600.0, 60.0).unwrap();
            ["momentum.inertial", "deltaV", "torque.total"].map(|name| flight.vector(name))
        });
        assert_eq!(swinging, rigid);
        let mut flight = named.initialize(0.0, &start).unwrap();
        flight.simulate_to(600.0, 60.0).unwrap();
        for output in ["flexibleMode[1].displacement", "slosh[1].angle[1]", "slosh[1].angle[2]"] {
            assert_eq!(flight.real(output), 0.0);
        }
    }
}

#[test]
fn what_cannot_swing_is_refused_by_name() {
    let named = swinging();
    let cases: [(Start<'_>, &str); 4] = [
        (&[("flexibleMode[1].coupling[1]", 14.2)], "flexibleMode[k].coupling"),
        (&[("slosh[1].mass", 2000.0)], "slosh[k].mass"),
        (&[("slosh[1].axis[3]", 0.0)], "slosh[1].axis"),
        (&[("slosh[1].pivot[1]", 3.0)], "slosh[k].pivot"),
    ];
    for (bad, named_in_it) in cases {
        let reported = named.refusal(&with(&[FREE, bad]));
        assert!(reported.contains(named_in_it) && reported.contains("allowed"), "{bad:?}: {reported}");
        named.initialize(0.0, bad).unwrap();
    }
}
