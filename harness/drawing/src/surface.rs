//! A flat surface in space, and how it is drawn.

use nalgebra::Vector3;

use super::shading::mixed;

/// A place in m or a direction, in the body frame.
pub type Vector = Vector3<f64>;

/// Appearance of a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finish {
    /// Cloth or sheet.
    Plate,
    /// A panel's solar cells.
    Cells,
    /// Part of a round body: without edges.
    Facet,
    /// Metal of a nozzle.
    Nozzle,
}

/// A flat polygon in space.
#[derive(Clone, Debug)]
pub struct Surface {
    /// In order around the outline.
    pub corners: Vec<Vector>,
    /// Mean of the corners.
    pub center: Vector,
    /// Out of the front.
    pub normal: Vector,
    /// Two directions in the plane that the grid of a solar panel follows.
    pub grid: [Vector; 2],
    /// Appearance.
    pub finish: Finish,
    /// The entry of the legend that it belongs to.
    pub part: usize,
}

impl Surface {
    /// With its outline, else a square of this area about this centre. Only a panel has an axis, and solar cells.
    pub fn new(
        outline: Option<Vec<Vector>>,
        (area_m2, center_m): (f64, Vector),
        normal: Vector,
        axis: Option<Vector>,
    ) -> Option<Self> {
        // One edge of a square lies along the panel's axis, or across the plane of normal and Z.
        let along =
            axis.or_else(|| unit(normal.cross(&Vector::z()))).or_else(|| unit(normal.cross(&Vector::x())))?;
        let across = unit(normal.cross(&along))?;
        let corners = match outline {
            Some(outline) => outline,
            None => square(area_m2, center_m, along, across)?,
        };
        let finish = if axis.is_some() { Finish::Cells } else { Finish::Plate };
        Some(Self { center: mean(&corners), corners, normal, grid: [along, across], finish, part: 0 })
    }

    /// Facet of a round body, from its corners; the normal follows them by the right-hand rule.
    pub fn facet(corners: Vec<Vector>, finish: Finish, part: usize) -> Option<Self> {
        let [a, b, c, ..] = corners[..] else { return None };
        let normal = unit((b - a).cross(&(c - b)))?;
        let edge = unit(b - a)?;
        let grid = [edge, normal.cross(&edge)];
        Some(Self { center: mean(&corners), corners, normal, grid, finish, part })
    }

    /// Front sides in the light are bright; cells are blue, cloth is yellowish white, backs are grey.
    pub fn colour(&self, front: bool, light: Vector) -> String {
        let light = unit(light).map_or(0.0, |light| self.normal.dot(&light)).max(0.0);
        let shades: [[u8; 3]; 2] = match (self.finish, front) {
            (Finish::Cells, true) => [[0x16, 0x2c, 0x5c], [0x3f, 0x74, 0xc4]],
            (Finish::Nozzle, _) => [[0x4a, 0x52, 0x5c], [0x7d, 0x86, 0x91]],
            (_, true) => [[0xb0, 0xa5, 0x8c], [0xff, 0xf6, 0xe2]],
            (_, false) => [[0x6f, 0x75, 0x7d], [0x8e, 0x95, 0x9e]],
        };
        mixed(&shades.map(|shade| shade.map(f64::from)), light)
    }

    /// Ends of the lines of a solar panel's grid: nearly square cells over the rectangle around the outline.
    pub fn cell_lines(&self) -> Vec<[Vector; 2]> {
        const CELLS: f64 = 25.0;
        let [low, high] = [f64::min, f64::max].map(|pick| {
            self.grid.map(|direction| {
                let along = self.corners.iter().map(|corner| corner.dot(&direction));
                along.reduce(pick).unwrap_or_default()
            })
        });
        let size = [high[0] - low[0], high[1] - low[1]];
        let cell = (size[0] * size[1] / CELLS).sqrt();
        let offset = self.center.dot(&self.normal);
        let point = |a: f64, b: f64| a * self.grid[0] + b * self.grid[1] + offset * self.normal;
        let mut lines = Vec::new();
        for axis in 0..2 {
            let count = (size[axis] / cell).round().clamp(1.0, CELLS) as u32;
            for k in 1..count {
                let at = low[axis] + size[axis] * f64::from(k) / f64::from(count);
                let ends = [low[1 - axis], high[1 - axis]];
                lines.push(ends.map(|end| if axis == 0 { point(at, end) } else { point(end, at) }));
            }
        }
        lines
    }
}

/// The unit vector; `None` of what has no direction.
pub fn unit(vector: Vector) -> Option<Vector> {
    vector.try_normalize(1e-9).filter(|unit| unit.iter().all(|x| x.is_finite()))
}

fn mean(corners: &[Vector]) -> Vector {
    corners.iter().sum::<Vector>() / corners.len() as f64
}

fn square(area_m2: f64, center: Vector, along: Vector, across: Vector) -> Option<Vec<Vector>> {
    let half = area_m2.sqrt() / 2.0;
    let corner = |(a, b): (f64, f64)| center + half * (a * along + b * across);
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner);
    (half.is_finite() && half > 0.0).then(|| corners.to_vec())
}
