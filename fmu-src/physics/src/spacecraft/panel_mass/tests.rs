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
    let about_center = points.iter().map(|(mass, at)| steiner_by_hand(&(at - center_of_mass_body_m)) * *mass);
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
