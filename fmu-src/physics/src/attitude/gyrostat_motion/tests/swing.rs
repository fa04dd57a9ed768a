//! Flexible modes against the damped oscillator about one axis, the balance of energy and an integration of order 12.

use core::f64::consts::TAU;

use approx::assert_relative_eq;
use nalgebra::{Matrix3, Matrix6, SVector, Vector6};

use super::*;
use crate::attitude::wheel::ReactionWheel;
use crate::attitude::{Appendages, FlexibleMode};
use crate::numerics::collocation::Collocation;

const INERTIA: [f64; 3] = [199.6, 507.1, 484.9];
const MASS_KG: f64 = 700.0;

fn mode(frequency_rad_s: f64, damping: f64, coupling: [f64; 3]) -> FlexibleMode {
    FlexibleMode { frequency_hz: frequency_rad_s / TAU, damping, coupling_body_sqrt_kg_m: coupling.into() }
}

fn spacecraft(wheels: Vec<ReactionWheel>, modes: &[FlexibleMode]) -> Gyrostat {
    let appendages = Appendages { modes: modes.to_vec(), ..Appendages::default() };
    let rigid = Gyrostat::new(Matrix3::from_diagonal(&INERTIA.into()), wheels).unwrap();
    rigid.with_appendages(appendages, MASS_KG, Vector3::zeros()).unwrap()
}

fn start(spacecraft: &Gyrostat, rate: Vector3<f64>) -> GyrostatMotion {
    GyrostatMotion::new(spacecraft, 0.0, Quaternion::IDENTITY, &rate, |k| k as f64 - 1.0)
}

#[test]
fn a_mode_rings_at_its_free_frequency_and_damping() {
    let (frequency, damping, coupling, inertia, torque) = (3.0, 0.02, 15.0, INERTIA[2], 0.4);
    let spacecraft = spacecraft(Vec::new(), &[mode(frequency, damping, [0.0, 0.0, coupling])]);
    let mut motion = start(&spacecraft, Vector3::zeros());
    let load =
        BodyLoad { torque_body_n_m: [Vector3::z() * torque, Vector3::zeros()], ..BodyLoad::none(MASS_KG) };
    // e'' (1 - d^2/J) + 2 z w e' + w^2 e = -d T/J: a step from rest.
    let ratio = 1.0 / (1.0 - coupling * coupling / inertia).sqrt();
    assert!(ratio > 1.3);
    let (free, damped) = (frequency * ratio, damping * ratio);
    let ringing = free * (1.0 - damped * damped).sqrt();
    let rest = -coupling * torque / (inertia * frequency * frequency);
    for step in 1..=200 {
        let time_s = 0.1 * f64::from(step);
        simulate(&mut motion, &spacecraft, &[], &load, time_s, 0.02);
        let at = motion.at(&spacecraft, time_s);
        let (sine, cosine) = (ringing * time_s).sin_cos();
        let decay = (-damped * free * time_s).exp();
        let expected = rest * (1.0 - decay * (cosine + damped * free / ringing * sine));
        let speed = rest * decay * free * free / ringing * sine;
        let [found, found_speed] = motion.oscillator(0, time_s, &at);
        assert!((found - expected).abs() < 1e-12 * rest.abs(), "{time_s}: {found} {expected}");
        assert!((found_speed - speed).abs() < 1e-12 * rest.abs() * free, "{time_s}: {found_speed} {speed}");
        let rate = (torque * time_s - coupling * speed) / inertia;
        assert!((at.rate_body_rad_s.z - rate).abs() < 1e-12 * torque * time_s / inertia);
    }
}

/// Three modes on a body with four wheels that turns about all axes.
fn ringing() -> (Gyrostat, [Motor; 4], GyrostatMotion) {
    let mut wheels = pyramid();
    wheels.iter_mut().for_each(|wheel| wheel.viscous_friction_n_m_s = 1e-5);
    let modes = [
        mode(1.3, 0.005, [6.0, -1.0, 2.0]),
        mode(4.1, 0.01, [-2.0, 9.0, 4.0]),
        mode(11.0, 0.0, [1.0, 1.0, -12.0]),
    ];
    let spacecraft = spacecraft(wheels, &modes);
    let motion = start(&spacecraft, Vector3::new(0.02, -0.03, 0.01));
    (spacecraft, [0.02, -0.05, 0.03, 0.01].map(|torque_n_m| Motor { torque_n_m, failed: false }), motion)
}

