//! Frames built from moving directions, with their angular rate in closed form.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use crate::math;

/// A unit vector and its time derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingUnit {
    /// Unit vector.
    pub direction: Vector3<f64>,
    /// Its derivative, in 1/s; perpendicular to it.
    pub rate_1_s: Vector3<f64>,
}

impl MovingUnit {
    /// Direction of `vector`, which changes by `rate` per second; `None` where it has no direction.
    pub fn from_vector(vector: Vector3<f64>, rate: Vector3<f64>) -> Option<Self> {
        let length = vector.norm();
        if !(length.is_finite() && length > 0.0) {
            return None;
        }
        let direction = vector / length;
        Some(Self { direction, rate_1_s: (rate - direction * direction.dot(&rate)) / length })
    }

    /// Direction of the part of `other` perpendicular to this one, and the angle between the two with its rate.
    ///
    /// `None` when the two are within 1e-9 rad of parallel: the part has no direction then.
    pub fn perpendicular_part(&self, other: &Self) -> Option<(Self, f64, f64)> {
        let cosine = self.direction.dot(&other.direction);
        let part = other.direction - self.direction * cosine;
        let sine = part.norm();
        if sine.is_nan() || sine < 1e-9 {
            return None;
        }
        let cosine_rate = self.rate_1_s.dot(&other.direction) + self.direction.dot(&other.rate_1_s);
        let part_rate = other.rate_1_s - self.rate_1_s * cosine - self.direction * cosine_rate;
        Some((Self::from_vector(part, part_rate)?, math::atan2(sine, cosine), -cosine_rate / sine))
    }
}

/// A body frame in motion: its axes in the inertial frame and its angular rate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingFrame {
    /// Matrix whose columns are the body axes in inertial components.
    pub inertial_from_body: Rotation3<f64>,
    /// Angular rate of the body in the inertial frame, body components, in rad/s.
    pub rate_body_rad_s: Vector3<f64>,
}

impl MovingFrame {
    /// Frame with X = `y` x `z` from two perpendicular moving axes.
    pub fn from_yz(y: &MovingUnit, z: &MovingUnit) -> Self {
        let x = y.direction.cross(&z.direction);
        let x_rate = y.rate_1_s.cross(&z.direction) + y.direction.cross(&z.rate_1_s);
        let axes = Matrix3::from_columns(&[x, y.direction, z.direction]);
        let rate_x_rad_s = y.rate_1_s.dot(&z.direction);
        let rate_body_rad_s = Vector3::new(rate_x_rad_s, z.rate_1_s.dot(&x), x_rate.dot(&y.direction));
        Self { inertial_from_body: Rotation3::from_matrix_unchecked(axes), rate_body_rad_s }
    }

    /// The frame turned about its own X axis by `angle_rad`, which changes by `angle_rate_rad_s`.
    pub fn pitched(&self, angle_rad: f64, angle_rate_rad_s: f64) -> Self {
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), angle_rad);
        Self {
            inertial_from_body: self.inertial_from_body * turn,
            rate_body_rad_s: turn.inverse() * self.rate_body_rad_s + Vector3::x() * angle_rate_rad_s,
        }
    }

    /// The frame turned by 180 deg about a direction of space, which keeps its place in the body: the turn 2 s s' - 1 goes at
    /// 2 s x ds/dt.
    pub fn half_turned(&self, about: &MovingUnit) -> Self {
        let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(about.direction), core::f64::consts::PI);
        let turning = about.direction.cross(&about.rate_1_s) * 2.0;
        Self {
            inertial_from_body: turn * self.inertial_from_body,
            rate_body_rad_s: self.rate_body_rad_s - self.inertial_from_body.inverse() * turning,
        }
    }

    /// The frame turned by `angle_body_rad * fraction` (a fixed vector, in its own components), where `fraction`
    /// changes by `fraction_rate_1_s`.
    pub fn offset(&self, angle_body_rad: &Vector3<f64>, fraction: f64, fraction_rate_1_s: f64) -> Self {
        let turn = Rotation3::from_scaled_axis(angle_body_rad * fraction);
        Self {
            inertial_from_body: self.inertial_from_body * turn,
            rate_body_rad_s: turn.inverse() * self.rate_body_rad_s + angle_body_rad * fraction_rate_1_s,
        }
    }
}

#[cfg(test)]
mod tests {
    //! The rate of a frame is the numerical derivative of its axes.
    use super::*;
    use approx::assert_relative_eq;

    fn vectors(t: f64) -> [(Vector3<f64>, Vector3<f64>); 2] {
        [
            (Vector3::new(t.cos(), t.sin(), 0.3 * t), Vector3::new(-t.sin(), t.cos(), 0.3)),
            (Vector3::new(1.0 + t, -t * t, 2.0), Vector3::new(1.0, -2.0 * t, 0.0)),
        ]
    }

    fn frame(t: f64) -> MovingFrame {
        let [a, b] = vectors(t);
        let y = MovingUnit::from_vector(a.0, a.1).unwrap();
        let z = y.perpendicular_part(&MovingUnit::from_vector(b.0, b.1).unwrap()).unwrap().0;
        MovingFrame::from_yz(&y, &z).pitched(0.2 * t, 0.2).offset(
            &Vector3::new(0.1, -0.2, 0.3),
            1.0 - t,
            -1.0,
        )
    }

    #[test]
    fn rate_is_the_derivative_of_the_axes() {
        let (t, dt) = (0.4, 1e-6);
        let derivative = (frame(t + dt).inertial_from_body.matrix()
            - frame(t - dt).inertial_from_body.matrix())
            / (2.0 * dt);
        let skew = frame(t).inertial_from_body.matrix().transpose() * derivative;
        let rate = Vector3::new(skew[(2, 1)], skew[(0, 2)], skew[(1, 0)]);
        assert_relative_eq!(rate, frame(t).rate_body_rad_s, epsilon = 1e-8);
    }

    #[test]
    fn angle_between_and_its_rate() {
        let angle = |t: f64| {
            let [a, b] = vectors(t);
            let y = MovingUnit::from_vector(a.0, a.1).unwrap();
            let (_, angle, rate) = y.perpendicular_part(&MovingUnit::from_vector(b.0, b.1).unwrap()).unwrap();
            (angle, rate)
        };
        let (t, dt) = (0.7, 1e-6);
        assert_relative_eq!((angle(t + dt).0 - angle(t - dt).0) / (2.0 * dt), angle(t).1, epsilon = 1e-8);
        let [a, b] = vectors(t);
        assert_relative_eq!(angle(t).0, a.0.angle(&b.0), epsilon = 1e-14);
    }

    #[test]
    fn parallel_directions_have_no_perpendicular_part() {
        let x = MovingUnit::from_vector(Vector3::x(), Vector3::y()).unwrap();
        assert!(
            x.perpendicular_part(&MovingUnit::from_vector(-Vector3::x(), Vector3::zeros()).unwrap())
                .is_none()
        );
        assert!(MovingUnit::from_vector(Vector3::zeros(), Vector3::x()).is_none());
    }
}
