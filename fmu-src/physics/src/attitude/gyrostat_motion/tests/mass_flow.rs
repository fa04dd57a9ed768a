//! Inertia that changes with propellant and jet damping, against closed forms.

use nalgebra::{Matrix3, Vector3};

use super::*;
use crate::attitude::mass_flow::{JetDamping, MassFlow};
use crate::math;

fn flowing(inertia_rate: Vector3<f64>, jet_damping: Vector3<f64>) -> BodyLoad {
    let mass_flow = MassFlow {
        inertia_rate_kg_m2_s: Matrix3::from_diagonal(&inertia_rate),
        jet_damping: JetDamping { terms_kg_m2_s: [Matrix3::from_diagonal(&jet_damping), Matrix3::zeros()] },
    };
    BodyLoad { mass_flow: Some(mass_flow), ..BodyLoad::none(400.0) }
}

fn body(inertia: Vector3<f64>) -> Gyrostat {
    Gyrostat::new(Matrix3::from_diagonal(&inertia), vec![]).unwrap()
}

fn simulated(
    gyrostat: &Gyrostat,
    rate: Vector3<f64>,
    load: &BodyLoad,
    span_s: f64,
) -> (GyrostatMotion, BodyMotion) {
    let mut motion = GyrostatMotion::new(gyrostat, 0.0, Quaternion::IDENTITY, &rate, |_| 0.0);
    motion.advance(gyrostat, &[], load, span_s);
    assert_eq!(motion.end_s(), span_s, "one segment");
    let end = motion.at(gyrostat, span_s);
    (motion, end)
}

#[test]
fn a_spin_about_an_axis_of_inertia_is_a_power_of_the_inertia() {
    // H' = -D H / (J + J' t): H = H0 ((J + J' t) / J)^(-D/J').
    let (inertia, growth, damping, span_s) = (200.0, -1.5, 0.6, 0.5);
    let gyrostat = body(Vector3::new(inertia, 300.0, 400.0));
    let load = flowing(Vector3::new(growth, -0.5, -2.0), Vector3::new(damping, 0.1, 0.2));
    let (motion, end) = simulated(&gyrostat, Vector3::x() * 0.1, &load, span_s);
    let left = inertia + growth * span_s;
    let expected = 0.1 * inertia * math::powf(left / inertia, -damping / growth);
    assert!(
        (end.momentum_inertial_n_m_s.x / expected - 1.0).abs() < 1e-13,
        "{}",
        end.momentum_inertial_n_m_s
    );
    assert!((end.rate_body_rad_s.x * left / expected - 1.0).abs() < 1e-13, "{}", end.rate_body_rad_s);
    assert!((motion.rate_at(span_s) - end.rate_body_rad_s).norm() < 1e-15);
}

#[test]
fn without_jet_damping_the_momentum_stays_and_the_rate_follows_the_inertia() {
    let gyrostat = body(Vector3::new(200.0, 300.0, 400.0));
    let load = flowing(Vector3::new(-3.0, -2.0, -1.0), Vector3::zeros());
    let rate = Vector3::new(0.02, -0.05, 0.03);
    let (motion, end) = simulated(&gyrostat, rate, &load, 0.5);
    let start = gyrostat.momentum_body_n_m_s(&rate, |_| 0.0);
    assert!((end.momentum_inertial_n_m_s - start).norm() < 1e-15 * start.norm());
    let left = Vector3::new(198.5, 299.0, 399.5);
    let formed = end.attitude.inertial_from_body(&left.component_mul(&motion.rate_at(0.5)));
    assert!((formed - start).norm() < 1e-13 * start.norm(), "{}", formed - start);
}
