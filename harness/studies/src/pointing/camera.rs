//! A square field of view: what it sees of the planet, and how much two fields share.

use super::flight::PointingSample;
use super::planet::{Ellipsoid, Planet};
use crate::attitude::Vector;

/// Half the field and where it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Camera {
    /// Its name.
    pub name: &'static str,
    /// Side of the square field, in deg.
    pub field_deg: f64,
    /// Whether it looks at the camera's angle; otherwise along +Z.
    pub on_platform: bool,
}

/// One frame: the field at one sample.
pub(super) struct Frame<'a> {
    /// When and from where.
    pub sample: &'a PointingSample,
    half_tangent: f64,
    /// Boresight, across toward +X, across sunward; body frame.
    axes: [Vector; 3],
    planet: &'a Planet,
}

/// Points along a side of an outline.
const SIDE: u32 = 12;
/// Directions along a side of a field by which overlap is counted.
const LATTICE: u32 = 60;

impl Camera {
    /// Its frame at a sample.
    pub(super) fn frame<'a>(&self, sample: &'a PointingSample, planet: &'a Planet) -> Frame<'a> {
        let angle = if self.on_platform { sample.mdis_angle_rad } else { 0.0 };
        let (sine, cosine) = angle.sin_cos();
        Frame {
            sample,
            half_tangent: (0.5 * self.field_deg).to_radians().tan(),
            axes: [Vector::new(0.0, -sine, cosine), Vector::x(), Vector::new(0.0, -cosine, -sine)],
            planet,
        }
    }
}

impl Frame<'_> {
    fn ellipsoid(&self) -> Ellipsoid {
        self.planet.at(self.sample.place.epoch_s)
    }

    /// EME2000 direction at -1 to 1 across the field.
    fn direction(&self, x: f64, y: f64) -> Vector {
        let [boresight, right, sunward] = &self.axes;
        let side = right * (self.half_tangent * x) + sunward * (self.half_tangent * y);
        self.sample.inertial(&(boresight + side))
    }

    /// Of the boresight, EME2000.
    pub(super) fn boresight(&self) -> Vector {
        self.direction(0.0, 0.0)
    }

    /// Where a direction meets the planet, or comes nearest to it, along the planet's axes.
    fn on_planet(&self, direction: &Vector) -> Vector {
        let ellipsoid = self.ellipsoid();
        ellipsoid.along_axes(&ellipsoid.hit_or_nearest(&self.sample.place.position_m, direction))
    }

    /// The middle along the planet's axes, in m.
    pub(super) fn middle_m(&self) -> Vector {
        self.on_planet(&self.boresight())
    }

    /// The outline once round along the planet's axes, in m; beside the planet the points nearest to it.
    pub(super) fn outline_m(&self) -> Vec<Vector> {
        let step = |k: u32| 2.0 * f64::from(k) / f64::from(SIDE) - 1.0;
        let side = |corner: fn(f64) -> (f64, f64)| (0..SIDE).map(move |k| corner(step(k)));
        let around = side(|t| (t, -1.0))
            .chain(side(|t| (1.0, t)))
            .chain(side(|t| (-t, 1.0)))
            .chain(side(|t| (-1.0, -t)))
            .chain([(-1.0, -1.0)]);
        around.map(|(x, y)| self.on_planet(&self.direction(x, y))).collect()
    }

    /// Whether the frame shows the surface point given along the planet's axes.
    pub(super) fn shows(&self, surface_m: &Vector) -> bool {
        let ellipsoid = self.ellipsoid();
        let point = ellipsoid.inertial(surface_m);
        let from = &self.sample.place.position_m;
        let seen = self.sample.q.inverse_transform_vector(&(point - from));
        let [depth, x, y] = self.axes.map(|axis| axis.dot(&seen));
        let limit = self.half_tangent * depth;
        depth > 0.0 && x.abs() <= limit && y.abs() <= limit && ellipsoid.beyond_limb(&point, from) > 0.0
    }

    /// Points of the surface in the field, along the planet's axes, evenly over it; and the share of the field they fill.
    pub(super) fn surface_m(&self) -> (Vec<Vector>, f64) {
        let ellipsoid = self.ellipsoid();
        let at = |k: u32| (2.0 * f64::from(k) + 1.0) / f64::from(LATTICE) - 1.0;
        let hits: Vec<Vector> = (0..LATTICE * LATTICE)
            .filter_map(|k| {
                let direction = self.direction(at(k % LATTICE), at(k / LATTICE));
                ellipsoid.hit(&self.sample.place.position_m, &direction)
            })
            .map(|hit| ellipsoid.along_axes(&hit))
            .collect();
        let share = hits.len() as f64 / f64::from(LATTICE * LATTICE);
        (hits, share)
    }
}
