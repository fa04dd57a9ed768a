//! Force of the air agrees with closed forms, integrals over the Maxwellian, rays and differences.

mod closed_forms;
mod maxwellian;
mod whole;

use nalgebra::Vector3;

use super::*;
use crate::loads::ForceTorque;
use crate::spacecraft::{GasSurface, Spacecraft};

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

const LAWS: [(AerodynamicLaw, Reemission); 4] = [
    (AerodynamicLaw::DragCoefficient, Reemission::Effusive),
    (AerodynamicLaw::Sentman, Reemission::Effusive),
    (AerodynamicLaw::Sentman, Reemission::Moe),
    (AerodynamicLaw::SchaafChambre, Reemission::Effusive),
];

/// Of no special values.
const SURFACE: GasSurface = GasSurface {
    drag_coefficient: 2.3,
    energy_accommodation: 0.7,
    normal_accommodation: 0.6,
    tangential_accommodation: 0.8,
    wall_temperature_k: 350.0,
};

fn spacecraft(text: &str) -> Spacecraft {
    Spacecraft::from_toml("test.toml", text).unwrap()
}

fn model(spacecraft: &Spacecraft, (law, reemission): (AerodynamicLaw, Reemission)) -> AerodynamicModel {
    let options = AerodynamicOptions { law, reemission, ..AerodynamicOptions::default() };
    AerodynamicModel::new(spacecraft, &options).unwrap()
}

/// Atomic oxygen of 1000 K: the most probable speed is 1019 m/s.
fn thin_air(velocity_body_m_s: Vector3<f64>) -> AirFlow<f64> {
    AirFlow { density_kg_m3: 1e-11, temperature_k: 1000.0, molar_mass_kg_mol: 0.016, velocity_body_m_s }
}

fn load(model: &AerodynamicModel, flow: &AirFlow<f64>, panel_angles_rad: &[f64]) -> ForceTorque {
    let mut workspace = AerodynamicWorkspace::default();
    model.load(flow, panel_angles_rad, &Vector3::zeros(), Walls::OWN, &mut workspace)
}
