//! A host that left the processor rounding up, down or toward zero gets the same flight within a tolerance.
#![cfg(all(target_arch = "x86_64", target_os = "linux"))]
#![allow(unsafe_code, reason = "the C library sets the rounding mode")]

use models::{DisturbanceTorque, MomentumPlant};
use nalgebra::Vector3;

use super::named_model::NamedModel;

unsafe extern "C" {
    safe fn fesetround(mode: i32) -> i32;
    safe fn fegetround() -> i32;
}

const NEAREST: i32 = 0;
/// Downward, upward, toward zero.
const DIRECTED: [i32; 3] = [0x400, 0x800, 0xc00];

/// Back to nearest whatever happens.
struct Rounding;

impl Rounding {
    fn set(mode: i32) -> Self {
        assert_eq!(fesetround(mode), 0);
        assert_eq!(fegetround(), mode);
        Self
    }
}

impl Drop for Rounding {
    fn drop(&mut self) {
        fesetround(NEAREST);
    }
}

const ORBITER: &str = include_str!("../../fmu-src/resources/examples/mercury-orbiter.toml");

const EVERYTHING: &[(&str, f64)] = &[
    ("planetLight.enabled", 1.0),
    ("thermal.enabled", 1.0),
    ("shadowing.enabled", 1.0),
    ("dump.threshold[1]", 0.05),
];

#[test]
fn every_rounding_mode_gives_the_same_two_days() {
    let simulate = |options: &[(&str, f64)]| -> (Vec<Vector3<f64>>, i32) {
        let named = NamedModel::<MomentumPlant>::with("mercury-orbiter.toml", ORBITER);
        let mut flight = named.initialize(0.0, &[EVERYTHING, options].concat()).unwrap();
        flight.simulate_to(172_800.0, 7_200.0).unwrap();
        assert_eq!(flight.not_finite(), None);
        let names = ["momentum.inertial", "torque.total", "force.total", "position", "deltaV"];
        (names.map(|name| flight.vector(name)).to_vec(), flight.integer("dump.count"))
    };
    for options in [&[][..], &[("orbit.dynamics", 2.0), ("guided.slewRate", 1e-3)]] {
        let (nearest, dumps) = simulate(options);
        for mode in DIRECTED {
            let rounding = Rounding::set(mode);
            let (found, found_dumps) = simulate(options);
            drop(rounding);
            assert_eq!(found_dumps, dumps, "mode {mode:#x}");
            for (a, b) in found.iter().zip(&nearest) {
                assert!((a - b).norm() < 2e-6 * b.norm(), "mode {mode:#x}: {a} {b}");
            }
        }
    }
}

#[test]
fn every_rounding_mode_gives_the_same_disturbance() {
    let evaluate = || {
        let named = NamedModel::<DisturbanceTorque>::with("mercury-orbiter.toml", ORBITER);
        (0..40)
            .map(|k| {
                let (sin, cos) = (f64::from(k) * 0.7).sin_cos();
                let sun = [("sun.positionBody[1]", 5e10 * sin), ("sun.positionBody[2]", -5e10 * cos)];
                let model = named.initialize(0.0, &sun).unwrap();
                assert_eq!(model.not_finite(), None);
                model.vector("torque.total")
            })
            .collect::<Vec<_>>()
    };
    let nearest = evaluate();
    for mode in DIRECTED {
        let rounding = Rounding::set(mode);
        let found = evaluate();
        drop(rounding);
        for (a, b) in found.iter().zip(&nearest) {
            assert!((a - b).norm() < 1e-9 * b.norm(), "mode {mode:#x}: {a} {b}");
        }
    }
}
