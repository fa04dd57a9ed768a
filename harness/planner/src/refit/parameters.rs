//! Fitted parameters: centre of mass and `solar.scale`, and their standard deviations before the history is known.

use nalgebra::{Vector3, Vector4};

/// The variables of MomentumPlant that are fitted.
pub const FITTED: [&str; 4] =
    ["spacecraft.centerOfMass[1]", "spacecraft.centerOfMass[2]", "spacecraft.centerOfMass[3]", "solar.scale"];

/// Values of what is fitted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Body frame, with every panel at angle 0, in m.
    pub center_of_mass_body_m: Vector3<f64>,
    /// Factor of force and torque of direct sunlight.
    pub solar_scale: f64,
}

impl Parameters {
    /// In the order of [`FITTED`].
    pub(super) fn new(values: &Vector4<f64>) -> Self {
        Self { center_of_mass_body_m: values.xyz(), solar_scale: values.w }
    }

    /// In the order of [`FITTED`].
    pub fn values(&self) -> Vector4<f64> {
        self.center_of_mass_body_m.push(self.solar_scale)
    }
}

/// Standard deviations: of momentum's noise, and of what is fitted about the mission's values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviations {
    /// Standard deviation of each component of each row, white, in N m s.
    pub noise_n_m_s: f64,
    /// Standard deviation of each component of the centre of mass, in m.
    pub center_of_mass_m: f64,
    /// Standard deviation of `solar.scale`.
    pub solar_scale: f64,
}

impl Deviations {
    /// Standard deviations of the parameters, in the order of [`FITTED`].
    pub fn of_parameters(&self) -> Vector4<f64> {
        Vector3::repeat(self.center_of_mass_m).push(self.solar_scale)
    }
}
