//! Which values the importer set belongs to the state: it is saved, restored and reset with the values, to the bit.

use client::{InProcess, Names, StatePointer};
use fmi_export::Status;

use super::support::{fresh, names, ok};

const MODEL: &str = "MomentumPlant";
const VENUS: i32 = 3;
/// Of the start values, which are about Mercury.
const ECCENTRICITY: f64 = 0.74;
const SEMI_MAJOR_AXIS_M: f64 = 6e7;

fn real(instance: &mut InProcess, names: &Names, name: &str) -> f64 {
    let mut value = [f64::NAN];
    ok(instance.get_real(&[names.find(name).unwrap()], &mut value));
    value[0]
}

fn distance_m(instance: &mut InProcess, names: &Names) -> f64 {
    (1..=3).map(|axis| real(instance, names, &format!("position[{axis}]")).powi(2)).sum::<f64>().sqrt()
}

/// About Venus on an ellipse whose eccentricity is set to its start value.
fn set(instance: &mut InProcess, names: &Names) {
    ok(instance.set_integer(&[names.find("orbit.center").unwrap()], &[VENUS]));
    ok(instance.set_real(&[names.find("orbit.semiMajorAxis").unwrap()], &[SEMI_MAJOR_AXIS_M]));
    ok(instance.set_real(&[names.find("orbit.eccentricity").unwrap()], &[ECCENTRICITY]));
}

fn bytes(instance: &mut InProcess) -> Vec<u8> {
    let mut state = StatePointer::null();
    ok(instance.get_state(&mut state));
    let (status, bytes) = instance.serialize(&state);
    ok(status);
    bytes
}

fn restored(bytes: &[u8]) -> InProcess {
    let mut instance = fresh(MODEL);
    let (status, state) = instance.deserialize(bytes);
    ok(status);
    ok(instance.set_state(&state));
    instance
}

#[test]
fn what_was_set_is_saved_and_restored_to_the_bit() {
    let names = names(MODEL);
    let mut here = fresh(MODEL);
    set(&mut here, &names);
    let before_the_start = bytes(&mut here);
    let mut there = restored(&before_the_start);
    for instance in [&mut here, &mut there] {
        ok(instance.start(0.0, None));
        // From periapsis; the circle that Venus' own eccentricity is would begin at the axis itself.
        let expected_m = SEMI_MAJOR_AXIS_M * (1.0 - ECCENTRICITY);
        assert!((distance_m(instance, &names) / expected_m - 1.0).abs() < 1e-12);
        ok(instance.do_step(0.0, 600.0));
    }
    let flown = bytes(&mut here);
    assert_eq!(flown, bytes(&mut there));
    // On from a state of the flight, in memory and from bytes.
    let mut state = StatePointer::null();
    ok(here.get_state(&mut state));
    ok(here.do_step(600.0, 600.0));
    let once = bytes(&mut here);
    ok(here.set_state(&state));
    assert_eq!(bytes(&mut here), flown);
    ok(here.do_step(600.0, 600.0));
    assert_eq!(bytes(&mut here), once);
    let mut elsewhere = restored(&flown);
    ok(elsewhere.do_step(600.0, 600.0));
    assert_eq!(bytes(&mut elsewhere), once);
    // A reset forgets it.
    ok(here.reset());
    ok(here.set_integer(&[names.find("orbit.center").unwrap()], &[VENUS]));
    ok(here.set_real(&[names.find("orbit.semiMajorAxis").unwrap()], &[SEMI_MAJOR_AXIS_M]));
    ok(here.start(0.0, None));
    assert!((distance_m(&mut here, &names) / SEMI_MAJOR_AXIS_M - 1.0).abs() < 1e-12);
}

/// Reading outputs in between changes nothing: what follows the centre is settled once initialization ends.
#[test]
fn parameters_that_follow_read_back_once_initialized() {
    let names = names(MODEL);
    let radius = names.find("planet.radius").unwrap();
    for reads in [false, true] {
        let mut instance = fresh(MODEL);
        ok(instance.set_integer(&[names.find("orbit.center").unwrap()], &[4]));
        ok(instance.setup_experiment(0.0, None));
        ok(instance.enter_initialization_mode());
        if reads {
            distance_m(&mut instance, &names);
        }
        ok(instance.set_integer(&[names.find("orbit.center").unwrap()], &[VENUS]));
        ok(instance.exit_initialization_mode());
        // Radius by the IAU, 2015.
        assert_eq!(real(&mut instance, &names, "planet.radius"), 6_051.8e3);
        assert_eq!(real(&mut instance, &names, "orbit.semiMajorAxis"), 3.0 * 6_051.8e3);
        assert_eq!(instance.set_real(&[radius], &[1.0]), Status::Error);
    }
}
