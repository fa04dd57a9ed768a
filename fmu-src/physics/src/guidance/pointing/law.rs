//! The attitude law of paper 001: four vectors to attitude and rate (eqs 1 to 16).
//!
//! A aims the boresight B, E places the body roll vector R in the half plane of A and E. Both pairs span a "prime" frame:
//! x along A (or B), z along A x E (or B x R). The attitude is C_B/I = C_B/P C_I/P^T. The paper's rates (eqs 8 to 13) are
//! components along the prime axes; the rate in body axes is C_B/P (omega_P/I - omega_P/B), which the sentence behind
//! eq 16 has otherwise.
//!
//! Degenerate geometry: where E lies along A it gives way to the north of EME2000, then to the equinox; where R lies along
//! B, to -Y, then to +Z. Where A or B has no direction there is no command. Both are said by [`Pointing::degenerate`].

use nalgebra::Vector3;

use crate::attitude::MovingFrame;
use crate::guidance::geometry::moving::{
    Moving, MovingMatrix, MovingVector, angular_rate_rad_s, fixed, normal_of_units, rotation_value, unit,
};
use crate::numerics::scalar::sin_cos;

/// Vectors that paper 001 aims: two vectors in the body frame, two in EME2000, of any length, with their rates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointingVectors {
    /// B: the body axis that points at the aimpoint.
    pub boresight_body: MovingVector,
    /// A: from the spacecraft to the aimpoint, EME2000.
    pub aimpoint: MovingVector,
    /// R: the body axis that is rolled toward the external roll reference.
    pub body_roll: MovingVector,
    /// E: the external roll reference, EME2000.
    pub external_roll: MovingVector,
}

/// A commanded attitude with its rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pointing {
    /// Body axes as columns in EME2000, with their derivatives.
    pub inertial_from_body: MovingMatrix,
    /// Whether a fallback stands in for a roll vector.
    pub degenerate: bool,
}

impl PointingVectors {
    /// Attitude and rate; `None` where boresight or aimpoint has no direction.
    pub fn pointing(&self) -> Option<Pointing> {
        const INERTIAL: [Vector3<f64>; 2] = [Vector3::new(0.0, 0.0, 1.0), Vector3::new(1.0, 0.0, 0.0)];
        const BODY: [Vector3<f64>; 2] = [Vector3::new(0.0, -1.0, 0.0), Vector3::new(0.0, 0.0, 1.0)];
        let (inertial_from_prime, no_reference) = prime_axes(&self.aimpoint, &self.external_roll, &INERTIAL)?;
        let (body_from_prime, no_roll) = prime_axes(&self.boresight_body, &self.body_roll, &BODY)?;
        Some(Pointing {
            inertial_from_body: inertial_from_prime * body_from_prime.transpose(),
            degenerate: no_reference || no_roll,
        })
    }
}

impl Pointing {
    /// Attitude and rate of a body frame in motion.
    pub fn from_frame(frame: &MovingFrame) -> Self {
        let axes = frame.inertial_from_body.matrix();
        let rates = axes * frame.rate_body_rad_s.cross_matrix();
        Self { inertial_from_body: axes.zip_map(&rates, Moving::new), degenerate: false }
    }

    /// Vectors that give this attitude: +Z at where it looks, -Y rolled to where it is.
    pub fn vectors(&self) -> PointingVectors {
        PointingVectors {
            boresight_body: fixed(Vector3::z()),
            aimpoint: self.inertial_from_body.column(2).into_owned(),
            body_roll: fixed(-Vector3::y()),
            external_roll: -self.inertial_from_body.column(1),
        }
    }

    /// Body frame and rate.
    pub fn frame(&self) -> MovingFrame {
        MovingFrame {
            inertial_from_body: rotation_value(&self.inertial_from_body),
            rate_body_rad_s: angular_rate_rad_s(&self.inertial_from_body),
        }
    }

    /// Components in the body frame of a vector given in EME2000.
    pub fn to_body(&self, inertial: &MovingVector) -> MovingVector {
        self.inertial_from_body.tr_mul(inertial)
    }

    /// The attitude turned by `angle_rad` about the unit vector `axis_body`, both of them moving.
    pub fn turned(&self, axis_body: &MovingVector, angle_rad: Moving) -> Self {
        let (sine, cosine) = sin_cos(angle_rad);
        let cross = axis_body.cross_matrix();
        let turn = MovingMatrix::identity() + cross * sine + cross * cross * (Moving::from_re(1.0) - cosine);
        Self { inertial_from_body: self.inertial_from_body * turn, ..*self }
    }
}

/// Prime axes as columns (eqs 1 to 3, 4 to 6), and whether a fallback stands in for `secondary`.
fn prime_axes(
    primary: &MovingVector,
    secondary: &MovingVector,
    fallbacks: &[Vector3<f64>; 2],
) -> Option<(MovingMatrix, bool)> {
    let x = unit(primary)?;
    let normal = |other: &MovingVector| normal_of_units(&x, &unit(other)?);
    let given = normal(secondary);
    let z = given.or_else(|| fallbacks.iter().find_map(|other| normal(&fixed(*other))))?;
    // The less both vectors differ, the less their normal is perpendicular to x.
    let z = unit(&(z - x * x.dot(&z)))?;
    Some((MovingMatrix::from_columns(&[x, z.cross(&x), z]), given.is_none()))
}

#[cfg(test)]
mod tests;
