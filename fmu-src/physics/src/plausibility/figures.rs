//! Figures of a spacecraft that a person can judge at a glance.

use nalgebra::Vector3;

use super::hull::is_outside;
use super::surfaces::{panel_angle_rad, sun_body, surfaces};
use super::thrusters::{ThrusterFigures, TorqueBothWays};
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::environment::sun::SOLAR_FLUX_W_M2;
use crate::loads::Effect;
use crate::momentum::WheelCapacity;
use crate::radiation::disturbance::{DisturbanceModel, Geometry, Options, Recoil, Workspace};
use crate::spacecraft::{MassProperties, Optics, Spacecraft, Wheel, with_panels};

/// A centre of mass counts as outside where it is beyond the hull by this part of the extents' diagonal: on the hull nothing
/// could be proved.
const OUTSIDE: f64 = 0.01;

/// Figures of a spacecraft's file, with the Sun on -Y and the panels at the angles that the file gives for it.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Least coordinates of any surface, body frame, in m.
    pub least_body_m: Vector3<f64>,
    /// Greatest coordinates of any surface, body frame, in m.
    pub greatest_body_m: Vector3<f64>,
    /// Area of surfaces projected on the planes across +X, +Y, +Z of those that face there, one hidden by another counted
    /// too, in m2.
    pub area_toward_plus_m2: Vector3<f64>,
    /// The same across -X, -Y, -Z, in m2.
    pub area_toward_minus_m2: Vector3<f64>,
    /// Sunlit area projected across the Sun's direction, in m2, without what surfaces with an outline hide.
    pub sunlit_area_m2: f64,
    /// Area of all fronts, and of all rears that light can reach, in m2.
    pub total_area_m2: f64,
    /// With the panels at their angles.
    pub mass_properties: MassProperties,
    /// How far the centre of mass is outside of the convex hull of all surfaces at least, in m; `None` inside.
    pub center_of_mass_outside_m: Option<f64>,
    /// Radii of gyration about the axes through the centre of mass along X, Y, Z, in m.
    pub gyration_radii_m: Vector3<f64>,
    /// Root mean square distance of the mass from the planes through the centre of mass across X, Y, Z, in m.
    pub mass_spread_m: Vector3<f64>,
    /// Force in N and torque in N m of sunlight about the centre of mass at 1 AU without shadows, body frame.
    pub solar: Option<(Vector3<f64>, Vector3<f64>)>,
    /// The same where surfaces with an outline shadow one another.
    pub shadowed_solar: Option<(Vector3<f64>, Vector3<f64>)>,
    /// Momentum capacity of the wheels; `None` where they do not span all directions.
    pub wheels: Option<WheelCapacity>,
    /// Each thruster, in the file's order.
    pub thrusters: Vec<ThrusterFigures>,
    /// Torque of the thrusters that may control the attitude together; `None` without any.
    pub thruster_torque: Option<TorqueBothWays>,
}

