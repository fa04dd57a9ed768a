//! Commanded attitudes as masters make them: interpolated component by component, or left over in guided flight.

use models::MomentumPlant;

use super::pilot::Hangar;

const COMMANDED: (&str, f64) = ("attitude.source", 2.0);

/// A turn by 90 deg about X, half way between two rows of a table.
const HALF_WAY: f64 = 0.25 * core::f64::consts::SQRT_2;

#[test]
fn an_interpolated_quaternion_is_restored() {
    let hangar = Hangar::<MomentumPlant>::shipped();
    let mut flight = hangar.fly(0.0, &[COMMANDED]).unwrap();
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
    for (name, error) in [("command.q[4]", 0.0), ("command.q[4]", 0.05), ("command.q[2]", 20.0)] {
        let hangar = Hangar::<MomentumPlant>::shipped();
        let refused = hangar.fly(0.0, &[COMMANDED, (name, error)]);
        let text = refused.map(|_| ()).unwrap_err().to_string();
        assert!(text.contains("command.q") && text.contains("0.1 to 10"), "{text}");
    }
}

#[test]
fn commands_that_nobody_follows_change_nothing() {
    let hangar = Hangar::<MomentumPlant>::shipped();
    // Either way an input was touched, which ends the cell there.
    let momentum = |command: [f64; 2]| {
        let mut flight = hangar.fly(0.0, &[]).unwrap();
        flight.step_to(600.0).unwrap();
        flight.set("command.q[4]", command[0]);
        flight.set("command.rate[2]", command[1]);
        flight.step_to(86_400.0).unwrap();
        ["momentum.body[1]", "momentum.body[2]", "momentum.body[3]"].map(|name| flight.real(name).to_bits())
    };
    assert_eq!(momentum([0.0, 1.0]), momentum([1.0, 0.0]));
}
