//! The slosh pendulum against the nonlinear motion of a body and a bob on a rod, in a plane, and its closed-form frequency.

use nalgebra::{Matrix3, SMatrix, SVector, Vector2, vector};

use super::*;
use crate::attitude::slosh::across;
use crate::attitude::{Appendages, SloshPendulum};
use crate::numerics::collocation::Collocation;

const MASS_KG: f64 = 1_000.0;
const BOB_KG: f64 = 180.0;
const LENGTH_M: f64 = 0.35;
/// Pivot before and behind the centre of mass along the thrust.
const PIVOTS_M: [f64; 2] = [0.9, -0.5];
const CENTER_M: Vector3<f64> = Vector3::new(0.2, 0.3, -0.1);
const INERTIA: f64 = 450.0;
const ACCELERATION_M_S2: f64 = 0.3;
/// Share of the force across.
const ASIDE: f64 = 1e-6;

fn spacecraft(pivot_m: f64, damping: f64) -> Gyrostat {
    let pendulum = SloshPendulum {
        mass_kg: BOB_KG,
        length_m: LENGTH_M,
        pivot_body_m: CENTER_M + Vector3::y() * pivot_m,
        axis_body: -Vector3::y(),
        coast_frequency_hz: 0.0,
        damping,
    };
    let rigid = Gyrostat::new(Matrix3::from_diagonal_element(INERTIA), Vec::new()).unwrap();
    rigid
        .with_appendages(Appendages { sloshes: vec![pendulum], ..Appendages::default() }, MASS_KG, CENTER_M)
        .unwrap()
}

/// Through the centre of mass of all at rest, along Y, a little along X.
fn thrust() -> BodyLoad {
    let force = Vector3::new(ASIDE, 1.0, 0.0) * (MASS_KG * ACCELERATION_M_S2);
    BodyLoad { force_body_n: [force, Vector3::zeros()], ..BodyLoad::none(MASS_KG) }
}

/// Angular frequency of body and pendulum together, from the determinant of the linear system of both.
fn frequency_rad_s(pivot_m: f64) -> f64 {
    // J w' + m r u'' = m a u, m (1 - m/M) u'' + m r w' = -m a u / L, r along the thrust.
    let bob_m = pivot_m - LENGTH_M;
    let numerator = 1.0 / LENGTH_M + BOB_KG * bob_m / INERTIA;
    let denominator = 1.0 - BOB_KG / MASS_KG - BOB_KG * bob_m * bob_m / INERTIA;
    (ACCELERATION_M_S2 * numerator / denominator).sqrt()
}

#[test]
fn body_and_bob_swing_as_the_rod_between_them_says() {
    for pivot_m in PIVOTS_M {
        let spacecraft = spacecraft(pivot_m, 0.0);
        let mut motion = GyrostatMotion::new(
            &spacecraft,
            0.0,
            Quaternion::IDENTITY,
            &Vector3::zeros(),
            |_| unreachable!(),
        );
        // Place of the body's own centre (x, y), its turn, the rod's angle to the body, and their rates; unknowns: their
        // accelerations and the rod's tension.
        let dry_kg = MASS_KG - BOB_KG;
        let bob_m = pivot_m - LENGTH_M;
        let own_m = -BOB_KG * bob_m / dry_kg;
        let dry_inertia = INERTIA - BOB_KG * bob_m * bob_m - dry_kg * own_m * own_m;
        assert!(dry_inertia > 0.0);
        let turn = |angle: f64, v: Vector2<f64>| {
            let (s, c) = angle.sin_cos();
            vector![c * v.x - s * v.y, s * v.x + c * v.y]
        };
        let left = |v: Vector2<f64>| vector![-v.y, v.x];
        let cross = |a: Vector2<f64>, b: Vector2<f64>| a.x * b.y - a.y * b.x;
        let rhs = |_: f64, y: &SVector<f64, 8>| {
            let (angle, swing, spin, swinging) = (y[2], y[3], y[6], y[7]);
            let pivot = turn(angle, vector![0.0, pivot_m - own_m]);
            let rod = turn(angle + swing, vector![0.0, -1.0]);
            let applied_at = turn(angle, vector![0.0, -own_m]);
            let force = turn(angle, vector![ASIDE, 1.0]) * (MASS_KG * ACCELERATION_M_S2);
            let total = spin + swinging;
            // M0 X'' - T rod = F; J0 th'' - pivot x rod T = x F; m p'' + T rod = 0.
            let mut matrix = SMatrix::<f64, 5, 5>::zeros();
            let mut right = SVector::<f64, 5>::zeros();
            let centripetal = -pivot * spin * spin - rod * (LENGTH_M * total * total);
            for axis in 0..2 {
                matrix[(axis, axis)] = dry_kg;
                matrix[(axis, 4)] = -rod[axis];
                right[axis] = force[axis];
                matrix[(3 + axis, axis)] = BOB_KG;
                matrix[(3 + axis, 2)] = BOB_KG * (left(pivot)[axis] + LENGTH_M * left(rod)[axis]);
                matrix[(3 + axis, 3)] = BOB_KG * LENGTH_M * left(rod)[axis];
                matrix[(3 + axis, 4)] = rod[axis];
                right[3 + axis] = -BOB_KG * centripetal[axis];
            }
            matrix[(2, 2)] = dry_inertia;
            matrix[(2, 4)] = -cross(pivot, rod);
            right[2] = cross(applied_at, force);
            let found = matrix.lu().solve(&right).unwrap();
            SVector::<f64, 8>::from([y[4], y[5], y[6], y[7], found[0], found[1], found[2], found[3]])
        };
        let method = Collocation::<6, 7>::default();
        let mut y = SVector::<f64, 8>::zeros();
        // Where the body's forces and the bob's weight are in balance, relative to whose angle errors are measured.
        let mut largest = 0.0_f64;
        let mut errors = [0.0_f64; 2];
        for step in 0..600 {
            let from_s = 0.1 * f64::from(step);
            (_, y) = method.solve(from_s, from_s + 0.1, &y, None, rhs).unwrap();
            let time_s = from_s + 0.1;
            simulate(&mut motion, &spacecraft, &[], &thrust(), time_s, 0.02);
            let at = motion.at(&spacecraft, time_s);
            // Coordinates across -Y.
            let across_body = across(&spacecraft.appendages().sloshes[0].axis_body);
            let found = (0..2).fold(Vector3::zeros(), |sum, k| {
                let displacement = motion.oscillator(k, time_s, &at)[0];
                sum + across_body[k] * spacecraft.appendages().sloshes[0].angle_rad(displacement)
            });
            // To the right of -Y is -X for a turn that is positive about Z.
            let expected = Vector3::x() * y[3].sin();
            largest = largest.max(y[3].abs());
            errors[0] = errors[0].max((found - expected).norm());
            errors[1] = errors[1].max((at.rate_body_rad_s.z - y[6]).abs());
        }
        assert!(largest > 0.5 * ASIDE && largest < 1e-3, "{largest}");
        let frequency = frequency_rad_s(pivot_m);
        assert!(errors[0] < 1e-5 * largest, "{pivot_m}: {} of {largest}", errors[0]);
        assert!(errors[1] < 1e-5 * largest * frequency, "{pivot_m}: {}", errors[1]);
    }
}

