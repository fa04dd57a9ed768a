//! Corridor of light on the cells: how much the arrays need for power, and how much heat they bear.

use serde::Serialize;

use super::part_reader::PartReader;
use crate::toml::{NotNegative, Positive, Written, tables};

tables! {
/// Corridor of the light on the cells of panels, in suns: max(0, cosine of the angle to the Sun) over the square of the distance in
/// AU. The defaults of `articulation.*`.
struct ArticulationDescription makes #[derive(Clone, Copy, Debug, PartialEq, Serialize)] pub struct Articulation {
    /// Least light, for power.
    min_suns: NotNegative = 0.0,
    /// Greatest light, for temperature.
    max_suns: Positive = 1e3,
    /// Light that panels with `control = "distance"` keep.
    target_suns: Positive = 1.0,
}
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

/// Reads the corridor.
pub(super) fn articulation(part: &PartReader<'_>, description: &ArticulationDescription) -> Articulation {
    let found = description.value();
    let Articulation { min_suns, max_suns, target_suns } = found;
    if ["min_suns", "max_suns", "target_suns"].iter().any(|key| part.key(key).has_reported()) {
        return found;
    }
    if max_suns <= min_suns {
        part.key("max_suns").report_across(max_suns, format_args!("more than min_suns, {min_suns}"));
    } else if found.margin_suns(target_suns) < 0.0 {
        let allowed = format_args!("from min_suns to max_suns, {min_suns} to {max_suns}");
        part.key("target_suns").report_across(target_suns, allowed);
    }
    found
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
