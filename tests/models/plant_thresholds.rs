//! Dumps fall where the momentum comes to its threshold in a body that turns.

use models::MomentumPlant;
use nalgebra::{Rotation3, Vector3};

use super::named_model::NamedModel;

const THRESHOLD_N_M_S: f64 = 4.0;

/// Commanded flight about a Sun that stands still along -Y; body and inertial axes coincide at the start.
const HELD: &[(&str, f64)] = &[
    ("attitude.source", 2.0),
    ("orbit.source", 3.0),
    ("orbit.position[2]", -1e8),
    ("ephemeris.source", 3.0),
    ("sun.position[2]", -6e10),
    ("spacecraft.centerOfMass[1]", 0.2),
    ("spacecraft.centerOfMass[3]", 0.3),
    ("gravityGradient.enabled", 0.0),
    ("command.q[4]", 1.0),
    ("start.momentum[1]", 3.5),
    ("start.momentum[3]", 3.5),
    ("dump.threshold[1]", THRESHOLD_N_M_S),
    ("dump.threshold[2]", 1e9),
    ("dump.threshold[3]", THRESHOLD_N_M_S),
];

/// Momentum in a body that turns at `rate` under a torque, both constant in the body: dh/dt = T - w x h in closed form.
fn momentum(rate: &Vector3<f64>, torque: &Vector3<f64>, start: &Vector3<f64>, at_s: f64) -> Vector3<f64> {
    let turn = Rotation3::from_scaled_axis(-rate * at_s);
    let axis = rate.normalize();
    let along = axis * axis.dot(torque) * at_s;
    // Across the axis: the particular solution h = T x w / w^2 stands still.
    let across = torque - axis * axis.dot(torque);
    let still = across.cross(rate) / rate.norm_squared();
    assert!((rate.cross(&still) - across).norm() <= 1e-12 * torque.norm());
    turn * (start - still) + still + along
}

#[test]
fn a_dump_comes_where_the_turning_momentum_comes_to_its_threshold() {
    let named = NamedModel::<MomentumPlant>::shipped();
    for flux in [0.0, 1367.0] {
        for rate_rad_s in [0.01, 0.02, 0.05, 1.0] {
            let sets = [HELD, &[("solar.flux", flux), ("command.rate[2]", rate_rad_s)]].concat();
            let mut flight = named.initialize(0.0, &sets).unwrap();
            let torque = flight.vector("torque.solar");
            assert_eq!(torque.norm() > 1e-5, flux > 0.0, "{torque}");
            let rate = Vector3::new(0.0, rate_rad_s, 0.0);
            let start = Vector3::new(3.5, 0.0, 3.5);
            let exceeds = |at_s: f64| {
                let now = momentum(&rate, &torque, &start, at_s);
                now.x.abs() > THRESHOLD_N_M_S || now.z.abs() > THRESHOLD_N_M_S
            };
            let mut above_s = 0.0;
            while !exceeds(above_s) {
                above_s += 1e-3 / rate_rad_s;
            }
            let mut below_s = above_s - 1e-3 / rate_rad_s;
            while above_s - below_s > 1e-12 {
                let middle_s = 0.5 * (above_s + below_s);
                *(if exceeds(middle_s) { &mut above_s } else { &mut below_s }) = middle_s;
            }
            flight.step_to(above_s + 0.01 / rate_rad_s).unwrap();
            assert_eq!(flight.integer("dump.count"), 1, "{rate_rad_s} rad/s");
            let found_s = flight.real("dump.lastTime");
            println!("flux {flux}, {rate_rad_s} rad/s: {found_s:?} s, expected {above_s:?} s");
            assert!((found_s - above_s).abs() < 1e-9, "flux {flux}, {rate_rad_s} rad/s: {found_s} {above_s}");
        }
    }
}
