//! Masses that turn on hinges: what they do to inertia and momentum of the whole, as Taylor series in time.
//!
//! Equations, for a mass m with its centre at r, which turns at the rate f' about the axis a through a hinge: r' = f' a x
//! (r - hinge), J_p = R J_p0 R^T; r_c the centre of mass of the whole, which moves with it. J = sum of J_p + m [r] - M [r_c]
//! with [r] = r.r 1 - r r^T, and the momentum relative to the body about r_c, h = sum of J_p a f' + m (r - r_c) x r', in
//! which the motion of r_c itself cancels. Then H = J w + h.
//! Method: the angle is quadratic in time; the series of cos f and sin f follow from f', products are Cauchy's.
//! Order: that of the motion's series.
//! Reference: Hughes, Spacecraft Attitude Dynamics, 3.4 (a system of rigid bodies).

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::series::{TERMS, polynomial};

use crate::math;

/// A mass that turns on a hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HingedMass {
    /// Mass in kg.
    pub mass_kg: f64,
    /// Unit vector of the hinge's axis, body frame.
    pub axis_body: Vector3<f64>,
    /// A point of that axis, body frame, in m.
    pub hinge_body_m: Vector3<f64>,
    /// Centre of the mass at angle 0, from that point, body frame, in m.
    pub arm_body_m: Vector3<f64>,
    /// Inertia about its own centre at angle 0, body frame, in kg m2.
    pub inertia_body_kg_m2: Matrix3<f64>,
    /// Angle about the axis, in rad.
    pub angle_rad: f64,
    /// Its rate, in rad/s.
    pub rate_rad_s: f64,
    /// The rate's change, in rad/s2.
    pub acceleration_rad_s2: f64,
}

impl HingedMass {
    /// Momentum relative to the body about the centre of mass of the whole, body frame, in N m s.
    pub fn momentum_body_n_m_s(&self, center_of_mass_body_m: &Vector3<f64>) -> Vector3<f64> {
        let [along, cosine, sine] = self.arm_parts();
        let (sin, cos) = math::sin_cos(self.angle_rad);
        let arm = along + cosine * cos + sine * sin;
        let from_center = self.hinge_body_m + arm - center_of_mass_body_m;
        let [still, c, s, c2, s2] = self.inertia_parts();
        let (sin2, cos2) = math::sin_cos(2.0 * self.angle_rad);
        let own = (still + c * cos + s * sin + c2 * cos2 + s2 * sin2) * self.axis_body;
        (own + from_center.cross(&self.axis_body.cross(&arm)) * self.mass_kg) * self.rate_rad_s
    }

    /// The arm is the first plus cos f times the second plus sin f times the third.
    fn arm_parts(&self) -> [Vector3<f64>; 3] {
        let along = self.axis_body * self.axis_body.dot(&self.arm_body_m);
        [along, self.arm_body_m - along, self.axis_body.cross(&self.arm_body_m)]
    }

    /// The inertia is the first plus cos f, sin f, cos 2f, sin 2f times the others.
    fn inertia_parts(&self) -> [Matrix3<f64>; 5] {
        let along = self.axis_body * self.axis_body.transpose();
        let (across, turned) = (Matrix3::identity() - along, self.axis_body.cross_matrix());
        let between = |a: &Matrix3<f64>, b: &Matrix3<f64>| a * self.inertia_body_kg_m2 * b.transpose();
        let mixed = |b: &Matrix3<f64>| between(&along, b) + between(b, &along);
        let (cos_cos, sin_sin) = (between(&across, &across), between(&turned, &turned));
        let cos_sin = between(&across, &turned) + between(&turned, &across);
        [
            between(&along, &along) + (cos_cos + sin_sin) * 0.5,
            mixed(&across),
            mixed(&turned),
            (cos_cos - sin_sin) * 0.5,
            cos_sin * 0.5,
        ]
    }

    /// Series of the cosine and sine of `times` the angle.
    fn cosine_and_sine(&self, times: f64) -> [[f64; TERMS]; 2] {
        let (sin, cos) = math::sin_cos(times * self.angle_rad);
        let [rate, acceleration] = [self.rate_rad_s, self.acceleration_rad_s2].map(|it| times * it);
        let (mut cosine, mut sine) = ([0.0; TERMS], [0.0; TERMS]);
        (cosine[0], sine[0]) = (cos, sin);
        for j in 0..TERMS - 1 {
            let turned = |series: &[f64; TERMS]| {
                let before = j.checked_sub(1).map_or(0.0, |i| series[i]);
                (series[j] * rate + before * acceleration) / (j + 1) as f64
            };
            (cosine[j + 1], sine[j + 1]) = (-turned(&sine), turned(&cosine));
        }
        [cosine, sine]
    }
}

