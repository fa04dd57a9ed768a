//! Inertial frames and their rotations to EME2000 (mean equator and equinox of J2000; the same as ICRF here).
//!
//! `dcm_a_from_b` turns components in b into components in a. All frames here are fixed: none moves with time.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

/// Obliquity of the ecliptic at J2000, rad: 84381.448 arc seconds (IAU 1976, SPICE's ECLIPJ2000).
pub const OBLIQUITY_J2000_RAD: f64 = 84_381.448 / 3600.0 * core::f64::consts::PI / 180.0;
/// Right ascension of Mercury's north pole at J2000, rad (281.0103 deg, IAU working group 2015).
pub const MERCURY_POLE_RIGHT_ASCENSION_RAD: f64 = 281.010_3 * core::f64::consts::PI / 180.0;
/// Declination of Mercury's north pole at J2000, rad (61.4155 deg, IAU working group 2015).
pub const MERCURY_POLE_DECLINATION_RAD: f64 = 61.415_5 * core::f64::consts::PI / 180.0;
/// Ascending node of Mercury's orbit on the ecliptic, rad (48.33 deg, paper 004 Table 4).
pub const PAPER_004_MERCURY_NODE_RAD: f64 = 48.33 * core::f64::consts::PI / 180.0;
/// Inclination of Mercury's orbit to the ecliptic, rad (7.0 deg, paper 004 Table 4).
pub const PAPER_004_MERCURY_INCLINATION_RAD: f64 = 7.0 * core::f64::consts::PI / 180.0;

/// The frame in which an orbit's elements are given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Frame {
    /// Paper 004's MCI: x to the ascending node of Mercury's orbit on the ecliptic, z normal to that orbit, with the
    /// node and inclination of its Table 4.
    Paper004Mci,
    /// x to the ascending node of Mercury's equator on the EME2000 equator, z to Mercury's north pole (IAU 2015, at
    /// J2000; it moves 0.03 deg a century).
    MercuryEquator,
    /// Mean equator and equinox of J2000.
    Eme2000,
    /// Mean ecliptic and equinox of J2000; paper 004's HCI has these axes.
    EclipticJ2000,
}

impl Frame {
    /// Components in this frame to components in EME2000.
    pub fn dcm_eme2000_from_frame(self) -> Matrix3<f64> {
        match self {
            Self::Paper004Mci => {
                Self::EclipticJ2000.dcm_eme2000_from_frame()
                    * dcm_reference_from_node_frame(
                        PAPER_004_MERCURY_NODE_RAD,
                        PAPER_004_MERCURY_INCLINATION_RAD,
                    )
            }
            Self::MercuryEquator => {
                dcm_from_pole(MERCURY_POLE_RIGHT_ASCENSION_RAD, MERCURY_POLE_DECLINATION_RAD)
            }
            Self::Eme2000 => Matrix3::identity(),
            Self::EclipticJ2000 => rotation_x(OBLIQUITY_J2000_RAD),
        }
    }
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
    let (s, c) = angle_rad.sin_cos();
    Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c)
}

/// Turns a vector by `angle_rad` about z.
pub fn rotation_z(angle_rad: f64) -> Matrix3<f64> {
    let (s, c) = angle_rad.sin_cos();
    Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0)
}

/// Unit vector at a right ascension and declination.
pub fn direction(right_ascension_rad: f64, declination_rad: f64) -> Vector3<f64> {
    let ((sin_ra, cos_ra), (sin_dec, cos_dec)) = (right_ascension_rad.sin_cos(), declination_rad.sin_cos());
    Vector3::new(cos_ra * cos_dec, sin_ra * cos_dec, sin_dec)
}

#[cfg(test)]
mod tests {
    //! Every frame is a proper rotation, and its axes point where astronomy says.

    use super::*;

    const ALL: [Frame; 4] = [Frame::Paper004Mci, Frame::MercuryEquator, Frame::Eme2000, Frame::EclipticJ2000];

    #[test]
    fn proper_rotations() {
        for frame in ALL {
            let dcm = frame.dcm_eme2000_from_frame();
            assert!((dcm * dcm.transpose() - Matrix3::identity()).norm() < 1e-14, "{frame:?}");
            assert!((dcm.determinant() - 1.0).abs() < 1e-14, "{frame:?}");
        }
    }

    #[test]
    fn ecliptic_pole_stands_in_draco() {
        // North ecliptic pole of J2000: right ascension 18 h 0 m 0 s, declination 66 deg 33 min 38.55 s.
        let pole = Frame::EclipticJ2000.dcm_eme2000_from_frame() * Vector3::z();
        let expected =
            direction(270.0_f64.to_radians(), (66.0 + 33.0 / 60.0 + 38.552 / 3600.0_f64).to_radians());
        assert!((pole - expected).norm() < 1e-9);
    }

    #[test]
    fn mercury_turns_upright_on_its_orbit() {
        // Obliquity 0.034 deg (2.04 arc minutes, Margot et al. 2012), though pole and orbit come from different sources.
        let pole = Frame::MercuryEquator.dcm_eme2000_from_frame() * Vector3::z();
        let expected = direction(MERCURY_POLE_RIGHT_ASCENSION_RAD, MERCURY_POLE_DECLINATION_RAD);
        assert!((pole - expected).norm() < 1e-14);
        let orbit_normal = Frame::Paper004Mci.dcm_eme2000_from_frame() * Vector3::z();
        let obliquity_deg = pole.angle(&orbit_normal).to_degrees();
        assert!((0.02..0.05).contains(&obliquity_deg), "{obliquity_deg}");
    }

    #[test]
    fn node_axes_lie_in_both_planes() {
        let mci = Frame::Paper004Mci.dcm_eme2000_from_frame();
        let ecliptic_normal = Frame::EclipticJ2000.dcm_eme2000_from_frame() * Vector3::z();
        assert!((mci * Vector3::x()).dot(&ecliptic_normal).abs() < 1e-15);
        // Ascending: moving on from the node (along y) leads north of the ecliptic.
        assert!((mci * Vector3::y()).dot(&ecliptic_normal) > 0.0);
        assert!((ecliptic_normal.angle(&(mci * Vector3::z())).to_degrees() - 7.0).abs() < 1e-12);
        let equator = Frame::MercuryEquator.dcm_eme2000_from_frame();
        assert!((equator * Vector3::x()).z.abs() < 1e-15 && (equator * Vector3::y()).z > 0.0);
    }
}
