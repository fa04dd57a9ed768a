//! Plume of a thruster: which surface stands in the cone that its exhaust fills.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};

use crate::math;
use crate::spacecraft::{Panel, Plate, Polygon, Spacecraft, Thruster};

/// Returns the first plate or panel with a corner or the centre in the cone of the thruster's plume, by name, the panels at
/// these angles (by index, in rad; none = left out). A surface that the thruster stands on is not in it.
pub fn surface_in_plume<'s>(
    spacecraft: &'s Spacecraft,
    thruster: &Thruster,
    panel_angle_rad: impl Fn(usize) -> Option<f64>,
) -> Option<&'s str> {
    if thruster.plume_half_angle_rad <= 0.0 {
        return None;
    }
    let exhaust = -thruster.force_body_n.normalize();
    let least = math::cos(thruster.plume_half_angle_rad);
    let is_in = |point: &Vector3<f64>| {
        let from_nozzle = point - thruster.position_body_m;
        from_nozzle.dot(&exhaust) > least * from_nozzle.norm()
    };
    // The surface is turned about a pivot.
    let is_met =
        |center: &Vector3<f64>, outline: Option<&Polygon>, turn: &Matrix3<f64>, pivot: &Vector3<f64>| {
            let vertices = outline.map_or(&[][..], Polygon::vertices_m);
            core::iter::once(center).chain(vertices).any(|point| is_in(&(pivot + turn * (point - pivot))))
        };
    let first_met = |plates: &'s [Plate], turn: &Matrix3<f64>| {
        let is_met = |it: &&Plate| is_met(&it.center_m, it.polygon.as_ref(), turn, &Vector3::zeros());
        plates.iter().find(is_met).map(|plate| plate.name.as_str())
    };
    let of_shade = || {
        let shade = spacecraft.sunshade.as_ref()?;
        first_met(&shade.plates, &shade.dcm_body_from_shade)
    };
    let is_panel_met = |(k, panel): &(usize, &Panel)| {
        panel_angle_rad(*k).is_some_and(|angle_rad| {
            let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(panel.axis_body), angle_rad);
            is_met(&panel.center_body_m, panel.polygon.as_ref(), turn.matrix(), &panel.center_body_m)
        })
    };
    let of_panels =
        || spacecraft.panels.iter().enumerate().find(is_panel_met).map(|(_, it)| it.name.as_str());
    first_met(&spacecraft.plates, &Matrix3::identity()).or_else(of_shade).or_else(of_panels)
}

#[cfg(test)]
mod tests {
    //! A nozzle that looks at a panel's edge, and away from it.
    use super::*;
    use crate::spacecraft::MESSENGER_TOML;

    fn nozzle(position: [f64; 3], exhaust: [f64; 3], half_angle_deg: f64) -> Thruster {
        let (position_body_m, force_body_n) = (Vector3::from(position), -Vector3::from(exhaust) * 4.4);
        let plume_half_angle_rad = half_angle_deg.to_radians();
        Thruster { plume_half_angle_rad, ..Thruster::plain(position_body_m, force_body_n) }
    }

    #[test]
    fn a_panel_in_the_cone_is_hit() {
        let spacecraft = Spacecraft::from_toml("messenger.toml", MESSENGER_TOML).unwrap();
        let hits = |thruster: &Thruster| surface_in_plume(&spacecraft, thruster, |_| Some(0.0)) == Some("+X");
        // The panel's centre is at (2.28, 0, 0): 45 deg off the exhaust.
        let aside = |half_deg: f64| nozzle([3.28, 0.0, 1.0], [0.0, 0.0, -1.0], half_deg);
        assert!(!hits(&aside(44.9)) && hits(&aside(45.1)));
        assert!(!hits(&aside(0.0)), "no plume is given");
        assert!(!hits(&nozzle([3.28, 0.0, 1.0], [0.0, 0.0, 1.0], 80.0)));
        let left_out = surface_in_plume(&spacecraft, &aside(50.0), |_| None);
        assert_eq!(left_out, None, "panels that are left out are not there");
    }
}
