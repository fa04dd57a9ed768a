//! A Sun elsewhere than sensed is believed for the persistence, and the modes go by what paper 001 lets them.
use nalgebra::Rotation3;

use super::*;
use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::environment::bodies_from_center::fixed;
use crate::guidance::geometry::ephemeris_at_time::TargetPlanet;

const CHECK: Monitor = Monitor { margin_rad: SUN_TOLERANCE_RAD, persistence_s: 3.0 };

fn ephemeris(sun_m: Vector3<f64>) -> EphemerisAtTime {
    let spacecraft = CartesianState { position_m: Vector3::x(), velocity_m_s: Vector3::y() };
    let planet = TargetPlanet::from_body(Body::Mercury.data());
    EphemerisAtTime::new(0.0, planet, &spacecraft, &fixed(sun_m), &fixed(Vector3::z() * 1e11))
}

fn positions() -> BodyPositions {
    let (precise, coarse) = (ephemeris(Vector3::x() * 5e10), ephemeris(Vector3::y() * 5e10));
    BodyPositions { precise: Some(precise), coarse: Some(coarse), by_mode: true }
}

/// An attitude turned about Z, and the Sun sensed in its frame while it stands along X or `off_rad` from there.
fn sensed(off_rad: f64) -> Option<(Attitude, Vector3<f64>)> {
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), 0.7);
    let sun = Rotation3::from_axis_angle(&Vector3::z_axis(), off_rad) * Vector3::x();
    Some((Attitude::from_rotation(&turn), turn.inverse() * sun * 3.0))
}

fn valid_after(offs_rad: &[Option<f64>]) -> bool {
    let mut trust = EphemerisTrust::default();
    for (second, off_rad) in offs_rad.iter().enumerate() {
        trust.sample(Some(&CHECK), second as f64, &positions(), off_rad.and_then(sensed));
    }
    trust.is_valid()
}

#[test]
fn a_disagreement_counts_once_it_has_lasted() {
    let (good, bad) = (Some(0.9 * SUN_TOLERANCE_RAD), Some(1.1 * SUN_TOLERANCE_RAD));
    assert!(valid_after(&[good; 9]));
    assert!(valid_after(&[bad; 3]));
    assert!(!valid_after(&[bad; 4]));
    assert!(!valid_after(&[bad, bad, bad, bad, good, good]), "invalid they stay");
    assert!(valid_after(&[bad, bad, bad, good, bad, bad, bad]));
    assert!(valid_after(&[bad, bad, bad, None, bad, bad, bad]), "nothing sensed contradicts nothing");
}

#[test]
fn a_span_that_is_left_ends_them_at_once_and_lack_of_places_does_not() {
    let mut trust = EphemerisTrust::default();
    trust.sample(None, 0.0, &BodyPositions { precise: None, coarse: None, ..positions() }, None);
    assert!(trust.is_valid());
    trust.sample(None, 0.0, &BodyPositions { precise: None, by_mode: false, ..positions() }, None);
    assert!(trust.is_valid());
    trust.sample(None, 0.0, &BodyPositions { precise: None, ..positions() }, None);
    assert!(!trust.is_valid());
    trust = EphemerisTrust::default();
    assert!(trust.is_valid());
}

#[test]
fn each_mode_goes_by_its_own_models() {
    let (mut trust, positions) = (EphemerisTrust::default(), positions());
    let [precise, coarse] = [positions.precise.as_ref(), positions.coarse.as_ref()];
    let modes = [Mode::Operational, Mode::SafeHold, Mode::EarthAcquisition];
    assert_eq!(modes.map(|mode| positions.in_mode(mode, &trust)), [precise, precise, coarse]);
    trust.sample(None, 0.0, &BodyPositions { precise: None, ..positions }, None);
    assert_eq!(modes.map(|mode| positions.in_mode(mode, &trust)), [precise, coarse, coarse]);
    let alone = BodyPositions { by_mode: false, ..positions };
    assert_eq!(modes.map(|mode| alone.in_mode(mode, &trust)), [precise; 3]);
}
