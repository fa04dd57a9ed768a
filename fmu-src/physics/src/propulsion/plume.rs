//! Plume of a thruster: which surface stands in the cone that its exhaust fills.

use nalgebra::{Rotation3, Unit, Vector3};

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
    let any_in = |center: &Vector3<f64>,
                  outline: Option<&Polygon>,
                  place: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| {
        is_in(&place(center))
            || outline.is_some_and(|outline| outline.vertices_m().iter().any(|vertex| is_in(&place(vertex))))
    };
    let fixed = |point: &Vector3<f64>| *point;
    let is_met = |plate: &&Plate, place: &dyn Fn(&Vector3<f64>) -> Vector3<f64>| {
        any_in(&plate.center_m, plate.polygon.as_ref(), place)
    };
    let plate = spacecraft.plates.iter().find(|plate| is_met(plate, &fixed));
    let of_shade = || {
        let shade = spacecraft.sunshade.as_ref()?;
        let turned = |point: &Vector3<f64>| shade.dcm_body_from_shade * point;
        shade.plates.iter().find(|plate| is_met(plate, &turned))
    };
    let panel = || {
        let numbered = spacecraft.panels.iter().enumerate();
        let mut met = numbered.filter(|(k, panel)| {
            panel_angle_rad(*k).is_some_and(|angle_rad| panel_hit(panel, angle_rad, &any_in))
        });
        met.next().map(|(_, panel)| panel.name.as_str())
    };
    plate.or_else(of_shade).map(|plate| plate.name.as_str()).or_else(panel)
}

type AnyIn<'a> = dyn Fn(&Vector3<f64>, Option<&Polygon>, &dyn Fn(&Vector3<f64>) -> Vector3<f64>) -> bool + 'a;

fn panel_hit(panel: &Panel, angle_rad: f64, any_in: &AnyIn<'_>) -> bool {
    let turn = Rotation3::from_axis_angle(&Unit::new_unchecked(panel.axis_body), angle_rad);
    let turned = |point: &Vector3<f64>| panel.center_body_m + turn * (point - panel.center_body_m);
    any_in(&panel.center_body_m, panel.polygon.as_ref(), &turned)
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
