//! Bodies with products of inertia: the tensor's own equations of motion, invariants, and the same body in principal axes.

use approx::assert_relative_eq;
use nalgebra::Vector3;

use super::{
    ace, assert_same_attitude, directions, launch, paper_start, reach, request, runge_kutta, started, tensor,
};
use crate::attitude::{Inertia, Quaternion};
use crate::spin::{
    burn_request::BurnRequest,
    forecast::Timing,
    motion::Motion,
    plant::{Commands, Outputs, Plant, Predictions, PulseCommand},
    spinner::Spinner,
};

const DIAGONAL: [f64; 3] = [225.0, 250.0, 353.82];
const PRODUCTS: [f64; 3] = [6.0, -9.0, 4.0];

fn motion(inertia: &Inertia, rate: Vector3<f64>, torque: Vector3<f64>, damper_s: f64) -> Motion {
    started(inertia, &tensor(DIAGONAL, PRODUCTS), damper_s, rate, torque)
}

#[test]
fn motion_in_body_axes_agrees_with_runge_kutta_on_the_full_tensor() {
    let inertia = Inertia::with_products(DIAGONAL, PRODUCTS).unwrap();
    let rate = Vector3::new(0.02, -0.05, 0.5);
    for torque in [Vector3::zeros(), Vector3::new(1.8, -0.4, 1.1)] {
        let mut motion = motion(&inertia, rate, torque, 0.0);
        reach(&mut motion, 40.0);
        let state = motion.at(40.0);
        let (w, m) = runge_kutta(&tensor(DIAGONAL, PRODUCTS), rate, |_| torque, 40.0, 10_000);
        assert!((state.rate_rad_s(&inertia) - w).norm() < 1e-11);
        assert_same_attitude(state.attitude, &m, 1e-10);
    }
}

#[test]
fn free_motion_keeps_energy_and_inertial_momentum_of_the_full_tensor() {
    let body = tensor(DIAGONAL, PRODUCTS);
    let inertia = Inertia::with_products(DIAGONAL, PRODUCTS).unwrap();
    let rate = Vector3::new(0.04, -0.02, 0.5);
    let mut motion = motion(&inertia, rate, Vector3::zeros(), 0.0);
    let before = motion.at(0.0);
    let energy_j = 0.5 * rate.dot(&(body * rate));
    for i in 1..=200 {
        let time_s = 17.3 * f64::from(i);
        reach(&mut motion, time_s);
        let state = motion.at(time_s);
        let w = state.rate_rad_s(&inertia);
        // The rate, the attitude and the tensor alone.
        let momentum = state.attitude.inertial_from_body(&(body * w));
        assert!((momentum - before.momentum_inertial).norm() < 1e-12 * momentum.norm());
        assert_relative_eq!(0.5 * w.dot(&(body * w)), energy_j, max_relative = 1e-12);
        assert_relative_eq!(super::energy_j(&state, &inertia), energy_j, max_relative = 1e-12);
    }
}

/// Every thruster of a spinner turned with its body.
fn turned(spinner: &Spinner, inertia: &Inertia) -> Spinner {
    let mut turned = spinner.clone();
    for thruster in &mut turned.thrusters {
        for vector in
            [&mut thruster.force_body_n, &mut thruster.position_body_m, &mut thruster.torque_body_n_m]
        {
            *vector = inertia.principal_from_body(vector);
        }
    }
    turned
}

