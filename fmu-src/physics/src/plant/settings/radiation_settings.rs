//! Settings of light and heat: what they take into account, and how finely they are resolved in time.

/// Parts of the light and heat that are computed, and their resolution in time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RadiationSettings {
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
