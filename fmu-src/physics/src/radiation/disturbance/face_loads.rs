//! Light and heat on every face at one geometry: forces, absorbed power, temperatures, recoil.

use super::geometry::{Geometry, Recoil};
use super::workspace::{FaceResult, Workspace};
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::loads::{Effect, ForceTorque, Loads};
use crate::numerics::scalar::{Scalar, constant_vector};
use crate::radiation::faces::{Face, Faces, Surface};
use crate::radiation::flat_plate::force_per_area_pa;
use crate::radiation::thermal::balance::{FaceEnvironment, conducting_temperatures_k, face_temperature_k};
use crate::radiation::thermal::recoil_n;

/// The faces at one geometry. Normals, planet light and shadows stand in the workspace.
pub(super) struct FaceLoads<'a, T: Scalar> {
    pub faces: &'a Faces,
    pub geometry: &'a Geometry<'a, T>,
    /// Whether surfaces shadow one another.
    pub shadowing: bool,
}

impl<T: Scalar> FaceLoads<'_, T> {
    /// Light on every face: solar, albedo and infrared force, absorbed power.
    pub(super) fn receive(&self, workspace: &mut Workspace<T>) -> Loads<T> {
        let beam = self.geometry.beam();
        let mut sum = Loads::zero();
        for (face, state) in self.faces.faces.iter().zip(workspace.faces.iter_mut()) {
            let surface = &self.faces.surfaces[face.surface];
            let material = &workspace.materials[face.material];
            let normal = &workspace.normals[face.normal];
            let light = &workspace.lights[face.normal];
            let center_m = constant_vector::<T>(&surface.center_body_m);
            let arm_m = center_m - self.geometry.center_of_mass_body_m;
            let area_m2 = T::constant(surface.area_m2);
            *state = FaceResult { lit_center_body_m: center_m, ..FaceResult::dark() };

            let sunlight = beam.received(normal);
            if sunlight.pressure_pa.value() > 0.0 {
                let shadowed =
                    surface.outline.filter(|_| self.shadowing).and_then(|o| workspace.shadow.lit(o));
                let (lit_area_m2, lit_center_m) = shadowed.unwrap_or((area_m2, center_m));
                state.lit_center_body_m = lit_center_m;
                state.absorbed_sun_w =
                    sunlight.pressure_pa * lit_area_m2 * (material.optics.absorptivity * SPEED_OF_LIGHT_M_S);
                let force_n = force_per_area_pa(&material.optics, normal, &sunlight) * lit_area_m2;
                let force_n = force_n * self.geometry.solar_scale;
                state.forces_body_n[Effect::Solar as usize] = force_n;
                if !surface.closed_form_sun {
                    let lit_arm_m = lit_center_m - self.geometry.center_of_mass_body_m;
                    sum[Effect::Solar] += ForceTorque::at_arm(&lit_arm_m, force_n);
                }
            }
            if light.albedo.pressure_pa.value() != 0.0 || light.infrared.pressure_pa.value() != 0.0 {
                let infrared_optics = &material.thermal.infrared_optics;
                let albedo_n = force_per_area_pa(&material.optics, normal, &light.albedo) * area_m2;
                let infrared_n = force_per_area_pa(infrared_optics, normal, &light.infrared) * area_m2;
                state.forces_body_n[Effect::Albedo as usize] = albedo_n;
                state.forces_body_n[Effect::Infrared as usize] = infrared_n;
                sum[Effect::Albedo] += ForceTorque::at_arm(&arm_m, albedo_n);
                sum[Effect::Infrared] += ForceTorque::at_arm(&arm_m, infrared_n);
                let absorbed_pa = light.albedo.pressure_pa * material.optics.absorptivity
                    + light.infrared.pressure_pa * infrared_optics.absorptivity;
                state.absorbed_planet_w = absorbed_pa * (surface.area_m2 * SPEED_OF_LIGHT_M_S);
            }
        }
        sum
    }

    /// Temperatures and recoil of every surface.
    pub(super) fn radiate(&self, recoil: Recoil<'_>, workspace: &mut Workspace<T>) -> ForceTorque<T> {
        let mut sum = ForceTorque::zero();
        if matches!(recoil, Recoil::Ignored) {
            return sum;
        }
        for surface in &self.faces.surfaces {
            let range = surface.faces.clone();
            let faces = &self.faces.faces[range.clone()];
            let states = &mut workspace.faces[range.clone()];
            let stores = surface.thermal.heat_capacity_j_m2_k > 0.0;
            let stored = match recoil {
                Recoil::Stored(temperatures_k) if stores => Some(&temperatures_k[range]),
                _ => None,
            };
            let environments = surface.environments(faces, &workspace.materials);
            let at_center = set_temperatures((surface, &environments), faces, states, stored);
            for ((face, state), environment) in faces.iter().zip(states).zip(environments) {
                let normal = &workspace.normals[face.normal];
                let radiated_w = environment.radiated_w_m2(state.temperature_k).0 * surface.area_m2;
                let center_m =
                    constant_vector::<T>(&surface.center_body_m) - self.geometry.center_of_mass_body_m;
                let at_center = at_center || environment.bus.conducts();
                // An insulated face gives off sunlight where it is absorbed, everything else evenly.
                let spread_w =
                    if at_center { radiated_w } else { state.absorbed_planet_w + face.internal_heat_w };
                let mut force_n = recoil_n(normal, spread_w);
                sum += ForceTorque::at_arm(&center_m, force_n);
                if !at_center {
                    let lit_n = recoil_n(normal, state.absorbed_sun_w);
                    let lit_center_m = state.lit_center_body_m - self.geometry.center_of_mass_body_m;
                    sum += ForceTorque::at_arm(&lit_center_m, lit_n);
                    force_n += lit_n;
                }
                state.forces_body_n[Effect::Thermal as usize] = force_n;
            }
        }
        sum
    }
}

/// Writes the temperatures of a surface's faces; tells whether the whole face radiates evenly.
fn set_temperatures<T: Scalar>(
    (surface, environments): (&Surface, &[FaceEnvironment<T>; 2]),
    faces: &[Face],
    states: &mut [FaceResult<T>],
    stored: Option<&[f64]>,
) -> bool {
    if let Some(stored) = stored {
        for (state, temperature_k) in states.iter_mut().zip(stored) {
            state.temperature_k = T::constant(*temperature_k);
        }
        return true;
    }
    let heat = |face: &Face, state: &FaceResult<T>| {
        (state.absorbed_sun_w + state.absorbed_planet_w + face.internal_heat_w) * (1.0 / surface.area_m2)
    };
    if let (Some(conduction), [front, rear], [front_state, rear_state]) =
        (&surface.thermal.conduction, faces, &mut *states)
        && (conduction.conductance_w_m2_k > 0.0 || conduction.radiative_exchange > 0.0)
    {
        let heat_w_m2 = [heat(front, front_state), heat(rear, rear_state)];
        let [front_k, rear_k] = conducting_temperatures_k(environments, conduction, heat_w_m2);
        front_state.temperature_k = front_k;
        rear_state.temperature_k = rear_k;
        return true;
    }
    for ((face, state), environment) in faces.iter().zip(states).zip(environments) {
        state.temperature_k = face_temperature_k(environment, heat(face, state));
    }
    false
}