#[test]
fn modes_keep_the_momentum() {
    let (spacecraft, motors, mut motion) = ringing();
    let total = motion.momentum_inertial_n_m_s;
    simulate(&mut motion, &spacecraft, &motors, &BodyLoad::none(MASS_KG), 100.0, 0.02);
    let at = motion.at(&spacecraft, 100.0);
    assert_eq!(at.momentum_inertial_n_m_s, total);
    // The inertia holds the modes at rest.
    let rigid = spacecraft
        .momentum_body_n_m_s(&at.rate_body_rad_s, |k| motion.rotor_n_m_s(&spacecraft, k, 100.0, &at));
    let formed = spacecraft.appendages().modes.iter().enumerate().fold(rigid, |sum, (k, mode)| {
        let [displacement, speed] = motion.oscillator(k, 100.0, &at);
        assert!(displacement.abs() > 1e-6 && speed.abs() > 1e-6);
        sum + mode.coupling_body_sqrt_kg_m * speed
    });
    assert_relative_eq!(at.attitude.inertial_from_body(&formed), total, max_relative = 1e-12);
}

#[test]
fn only_damping_takes_energy() {
    let (spacecraft, _, mut motion) = ringing();
    // Locked wheels turn with the body.
    let locked =
        spacecraft.wheels().iter().map(|wheel| ReactionWheel { locked: true, ..wheel.clone() }).collect();
    let spacecraft = self::spacecraft(locked, &spacecraft.appendages().modes);
    motion.series.rotors.iter_mut().for_each(|it| it.rotor = Rotor::Held { momentum_n_m_s: 0.0 });
    let mut motion =
        GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &motion.series.rotation.rate[0], |_| 0.0);
    let load = BodyLoad {
        torque_body_n_m: [Vector3::new(0.5, -1.0, 2.0), Vector3::zeros()],
        ..BodyLoad::none(MASS_KG)
    };
    simulate(&mut motion, &spacecraft, &[Motor::default(); 4], &load, 1.0, 0.02);
    let state = |motion: &GyrostatMotion, time_s: f64| {
        let at = motion.at(&spacecraft, time_s);
        let rate = at.rate_body_rad_s;
        let rigid = 0.5 * rate.dot(&(spacecraft.inertia_body_kg_m2() * rate));
        spacecraft.appendages().modes.iter().enumerate().fold([rigid, 0.0], |[energy, loss], (k, mode)| {
            let [displacement, speed] = motion.oscillator(k, time_s, &at);
            let spring = (TAU * mode.frequency_hz) * displacement;
            let coupled = speed * mode.coupling_body_sqrt_kg_m.dot(&rate);
            let own = 0.5 * (speed * speed + spring * spring);
            [energy + own + coupled, loss + 2.0 * mode.damping * (TAU * mode.frequency_hz) * speed * speed]
        })
    };
    let [first, _] = state(&motion, 1.0);
    // Simpson's rule over steps of 10 ms.
    let mut lost = 0.0;
    for step in 0..6_000 {
        let time_s = 1.0 + 0.01 * f64::from(step);
        let begin = state(&motion, time_s)[1];
        simulate(
            &mut motion,
            &spacecraft,
            &[Motor::default(); 4],
            &BodyLoad::none(MASS_KG),
            time_s + 0.005,
            0.005,
        );
        let middle = state(&motion, time_s + 0.005)[1];
        simulate(
            &mut motion,
            &spacecraft,
            &[Motor::default(); 4],
            &BodyLoad::none(MASS_KG),
            time_s + 0.01,
            0.005,
        );
        lost += (begin + 4.0 * middle + state(&motion, time_s + 0.01)[1]) * (0.01 / 6.0);
    }
    let [last, _] = state(&motion, 61.0);
    assert!(lost > 1e-4 * first, "{lost} of {first}");
    assert!((first - last - lost).abs() < 1e-7 * lost, "{} {lost}", first - last);
}

