//! Days, obliquities and surface gravities that every almanac prints follow from the rows.
use super::*;
use approx::assert_relative_eq;

#[test]
fn every_body_stands_in_its_row() {
    for body in Body::ALL {
        assert_eq!(body.data().body, body);
        assert_eq!(body.is_planet(), body.data().surface.is_some());
        if let Some(surface) = body.data().surface {
            assert_eq!(surface.validate(), Ok(()));
            assert_eq!(surface.radius_m, body.data().radius_m);
        }
    }
}

#[test]
fn surface_gravity_and_sidereal_day_are_the_almanacs() {
    for (body, gravity_m_s2, day_h) in [
        (Body::Sun, 274.0, 609.12),
        (Body::Mercury, 3.70, 1407.5),
        (Body::Venus, 8.87, -5832.4),
        (Body::Earth, 9.82, 23.9345),
        (Body::Mars, 3.73, 24.6229),
        (Body::Jupiter, 25.92, 9.9250),
    ] {
        let data = body.data();
        let gravity = data.gm_m3_s2 / data.radius_m.powi(2);
        assert_relative_eq!(gravity, gravity_m_s2, max_relative = 2e-3);
        let day = core::f64::consts::TAU / data.rotation_rate_rad_s / 3600.0;
        assert_relative_eq!(day, day_h, max_relative = 1e-3);
    }
}

#[test]
fn equators_lean_on_their_orbits_as_the_almanac_says() {
    let obliquity_j2000_rad = (84_381.448_f64 / 3600.0).to_radians();
    for (body, obliquity_deg, within_deg) in [
        (Body::Sun, 7.25, 0.01),
        (Body::Mercury, 0.034, 0.02),
        (Body::Venus, 2.64, 0.02),
        (Body::Earth, 23.44, 0.01),
        (Body::Mars, 25.19, 0.02),
        (Body::Jupiter, 3.13, 0.02),
    ] {
        let data = body.data();
        let (sin_node, cos_node) = data.orbit_node_rad.sin_cos();
        let (sin_i, cos_i) = data.orbit_inclination_rad.sin_cos();
        let ecliptic = Vector3::new(sin_node * sin_i, -cos_node * sin_i, cos_i);
        let (sin, cos) = obliquity_j2000_rad.sin_cos();
        let normal = Vector3::new(
            ecliptic.x,
            cos * ecliptic.y - sin * ecliptic.z,
            sin * ecliptic.y + cos * ecliptic.z,
        );
        let found_deg = data.pole().angle(&normal).to_degrees();
        assert!((found_deg - obliquity_deg).abs() < within_deg, "{body:?}: {found_deg}");
    }
}
