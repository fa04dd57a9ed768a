//! The CubeSat and its torques by effect.

use crate::attitude::Vector;
use crate::case::recorded;

/// The FMU that is simulated.
pub(super) const CUBESAT: &str = "Cubesat.fmu";
/// Radius of the equator from which heights count here, in m.
pub(super) const EQUATOR_M: f64 = 6_378_137.0;
/// Gravitational parameter, in m3/s2, by which an orbit's duration is known ahead.
const GM_M3_S2: f64 = 3.986_004_4e14;

/// Effects in the order of [`Torques::by_effect_n_m`].
pub(super) const EFFECTS: [&str; 5] =
    ["gravity gradient", "air", "magnetic field", "sunlight", "planet light (reflected and infrared)"];

recorded! {
    /// Torque by effect at one communication point, body frame.
    pub(super) struct Torques {
        gravity_gradient_n_m: Vector = "torque.gravityGradient",
        air_n_m: Vector = "torque.aerodynamic",
        magnetic_n_m: Vector = "torque.magnetic",
        sunlight_n_m: Vector = "torque.solar",
        albedo_n_m: Vector = "torque.albedo",
        infrared_n_m: Vector = "torque.infrared",
    }
}

impl Torques {
    pub(super) fn by_effect_n_m(&self) -> [f64; EFFECTS.len()] {
        let planet_light_n_m = self.albedo_n_m + self.infrared_n_m;
        [self.gravity_gradient_n_m, self.air_n_m, self.magnetic_n_m, self.sunlight_n_m, planet_light_n_m]
            .map(|torque_n_m| torque_n_m.norm())
    }
}

/// Duration of a circular orbit of this radius, in s.
pub(super) fn period_s(radius_m: f64) -> f64 {
    core::f64::consts::TAU * (radius_m.powi(3) / GM_M3_S2).sqrt()
}
