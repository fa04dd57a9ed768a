//! Corridor of light on the cells: how much the arrays need for power, and how much heat they bear.

use serde::Serialize;

/// Bounds of the light on the cells of panels, in suns: 1 is full sunlight across the cells at 1 AU.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Articulation {
    /// Least light, for power.
    pub min_suns: f64,
    /// Greatest light, for temperature.
    pub max_suns: f64,
    /// Light that [`super::PanelControl::Distance`] keeps.
    pub target_suns: f64,
}

impl Default for Articulation {
    fn default() -> Self {
        Self { min_suns: 0.0, max_suns: 1e3, target_suns: 1.0 }
    }
}

impl Articulation {
    /// Least distance of a light to the two bounds, in suns; negative outside.
    pub fn margin_suns(&self, suns: f64) -> f64 {
        (suns - self.min_suns).min(self.max_suns - suns)
    }
}

#[cfg(test)]
mod tests {
    //! The margin is the distance to the nearer bound.
    use super::*;

    #[test]
    fn the_margin_is_the_distance_to_the_nearer_bound() {
        let corridor = Articulation { min_suns: 2.0, max_suns: 4.5, target_suns: 3.0 };
        for (suns, margin) in [(0.0, -2.0), (2.0, 0.0), (2.25, 0.25), (4.0, 0.5), (4.5, 0.0), (11.0, -6.5)] {
            assert_eq!(corridor.margin_suns(suns), margin, "{suns}");
        }
    }
}
