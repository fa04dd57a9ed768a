//! Force and torque by source from where Sun and planet are: light and heat, dimmed by the planet's shadow, and the
//! gravity gradient. Positions and parameters may carry a seed, so that derivatives by all of them are exact.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::{gravity_gradient, magnetic};
use crate::aerodynamics::{AerodynamicModel, AerodynamicWorkspace, AirFlow, Walls};
use crate::bodies::surface::PlanetSurface;
use crate::environment::eclipse::{EclipseError, Shadow};
use crate::loads::{Active, Effect, Loads};
use crate::numerics::scalar::{Scalar, scratch};
use crate::plant::settings::laws::Laws;
use crate::radiation::disturbance::{self, DisturbanceModel, Geometry, Recoil};
use crate::refusal::Refusal;
use crate::spacecraft::Material;

/// Positions, directions, air and field, body frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Positions<T> {
    /// From the spacecraft to the Sun, in m; zero = there is no light yet, and nothing acts.
    pub sun_m: [T; 3],
    /// From the spacecraft to the planet's centre, in m; zero = there is no planet.
    pub planet_m: [T; 3],
    /// North of the planet's cells, of any length; zero = -Z.
    pub pole: [T; 3],
    /// Centre of mass, in m.
    pub center_of_mass_m: [T; 3],
    /// The air about the spacecraft: density in kg/m3, zero = none, temperature in K, molar mass in kg/mol.
    pub air: [T; 3],
    /// Velocity relative to the air, in m/s.
    pub air_velocity_m_s: [T; 3],
    /// Magnetic field, in T.
    pub field_t: [T; 3],
    /// Angle of every panel about its axis, in rad.
    pub panel_angles_rad: Vec<T>,
}

/// Parameters of forces and torques.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters<T: Scalar> {
    /// The Sun's flux at 1 AU, in W/m2.
    pub flux_at_1_au_w_m2: T,
    /// Factor of force and torque of direct sunlight.
    pub solar_scale: T,
    /// The Sun's radius, in m.
    pub sun_radius_m: T,
    /// Inertia about the centre of mass, body frame, in kg m2.
    pub inertia_body_kg_m2: Matrix3<T>,
    /// The planet's surface.
    pub planet: PlanetSurface<T>,
    /// Parameters of the effects in closed form.
    pub laws: Laws<T>,
}

/// Spacecraft as prepared for light and air.
#[derive(Clone, Copy, Debug)]
pub struct Surfaces<'a, T: Scalar> {
    /// In light.
    pub light: &'a DisturbanceModel,
    /// In air, where that acts.
    pub air: Option<&'a AerodynamicModel>,
    /// Materials, in the order of [`DisturbanceModel::materials`].
    pub materials: &'a [Material<T>],
    /// The effects that act.
    pub active: Active,
    /// Whether temperatures of the faces count, even where their recoil does not.
    pub needs_temperatures: bool,
}

scratch! {
/// Scratch space of the models of light and air.
pub struct Workspaces<T: Scalar> {
    /// In light.
    pub light: disturbance::Workspace<T>,
    /// In air.
    pub air: AerodynamicWorkspace<T>,
    /// Temperatures of the faces, in K.
    face_temperatures_k: Vec<T>,
}
}

/// Everything computed from one set of positions, but for the faces, which are in the workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BySource<T: Scalar> {
    /// The effects that act.
    pub active: Active,
    /// Force and torque by effect.
    pub loads: Loads<T>,
    /// Visible fraction of the Sun's disc.
    pub lit_fraction: T,
}

/// Positions without meaning.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PositionError {
    /// The shadow cannot be computed.
    #[error(transparent)]
    Eclipse(#[from] EclipseError),
    /// Light and heat cannot be computed.
    #[error(transparent)]
    Geometry(#[from] Refusal),
}

impl<T> Positions<T> {
    /// Every vector.
    fn vectors(&self) -> [&[T; 3]; 7] {
        let Self { sun_m, planet_m, pole, center_of_mass_m, air, air_velocity_m_s, field_t, .. } = self;
        [sun_m, planet_m, pole, center_of_mass_m, air, air_velocity_m_s, field_t]
    }

    /// Every number.
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.vectors().into_iter().flatten().chain(&self.panel_angles_rad)
    }

    /// Changes every number by the one in its place of `others`.
    pub fn update<U>(&mut self, others: &Positions<U>, change: impl Fn(&mut T, &U)) {
        let Self { sun_m, planet_m, pole, center_of_mass_m, air, air_velocity_m_s, field_t, .. } = self;
        let vectors = [sun_m, planet_m, pole, center_of_mass_m, air, air_velocity_m_s, field_t];
        // Vector by vector: one chain of all of them is slower.
        for (own, others) in vectors.into_iter().zip(others.vectors()) {
            own.iter_mut().zip(others).for_each(|(own, other)| change(own, other));
        }
        let angles = self.panel_angles_rad.iter_mut().zip(&others.panel_angles_rad);
        angles.for_each(|(own, other)| change(own, other));
    }

    /// Applies `of` to every number.
    pub fn map<U>(&self, of: impl Fn(&T) -> U) -> Positions<U> {
        Positions {
            sun_m: self.sun_m.each_ref().map(&of),
            planet_m: self.planet_m.each_ref().map(&of),
            pole: self.pole.each_ref().map(&of),
            center_of_mass_m: self.center_of_mass_m.each_ref().map(&of),
            air: self.air.each_ref().map(&of),
            air_velocity_m_s: self.air_velocity_m_s.each_ref().map(&of),
            field_t: self.field_t.each_ref().map(&of),
            panel_angles_rad: self.panel_angles_rad.iter().map(&of).collect(),
        }
    }
}

