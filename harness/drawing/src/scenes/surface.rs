//! The flat surfaces of a spacecraft, as its file's reader gives them, for pictures.
//!
//! A surface given by its outline is that polygon, any other a square of its area; a cylindrical sunshade is a row of
//! facets.

use nalgebra::{Rotation3, Unit};
use physics::spacecraft::{Panel, PanelControl, Polygon, Spacecraft, SunshadeModel};

use crate::{Finish, Surface, Vector};

/// The direction to the Sun that the shipped files and Guidance take.
pub(super) const TO_SUN: Vector = Vector::new(0.0, -1.0, 0.0);
/// Facets of a whole cylinder.
const FACETS: f64 = 72.0;

/// A panel's surface turned about its axis.
fn turned(surface: Surface, panel: &Panel, angle_rad: f64) -> Surface {
    // At angle 0 the outline stays as the file has it, to the bit.
    if angle_rad == 0.0 {
        return surface;
    }
    let turn = Rotation3::from_axis_angle(&Unit::new_normalize(panel.axis_body), angle_rad);
    let place = |at: Vector| panel.center_body_m + turn * (at - panel.center_body_m);
    Surface {
        corners: surface.corners.iter().map(|corner| place(*corner)).collect(),
        center: place(surface.center),
        normal: turn * surface.normal,
        grid: surface.grid.map(|direction| turn * direction),
        ..surface
    }
}

/// The sunshade that the file says is used.
pub(super) fn shade_model(spacecraft: &Spacecraft) -> SunshadeModel {
    spacecraft.sunshade.as_ref().map_or(SunshadeModel::Plates, |shade| shade.model)
}

/// Plates, then a cylindrical shade if it is used, then panels at these angles (by index, in rad); `part` counts these.
pub(super) fn surfaces(spacecraft: &Spacecraft, angle_rad: impl Fn(usize) -> f64) -> Vec<Surface> {
    let outline = |polygon: &Option<Polygon>| Some(polygon.as_ref()?.vertices_m().to_vec());
    let plates = spacecraft.plates_body(shade_model(spacecraft));
    let mut parts: Vec<Vec<Surface>> = plates
        .iter()
        .map(|plate| {
            let square = (plate.area_m2, plate.center_m);
            Surface::new(outline(&plate.polygon), square, plate.normal, None).into_iter().collect()
        })
        .collect();
    parts.extend((shade_model(spacecraft) == SunshadeModel::Cylinder).then(|| cylinder(spacecraft)));
    for (index, panel) in spacecraft.panels.iter().enumerate() {
        let square = (panel.area_m2, panel.center_body_m);
        let (normal, axis) = (panel.zero_normal_body, panel.axis_body);
        let surface = Surface::new(outline(&panel.polygon), square, normal, Some(axis));
        parts.push(surface.map(|surface| turned(surface, panel, angle_rad(index))).into_iter().collect());
    }
    let numbered = parts.into_iter().enumerate();
    numbered
        .flat_map(|(part, surfaces)| surfaces.into_iter().map(move |surface| Surface { part, ..surface }))
        .collect()
}

/// The angle at which a panel stands with the Sun along -Y, as its file says.
pub(super) fn angle_of_file_rad(panel: &Panel) -> f64 {
    match panel.control {
        PanelControl::Angle => panel.angle_rad,
        _ => panel.angle_for_sun_offset(&TO_SUN, panel.sun_offset_rad, panel.tilt_sign),
    }
}

/// The facets of a cylindrical sunshade.
fn cylinder(spacecraft: &Spacecraft) -> Vec<Surface> {
    let Some(shade) = &spacecraft.sunshade else { return Vec::new() };
    let Some(cylinder) = &shade.cylinder else { return Vec::new() };
    let half_turn = std::f64::consts::PI;
    let count = (FACETS * cylinder.half_angle_rad / half_turn).ceil().max(2.0);
    let corner = |k: f64, z_m: f64| -> Vector {
        let (sine, cosine) = (cylinder.half_angle_rad * (2.0 * k / count - 1.0)).sin_cos();
        shade.dcm_body_from_shade * Vector::new(cylinder.radius_m * sine, -cylinder.radius_m * cosine, z_m)
    };
    let half_m = cylinder.height_m / 2.0;
    (0..count as u32)
        .filter_map(|k| {
            let (k, next) = (f64::from(k), f64::from(k + 1));
            let corners =
                vec![corner(k, -half_m), corner(next, -half_m), corner(next, half_m), corner(k, half_m)];
            Surface::facet(corners, Finish::Facet, 0)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    //! Panels stand as the model that takes the light turns them.
    use super::*;

    #[test]
    fn panels_turn_as_the_radiation_model_turns_them() {
        let sailer = include_str!("../../../../fmu-src/resources/examples/solar-sailer.toml");
        let file = Spacecraft::from_toml("", sailer).unwrap();
        for angle_rad in [-2.0, -0.4, 0.7, 3.0] {
            let all = surfaces(&file, |_| angle_rad);
            for (panel, surface) in file.panels.iter().zip(&all[all.len() - file.panels.len()..]) {
                let normal = panel.normal_body(angle_rad);
                assert!((normal.dot(&surface.normal) - 1.0).abs() < 1e-12, "{}", panel.name);
                for corner in &surface.corners {
                    assert!(normal.dot(&(corner - surface.center)).abs() < 1e-12, "{}", panel.name);
                }
            }
        }
    }

    #[test]
    fn panels_that_follow_the_sun_keep_their_offset() {
        let file = Spacecraft::from_toml("", physics::spacecraft::MESSENGER_TOML).unwrap();
        let all = surfaces(&file, |index| angle_of_file_rad(&file.panels[index]));
        let cells: Vec<&Surface> = all.iter().filter(|surface| surface.finish == Finish::Cells).collect();
        assert_eq!(cells.len(), 2);
        for surface in cells {
            let offset_deg = surface.normal.dot(&TO_SUN).acos().to_degrees();
            assert!((offset_deg - 65.0).abs() < 1e-9, "{offset_deg}");
        }
    }
}
