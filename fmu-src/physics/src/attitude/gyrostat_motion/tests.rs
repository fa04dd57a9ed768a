//! Against closed forms: Jacobi's elliptic functions for the free body, exponentials for a rotor under friction, and the
//! invariants.

mod dipole;
mod imbalance;
mod mass_flow;
mod slosh;
mod swing;

use approx::assert_relative_eq;
use nalgebra::Matrix3;

use super::*;
use crate::attitude::ReactionWheel;
use crate::tests::short_or_long;

const INERTIA: [f64; 3] = [199.6, 507.1, 484.9];

impl GyrostatMotion {
    /// Continues from the end with the body as it is there.
    fn advance(&mut self, gyrostat: &Gyrostat, motors: &[Motor], load: &BodyLoad, limit_s: f64) {
        let end = self.evaluated_at(gyrostat, self.end_s);
        self.advance_from(&end, gyrostat, motors, load, limit_s);
    }
}

fn wheel(axis_body: Vector3<f64>) -> ReactionWheel {
    ReactionWheel {
        axis_body,
        inertia_kg_m2: 0.0127,
        max_torque_n_m: 0.075,
        capacity_n_m_s: 8.0,
        bias_n_m_s: 0.0,
        coulomb_friction_n_m: 0.0,
        viscous_friction_n_m_s: 0.0,
        locked: false,
    }
}

pub(super) fn pyramid() -> Vec<ReactionWheel> {
    let c = (1.0f64 / 3.0).sqrt();
    [(c, c), (c, -c), (-c, -c), (-c, c)].iter().map(|&(x, z)| wheel(Vector3::new(x, c, z))).collect()
}

fn spacecraft(wheels: Vec<ReactionWheel>) -> Gyrostat {
    Gyrostat::new(Matrix3::from_diagonal(&INERTIA.into()), wheels).unwrap()
}

/// Simulates on to `end_s` in pieces of at most `piece_s`.
pub(super) fn simulate(
    motion: &mut GyrostatMotion,
    spacecraft: &Gyrostat,
    motors: &[Motor],
    load: &BodyLoad,
    end_s: f64,
    piece_s: f64,
) -> usize {
    let mut segments = 0;
    while motion.end_s() < end_s {
        let next_s = ((motion.end_s() / piece_s + 1e-9).floor() + 1.0) * piece_s;
        motion.advance(spacecraft, motors, load, next_s.min(end_s));
        segments += 1;
        assert!(segments < 10_000_000);
    }
    segments
}

/// Jacobi's sn, cn, dn by the arithmetic-geometric mean (Abramowitz and Stegun, 16.4).
fn jacobi(u: f64, m: f64) -> [f64; 3] {
    let (mut a, mut b, mut c) = (vec![1.0], (1.0 - m).sqrt(), vec![m.sqrt()]);
    while c.last().unwrap().abs() > 1e-17 && a.len() < 30 {
        let last = *a.last().unwrap();
        c.push(0.5 * (last - b));
        a.push(0.5 * (last + b));
        b = (last * b).sqrt();
    }
    let n = a.len() - 1;
    let mut phi = 2f64.powi(n as i32) * a[n] * u;
    let mut before = phi;
    for k in (1..=n).rev() {
        before = phi;
        phi = 0.5 * (phi + (c[k] / a[k] * phi.sin()).asin());
    }
    let _ = before;
    [phi.sin(), phi.cos(), (1.0 - m * phi.sin().powi(2)).sqrt()]
}

