//! Inertial frames and their rotations to EME2000 (mean equator and equinox of J2000; the same as ICRF here).
//!
//! `dcm_a_from_b` turns components in b into components in a. All frames here are fixed: none moves with time.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::bodies::BodyData;
use crate::enumeration::enumeration;
use crate::math;

/// Obliquity of the ecliptic at J2000, rad: 84381.448 arc seconds (IAU 1976, SPICE's ECLIPJ2000).
pub const OBLIQUITY_J2000_RAD: f64 = 84_381.448 / 3600.0 * core::f64::consts::PI / 180.0;
enumeration! {
    /// The frame in which an orbit's elements are given.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
    pub enum Frame {
        /// The planet's orbit plane, from its ascending node on the ecliptic: the Mercury-centred inertial frame of paper 004.
        // x to the ascending node, z normal to the orbit. For the Sun, which has no orbit, the ecliptic.
        1 => PlanetOrbit,
        /// The planet's equator of J2000.
        // x to the ascending node on the EME2000 equator, z to the north pole at J2000 (that of Mercury moves 0.03 deg a century).
        2 => PlanetEquator,
        /// Earth mean equator and equinox of J2000.
        3 => Eme2000,
        /// Ecliptic and equinox of J2000.
        // Mean (SPICE's ECLIPJ2000); paper 004's HCI has these axes.
        4 => Ecliptic,
    }
}

impl Frame {
    /// Components in this frame, which may be the body's own, to components in EME2000.
    pub fn dcm_eme2000_from_frame(self, body: &BodyData) -> Matrix3<f64> {
        match self {
            Self::PlanetOrbit => {
                dcm_eme2000_from_ecliptic()
                    * dcm_reference_from_node_frame(body.orbit_node_rad, body.orbit_inclination_rad)
            }
            Self::PlanetEquator => dcm_from_pole(body.pole_right_ascension_rad, body.pole_declination_rad),
            Self::Eme2000 => Matrix3::identity(),
            Self::Ecliptic => dcm_eme2000_from_ecliptic(),
        }
    }
}

/// Components in the mean ecliptic and equinox of J2000 to components in EME2000.
pub fn dcm_eme2000_from_ecliptic() -> Matrix3<f64> {
    rotation_x(OBLIQUITY_J2000_RAD)
}

/// North of the mean ecliptic of J2000, a unit vector in EME2000.
pub fn ecliptic_north() -> Vector3<f64> {
    dcm_eme2000_from_ecliptic().column(2).into_owned()
}

/// From a frame with x at a plane's ascending node and z along its normal to the reference frame of node and
/// inclination (paper 004 eq 1): Rz(node) Rx(inclination).
pub fn dcm_reference_from_node_frame(ascending_node_rad: f64, inclination_rad: f64) -> Matrix3<f64> {
    rotation_z(ascending_node_rad) * rotation_x(inclination_rad)
}

/// From a body's equator (x at its ascending node on the EME2000 equator, z to the pole) to EME2000.
pub fn dcm_from_pole(right_ascension_rad: f64, declination_rad: f64) -> Matrix3<f64> {
    use core::f64::consts::FRAC_PI_2;
    dcm_reference_from_node_frame(right_ascension_rad + FRAC_PI_2, FRAC_PI_2 - declination_rad)
}

/// Turns a vector by `angle_rad` about x.
pub fn rotation_x(angle_rad: f64) -> Matrix3<f64> {
    let (s, c) = math::sin_cos(angle_rad);
    Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
}

/// Turns a vector by `angle_rad` about y.
pub fn rotation_y(angle_rad: f64) -> Matrix3<f64> {
    let (s, c) = math::sin_cos(angle_rad);
    Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c)
}

/// Turns a vector by `angle_rad` about z.
pub fn rotation_z(angle_rad: f64) -> Matrix3<f64> {
    let (s, c) = math::sin_cos(angle_rad);
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

/// Unit vector at a right ascension and declination.
pub fn direction(right_ascension_rad: f64, declination_rad: f64) -> Vector3<f64> {
    let ((sin_ra, cos_ra), (sin_dec, cos_dec)) =
        (math::sin_cos(right_ascension_rad), math::sin_cos(declination_rad));
    Vector3::new(cos_ra * cos_dec, sin_ra * cos_dec, sin_dec)
}

#[cfg(test)]
mod tests {
    //! Every frame is a proper rotation, and its axes point where astronomy says.

    use super::*;
    use crate::bodies::Body;

    const ALL: [Frame; 4] = [Frame::PlanetOrbit, Frame::PlanetEquator, Frame::Eme2000, Frame::Ecliptic];

    #[test]
    fn proper_rotations() {
        for frame in ALL {
            for body in Body::ALL {
                let dcm = frame.dcm_eme2000_from_frame(body.data());
                assert!((dcm * dcm.transpose() - Matrix3::identity()).norm() < 1e-14, "{frame:?} {body:?}");
                assert!((dcm.determinant() - 1.0).abs() < 1e-14, "{frame:?} {body:?}");
            }
        }
    }

    #[test]
    fn ecliptic_pole_stands_in_draco() {
        // North ecliptic pole of J2000: right ascension 18 h 0 m 0 s, declination 66 deg 33 min 38.55 s.
        let pole = dcm_eme2000_from_ecliptic() * Vector3::z();
        let expected =
            direction(270.0_f64.to_radians(), (66.0 + 33.0 / 60.0 + 38.552 / 3600.0_f64).to_radians());
        assert!((pole - expected).norm() < 1e-9);
    }

    #[test]
    fn mercury_turns_upright_on_its_orbit() {
        // Obliquity 0.034 deg (2.04 arc minutes, Margot et al. 2012), though pole and orbit come from different sources.
        let mercury = Body::Mercury.data();
        let pole = Frame::PlanetEquator.dcm_eme2000_from_frame(mercury) * Vector3::z();
        assert!((pole - mercury.pole()).norm() < 1e-14);
        let orbit_normal = Frame::PlanetOrbit.dcm_eme2000_from_frame(mercury) * Vector3::z();
        let obliquity_deg = pole.angle(&orbit_normal).to_degrees();
        assert!((0.02..0.05).contains(&obliquity_deg), "{obliquity_deg}");
    }

    #[test]
    fn node_axes_lie_in_both_planes() {
        let mercury = Body::Mercury.data();
        let orbit = Frame::PlanetOrbit.dcm_eme2000_from_frame(mercury);
        let ecliptic_normal = dcm_eme2000_from_ecliptic() * Vector3::z();
        assert!((orbit * Vector3::x()).dot(&ecliptic_normal).abs() < 1e-15);
        // Ascending: moving on from the node (along y) leads north of the ecliptic.
        assert!((orbit * Vector3::y()).dot(&ecliptic_normal) > 0.0);
        assert!((ecliptic_normal.angle(&(orbit * Vector3::z())).to_degrees() - 7.0).abs() < 1e-12);
        let equator = Frame::PlanetEquator.dcm_eme2000_from_frame(mercury);
        assert!((equator * Vector3::x()).z.abs() < 1e-15 && (equator * Vector3::y()).z > 0.0);
    }
}
