//! A rotor out of balance on a body at rest, against the closed form.

use nalgebra::{Complex, Matrix3};

use super::*;
use crate::attitude::wheel::ReactionWheel;
use crate::attitude::{Appendages, RotorImbalance};

#[test]
fn a_rotor_out_of_balance_shakes_the_body_as_the_closed_form_says() {
    // About Z, at constant speed, on a body alike about X and Y: with w = wx + i wy, J w' - i h w = T.
    let (imbalance, lever_m, inertia, mass_kg, speed) = (2e-5, 0.4, 300.0, 500.0, 250.0);
    let wheel = ReactionWheel {
        axis_body: Vector3::z(),
        inertia_kg_m2: 0.0127,
        max_torque_n_m: 0.075,
        capacity_n_m_s: 8.0,
        bias_n_m_s: 0.0,
        coulomb_friction_n_m: 0.0,
        viscous_friction_n_m_s: 0.0,
        locked: false,
    };
    let held = speed * wheel.inertia_kg_m2;
    let appendages = Appendages {
        imbalances: vec![RotorImbalance {
            wheel: 0,
            static_imbalance_kg_m: imbalance,
            position_body_m: Vector3::new(0.1, 0.2, 0.3 + lever_m),
        }],
        ..Appendages::default()
    };
    let spacecraft = Gyrostat::new(Matrix3::from_diagonal_element(inertia), vec![wheel]).unwrap();
    let spacecraft = spacecraft.with_appendages(appendages, mass_kg, Vector3::new(0.1, 0.2, 0.3)).unwrap();
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &Vector3::zeros(), |_| held);
    let load = BodyLoad::none(mass_kg);
    let i = Complex::<f64>::i();
    let precession = held / inertia;
    let (mut largest, mut moved) = (0.0_f64, 0.0_f64);
    // The phase begins along Z x X = Y.
    let force = |time_s: f64| i * (i * (speed * time_s)).exp() * (imbalance * speed * speed);
    for step in 1..=1_000 {
        let time_s = 0.01 * f64::from(step) + 1e-4;
        simulate(&mut motion, &spacecraft, &[Motor::default()], &load, time_s, 0.02);
        let at = motion.at(&spacecraft, time_s);
        let [_, found] = motion.imbalance_load(&spacecraft, time_s, &at);
        let found = Complex::new(found.x, found.y);
        assert!((found - force(time_s)).norm() < 1e-9 * force(0.0).norm(), "{found} {}", force(time_s));
        let amplitude = imbalance * speed * speed * lever_m / (inertia * (speed - precession));
        let expected = i * amplitude * ((i * (speed * time_s)).exp() - (i * (precession * time_s)).exp());
        let found = Complex::new(at.rate_body_rad_s.x, at.rate_body_rad_s.y);
        assert!((found - expected).norm() < 1e-8 * amplitude, "{time_s}: {found} {expected}");
        largest = largest.max(found.norm());
        // In a body that hardly turns.
        let velocity = imbalance * speed / mass_kg;
        let expected = ((i * (speed * time_s)).exp() - 1.0) * velocity;
        let found = Complex::new(at.delta_v_inertial_m_s.x, at.delta_v_inertial_m_s.y);
        assert!((found - expected).norm() < 1e-4 * velocity, "{time_s}: {found} {expected}");
        moved = moved.max(found.norm());
    }
    assert!(largest > 3e-6 && moved > 1.9 * imbalance * speed / mass_kg);
}