#[test]
fn a_free_body_turns_as_jacobi_says() {
    // I1 < I3 < I2: about the axes of least and greatest inertia, momentum nearer to the greatest.
    let spacecraft = spacecraft(Vec::new());
    let [i1, i2, i3] = INERTIA;
    // Axes ordered a (greatest), b (middle), c (least): y, z, x; starts in the plane of a and c.
    let (a, b, c) = (i2, i3, i1);
    let rate = Vector3::new(0.004, 0.03, 0.0);
    let energy = 0.5 * (c * rate.x * rate.x + a * rate.y * rate.y);
    let squared = (c * rate.x).powi(2) + (a * rate.y).powi(2);
    // Landau and Lifshitz, Mechanics, section 37, with I1 < I2 < I3 as c, b, a and M^2 > 2 E b.
    let two_e = 2.0 * energy;
    assert!(squared > two_e * b);
    let tau = ((a - b) * (squared - two_e * c) / (a * b * c)).sqrt();
    let m = (b - c) * (two_e * a - squared) / ((a - b) * (squared - two_e * c));
    let sizes = [
        ((two_e * a - squared) / (c * (a - c))).sqrt(),
        ((two_e * a - squared) / (b * (a - b))).sqrt(),
        ((squared - two_e * c) / (a * (a - c))).sqrt(),
    ];
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &rate, |_| unreachable!());
    let mut worst = 0.0_f64;
    for minute in 1..=60 {
        let time_s = 60.0 * f64::from(minute);
        simulate(&mut motion, &spacecraft, &[], &BodyLoad::none(1.0), time_s, 0.02);
        let found = motion.at(&spacecraft, time_s);
        let [sn, cn, dn] = jacobi(tau * time_s, m);
        // c = x, b = z, a = y is a left-handed order: the middle axis runs the other way.
        let expected = Vector3::new(sizes[0] * cn, sizes[2] * dn, -sizes[1] * sn);
        worst = worst.max((found.rate_body_rad_s - expected).norm() / expected.norm());
        // The attitude's two angles about the momentum follow from momentum in the body; the third from its rate there.
        let momentum = found.attitude.body_from_inertial(&motion.momentum_inertial_n_m_s);
        let in_body = Vector3::new(c * expected.x, a * expected.y, b * expected.z);
        worst = worst.max((momentum - in_body).norm() / in_body.norm());
    }
    assert!(worst < 1e-10, "{worst:e}");
    // The turn about the momentum: its rate is M (I_c w_c^2 + I_b w_b^2) / (I_c^2 w_c^2 + I_b^2 w_b^2), by Simpson's rule.
    let norm = squared.sqrt();
    let precession = |time_s: f64| {
        let [sn, cn, _] = jacobi(tau * time_s, m);
        let (x, z) = (sizes[0] * cn, sizes[1] * sn);
        norm * (c * x * x + b * z * z) / ((c * x).powi(2) + (b * z).powi(2))
    };
    let steps = 200_000;
    let step_s = 3600.0 / f64::from(steps);
    let sum: f64 = (0..=steps)
        .map(|k| {
            let weight = match k {
                0 => 1.0,
                k if k == steps => 1.0,
                k if k % 2 == 1 => 4.0,
                _ => 2.0,
            };
            weight * precession(step_s * f64::from(k))
        })
        .sum();
    let turned = sum * step_s / 3.0;
    // Angle of the body's axis a about the momentum.
    let motion_end = motion.at(&spacecraft, 3600.0);
    let along = motion.momentum_inertial_n_m_s.normalize();
    let angle = |q: &Quaternion| {
        let axis = q.inertial_from_body(&Vector3::y());
        let x = along.cross(&Vector3::z()).normalize();
        axis.dot(&along.cross(&x)).atan2(axis.dot(&x))
    };
    let found = angle(&motion_end.attitude) - angle(&Quaternion::IDENTITY);
    let difference = (found - turned).sin().asin();
    assert!(difference.abs() < 1e-9, "{difference:e}");
}

#[test]
fn momentum_and_energy_are_kept() {
    let end_s = short_or_long(3_600.0, 86_400.0);
    let mut locked = pyramid();
    locked.iter_mut().for_each(|wheel| wheel.locked = true);
    let spacecraft = spacecraft(locked);
    let rate = Vector3::new(2e-3, -1e-3, 3e-3);
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &rate, |_| 0.0);
    let energy = |motion: &BodyMotion| {
        0.5 * motion.rate_body_rad_s.dot(&(spacecraft.inertia_body_kg_m2() * motion.rate_body_rad_s))
    };
    let first = motion.at(&spacecraft, 0.0);
    simulate(&mut motion, &spacecraft, &[Motor::default(); 4], &BodyLoad::none(1.0), end_s, 0.02);
    let last = motion.at(&spacecraft, end_s);
    assert_eq!(last.momentum_inertial_n_m_s, first.momentum_inertial_n_m_s);
    assert_relative_eq!(energy(&last), energy(&first), max_relative = 1e-10);
    let formed =
        last.attitude.inertial_from_body(&spacecraft.momentum_body_n_m_s(&last.rate_body_rad_s, |_| 0.0));
    assert_relative_eq!(formed, first.momentum_inertial_n_m_s, max_relative = 1e-12);
}

