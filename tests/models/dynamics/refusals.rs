//! Settings that cannot be simulated are refused by name.

use models::MomentumPlant;

use super::super::named_model::NamedModel;
use super::{CONTROLLED, FREE, Start, with};

#[test]
fn what_cannot_be_controlled_is_refused_by_name() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let cases: [(Start<'_>, Start<'_>, &str); 12] = [
        (
            FREE,
            &[("wheel[3].axis[1]", 0.0), ("wheel[3].axis[2]", 0.0), ("wheel[3].axis[3]", 0.0)],
            "wheel[3].axis",
        ),
        (FREE, &[("wheel[2].inertia", 1e4)], "spacecraft.inertia"),
        (FREE, &[("start.momentum[1]", 1.0)], "start.momentum"),
        (FREE, &[("momentum.convention", 2.0)], "momentum.convention"),
        (FREE, &[("wheel[1].startMomentum", 8.5)], "wheel[1].startMomentum"),
        (FREE, &[("wheel[1].locked", 1.0), ("wheel[1].startMomentum", 0.5)], "wheel[1].startMomentum"),
        (FREE, &[("sunSensor[2].axis[1]", 0.0)], "sunSensor[2].axis"),
        (CONTROLLED, &[("start.momentum[2]", 1.0)], "start.momentum"),
        (CONTROLLED, &[("momentum.convention", 2.0)], "momentum.convention"),
        (CONTROLLED, &[("wheel[1].locked", 1.0), ("wheel[2].locked", 1.0)], "wheel[k].axis"),
        (CONTROLLED, &[("control.bandwidth", 200.0)], "control.bandwidth"),
        (CONTROLLED, &[("control.rate", 0.1), ("control.bandwidth", 1.0)], "control.bandwidth"),
    ];
    for (source, bad, named_in_it) in cases {
        let reported = named.refusal(&with(&[source, bad]));
        let says_what_is_allowed = reported.contains("allowed") || reported.contains("stable below");
        assert!(reported.contains(named_in_it) && says_what_is_allowed, "{bad:?}: {reported}");
        // Nothing of it matters without dynamics.
        if !bad.iter().any(|(name, _)| name.starts_with("sunSensor")) {
            named.initialize(0.0, bad).unwrap();
        }
    }
}

#[test]
fn a_place_inside_the_planet_is_refused_before_the_body_is_simulated_there() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // Nothing is left for a body that its gravity gradient spins up.
    let sets = [
        ("orbit.source", 2.0),
        ("orbit.velocity[1]", 2500.0),
        ("gravityGradient.enabled", 1.0),
        ("solver.workLimit", 2e4),
    ];
    for (source, shadow) in [(FREE, 1.0), (FREE, 4.0), (CONTROLLED, 1.0), (CONTROLLED, 4.0)] {
        let mut flight =
            named.initialize(0.0, &with(&[source, &sets, &[("eclipse.method", shadow)]])).unwrap();
        flight.step_to(1.0).unwrap();
        flight.set("orbit.position[2]", 1e-4);
        let reported = flight.step_to(2.0).unwrap_err().to_string();
        assert!(reported.contains("inside the planet") && reported.contains("orbit.*"), "{reported}");
    }
}
