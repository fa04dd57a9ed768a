//! From parameters to a prepared model, and from inputs to an outcome.

use fmi_export::{Failure, Real, Values};
use nalgebra::{Matrix3, Vector3};
use physics::attitude::gravity_gradient_n_m;
use physics::bodies::surface::PlanetSurface;
use physics::environment::eclipse::{Shadow, ShadowModel};
use physics::numerics::scalar::{Dual64, Scalar};
use physics::radiation::disturbance::{
    Disturbance, DisturbanceModel, Geometry, Options, PlanetLightMethod, Recoil, Workspace,
};
use physics::radiation::grid::CellLayout;
use physics::spacecraft::{self, Spacecraft};
use serde::{Deserialize, Serialize};

use super::Plan;
use super::variables::{DisturbanceVariables, PlanetLightVariables, PlanetMethod};
use crate::momentum_plant::choices::{EclipseMethod, SunshadeShape};
use crate::shared::inertia_body_kg_m2;

/// What parameters and spacecraft amount to.
#[derive(Clone, Debug)]
pub struct Prepared {
    model: DisturbanceModel,
    /// Absent without a planet.
    shadow: Option<Shadow>,
    pub parameters: Parameters<f64>,
}

/// The Real parameters.
#[derive(Clone, Debug)]
pub struct Parameters<T> {
    flux_at_1_au_w_m2: T,
    gm_m3_s2: T,
    inertia_body_kg_m2: Matrix3<T>,
    planet: PlanetSurface<T>,
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
            self.sun_m[i] = value(variables.sun.position_body.element(i));
            self.planet_m[i] = value(variables.planet.position_body.element(i));
            self.pole[i] = value(variables.planet.pole.element(i));
            self.center_of_mass_m[i] = value(variables.spacecraft.center_of_mass.element(i));
        }
        for (angle_rad, panel) in self.panel_angles_rad.iter_mut().zip(&variables.panel) {
            *angle_rad = value(panel.angle);
        }
    }

    /// Whether all are finite numbers.
    pub fn is_finite(&self) -> bool {
        let vectors = [&self.sun_m, &self.planet_m, &self.pole, &self.center_of_mass_m];
        vectors.into_iter().flatten().chain(&self.panel_angles_rad).all(|x| x.is_finite())
    }

    /// The same inputs as dual numbers; `along` gives an input's seed.
    pub fn with_seed(&self, variables: &DisturbanceVariables, along: impl Fn(Real) -> f64) -> Inputs<Dual64> {
        let dual = |value: f64, handle: Real| Dual64::new(value, along(handle));
        let angles = self.panel_angles_rad.iter().zip(&variables.panel);
        Inputs {
            sun_m: core::array::from_fn(|i| dual(self.sun_m[i], variables.sun.position_body.element(i))),
            planet_m: core::array::from_fn(|i| {
                dual(self.planet_m[i], variables.planet.position_body.element(i))
            }),
            pole: core::array::from_fn(|i| dual(self.pole[i], variables.planet.pole.element(i))),
            center_of_mass_m: core::array::from_fn(|i| {
                dual(self.center_of_mass_m[i], variables.spacecraft.center_of_mass.element(i))
            }),
            panel_angles_rad: angles.map(|(angle_rad, panel)| dual(*angle_rad, panel.angle)).collect(),
        }
    }
}

impl<T> Inputs<T> {
    /// Whether a Real is one of the inputs.
    pub fn has(variables: &DisturbanceVariables, real: Real) -> bool {
        let planet = &variables.planet;
        let vectors = [
            variables.sun.position_body,
            planet.position_body,
            planet.pole,
            variables.spacecraft.center_of_mass,
        ];
        vectors.iter().any(|vector| vector.index_of(real).is_some())
            || variables.panel.iter().any(|panel| panel.angle == real)
    }
}

