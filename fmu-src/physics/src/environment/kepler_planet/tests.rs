//! Paper 004's frames HCI, MCI, PL and SC (eqs 1-4) point where its text says they do, in every test case of its Table 6.
//!
//! PL: x to the Sun, z along the orbit's normal. SC: the Sun-pointing spacecraft, the Sun along -y, z along -z_PL (the
//! paper's sentence that y_SC is aligned with x_PL has the wrong sign, its eq 4 is right).

use nalgebra::Vector3;

use super::*;
use crate::bodies::Body;
use crate::constants::{ASTRONOMICAL_UNIT_M, GM_MERCURY_M3_S2};
use crate::environment::frames::{Frame, dcm_reference_from_node_frame, rotation_z};

/// Components in PL to components in SC, and back (eq 4, its own inverse).
pub(crate) fn dcm_sc_from_pl() -> Matrix3<f64> {
    Matrix3::new(0.0, -1.0, 0.0, -1.0, 0.0, 0.0, 0.0, 0.0, -1.0)
}

/// The four frames at one moment, fixed by where the planet is on its orbit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Frames {
    /// The planet's position relative to the Sun in HCI, m.
    pub(crate) planet_hci_m: Vector3<f64>,
    /// Components in MCI to components in HCI (eq 1).
    pub(crate) dcm_hci_from_mci: Matrix3<f64>,
    /// Components in MCI to components in PL (eqs 2 and 3).
    pub(crate) dcm_pl_from_mci: Matrix3<f64>,
}

impl Frames {
    /// From the planet's elements in HCI (about the Sun): node and inclination turn MCI, the position angle
    /// `true anomaly + argument of periapsis + pi` turns PL.
    pub(crate) fn from_elements(planet: &Elements) -> Self {
        let position_angle_rad = planet.true_anomaly_rad + planet.periapsis_argument_rad + PI;
        Self {
            planet_hci_m: planet.state(GM_SUN_M3_S2).unwrap().position_m,
            dcm_hci_from_mci: dcm_reference_from_node_frame(
                planet.ascending_node_rad,
                planet.inclination_rad,
            ),
            dcm_pl_from_mci: rotation_z(position_angle_rad).transpose(),
        }
    }

    /// A position relative to the planet in MCI as a position relative to the Sun in HCI, m (eq 1).
    pub(crate) fn position_hci_m(&self, position_mci_m: &Vector3<f64>) -> Vector3<f64> {
        self.dcm_hci_from_mci * position_mci_m + self.planet_hci_m
    }

    /// A position relative to the Sun in HCI as a position relative to the planet in MCI, m (inverse of eq 1).
    pub(crate) fn position_mci_m(&self, position_hci_m: &Vector3<f64>) -> Vector3<f64> {
        self.dcm_hci_from_mci.tr_mul(&(position_hci_m - self.planet_hci_m))
    }

    /// Components in MCI to components in SC.
    pub(crate) fn dcm_sc_from_mci(&self) -> Matrix3<f64> {
        dcm_sc_from_pl() * self.dcm_pl_from_mci
    }

    /// Components in HCI to components in SC.
    pub(crate) fn dcm_sc_from_hci(&self) -> Matrix3<f64> {
        self.dcm_sc_from_mci() * self.dcm_hci_from_mci.transpose()
    }

    /// Components in EME2000 to components in SC: the attitude the paper gives its spacecraft.
    pub(crate) fn dcm_sc_from_eme2000(&self) -> Matrix3<f64> {
        self.dcm_sc_from_hci() * dcm_eme2000_from_ecliptic().transpose()
    }
}

/// Mercury as printed in Table 4, at a true anomaly (Table 6: 10, 98, 189 and 279 deg).
fn mercury(true_anomaly_deg: f64) -> KeplerPlanet {
    let true_anomaly_rad = true_anomaly_deg.to_radians();
    KeplerPlanet::new(Elements { true_anomaly_rad, ..MERCURY_AS_PRINTED }, 0.0).unwrap()
}

fn case(true_anomaly_deg: f64) -> (CartesianState, Frames) {
    let state = mercury(true_anomaly_deg).orbit_hci.state_at(0.0);
    // By way of the osculating elements (eqs 13-21), with all quadrants.
    (state, Frames::from_elements(&Elements::from_state(&state, GM_SUN_M3_S2).unwrap()))
}

