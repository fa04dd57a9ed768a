//! Commanded attitudes as masters make them: interpolated component by component, or left over in guided flight.

use models::MomentumPlant;
use nalgebra::{Matrix3, Vector3};

use super::named_model::NamedModel;

const COMMANDED: (&str, f64) = ("attitude.source", 2.0);

/// A turn by 90 deg about X, half way between two rows of a table.
const HALF_WAY: f64 = 0.25 * core::f64::consts::SQRT_2;

#[test]
fn an_interpolated_quaternion_is_restored() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let mut flight = named.initialize(0.0, &[COMMANDED]).unwrap();
    flight.step_to(60.0).unwrap();
    flight.set("command.q[1]", HALF_WAY);
    flight.set("command.q[4]", 0.5 + HALF_WAY);
    flight.step_to(120.0).unwrap();
    let eighth = core::f64::consts::FRAC_PI_8;
    for (name, expected) in [
        ("attitude.q[1]", eighth.sin()),
        ("attitude.q[2]", 0.0),
        ("attitude.q[3]", 0.0),
        ("attitude.q[4]", eighth.cos()),
    ] {
        assert!((flight.real(name) - expected).abs() < 4e-15, "{name} is {}", flight.real(name));
    }
}

#[test]
fn four_numbers_without_a_direction_are_refused() {
    for (name, error) in [("command.q[4]", -0.01), ("command.q[4]", 0.05), ("command.q[2]", 20.0)] {
        let named = NamedModel::<MomentumPlant>::shipped();
        let refused = named.initialize(0.0, &[COMMANDED, (name, error)]);
        let text = refused.map(|_| ()).unwrap_err().to_string();
        assert!(text.contains("command.q") && text.contains("0.1 to 10"), "{text}");
    }
}

#[test]
fn commands_that_nobody_follows_change_nothing() {
    let named = NamedModel::<MomentumPlant>::shipped();
    // Either way an input was touched, which ends the cell there.
    let momentum = |command: [f64; 2]| {
        let mut flight = named.initialize(0.0, &[]).unwrap();
        flight.step_to(600.0).unwrap();
        flight.set("command.q[4]", command[0]);
        flight.set("command.rate[2]", command[1]);
        flight.step_to(86_400.0).unwrap();
        ["momentum.body[1]", "momentum.body[2]", "momentum.body[3]"].map(|name| flight.real(name).to_bits())
    };
    assert_eq!(momentum([0.0, 1.0]), momentum([0.7, 2.0]));
}

/// A(q) of a scalar-last quaternion, as paper 001 writes it.
fn direction_cosines(q: [f64; 4]) -> Matrix3<f64> {
    let (v, w) = (Vector3::new(q[0], q[1], q[2]), q[3]);
    Matrix3::identity() * (w * w - v.dot(&v)) + v * v.transpose() * 2.0 - v.cross_matrix() * (2.0 * w)
}

/// Eq 25: the quaternion whose matrix takes the boresight to the sensed Sun.
fn error_quaternion(boresight: &Vector3<f64>, sensed: &Vector3<f64>) -> [f64; 4] {
    let half = 0.5 * boresight.angle(sensed);
    let v = sensed.cross(boresight).normalize() * half.sin();
    let q = [v.x, v.y, v.z, half.cos()];
    assert!((direction_cosines(q) * boresight - sensed).norm() < 1e-14);
    q
}

#[test]
fn an_error_quaternion_brings_the_sun_onto_the_boresight_once() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let start =
        [COMMANDED, ("start.q[1]", 0.5), ("start.q[2]", -0.1), ("start.q[3]", 0.7), ("start.q[4]", 0.5)];
    for boresight in [Vector3::new(0.0, -1.0, 0.0), Vector3::new(0.36, 0.48, -0.8), Vector3::x()] {
        let mut flight = named.initialize(0.0, &[&start[..], &[("command.kind", 3.0)]].concat()).unwrap();
        flight.step_to(60.0).unwrap();
        let send = |flight: &mut super::named_model::NamedInstance<'_, MomentumPlant>, error: [f64; 4]| {
            for (i, x) in error.into_iter().enumerate() {
                flight.set(&format!("command.error[{}]", i + 1), x);
            }
        };
        let sensed = flight.vector("sun.direction");
        assert!(sensed.angle(&boresight) > 0.3);
        send(&mut flight, error_quaternion(&boresight, &sensed));
        flight.set("command.kind", 2.0);
        flight.step_to(61.0).unwrap();
        // Within a second the Sun moves on by 1e-6 rad.
        let off_rad = flight.vector("sun.direction").angle(&boresight);
        assert!(off_rad < 3e-6, "{off_rad}");
        // The sensor still measures what it measured: that error is turned out and turns no more, until the kind is chosen anew.
        send(&mut flight, error_quaternion(&Vector3::z(), &sensed));
        flight.step_to(62.0).unwrap();
        assert!(flight.vector("sun.direction").angle(&boresight) < 3e-6);
        flight.set("command.kind", 3.0);
        flight.step_to(63.0).unwrap();
        let sensed = flight.vector("sun.direction");
        send(&mut flight, error_quaternion(&Vector3::z(), &sensed));
        flight.set("command.kind", 2.0);
        flight.step_to(64.0).unwrap();
        assert!(flight.vector("sun.direction").angle(&Vector3::z()) < 3e-6);
    }
}
