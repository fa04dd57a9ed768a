//! Places of the Sun in a downlink that Sun, Earth and antennas allow: a convex polygon of azimuth and elevation.
//!
//! From the Sun on -Y, which every downlink allows, the law is followed along rays as far as no row of the downlink is clamped (by
//! halving). The ends are corners of a polygon that sees its middle; the half-planes on the inner side of all its edges have a convex
//! polygon in common that lies within (its kernel). For MESSENGER the Earth at theta from the Sun bounds it by an arc near the circle
//! A^2 + E^2 = theta^2 on one side.

use core::f64::consts::TAU;

use super::{simulated::FlightRow, torque::SunlitSpacecraft};

/// Rays, and halvings along each.
const RAYS: usize = 24;
const HALVINGS: usize = 14;
/// Rows of a downlink that are looked at: the Earth moves little within one.
const ROWS: usize = 5;
/// Distance kept from the bound, in rad: for angles as they are written, and because the attitude has no derivative at it.
const LEFT_RAD: f64 = 1e-3;

/// A side of a polygon: azimuth and elevation, in rad, by these weights come to no more than `most`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaceSide {
    /// Weights of azimuth and elevation.
    pub weights: [f64; 2],
    /// In rad.
    pub most: f64,
}

impl PlaceSide {
    /// Its terms by the indices of azimuth and elevation.
    pub(super) fn terms(&self, pair: [usize; 2]) -> Vec<(usize, f64)> {
        pair.into_iter().zip(self.weights).collect()
    }

    /// Whether a place is on its inner side.
    pub fn holds(&self, place_rad: [f64; 2]) -> bool {
        self.weights[0] * place_rad[0] + self.weights[1] * place_rad[1] <= self.most
    }
}

/// The sides of the polygon within these azimuths and elevations either way, in rad; none where all of them are allowed.
pub(super) fn places(sunlit: &SunlitSpacecraft, rows: &[&FlightRow], reach_rad: [f64; 2]) -> Vec<PlaceSide> {
    let last = rows.len().saturating_sub(1);
    let picked: Vec<&FlightRow> =
        (0..ROWS).filter_map(|k| rows.get(k * last / (ROWS - 1)).copied()).collect();
    let allowed = |[azimuth_rad, elevation_rad]: [f64; 2]| {
        picked.iter().all(|row| sunlit.allows(row, azimuth_rad, elevation_rad))
    };
    let ray = |number: usize| {
        let (sine, cosine) = (TAU * number as f64 / RAYS as f64).sin_cos();
        // To the rectangle.
        let most = (reach_rad[0] / cosine.abs()).min(reach_rad[1] / sine.abs());
        let at = |length: f64| [cosine * length, sine * length];
        if allowed(at(most)) {
            return (at(most), true);
        }
        let [mut good, mut bad] = [0.0, most];
        for _ in 0..HALVINGS {
            let middle = 0.5 * (good + bad);
            if allowed(at(middle)) { good = middle } else { bad = middle }
        }
        (at((good - LEFT_RAD).max(0.0)), false)
    };
    let corners: Vec<([f64; 2], bool)> = (0..RAYS).map(ray).collect();
    let mut sides = Vec::new();
    for (number, (from, whole)) in corners.iter().enumerate() {
        let (to, next_whole) = corners[(number + 1) % RAYS];
        if *whole && next_whole {
            continue;
        }
        // Outward of an edge that goes round against the clock.
        let weights = [to[1] - from[1], from[0] - to[0]];
        let length = weights[0].hypot(weights[1]);
        if length > 0.0 {
            let weights = weights.map(|it| it / length);
            sides.push(PlaceSide { weights, most: weights[0] * from[0] + weights[1] * from[1] });
        }
    }
    sides
}

#[cfg(test)]
mod tests;
