//! Balances of the spacecraft: X and Z of the torque vanish together, by Newton's method on the sphere; minimum of the whole torque.

use fmi::Error;
use nalgebra::{Matrix2, Vector2, Vector3};

use super::{
    grid::{Angles, Grid, angles_deg, cell, direction},
    sunlight::Sunlight,
};

/// Torque that counts as zero, relative to the greatest.
const ZERO: f64 = 1e-12;
const MAX_STEPS: u32 = 30;
/// A step is halved at most so often until torque falls.
const MAX_HALVINGS: u32 = 8;
/// Longest step, in rad.
const LONGEST_RAD: f64 = 0.1;
/// Points nearer than this are one, in rad.
const SAME_RAD: f64 = 1e-6;
/// The targeted components.
const TARGETED: [usize; 2] = [0, 2];

/// A direction of the Sun without torque about X and Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Balance {
    /// Azimuth and elevation.
    pub place_deg: Angles,
    /// Remaining torque, in N m.
    pub torque_n_m: Vector3<f64>,
    /// Whether a small turn of the spacecraft about any axis across Y is turned back, panels following the Sun.
    pub is_restoring: bool,
}

/// The balances near cells of a grid in which both components change sign.
pub(super) fn find(sunlight: &mut Sunlight<'_>, grid: &Grid) -> Result<Vec<Balance>, Error> {
    let (_, greatest_n_m) = grid.most();
    let is_flat = TARGETED.map(|axis| grid.is_flat(axis));
    let is_free = |corners: [(usize, usize); 4]| {
        corners.iter().all(|&(column, row)| !is_flat.iter().any(|is_flat| is_flat(column, row)))
    };
    let mut found: Vec<Balance> = Vec::new();
    let values = TARGETED.map(|axis| grid.component_n_m(axis));
    for row in 0..grid.steps[1] {
        for column in 0..grid.steps[0] {
            let corners = cell(column, row);
            let changes = |value: &dyn Fn(usize, usize) -> f64| {
                let at = corners.map(|(column, row)| value(column, row));
                at.iter().any(|value| *value < 0.0) && at.iter().any(|value| *value > 0.0)
                    || at.iter().filter(|value| **value == 0.0).count() == 2
            };
            if !is_free(corners) || !values.iter().all(|value| changes(value)) {
                continue;
            }
            let [a, b] = [grid.angles_deg(column, row), grid.angles_deg(column + 1, row + 1)];
            let start = direction([0, 1].map(|k| 0.5 * (a[k] + b[k])));
            let Some(balance) = newton(sunlight, start, greatest_n_m)? else { continue };
            let at = direction(balance.place_deg);
            let cell_rad = (b[1] - a[1]).max(b[0] - a[0]).to_radians();
            let is_near = at.angle(&start) <= 2.0 * cell_rad;
            if is_near
                && is_free(grid.corners(balance.place_deg))
                && found.iter().all(|other| direction(other.place_deg).angle(&at) > SAME_RAD)
            {
                found.push(balance);
            }
        }
    }
    Ok(found)
}

/// Two unit vectors across a direction and each other.
fn across(sun: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let first = sun.cross(&Vector3::ith(sun.iamin(), 1.0)).normalize();
    [first, sun.cross(&first)]
}

fn targeted(torque_n_m: &Vector3<f64>) -> Vector2<f64> {
    Vector2::from(TARGETED.map(|axis| torque_n_m[axis]))
}

/// A root of X and Z near a direction; `None` where the method finds none.
fn newton(
    sunlight: &mut Sunlight<'_>,
    mut sun: Vector3<f64>,
    greatest_n_m: f64,
) -> Result<Option<Balance>, Error> {
    for _ in 0..MAX_STEPS {
        let ways = across(&sun);
        let (load, slopes) = sunlight.slopes(&sun, ways)?;
        let size_n_m = targeted(&load.torque_n_m).norm();
        if size_n_m <= 0.1 * ZERO * greatest_n_m {
            break;
        }
        let jacobian = Matrix2::from_columns(&slopes.map(|slope| targeted(&slope)));
        let Some(inverse) = jacobian.try_inverse() else { return Ok(None) };
        let mut step = -(inverse * targeted(&load.torque_n_m));
        if !step.iter().all(|part| part.is_finite()) {
            return Ok(None);
        }
        step *= (LONGEST_RAD / step.norm()).min(1.0);
        let mut next = None;
        for _ in 0..MAX_HALVINGS {
            let tried = (sun + ways[0] * step.x + ways[1] * step.y).normalize();
            if targeted(&sunlight.at(&tried)?.torque_n_m).norm() < size_n_m {
                next = Some(tried);
                break;
            }
            step *= 0.5;
        }
        match next {
            Some(next) => sun = next,
            None => break,
        }
    }
    // As it is reported, in angles.
    let place_deg = angles_deg(&sun);
    let sun = direction(place_deg);
    let torque_n_m = sunlight.at(&sun)?.torque_n_m;
    if targeted(&torque_n_m).amax() > ZERO * greatest_n_m {
        return Ok(None);
    }
    // A turn of the spacecraft moves the Sun the other way in its axes.
    let (_, slopes) = sunlight.slopes(&sun, [Vector3::x(), Vector3::z()].map(|axis| sun.cross(&axis)))?;
    let stiffness = Matrix2::from_columns(&slopes.map(|slope| targeted(&slope)));
    let symmetric = 0.5 * (stiffness + stiffness.transpose());
    let is_restoring = symmetric.trace() < 0.0 && symmetric.determinant() > 0.0;
    Ok(Some(Balance { place_deg, torque_n_m, is_restoring }))
}

/// Finds the minimum of the whole torque within the limits of a grid, by a search with shrinking steps from its least node, in N m.
///
/// # Errors
/// A call that failed.
pub fn least(sunlight: &mut Sunlight<'_>, grid: &Grid) -> Result<(Angles, Vector3<f64>), Error> {
    let start = grid.nodes().min_by(|a, b| a.1.torque_n_m.norm().total_cmp(&b.1.torque_n_m.norm()));
    let Some((mut place, load)) = start else { return Ok(([0.0; 2], Vector3::zeros())) };
    let mut torque_n_m = load.torque_n_m;
    let mut step = [0, 1].map(|k| grid.limits_deg[k] / grid.steps[k] as f64);
    while step[0].max(step[1]) > 1e-9 {
        let mut is_better = false;
        for way in [
            [1.0, 0.0],
            [-1.0, 0.0],
            [0.0, 1.0],
            [0.0, -1.0],
            [1.0, 1.0],
            [-1.0, 1.0],
            [1.0, -1.0],
            [-1.0, -1.0],
        ] {
            let tried =
                [0, 1].map(|k| (place[k] + way[k] * step[k]).clamp(-grid.limits_deg[k], grid.limits_deg[k]));
            let there_n_m = sunlight.at(&direction(tried))?.torque_n_m;
            if there_n_m.norm() < torque_n_m.norm() {
                (place, torque_n_m, is_better) = (tried, there_n_m, true);
            }
        }
        if !is_better {
            step = step.map(|step| 0.5 * step);
        }
    }
    Ok((place, torque_n_m))
}
