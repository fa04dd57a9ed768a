//! Random directions, smooth motions and differences for the tests of the guidance laws.

use nalgebra::{Matrix3, Vector3};

use crate::guidance::constraints::keep_in::{KeepIn, KeepInMethod};
use crate::guidance::geometry::moving::{MovingVector, matrix_value, moving};
use crate::guidance::pointing::law::Pointing;

/// The zone about -Y with its nearest boundary point.
pub(crate) fn nearest_zone(azimuth_rad: f64, elevation_rad: f64) -> KeepIn {
    let method = KeepInMethod::Nearest;
    KeepIn { axis_body: -Vector3::y(), azimuth_rad, elevation_rad, method, distance_m: 1e13 }
}

/// Numbers of SplitMix64 (Steele, Lea and Flood 2014).
pub(crate) struct Random(pub u64);

impl Random {
    /// The next number in `low..high`.
    pub(crate) fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut bits = self.0;
        bits = (bits ^ (bits >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        bits = (bits ^ (bits >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        bits ^= bits >> 31;
        low + (high - low) * ((bits >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// A direction, uniform on the sphere.
    pub(crate) fn direction(&mut self) -> Vector3<f64> {
        let (z, angle_rad) = (self.within(-1.0, 1.0), self.within(0.0, std::f64::consts::TAU));
        let across = (1.0 - z * z).sqrt();
        Vector3::new(across * angle_rad.cos(), across * angle_rad.sin(), z)
    }

    /// One of `choices`.
    pub(crate) fn one_of<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[(self.within(0.0, choices.len() as f64) as usize).min(choices.len() - 1)]
    }
}

/// A direction that turns about an axis at a constant rate, at a length that oscillates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Motion {
    start: Vector3<f64>,
    axis: Vector3<f64>,
    rate_rad_s: f64,
}

impl Motion {
    /// At 1e-5 to 1e-3 rad/s.
    pub(crate) fn random(random: &mut Random) -> Self {
        let (start, axis) = (random.direction(), random.direction());
        Self { start, axis, rate_rad_s: 10_f64.powf(random.within(-5.0, -3.0)) }
    }

    /// The vector and its rate at `time_s`.
    pub(crate) fn at(&self, time_s: f64) -> MovingVector {
        let angle_rad = self.rate_rad_s * time_s;
        let turn = nalgebra::Rotation3::from_scaled_axis(self.axis * angle_rad);
        let length = 2.0 + (0.7 * angle_rad).sin();
        let direction = turn * self.start;
        let slope = self.axis.cross(&direction) * (length * self.rate_rad_s);
        moving(direction * length, slope + direction * (0.7 * self.rate_rad_s * (0.7 * angle_rad).cos()))
    }
}

/// Body rate by a fourth-order difference of the attitude `at` times `step_s` apart; `None` where one is `None`.
pub(crate) fn difference_rad_s(at: impl Fn(f64) -> Option<Pointing>, step_s: f64) -> Option<Vector3<f64>> {
    let matrix = |k: f64| at(k * step_s).map(|pointing| matrix_value(&pointing.inertial_from_body));
    let slope: Matrix3<f64> =
        (matrix(-2.0)? - matrix(2.0)? + (matrix(1.0)? - matrix(-1.0)?) * 8.0) / (12.0 * step_s);
    let skew = matrix(0.0)?.transpose() * slope;
    Some(Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]))
}

/// The 26 directions from the centre of a cube to its faces, edges and corners.
pub(crate) fn cube_directions() -> impl Iterator<Item = Vector3<f64>> {
    (0..27)
        .filter(|k| *k != 13)
        .map(|k| Vector3::new(f64::from(k % 3) - 1.0, f64::from(k / 3 % 3) - 1.0, f64::from(k / 9) - 1.0))
}
