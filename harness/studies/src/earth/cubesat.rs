//! The CubeSat and its torques by effect.

use crate::attitude::Vector;
use crate::case::recorded;

/// The FMU that is simulated.
pub(super) const CUBESAT: &str = "Cubesat.fmu";
/// Radius of the equator from which heights count here, in m.
pub(super) const EQUATOR_M: f64 = 6_378_137.0;
/// Gravitational parameter, in m3/s2, by which an orbit's duration is known ahead.
const GM_M3_S2: f64 = 3.986_004_4e14;

/// Effects in the order of [`by_effect`].
pub(super) const EFFECTS: [&str; 5] =
    ["gravity gradient", "air", "magnetic field", "sunlight", "planet light (reflected and infrared)"];

recorded! {
    /// Torque by effect at one communication point, body frame.
    pub(super) struct Torques {
        by_source_n_m: [Vector; 6] = "torque.gravityGradient" "torque.aerodynamic" "torque.magnetic"
            "torque.solar" "torque.albedo" "torque.infrared",
    }
}

impl Torques {
    pub(super) fn by_effect_n_m(&self) -> [f64; EFFECTS.len()] {
        by_effect(self.by_source_n_m)
    }
}

/// Sizes of what each effect gives, the two kinds of planet light together.
pub(super) fn by_effect(by_source: [Vector; 6]) -> [f64; EFFECTS.len()] {
    let [gravity_gradient, air, magnetic, sunlight, albedo, infrared] = by_source;
    [gravity_gradient, air, magnetic, sunlight, albedo + infrared].map(|vector| vector.norm())
}

/// Duration of a circular orbit of this radius, in s.
pub(super) fn period_s(radius_m: f64) -> f64 {
    core::f64::consts::TAU * (radius_m.powi(3) / GM_M3_S2).sqrt()
}
