//! The whole MESSENGER against its sunshade and panels alone: what differs within the keep-in zone is what single surfaces add.

use approx::assert_relative_eq;
use nalgebra::Vector3;

use super::*;
use crate::loads::{Effect, ForceTorque};
use crate::spacecraft::{MESSENGER_TOML, Spacecraft};

const WHOLE: &str = include_str!("../../../../resources/messenger-full.toml");
/// Cells 65 deg off a Sun on -Y.
const ANGLES_RAD: [f64; 2] = [1.134_464_013_796_314_2; 2];

fn model(name: &str, text: &str) -> DisturbanceModel {
    DisturbanceModel::new(&Spacecraft::from_toml(name, text).unwrap(), &Options::default()).unwrap()
}

/// Where the Sun stands at an azimuth and elevation, in deg.
fn sun(azimuth_deg: f64, elevation_deg: f64) -> Vector3<f64> {
    let (azimuth, elevation) = (azimuth_deg.to_radians(), elevation_deg.to_radians());
    Vector3::new(elevation.cos() * azimuth.sin(), -elevation.cos() * azimuth.cos(), -elevation.sin())
}

/// Sunlight on the whole and, name by name, on each lit face.
fn sunlight(
    model: &DisturbanceModel,
    sun_body: Vector3<f64>,
) -> (ForceTorque<f64>, Vec<(String, ForceTorque<f64>)>) {
    let geometry = Geometry {
        panel_angles_rad: &ANGLES_RAD,
        center_of_mass_body_m: Vector3::new(0.01, -0.02, 0.03),
        ..Geometry::sunlit(sun_body, 9000.0)
    };
    let mut workspace = Workspace::default();
    let found = model.evaluate(&geometry, Recoil::Balance, &mut workspace).unwrap();
    let faces = workspace
        .faces()
        .iter()
        .zip(model.face_names())
        .filter(|(face, _)| face.forces_body_n[Effect::Solar as usize] != Vector3::zeros());
    let of = |face: &FaceResult<f64>| {
        let arm_m = face.lit_center_body_m - geometry.center_of_mass_body_m;
        ForceTorque::at_arm(&arm_m, face.forces_body_n[Effect::Solar as usize])
    };
    (found[Effect::Solar], faces.map(|(face, name)| (name, of(face))).collect())
}

#[test]
fn within_the_zone_the_whole_differs_from_shade_and_panels_by_what_single_surfaces_add() {
    let (whole, few) = (model("messenger-full.toml", WHOLE), model("messenger.toml", MESSENGER_TOML));
    let mut lit_beyond = std::collections::BTreeSet::new();
    for azimuth_deg in (-15_i32..=15).step_by(3) {
        for elevation_deg in [-13, -10, -5, 0, 5, 10, 13] {
            let at = sun(f64::from(azimuth_deg), f64::from(elevation_deg));
            let ((all, on_whole), (some, on_few)) = (sunlight(&whole, at), sunlight(&few, at));
            let mut sum = ForceTorque::zero();
            for (name, load) in &on_whole {
                match on_few.iter().find(|(known, _)| known == name) {
                    Some((_, known)) => {
                        sum += *load;
                        sum += ForceTorque {
                            force_body_n: -known.force_body_n,
                            torque_body_n_m: -known.torque_body_n_m,
                        };
                        // Plates meet at corners printed to a tenth of a millimetre.
                        let seam = (load.force_body_n - known.force_body_n).norm();
                        assert!(seam <= 0.01 * known.force_body_n.norm(), "{name}: {seam}");
                    }
                    None => {
                        sum += *load;
                        if load.force_body_n.norm() > 1e-9 * all.force_body_n.norm() {
                            lit_beyond.insert(name.clone());
                            let is_slim = name.starts_with("boom") || name.starts_with("bell");
                            // The shade keeps the bus dark up to 10.5 deg of azimuth.
                            let is_aside = ["bus +X", "bus -X", "bus +Z", "bus -Z"].contains(&name.as_str());
                            let is_allowed = is_slim || is_aside && azimuth_deg.abs() >= 11;
                            assert!(is_allowed, "{name} at {azimuth_deg} {elevation_deg}");
                        }
                    }
                }
            }
            assert!(on_few.iter().all(|(name, _)| on_whole.iter().any(|(known, _)| known == name)));
            let size = all.force_body_n.norm();
            let difference = all.force_body_n - some.force_body_n;
            assert_relative_eq!(sum.force_body_n, difference, epsilon = 1e-13 * size);
            let torque = all.torque_body_n_m - some.torque_body_n_m;
            assert_relative_eq!(sum.torque_body_n_m, torque, epsilon = 1e-13 * size);
        }
    }
    for name in ["bus +X", "bus -X", "boom +X", "boom -X", "bell exit"] {
        assert!(lit_beyond.contains(name), "{name}: {lit_beyond:?}");
    }
}

/// From behind, the bus, the backs of shade and panels, the bell or the boom take the light that shade and cells do not.
#[test]
fn an_attitude_off_the_sun_feels_light() {
    let (whole, few) = (model("messenger-full.toml", WHOLE), model("messenger.toml", MESSENGER_TOML));
    for (at, named) in [
        (Vector3::y(), "bus back"),
        (Vector3::new(0.0, 0.6, 0.8), "bus +Z"),
        (Vector3::new(0.0, 0.28, -0.96), "bell exit"),
        (Vector3::new(0.96, 0.28, 0.0), "boom +X"),
        (Vector3::new(0.0, 0.8, 0.6), "front, rear"),
    ] {
        let ((all, on_whole), (some, _)) = (sunlight(&whole, at), sunlight(&few, at));
        assert!(on_whole.iter().any(|(name, _)| name == named), "{named} is dark: {on_whole:?}");
        assert!(all.force_body_n.norm() > some.force_body_n.norm(), "{named}");
        // Light pushes away from the Sun.
        assert!(all.force_body_n.dot(&at) < -1e-5, "{named}");
    }
}