/// Inertia and momentum relative to the body of all masses that turn, as series from a segment's start on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct InternalMotion {
    /// Terms of the inertia of the whole in kg m2; the first one is the gyrostat's own and not kept.
    inertia: [Matrix3<f64>; TERMS],
    /// Terms of the momentum in N m s.
    momentum: [Vector3<f64>; TERMS],
}

impl InternalMotion {
    /// Motion of these masses in a whole of `whole_kg` with this centre of mass.
    pub fn new(
        masses: impl Iterator<Item = HingedMass> + Clone,
        whole_kg: f64,
        center_of_mass_body_m: &Vector3<f64>,
    ) -> Self {
        let mut center = [Vector3::zeros(); TERMS];
        center[0] = *center_of_mass_body_m;
        for mass in masses.clone() {
            for (center, place) in center.iter_mut().zip(places(&mass)).skip(1) {
                *center += place * (mass.mass_kg / whole_kg);
            }
        }
        let (mut inertia, mut momentum) = ([Matrix3::zeros(); TERMS], [Vector3::zeros(); TERMS]);
        for mass in masses {
            let place = places(&mass);
            let [cosine, sine] = mass.cosine_and_sine(1.0);
            let [cosine_2, sine_2] = mass.cosine_and_sine(2.0);
            let [still, c, s, c2, s2] = mass.inertia_parts();
            let mut before = Matrix3::zeros();
            for j in 0..TERMS {
                let mut own = c * cosine[j] + s * sine[j] + c2 * cosine_2[j] + s2 * sine_2[j];
                if j == 0 {
                    own += still;
                }
                inertia[j] += own + steiner_term(&place, j) * mass.mass_kg;
                let turned = own * mass.rate_rad_s + before * mass.acceleration_rad_s2;
                momentum[j] += turned * mass.axis_body;
                before = own;
                for i in 0..=j {
                    let next = j - i + 1;
                    let velocity = place.get(next).map_or(Vector3::zeros(), |term| term * next as f64);
                    momentum[j] += (place[i] - center[i]).cross(&velocity) * mass.mass_kg;
                }
            }
        }
        for (j, inertia) in inertia.iter_mut().enumerate() {
            *inertia -= steiner_term(&center, j) * whole_kg;
        }
        Self { inertia, momentum }
    }

    /// Term `j` of what the momentum of the whole has besides the present inertia times the rate's term `j`.
    pub(super) fn carried_term(&self, rate: &[Vector3<f64>; TERMS], j: usize) -> Vector3<f64> {
        (1..=j).fold(self.momentum[j], |sum, i| sum + self.inertia[i] * rate[j - i])
    }

    /// Momentum relative to the body after `elapsed_s`, in N m s.
    pub(super) fn momentum_after(&self, elapsed_s: f64) -> Vector3<f64> {
        polynomial(&self.momentum, elapsed_s)
    }

    /// Change of the inertia after `elapsed_s`, in kg m2.
    pub(super) fn inertia_change_after(&self, elapsed_s: f64) -> Matrix3<f64> {
        polynomial(&self.inertia[1..], elapsed_s) * elapsed_s
    }
}

/// Series of the place of a mass, body frame, in m.
fn places(mass: &HingedMass) -> [Vector3<f64>; TERMS] {
    let [along, across, turned] = mass.arm_parts();
    let [cosine, sine] = mass.cosine_and_sine(1.0);
    let mut places: [Vector3<f64>; TERMS] = core::array::from_fn(|j| across * cosine[j] + turned * sine[j]);
    places[0] += mass.hinge_body_m + along;
    places
}

/// Term `j` of r.r 1 - r r^T.
fn steiner_term(place: &[Vector3<f64>; TERMS], j: usize) -> Matrix3<f64> {
    (0..=j).fold(Matrix3::zeros(), |sum, i| {
        let (a, b) = (&place[i], &place[j - i]);
        sum + Matrix3::from_diagonal_element(a.dot(b)) - a * b.transpose()
    })
}
