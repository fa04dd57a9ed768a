//! From parameters to a prepared model, and from inputs to an outcome.

use fmi_export::{Failure, Real, Values};
use nalgebra::{Matrix3, Vector3};
use physics::attitude::gravity_gradient_n_m;
use physics::environment::eclipse::{Shadow, ShadowModel};
use physics::numerics::scalar::{Dual64, Scalar};
use physics::radiation::disturbance::{
    Disturbance, DisturbanceModel, Geometry, Options, PlanetLightMethod, Recoil, Workspace,
};
use physics::radiation::grid::CellLayout;
use physics::spacecraft::{self, Spacecraft};
use serde::{Deserialize, Serialize};

use super::Plan;
use super::variables::{DisturbanceVariables, PlanetMethod, RadiationVariables};
use crate::momentum_plant::choices::{EclipseModel, SunshadeModel};
use crate::shared::inertia_body_kg_m2;

/// What parameters and spacecraft amount to.
#[derive(Clone, Debug)]
pub struct Prepared {
    model: DisturbanceModel,
    /// Absent without a planet.
    shadow: Option<Shadow>,
    flux_at_1_au_w_m2: f64,
    gm_m3_s2: f64,
    inertia_body_kg_m2: Matrix3<f64>,
}

/// The Real inputs.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Inputs<T> {
    sun_m: [T; 3],
    planet_m: [T; 3],
    pole: [T; 3],
    center_of_mass_m: [T; 3],
    pub panel_angles_rad: Vec<T>,
}

/// Everything computed from one set of inputs, but for the faces, which are in the workspace.
#[derive(Clone, Copy, Debug)]
pub struct Outcome<T: Scalar> {
    pub disturbance: Disturbance<T>,
    pub gravity_gradient_n_m: Vector3<T>,
    pub lit_fraction: T,
}

impl Inputs<f64> {
    /// From a source of values.
    pub fn read(variables: &DisturbanceVariables, value: impl Fn(Real) -> f64) -> Self {
        let mut inputs = Self {
            sun_m: [0.0; 3],
            planet_m: [0.0; 3],
            pole: [0.0; 3],
            center_of_mass_m: [0.0; 3],
            panel_angles_rad: vec![0.0; variables.panel.len()],
        };
        inputs.refresh(variables, value);
        inputs
    }

    /// Takes every value anew, without allocation.
    pub fn refresh(&mut self, variables: &DisturbanceVariables, value: impl Fn(Real) -> f64) {
        for i in 0..3 {
            self.sun_m[i] = value(variables.sun.position.element(i));
            self.planet_m[i] = value(variables.planet.position.element(i));
            self.pole[i] = value(variables.planet.pole.element(i));
            self.center_of_mass_m[i] = value(variables.center_of_mass.element(i));
        }
        for (angle_rad, panel) in self.panel_angles_rad.iter_mut().zip(&variables.panel) {
            *angle_rad = value(panel.angle);
        }
    }

    /// The same inputs as dual numbers; `along` gives an input's seed by its value reference.
    pub fn with_seed(&self, variables: &DisturbanceVariables, along: impl Fn(u32) -> f64) -> Inputs<Dual64> {
        let dual = |value: f64, handle: Real| Dual64::new(value, along(handle.reference()));
        let angles = self.panel_angles_rad.iter().zip(&variables.panel);
        Inputs {
            sun_m: core::array::from_fn(|i| dual(self.sun_m[i], variables.sun.position.element(i))),
            planet_m: core::array::from_fn(|i| dual(self.planet_m[i], variables.planet.position.element(i))),
            pole: core::array::from_fn(|i| dual(self.pole[i], variables.planet.pole.element(i))),
            center_of_mass_m: core::array::from_fn(|i| {
                dual(self.center_of_mass_m[i], variables.center_of_mass.element(i))
            }),
            panel_angles_rad: angles.map(|(angle_rad, panel)| dual(*angle_rad, panel.angle)).collect(),
        }
    }
}

impl<T> Inputs<T> {
    /// Whether a value reference is one of the inputs.
    pub fn has(variables: &DisturbanceVariables, reference: u32) -> bool {
        let planet = &variables.planet;
        let vectors = [variables.sun.position, planet.position, planet.pole, variables.center_of_mass];
        vectors.iter().any(|v| (v.reference()..v.reference() + 3).contains(&reference))
            || variables.panel.iter().any(|panel| panel.angle.reference() == reference)
    }
}

