//! Mass of panels that turn: centre of mass and inertia of the whole as they do.
//!
//! Equations: r_c' = r_c + sum m_p / M (r_p' - r_p); J' = J_O' - M [r_c'], with J_O' = J + M [r_c] + sum over the panels of
//! (J_p' + m_p [r_p']) - (J_p + m_p [r_p]) about the origin and [r] = r.r 1 - r r^T (Steiner). The mass properties of the
//! spacecraft are those with every panel at angle 0. What a panel has of momentum by turning against
//! the body is [`HingedMass`]'s.

use nalgebra::{Rotation3, Unit};

use super::mass::{MassProperties, steiner};
use super::panel::Panel;
use crate::attitude::HingedMass;

/// Mass properties of a spacecraft that has `at_zero` with every panel at angle 0, with the panels at these angles (by index,
/// in rad).
pub fn with_panels(
    at_zero: &MassProperties,
    panels: &[Panel],
    angle_rad: impl Fn(usize) -> f64,
) -> MassProperties {
    let mass_kg = at_zero.mass_kg;
    let mut moment_kg_m = at_zero.center_of_mass_body_m * mass_kg;
    let mut about_origin_kg_m2 =
        at_zero.inertia_body_kg_m2 + steiner(&at_zero.center_of_mass_body_m) * mass_kg;
    let mut has_mass = false;
    for (index, panel) in panels.iter().enumerate() {
        let Some(mass) = &panel.mass else { continue };
        has_mass = true;
        let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(panel.axis_body), angle_rad(index));
        let center_body_m = panel.center_body_m + turn * (mass.center_body_m - panel.center_body_m);
        let inertia = turn.matrix() * mass.inertia_body_kg_m2 * turn.matrix().transpose();
        moment_kg_m += (center_body_m - mass.center_body_m) * mass.mass_kg;
        about_origin_kg_m2 += inertia - mass.inertia_body_kg_m2
            + (steiner(&center_body_m) - steiner(&mass.center_body_m)) * mass.mass_kg;
    }
    if !has_mass {
        return *at_zero;
    }
    let center_of_mass_body_m = moment_kg_m / mass_kg;
    MassProperties {
        mass_kg,
        center_of_mass_body_m,
        inertia_body_kg_m2: about_origin_kg_m2 - steiner(&center_of_mass_body_m) * mass_kg,
    }
}

/// The panels that have a mass, turning at these angles in rad, rates in rad/s and accelerations in rad/s2 (by index).
pub fn hinged_masses(
    panels: &[Panel],
    turn: impl Fn(usize) -> [f64; 3] + Clone,
) -> impl Iterator<Item = HingedMass> + Clone {
    panels.iter().enumerate().filter_map(move |(index, panel)| {
        let mass = panel.mass.as_ref()?;
        let [angle_rad, rate_rad_s, acceleration_rad_s2] = turn(index);
        Some(HingedMass {
            mass_kg: mass.mass_kg,
            axis_body: panel.axis_body,
            hinge_body_m: panel.center_body_m,
            arm_body_m: mass.center_body_m - panel.center_body_m,
            inertia_body_kg_m2: mass.inertia_body_kg_m2,
            angle_rad,
            rate_rad_s,
            acceleration_rad_s2,
        })
    })
}

#[cfg(test)]
mod tests;
