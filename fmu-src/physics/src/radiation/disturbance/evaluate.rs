//! From geometry to force and torque.

use nalgebra::Vector3;

use super::faces::{Face, Normal, Surface};
use super::geometry::{Geometry, GeometryError, Recoil};
use super::model::DisturbanceModel;
use super::workspace::{Disturbance, FaceResult, Workspace};
use crate::bodies::surface::PlanetSurface;
use crate::constants::SPEED_OF_LIGHT_M_S;
use crate::numerics::scalar::{Scalar, constant_vector};
use crate::radiation::flat_plate::{Beam, force_per_area_pa};
use crate::radiation::force_torque::ForceTorque;
use crate::radiation::planet_light::PlanetLight;
use crate::radiation::thermal::balance::{conducting_temperatures_k, exitance_w_m2, insulated_temperature_k};
use crate::radiation::thermal::recoil_n;

impl DisturbanceModel {
    /// Force and torque about the centre of mass by effect; by face in the workspace.
    ///
    /// Does not allocate once the workspace has been used, unless surfaces shadow one another.
    ///
    /// # Errors
    /// A geometry without meaning: not finite, spacecraft inside the planet, Sun without direction, wrong number of
    /// angles or temperatures.
    pub fn evaluate<T: Scalar>(
        &self,
        geometry: &Geometry<'_, T>,
        recoil: Recoil<'_>,
        workspace: &mut Workspace<T>,
    ) -> Result<Disturbance<T>, GeometryError> {
        let surface = self.planet.map(|surface| surface.constant());
        self.evaluate_on(surface.as_ref(), geometry, recoil, workspace)
    }

    /// As [`DisturbanceModel::evaluate`] near a planet of this surface, whose properties may depend on the seed; not
    /// checked.
    ///
    /// # Errors
    /// See [`DisturbanceModel::evaluate`].
    pub fn evaluate_on<T: Scalar>(
        &self,
        surface: Option<&PlanetSurface<T>>,
        geometry: &Geometry<'_, T>,
        recoil: Recoil<'_>,
        workspace: &mut Workspace<T>,
    ) -> Result<Disturbance<T>, GeometryError> {
        geometry.check(self.panels.len())?;
        self.check_temperatures(recoil)?;
        workspace.prepare(self.faces.normals.len(), self.faces.faces.len());
        self.turn_normals(geometry, workspace);
        self.light_planet(surface, geometry, workspace)?;
        if let Some(scene) = &self.scene {
            let sun = &geometry.sun_direction_body;
            scene.evaluate(sun, geometry.panel_angles_rad, &mut workspace.shadow);
        }
        let mut sum = self.receive(geometry, workspace);
        sum.thermal = self.radiate(geometry, recoil, workspace);
        if let Some(cylinder) = &self.cylinder {
            sum.solar += cylinder.sunshade(&beam(geometry), &geometry.center_of_mass_body_m);
        }
        Ok(sum)
    }

    /// Recoil of heat anew for the light of the last evaluation, at other temperatures.
    ///
    /// # Errors
    /// Not one temperature for each face, or a workspace of another model.
    pub fn recoil<T: Scalar>(
        &self,
        geometry: &Geometry<'_, T>,
        recoil: Recoil<'_>,
        workspace: &mut Workspace<T>,
    ) -> Result<ForceTorque<T>, GeometryError> {
        self.check_temperatures(recoil)?;
        let (found, allowed) = (workspace.faces.len(), self.faces.faces.len());
        if found != allowed {
            return Err(GeometryError::Temperatures { found, allowed });
        }
        Ok(self.radiate(geometry, recoil, workspace))
    }

    fn check_temperatures(&self, recoil: Recoil<'_>) -> Result<(), GeometryError> {
        let allowed = self.faces.faces.len();
        match recoil {
            Recoil::Stored(temperatures_k) if temperatures_k.len() != allowed => {
                Err(GeometryError::Temperatures { found: temperatures_k.len(), allowed })
            }
            _ => Ok(()),
        }
    }

