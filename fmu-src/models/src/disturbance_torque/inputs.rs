//! From parameters to a prepared model, and from inputs to positions.

use fmi_export::{Failure, Real, RealVector, Values};
use nalgebra::Matrix3;
use physics::bodies::surface::PlanetSurface;
use physics::environment::eclipse::Shadow;
use physics::numerics::scalar::{Dual64, Scalar};
use physics::radiation::disturbance::{
    ActiveEffects, BySource, DisturbanceModel, ModelError, Options, Parameters, PlanetLightMethod,
    PositionError, Positions, Workspace,
};
use physics::spacecraft::Spacecraft;

use super::setup::Plan;
use super::variables::{DisturbanceVariables, PlanetLightVariables, PlanetMethod};
use crate::common::effects::unused_map;
use crate::common::spacecraft::inertia_body_kg_m2;

/// What parameters and spacecraft amount to.
#[derive(Clone, Debug)]
pub struct Prepared {
    model: DisturbanceModel,
    /// Absent without a planet.
    shadow: Option<Shadow>,
    pub parameters: Parameters<f64>,
    effects: ActiveEffects,
}

/// The vectors among the inputs, in the order of [`Positions`].
fn vectors(variables: &DisturbanceVariables) -> [RealVector<3>; 4] {
    let planet = &variables.planet;
    [variables.sun.position_body, planet.position_body, planet.pole, variables.spacecraft.center_of_mass]
}

/// The inputs from a source of values.
pub fn positions(variables: &DisturbanceVariables, value: impl Fn(Real) -> f64) -> Positions<f64> {
    let [sun_m, planet_m, pole, center_of_mass_m] = [[0.0; 3]; 4];
    let panel_angles_rad = vec![0.0; variables.panel.len()];
    let mut positions = Positions { sun_m, planet_m, pole, center_of_mass_m, panel_angles_rad };
    refresh(&mut positions, variables, value);
    positions
}

/// Takes every input anew, without allocation.
pub fn refresh(
    positions: &mut Positions<f64>,
    variables: &DisturbanceVariables,
    value: impl Fn(Real) -> f64,
) {
    let vector = |handle: RealVector<3>| core::array::from_fn(|i| value(handle.element(i)));
    [positions.sun_m, positions.planet_m, positions.pole, positions.center_of_mass_m] =
        vectors(variables).map(vector);
    for (angle_rad, panel) in positions.panel_angles_rad.iter_mut().zip(&variables.panel) {
        *angle_rad = value(panel.angle);
    }
}

/// The same positions as dual numbers; `along` gives an input's seed.
pub fn seeded_positions(
    positions: &Positions<f64>,
    variables: &DisturbanceVariables,
    along: impl Fn(Real) -> f64,
) -> Positions<Dual64> {
    let given = [positions.sun_m, positions.planet_m, positions.pole, positions.center_of_mass_m];
    let handles = vectors(variables);
    let dual = |k: usize, i: usize| Dual64::new(given[k][i], along(handles[k].element(i)));
    let [sun_m, planet_m, pole, center_of_mass_m] =
        core::array::from_fn(|k| core::array::from_fn(|i| dual(k, i)));
    let angles = positions.panel_angles_rad.iter().zip(&variables.panel);
    let panel_angles_rad =
        angles.map(|(angle_rad, panel)| Dual64::new(*angle_rad, along(panel.angle))).collect();
    Positions { sun_m, planet_m, pole, center_of_mass_m, panel_angles_rad }
}