#[test]
fn the_same_body_described_in_principal_axes_moves_the_same() {
    let in_body = ace();
    for (products, damper_s) in [(PRODUCTS, 0.0), ([0.0, 0.0, 3.0], 600.0)] {
        let inertia = Inertia::with_products(DIAGONAL, products).unwrap();
        let in_principal = turned(&in_body, &inertia);
        let mut start = paper_start(1.483);
        (start.inertia_kg_m2, start.products_kg_m2) = (DIAGONAL, products);
        start.damper_time_constant_s = damper_s;
        start.attitude = Quaternion([0.3, 0.1, -0.2, 0.9]).normalized().0;
        for of_one in &mut start.execution {
            of_one.valve.rise_s = 0.03;
            of_one.valve.tail_off_s = 0.05;
            of_one.scatter = 0.1;
        }
        let mut other = start.clone();
        (other.inertia_kg_m2, other.products_kg_m2) = (inertia.principal_kg_m2(), [0.0; 3]);
        other.attitude = inertia.principal_attitude(Quaternion(start.attitude)).0;
        let simulate = |spinner: &Spinner, start| {
            let mut plant = Plant::start(spinner, start, directions(), Commands::default(), 0.0).unwrap();
            for i in 0..60_u32 {
                let mut commands = Commands::default();
                commands.pulses[i as usize % 10] =
                    PulseCommand { delay_s: 0.2, on_s: 0.1 * f64::from(i % 4) };
                commands.any_pulse = true;
                plant.command(commands, directions());
                plant.advance(spinner, f64::from(i + 1)).unwrap();
            }
            Outputs::from_plant(&plant, spinner)
        };
        let (one, two) = (simulate(&in_body, &start), simulate(&in_principal, &other));
        let attitude = inertia.principal_attitude(one.state.attitude);
        for (a, b) in attitude.0.iter().zip(two.state.attitude.0) {
            assert!((a - b).abs() < 1e-12, "{attitude:?} {:?}", two.state.attitude);
        }
        let size = one.state.momentum_inertial.norm();
        assert!((one.state.momentum_inertial - two.state.momentum_inertial).norm() < 1e-12 * size);
        assert!((one.delta_v_inertial_m_s - two.delta_v_inertial_m_s).norm() < 1e-12);
        assert_relative_eq!(one.energy_j, two.energy_j, max_relative = 1e-12);
        assert_relative_eq!(one.spin_rate_rad_s, two.spin_rate_rad_s, max_relative = 1e-12);
        assert_relative_eq!(one.nutation_rad, two.nutation_rad, epsilon = 1e-12);
        assert_relative_eq!(one.predicted_nutation_rad, two.predicted_nutation_rad, epsilon = 1e-12);
        assert!(
            one.nutation_rad > 1e-4 && one.inertia.coning_rad() > 0.02 && two.inertia.coning_rad() == 0.0
        );
    }
}

#[test]
fn the_damper_leaves_a_turn_about_the_major_principal_axis() {
    let inertia = Inertia::with_products(DIAGONAL, PRODUCTS).unwrap();
    let mut motion = motion(&inertia, Vector3::new(0.03, 0.02, 0.5), Vector3::zeros(), 60.0);
    let before = motion.at(0.0);
    reach(&mut motion, 3_000.0);
    let after = motion.at(3_000.0);
    assert!((after.momentum_inertial - before.momentum_inertial).norm() == 0.0);
    assert!(after.nutation_rad(&inertia) < 1e-12);
    // An eigenvector of the tensor: the rate does not change any more.
    let body = tensor(DIAGONAL, PRODUCTS);
    let w = after.rate_rad_s(&inertia);
    assert!(w.cross(&(body * w)).norm() < 1e-11 * (body * w).norm());
    assert_relative_eq!(angle(&w), inertia.coning_rad(), epsilon = 1e-11);
    assert!(inertia.coning_rad() > 0.05);
}

fn angle(vector: &Vector3<f64>) -> f64 {
    vector.xy().norm().atan2(vector.z)
}

#[test]
fn a_start_without_nutation_turns_about_the_principal_axis() {
    let spinner = ace();
    let mut start = paper_start(1.483);
    (start.inertia_kg_m2, start.products_kg_m2) = (DIAGONAL, PRODUCTS);
    let mut plant = launch(&spinner, &start);
    let body = tensor(DIAGONAL, PRODUCTS);
    let w = Outputs::from_plant(&plant, &spinner).rate_rad_s;
    assert!(w.cross(&(body * w)).norm() < 1e-13 * (body * w).norm());
    assert_relative_eq!(w.norm(), start.spin_rate_rad_s, max_relative = 1e-14);
    plant.advance(&spinner, 100.0).unwrap();
    let later = Outputs::from_plant(&plant, &spinner);
    assert!((later.rate_rad_s - w).norm() < 1e-13 && later.nutation_rad < 1e-13);
    // With nutation: the angle and the azimuth requested.
    (start.nutation_rad, start.nutation_phase_rad) = (0.1, 2.0);
    let plant = launch(&spinner, &start);
    let seen = Outputs::from_plant(&plant, &spinner);
    assert_relative_eq!(seen.nutation_rad, 0.1, max_relative = 1e-13);
    assert_relative_eq!(seen.nutation_phase_rad, 2.0, max_relative = 1e-13);
    let axis = w.normalize();
    let tilted = seen.state.momentum_body.normalize();
    assert_relative_eq!(axis.dot(&tilted).acos(), 0.1, max_relative = 1e-12);
}