fn method(
    values: &Values,
    radiation: &RadiationVariables,
    spacecraft: &Spacecraft,
) -> Result<PlanetLightMethod, Failure> {
    let count = |handle| usize::try_from(values.integer(handle)).unwrap_or(0);
    Ok(match values.choice(radiation.method) {
        Some(PlanetMethod::Cells) => PlanetLightMethod::Cells(CellLayout::Corrected, count(radiation.belts)),
        Some(PlanetMethod::CellsAsPrinted) => {
            PlanetLightMethod::Cells(CellLayout::AsPrinted, count(radiation.belts))
        }
        Some(PlanetMethod::Map) => {
            PlanetLightMethod::Map(spacecraft.planet_map.clone().ok_or_else(|| {
                Failure::new(
                    "radiation.method is map, allowed only where the spacecraft's file has a planet_map",
                )
            })?)
        }
        Some(PlanetMethod::Rings) | None => PlanetLightMethod::Rings(count(radiation.nodes)),
    })
}

impl Prepared {
    /// From the parameters.
    ///
    /// # Errors
    /// Names the parameter that cannot be.
    pub fn new(context: &Plan<'_>, values: &Values) -> Result<Self, Failure> {
        let variables = context.variables;
        let spacecraft = &context.setup.spacecraft;
        let planet = &variables.planet;
        let present = values.boolean(planet.present);
        let surface = planet.surface.read(values, planet.radius);
        let sunshade_model = values.choice(variables.sunshade.model).map(|model| match model {
            SunshadeModel::Plates => spacecraft::SunshadeModel::Plates,
            SunshadeModel::Cylinder => spacecraft::SunshadeModel::Cylinder,
        });
        let options = Options {
            planet: present.then_some(surface),
            planet_light: method(values, &variables.radiation, spacecraft)?,
            self_shadowing: values.boolean(variables.radiation.self_shadowing),
            sunshade_model: sunshade_model.filter(|_| spacecraft.sunshade.is_some()),
        };
        let shadow_model = match values.choice(variables.eclipse.model) {
            Some(EclipseModel::Cone) => ShadowModel::AllOrNothingCone,
            Some(EclipseModel::Cylinder) => ShadowModel::AllOrNothingCylinder,
            Some(EclipseModel::Off) => ShadowModel::Off,
            Some(EclipseModel::Discs) | None => ShadowModel::DiscOverlap,
        };
        let failure = |error: &dyn core::fmt::Display| Failure::new(error.to_string());
        let shadow = Shadow::new(shadow_model, surface.radius_m)
            .map_err(|error| Failure::new(format!("planet.radius: {error}")))?;
        let inertia_body_kg_m2 = inertia_body_kg_m2(values, variables.spacecraft.inertia)?;
        Ok(Self {
            model: DisturbanceModel::new(spacecraft, &options).map_err(|error| failure(&error))?,
            shadow: present.then_some(shadow),
            flux_at_1_au_w_m2: values.real(variables.solar.flux),
            gm_m3_s2: values.real(planet.gravitational_parameter),
            inertia_body_kg_m2,
        })
    }

    /// Everything at these inputs.
    ///
    /// # Errors
    /// A geometry without meaning: the spacecraft inside planet or Sun, positions that are no numbers.
    pub fn evaluate<T: Scalar>(
        &self,
        inputs: &Inputs<T>,
        workspace: &mut Workspace<T>,
    ) -> Result<Outcome<T>, Failure> {
        let sun_m = Vector3::from(inputs.sun_m);
        let planet_m = self.shadow.map(|_| Vector3::from(inputs.planet_m));
        let (lit_fraction, gravity_gradient_n_m) = match (&self.shadow, &planet_m) {
            (Some(shadow), Some(planet_m)) => {
                let lit_fraction = shadow.lit_fraction(&-planet_m, &(sun_m - planet_m)).map_err(|error| {
                    Failure::new(format!("sun.position, planet.position, planet.radius: {error}"))
                })?;
                let torque = gravity_gradient_n_m(self.gm_m3_s2, &self.inertia_body_kg_m2, planet_m);
                (lit_fraction, torque)
            }
            _ => (T::constant(1.0), Vector3::zeros()),
        };
        let refused = |error| Failure::new(format!("sun.position, planet.position, planet.pole: {error}"));
        let mut geometry = Geometry::at(
            self.flux_at_1_au_w_m2,
            &sun_m,
            planet_m.as_ref(),
            lit_fraction,
            &inputs.panel_angles_rad,
            Vector3::from(inputs.center_of_mass_m),
        )
        .map_err(refused)?;
        if let Some(planet) = &mut geometry.planet {
            planet.pole_body = Vector3::from(inputs.pole);
        }
        let disturbance = self.model.evaluate(&geometry, Recoil::Balance, workspace).map_err(refused)?;
        Ok(Outcome { disturbance, gravity_gradient_n_m, lit_fraction })
    }
}
