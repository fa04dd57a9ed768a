//! Figure and rotation of the planet, and which air and magnetic field are about it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::environment::atmosphere::{Air, AtmosphereModel, SpaceWeather};
use crate::environment::geodetic::{Ellipsoid, Geodetic};
use crate::environment::magnetic_field::MagneticField;
use crate::environment::orientation::Orientation;
use crate::math::wrapped_rad;

/// Figure and rotation of the planet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PlanetFigure {
    /// Rotation.
    pub orientation: Orientation,
    /// Reference ellipsoid of heights.
    pub ellipsoid: Ellipsoid,
}

impl PlanetFigure {
    /// Geodetic coordinates of a position from its centre, EME2000, in m.
    pub fn geodetic(&self, epoch_s: f64, position_m: &Vector3<f64>) -> Geodetic {
        let equator = self.orientation.equator(epoch_s);
        let from_node = self.ellipsoid.geodetic(&(equator.equator_from_eme2000 * position_m));
        let longitude_rad = wrapped_rad(from_node.longitude_rad - equator.rotation_angle_rad);
        Geodetic { longitude_rad, ..from_node }
    }
}

/// Air and magnetic field about the planet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AirAndFieldSettings {
    /// The air; `None` where it does not act.
    pub air: Option<AirSettings>,
    /// The field; `None` where it does not act.
    pub field: Option<FieldSource>,
    /// Last Chebyshev terms of both relative to their size.
    pub tolerance: f64,
}

impl AirAndFieldSettings {
    /// Model of the atmosphere, where the air acts and is not given.
    pub(crate) fn atmosphere(&self) -> Option<AtmosphereModel> {
        let AirSource::Model(model) = self.air?.source else { return None };
        Some(model)
    }
}

/// The air about the planet.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct AirSettings {
    /// Source of density, temperature and molar mass.
    pub source: AirSource,
    /// Activity of the Sun and of the Earth's field.
    pub weather: SpaceWeather,
    /// Factor of the model's density.
    pub density_factor: f64,
    /// Velocity of the air relative to the rotating planet: east, north, up, in m/s.
    pub wind_m_s: Vector3<f64>,
}

/// Source of density, temperature and molar mass.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum AirSource {
    /// A model.
    Model(AtmosphereModel),
    /// Constant until the inputs change; no air at zero density.
    Given(Air),
}

/// Source of the magnetic field.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum FieldSource {
    /// A model.
    Model(MagneticField),
    /// Constant until the input changes, EME2000, in T.
    Given(Vector3<f64>),
}
