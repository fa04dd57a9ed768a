//! From parameters to a prepared model, and from inputs to positions.

use std::cell::Cell;

use fmi_export::{Failure, Real, Values};
use physics::aerodynamics::AerodynamicModel;
use physics::environment::eclipse::Shadow;
use physics::loads::{Active, Switch};
use physics::numerics::scalar::Scalar;
use physics::plant::{BySource, Parameters, PositionError, Positions, Surfaces, Workspaces};
use physics::radiation::disturbance::{DisturbanceModel, Options, PlanetLightMethod};
use physics::spacecraft::{Material, Spacecraft};

use super::setup::Plan;
use super::variables::{DisturbanceVariables, PlanetLightVariables, PlanetMethod};
use crate::common::effects::unused_map;
use crate::common::spacecraft::inertia_body_kg_m2;

/// Models and numbers by parameters and spacecraft.
#[derive(Clone, Debug)]
pub(super) struct Prepared {
    model: DisturbanceModel,
    /// Absent where air does not act.
    air: Option<AerodynamicModel>,
    /// Absent without a planet.
    shadow: Option<Shadow>,
    pub parameters: Parameters<f64>,
    /// The inputs.
    pub inputs: Positions<Real>,
    active: Active,
}

/// Whether a Real is one of the inputs or parameters that derivatives are known by.
pub(super) fn is_known(variables: &DisturbanceVariables, values: &Values, real: Real) -> bool {
    let is_read = Cell::new(variables.positions().iter().any(|input| *input == real));
    variables.parameters(values, |parameter| {
        is_read.set(is_read.get() || parameter == real);
        0.0
    });
    is_read.get() || variables.optics.each().any(|parameter| parameter == real)
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
pub(super) fn check_effects(context: &Plan<'_>, values: &Values) -> Result<(), Failure> {
    let (variables, spacecraft) = (context.variables, &context.setup.spacecraft);
    let shape = values.choice(variables.sunshade_shape).0;
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
    pub(super) fn new(context: &Plan<'_>, values: &Values) -> Result<Self, Failure> {
        let variables = context.variables;
        let spacecraft = &context.setup.spacecraft;
        let (planet, light) = (&variables.planet, &variables.planet_light);
        let present = values.boolean(planet.present);
        let parameters = variables.parameters(values, |parameter| values.real(parameter));
        let surface = parameters.planet;
        let sunshade_model = values.choice(variables.sunshade_shape).0;
        let options = Options {
            planet: present.then_some(surface),
            planet_light: method(values, light, spacecraft)?,
            self_shadowing: values.boolean(variables.shadowing.enabled),
            sun_disc: values.boolean(variables.shadowing.sun_disc),
            sunshade_model: spacecraft.sunshade.is_some().then_some(sunshade_model),
        };
        let shadow = variables.eclipse.read(values, surface.radius_m, parameters.sun_radius_m)?;
        let failure = |error: &dyn core::fmt::Display| Failure::new(error.to_string());
        inertia_body_kg_m2(values, variables.spacecraft.inertia)?;
        let model = DisturbanceModel::new(spacecraft, &options).map_err(|error| failure(&error))?;
        let model = model.within(variables.solver.units(values)).map_err(|error| {
            Failure::new(format!(
                "{error} (solver.workLimit); see planetLight.method, planetLight.belts and planetLight.nodes"
            ))
        })?;
        let laws = &variables.laws;
        let active =
            laws.active([light.rings.enabled, variables.thermal.enabled], |switch| values.boolean(switch));
        let air = match active.is_on(Switch::Aerodynamics) {
            true => Some(laws.aerodynamics.options(values, spacecraft, sunshade_model)?),
            false => None,
        };
        let air = air.map(|options| AerodynamicModel::new(spacecraft, &options)).transpose();
        Ok(Self {
            model,
            air: air.map_err(|error| failure(&error))?,
            shadow: present.then_some(shadow),
            parameters,
            inputs: variables.positions(),
            active,
        })
    }

    /// The inputs that are all zero, as before a master's first exchange.
    pub(super) fn unset(&self, positions: &Positions<f64>) -> Vec<&'static str> {
        let places = [
            (true, positions.sun_m, "sun.positionBody"),
            (self.shadow.is_some(), positions.planet_m, "planet.positionBody"),
        ];
        let unset = places.into_iter().filter(|(counts, at, _)| *counts && *at == [0.0; 3]);
        unset.map(|(_, _, name)| name).collect()
    }

    /// Everything at these positions, with these parameters and materials: its own, which may carry a seed.
    ///
    /// # Errors
    /// Names the inputs of a geometry without meaning.
    pub(super) fn evaluate<T: Scalar>(
        &self,
        parameters: &Parameters<T>,
        materials: &[Material<T>],
        positions: &Positions<T>,
        workspaces: &mut Workspaces<T>,
    ) -> Result<BySource<T>, Failure> {
        let surfaces =
            Surfaces { light: &self.model, air: self.air.as_ref(), materials, active: self.active };
        BySource::at(surfaces, self.shadow.as_ref(), parameters, positions, workspaces).map_err(|error| {
            let inputs = match &error {
                PositionError::Eclipse(_) => "sun.positionBody, planet.positionBody, planet.radius",
                PositionError::Geometry(_) => "sun.positionBody, planet.positionBody, planet.pole",
            };
            Failure::new(format!("{inputs}: {error}"))
        })
    }
}