impl Parameters<f64> {
    /// The same parameters as dual numbers; `along` gives a parameter's seed.
    pub fn with_seed(
        &self,
        variables: &DisturbanceVariables,
        along: impl Fn(Real) -> f64,
    ) -> Parameters<Dual64> {
        let dual = |value: f64, handle: Real| Dual64::new(value, along(handle));
        let (planet, surface) = (&variables.planet, &self.planet);
        let inertia = |i: usize, j: usize| {
            dual(self.inertia_body_kg_m2[(i, j)], variables.spacecraft.inertia.element(i, j))
        };
        Parameters {
            flux_at_1_au_w_m2: dual(self.flux_at_1_au_w_m2, variables.solar.flux),
            gm_m3_s2: dual(self.gm_m3_s2, planet.gravitational_parameter),
            inertia_body_kg_m2: Matrix3::from_fn(inertia),
            planet: PlanetSurface {
                radius_m: dual(surface.radius_m, planet.radius),
                absorptivity: dual(surface.absorptivity, planet.surface.absorptivity),
                diffuse_reflectivity: dual(surface.diffuse_reflectivity, planet.surface.diffuse_reflectivity),
                emissivity: dual(surface.emissivity, planet.surface.emissivity),
                night_temperature_k: dual(surface.night_temperature_k, planet.surface.night_temperature),
                day_temperature: surface.day_temperature,
            },
        }
    }
}

impl<T> Parameters<T> {
    /// Whether a Real is one of the parameters.
    pub fn has(variables: &DisturbanceVariables, real: Real) -> bool {
        let planet = &variables.planet;
        let surface = &planet.surface;
        let numbers = [
            variables.solar.flux,
            planet.gravitational_parameter,
            planet.radius,
            surface.absorptivity,
            surface.diffuse_reflectivity,
            surface.emissivity,
            surface.night_temperature,
        ];
        numbers.contains(&real) || variables.spacecraft.inertia.index_of(real).is_some()
    }
}

