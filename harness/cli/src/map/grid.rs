//! Loads on a regular grid of the Sun's azimuth and elevation.

use loader::Error;
use nalgebra::Vector3;
use physics::attitude::{SunAngles, direction_from_angles};

use super::sunlight::{Load, Sunlight};

/// Least part of the greatest torque that is not rounding.
const ROUNDING: f64 = 1e-13;

/// Azimuth and elevation, in deg.
pub type Angles = [f64; 2];

/// A rectangle of directions: nodes count from the least azimuth and elevation.
pub struct Grid {
    /// Greatest azimuth and elevation; the least are their negatives.
    pub limits_deg: Angles,
    /// Steps from the least to the greatest.
    pub steps: [usize; 2],
    /// Rows of elevation, in each the azimuths.
    loads: Vec<Load>,
}

/// The Sun's direction in the body frame.
pub fn direction([azimuth_deg, elevation_deg]: Angles) -> Vector3<f64> {
    direction_from_angles(SunAngles {
        azimuth_rad: azimuth_deg.to_radians(),
        elevation_rad: elevation_deg.to_radians(),
    })
}

/// Azimuth and elevation of a direction.
pub fn angles_deg(direction: &Vector3<f64>) -> Angles {
    let of = SunAngles::of(direction);
    [of.azimuth_rad.to_degrees(), of.elevation_rad.to_degrees()]
}

impl Grid {
    /// Asks for every node.
    pub fn new(sunlight: &mut Sunlight<'_>, limits_deg: Angles, steps: [usize; 2]) -> Result<Self, Error> {
        let mut grid = Self { limits_deg, steps, loads: Vec::with_capacity((steps[0] + 1) * (steps[1] + 1)) };
        // The first azimuth of a whole turn is the last one too.
        let turns_round = limits_deg[0] == 180.0;
        for row in 0..=steps[1] {
            for column in 0..=steps[0] {
                let load = if turns_round && column == steps[0] {
                    *grid.at(0, row)
                } else {
                    sunlight.at(&direction(grid.angles_deg(column, row)))?
                };
                grid.loads.push(load);
            }
        }
        Ok(grid)
    }

    /// Of a node.
    pub fn angles_deg(&self, column: usize, row: usize) -> Angles {
        let at = |axis: usize, index: usize| {
            let (index, steps) = (index as f64, self.steps[axis] as f64);
            self.limits_deg[axis] * (2.0 * index - steps) / steps
        };
        [at(0, column), at(1, row)]
    }

    /// The load at a node.
    pub fn at(&self, column: usize, row: usize) -> &Load {
        &self.loads[row * (self.steps[0] + 1) + column]
    }

    /// Every node with its load.
    pub fn nodes(&self) -> impl Iterator<Item = (Angles, &Load)> {
        let columns = self.steps[0] + 1;
        self.loads.iter().enumerate().map(move |(k, load)| (self.angles_deg(k % columns, k / columns), load))
    }

    /// Greatest size of a component of torque, in N m.
    pub fn greatest_n_m(&self, axis: usize) -> f64 {
        self.loads.iter().map(|load| load.torque_n_m[axis].abs()).fold(0.0, f64::max)
    }

    /// Greatest torque, in N m, and where.
    pub fn most(&self) -> (Angles, f64) {
        let sizes = self.nodes().map(|(at, load)| (at, load.torque_n_m.norm()));
        sizes.fold(([0.0; 2], 0.0), |most, next| if next.1 > most.1 { next } else { most })
    }

    /// A component of torque, 0 where it is rounding of the greatest torque.
    pub fn component_n_m(&self, axis: usize) -> impl Fn(usize, usize) -> f64 + '_ {
        let least_n_m = ROUNDING * self.most().1;
        move |column, row| {
            let value_n_m = self.at(column, row).torque_n_m[axis];
            if value_n_m.abs() <= least_n_m { 0.0 } else { value_n_m }
        }
    }
}