#[test]
fn burns_of_a_coning_spacecraft_point_at_their_target() {
    let spinner = ace();
    for timing in [Timing::Clock, Timing::SunCrossing, Timing::TruePhase] {
        let mut start = paper_start(1.483);
        start.products_kg_m2 = [0.0, 1.0, -0.5];
        start.burn = Some(BurnRequest { timing, count: 57, ..request() });
        let mut plant = launch(&spinner, &start);
        let from = plant.state().momentum_inertial.normalize();
        plant.advance(&spinner, 1500.0).unwrap();
        let seen = Outputs::from_plant(&plant, &spinner);
        assert!(seen.burn_done && seen.inertia.coning_rad() > 0.009);
        let moved = Predictions::from_plant(&plant).manoeuvre_rad;
        assert_relative_eq!(seen.momentum_displacement_rad, moved, max_relative = 2e-3);
        let target = Vector3::new(0.8, 0.6, 0.0);
        let aside = from.cross(&target).normalize().dot(&seen.state.momentum_inertial.normalize());
        // Without regard to the slit, which is not parallel to the spin axis, 0.05 by Sun crossings.
        assert!(aside.abs() < 0.01 * moved, "{timing:?}: {} of it aside", aside / moved);
    }
}

#[test]
fn tensors_that_no_body_has_are_refused_by_name() {
    let refusal = |products| Inertia::with_products([100.0, 120.0, 140.0], products).unwrap_err().to_string();
    for (products, part) in [
        ([0.0, 0.0, 130.0], "principal moments"),
        ([0.0, 0.0, 50.0], "triangle"),
        ([f64::NAN, 0.0, 0.0], "productsOfInertia[1]"),
        ([0.0, 0.0, f64::INFINITY], "productsOfInertia[3]"),
    ] {
        let text = refusal(products);
        assert!(text.contains(part) && text.contains("productsOfInertia"), "{text}");
    }
    let error = Inertia::with_products([100.0, -1.0, 140.0], [1.0, 0.0, 0.0]).unwrap_err().to_string();
    assert!(error.contains("inertia[2]"), "{error}");
    assert!(Inertia::with_products([100.0, 120.0, 140.0], [0.0, 0.0, 10.0]).is_ok());
}

#[test]
fn the_file_gives_products_for_each_point_of_the_table() {
    let with = |line: &str| {
        let text = super::ACE.replacen(
            "transverse_quotient = 1.0",
            &format!("transverse_quotient = 1.0\n{line}"),
            1,
        );
        Spinner::parse("my.toml", &text)
    };
    let three = "products_of_inertia_kg_m2 = [[0, 0, 0], [1.0, 2.0, -4.0], [3.0, 2.0, 0.0]]";
    let mass = with(three).unwrap().mass_properties;
    assert_eq!(mass.products_kg_m2(-1.0), [0.0; 3]);
    assert_eq!(mass.products_kg_m2(97.5), [1.0, 2.0, -4.0]);
    assert_eq!(mass.products_kg_m2(195.0 - 97.5 / 2.0), [2.0, 2.0, -2.0]);
    assert_eq!(mass.products_kg_m2(400.0), [3.0, 2.0, 0.0]);
    let expected = Inertia::with_products(mass.moments_kg_m2(97.5), [1.0, 2.0, -4.0]).unwrap();
    assert_eq!(mass.inertia(97.5).unwrap(), expected);
    assert_eq!(ace().mass_properties.products_kg_m2(97.5), [0.0; 3]);
    for (line, parts) in [
        ("products_of_inertia_kg_m2 = [[0, 0, 0]]", ["products_of_inertia_kg_m2", "a list of 1"]),
        (
            "products_of_inertia_kg_m2 = [[0, 0, 0], [0, 0, nan], [0, 0, 0]]",
            ["products_of_inertia_kg_m2[2]", "nan"],
        ),
        (
            "products_of_inertia_kg_m2 = [[0, 0, 0], [0, 0, 300], [0, 0, 0]]",
            ["productsOfInertia", "principal"],
        ),
    ] {
        let text = with(line).unwrap_err().to_string().replace("NaN", "nan");
        assert!(parts.iter().all(|part| text.contains(part)), "{text}");
    }
}
