//! A body of the user's own, an asteroid, a comet or a moon: what its file says of it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::bodies::surface::{DayTemperature, PlanetSurface};
use crate::bodies::{Body, BodyData};

/// Temperature of its night side, assumed, in K: as low as that of airless bodies that turn slowly.
const NIGHT_TEMPERATURE_K: f64 = 100.0;

/// A body that the spacecraft's file describes, `custom` in `orbit.center`.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct CustomBody {
    /// Its name.
    pub name: String,
    /// Gravitational parameter, in m3/s2.
    pub gm_m3_s2: f64,
    /// Radii of the ellipsoid along its x, y and z, in m.
    pub radii_m: [f64; 3],
    /// Second zonal harmonic, unnormalised, for the radius along x.
    pub j2: f64,
    /// Right ascension and declination of its north pole in EME2000, in rad.
    pub pole_rad: [f64; 2],
    /// Angle of its prime meridian at J2000, in rad.
    pub prime_meridian_rad: f64,
    /// Rotation rate about the pole, in rad/s.
    pub rotation_rate_rad_s: f64,
    /// Diffusely reflected fraction of sunlight.
    pub albedo: f64,
    /// Infrared emissivity.
    pub emissivity: f64,
    /// Its motion about the Sun; `None` where inputs or a table of positions say where it is.
    pub motion: Option<BodyMotion>,
}

/// How it moves about the Sun, undisturbed.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BodyMotion {
    /// When it is there, in s past J2000 TDB.
    pub epoch_s: f64,
    /// Axes of elements or state.
    pub frame: InertialFrame,
    /// Elements or state about the Sun.
    pub orbit: BodyOrbit,
}

/// Axes that do not turn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "camelCase")]
pub enum InertialFrame {
    /// Mean ecliptic and equinox of J2000.
    #[default]
    Ecliptic,
    /// Mean equator and equinox of J2000.
    Eme2000,
}

/// Orbit of the body about the Sun.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub enum BodyOrbit {
    /// By Keplerian elements.
    Elements {
        /// Semi-major axis, in m.
        semi_major_axis_m: f64,
        /// Eccentricity, below 1.
        eccentricity: f64,
        /// Inclination, in rad.
        inclination_rad: f64,
        /// Longitude of the ascending node, in rad.
        ascending_node_rad: f64,
        /// Argument of periapsis, in rad.
        periapsis_argument_rad: f64,
        /// True anomaly, in rad.
        true_anomaly_rad: f64,
    },
    /// By a state vector.
    State {
        /// In m.
        position_m: Vector3<f64>,
        /// In m/s.
        velocity_m_s: Vector3<f64>,
    },
}

impl CustomBody {
    /// Its surface: local balance by day; the night's temperature is assumed.
    pub fn surface(&self) -> PlanetSurface {
        PlanetSurface {
            radius_m: self.mean_radius_m(),
            absorptivity: 1.0 - self.albedo,
            diffuse_reflectivity: self.albedo,
            emissivity: self.emissivity,
            night_temperature_k: NIGHT_TEMPERATURE_K,
            day_temperature: DayTemperature::Cosine,
        }
    }

    fn mean_radius_m(&self) -> f64 {
        self.radii_m.iter().sum::<f64>() / 3.0
    }

    /// As a row of [`BODIES`](crate::bodies::BODIES), without its orbit.
    pub fn data(&self) -> BodyData {
        BodyData {
            gm_m3_s2: self.gm_m3_s2,
            radius_m: self.mean_radius_m(),
            j2: self.j2,
            j2_radius_m: self.radii_m[0],
            pole_right_ascension_rad: self.pole_rad[0],
            pole_declination_rad: self.pole_rad[1],
            prime_meridian_rad: self.prime_meridian_rad,
            rotation_rate_rad_s: self.rotation_rate_rad_s,
            equatorial_radius_m: self.radii_m[0],
            flattening: 1.0 - self.radii_m[2] / self.radii_m[0],
            surface: Some(self.surface()),
            ..*Body::Custom.data()
        }
    }
}
