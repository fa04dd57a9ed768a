//! Torque-free motion of the axisymmetric body in closed form, damper included.
//!
//! With H fixed in inertial space and phi the angle from H to the spin axis, the body axes turn by
//! psi = |H| t / I_T about H, the spin axis closes in on H by phi(0) - phi(t), and the body turns about its own
//! axis by |H| (1/I3 - 1/I_T) times the integral of cos(phi). One evaluation is exact at any distance in time.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::{damper::Damper, series::Anchor};
use crate::attitude::{Inertia, Quaternion};
use crate::math;

/// A torque-free arc of an axisymmetric body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Coast {
    attitude: Quaternion,
    /// Unit vector along H, inertial.
    axis: Vector3<f64>,
    /// Unit vector about which the spin axis moves toward H, inertial.
    node: Vector3<f64>,
    /// Angle from the nearest pole of the spin axis to H.
    angle_rad: f64,
    cosine: f64,
    /// Whether H lies on the side of the positive spin axis.
    upright: bool,
    precession_rad_s: f64,
    /// |H| (1/I3 - 1/I_T): relative spin rate per cos(phi).
    relative_spin_rad_s: f64,
    damper: Damper,
}

impl Coast {
    /// The arc from an anchor whose attitude is that of the principal axes.
    pub fn new(inertia: &Inertia, damper: &Damper, principal: &Anchor) -> Self {
        let Anchor { attitude, momentum_inertial, .. } = *principal;
        let [transverse, _, spin] = inertia.principal_kg_m2();
        let momentum = momentum_inertial.norm();
        let spin_axis = attitude.spin_axis_inertial();
        let axis = if momentum > 0.0 { momentum_inertial / momentum } else { spin_axis };
        let across = spin_axis.cross(&axis);
        let (sine, along) = (across.norm(), spin_axis.dot(&axis));
        let node = if sine > 0.0 { across / sine } else { attitude.inertial_from_body(&Vector3::x()) };
        let angle_rad = math::atan2(sine, along.abs());
        Self {
            attitude,
            axis,
            node,
            angle_rad,
            cosine: math::cos(angle_rad),
            upright: along >= 0.0,
            precession_rad_s: momentum / transverse,
            relative_spin_rad_s: momentum * (spin.recip() - transverse.recip()),
            damper: *damper,
        }
    }

    /// Attitude `dt_s` after the arc's anchor.
    #[inline]
    pub fn attitude_at(&self, dt_s: f64) -> Quaternion {
        let side = if self.upright { 1.0 } else { -1.0 };
        let precession = Quaternion::turn(&self.axis, self.precession_rad_s * dt_s);
        let (moved, cosine_s) = if self.damper.acts() {
            let closing = side * (self.angle_rad - self.damper.angle_after_rad(self.angle_rad, dt_s));
            let moved = Quaternion::turn(&self.node, closing).after(self.attitude);
            (moved, self.damper.cosine_integral_s(self.angle_rad, dt_s))
        } else {
            (self.attitude, self.cosine * dt_s)
        };
        let (sine, cosine) = math::sin_cos(0.5 * side * self.relative_spin_rad_s * cosine_s);
        precession.after(moved).after(Quaternion([0.0, 0.0, sine, cosine]))
    }
}
