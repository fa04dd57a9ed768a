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
mod tests {
    //! Against the same body put together from point masses.
    use approx::assert_relative_eq;
    use nalgebra::{Matrix3, Vector3};

    use super::*;
    use crate::spacecraft::{PanelMass, Spacecraft};

    /// Point masses of a plate 2 m x 1 m, 1 m off the axis along +X, at an angle about it.
    fn plate(angle_rad: f64) -> Vec<(f64, Vector3<f64>)> {
        let turn = Rotation3::from_axis_angle(&Vector3::x_axis(), angle_rad);
        let cells = (0..20).flat_map(|i| (0..10).map(move |j| (f64::from(i), f64::from(j))));
        cells
            .map(|(i, j)| {
                let at = Vector3::new(1.0 + 0.05 + 0.1 * i, 0.0, 0.3 + 0.05 + 0.1 * j);
                (0.1, turn * at)
            })
            .collect()
    }

    fn body() -> Vec<(f64, Vector3<f64>)> {
        let corners = (0..8_u32).map(|k| Vector3::from_fn(|i, _| if k >> i & 1 == 0 { 0.7 } else { -0.5 }));
        corners.map(|at| (25.0, at)).collect()
    }

    fn of(points: &[(f64, Vector3<f64>)]) -> MassProperties {
        let mass_kg: f64 = points.iter().map(|(mass, _)| mass).sum();
        let moment: Vector3<f64> = points.iter().map(|(mass, at)| at * *mass).sum();
        let center_of_mass_body_m = moment / mass_kg;
        let about_center =
            points.iter().map(|(mass, at)| steiner_by_hand(&(at - center_of_mass_body_m)) * *mass);
        MassProperties { mass_kg, center_of_mass_body_m, inertia_body_kg_m2: about_center.sum() }
    }

    fn steiner_by_hand(r: &Vector3<f64>) -> Matrix3<f64> {
        Matrix3::new(
            r.y * r.y + r.z * r.z,
            -r.x * r.y,
            -r.x * r.z,
            -r.x * r.y,
            r.x * r.x + r.z * r.z,
            -r.y * r.z,
            -r.x * r.z,
            -r.y * r.z,
            r.x * r.x + r.y * r.y,
        )
    }

    #[test]
    fn a_turned_panel_is_where_its_points_are() {
        let whole = |angle_rad: f64| [body(), plate(angle_rad)].concat();
        let alone = of(&plate(0.0));
        let mut panels =
            Spacecraft::from_toml("messenger.toml", crate::spacecraft::MESSENGER_TOML).unwrap().panels;
        panels.truncate(1);
        (panels[0].axis_body, panels[0].center_body_m) = (Vector3::x(), Vector3::new(2.0, 0.0, 0.0));
        panels[0].mass = Some(PanelMass {
            mass_kg: alone.mass_kg,
            center_body_m: alone.center_of_mass_body_m,
            inertia_body_kg_m2: alone.inertia_body_kg_m2,
        });
        let at_zero = of(&whole(0.0));
        for angle_rad in [0.0, 0.4, -1.3, 3.0] {
            let (found, expected) = (with_panels(&at_zero, &panels, |_| angle_rad), of(&whole(angle_rad)));
            assert_relative_eq!(found.center_of_mass_body_m, expected.center_of_mass_body_m, epsilon = 1e-13);
            assert_relative_eq!(found.inertia_body_kg_m2, expected.inertia_body_kg_m2, epsilon = 1e-11);
        }
    }

    #[test]
    fn a_square_plate_has_its_textbook_inertia() {
        let plate = PanelMass::square_plate(3.0, 4.0, Vector3::zeros(), &Vector3::y());
        assert_relative_eq!(plate.inertia_body_kg_m2, Matrix3::from_diagonal(&Vector3::new(1.0, 2.0, 1.0)));
    }
}
