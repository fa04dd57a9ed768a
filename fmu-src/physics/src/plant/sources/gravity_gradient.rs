//! Gravity gradient of the planet, with the flattening of its gravity where that is asked for.

use nalgebra::{Matrix3, Vector3};

use super::source::{Results, Source};
use crate::attitude::{OblatePlanet, gravity_gradient_n_m, oblate_gravity_gradient_n_m};
use crate::loads::Effect;
use crate::numerics::scalar::Scalar;
use crate::plant::instant::conditions::Conditions;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::laws::Laws;

/// Gravity gradient.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct GravityGradient;

/// Torque in N m of a planet that lies `planet_body_m` from the spacecraft, its north in the direction `pole_body`, all in the body frame.
pub(super) fn torque_n_m<T: Scalar>(
    laws: &Laws<T>,
    inertia_body_kg_m2: &Matrix3<T>,
    planet_body_m: &Vector3<T>,
    pole_body: impl FnOnce() -> Vector3<T>,
) -> Vector3<T> {
    let gm_m3_s2 = laws.gm_m3_s2;
    match laws.flattening {
        None => gravity_gradient_n_m(gm_m3_s2, inertia_body_kg_m2, planet_body_m),
        Some([j2, j2_radius_m]) => {
            let planet = OblatePlanet { gm_m3_s2, j2, j2_radius_m, pole_body: pole_body() };
            oblate_gravity_gradient_n_m(&planet, inertia_body_kg_m2, planet_body_m)
        }
    }
}

/// North of the planet, EME2000, where its flattening acts.
pub(crate) fn pole_inertial(configuration: &Configuration, time_s: f64) -> Option<Vector3<f64>> {
    let Configuration { figure, laws, epoch_minus_time_s, .. } = configuration;
    let figure = figure.as_ref().filter(|_| laws.flattening.is_some());
    figure.map(|it| it.orientation.pole_eme2000(time_s + epoch_minus_time_s))
}

impl Source for GravityGradient {
    const ROWS: &'static [Effect] = &[Effect::GravityGradient];
    type Settings = Laws;
    type State = ();

    fn load(&mut self, laws: &Laws, (): &(), at: &Conditions<'_>, results: &mut Results<'_>) {
        let Some(planet_body_m) = &at.instant.planet_body_m else { return };
        let pole = || {
            let pole_inertial = pole_inertial(at.kinematics.configuration, at.instant.time_s);
            at.instant.to_body * pole_inertial.unwrap_or_else(Vector3::z)
        };
        results.loads[Effect::GravityGradient].torque_body_n_m =
            torque_n_m(laws, &at.mass.inertia_body_kg_m2, planet_body_m, pole);
    }
}
