//! A planet on an undisturbed ellipse about the Sun, and the orbits that paper 004 prints in its Tables 3 and 4.
//!
//! HCI: centred in the Sun, axes of the mean ecliptic and equinox of J2000. MCI: centred in the planet, x to the ascending
//! node of its orbit, z along the orbit's normal.

use core::f64::consts::PI;

use nalgebra::Matrix3;

use super::CartesianState;
use super::frames::dcm_eme2000_from_ecliptic;
use super::orbit::{Elements, OrbitError, TwoBodyOrbit};
use crate::constants::GM_SUN_M3_S2;
use crate::spacecraft::{BodyMotion, BodyOrbit, InertialFrame};

/// Mercury's orbit in HCI (Table 4), at perihelion. The semi-major axis is 57.91e9 m (printed a digit short); 77.46
/// deg is the longitude of the perihelion but printed, and used, as its argument.
pub const MERCURY_AS_PRINTED: Elements = Elements {
    semi_major_axis_m: 57.91e9,
    eccentricity: 0.205_6,
    inclination_rad: 7.0 * PI / 180.0,
    ascending_node_rad: 48.33 * PI / 180.0,
    periapsis_argument_rad: 77.46 * PI / 180.0,
    true_anomaly_rad: 0.0,
};

/// The spacecraft's orbit in MCI (Table 3), at periapsis.
pub const MESSENGER_AS_PRINTED: Elements = Elements {
    semi_major_axis_m: 10_175_000.0,
    eccentricity: 0.74,
    inclination_rad: 82.52 * PI / 180.0,
    ascending_node_rad: 350.17 * PI / 180.0,
    periapsis_argument_rad: 119.16 * PI / 180.0,
    true_anomaly_rad: 0.0,
};

/// A planet on an undisturbed ellipse about the Sun given in HCI: `ephemeris.source` kepler, or any planet
/// by its elements.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeplerPlanet {
    orbit_hci: TwoBodyOrbit,
    dcm_eme2000_from_hci: Matrix3<f64>,
}

impl KeplerPlanet {
    /// The planet that has `elements` (in HCI) at `epoch_s`.
    ///
    /// # Errors
    /// See [`Elements::check`].
    pub fn new(elements: Elements, epoch_s: f64) -> Result<Self, OrbitError> {
        let orbit_hci = TwoBodyOrbit::from_elements(elements, GM_SUN_M3_S2, epoch_s)?;
        Ok(Self { orbit_hci, dcm_eme2000_from_hci: dcm_eme2000_from_ecliptic() })
    }

    /// The body that a spacecraft's file places by elements or by a state about the Sun.
    ///
    /// # Errors
    /// See [`Elements::check`] and [`TwoBodyOrbit::from_state`].
    pub fn of_body(motion: &BodyMotion) -> Result<Self, OrbitError> {
        let orbit = match motion.orbit {
            BodyOrbit::Elements(given) => {
                let elements = Elements {
                    semi_major_axis_m: given.semi_major_axis_m,
                    eccentricity: given.eccentricity,
                    inclination_rad: given.inclination_rad,
                    ascending_node_rad: given.ascending_node_rad,
                    periapsis_argument_rad: given.periapsis_argument_rad,
                    true_anomaly_rad: given.true_anomaly_rad,
                };
                TwoBodyOrbit::from_elements(elements, GM_SUN_M3_S2, motion.epoch_s)?
            }
            BodyOrbit::State { position_m, velocity_m_s } => {
                let state = CartesianState { position_m, velocity_m_s };
                TwoBodyOrbit::from_state(&state, GM_SUN_M3_S2, motion.epoch_s)?
            }
        };
        let orbit_hci = match motion.frame {
            InertialFrame::Ecliptic => orbit,
            InertialFrame::Eme2000 => orbit.along(&dcm_eme2000_from_ecliptic().transpose()),
        };
        Ok(Self { orbit_hci, dcm_eme2000_from_hci: dcm_eme2000_from_ecliptic() })
    }

    /// Its elements about the Sun, in HCI.
    pub fn elements(&self) -> &Elements {
        self.orbit_hci.elements()
    }

    /// Heliocentric position and velocity in EME2000.
    pub fn state(&self, epoch_s: f64) -> CartesianState {
        self.orbit_hci.state_at(epoch_s).along(&self.dcm_eme2000_from_hci)
    }
}

#[cfg(test)]
pub(crate) mod tests;
