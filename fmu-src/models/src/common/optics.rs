//! Optics of surfaces, and what air does to them, as tunable parameters by material.

use fmi_export::variables::{Causality, RealSpec, Role, Variability};
use fmi_export::{Context, Declare, DeclareError, Failure, Knowns, Model, Real, Section, Values, Variables};
use physics::bodies::Body;
use physics::numerics::scalar::Scalar;
use physics::spacecraft::{
    Following, GasSurface, Material, MaterialValues, NamedMaterial, Spacecraft, StartValue,
};

use super::start_values::entry_of;
use super::value_reader::ValueReader;

/// Materials whose numbers are parameters of a model, and which of them.
#[derive(Clone, Debug)]
pub struct SettableMaterials {
    /// In the spacecraft's order.
    pub all: Vec<NamedMaterial>,
    heat: bool,
    air: bool,
}

impl SettableMaterials {
    /// For a model with every effect. Numbers for air are there about the Earth, and where the file turns air on or says what it
    /// does to a material; not where it fixes that air does not act.
    pub fn new(spacecraft: &Spacecraft, center: Body, model: &str) -> Self {
        let entry = entry_of(&spacecraft.start, model, "aerodynamics.enabled");
        let is_on = entry.map(|entry| entry.value == StartValue::Boolean(true));
        let air = match entry {
            Some(entry) if entry.is_fixed => is_on == Some(true),
            _ => {
                is_on == Some(true)
                    || center == Body::Earth
                    || spacecraft.materials.iter().any(|it| it.has_air)
            }
        };
        Self { all: spacecraft.materials.clone(), heat: true, air }
    }

    /// For a model of sunlight alone.
    pub fn in_sunlight(spacecraft: &Spacecraft) -> Self {
        Self { all: spacecraft.materials.clone(), heat: false, air: false }
    }
}

/// Parameters by material, in the spacecraft's order.
pub struct OpticsVariables(Vec<MaterialVariables>);

/// Parameters of one material.
struct MaterialVariables {
    /// Mirrored and scattered fraction.
    light: [Real; 2],
    /// Emissivity and absorbed fraction of infrared light.
    heat: Option<[Real; 2]>,
    /// Interaction with air.
    air: Option<GasSurface<Real>>,
}

impl Variables<SettableMaterials> for OpticsVariables {
    fn declare(scope: &mut Declare, setup: &SettableMaterials, _index: usize) -> Result<Self, DeclareError> {
        let declared = setup
            .all
            .iter()
            .map(|named| scope.group(&named.name, |scope| MaterialVariables::declare(scope, setup, named)));
        declared.collect::<Result<_, _>>().map(Self)
    }
}

impl MaterialVariables {
    fn declare(
        scope: &mut Declare,
        setup: &SettableMaterials,
        named: &NamedMaterial,
    ) -> Result<Self, DeclareError> {
        let values = named.values();
        let (emissivity, infrared) = (values.emissivity.value, values.infrared_absorptivity.value);
        let light = [
            fraction(scope, "specular", "Mirrored fraction; the rest of both is absorbed", values.specular)?,
            fraction(scope, "diffuse", "Scattered fraction (Lambert)", values.diffuse)?,
        ];
        let heat = match setup.heat {
            true => Some([
                parameter(
                    scope,
                    ("emissivity", "Infrared emissivity; unless given, the absorptivity"),
                    "1",
                    [Some(1e-3), Some(1.0)],
                    emissivity,
                )?,
                fraction(
                    scope,
                    "infraredAbsorptivity",
                    "Absorbed fraction of infrared light; unless given, the absorptivity",
                    infrared,
                )?,
            ]),
            false => None,
        };
        let gas = values.gas_surface;
        let air = match setup.air {
            true => Some(GasSurface {
                drag_coefficient: parameter(
                    scope,
                    ("dragCoefficient", "For aerodynamics.law dragCoefficient"),
                    "1",
                    [Some(0.0), None],
                    gas.drag_coefficient,
                )?,
                energy_accommodation: fraction(
                    scope,
                    "energyAccommodation",
                    "For aerodynamics.law sentman",
                    gas.energy_accommodation,
                )?,
                normal_accommodation: fraction(
                    scope,
                    "normalAccommodation",
                    "For aerodynamics.law schaafChambre",
                    gas.normal_accommodation,
                )?,
                tangential_accommodation: fraction(
                    scope,
                    "tangentialAccommodation",
                    "For aerodynamics.law schaafChambre",
                    gas.tangential_accommodation,
                )?,
                wall_temperature_k: parameter(
                    scope,
                    ("wallTemperature", "In air, without thermal.enabled"),
                    "K",
                    [Some(0.0), Some(2000.0)],
                    gas.wall_temperature_k,
                )?,
            }),
            false => None,
        };
        Ok(Self { light, heat, air })
    }

