//! Air of a body by an exponential model.

use serde::{Deserialize, Serialize};

/// Air whose density falls exponentially with the height.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ExponentialAir {
    /// Density at the reference height, in kg/m3.
    pub reference_density_kg_m3: f64,
    /// Reference height, in m.
    pub reference_height_m: f64,
    /// Height over which it falls to 1/e, in m.
    pub scale_height_m: f64,
    /// Temperature at every height, in K.
    pub temperature_k: f64,
    /// Mean molar mass at every height, in kg/mol.
    pub molar_mass_kg_mol: f64,
}

impl ExponentialAir {
    /// No air.
    pub const NONE: Self = Self {
        reference_density_kg_m3: 0.0,
        reference_height_m: 0.0,
        scale_height_m: 1e4,
        temperature_k: 1000.0,
        molar_mass_kg_mol: 0.016,
    };
}

/// Air of the Earth between 400 and 450 km (Vallado, Fundamentals of Astrodynamics, table 8-4). Temperature and molar mass, of atomic
/// oxygen, are assumptions.
pub const EARTH: ExponentialAir = ExponentialAir {
    reference_density_kg_m3: 3.725e-12,
    reference_height_m: 400e3,
    scale_height_m: 58_515.0,
    ..ExponentialAir::NONE
};

/// Air of Venus by density, scale height and temperature at its surface (NASA planetary fact sheet): at heights of orbits an
/// assumption.
pub const VENUS: ExponentialAir = ExponentialAir {
    reference_density_kg_m3: 65.0,
    reference_height_m: 0.0,
    scale_height_m: 15.9e3,
    temperature_k: 737.0,
    molar_mass_kg_mol: 0.043_45,
};

/// Air of Mars where orbits dip into it: 0.11 kg/km3 at 145 km and 3.0 kg/km3 at 121 km, as MAVEN's fourth deep dip met it in
/// September 2015 (NASA and the Space Sciences Laboratory, Berkeley). Temperature and molar mass, of carbon dioxide at that scale
/// height, are assumptions.
pub const MARS: ExponentialAir = ExponentialAir {
    reference_density_kg_m3: 1.1e-10,
    reference_height_m: 145e3,
    scale_height_m: 7.26e3,
    temperature_k: 131.0,
    molar_mass_kg_mol: 0.044,
};

/// Air of Jupiter at 1 bar, likewise an assumption at heights of orbits.
pub const JUPITER: ExponentialAir = ExponentialAir {
    reference_density_kg_m3: 0.16,
    reference_height_m: 0.0,
    scale_height_m: 27e3,
    temperature_k: 165.0,
    molar_mass_kg_mol: 0.002_22,
};

#[cfg(test)]
mod tests {
    //! Densities at a second published height, and the scale height of a gas at rest.
    use super::*;

    fn density_kg_m3(air: &ExponentialAir, height_m: f64) -> f64 {
        air.reference_density_kg_m3 * ((air.reference_height_m - height_m) / air.scale_height_m).exp()
    }

    #[test]
    fn density_is_met_at_another_published_height() {
        // Vallado's next row, at 450 km; MAVEN at the lowest periapsis of its fourth deep dip.
        assert!((density_kg_m3(&EARTH, 450e3) / 1.585e-12 - 1.0).abs() < 2e-3);
        assert!((density_kg_m3(&MARS, 121e3) / 3.0e-9 - 1.0).abs() < 2e-2);
    }

    #[test]
    fn the_scale_height_of_mars_is_that_of_its_gas() {
        let gravity_m_s2 = 4.2828e13 / (3_389.5e3_f64 + 133e3).powi(2);
        let scale_m = 8.314_46 * MARS.temperature_k / (MARS.molar_mass_kg_mol * gravity_m_s2);
        assert!((scale_m / MARS.scale_height_m - 1.0).abs() < 0.02, "{scale_m}");
    }
}
