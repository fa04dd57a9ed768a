//! Lines on which a component of torque vanishes: between nodes of a grid of unlike sign, each crossing solved by the FMU.
//!
//! Crossings are roots by regula falsi with the Illinois rule, to 1e-13 of the component's greatest size; what jumps through
//! zero (a panel that flips where the Sun stands along its axis) has no root and is left out.

use std::collections::HashMap;

use fmi::Error;

use super::{
    contour::{self, Edge},
    grid::{Angles, Grid, direction},
    sunlight::Sunlight,
};

/// Value that counts as zero, relative to the component's greatest size.
const ZERO: f64 = 1e-12;
/// Value at which the iteration ends.
const TRIED: f64 = 1e-13;
const MAX_TRIES: u32 = 80;
/// Places nearer than this to the middle are on it.
const ON_DEG: f64 = 1e-9;

/// One line.
pub struct ZeroLine {
    /// Places in their order; one that returns to the first is closed.
    pub places_deg: Vec<Angles>,
}

impl ZeroLine {
    /// Least and greatest of azimuth or of elevation, in deg.
    pub fn extent_deg(&self, of: usize) -> [f64; 2] {
        let along = || self.places_deg.iter().map(|place| place[of]);
        [along().fold(f64::INFINITY, f64::min), along().fold(f64::NEG_INFINITY, f64::max)]
    }

    /// Whether all of it is on the middle, 0 of azimuth or of elevation.
    pub fn is_along(&self, of: usize) -> bool {
        self.places_deg.iter().all(|place| place[of].abs() < ON_DEG)
    }

    /// Returns its crossings of the middle, 0 of azimuth or of elevation: the other angle, in deg.
    pub fn crossings_deg(&self, of: usize) -> Vec<f64> {
        let is_on = |place: &Angles| place[of].abs() < ON_DEG;
        let mut found: Vec<f64> = Vec::new();
        for pair in self.places_deg.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            // A piece of line along the middle crosses it nowhere.
            if (a[of] < 0.0) != (b[of] < 0.0) && !(is_on(&a) && is_on(&b)) {
                let part = a[of] / (a[of] - b[of]);
                found.push(a[1 - of] + part * (b[1 - of] - a[1 - of]));
            }
        }
        found.sort_by(f64::total_cmp);
        found
    }
}

/// The lines of a component (0 to 2) in a grid.
pub(super) fn find(sunlight: &mut Sunlight<'_>, grid: &Grid, axis: usize) -> Result<Vec<ZeroLine>, Error> {
    let greatest_n_m = grid.greatest_n_m(axis);
    let (value_n_m, is_flat) = (grid.component_n_m(axis), grid.is_flat(axis));
    let mut roots: HashMap<Edge, Angles> = HashMap::new();
    let mut failure = None;
    let lines = contour::lines(grid.steps, &value_n_m, |edge| {
        let (a, b) = ([edge.column, edge.row], edge.end());
        // The border of a region of zeros is no line.
        if failure.is_some() || [a, b].into_iter().any(|[column, row]| is_flat(column, row)) {
            return false;
        }
        let ends = [a, b].map(|[column, row]| (grid.angles_deg(column, row), value_n_m(column, row)));
        match root(sunlight, ends, axis, greatest_n_m) {
            Ok(Some(root)) => {
                roots.insert(edge, root);
                true
            }
            Ok(None) => false,
            Err(error) => {
                failure = Some(error);
                false
            }
        }
    });
    if let Some(error) = failure {
        return Err(error);
    }
    let placed = |line: Vec<Edge>| line.iter().filter_map(|edge| roots.get(edge).copied()).collect();
    let lines = lines.into_iter().map(|line| ZeroLine { places_deg: placed(line) });
    // A pole is a point, whatever its azimuth.
    let is_pole = |line: &ZeroLine| line.places_deg.iter().all(|place| place[1].abs() > 90.0 - ON_DEG);
    Ok(lines.filter(|line| !is_pole(line)).collect())
}

/// The root between two places of unlike sign, if there is one.
fn root(
    sunlight: &mut Sunlight<'_>,
    [mut a, mut b]: [(Angles, f64); 2],
    axis: usize,
    greatest_n_m: f64,
) -> Result<Option<Angles>, Error> {
    if let Some((place, _)) = [a, b].into_iter().find(|(_, value)| *value == 0.0) {
        return Ok(Some(place));
    }
    let mut best = if a.1.abs() < b.1.abs() { a } else { b };
    for _ in 0..MAX_TRIES {
        if best.1.abs() <= TRIED * greatest_n_m {
            break;
        }
        let part = (a.1 / (a.1 - b.1)).clamp(0.0, 1.0);
        let place = [0, 1].map(|k| a.0[k] + part * (b.0[k] - a.0[k]));
        let value_n_m = sunlight.at(&direction(place))?.torque_n_m[axis];
        if value_n_m.abs() < best.1.abs() {
            best = (place, value_n_m);
        }
        if (value_n_m < 0.0) == (b.1 < 0.0) {
            // The end that stays counts half, so that it moves next.
            a.1 *= 0.5;
        } else {
            a = b;
        }
        b = (place, value_n_m);
    }
    Ok((best.1.abs() <= ZERO * greatest_n_m).then_some(best.0))
}