fn method(
    values: &Values,
    light: &PlanetLightVariables,
    spacecraft: &Spacecraft,
) -> Result<PlanetLightMethod, Failure> {
    let count = |handle| usize::try_from(values.integer(handle)).unwrap_or(0);
    Ok(match values.choice(light.method) {
        Some(PlanetMethod::Cells) => PlanetLightMethod::Cells(CellLayout::Corrected, count(light.belts)),
        Some(PlanetMethod::Map) => {
            PlanetLightMethod::Map(spacecraft.planet_map.clone().ok_or_else(|| {
                Failure::new(
                    "planetLight.method is map, allowed only where the spacecraft's file has a planet_map",
                )
            })?)
        }
        Some(PlanetMethod::Rings) | None => PlanetLightMethod::Rings(count(light.nodes)),
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
        let sunshade_model = values.choice(variables.sunshade.shape).map(|model| match model {
            SunshadeShape::Plates => spacecraft::SunshadeModel::Plates,
            SunshadeShape::Cylinder => spacecraft::SunshadeModel::Cylinder,
        });
        let options = Options {
            planet: present.then_some(surface),
            planet_light: method(values, &variables.planet_light, spacecraft)?,
            self_shadowing: values.boolean(variables.shadowing.enabled),
            sunshade_model: sunshade_model.filter(|_| spacecraft.sunshade.is_some()),
        };
        let shadow_model = match values.choice(variables.eclipse.method) {
            Some(EclipseMethod::Cone) => ShadowModel::AllOrNothingCone,
            Some(EclipseMethod::Cylinder) => ShadowModel::AllOrNothingCylinder,
            Some(EclipseMethod::Off) => ShadowModel::Off,
            Some(EclipseMethod::Discs) | None => ShadowModel::DiscOverlap,
        };
        let failure = |error: &dyn core::fmt::Display| Failure::new(error.to_string());
        let shadow = Shadow::new(shadow_model, surface.radius_m)
            .map_err(|error| Failure::new(format!("planet.radius: {error}")))?;
        let inertia_body_kg_m2 = inertia_body_kg_m2(values, variables.spacecraft.inertia)?;
        Ok(Self {
            model: DisturbanceModel::new(spacecraft, &options).map_err(|error| failure(&error))?,
            shadow: present.then_some(shadow),
            parameters: Parameters {
                flux_at_1_au_w_m2: values.real(variables.solar.flux),
                gm_m3_s2: values.real(planet.gravitational_parameter),
                inertia_body_kg_m2,
                planet: surface,
            },
        })
    }

    /// The inputs that are all zero, as before a master's first exchange.
    pub fn unset(&self, inputs: &Inputs<f64>) -> Vec<&'static str> {
        let places = [
            (true, inputs.sun_m, "sun.positionBody"),
            (self.shadow.is_some(), inputs.planet_m, "planet.positionBody"),
        ];
        places
            .into_iter()
            .filter(|(counts, at, _)| *counts && *at == [0.0; 3])
            .map(|(_, _, name)| name)
            .collect()
    }

    /// Everything at these inputs, with these parameters: its own, which may carry a seed. A Sun at zero means that there is
    /// no light yet and nothing acts, a planet at zero that there is no planet, a pole of zero is -Z.
    ///
    /// # Errors
    /// A geometry without meaning: the spacecraft inside planet or Sun, positions that are no numbers.
    pub fn evaluate<T: Scalar>(
        &self,
        parameters: &Parameters<T>,
        inputs: &Inputs<T>,
        workspace: &mut Workspace<T>,
    ) -> Result<Outcome<T>, Failure> {
        let sun_m = Vector3::from(inputs.sun_m);
        if is_zero(&sun_m) {
            workspace.darken(self.model.face_count());
            let nothing = Vector3::zeros();
            let lit_fraction = T::constant(0.0);
            return Ok(Outcome {
                disturbance: Disturbance::zero(),
                gravity_gradient_n_m: nothing,
                lit_fraction,
            });
        }
        let shadow = self.shadow.filter(|_| !is_zero(&Vector3::from(inputs.planet_m)));
        let planet_m = shadow.map(|_| Vector3::from(inputs.planet_m));
        let (lit_fraction, gravity_gradient_n_m) = match (&shadow, &planet_m) {
            (Some(shadow), Some(planet_m)) => {
                let lit_fraction =
                    shadow.lit_fraction_of(parameters.planet.radius_m, &-planet_m, &(sun_m - planet_m));
                let lit_fraction = lit_fraction.map_err(|error| {
                    Failure::new(format!("sun.positionBody, planet.positionBody, planet.radius: {error}"))
                })?;
                let torque =
                    gravity_gradient_n_m(parameters.gm_m3_s2, &parameters.inertia_body_kg_m2, planet_m);
                (lit_fraction, torque)
            }
            _ => (T::constant(1.0), Vector3::zeros()),
        };
        let refused =
            |error| Failure::new(format!("sun.positionBody, planet.positionBody, planet.pole: {error}"));
        let mut geometry = Geometry::at(
            parameters.flux_at_1_au_w_m2,
            &sun_m,
            planet_m.as_ref(),
            lit_fraction,
            &inputs.panel_angles_rad,
            Vector3::from(inputs.center_of_mass_m),
        )
        .map_err(refused)?;
        if let Some(planet) = &mut geometry.planet {
            let pole = Vector3::from(inputs.pole);
            planet.pole_body = if is_zero(&pole) { -Vector3::z() } else { pole };
        }
        let planet = shadow.map(|_| &parameters.planet);
        let disturbance =
            self.model.evaluate_on(planet, &geometry, Recoil::Balance, workspace).map_err(refused)?;
        Ok(Outcome { disturbance, gravity_gradient_n_m, lit_fraction })
    }
}

/// Whether a vector has no value, whatever its derivatives.
fn is_zero<T: Scalar>(vector: &Vector3<T>) -> bool {
    vector.iter().all(|x| x.value() == 0.0)
}
