//! Loads on a regular grid of the Sun's azimuth and elevation.

use fmi::Error;
use nalgebra::Vector3;
use physics::attitude::{SunAngles, direction_from_angles};
use rayon::prelude::*;

use super::sunlight::{LitSpacecraft, Load, Sunlight};

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
pub(super) fn angles_deg(direction: &Vector3<f64>) -> Angles {
    let of = SunAngles::from_direction(direction);
    [of.azimuth_rad.to_degrees(), of.elevation_rad.to_degrees()]
}

/// Corners of the cell beyond a node, counter-clockwise from it.
pub(super) fn cell(column: usize, row: usize) -> [(usize, usize); 4] {
    let (right, above) = (column.wrapping_add(1), row.wrapping_add(1));
    [(column, row), (right, row), (right, above), (column, above)]
}

impl Grid {
    /// Asks for every node, on as many threads as the computer has; what acts depends on the direction alone.
    ///
    /// # Errors
    /// A call that failed.
    pub fn new<'a>(
        spacecraft: &'a LitSpacecraft,
        limits_deg: Angles,
        steps: [usize; 2],
    ) -> Result<Self, Error> {
        let empty = Self { limits_deg, steps, loads: Vec::new() };
        let row = |sunlight: &mut Option<Sunlight<'a>>, row: usize| {
            let mut own = sunlight.take().map_or_else(|| Sunlight::new(spacecraft), Ok)?;
            let loads = empty.row(&mut own, row);
            *sunlight = Some(own);
            loads
        };
        let rows = (0..=steps[1]).into_par_iter().map_init(|| None, row);
        Ok(Self { loads: rows.collect::<Result<Vec<_>, Error>>()?.concat(), ..empty })
    }

    fn row(&self, sunlight: &mut Sunlight<'_>, row: usize) -> Result<Vec<Load>, Error> {
        // The first azimuth of a whole turn is the last one too.
        let turns_round = self.limits_deg[0] == 180.0;
        let mut loads: Vec<Load> = Vec::with_capacity(self.steps[0] + 1);
        for column in 0..=self.steps[0] {
            let load = match loads.first() {
                Some(first) if turns_round && column == self.steps[0] => *first,
                _ => sunlight.at(&direction(self.angles_deg(column, row)))?,
            };
            loads.push(load);
        }
        Ok(loads)
    }

    /// Returns the angles of a node.
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

    /// Whether a node is a corner of a cell on which a component is 0: dark or symmetric. A line of zeros has no such cell.
    pub fn is_flat(&self, axis: usize) -> impl Fn(usize, usize) -> bool + '_ {
        let value_n_m = self.component_n_m(axis);
        let vanishes = move |column: usize, row: usize| {
            column <= self.steps[0] && row <= self.steps[1] && value_n_m(column, row) == 0.0
        };
        move |column, row| {
            let cells = [(0, 0), (1, 0), (0, 1), (1, 1)]
                .map(|(left, below)| (column.wrapping_sub(left), row.wrapping_sub(below)));
            vanishes(column, row)
                && cells.into_iter().any(|(column, row)| {
                    cell(column, row).into_iter().all(|(column, row)| vanishes(column, row))
                })
        }
    }

    /// The corners of the cell that a place is in.
    pub(super) fn corners(&self, place_deg: Angles) -> [(usize, usize); 4] {
        let [column, row] = [0, 1].map(|axis| {
            let part = 0.5 * (place_deg[axis] / self.limits_deg[axis] + 1.0);
            ((part * self.steps[axis] as f64).floor().max(0.0) as usize).min(self.steps[axis] - 1)
        });
        cell(column, row)
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
