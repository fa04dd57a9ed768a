//! Acceleration by light as a function of the place, of a spacecraft whose attitude follows Sun and Earth.
//!
//! Equation: the force F is proportional to the pressure, 1 / d^2 at d from the Sun, and turns with the body: dF = dtheta x F + F dP / P. In
//! downlinks the Sun stands still in the body frame and the Earth stays across w, the Z axis (alternate: turned by 180 deg about the
//! Sun line s): dtheta = s x ds + a s, a (s . (w x e)) = -w . de - (s x ds) . (w x e), e toward the Earth. Otherwise a = 0. Arrays stand
//! still to the Sun, or follow its distance: then F changes by that too.
//! Where the downlink attitude turns to its other form (at 90 deg between Sun and Earth for MESSENGER) the acceleration jumps, earlier or
//! later by dt = -dh / h', h = s . e: the state behind it is off by (a before - a after) dt, the saltation.

use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};
use physics::{attitude::SunAngles, plant::LightSource};

use super::flight::{Path, PathRow};
use crate::momentum::{simulated::FlightRow, torque::SunlitSpacecraft};

/// An angle between attitudes above which one is the other turned over, in rad.
const TURNED_RAD: f64 = core::f64::consts::FRAC_PI_2;
/// Halvings of the time between two rows.
const HALVINGS: usize = 20;
/// The Earth is across an axis to this, as a sine.
const ACROSS: f64 = 1e-3;

/// Light along a path.
pub(super) struct LightAlong<'a> {
    path: &'a Path<'a>,
    sunlit: &'a SunlitSpacecraft,
    /// Whether its pressure is the same everywhere.
    is_fixed: bool,
    /// By row, of downlinks: whether the attitude is the alternate one.
    alternate: Vec<Option<bool>>,
}

/// Time at which the attitude turns over because Sun and Earth have come to an angle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Flip {
    /// In s of the flight.
    pub time_s: f64,
    /// Takes a small change of the state before it to that behind it.
    pub saltation: Matrix6<f64>,
}

impl<'a> LightAlong<'a> {
    pub(super) fn new(path: &'a Path<'a>, sunlit: &'a SunlitSpacecraft) -> Self {
        let alternate = |it: &PathRow<'_>| {
            let law = law(sunlit, it.row, it.row).filter(|_| it.row.downlink)?;
            Some(law.angle_to(&it.row.inertial_from_body) > TURNED_RAD)
        };
        let is_fixed = matches!(sunlit.light.source, LightSource::Fixed { .. });
        Self { path, sunlit, is_fixed, alternate: path.rows.iter().map(alternate).collect() }
    }

    /// Gradient of the acceleration by the place, EME2000, 1/s2, by the row nearest to a time.
    pub(super) fn gradient_per_s2(&self, time_s: f64) -> Matrix3<f64> {
        let PathRow { row, motion } = self.path.nearest(time_s);
        let (sun_m, earth_m) = (row.to_sun_m.norm(), row.to_earth_m.norm());
        let (sun, earth) = (row.to_sun_m / sun_m, row.to_earth_m / earth_m);
        let across = across_earth(&row.inertial_from_body, &sun, &earth).filter(|_| row.downlink);
        let by_distance_n_m = self.sunlit.force_by_distance_n_m(row);
        let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|moved: Vector3<f64>| {
            let by_sun = (sun * sun.dot(&moved) - moved) / sun_m;
            let by_earth = (earth * earth.dot(&moved) - moved) / earth_m;
            let mut turn = sun.cross(&by_sun);
            if let Some(across) = across {
                let normal = across.cross(&earth);
                turn -= sun * ((across.dot(&by_earth) + turn.dot(&normal)) / sun.dot(&normal));
            }
            let pressure = if self.is_fixed { 0.0 } else { 2.0 * sun.dot(&moved) / sun_m };
            turn.cross(&motion.light_n) + motion.light_n * pressure - by_distance_n_m * sun.dot(&moved)
        });
        Matrix3::from_columns(&columns) / motion.mass_kg
    }

    /// Returns the times at which the attitude of downlinks turns over by itself, in order.
    pub(super) fn flips(&self) -> Vec<Flip> {
        let pairs = self.path.rows.windows(2).zip(self.alternate.windows(2));
        let flip = |(rows, alternate): (&[PathRow<'_>], &[Option<bool>])| {
            let [from, to] = [rows[0], rows[1]];
            let turned_rad = from.row.inertial_from_body.angle_to(&to.row.inertial_from_body);
            let is_flip = alternate[0].is_some() && alternate[0] == alternate[1] && turned_rad > TURNED_RAD;
            is_flip.then(|| flip([from, to], self.flip_s([from.row, to.row])))
        };
        pairs.filter_map(flip).collect()
    }

    /// When the law turns over between two rows, by halving.
    fn flip_s(&self, [from, to]: [&FlightRow; 2]) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        let before = law(self.sunlit, from, from);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let there = law(self.sunlit, &from.toward(to, middle), from);
            let is_turned = before.zip(there).is_some_and(|(a, b)| a.angle_to(&b) > TURNED_RAD);
            if is_turned { high = middle } else { low = middle }
        }
        from.time_s + 0.5 * (low + high) * (to.time_s - from.time_s)
    }
}

/// Attitude of a downlink at a row with the Sun where it stands in the body frame at another.
fn law(sunlit: &SunlitSpacecraft, row: &FlightRow, place: &FlightRow) -> Option<Rotation3<f64>> {
    let sun_body = place.inertial_from_body.inverse() * place.to_sun_m;
    let SunAngles { azimuth_rad, elevation_rad } = SunAngles::from_direction(&sun_body);
    sunlit.downlink_attitude(row, azimuth_rad, elevation_rad)
}

/// Between two rows; h by the place is -(e - s h) / |to Sun| - (s - e h) / |to Earth|.
fn flip([from, to]: [PathRow<'_>; 2], time_s: f64) -> Flip {
    let cosine = |it: PathRow<'_>| it.row.to_sun_m.normalize().dot(&it.row.to_earth_m.normalize());
    let span_s = to.row.time_s - from.row.time_s;
    let rate_1_s = (cosine(to) - cosine(from)) / span_s;
    let (sun, earth) = (from.row.to_sun_m, from.row.to_earth_m);
    let [s, e] = [sun.normalize(), earth.normalize()];
    let h = s.dot(&e);
    let by_place = -(e - s * h) / sun.norm() - (s - e * h) / earth.norm();
    let acceleration = |it: PathRow<'_>| it.motion.light_n / it.motion.mass_kg;
    let mut saltation = Matrix6::identity();
    if rate_1_s != 0.0 {
        let jump_m_s2 = acceleration(to) - acceleration(from);
        saltation.fixed_view_mut::<3, 3>(3, 0).copy_from(&(jump_m_s2 * by_place.transpose() / rate_1_s));
    }
    Flip { time_s, saltation }
}

/// The body's Z axis, or that of the attitude turned over about the Sun line, whichever the Earth is across.
fn across_earth(
    inertial_from_body: &Rotation3<f64>,
    sun: &Vector3<f64>,
    earth: &Vector3<f64>,
) -> Option<Vector3<f64>> {
    let z = inertial_from_body * Vector3::z();
    let turned = sun * (2.0 * sun.dot(&z)) - z;
    let is_across =
        |axis: &Vector3<f64>| axis.dot(earth).abs() < ACROSS && sun.dot(&axis.cross(earth)).abs() > ACROSS;
    [z, turned].into_iter().find(is_across)
}

#[cfg(test)]
mod tests;