#[test]
fn a_rotor_runs_up_and_down_as_the_exponential_says() {
    // On a body so heavy that it does not turn.
    let mut one = wheel(Vector3::z());
    (one.coulomb_friction_n_m, one.viscous_friction_n_m_s) = (2e-3, 3e-5);
    let (friction, damping) = (one.coulomb_friction_n_m, one.viscous_friction_n_m_s / one.inertia_kg_m2);
    let spacecraft = Gyrostat::new(Matrix3::from_diagonal_element(1e9), vec![one]).unwrap();
    let still = Vector3::zeros();
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &still, |_| 0.0);
    let free = BodyLoad::none(1.0);
    let torque = 0.02;
    let up = [Motor { torque_n_m: torque, failed: false }];
    let momentum = |motion: &GyrostatMotion, time_s| {
        motion.rotor_n_m_s(&spacecraft, 0, time_s, &motion.at(&spacecraft, time_s))
    };
    simulate(&mut motion, &spacecraft, &up, &free, 120.0, 1.0);
    let top = (torque - friction) / damping * (1.0 - (-damping * 120.0_f64).exp());
    assert_relative_eq!(momentum(&motion, 120.0), top, max_relative = 1e-7);
    // Down without motor: h + c / k decays, to rest at k t = ln(1 + k h / c), and stays there.
    let off = [Motor { torque_n_m: 0.0, failed: true }];
    let rest_s = 120.0 + (1.0 + damping * top / friction).ln() / damping;
    simulate(&mut motion, &spacecraft, &off, &free, 200.0, 1.0);
    let expected = (top + friction / damping) * (-damping * 80.0_f64).exp() - friction / damping;
    assert_relative_eq!(momentum(&motion, 200.0), expected, max_relative = 1e-7);
    while motion.end_s() < rest_s + 10.0 {
        let (start_s, before) = (motion.end_s(), momentum(&motion, motion.end_s()));
        motion.advance(&spacecraft, &off, &free, (start_s + 1e-9).floor() + 1.0);
        if before > 1e-9 && momentum(&motion, motion.end_s()).abs() < 1e-9 {
            assert!((motion.end_s() - rest_s).abs() < 1e-4, "{} {rest_s}", motion.end_s());
        }
    }
    assert_eq!(momentum(&motion, motion.end_s()), 0.0);
    // Friction holds less than itself, and lets go above.
    let weak = [Motor { torque_n_m: 0.9 * friction, failed: false }];
    let end_s = motion.end_s() + 10.0;
    simulate(&mut motion, &spacecraft, &weak, &free, end_s, 1.0);
    assert_eq!(momentum(&motion, end_s), 0.0);
    let strong = [Motor { torque_n_m: -1.1 * friction, failed: false }];
    simulate(&mut motion, &spacecraft, &strong, &free, end_s + 10.0, 1.0);
    let expected = -0.1 * friction / damping * (1.0 - (-damping * 10.0_f64).exp());
    assert_relative_eq!(momentum(&motion, end_s + 10.0), expected, max_relative = 1e-6);
}

#[test]
fn a_rotor_stops_at_its_capacity_and_leaves_it() {
    let spacecraft = spacecraft(pyramid());
    let still = Vector3::zeros();
    let mut motion =
        GyrostatMotion::new(
            &spacecraft,
            0.0,
            Quaternion::IDENTITY,
            &still,
            |k| if k == 0 { 7.0 } else { 0.0 },
        );
    let total = motion.momentum_inertial_n_m_s;
    let free = BodyLoad::none(1.0);
    let mut motors = [Motor::default(); 4];
    motors[0].torque_n_m = 0.075;
    simulate(&mut motion, &spacecraft, &motors, &free, 60.0, 0.02);
    let at = motion.at(&spacecraft, 60.0);
    assert_eq!(motion.rotor_n_m_s(&spacecraft, 0, 60.0, &at), 8.0);
    assert!(spacecraft.wheels()[0].is_saturated(8.0));
    // The body took what the wheel took, and turns on freely once the wheel is full.
    let relative = at.attitude.inertial_from_body(
        &spacecraft
            .momentum_body_n_m_s(&at.rate_body_rad_s, |k| motion.rotor_n_m_s(&spacecraft, k, 60.0, &at)),
    );
    assert_relative_eq!(relative, total, max_relative = 1e-12);
    motors[0].torque_n_m = -0.075;
    simulate(&mut motion, &spacecraft, &motors, &free, 61.0, 0.02);
    let at = motion.at(&spacecraft, 61.0);
    let left = motion.rotor_n_m_s(&spacecraft, 0, 61.0, &at);
    assert!((left - (8.0 - 0.075)).abs() < 1e-4 && !spacecraft.wheels()[0].is_saturated(left), "{left}");
}