    /// Heat every face takes in, in W, as of the last evaluation: absorbed light and heat from inside. Written to
    /// `heat_w`, face by face, as far as both reach.
    pub fn heat_w(&self, workspace: &Workspace<f64>, heat_w: &mut [f64]) {
        for ((heat_w, state), face) in heat_w.iter_mut().zip(&workspace.faces).zip(&self.faces.faces) {
            *heat_w = state.absorbed_sun_w + state.absorbed_planet_w + face.internal_heat_w;
        }
    }

    fn turn_normals<T: Scalar>(&self, geometry: &Geometry<'_, T>, workspace: &mut Workspace<T>) {
        let turned = |panel: usize| match (self.panels.get(panel), geometry.panel_angles_rad.get(panel)) {
            (Some(panel), Some(angle_rad)) => panel.normal_body(*angle_rad),
            _ => Vector3::zeros(),
        };
        for (normal, source) in workspace.normals.iter_mut().zip(&self.faces.normals) {
            *normal = match *source {
                Normal::Fixed(fixed) => constant_vector(&fixed),
                Normal::Front(panel) => turned(panel),
                Normal::Rear(panel) => -turned(panel),
            };
        }
    }

    /// Planet light for every distinct normal.
    fn light_planet<T: Scalar>(
        &self,
        surface: Option<&PlanetSurface<T>>,
        geometry: &Geometry<'_, T>,
        workspace: &mut Workspace<T>,
    ) -> Result<(), GeometryError> {
        let (Some(surface), Some(planet)) = (surface, &geometry.planet) else {
            workspace.lights.fill(PlanetLight::dark());
            return Ok(());
        };
        let planet_source = self.planet_light.planet_source(surface, planet)?;
        for (index, normal) in workspace.normals.iter().enumerate() {
            // Panels that stand alike, or like a plate, see the same.
            let turns = !matches!(self.faces.normals[index], Normal::Fixed(_));
            let alike =
                turns.then(|| workspace.normals[..index].iter().position(|known| same(known, normal)));
            workspace.lights[index] = match alike.flatten() {
                Some(known) => workspace.lights[known],
                None => planet_source.receive(normal),
            };
        }
        Ok(())
    }

    /// Light on every face: solar, albedo and infrared force, absorbed power.
    fn receive<T: Scalar>(&self, geometry: &Geometry<'_, T>, workspace: &mut Workspace<T>) -> Disturbance<T> {
        let beam = beam(geometry);
        let mut sum = Disturbance::zero();
        for (face, state) in self.faces.faces.iter().zip(workspace.faces.iter_mut()) {
            let surface = &self.faces.surfaces[face.surface];
            let normal = &workspace.normals[face.normal];
            let light = &workspace.lights[face.normal];
            let center_m = constant_vector::<T>(&surface.center_body_m);
            let arm_m = center_m - geometry.center_of_mass_body_m;
            let area_m2 = T::constant(surface.area_m2);
            *state = FaceResult { lit_center_body_m: center_m, ..FaceResult::dark() };

            let sunlight = beam.received(normal);
            if sunlight.pressure_pa.value() > 0.0 {
                let shadowed = self.scene.as_ref().and(surface.outline).and_then(|o| workspace.shadow.lit(o));
                let (lit_area_m2, lit_center_m) = shadowed.unwrap_or((area_m2, center_m));
                state.lit_area_m2 = lit_area_m2;
                state.lit_center_body_m = lit_center_m;
                state.absorbed_sun_w =
                    sunlight.pressure_pa * lit_area_m2 * (face.optics.absorptivity * SPEED_OF_LIGHT_M_S);
                let force_n = force_per_area_pa(&face.optics, normal, &sunlight) * lit_area_m2;
                state.forces_body_n[0] = force_n;
                if !surface.closed_form_sun {
                    let lit_arm_m = lit_center_m - geometry.center_of_mass_body_m;
                    sum.solar += ForceTorque::at_arm(&lit_arm_m, force_n);
                }
            }
            if light.albedo.pressure_pa.value() != 0.0 || light.infrared.pressure_pa.value() != 0.0 {
                let infrared_optics = &face.thermal.infrared_optics;
                let albedo_n = force_per_area_pa(&face.optics, normal, &light.albedo) * area_m2;
                let infrared_n = force_per_area_pa(infrared_optics, normal, &light.infrared) * area_m2;
                state.forces_body_n[1] = albedo_n;
                state.forces_body_n[2] = infrared_n;
                sum.albedo += ForceTorque::at_arm(&arm_m, albedo_n);
                sum.infrared += ForceTorque::at_arm(&arm_m, infrared_n);
                let absorbed_pa = light.albedo.pressure_pa * face.optics.absorptivity
                    + light.infrared.pressure_pa * infrared_optics.absorptivity;
                state.absorbed_planet_w = absorbed_pa * (surface.area_m2 * SPEED_OF_LIGHT_M_S);
            }
        }
        sum
    }