impl<T: Scalar> BySource<T> {
    /// At these positions, with these parameters, by the model's light and heat, the effects that act, and the planet's
    /// shadow; without a shadow there is no planet. The parameters' planet counts in place of the model's.
    ///
    /// # Errors
    /// The spacecraft inside planet or Sun, positions that are no numbers.
    pub fn at(
        Surfaces { light: model, air, materials, active, needs_temperatures }: Surfaces<'_, T>,
        shadow: Option<&Shadow>,
        parameters: &Parameters<T>,
        positions: &Positions<T>,
        Workspaces { light: workspace, air: air_workspace, face_temperatures_k }: &mut Workspaces<T>,
    ) -> Result<Self, PositionError> {
        let sun_m = Vector3::from(positions.sun_m);
        if is_zero(&sun_m) {
            workspace.darken(model.face_count());
            return Ok(Self { active, loads: Loads::zero(), lit_fraction: T::constant(0.0) });
        }
        let (distance_m, radius_m) = (sun_m.norm().value(), parameters.sun_radius_m.value());
        if distance_m <= radius_m {
            return Err(EclipseError::InsideSun { distance_m, radius_m }.into());
        }
        let shadow = shadow.filter(|_| !is_zero(&Vector3::from(positions.planet_m)));
        let planet_m = shadow.map(|_| Vector3::from(positions.planet_m));
        let lit_fraction = match (shadow, &planet_m) {
            (Some(shadow), Some(planet_m)) => shadow.lit_fraction_of(
                [parameters.planet.radius_m, parameters.sun_radius_m],
                &-planet_m,
                &(sun_m - planet_m),
            )?,
            _ => T::constant(1.0),
        };
        let mut geometry = Geometry::at(
            parameters.flux_at_1_au_w_m2,
            &sun_m,
            planet_m.as_ref(),
            lit_fraction,
            &positions.panel_angles_rad,
            Vector3::from(positions.center_of_mass_m),
        )?
        .with_sun_radius(parameters.sun_radius_m);
        geometry.solar_scale = parameters.solar_scale;
        let pole_body = Some(Vector3::from(positions.pole)).filter(|it| !is_zero(it));
        if let Some(planet) = &mut geometry.planet {
            planet.pole_body = pole_body;
        }
        let planet = shadow.filter(|_| active.has(Effect::Albedo)).map(|_| &parameters.planet);
        let is_warm = needs_temperatures || active.has(Effect::Thermal);
        let recoil = if is_warm { Recoil::Balance } else { Recoil::Ignored };
        let light = model.evaluate_on(planet, Some(materials), &geometry, recoil, workspace)?;
        let mut loads = light.of_active(active);
        let [density_kg_m3, temperature_k, molar_mass_kg_mol] = positions.air;
        let velocity_body_m_s = Vector3::from(positions.air_velocity_m_s);
        let flow = AirFlow { density_kg_m3, temperature_k, molar_mass_kg_mol, velocity_body_m_s };
        if let Some(model) = air.filter(|_| density_kg_m3.value() > 0.0 && active.has(Effect::Aerodynamic)) {
            let center = Vector3::from(positions.center_of_mass_m);
            let temperatures_k = active.has(Effect::Thermal).then(|| {
                face_temperatures_k.clear();
                face_temperatures_k.extend(workspace.faces().iter().map(|face| face.temperature_k));
                face_temperatures_k.as_slice()
            });
            let walls = Walls { temperatures_k, materials: Some(materials) };
            let load = model.load(&flow, &positions.panel_angles_rad, &center, walls, air_workspace);
            loads[Effect::Aerodynamic] = load;
        }
        let Parameters { laws, inertia_body_kg_m2, .. } = parameters;
        if let Some(planet_body_m) = planet_m.filter(|_| active.has(Effect::GravityGradient)) {
            let pole_body = || pole_body.map_or_else(|| -Vector3::z(), |pole| pole.normalize());
            loads[Effect::GravityGradient].torque_body_n_m =
                gravity_gradient::torque_n_m(laws, inertia_body_kg_m2, &planet_body_m, pole_body);
        }
        if active.has(Effect::Magnetic) {
            let field_body_t = Vector3::from(positions.field_t);
            loads[Effect::Magnetic].torque_body_n_m =
                magnetic::torque_n_m(&laws.dipole_body_a_m2, &field_body_t);
        }
        Ok(Self { active, loads, lit_fraction })
    }
}

/// Whether a vector has no value, whatever its derivatives.
fn is_zero<T: Scalar>(vector: &Vector3<T>) -> bool {
    vector.iter().all(|x| x.value() == 0.0)
}
