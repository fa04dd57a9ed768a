//! Vectors with their time derivative: every guidance law gives its rate exactly because its inputs carry theirs.
//!
//! A moving number is a dual number whose derivative is the one by time, in 1/s; a law written in moving vectors is the
//! law and its derivative at once. A law that iterates ends with one Newton step in moving numbers, which is implicit
//! differentiation.

use nalgebra::{ComplexField, Matrix3, Rotation3, Vector3};

use crate::environment::CartesianState;
use crate::math;
use crate::numerics::scalar::{Dual64, sin_cos};

/// A number and its time derivative.
pub type Moving = Dual64;

/// A vector and its time derivative.
pub type MovingVector = Vector3<Moving>;

/// A matrix and its time derivative.
pub type MovingMatrix = Matrix3<Moving>;

/// Two directions closer than this to parallel span no plane, in rad.
pub const PARALLEL_RAD: f64 = 1e-9;

/// The vector `value` that changes by `rate` per second.
pub fn moving(value: Vector3<f64>, rate: Vector3<f64>) -> MovingVector {
    value.zip_map(&rate, Moving::new)
}

/// A vector that stays.
pub fn fixed(value: Vector3<f64>) -> MovingVector {
    value.map(Moving::from_re)
}

/// The vector at this time.
pub fn value(vector: &MovingVector) -> Vector3<f64> {
    vector.map(|x| x.re)
}

/// Its time derivative.
pub fn rate(vector: &MovingVector) -> Vector3<f64> {
    vector.map(|x| x.eps)
}

/// A position with its rate as a state.
pub fn state(position: &MovingVector) -> CartesianState {
    CartesianState { position_m: value(position), velocity_m_s: rate(position) }
}

/// The matrix at this time.
pub fn matrix_value(matrix: &MovingMatrix) -> Matrix3<f64> {
    matrix.map(|x| x.re)
}

/// Unit vector along `vector`; `None` where it has no direction: zero, or not finite.
pub fn unit(vector: &MovingVector) -> Option<MovingVector> {
    let largest = value(vector).amax();
    if !(largest.is_finite() && largest > 0.0) {
        return None;
    }
    let scaled = vector / Moving::from_re(largest);
    Some(scaled / scaled.dot(&scaled).sqrt())
}

/// Unit vector along `a` x `b`; `None` where they are within [`PARALLEL_RAD`] of parallel or one has no direction.
pub fn unit_normal(a: &MovingVector, b: &MovingVector) -> Option<MovingVector> {
    normal_of_units(&unit(a)?, &unit(b)?)
}

/// The same of two unit vectors.
pub fn normal_of_units(a: &MovingVector, b: &MovingVector) -> Option<MovingVector> {
    let normal = a.cross(b);
    (value(&normal).norm() > PARALLEL_RAD).then(|| unit(&normal)).flatten()
}

/// Body-frame unit vector of azimuth and elevation in rad, as [`crate::attitude::direction_from_angles`].
pub fn direction(azimuth: Moving, elevation: Moving) -> MovingVector {
    let (sin_a, cos_a) = sin_cos(azimuth);
    let (sin_e, cos_e) = sin_cos(elevation);
    MovingVector::new(cos_e * sin_a, -cos_e * cos_a, -sin_e)
}

/// Unit vector of a longitude about z from x, and a latitude above the x-y plane: right ascension and declination as well.
pub fn spherical(longitude_rad: f64, latitude_rad: f64) -> Vector3<f64> {
    let (sin_lon, cos_lon) = math::sin_cos(longitude_rad);
    let (sin_lat, cos_lat) = math::sin_cos(latitude_rad);
    Vector3::new(cos_lat * cos_lon, cos_lat * sin_lon, sin_lat)
}

/// Rotation by `angle_rad` about the axis `0` x, `1` y or `2` z, right-handed.
pub fn rotation_about(axis: usize, angle_rad: Moving) -> MovingMatrix {
    let (sine, cosine) = sin_cos(angle_rad);
    let (next, last) = ((axis + 1) % 3, (axis + 2) % 3);
    let mut matrix = MovingMatrix::identity();
    matrix[(next, next)] = cosine;
    matrix[(next, last)] = -sine;
    matrix[(last, next)] = sine;
    matrix[(last, last)] = cosine;
    matrix
}

/// Angular rate of a frame whose axes are the columns of `axes`, in components along these axes, in rad/s.
pub fn angular_rate_rad_s(axes: &MovingMatrix) -> Vector3<f64> {
    let [x, y, z] = [0, 1, 2].map(|column| axes.column(column).into_owned());
    Vector3::new(rate(&y).dot(&value(&z)), rate(&z).dot(&value(&x)), rate(&x).dot(&value(&y)))
}

/// The rotation whose columns are these axes now.
pub fn rotation_value(axes: &MovingMatrix) -> Rotation3<f64> {
    Rotation3::from_matrix_unchecked(matrix_value(axes))
}
