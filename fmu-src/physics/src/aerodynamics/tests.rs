//! Force of the air agrees with closed forms and integrals over the Maxwellian.

use nalgebra::Vector3;

use super::*;
use crate::spacecraft::Spacecraft;

/// One plate of 10 m2 across x, one metre up z.
const PLATE: &str = r#"
name = "plate"
[mass_properties]
mass_kg = 100.0
center_of_mass_m = [0, 0, 0]
inertia_kg_m2 = [[10, 0, 0], [0, 10, 0], [0, 0, 10]]
[optics.black]
specular = 0
diffuse = 0
[[plates]]
area_m2 = 10.0
center_m = [0, 0, 1]
normal = [1, 0, 0]
optics = "black"
"#;

fn thin_air(velocity_body_m_s: Vector3<f64>) -> AirFlow<f64> {
    AirFlow { density_kg_m3: 1e-11, temperature_k: 1000.0, molar_mass_kg_mol: 0.016, velocity_body_m_s }
}

#[test]
fn drag_is_dynamic_pressure_times_area_and_coefficient() {
    let spacecraft = Spacecraft::from_toml("plate.toml", PLATE).unwrap();
    let options =
        AerodynamicOptions { law: AerodynamicLaw::DragCoefficient, ..AerodynamicOptions::default() };
    let model = AerodynamicModel::new(&spacecraft, &options).unwrap();
    let mut workspace = AerodynamicWorkspace::default();
    let flow = thin_air(Vector3::new(7670.0, 0.0, 0.0));
    let load = model.load(&flow, &[], &Vector3::zeros(), None, &mut workspace);
    assert!((load.force_body_n - Vector3::new(-6.471179e-3, 0.0, 0.0)).norm() < 1e-12);
    assert!((load.torque_body_n_m - Vector3::new(0.0, -6.471179e-3, 0.0)).norm() < 1e-12);
    let behind = thin_air(Vector3::new(-7670.0, 0.0, 0.0));
    let load = model.load(&behind, &[], &Vector3::zeros(), None, &mut workspace);
    assert_eq!(load.force_body_n, Vector3::zeros());
}