#[test]
fn momenta_kept_with_the_motion_are_those_of_the_series() {
    // More rotors than are kept, one of them held and one under viscous friction.
    let mut wheels = pyramid();
    wheels.extend([wheel(Vector3::x()), wheel(Vector3::z())]);
    wheels[1].locked = true;
    wheels[2].viscous_friction_n_m_s = 1e-5;
    let spacecraft = spacecraft(wheels);
    let rate = Vector3::new(0.01, -0.02, 0.015);
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &rate, |k| 0.3 * k as f64);
    let motors = [Motor { torque_n_m: 0.01, failed: false }; 6];
    motion.advance(&spacecraft, &motors, &BodyLoad::none(1.0), 0.5);
    let at = motion.evaluated_at(&spacecraft, 0.3);
    for k in 0..6 {
        let evaluated = motion.rotor_n_m_s(&spacecraft, k, 0.3, &at.body);
        assert_eq!(motion.rotor_at_n_m_s(&spacecraft, k, &at), evaluated);
    }
}

#[test]
fn torque_and_force_add_up() {
    // About one axis the angle under constant torque is known; force turns with the body.
    let spacecraft = spacecraft(pyramid());
    let still = Vector3::zeros();
    let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &still, |_| 0.0);
    let (torque, slope) = (0.05, 1e-4);
    // The rotors' own axial momentum stays: the body turns as if they had no inertia along it.
    let inertia = INERTIA[1] - 4.0 * 0.0127 / 3.0;
    let rate = |t: f64| (torque * t + 0.5 * slope * t * t) / inertia;
    let angle = |t: f64| (0.5 * torque * t * t + slope * t.powi(3) / 6.0) / inertia;
    let mut time_s: f64 = 0.0;
    while time_s < 100.0 {
        let load = BodyLoad {
            torque_body_n_m: [Vector3::y() * (torque + slope * time_s), Vector3::y() * slope],
            force_body_n: [Vector3::z() * 0.5, Vector3::zeros()],
            ..BodyLoad::none(500.0)
        };
        motion.advance(&spacecraft, &[Motor::default(); 4], &load, time_s + 0.5);
        time_s = motion.end_s();
    }
    let at = motion.at(&spacecraft, time_s);
    assert_relative_eq!(at.rate_body_rad_s, Vector3::y() * rate(time_s), max_relative = 1e-12);
    assert_relative_eq!(
        Vector3::from_row_slice(&at.attitude.0[..3]),
        Vector3::y() * (0.5 * angle(time_s)).sin(),
        max_relative = 1e-12
    );
    // By Simpson's rule over the known angle.
    let steps = 100_000;
    let step_s = time_s / f64::from(steps);
    let sum = (0..=steps).fold(Vector3::zeros(), |sum: Vector3<f64>, k| {
        let weight = if k == 0 || k == steps {
            1.0
        } else if k % 2 == 1 {
            4.0
        } else {
            2.0
        };
        let (sine, cosine) = angle(step_s * f64::from(k)).sin_cos();
        sum + Vector3::new(sine, 0.0, cosine) * (weight * step_s / 3.0 * 1e-3)
    });
    assert_relative_eq!(at.delta_v_inertial_m_s, sum, max_relative = 1e-11);
}

#[test]
fn long_segments_give_what_short_ones_give() {
    let mut wheels = pyramid();
    wheels.iter_mut().for_each(|wheel| wheel.viscous_friction_n_m_s = 1e-4);
    let spacecraft = spacecraft(wheels);
    let rate = Vector3::new(0.02, -0.03, 0.05);
    let motors = [0.01, -0.02, 0.03, 0.005].map(|torque_n_m| Motor { torque_n_m, failed: false });
    let simulate_in = |piece_s: f64| {
        let mut motion =
            GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &rate, |k| k as f64 - 1.0);
        simulate(&mut motion, &spacecraft, &motors, &BodyLoad::none(1.0), 50.0, piece_s);
        motion.at(&spacecraft, 50.0)
    };
    let (short, long) = (simulate_in(0.01), simulate_in(10.0));
    assert_relative_eq!(short.rate_body_rad_s, long.rate_body_rad_s, max_relative = 1e-12);
    for (a, b) in short.attitude.0.iter().zip(long.attitude.0) {
        assert!((a - b).abs() < 1e-13, "{a} {b}");
    }
}

