//! Force and torque by source from where Sun and planet are: light and heat, dimmed by the planet's shadow, and the
//! gravity gradient. Positions and parameters may carry a seed, so that derivatives by all of them are exact.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::geometry::{Geometry, GeometryError, Recoil};
use super::model::DisturbanceModel;
use super::workspace::{Disturbance, Workspace};
use crate::attitude::gravity_gradient_n_m;
use crate::bodies::surface::PlanetSurface;
use crate::environment::eclipse::{EclipseError, Shadow};
use crate::numerics::scalar::Scalar;
use crate::radiation::force_torque::ForceTorque;

/// Where everything is, body frame.
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
    /// Angle of every panel about its axis, in rad.
    pub panel_angles_rad: Vec<T>,
}

/// What else forces and torques follow from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters<T: Scalar> {
    /// The Sun's flux at 1 AU, in W/m2.
    pub flux_at_1_au_w_m2: T,
    /// The Sun's radius, in m.
    pub sun_radius_m: T,
    /// Gravitational parameter of the planet, in m3/s2.
    pub gm_m3_s2: T,
    /// Inertia about the centre of mass, body frame, in kg m2.
    pub inertia_body_kg_m2: Matrix3<T>,
    /// The planet's surface.
    pub planet: PlanetSurface<T>,
}

/// Which effects act beside sunlight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActiveEffects {
    /// Whether light of the planet acts and heats.
    pub planet_light: bool,
    /// Whether the recoil of radiated heat acts.
    pub recoil: bool,
    /// Whether the planet's gravity gradient acts.
    pub gravity_gradient: bool,
}

/// Everything computed from one set of positions, but for the faces, which are in the workspace.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BySource<T: Scalar> {
    /// Light and heat.
    pub disturbance: Disturbance<T>,
    /// Torque of the planet's gravity gradient, body frame, in N m.
    pub gravity_gradient_n_m: Vector3<T>,
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
    Geometry(#[from] GeometryError),
}

impl Positions<f64> {
    /// Whether all are finite numbers.
    pub fn is_finite(&self) -> bool {
        let vectors = [&self.sun_m, &self.planet_m, &self.pole, &self.center_of_mass_m];
        vectors.into_iter().flatten().chain(&self.panel_angles_rad).all(|x| x.is_finite())
    }
}

impl<T: Scalar> BySource<T> {
    /// Force of all sources, body frame, in N.
    pub fn total_force_body_n(&self) -> Vector3<T> {
        self.disturbance.total().force_body_n
    }

    /// Torque of all sources about the centre of mass, body frame, in N m.
    pub fn total_torque_body_n_m(&self) -> Vector3<T> {
        self.disturbance.total().torque_body_n_m + self.gravity_gradient_n_m
    }

    /// Whether total force and torque are finite numbers.
    pub fn is_finite(&self) -> bool {
        let (force, torque) = (self.total_force_body_n(), self.total_torque_body_n_m());
        force.iter().chain(&torque).all(|x| x.value().is_finite())
    }

    /// At these positions, with these parameters, by the model's light and heat, of which these effects act, and the planet's
    /// shadow; without a shadow there is no planet. The parameters' planet counts in place of the model's.
    ///
    /// # Errors
    /// The spacecraft inside planet or Sun, positions that are no numbers.
    pub fn at(
        (model, effects): (&DisturbanceModel, ActiveEffects),
        shadow: Option<&Shadow>,
        parameters: &Parameters<T>,
        positions: &Positions<T>,
        workspace: &mut Workspace<T>,
    ) -> Result<Self, PositionError> {
        let sun_m = Vector3::from(positions.sun_m);
        if is_zero(&sun_m) {
            workspace.darken(model.face_count());
            return Ok(Self {
                disturbance: Disturbance::zero(),
                gravity_gradient_n_m: Vector3::zeros(),
                lit_fraction: T::constant(0.0),
            });
        }
        let shadow = shadow.filter(|_| !is_zero(&Vector3::from(positions.planet_m)));
        let planet_m = shadow.map(|_| Vector3::from(positions.planet_m));
        let (lit_fraction, gravity_gradient_n_m) = match (shadow, &planet_m) {
            (Some(shadow), Some(planet_m)) => (
                shadow.lit_fraction_of(
                    [parameters.planet.radius_m, parameters.sun_radius_m],
                    &-planet_m,
                    &(sun_m - planet_m),
                )?,
                if effects.gravity_gradient {
                    gravity_gradient_n_m(parameters.gm_m3_s2, &parameters.inertia_body_kg_m2, planet_m)
                } else {
                    Vector3::zeros()
                },
            ),
            _ => (T::constant(1.0), Vector3::zeros()),
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
        if let Some(planet) = &mut geometry.planet {
            let pole = Vector3::from(positions.pole);
            planet.pole_body = if is_zero(&pole) { -Vector3::z() } else { pole };
        }
        let planet = shadow.filter(|_| effects.planet_light).map(|_| &parameters.planet);
        let mut disturbance = model.evaluate_on(planet, &geometry, Recoil::Balance, workspace)?;
        if !effects.recoil {
            disturbance.thermal = ForceTorque::zero();
            workspace.leave_out_recoil();
        }
        Ok(Self { disturbance, gravity_gradient_n_m, lit_fraction })
    }
}

/// Whether a vector has no value, whatever its derivatives.
fn is_zero<T: Scalar>(vector: &Vector3<T>) -> bool {
    vector.iter().all(|x| x.value() == 0.0)
}