    /// Temperatures and recoil of every surface.
    fn radiate<T: Scalar>(
        &self,
        geometry: &Geometry<'_, T>,
        recoil: Recoil<'_>,
        workspace: &mut Workspace<T>,
    ) -> ForceTorque<T> {
        let mut sum = ForceTorque::zero();
        for surface in &self.faces.surfaces {
            let range = surface.first_face..surface.first_face + if surface.two_sided { 2 } else { 1 };
            let faces = &self.faces.faces[range.clone()];
            let states = &mut workspace.faces[range.clone()];
            let stores = surface.thermal.heat_capacity_j_m2_k > 0.0;
            let stored = match recoil {
                Recoil::Stored(temperatures_k) if stores => Some(&temperatures_k[range]),
                _ => None,
            };
            let at_center = set_temperatures(surface, faces, states, stored);
            for (face, state) in faces.iter().zip(states) {
                let normal = &workspace.normals[face.normal];
                let radiated_w =
                    exitance_w_m2(&face.thermal.emission, state.temperature_k).0 * surface.area_m2;
                let center_m = constant_vector::<T>(&surface.center_body_m) - geometry.center_of_mass_body_m;
                // An insulated face gives off sunlight where it is absorbed, everything else evenly.
                let spread_w =
                    if at_center { radiated_w } else { state.absorbed_planet_w + face.internal_heat_w };
                let mut force_n = recoil_n(normal, spread_w);
                sum += ForceTorque::at_arm(&center_m, force_n);
                if !at_center {
                    let lit_n = recoil_n(normal, state.absorbed_sun_w);
                    let lit_center_m = state.lit_center_body_m - geometry.center_of_mass_body_m;
                    sum += ForceTorque::at_arm(&lit_center_m, lit_n);
                    force_n += lit_n;
                }
                state.forces_body_n[3] = force_n;
            }
        }
        sum
    }
}

/// Writes the temperatures of a surface's faces; tells whether the whole face radiates evenly.
fn set_temperatures<T: Scalar>(
    surface: &Surface,
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
        let emission = [front.thermal.emission, rear.thermal.emission];
        let heat_w_m2 = [heat(front, front_state), heat(rear, rear_state)];
        let [front_k, rear_k] = conducting_temperatures_k(&emission, conduction, heat_w_m2);
        front_state.temperature_k = front_k;
        rear_state.temperature_k = rear_k;
        return true;
    }
    for (face, state) in faces.iter().zip(states) {
        state.temperature_k = insulated_temperature_k(&face.thermal.emission, heat(face, state));
    }
    false
}

fn beam<T: Scalar>(geometry: &Geometry<'_, T>) -> Beam<T> {
    Beam {
        source_body: geometry.sun_direction_body,
        pressure_pa: geometry.sun_flux_w_m2 * geometry.lit_fraction * (1.0 / SPEED_OF_LIGHT_M_S),
    }
}

fn same<T: Scalar>(a: &Vector3<T>, b: &Vector3<T>) -> bool {
    a.iter().zip(b.iter()).all(|(a, b)| a.same(*b))
}
