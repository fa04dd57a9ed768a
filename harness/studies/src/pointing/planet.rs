//! The planet as an ellipsoid: where lines meet it, what is seen of it, where its limb is.
//!
//! Lengths along its axes in units of its radii make it the unit sphere.

use nalgebra::Matrix3;

use crate::attitude::Vector;
use crate::case::recorded;

recorded! {
    /// Radii, pole and rotation, from the parameters of Guidance.
    pub(super) struct Planet {
        /// Along its own axes, in m.
        pub radii_m: Vector = "planet.radii",
        pole_right_ascension_rad: f64 = "planet.poleRightAscension",
        pole_declination_rad: f64 = "planet.poleDeclination",
        prime_meridian_rad: f64 = "planet.primeMeridian",
        rotation_rate_rad_s: f64 = "planet.rotationRate",
    }
}

/// The planet at one moment, by vectors in EME2000 from its centre.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ellipsoid {
    axes: Matrix3<f64>,
    radii_m: Vector,
}

impl Planet {
    /// At an epoch in s past J2000 TDB.
    pub(super) fn at(&self, epoch_s: f64) -> Ellipsoid {
        let (sin_a, cos_a) = self.pole_right_ascension_rad.sin_cos();
        let (sin_d, cos_d) = self.pole_declination_rad.sin_cos();
        let pole = Vector::new(cos_d * cos_a, cos_d * sin_a, sin_d);
        // The ascending node of its equator on that of EME2000.
        let node = Vector::new(-sin_a, cos_a, 0.0);
        let ahead = pole.cross(&node);
        let (sin_w, cos_w) = (self.prime_meridian_rad + self.rotation_rate_rad_s * epoch_s).sin_cos();
        let x = node * cos_w + ahead * sin_w;
        Ellipsoid { axes: Matrix3::from_columns(&[x, pole.cross(&x), pole]), radii_m: self.radii_m }
    }
}

impl Ellipsoid {
    /// Its x, y and z axis: columns.
    pub(super) fn axes(&self) -> &Matrix3<f64> {
        &self.axes
    }

    /// Components along its axes in units of its radii.
    fn in_radii(&self, v: &Vector) -> Vector {
        self.along_axes(v).component_div(&self.radii_m)
    }

    /// The other way.
    fn in_meters(&self, y: &Vector) -> Vector {
        self.inertial(&y.component_mul(&self.radii_m))
    }

    /// EME2000 components of components along its axes.
    pub(super) fn inertial(&self, v: &Vector) -> Vector {
        self.axes * v
    }

    /// Components along its axes.
    pub(super) fn along_axes(&self, v: &Vector) -> Vector {
        self.axes.tr_mul(v)
    }

    /// The surface point in this direction from the centre.
    pub(super) fn surface(&self, direction: &Vector) -> Vector {
        direction * (1.0 / self.in_radii(direction).norm())
    }

    /// x . r in units of the radii, less 1: 0 at limb points, positive where the surface is seen (paper 001, eq 21).
    pub(super) fn beyond_limb(&self, surface: &Vector, from: &Vector) -> f64 {
        self.in_radii(surface).dot(&self.in_radii(from)) - 1.0
    }

    /// Where a line first meets the surface.
    pub(super) fn hit(&self, from: &Vector, direction: &Vector) -> Option<Vector> {
        let (origin, ray) = (self.in_radii(from), self.in_radii(direction));
        let (along, square) = (-origin.dot(&ray), ray.norm_squared());
        let inside = along * along - square * (origin.norm_squared() - 1.0);
        let distance = (along - inside.max(0.0).sqrt()) / square;
        (inside >= 0.0 && along > 0.0).then(|| from + direction * distance)
    }

    /// Where a line meets the surface, or comes nearest to it in units of the radii.
    pub(super) fn hit_or_nearest(&self, from: &Vector, direction: &Vector) -> Vector {
        self.hit(from, direction).unwrap_or_else(|| {
            let (origin, ray) = (self.in_radii(from), self.in_radii(direction));
            from + direction * (-origin.dot(&ray) / ray.norm_squared())
        })
    }

    /// The limb point below a line and the line's height over it along the radius, in m.
    ///
    /// Of the line's points the one whose radius meets the surface at the limb (eq 21), by bisection: from the spacecraft on
    /// the radius turns toward the line's direction, and its end goes from the visible side over the limb.
    pub(super) fn height_over_limb_m(&self, from: &Vector, direction: &Vector) -> Option<(Vector, f64)> {
        let at = |distance: f64| from + direction * distance;
        let beyond = |distance: f64| self.beyond_limb(&self.surface(&at(distance)), from);
        let (mut near, mut far) = (0.0, 2.0 * from.norm());
        if beyond(far) >= 0.0 {
            return None;
        }
        for _ in 0..200 {
            let middle = 0.5 * (near + far);
            if beyond(middle) > 0.0 { near = middle } else { far = middle }
        }
        let point = at(near);
        let foot = self.surface(&point);
        Some((foot, point.norm() - foot.norm()))
    }

    /// The points of the surface in the plane through the centre normal to `normal`, once round.
    pub(super) fn great_ellipse(&self, normal: &Vector, count: u32) -> Vec<Vector> {
        circle(normal, count).map(|direction| self.surface(&direction)).collect()
    }

    /// The limb points on the terminator, the plane normal to the Sun's direction: changes of sign of eq 21 along it.
    pub(super) fn terminator_limb_points(&self, from: &Vector, sun: &Vector) -> Vec<Vector> {
        const POINTS: u32 = 720;
        let ellipse = self.great_ellipse(sun, POINTS);
        let sides = ellipse.iter().zip(ellipse.iter().cycle().skip(1));
        sides
            .filter(|(a, b)| (self.beyond_limb(a, from) > 0.0) != (self.beyond_limb(b, from) > 0.0))
            .map(|(a, b)| {
                let (mut seen, mut hidden) =
                    if self.beyond_limb(a, from) > 0.0 { (*a, *b) } else { (*b, *a) };
                for _ in 0..60 {
                    let middle = self.surface(&((seen + hidden) * 0.5));
                    if self.beyond_limb(&middle, from) > 0.0 { seen = middle } else { hidden = middle }
                }
                seen
            })
            .collect()
    }

    /// Whether the Sun is above the terminator's plane there.
    pub(super) fn is_day(surface: &Vector, sun: &Vector) -> bool {
        surface.dot(sun) > 0.0
    }

    /// The limb, once round: the circle on the unit sphere whose tangents meet at the spacecraft.
    pub(super) fn limb(&self, from: &Vector, count: u32) -> Vec<Vector> {
        let rho = self.in_radii(from);
        let square = rho.norm_squared();
        let middle = rho * (1.0 / square);
        let radius = (1.0 - 1.0 / square).sqrt();
        circle(&rho, count).map(|side| self.in_meters(&(middle + side * radius))).collect()
    }
}

/// Unit vectors across `normal`, once round.
fn circle(normal: &Vector, count: u32) -> impl Iterator<Item = Vector> {
    let u = (normal.cross(&Vector::ith(normal.iamin(), 1.0))).normalize();
    let v = normal.cross(&u).normalize();
    (0..count).map(move |k| {
        let (sine, cosine) = (core::f64::consts::TAU * f64::from(k) / f64::from(count)).sin_cos();
        u * cosine + v * sine
    })
}