#[test]
fn impossible_bodies_are_refused() {
    let mut heavy = pyramid();
    heavy[0].inertia_kg_m2 = 1e4;
    let reported =
        |wheels| Gyrostat::new(Matrix3::from_diagonal(&INERTIA.into()), wheels).unwrap_err().to_string();
    assert!(reported(heavy).contains("principal moment"));
    let mut none = pyramid();
    none[2].axis_body = Vector3::zeros();
    assert!(reported(none).contains("wheel[3].axis"));
    let mut light = pyramid();
    light[1].inertia_kg_m2 = 0.0;
    assert!(reported(light).contains("wheel[2].inertia"));
}

#[test]
fn no_wheels_make_the_motion_stand_still() {
    // Rest, breakaway, capacity and their edges, drawn at random: no second takes segments without end.
    let mut seed = 12345_u64;
    let mut random = || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    for case in 0..1_000 {
        let count = 1 + (4.0 * random()) as usize;
        let wheels: Vec<_> = (0..count)
            .map(|_| {
                let axis = Vector3::new(random() - 0.5, random() - 0.5, random() - 0.5);
                ReactionWheel {
                    inertia_kg_m2: 0.005 + 0.045 * random(),
                    capacity_n_m_s: [8.0, 1e-3, 0.1][(3.0 * random()) as usize],
                    bias_n_m_s: 0.0,
                    coulomb_friction_n_m: if random() < 0.5 { 1e-5 * 100_f64.powf(random()) } else { 0.0 },
                    viscous_friction_n_m_s: if random() < 0.5 { 1e-6 * 100_f64.powf(random()) } else { 0.0 },
                    locked: random() < 0.1,
                    ..wheel(axis)
                }
            })
            .collect();
        let inertia = if random() < 0.3 { [1.0, 1.5, 1.2] } else { INERTIA };
        let spacecraft = Gyrostat::new(Matrix3::from_diagonal(&inertia.into()), wheels).unwrap();
        let shares: Vec<f64> = (0..count).map(|_| [1.0, 0.0, -1.0, 0.3][(4.0 * random()) as usize]).collect();
        let held = |k: usize| {
            let wheel = &spacecraft.wheels()[k];
            if wheel.locked { 0.0 } else { shares[k] * wheel.capacity_n_m_s }
        };
        let rate = Vector3::new(random() - 0.5, random() - 0.5, random() - 0.5) * 0.02;
        let mut motion = GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &rate, held);
        let mut momenta: Vec<f64> = (0..count).map(held).collect();
        for second in 1..=20 {
            let motors: Vec<_> = (0..count)
                .map(|_| {
                    let torque_n_m = [0.05, -0.05, 1e-4, 0.0, 2e-5][(5.0 * random()) as usize];
                    let failed = random() < 0.1;
                    Motor { torque_n_m: if failed { 0.0 } else { torque_n_m }, failed }
                })
                .collect();
            let torque = Vector3::new(random() - 0.5, random() - 0.5, random() - 0.5) * 0.02;
            let load = BodyLoad { torque_body_n_m: [torque, torque * 0.1], ..BodyLoad::none(1.0) };
            let (end_s, mut segments) = (f64::from(second), 0);
            while motion.end_s() < end_s {
                motion.advance(&spacecraft, &motors, &load, end_s);
                segments += 1;
                assert!(segments < 2_000, "case {case}, at {}: {motors:?} {spacecraft:?}", motion.end_s());
            }
            let at = motion.at(&spacecraft, end_s);
            for (k, wheel) in spacecraft.wheels().iter().enumerate() {
                let found = motion.rotor_n_m_s(&spacecraft, k, end_s, &at);
                // No motor drives a rotor beyond; a body that turns may.
                let driven = motors[k].torque_n_m * found > 0.0 && momenta[k].abs() <= wheel.capacity_n_m_s;
                let most = wheel.capacity_n_m_s * (1.0 + 1e-9);
                assert!(
                    !driven || wheel.locked || found.abs() <= most,
                    "case {case}, wheel {k}: {found} of {most}"
                );
                momenta[k] = found;
            }
        }
    }
}
