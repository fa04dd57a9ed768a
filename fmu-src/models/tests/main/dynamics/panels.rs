//! Panels that have a mass: centre of mass and inertia follow their angles.

use models::MomentumPlant;
use nalgebra::{Matrix3, Rotation3, Vector3};

use super::super::named_model::NamedModel;
use super::{DARK, FREE, Flight, Start, fly, to_inertial};

/// The shipped spacecraft, its first panel a hinged plate of 30 kg whose mass lies off the axis.
fn text() -> String {
    let shipped = include_str!("../../../../resources/messenger.toml");
    let panel = shipped.find("[[panels]]").unwrap();
    let (before, after) = shipped.split_at(panel + "[[panels]]".len());
    let mass = "mass_kg = 30.0\nmass_center_m = [2.0, 0.0, 0.5]\n\
                inertia_kg_m2 = [[4.0, 0.0, 0.0], [0.0, 7.0, 0.0], [0.0, 0.0, 3.5]]";
    format!("{before}\n{mass}{after}")
}

fn steiner(at: &Vector3<f64>) -> Matrix3<f64> {
    let skew = at.cross_matrix();
    -skew * skew
}

/// Centre of mass and inertia about it by taking the panel off at angle 0 and putting it back at `angle_rad`.
fn by_hand(angle_rad: f64, axis: &Vector3<f64>, hinge: &Vector3<f64>) -> (Vector3<f64>, Matrix3<f64>) {
    let (mass, panel) = (700.0, 30.0);
    let at = Vector3::new(2.0, 0.0, 0.5);
    let own = Matrix3::from_diagonal(&Vector3::new(4.0, 7.0, 3.5));
    let whole = Matrix3::from_diagonal(&Vector3::new(199.6, 507.1, 484.9));
    // The rest alone, about the origin.
    let rest = whole - own - steiner(&at) * panel;
    let turn = Rotation3::new(axis * angle_rad);
    let there = hinge + turn * (at - hinge);
    let center = (there - at) * (panel / mass);
    let inertia = rest + turn.matrix() * own * turn.matrix().transpose() + steiner(&there) * panel;
    (center, inertia - steiner(&center) * mass)
}

#[test]
fn the_body_turns_as_the_panel_moves_its_inertia() {
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text());
    let start: Start<'_> = &[
        ("panel[1].control", 2.0),
        ("panel[2].control", 2.0),
        ("start.rate[1]", 2e-3),
        ("start.rate[2]", 1e-3),
        ("start.rate[3]", -1e-3),
    ];
    let mut flight = fly(&named, &[FREE, DARK, start]);
    let total = flight.vector("momentum.inertial");
    let (axis, hinge) = (Vector3::x(), Vector3::new(2.28, 0.0, 0.0));
    let check = |flight: &Flight<'_>, angle_rad: f64| {
        let (center, inertia) = by_hand(angle_rad, &axis, &hinge);
        assert!((flight.vector("centerOfMass") - center).norm() < 1e-12, "{}", flight.vector("centerOfMass"));
        let axes = (1..=4).map(|k| flight.vector(&format!("wheel[{k}].axis")).normalize());
        let held: Vector3<f64> =
            axes.enumerate().map(|(k, axis)| axis * flight.real(&format!("wheel[{}].momentum", k + 1))).sum();
        let formed = to_inertial(flight) * (inertia * flight.vector("attitude.rate") + held);
        assert!((formed - total).norm() < 1e-12 * total.norm(), "{angle_rad}: {formed} {total}");
        assert_eq!(flight.vector("momentum.inertial"), total);
    };
    check(&flight, 0.0);
    for (step, angle_rad) in [0.3, 0.9, 1.5, -0.7, 3.0].into_iter().enumerate() {
        flight.set("panel[1].angle", angle_rad);
        flight.step_to(20.0 * (step + 1) as f64).unwrap();
        check(&flight, angle_rad);
    }
    // Begun at an angle, the rate is the one requested.
    let turned = fly(&named, &[FREE, DARK, start, &[("panel[1].angle", 0.9)]]);
    assert!((turned.vector("attitude.rate") - Vector3::new(2e-3, 1e-3, -1e-3)).norm() < 1e-17);
    let (_, inertia) = by_hand(0.9, &axis, &hinge);
    let expected = to_inertial(&turned) * (inertia * turned.vector("attitude.rate"));
    assert!((turned.vector("momentum.inertial") - expected).norm() < 1e-13);
}

#[test]
fn light_turns_the_body_about_its_moved_centre() {
    // Sunlight on the panels has an arm from the centre of mass, which the first panel moves.
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text());
    let start: Start<'_> =
        &[("attitude.source", 2.0), ("panel[1].control", 2.0), ("gravityGradient.enabled", 0.0)];
    let mut flight = fly(&named, &[start]);
    let torque_about_origin = |flight: &Flight<'_>| {
        let force = flight.vector("force.solar");
        (flight.vector("torque.solar") + flight.vector("centerOfMass").cross(&force), force)
    };
    flight.set("panel[1].angle", 1.2);
    flight.step_to(10.0).unwrap();
    let moved = torque_about_origin(&flight);
    let shipped = NamedModel::<MomentumPlant>::shipped();
    let mut rigid = fly(&shipped, &[start]);
    rigid.set("panel[1].angle", 1.2);
    rigid.step_to(10.0).unwrap();
    let fixed = torque_about_origin(&rigid);
    assert!(flight.vector("centerOfMass").norm() > 0.01 && rigid.vector("centerOfMass").norm() == 0.0);
    assert!((moved.1 - fixed.1).norm() < 1e-12 * fixed.1.norm());
    assert!((moved.0 - fixed.0).norm() < 1e-10 * fixed.0.norm(), "{} {}", moved.0, fixed.0);
}
