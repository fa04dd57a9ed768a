//! Effects in closed form, each row of the table joined with its law.

mod magnetic;

use nalgebra::{Matrix3, Vector3};

use crate::attitude::{OblatePlanet, gravity_gradient_n_m, oblate_gravity_gradient_n_m};
use crate::loads::{Active, Effect, ForceTorque, Loads};
use crate::numerics::scalar::Scalar;
use crate::plant::settings::laws::Laws;

/// Quantities at the spacecraft that the laws depend on: planet, inertia, magnetic field and air.
#[derive(Clone, Copy, Debug)]
pub struct LocalEnvironment<T: Scalar> {
    /// From the spacecraft to the planet's centre, body frame, in m; `None` where it is not known.
    pub planet_body_m: Option<Vector3<T>>,
    /// Unit vector to the planet's north pole, body frame.
    pub pole_body: Vector3<T>,
    /// Inertia about the centre of mass, body frame, in kg m2.
    pub inertia_body_kg_m2: Matrix3<T>,
    /// Magnetic field, body frame, in T.
    pub field_body_t: Vector3<T>,
    /// Aerodynamic force and torque.
    pub air: ForceTorque<T>,
}

/// Writes the loads of the active effects that have a closed form.
pub(super) fn write_loads<T: Scalar>(
    laws: &Laws<T>,
    active: Active,
    at: &LocalEnvironment<T>,
    loads: &mut Loads<T>,
) {
    for effect in active.disturbances().filter(|effect| !effect.is_light()) {
        loads[effect] = load(laws, effect, at);
    }
}

fn load<T: Scalar>(laws: &Laws<T>, effect: Effect, at: &LocalEnvironment<T>) -> ForceTorque<T> {
    let torque = |torque_body_n_m: Option<Vector3<T>>| ForceTorque {
        torque_body_n_m: torque_body_n_m.unwrap_or_else(Vector3::zeros),
        ..ForceTorque::zero()
    };
    match effect {
        Effect::GravityGradient => torque(at.planet_body_m.map(|planet_body_m| match laws.flattening {
            None => gravity_gradient_n_m(laws.gm_m3_s2, &at.inertia_body_kg_m2, &planet_body_m),
            Some([j2, j2_radius_m]) => {
                let (gm_m3_s2, pole_body) = (laws.gm_m3_s2, at.pole_body);
                let planet = OblatePlanet { gm_m3_s2, j2, j2_radius_m, pole_body };
                oblate_gravity_gradient_n_m(&planet, &at.inertia_body_kg_m2, &planet_body_m)
            }
        })),
        Effect::Aerodynamic => at.air,
        Effect::Magnetic => torque(Some(magnetic::torque_n_m(&laws.dipole_body_a_m2, &at.field_body_t))),
        Effect::Solar
        | Effect::Albedo
        | Effect::Infrared
        | Effect::Thermal
        | Effect::Applied
        | Effect::Thrusters
        | Effect::Imbalance
        | Effect::Slosh => ForceTorque::zero(),
    }
}
