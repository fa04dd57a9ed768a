//! Vectors of three components in the body frame.

/// Components in the body frame.
pub type Vector = [f64; 3];

pub fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// `a + factor b`.
pub fn along(a: Vector, factor: f64, b: Vector) -> Vector {
    std::array::from_fn(|i| a[i] + factor * b[i])
}

pub fn unit(a: Vector) -> Option<Vector> {
    let length = dot(a, a).sqrt();
    (length.is_finite() && length > 1e-9).then(|| a.map(|x| x / length))
}

/// A vector turned about a unit axis, right-handed (Rodrigues).
pub fn turned(a: Vector, axis: Vector, angle_rad: f64) -> Vector {
    let (sine, cosine) = angle_rad.sin_cos();
    let (across, part) = (cross(axis, a), dot(axis, a) * (1.0 - cosine));
    std::array::from_fn(|i| a[i] * cosine + across[i] * sine + axis[i] * part)
}