    /// All of them.
    fn each(&self) -> impl Iterator<Item = Real> + '_ {
        let air = self.air.as_ref().map(|it| {
            [
                it.drag_coefficient,
                it.energy_accommodation,
                it.normal_accommodation,
                it.tangential_accommodation,
                it.wall_temperature_k,
            ]
        });
        self.light.into_iter().chain(self.heat.into_iter().flatten()).chain(air.into_iter().flatten())
    }

    /// Values as `read` reads them; a number counts as given where `is_given` says so.
    fn values<T: Scalar>(
        &self,
        own: &NamedMaterial,
        is_given: impl Fn(Real) -> bool,
        read: impl Fn(Real) -> T,
    ) -> MaterialValues<T> {
        let own = own.values().map(T::constant);
        let following = |known: Following<T>, parameter: Option<Real>| {
            parameter
                .map_or(known, |it| Following { value: read(it), follows: known.follows && !is_given(it) })
        };
        let [specular, diffuse] = self.light.map(&read);
        MaterialValues {
            specular,
            diffuse,
            emissivity: following(own.emissivity, self.heat.map(|[it, _]| it)),
            infrared_absorptivity: following(own.infrared_absorptivity, self.heat.map(|[_, it]| it)),
            gas_surface: self.air.map_or(own.gas_surface, |air| air.map(&read)),
        }
    }
}

impl OpticsVariables {
    /// Reflectivities.
    pub fn light(&self) -> Knowns {
        self.0.iter().flat_map(|it| it.light).collect()
    }

    /// The parameters that act on light and heat.
    pub fn light_and_heat(&self) -> Knowns {
        self.0.iter().flat_map(|it| it.light.into_iter().chain(it.heat.into_iter().flatten())).collect()
    }

    /// Every parameter.
    pub fn each(&self) -> impl Iterator<Item = Real> + '_ {
        self.0.iter().flat_map(MaterialVariables::each)
    }

    /// Values of every material, as `read` reads a parameter.
    pub fn values<'v, M: Model, T: Scalar>(
        &'v self,
        context: &'v Context<'_, M>,
        values: &'v Values,
        own: &'v SettableMaterials,
        read: impl Fn(Real) -> T + Copy + 'v,
    ) -> impl Iterator<Item = MaterialValues<T>> + 'v {
        self.0.iter().zip(&own.all).map(move |(material, own)| {
            let heat = material.heat.unwrap_or(material.light).map(Into::into);
            let given = || context.given_deliberately(values, &heat);
            material.values(own, |parameter| given().has(parameter), read)
        })
    }
}

impl OpticsVariables {
    /// Every material with its place, as parameters set it.
    ///
    /// # Errors
    /// Names parameters whose values no material has.
    pub(crate) fn materials<'v, M: Model>(
        &'v self,
        read: ValueReader<'v, M>,
        own: &'v SettableMaterials,
    ) -> impl Iterator<Item = Result<(usize, Material), Failure>> + 'v {
        let found = self.values(read.context, read.values, own, move |parameter| read.real(parameter));
        let made = found.zip(&own.all).enumerate();
        made.map(|(place, (found, own))| Ok((place, material(own, &found)?)))
    }
}

impl Section for OpticsVariables {
    fn section(&self) -> Knowns {
        self.each().collect()
    }
}

/// A material with these values.
///
/// # Errors
/// Names the parameters whose values no material has.
pub(crate) fn material<T: Scalar>(
    own: &NamedMaterial,
    values: &MaterialValues<T>,
) -> Result<Material<T>, Failure> {
    own.with(values).map_err(|error| Failure::new(error.to_string()))
}

fn fraction(scope: &mut Declare, name: &str, description: &str, start: f64) -> Result<Real, DeclareError> {
    parameter(scope, (name, description), "1", [Some(0.0), Some(1.0)], start)
}

fn parameter(
    scope: &mut Declare,
    (name, description): (&str, &str),
    unit: &str,
    [min, max]: [Option<f64>; 2],
    start: f64,
) -> Result<Real, DeclareError> {
    let role = Role { causality: Causality::Parameter, variability: Variability::Tunable, initial: None };
    let (display_unit, nominal) = (None, None);
    scope.real(&RealSpec { name, description, role, unit, display_unit, min, max, nominal }, Some(start))
}
