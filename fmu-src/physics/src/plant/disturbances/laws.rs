//! Effects in closed form, each row of the table joined with its law.

use nalgebra::{Matrix3, Vector3};

use crate::attitude::gravity_gradient_n_m;
use crate::loads::{Active, Effect, ForceTorque, Grid, Loads};
use crate::numerics::scalar::Scalar;
use crate::plant::motion::instant::Instant;
use crate::spacecraft::MassProperties;

/// What the laws go by that does not change in flight.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Laws<T = f64> {
    /// Gravitational parameter of the planet, in m3/s2.
    pub gm_m3_s2: T,
}

/// A body near a planet.
#[derive(Clone, Copy, Debug)]
pub struct NearPlanet<T> {
    /// From the spacecraft to the planet's centre, body frame, in m.
    pub planet_body_m: Vector3<T>,
    /// Inertia about the centre of mass, body frame, in kg m2.
    pub inertia_body_kg_m2: Matrix3<T>,
}

impl NearPlanet<f64> {
    /// The spacecraft of these mass properties at an instant; `None` where no planet is.
    pub fn of(instant: &Instant, mass: &MassProperties) -> Option<Self> {
        let inertia_body_kg_m2 = mass.inertia_body_kg_m2;
        instant.planet_body_m.map(|planet_body_m| Self { planet_body_m, inertia_body_kg_m2 })
    }
}

impl<T: Scalar> Laws<T> {
    /// Writes the loads of those effects in closed form that act.
    pub fn exert(&self, active: Active, at: &NearPlanet<T>, loads: &mut Loads<T>) {
        for effect in active.disturbances().filter(|effect| effect.row().grid == Grid::Disturbance) {
            loads[effect] = self.load(effect, at);
        }
    }

    fn load(&self, effect: Effect, at: &NearPlanet<T>) -> ForceTorque<T> {
        match effect {
            Effect::GravityGradient => ForceTorque {
                torque_body_n_m: gravity_gradient_n_m(
                    self.gm_m3_s2,
                    &at.inertia_body_kg_m2,
                    &at.planet_body_m,
                ),
                ..ForceTorque::zero()
            },
            Effect::Solar
            | Effect::Albedo
            | Effect::Infrared
            | Effect::Thermal
            | Effect::Applied
            | Effect::Thrusters => ForceTorque::zero(),
        }
    }
}