impl Figures {
    /// Computes the figures of a spacecraft.
    pub fn new(spacecraft: &Spacecraft) -> Self {
        let surfaces = surfaces(spacecraft);
        let angles_rad: Vec<f64> = spacecraft.panels.iter().map(panel_angle_rad).collect();
        let corners_m: Vec<_> =
            surfaces.iter().flat_map(|surface| surface.corners_m.iter().copied()).collect();
        let fold = |start: f64, pick: fn(f64, f64) -> f64| {
            corners_m.iter().fold(Vector3::repeat(start), |found, corner| found.zip_map(corner, pick))
        };
        let (least_body_m, greatest_body_m) =
            (fold(f64::INFINITY, f64::min), fold(f64::NEG_INFINITY, f64::max));
        let mut area_toward_m2 = [Vector3::zeros(); 2];
        let mut total_area_m2 = 0.0;
        for surface in &surfaces {
            let [plus, minus] = &mut area_toward_m2;
            let projected_m2 = surface.plate.normal * surface.plate.area_m2;
            let rear = f64::from(u8::from(surface.plate.faces.rear_optics.is_some()));
            *plus += projected_m2.map(|area_m2| area_m2.max(0.0) + rear * (-area_m2).max(0.0));
            *minus += projected_m2.map(|area_m2| (-area_m2).max(0.0) + rear * area_m2.max(0.0));
            total_area_m2 += surface.plate.area_m2 * (1.0 + rear);
        }
        let angle_rad = |index: usize| angles_rad.get(index).copied().unwrap_or(0.0);
        let mass_properties = with_panels(&spacecraft.mass_properties, &spacecraft.panels, angle_rad);
        let center_m = mass_properties.center_of_mass_body_m;
        let tolerance_m = OUTSIDE * (greatest_body_m - least_body_m).norm();
        let sunlit = |spacecraft: &Spacecraft, shadows| sunlight(spacecraft, &angles_rad, center_m, shadows);
        let moments = mass_properties.inertia_body_kg_m2.diagonal() / mass_properties.mass_kg;
        let axes: Vec<_> = spacecraft.wheels.iter().map(|wheel| wheel.axis_body).collect();
        let capacities_n_m_s: Vec<_> = spacecraft.wheels.iter().map(Wheel::free_capacity_n_m_s).collect();
        Self {
            least_body_m,
            greatest_body_m,
            area_toward_plus_m2: area_toward_m2[0],
            area_toward_minus_m2: area_toward_m2[1],
            sunlit_area_m2: sunlit(&black(spacecraft), true)
                .map_or(0.0, |(force_n, _)| -force_n.dot(&sun_body()) * SPEED_OF_LIGHT_M_S / SOLAR_FLUX_W_M2),
            total_area_m2,
            mass_properties,
            center_of_mass_outside_m: is_outside(&center_m, &corners_m, tolerance_m),
            gyration_radii_m: moments.map(f64::sqrt),
            mass_spread_m: moments.map(|own| ((moments.sum() / 2.0 - own).max(0.0)).sqrt()),
            solar: sunlit(spacecraft, false),
            shadowed_solar: sunlit(spacecraft, true),
            wheels: WheelCapacity::new(&axes, &capacities_n_m_s),
            thrusters: ThrusterFigures::for_all(spacecraft, &angles_rad, &center_m),
            thruster_torque: TorqueBothWays::new(spacecraft, &center_m),
        }
    }
}

/// Force and torque of sunlight at 1 AU.
fn sunlight(
    spacecraft: &Spacecraft,
    panel_angles_rad: &[f64],
    center_of_mass_body_m: Vector3<f64>,
    self_shadowing: bool,
) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let options = Options { self_shadowing, ..Options::default() };
    let model = DisturbanceModel::new(spacecraft, &options).ok()?;
    let sunlit = Geometry::sunlit(sun_body(), SOLAR_FLUX_W_M2);
    let geometry = Geometry { panel_angles_rad, center_of_mass_body_m, ..sunlit };
    let solar = model.evaluate(&geometry, Recoil::Balance, &mut Workspace::default()).ok()?[Effect::Solar];
    Some((solar.force_body_n, solar.torque_body_n_m))
}

/// Returns the spacecraft with surfaces that absorb all light: the force along the light is then that on its shadow.
fn black(spacecraft: &Spacecraft) -> Spacecraft {
    let black = Optics::from_reflectivities(0.0, 0.0);
    let mut spacecraft = spacecraft.clone();
    let shade_plates = spacecraft.sunshade.iter_mut().flat_map(|shade| {
        shade.cylinder.iter_mut().for_each(|cylinder| cylinder.optics = black);
        &mut shade.plates
    });
    let plates = spacecraft.plates.iter_mut().chain(shade_plates).map(|plate| &mut plate.faces);
    for faces in plates.chain(spacecraft.panels.iter_mut().map(|panel| &mut panel.faces)) {
        faces.optics = black;
        faces.rear_optics = faces.rear_optics.map(|_| black);
    }
    spacecraft
}
