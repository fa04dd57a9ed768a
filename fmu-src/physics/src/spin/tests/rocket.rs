//! Delta-v is that of thrust over the mass left at each instant: the rocket equation, and a quadrature of its own.

use approx::assert_relative_eq;
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{ace, directions, firing, launch, paper_start, pulses};
use crate::spin::{
    plant::{Commands, Outputs, Plant, Start},
    spinner::Spinner,
};

const FORCE_N: f64 = 4.448;
const EXHAUST_M_S: f64 = 220.0 * 9.806_65;
const FULL_KG: f64 = 562.0 + 97.5;

fn started(spinner: &Spinner, start: &Start, thrusters: &[u32]) -> Plant {
    Plant::start(spinner, start, directions(), firing(thrusters), 0.0).unwrap()
}

/// Two thrusters along the axis, whose torques cancel, up to the last drop and beyond.
#[test]
fn axial_thrust_follows_the_rocket_equation_at_every_reading() {
    let spinner = ace();
    let flow_kg_s = 2.0 * FORCE_N / EXHAUST_M_S;
    let depletion_time_s = 97.5 / flow_kg_s;
    // With a rate so slow that a panel is limited by the mass it loses, too.
    for rate_rad_s in [std::f64::consts::PI / 6.0, 1e-4] {
        let mut plant =
            started(&spinner, &Start { spin_rate_rad_s: rate_rad_s, ..paper_start(1.483) }, &[7, 9]);
        for share in [1e-9, 1e-6, 1e-4, 0.01, 0.1, 0.123, 0.5, 0.87, 0.99, 0.999_999, 1.01, 1.1] {
            let time_s = share * depletion_time_s;
            plant.advance(&spinner, time_s).unwrap();
            let outputs = Outputs::from_plant(&plant, &spinner);
            let burnt_kg = (flow_kg_s * time_s).min(97.5);
            let expected = -EXHAUST_M_S * (-burnt_kg / FULL_KG).ln_1p();
            assert_relative_eq!(outputs.delta_v_inertial_m_s.z, expected, max_relative = 1e-10);
            assert_relative_eq!(outputs.propellant_remaining_kg, 97.5 - burnt_kg, epsilon = 1e-9);
        }
    }
}

/// A radial thruster on a body that turns and nutates: Simpson's rule over the attitudes it shows.
#[test]
fn radial_thrust_turns_with_the_body() {
    let spinner = ace();
    let start = Start { nutation_rad: 0.02, ..paper_start(1.483) };
    let mut plant = started(&spinner, &start, &[8]);
    let force_body_n = spinner.thrusters[7].force_body_n;
    assert!(force_body_n.z == 0.0);
    let (step_s, intervals) = (0.01, 12_000_u32);
    let mut integral = Vector3::zeros();
    for i in 0..=intervals {
        let time_s = f64::from(i) * step_s;
        if i > 0 {
            plant.advance(&spinner, time_s).unwrap();
        }
        let [x, y, z, w] = Outputs::from_plant(&plant, &spinner).state.attitude.0;
        let inertial_from_body = UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z));
        let acceleration = inertial_from_body * force_body_n / (FULL_KG - FORCE_N / EXHAUST_M_S * time_s);
        let weight = if i == 0 || i == intervals {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        };
        integral += acceleration * (weight * step_s / 3.0);
        if i == 5_000 {
            // In the midst of the pulse: the same rule closed here.
            let seen = Outputs::from_plant(&plant, &spinner).delta_v_inertial_m_s;
            let closed = integral - acceleration * (step_s / 3.0);
            assert!((seen - closed).norm() < 1e-10 * 50.0 * FORCE_N / FULL_KG, "{seen} {closed}");
        }
    }
    let seen = Outputs::from_plant(&plant, &spinner).delta_v_inertial_m_s;
    // Relative to what the thrust would have given without turning.
    assert!((seen - integral).norm() < 1e-10 * 120.0 * FORCE_N / FULL_KG, "{seen} {integral}");
}

#[test]
fn a_pulse_fired_in_two_gives_what_it_gives_in_one() {
    let spinner = ace();
    let pulse = |thruster: usize, on_s: f64| pulses(&[thruster], 0.0, on_s);
    for (thruster, whole_s) in [(8, 1.1), (7, 1.1), (8, 100.0), (7, 100.0)] {
        let launch = || launch(&spinner, &paper_start(1.483));
        let mut one = launch();
        one.command(pulse(thruster, whole_s), directions());
        one.advance(&spinner, 2.0 * whole_s).unwrap();
        let mut two = launch();
        two.command(pulse(thruster, 0.6 * whole_s), directions());
        two.advance(&spinner, 0.6 * whole_s).unwrap();
        two.command(pulse(thruster, 0.4 * whole_s), directions());
        two.advance(&spinner, 1.3 * whole_s).unwrap();
        two.command(Commands::default(), directions());
        two.advance(&spinner, 2.0 * whole_s).unwrap();
        let (one, two) = (Outputs::from_plant(&one, &spinner), Outputs::from_plant(&two, &spinner));
        let apart = (one.delta_v_inertial_m_s - two.delta_v_inertial_m_s).norm();
        assert!(apart < 1e-11 * one.delta_v_inertial_m_s.norm(), "{thruster} {whole_s}: {apart}");
        assert_relative_eq!(one.propellant_used_kg, two.propellant_used_kg, max_relative = 1e-12);
    }
}
