//! Sun keep-in zone: limits of the Sun's azimuth and elevation about a body axis (paper 001, eqs 23 and 24, Table 6).
//!
//! The zone's frame is the body's turned by the smallest rotation that takes -Y to the zone's axis (to +Y: about Z). Where
//! an attitude puts the Sun outside, the vectors are exchanged: a boundary point B' is aimed at the Sun, and the old
//! boresight is rolled toward the old aimpoint. B' is the nearest point of the boundary in closed form, or the paper's:
//! both angles cut at their limits.
//!
//! The zone is symmetric in both angles, so its nearest point has the Sun's signs of azimuth a and elevation e. Within the
//! azimuth limit A it lies on the parallel of the limit E, at a; beyond, on the meridian of A at the foot of the great
//! circle perpendicular to it, tan e' = tan e / cos(|a| - A), or at its corner. On the equator beyond A + 90 deg both
//! corners are as near, the one at positive elevation is taken. Distances are angles on the sphere.

use nalgebra::{ComplexField, Matrix3, Vector3};

use crate::attitude::SunAngles;
use crate::enumeration::enumeration;
use crate::guidance::geometry::moving::{Moving, MovingVector, PARALLEL_RAD, direction, fixed, unit, value};
use crate::guidance::pointing::law::{Pointing, PointingVectors};
use crate::math;
use crate::numerics::scalar::{Scalar, sin_cos};

/// A Sun this little off the zone's boundary is on it, in rad.
const ON_BOUNDARY_RAD: f64 = 1e-9;

/// A Sun this little outside counts as inside, in rad: laws that put it on the boundary leave it there within rounding.
pub const BOUNDARY_RAD: f64 = 1e-12;

enumeration! {
    /// Which boundary point takes the place of a Sun outside.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub enum KeepInMethod {
        /// At the nearest point of the boundary.
        #[default]
        1 => Nearest,
        /// Azimuth and elevation clamped one by one, as paper 001 does; up to 3.5 deg farther away.
        2 => Clamp,
    }
}

/// Sun keep-in zone about a body axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeepIn {
    /// Centre of the zone, body frame, of any length.
    pub axis_body: Vector3<f64>,
    /// Greatest magnitude of the azimuth, 0 to pi/2.
    pub azimuth_rad: f64,
    /// Greatest magnitude of the elevation, 0 to pi/2.
    pub elevation_rad: f64,
    /// Boundary point.
    pub method: KeepInMethod,
    /// Greatest distance from the Sun at which it counts, in m.
    pub distance_m: f64,
}

/// An attitude with the Sun inside the zone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KeptIn {
    /// The attitude.
    pub pointing: Pointing,
    /// Whether the vectors were exchanged (Table 6).
    pub in_force: bool,
}

/// An attitude of vectors within a zone, and where the law takes its other form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WithinZone {
    /// The attitude.
    pub pointing: Pointing,
    /// How far the Sun is inside the zone in the attitude without it, in rad; infinite without one.
    pub margin: f64,
    /// Whether the zone moves the Sun.
    pub is_moved: bool,
}

/// The attitude of `vectors` with the Sun inside the zone, if there is one; `None` where boresight, aimpoint, the zone's axis or the
/// Sun has no direction. A Sun that the law itself holds on the boundary (`is_held`) stays there, whatever the rounding: no root.
pub fn within_zone(
    vectors: &PointingVectors,
    zone: Option<&KeepIn>,
    to_sun: &MovingVector,
    is_held: bool,
) -> Option<WithinZone> {
    let pointing = vectors.pointing()?;
    let Some(zone) = zone else {
        return Some(WithinZone { pointing, margin: f64::INFINITY, is_moved: false });
    };
    let sun_body = value(&pointing.to_body(to_sun)).try_normalize(0.0);
    let margin = sun_body.and_then(|sun_body| Some(-zone.excess_rad(&sun_body)?));
    let is_moved = margin.is_some_and(|margin| margin < -ON_BOUNDARY_RAD);
    let margin = margin.filter(|margin| !is_held || margin.abs() > ON_BOUNDARY_RAD);
    Some(WithinZone {
        pointing: zone.constrained(vectors, to_sun)?.pointing,
        margin: margin.unwrap_or(f64::INFINITY),
        is_moved,
    })
}

impl KeepIn {
    /// The attitude of `vectors` where it keeps the Sun inside, else that of the exchanged vectors; `None` where boresight,
    /// aimpoint, the zone's axis or the Sun has no direction.
    pub fn constrained(&self, vectors: &PointingVectors, to_sun: &MovingVector) -> Option<KeptIn> {
        let pointing = vectors.pointing()?;
        let sun_body = pointing.to_body(&unit(to_sun)?);
        match self.boundary_point(&sun_body)? {
            None => Some(KeptIn { pointing, in_force: false }),
            Some(boundary_body) => {
                let exchanged = PointingVectors {
                    boresight_body: boundary_body,
                    aimpoint: *to_sun,
                    body_roll: vectors.boresight_body,
                    external_roll: vectors.aimpoint,
                };
                Some(KeptIn { pointing: exchanged.pointing()?, in_force: true })
            }
        }
    }

    /// Azimuth and elevation of a body direction in the zone's frame; `None` where the axis has no direction.
    pub fn angles(&self, sun_body: &Vector3<f64>) -> Option<SunAngles> {
        Some(SunAngles::from_direction(&self.body_from_zone()?.tr_mul(sun_body)))
    }

    /// How far the Sun is outside, the greater of both angles' excesses, in rad; negative inside. `None` where the axis has
    /// no direction.
    pub fn excess_rad(&self, sun_body: &Vector3<f64>) -> Option<f64> {
        Some(-self.angles(sun_body)?.keep_in_margin_rad(self.azimuth_rad, self.elevation_rad))
    }

