//! What is known of a body's air by an exponential model.

/// Air whose density falls exponentially with the height.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ExponentialAir {
    /// Density at the reference height, in kg/m3.
    pub reference_density_kg_m3: f64,
    /// The height at which it has that, in m.
    pub reference_height_m: f64,
    /// Height over which it falls to 1/e, in m.
    pub scale_height_m: f64,
    /// Temperature at every height, in K.
    pub temperature_k: f64,
    /// Mean molar mass at every height, in kg/mol.
    pub molar_mass_kg_mol: f64,
}

impl ExponentialAir {
    /// None.
    pub const NONE: Self = Self {
        reference_density_kg_m3: 0.0,
        reference_height_m: 0.0,
        scale_height_m: 1e4,
        temperature_k: 1000.0,
        molar_mass_kg_mol: 0.016,
    };
}

/// The Earth's between 400 and 450 km (Vallado, Fundamentals of Astrodynamics, table 8-4). Temperature and molar mass, of atomic
/// oxygen, are assumptions.
pub const EARTH: ExponentialAir = ExponentialAir {
    reference_density_kg_m3: 3.725e-12,
    reference_height_m: 400e3,
    scale_height_m: 58_515.0,
    ..ExponentialAir::NONE
};

/// That of Venus by density, scale height and temperature at its surface (NASA planetary fact sheet): at heights of orbits an
/// assumption.
pub const VENUS: ExponentialAir = ExponentialAir {
    reference_density_kg_m3: 65.0,
    reference_height_m: 0.0,
    scale_height_m: 15.9e3,
    temperature_k: 737.0,
    molar_mass_kg_mol: 0.043_45,
};

/// Likewise that of Mars.
pub const MARS: ExponentialAir = ExponentialAir {
    reference_density_kg_m3: 0.020,
    reference_height_m: 0.0,
    scale_height_m: 11.1e3,
    temperature_k: 210.0,
    molar_mass_kg_mol: 0.043_34,
};

/// Likewise that of Jupiter at 1 bar.
pub const JUPITER: ExponentialAir = ExponentialAir {
    reference_density_kg_m3: 0.16,
    reference_height_m: 0.0,
    scale_height_m: 27e3,
    temperature_k: 165.0,
    molar_mass_kg_mol: 0.002_22,
};
