//! Sunlight on the outside of a cylindrical section in closed form (paper 000, eqs 4-5, re-derived), clipped exactly
//! where the Sun lights it in part.
//!
//! In the shade frame the outward normal at angle theta from -Y is n = [sin theta, -cos theta, 0] and the surface
//! r = R n + z Z. With c = n.s, the light a strip receives, force and torque need only int c, int c n and int c^2 n over the
//! lit angles; terms odd in z vanish.

use core::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Matrix3, Vector3};

use super::flat_plate::Beam;
use crate::loads::ForceTorque;
use crate::math;
use crate::numerics::scalar::Scalar;
use crate::spacecraft::{Cylinder, Optics};

const THIRD: f64 = 1.0 / 3.0;

/// A cylindrical section with its orientation in the body.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct CylinderFace {
    pub cylinder: Cylinder,
    /// Place of its material among those of the faces.
    pub material: usize,
    pub dcm_body_from_shade: Matrix3<f64>,
}

impl CylinderFace {
    /// Force, and torque about the body frame's origin.
    pub(super) fn force_torque_about_origin<T: Scalar>(
        &self,
        optics: &Optics<T>,
        beam: &Beam<T>,
    ) -> ForceTorque<T> {
        let rotation = self.dcm_body_from_shade.map(T::constant);
        let beam_shade = Beam { source_body: rotation.transpose() * beam.source_body, ..*beam };
        let shade = cylinder_force_torque(&self.cylinder, optics, &beam_shade);
        ForceTorque {
            force_body_n: rotation * shade.force_body_n,
            torque_body_n_m: rotation * shade.torque_body_n_m,
        }
    }
}

/// How much of the section's angle a Sun in this direction (shade frame) lights, in rad.
pub fn lit_angle_rad(cylinder: &Cylinder, sun_shade: &Vector3<f64>) -> f64 {
    let arcs = lit_arcs::<f64>(cylinder.half_angle_rad, sun_shade);
    arcs.iter().flatten().map(|[from, to]| to.angle_rad - from.angle_rad).sum()
}

/// Force and torque about the shade frame's origin, both in the shade frame, as is the beam, of an outside of these optics.
pub fn cylinder_force_torque<T: Scalar>(
    cylinder: &Cylinder,
    optics: &Optics<T>,
    beam: &Beam<T>,
) -> ForceTorque<T> {
    let sun = &beam.source_body;
    let mut light = T::constant(0.0);
    let [mut light_normal, mut light_squared_normal] = [Vector3::zeros(); 2];
    for [from, to] in lit_arcs(cylinder.half_angle_rad, sun).iter().flatten() {
        let arc = Moments::over(from, to, sun);
        light += arc.light;
        light_normal += arc.light_normal;
        light_squared_normal += arc.light_squared_normal;
    }
    // P times the area of a strip of one radian.
    let strip_n = beam.pressure_pa * (cylinder.radius_m * cylinder.height_m);
    let along_light = light * (optics.absorptivity + optics.diffuse);
    let along_normal =
        light_normal * (optics.diffuse * (2.0 / 3.0)) + light_squared_normal * (optics.specular * 2.0);
    let moment = light_normal.cross(sun) * ((optics.absorptivity + optics.diffuse) * cylinder.radius_m);
    ForceTorque {
        force_body_n: -(sun * along_light + along_normal) * strip_n,
        torque_body_n_m: -moment * strip_n,
    }
}

/// End of a lit arc.
#[derive(Clone, Copy)]
struct ArcEnd<T: Scalar> {
    /// From -Y, in rad.
    angle_rad: T,
    sin: T,
    cos: T,
}

/// The lit arcs within +-`half_angle` of -Y: the Sun lights the half turn about its own azimuth, which a section of
/// more than half a turn can meet twice.
fn lit_arcs<T: Scalar>(half_angle_rad: f64, sun: &Vector3<T>) -> [Option<[ArcEnd<T>; 2]>; 3] {
    if sun.x.value() == 0.0 && sun.y.value() == 0.0 {
        return [None; 3];
    }
    let azimuth = T::polar_angle(sun.x, -sun.y);
    let across = (sun.x * sun.x + sun.y * sun.y).sqrt();
    let (sin, cos) = (sun.x / across, -sun.y / across);
    let (sin_half, cos_half) = math::sin_cos(half_angle_rad);
    // Edge of the section on the side of this sign.
    let edge = |side: f64| ArcEnd {
        angle_rad: T::constant(side * half_angle_rad),
        sin: T::constant(side * sin_half),
        cos: T::constant(cos_half),
    };
    [-TAU, 0.0, TAU].map(|turn| {
        let from = ArcEnd { angle_rad: azimuth + (turn - FRAC_PI_2), sin: -cos, cos: sin };
        let to = ArcEnd { angle_rad: azimuth + (turn + FRAC_PI_2), sin: cos, cos: -sin };
        let from = if from.angle_rad.value() > -half_angle_rad { from } else { edge(-1.0) };
        let to = if to.angle_rad.value() < half_angle_rad { to } else { edge(1.0) };
        (from.angle_rad.value() < to.angle_rad.value()).then_some([from, to])
    })
}

/// Integrals over an arc of angles.
struct Moments<T: Scalar> {
    /// int c dtheta
    light: T,
    /// int c n dtheta
    light_normal: Vector3<T>,
    /// int c^2 n dtheta
    light_squared_normal: Vector3<T>,
}

impl<T: Scalar> Moments<T> {
    fn over(from: &ArcEnd<T>, to: &ArcEnd<T>, sun: &Vector3<T>) -> Self {
        // c = u sin + v cos
        let u = sun.x;
        let v = -sun.y;
        let between = |antiderivative: fn(T, T) -> T| {
            antiderivative(to.sin, to.cos) - antiderivative(from.sin, from.cos)
        };
        let sin = between(|_, c| -c);
        let cos = between(|s, _| s);
        let half = (to.angle_rad - from.angle_rad) * 0.5;
        let sin_sin = half - between(|s, c| s * c * 0.5);
        let sin_cos = between(|s, _| s * s * 0.5);
        let cos_cos = half + between(|s, c| s * c * 0.5);
        let sin_sin_sin = between(|_, c| c * c * c * THIRD - c);
        let sin_sin_cos = between(|s, _| s * s * s * THIRD);
        let sin_cos_cos = between(|_, c| -c * c * c * THIRD);
        let cos_cos_cos = between(|s, _| s - s * s * s * THIRD);
        let zero = T::constant(0.0);
        let normal = |along_sin: T, along_cos: T| Vector3::new(along_sin, -along_cos, zero);
        Self {
            light: u * sin + v * cos,
            light_normal: normal(u * sin_sin + v * sin_cos, u * sin_cos + v * cos_cos),
            light_squared_normal: normal(
                u * u * sin_sin_sin + u * v * sin_sin_cos * 2.0 + v * v * sin_cos_cos,
                u * u * sin_sin_cos + u * v * sin_cos_cos * 2.0 + v * v * cos_cos_cos,
            ),
        }
    }
}
