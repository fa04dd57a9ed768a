//! Panel angles that come back within a turn: +180 and -180 deg are one place, and what is shown counts whole turns.

use core::f64::consts::{PI, TAU};

use models::MomentumPlant;

use super::super::named_model::{NamedModel, assert_cuts_change_nothing};
use super::panel_momentum::{BY_ANGLE, HINGED, LOCKED, text};
use super::{DARK, FREE, Start, initialize, to_inertial};

/// Turns on through 180 deg in steps of 0.05 deg.
fn straight_rad(step: u32) -> f64 {
    (178.0 + 0.05 * f64::from(step)).to_radians()
}

#[test]
fn an_angle_that_wraps_turns_the_body_as_one_that_does_not() {
    let named = NamedModel::<MomentumPlant>::with("hinged.toml", &text(HINGED));
    let begin: Start<'_> = &[("panel[1].angle", straight_rad(0)), ("panel[2].angle", -straight_rad(0))];
    let [mut straight, mut wrapped] =
        [(); 2].map(|()| initialize(&named, &[FREE, DARK, LOCKED, BY_ANGLE, begin]));
    for step in 1..=100 {
        let before = to_inertial(&wrapped);
        let angle_rad = straight_rad(step);
        let within_rad = (angle_rad + PI).rem_euclid(TAU) - PI;
        for (flight, angle_rad) in [(&mut straight, angle_rad), (&mut wrapped, within_rad)] {
            flight.set("panel[1].angle", angle_rad);
            flight.set("panel[2].angle", -angle_rad);
            flight.step_to(f64::from(step)).unwrap();
        }
        let turned_rad = before.angle_to(&to_inertial(&wrapped));
        assert!(turned_rad < 2e-4, "{step}: {turned_rad}");
        for (name, angle_rad) in [("panel[1].angleActual", angle_rad), ("panel[2].angleActual", -angle_rad)] {
            assert!((wrapped.real(name) - angle_rad).abs() < 1e-14, "{step}: {name} {}", wrapped.real(name));
            assert_eq!(straight.real(name), angle_rad, "{step}");
        }
        wrapped = wrapped.restored();
    }
    let apart_rad = to_inertial(&straight).angle_to(&to_inertial(&wrapped));
    assert!(apart_rad < 1e-12, "{apart_rad}");
}

/// The body turns about the panels' axis, and they follow the Sun the other way, a turn and more from one look to the next.
#[test]
fn angles_count_the_turns_of_a_flight_however_it_is_cut() {
    let named = NamedModel::<MomentumPlant>::shipped();
    let turning: Start<'_> = &[("attitude.source", 2.0), ("command.rate[1]", 2e-3)];
    let initialize = || initialize(&named, &[turning]);
    let begun = initialize();
    let first_rad = begun.real("panel[1].angleActual");
    assert_cuts_change_nothing(initialize, [4_500.0, 9_000.0, 20_000.0], &[700.0, 61.0], |flight| {
        let turned_rad = (flight.real("panel[1].angleActual") - first_rad).abs();
        let expected_rad = 2e-3 * flight.time_s();
        // The Sun moves by a degree and a half.
        assert!((turned_rad - expected_rad).abs() < 0.03, "{turned_rad} {expected_rad}");
    });
}