#[test]
fn an_integration_of_order_twelve_agrees() {
    // Newton and Euler with two modes, an inertia with products, and a torque: rate and modes' accelerations from one
    // linear system.
    let modes = [mode(1.3, 0.005, [6.0, -1.0, 2.0]), mode(4.1, 0.3, [-2.0, 9.0, 4.0])];
    let inertia = Matrix3::new(200.0, 11.0, -7.0, 11.0, 480.0, 5.0, -7.0, 5.0, 440.0);
    let appendages = Appendages { modes: modes.to_vec(), ..Appendages::default() };
    let spacecraft = Gyrostat::new(inertia, Vec::new())
        .unwrap()
        .with_appendages(appendages, MASS_KG, Vector3::zeros())
        .unwrap();
    let (rate, torque) = (Vector3::new(0.02, -0.03, 0.05), Vector3::new(0.3, 0.1, -0.2));
    let mut motion = start(&spacecraft, rate);
    let load = BodyLoad { torque_body_n_m: [torque, Vector3::zeros()], ..BodyLoad::none(MASS_KG) };
    simulate(&mut motion, &spacecraft, &[], &load, 50.0, 0.02);
    let at = motion.at(&spacecraft, 50.0);

    // Attitude (scalar last), rate, displacements, speeds.
    let rhs = |_: f64, y: &SVector<f64, 11>| {
        let (rate, speeds) = (y.fixed_rows::<3>(4).into_owned(), [y[9], y[10]]);
        let mut momentum = inertia * rate;
        let mut matrix = Matrix6::identity();
        let mut right = Vector6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&inertia);
        for (k, mode) in modes.iter().enumerate() {
            let coupling = mode.coupling_body_sqrt_kg_m;
            momentum += coupling * speeds[k];
            matrix.fixed_view_mut::<3, 1>(0, 3 + k).copy_from(&coupling);
            matrix.fixed_view_mut::<1, 3>(3 + k, 0).copy_from(&coupling.transpose());
            let w = TAU * mode.frequency_hz;
            right[3 + k] = -2.0 * mode.damping * w * speeds[k] - w * w * y[7 + k];
        }
        right.fixed_rows_mut::<3>(0).copy_from(&(torque - rate.cross(&momentum)));
        let solved = matrix.lu().solve(&right).unwrap();
        let q = nalgebra::Quaternion::new(y[3], y[0], y[1], y[2]);
        let turned = q * nalgebra::Quaternion::from_imag(rate) * 0.5;
        let mut rates = SVector::<f64, 11>::zeros();
        rates.fixed_rows_mut::<4>(0).copy_from(&turned.coords);
        rates
            .fixed_rows_mut::<5>(4)
            .copy_from(&SVector::<f64, 5>::from([solved[0], solved[1], solved[2], y[9], y[10]]));
        (rates[9], rates[10]) = (solved[3], solved[4]);
        rates
    };
    let method = Collocation::<6, 7>::default();
    let mut y = SVector::<f64, 11>::zeros();
    y[3] = 1.0;
    y.fixed_rows_mut::<3>(4).copy_from(&rate);
    for step in 0..1_000 {
        let from_s = 0.05 * f64::from(step);
        (_, y) = method.solve(from_s, from_s + 0.05, &y, None, rhs).unwrap();
    }
    let expected = y.fixed_rows::<3>(4).into_owned();
    assert!((at.rate_body_rad_s - expected).norm() < 1e-11 * expected.norm(), "{expected}");
    let away: f64 = (0..4).map(|i| (at.attitude.0[i] - y[i]).abs()).sum();
    let turned: f64 = (0..4).map(|i| (at.attitude.0[i] + y[i]).abs()).sum();
    assert!(away.min(turned) < 1e-11, "{away:e} {turned:e}");
    for k in 0..2 {
        let [displacement, speed] = motion.oscillator(k, 50.0, &at);
        let size = y[7].hypot(y[8]);
        assert!((displacement - y[7 + k]).abs() < 1e-10 * size, "{displacement} {}", y[7 + k]);
        assert!((speed - y[9 + k]).abs() < 1e-10 * size * TAU * modes[1].frequency_hz);
    }
}

#[test]
fn long_segments_give_what_short_ones_give() {
    let simulate_in = |piece_s: f64| {
        let (spacecraft, motors, mut motion) = ringing();
        simulate(&mut motion, &spacecraft, &motors, &BodyLoad::none(MASS_KG), 20.0, piece_s);
        let at = motion.at(&spacecraft, 20.0);
        (at.rate_body_rad_s, motion.oscillator(2, 20.0, &at))
    };
    let (short, long) = (simulate_in(0.003), simulate_in(10.0));
    assert_relative_eq!(short.0, long.0, max_relative = 1e-11);
    assert_relative_eq!(
        Vector3::from([short.1[0], short.1[1], 0.0]),
        Vector3::from([long.1[0], long.1[1], 0.0]),
        max_relative = 1e-11
    );
}

#[test]
fn bodies_with_too_much_that_swings_are_refused() {
    let appendages = Appendages { modes: vec![mode(1.0, 0.0, [14.2, 0.0, 0.0])], ..Appendages::default() };
    let rigid = Gyrostat::new(Matrix3::from_diagonal(&INERTIA.into()), Vec::new()).unwrap();
    let reported = rigid.with_appendages(appendages, MASS_KG, Vector3::zeros()).unwrap_err().to_string();
    assert!(reported.contains("flexibleMode[k].coupling"), "{reported}");
}
