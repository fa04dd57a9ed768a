//! Settings of light and heat: which effects act, and how finely they are resolved in time.

/// Which of light's and heat's effects act, and how finely they are resolved in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiationSettings {
    /// Light of the planet: albedo and infrared.
    pub planet_light: bool,
    /// Recoil of the heat the spacecraft radiates.
    pub recoil: bool,
    /// Whether surfaces with a heat capacity store heat; otherwise all are in balance with their light.
    pub storage: bool,
    /// Whether surfaces given as polygons shadow one another from the Sun.
    pub shadowing: bool,
    /// Whether the Sun's disc softens those shadows.
    pub sun_disc: bool,
    /// Segments of light and heat end at multiples of this, in s.
    pub grid_s: f64,
    /// Largest last Chebyshev term of a segment relative to the largest force and torque in it.
    pub tolerance: f64,
}

impl RadiationSettings {
    /// Direct sunlight alone, unshadowed.
    pub const OFF: Self = Self {
        planet_light: false,
        recoil: false,
        storage: false,
        shadowing: false,
        sun_disc: false,
        grid_s: 600.0,
        tolerance: 1e-5,
    };

    /// Whether there is anything beyond direct sunlight.
    pub fn any(&self) -> bool {
        self.planet_light || self.recoil || self.shadowing
    }
}