/// The same parameters as dual numbers; `along` gives a parameter's seed.
pub fn seeded_parameters(
    parameters: &Parameters<f64>,
    variables: &DisturbanceVariables,
    along: impl Fn(Real) -> f64,
) -> Parameters<Dual64> {
    let dual = |value: f64, handle: Real| Dual64::new(value, along(handle));
    let (planet, surface) = (&variables.planet, &parameters.planet);
    let inertia = |i: usize, j: usize| {
        dual(parameters.inertia_body_kg_m2[(i, j)], variables.spacecraft.inertia.element(i, j))
    };
    Parameters {
        flux_at_1_au_w_m2: dual(parameters.flux_at_1_au_w_m2, variables.solar.flux),
        sun_radius_m: dual(parameters.sun_radius_m, variables.sun.radius),
        gm_m3_s2: dual(parameters.gm_m3_s2, planet.gravitational_parameter),
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

/// Whether a Real is one of the inputs or parameters that derivatives are known by.
pub fn is_known(variables: &DisturbanceVariables, real: Real) -> bool {
    let planet = &variables.planet;
    let surface = &planet.surface;
    let numbers = [
        variables.solar.flux,
        variables.sun.radius,
        planet.gravitational_parameter,
        planet.radius,
        surface.absorptivity,
        surface.diffuse_reflectivity,
        surface.emissivity,
        surface.night_temperature,
    ];
    numbers.contains(&real)
        || variables.spacecraft.inertia.index_of(real).is_some()
        || vectors(variables).iter().any(|vector| vector.index_of(real).is_some())
        || variables.panel.iter().any(|panel| panel.angle == real)
}

fn method(
    values: &Values,
    light: &PlanetLightVariables,
    spacecraft: &Spacecraft,
) -> Result<PlanetLightMethod, Failure> {
    let count = |handle| usize::try_from(values.integer(handle)).unwrap_or(0);
    Ok(match values.choice(light.method) {
        PlanetMethod::Cells => PlanetLightMethod::Cells(count(light.belts)),
        PlanetMethod::Map => PlanetLightMethod::Map(spacecraft.planet_map.clone().ok_or_else(|| {
            Failure::new(
                "planetLight.method is map, allowed only where the spacecraft's file has a planet_map",
            )
        })?),
        PlanetMethod::Rings => PlanetLightMethod::Rings(count(light.rings.nodes)),
    })
}

/// Warns of what is set, or stands in the file, and is without effect.
///
/// # Errors
/// A setting that cannot have any.
pub fn check_effects(context: &Plan<'_>, values: &Values) -> Result<(), Failure> {
    let (variables, spacecraft) = (context.variables, &context.setup.spacecraft);
    let shape = values.choice(variables.sunshade.shape).0;
    let shadows = variables.shadowing.check(values, spacecraft, shape)?;
    let light = &variables.planet_light;
    let maps = values.boolean(light.rings.enabled) && values.choice(light.method) == PlanetMethod::Map;
    let map = unused_map(spacecraft).filter(|_| !maps);
    for warning in [shadows, map].into_iter().flatten() {
        context.log.warning(&warning);
    }
    Ok(())
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
        let effects = ActiveEffects {
            planet_light: values.boolean(variables.planet_light.rings.enabled),
            recoil: values.boolean(variables.thermal.enabled),
            gravity_gradient: values.boolean(variables.gravity_gradient.enabled),
        };
        let surface = planet.surface.read(values, planet.radius);
        let sunshade_model = values.choice(variables.sunshade.shape).0;
        let options = Options {
            planet: present.then_some(surface),
            planet_light: method(values, &variables.planet_light, spacecraft)?,
            self_shadowing: values.boolean(variables.shadowing.enabled),
            sun_disc: values.boolean(variables.shadowing.sun_disc),
            sunshade_model: spacecraft.sunshade.is_some().then_some(sunshade_model),
        };
        let sun_radius_m = values.real(variables.sun.radius);
        let shadow = variables.eclipse.read(values, surface.radius_m, sun_radius_m)?;
        let failure = |error: &dyn core::fmt::Display| Failure::new(error.to_string());
        let inertia_body_kg_m2 = inertia_body_kg_m2(values, variables.spacecraft.inertia)?;
        let model = DisturbanceModel::new(spacecraft, &options)
            .and_then(|model| model.within(variables.solver.units(values)))
            .map_err(|error| match error {
                ModelError::Work { .. } => Failure::new(format!(
                    "{error} (solver.workLimit); see planetLight.method, planetLight.belts and planetLight.nodes"
                )),
                _ => failure(&error),
            })?;
        Ok(Self {
            model,
            shadow: present.then_some(shadow),
            parameters: Parameters {
                flux_at_1_au_w_m2: values.real(variables.solar.flux),
                sun_radius_m,
                gm_m3_s2: values.real(planet.gravitational_parameter),
                inertia_body_kg_m2,
                planet: surface,
            },
            effects,
        })
    }

    /// The inputs that are all zero, as before a master's first exchange.
    pub fn unset(&self, positions: &Positions<f64>) -> Vec<&'static str> {
        let places = [
            (true, positions.sun_m, "sun.positionBody"),
            (self.shadow.is_some(), positions.planet_m, "planet.positionBody"),
        ];
        let unset = places.into_iter().filter(|(counts, at, _)| *counts && *at == [0.0; 3]);
        unset.map(|(_, _, name)| name).collect()
    }

    /// Everything at these positions, with these parameters: its own, which may carry a seed.
    ///
    /// # Errors
    /// Names the inputs of a geometry without meaning.
    pub fn evaluate<T: Scalar>(
        &self,
        parameters: &Parameters<T>,
        positions: &Positions<T>,
        workspace: &mut Workspace<T>,
    ) -> Result<BySource<T>, Failure> {
        let model = (&self.model, self.effects);
        BySource::at(model, self.shadow.as_ref(), parameters, positions, workspace).map_err(|error| {
            let inputs = match &error {
                PositionError::Eclipse(_) => "sun.positionBody, planet.positionBody, planet.radius",
                PositionError::Geometry(_) => "sun.positionBody, planet.positionBody, planet.pole",
            };
            Failure::new(format!("{inputs}: {error}"))
        })
    }
}