    /// Azimuth and elevation in the body frame of the point that takes the place of a Sun outside; `None` inside.
    pub fn boundary_angles(&self, sun_body: &Vector3<f64>) -> Option<SunAngles> {
        Some(SunAngles::from_direction(&value(&self.boundary_point(&fixed(*sun_body))??)))
    }

    /// The boundary point for the unit vector `sun_body`, inner `None` inside the zone; outer `None` where the axis has no
    /// direction.
    fn boundary_point(&self, sun_body: &MovingVector) -> Option<Option<MovingVector>> {
        let body_from_zone = self.body_from_zone()?.map(Moving::from_re);
        let sun = body_from_zone.tr_mul(sun_body);
        let now = SunAngles::from_direction(&value(&sun));
        if now.keep_in_margin_rad(self.azimuth_rad, self.elevation_rad) >= -BOUNDARY_RAD {
            return Some(None);
        }
        // What lies on an axis within rounding takes the positive side, and an azimuth of 0.
        let side = |angle_rad: f64, off: Moving| {
            if off.re.abs() >= PARALLEL_RAD && angle_rad < 0.0 { -1.0 } else { 1.0 }
        };
        let azimuth_sign = side(now.azimuth_rad, sun.x);
        let elevation_sign = side(now.elevation_rad, sun.z);
        // In the octant of positive azimuth and elevation.
        let (x, y) = (sun.x * azimuth_sign, sun.y);
        let up = -sun.z * elevation_sign;
        // Neither a sign of zero nor rounding may show on the far side.
        let up = if up.re <= 0.0 { Moving::constant(0.0) } else { up };
        let [azimuth_limit, elevation_limit] = [self.azimuth_rad, self.elevation_rad].map(Moving::constant);
        let at_pole = math::hypot(x.re, y.re) < PARALLEL_RAD;
        let beyond_azimuth = !at_pole && now.azimuth_rad.abs() > self.azimuth_rad;
        let azimuth = if beyond_azimuth {
            azimuth_limit
        } else if at_pole {
            Moving::constant(0.0)
        } else {
            Moving::polar_angle(x, -y)
        };
        let foot = if beyond_azimuth && self.method == KeepInMethod::Nearest {
            let (sine, cosine) = sin_cos(azimuth);
            Moving::polar_angle(up, x * sine - y * cosine)
        } else {
            let across = if at_pole { Moving::constant(0.0) } else { (x * x + y * y).sqrt() };
            Moving::polar_angle(up, across)
        };
        let elevation = if foot.re > self.elevation_rad { elevation_limit } else { foot };
        Some(Some(body_from_zone * direction(azimuth * azimuth_sign, elevation * elevation_sign)))
    }

    /// How near a direction that starts at the unit vector `from_body` and turns by `turn_body_rad` comes to the boundary:
    /// the least distance to its planes, of azimuth through Z and of elevation across it; negative where it goes beyond.
    pub(crate) fn least_margin_on_turn(
        &self,
        body_from_zone: &Matrix3<f64>,
        from_body: &Vector3<f64>,
        turn_body_rad: &Vector3<f64>,
    ) -> f64 {
        let [from, turn] = [from_body, turn_body_rad].map(|body| body_from_zone.tr_mul(body));
        let angle_rad = turn.norm();
        let axis = turn.try_normalize(0.0).unwrap_or_default();
        let along = axis * axis.dot(&from);
        let (across, ahead) = (from - along, axis.cross(&from));
        let (sin_a, cos_a) = math::sin_cos(self.azimuth_rad);
        let up = math::sin(self.elevation_rad);
        let planes = [
            (Vector3::new(-cos_a, -sin_a, 0.0), 0.0),
            (Vector3::new(cos_a, -sin_a, 0.0), 0.0),
            (Vector3::z(), up),
            (-Vector3::z(), up),
        ];
        let least = planes.map(|(normal, offset)| {
            // The distance after a turn by phi is mean + c cos(phi) + s sin(phi).
            let (mean, c, s) = (offset + normal.dot(&along), normal.dot(&across), normal.dot(&ahead));
            let lowest_rad = math::atan2(-s, -c).rem_euclid(core::f64::consts::TAU);
            let (sin_end, cos_end) = math::sin_cos(angle_rad);
            let at_ends = (mean + c).min(mean + c * cos_end + s * sin_end);
            if lowest_rad < angle_rad { at_ends.min(mean - math::hypot(c, s)) } else { at_ends }
        });
        least.into_iter().fold(f64::INFINITY, f64::min)
    }

    /// From the zone's frame to the body's: the smallest rotation that takes -Y to the axis.
    pub(crate) fn body_from_zone(&self) -> Option<Matrix3<f64>> {
        let axis = value(&unit(&fixed(self.axis_body))?);
        // The rotation's axis times the sine of its angle: -Y x axis.
        let normal = Vector3::new(-axis.z, 0.0, axis.x);
        let cosine = -axis.y;
        let sine = normal.norm();
        // (1 - cosine) times the dyad of the rotation's axis, without cancellation on either side.
        let dyad = if cosine >= 0.0 {
            normal * normal.transpose() / (1.0 + cosine)
        } else {
            let unit_normal = if sine > 0.0 { normal / sine } else { Vector3::z() };
            unit_normal * unit_normal.transpose() * (1.0 - cosine)
        };
        Some(Matrix3::identity() * cosine + normal.cross_matrix() + dyad)
    }
}

#[cfg(test)]
mod tests;