#[test]
fn axes_follow_the_sun_and_the_orbit() {
    for anomaly in [0.0, 10.0, 98.0, 189.0, 279.0, 359.0] {
        let (planet, frames) = case(anomaly);
        let to_sun_hci = -planet.position_m.normalize();
        let normal_hci = planet.position_m.cross(&planet.velocity_m_s).normalize();
        let pl_from_hci = frames.dcm_pl_from_mci * frames.dcm_hci_from_mci.transpose();
        assert!((pl_from_hci * to_sun_hci - Vector3::x()).norm() < 1e-14);
        assert!((pl_from_hci * normal_hci - Vector3::z()).norm() < 1e-14);
        // The Sun stands along -y_SC, the orbit's normal along -z_SC.
        assert!((frames.dcm_sc_from_hci() * to_sun_hci + Vector3::y()).norm() < 1e-14);
        assert!((frames.dcm_sc_from_hci() * normal_hci + Vector3::z()).norm() < 1e-14);
        for dcm in [frames.dcm_hci_from_mci, frames.dcm_pl_from_mci, frames.dcm_sc_from_eme2000()] {
            assert!((dcm * dcm.transpose() - Matrix3::identity()).norm() < 1e-14);
            assert!((dcm.determinant() - 1.0).abs() < 1e-14);
        }
    }
    assert_eq!(dcm_sc_from_pl() * dcm_sc_from_pl(), Matrix3::identity());
}

#[test]
fn positions_there_and_back() {
    let (planet, frames) = case(98.0);
    let mci = Vector3::new(3e6, -5e6, 8e6);
    let hci = frames.position_hci_m(&mci);
    assert!((frames.position_mci_m(&hci) - mci).norm() < 1e-4);
    assert!(((hci - planet.position_m).norm() - mci.norm()).abs() < 1e-4);
    // The Sun in MCI lies in the xy plane, which is the planet's orbit.
    assert!(frames.position_mci_m(&Vector3::zeros()).z.abs() < 1e-4);
}

#[test]
fn frames_agree_with_the_inertial_mci() {
    // With Table 4's node and inclination MCI is the frame an orbit may be given in.
    let (_, frames) = case(189.0);
    let eme2000_from_hci = dcm_eme2000_from_ecliptic();
    let mci = Frame::PlanetOrbit.dcm_eme2000_from_frame(Body::Mercury.data(), Default::default).unwrap();
    assert!((eme2000_from_hci * frames.dcm_hci_from_mci - mci).norm() < 1e-14);
}

#[test]
fn dawn_dusk_and_noon_midnight() {
    // Figure 11: the orbit plane faces the Sun in cases 1 and 3 and holds it in cases 2 and 4.
    let orbit = MESSENGER_AS_PRINTED.state(GM_MERCURY_M3_S2).unwrap();
    let normal_mci = orbit.position_m.cross(&orbit.velocity_m_s).normalize();
    let sun_off_plane_deg = |anomaly: f64| {
        let (_, frames) = case(anomaly);
        let sun_mci = frames.position_mci_m(&Vector3::zeros()).normalize();
        sun_mci.dot(&normal_mci).asin().to_degrees().abs()
    };
    assert!(sun_off_plane_deg(10.0) > 75.0 && sun_off_plane_deg(189.0) > 75.0);
    assert!(sun_off_plane_deg(98.0) < 10.0 && sun_off_plane_deg(279.0) < 10.0);
    // With 77.46 deg taken for the longitude of the perihelion the cases would be lost.
    let argument_rad = (77.46_f64 - 48.33).to_radians();
    let right =
        Elements { periapsis_argument_rad: argument_rad, true_anomaly_rad: 0.17, ..MERCURY_AS_PRINTED };
    let sun_mci = Frames::from_elements(&right).position_mci_m(&Vector3::zeros()).normalize();
    assert!(sun_mci.dot(&normal_mci).asin().to_degrees().abs() < 60.0);
}

#[test]
fn mercury_year_holds_174_9_orbits() {
    // The paper's text has 172; its own Tables 3 and 4 make 174.9.
    let planet = mercury(0.0);
    let year_s = planet.orbit_hci.period_s();
    assert!((year_s / 86_400.0 - 87.97).abs() < 0.01);
    let orbit = TwoBodyOrbit::from_elements(MESSENGER_AS_PRINTED, GM_MERCURY_M3_S2, 0.0).unwrap();
    assert!((year_s / orbit.period_s() - 174.9).abs() < 0.05);
    let (near, far) = (case(0.0).0.position_m.norm(), case(180.0).0.position_m.norm());
    assert!(
        (near / ASTRONOMICAL_UNIT_M - 0.3075).abs() < 1e-4
            && (far / ASTRONOMICAL_UNIT_M - 0.4667).abs() < 1e-4
    );
    // The same planet in EME2000.
    let (hci, eme2000) = (planet.orbit_hci.state_at(1e6), planet.state(1e6));
    let back = dcm_eme2000_from_ecliptic().transpose() * eme2000.position_m;
    assert!((back - hci.position_m).norm() < 1e-4);
}

#[test]
fn sunlight_falls_off_as_in_table_7() {
    // Radiation pressure is proportional to 8.45, 5.51, 3.71, 6.22 in the four cases.
    let light = |anomaly: f64| 1.0 / case(anomaly).0.position_m.norm_squared();
    for (anomaly, published) in [(98.0, 5.51), (189.0, 3.71), (279.0, 6.22)] {
        assert!((light(anomaly) / light(10.0) / (published / 8.45) - 1.0).abs() < 2e-3, "{anomaly}");
    }
}