#[test]
fn the_pendulum_swings_at_its_closed_form_frequency() {
    for pivot_m in PIVOTS_M {
        let spacecraft = spacecraft(pivot_m, 0.0);
        let mut motion = GyrostatMotion::new(
            &spacecraft,
            0.0,
            Quaternion::IDENTITY,
            &Vector3::zeros(),
            |_| unreachable!(),
        );
        let period_s = core::f64::consts::TAU / frequency_rad_s(pivot_m);
        let mut largest = 0.0_f64;
        let mut sizes = [0.0; 2];
        let state = |motion: &GyrostatMotion, time_s: f64| {
            let at = motion.at(&spacecraft, time_s);
            [0, 1].map(|k| motion.oscillator(k, time_s, &at))
        };
        for turn in 1..=20 {
            let half_s = (f64::from(turn) - 0.5) * period_s;
            simulate(&mut motion, &spacecraft, &[], &thrust(), half_s, 0.02);
            for (size, [displacement, _]) in sizes.iter_mut().zip(state(&motion, half_s)) {
                *size = displacement;
            }
            largest = largest.max(sizes[0].hypot(sizes[1]));
            // A step from rest is back at rest after every period.
            let full_s = f64::from(turn) * period_s;
            simulate(&mut motion, &spacecraft, &[], &thrust(), full_s, 0.02);
            for [displacement, speed] in state(&motion, full_s) {
                assert!(displacement.abs() < 1e-9 * largest, "{turn}: {displacement:e} of {largest:e}");
                assert!(speed.abs() < 1e-9 * largest * frequency_rad_s(pivot_m));
            }
        }
        assert!(largest > 1e-7);
    }
}

#[test]
fn a_pendulum_on_a_heavy_body_is_a_plain_one() {
    // sqrt(a/L) and the damping ratio itself, with a spring against the tank besides.
    let (damping, coast) = (0.05, 0.4_f64);
    let pendulum = SloshPendulum {
        mass_kg: 1e-9,
        length_m: LENGTH_M,
        pivot_body_m: CENTER_M + Vector3::y(),
        axis_body: -Vector3::y(),
        coast_frequency_hz: coast / core::f64::consts::TAU,
        damping,
    };
    let rigid = Gyrostat::new(Matrix3::from_diagonal_element(INERTIA), Vec::new()).unwrap();
    let spacecraft = rigid
        .with_appendages(Appendages { sloshes: vec![pendulum], ..Appendages::default() }, MASS_KG, CENTER_M)
        .unwrap();
    let mut motion =
        GyrostatMotion::new(&spacecraft, 0.0, Quaternion::IDENTITY, &Vector3::zeros(), |_| unreachable!());
    let along = ACCELERATION_M_S2 * (1.0 + ASIDE * ASIDE).sqrt();
    let free = (along / LENGTH_M + coast * coast).sqrt();
    let ringing = free * (1.0 - damping * damping).sqrt();
    let rest = -ASIDE * ACCELERATION_M_S2 / (free * free) * 1e-9_f64.sqrt();
    for step in 1..=100 {
        let time_s = 0.3 * f64::from(step);
        simulate(&mut motion, &spacecraft, &[], &thrust(), time_s, 0.02);
        let at = motion.at(&spacecraft, time_s);
        let across_body = across(&spacecraft.appendages().sloshes[0].axis_body);
        let found: f64 = (0..2).map(|k| across_body[k].x * motion.oscillator(k, time_s, &at)[0]).sum();
        let (sine, cosine) = (ringing * time_s).sin_cos();
        let decay = (-damping * free * time_s).exp();
        let expected = rest * (1.0 - decay * (cosine + damping * free / ringing * sine));
        assert!((found - expected).abs() < 1e-9 * rest.abs(), "{time_s}: {found:e} {expected:e}");
    }
}
