//! The attitude law of paper 001: four vectors to attitude and rate (eqs 1 to 16).
//!
//! A aims the boresight B, E places the body roll vector R in the half plane of A and E. Both pairs span a "prime" frame:
//! x along A (or B), z along A x E (or B x R). The attitude is C_B/I = C_B/P C_I/P^T. The paper's rates (eqs 8 to 13) are
//! components along the prime axes; the rate in body axes is C_B/P (omega_P/I - omega_P/B), which the sentence behind
//! eq 16 has otherwise.
//!
//! Degenerate geometry: where E lies along A it gives way to the north of EME2000, then to the equinox; where R lies along
//! B, to -Y, then to +Z. Where A or B has no direction there is no command. Both are said by [`Pointing::degenerate`].

use nalgebra::{ComplexField, Vector3};

use crate::attitude::MovingFrame;
use crate::guidance::geometry::moving::{
    Moving, MovingMatrix, MovingVector, angular_rate_rad_s, fixed, normal_of_units, rotation_value, unit,
};

/// What paper 001 aims: two vectors in the body frame, two in EME2000, of any length, with their rates.
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
    /// Of a body frame in motion.
    pub fn of(frame: &MovingFrame) -> Self {
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
        let (sine, cosine) = angle_rad.sin_cos();
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
mod tests {
    //! Against eqs 8 to 16 as printed and corrected, against differences of the attitude, and in degenerate geometry.
    use super::*;
    use crate::guidance::geometry::moving::{matrix_value, moving, rate, value};
    use approx::assert_relative_eq;
    use nalgebra::Matrix3;

    fn vectors(t: f64) -> PointingVectors {
        let at = |k: f64| {
            let (s, c) = (k * t + k).sin_cos();
            moving(
                Vector3::new(2.0 + s, c * k, 0.5 - s * c),
                Vector3::new(k * c, -s * k * k, -k * (c * c - s * s)),
            )
        };
        PointingVectors {
            boresight_body: at(0.3),
            aimpoint: at(1.1) * Moving::from_re(1e9),
            body_roll: at(-0.8),
            external_roll: at(2.3),
        }
    }

    /// Eqs 8 to 10, and 11 to 13: components along the prime axes.
    fn printed_rate(a: &MovingVector, e: &MovingVector) -> Vector3<f64> {
        let (a, a_dot, e, e_dot) = (value(a), rate(a), value(e), rate(e));
        let normal = a.cross(&e);
        let across = normal.cross(&a);
        let turn = a.cross(&a_dot).cross(&a);
        Vector3::new(
            -across.dot(&(a.cross(&e_dot) + a_dot.cross(&e))) / (normal.norm_squared() * a.norm()),
            -normal.dot(&turn) / (normal.norm() * a.norm().powi(3)),
            across.dot(&turn) / (normal.norm() * a.norm().powi(4)),
        )
    }

    #[test]
    fn the_rate_is_the_papers_in_prime_axes() {
        for i in 0..100 {
            let vectors = vectors(f64::from(i) * 0.17);
            let frame = vectors.pointing().unwrap().frame();
            let body_from_prime = {
                let x = value(&vectors.boresight_body).normalize();
                let z = x.cross(&value(&vectors.body_roll)).normalize();
                Matrix3::from_columns(&[x, z.cross(&x), z])
            };
            let prime = printed_rate(&vectors.aimpoint, &vectors.external_roll)
                - printed_rate(&vectors.boresight_body, &vectors.body_roll);
            assert_relative_eq!(frame.rate_body_rad_s, body_from_prime * prime, epsilon = 1e-12);
        }
    }

    #[test]
    fn the_rate_is_the_derivative_of_the_attitude() {
        let step = 1e-4;
        let matrix = |t: f64| matrix_value(&vectors(t).pointing().unwrap().inertial_from_body);
        for i in 0..50 {
            let t = f64::from(i) * 0.31;
            let slope = (matrix(t - 2.0 * step) - matrix(t + 2.0 * step)
                + (matrix(t + step) - matrix(t - step)) * 8.0)
                / (12.0 * step);
            let skew = matrix(t).transpose() * slope;
            let expected = Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]);
            let found = vectors(t).pointing().unwrap().frame().rate_body_rad_s;
            assert_relative_eq!(found, expected, epsilon = 1e-9, max_relative = 1e-9);
        }
    }

    #[test]
    fn the_boresight_lies_on_the_aimpoint_and_the_roll_vector_in_its_half_plane() {
        for i in 0..100 {
            let vectors = vectors(f64::from(i) * 0.13);
            let to_inertial = vectors.pointing().unwrap().frame().inertial_from_body;
            let boresight = to_inertial * value(&vectors.boresight_body).normalize();
            let aimpoint = value(&vectors.aimpoint).normalize();
            assert!(boresight.cross(&aimpoint).norm() < 1e-14 && boresight.dot(&aimpoint) > 0.0);
            let roll = to_inertial * value(&vectors.body_roll);
            let external = value(&vectors.external_roll);
            let normal = aimpoint.cross(&external).normalize();
            assert!(
                roll.dot(&normal).abs() < 1e-14 * roll.norm() && aimpoint.cross(&roll).dot(&normal) > 0.0
            );
        }
    }

    #[test]
    fn degenerate_geometry_has_a_fallback_and_no_direction_no_command() {
        let some = vectors(1.0);
        for degenerate in [
            PointingVectors { external_roll: some.aimpoint, ..some },
            PointingVectors { external_roll: MovingVector::zeros(), ..some },
            PointingVectors { body_roll: -some.boresight_body, ..some },
            PointingVectors { aimpoint: fixed(Vector3::z()), external_roll: fixed(Vector3::z()), ..some },
            PointingVectors { boresight_body: fixed(-Vector3::y()), body_roll: fixed(Vector3::y()), ..some },
        ] {
            let pointing = degenerate.pointing().unwrap();
            assert!(pointing.degenerate);
            let matrix = matrix_value(&pointing.inertial_from_body);
            assert_relative_eq!(matrix * matrix.transpose(), Matrix3::identity(), epsilon = 1e-14);
            assert_relative_eq!(matrix.determinant(), 1.0, epsilon = 1e-14);
            assert!(pointing.frame().rate_body_rad_s.iter().all(|x| x.is_finite()));
        }
        assert!(PointingVectors { aimpoint: MovingVector::zeros(), ..some }.pointing().is_none());
        assert!(PointingVectors { boresight_body: MovingVector::zeros(), ..some }.pointing().is_none());
        assert!(!some.pointing().unwrap().degenerate);
    }
}
