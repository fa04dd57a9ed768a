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

/// Parameters of one material: the first of [`NUMBERS`], as many as its model has.
struct MaterialVariables(Vec<Real>);

/// A number of a material.
struct Number {
    name: &'static str,
    description: &'static str,
    unit: &'static str,
    limits: [Option<f64>; 2],
    start: fn(&MaterialValues) -> f64,
}

/// A number from 0 to 1.
const fn fraction(
    name: &'static str,
    description: &'static str,
    start: fn(&MaterialValues) -> f64,
) -> Number {
    Number { name, description, unit: "1", limits: [Some(0.0), Some(1.0)], start }
}

/// Number of the parameters that act on light, and on light and heat.
const LIGHT: usize = 2;
const LIGHT_AND_HEAT: usize = 4;

/// Mirrored and scattered fraction; emissivity and absorbed fraction of infrared light; interaction with air.
const NUMBERS: [Number; 9] = [
    fraction("specular", "Mirrored fraction; the rest of both is absorbed", |it| it.specular),
    fraction("diffuse", "Scattered fraction (Lambert)", |it| it.diffuse),
    Number {
        limits: [Some(1e-3), Some(1.0)],
        ..fraction("emissivity", "Infrared emissivity; unless given, the absorptivity", |it| {
            it.emissivity.value
        })
    },
    fraction(
        "infraredAbsorptivity",
        "Absorbed fraction of infrared light; unless given, the absorptivity",
        |it| it.infrared_absorptivity.value,
    ),
    Number {
        limits: [Some(0.0), None],
        ..fraction("dragCoefficient", "For aerodynamics.law dragCoefficient", |it| {
            it.gas_surface.drag_coefficient
        })
    },
    fraction("energyAccommodation", "For aerodynamics.law sentman", |it| it.gas_surface.energy_accommodation),
    fraction("normalAccommodation", "For aerodynamics.law schaafChambre", |it| {
        it.gas_surface.normal_accommodation
    }),
    fraction("tangentialAccommodation", "For aerodynamics.law schaafChambre", |it| {
        it.gas_surface.tangential_accommodation
    }),
    Number {
        unit: "K",
        limits: [Some(0.0), Some(2000.0)],
        ..fraction("wallTemperature", "In air, without thermal.enabled", |it| {
            it.gas_surface.wall_temperature_k
        })
    },
];

impl Variables<SettableMaterials> for OpticsVariables {
    fn declare(scope: &mut Declare, setup: &SettableMaterials, _index: usize) -> Result<Self, DeclareError> {
        let declared =
            setup.all.iter().map(|named| scope.group(&named.name, |scope| setup.declare(scope, named)));
        declared.collect::<Result<_, _>>().map(Self)
    }
}

impl SettableMaterials {
    fn declare(&self, scope: &mut Declare, named: &NamedMaterial) -> Result<MaterialVariables, DeclareError> {
        let values = named.values();
        let role = Role { causality: Causality::Parameter, variability: Variability::Tunable, initial: None };
        let count = match (self.heat, self.air) {
            (false, _) => LIGHT,
            (true, false) => LIGHT_AND_HEAT,
            (true, true) => NUMBERS.len(),
        };
        let declared = NUMBERS.iter().take(count).map(|number| {
            let &Number { name, description, unit, limits: [min, max], start } = number;
            let (display_unit, nominal) = (None, None);
            let spec = RealSpec { name, description, role, unit, display_unit, min, max, nominal };
            scope.real(&spec, Some(start(&values)))
        });
        declared.collect::<Result<_, _>>().map(MaterialVariables)
    }
}

impl MaterialVariables {
    /// Mirrored and scattered fraction.
    fn light(&self) -> [Real; LIGHT] {
        [self.0[0], self.0[1]]
    }

    /// Emissivity and absorbed fraction of infrared light.
    fn heat(&self) -> Option<[Real; 2]> {
        self.0.get(LIGHT..LIGHT_AND_HEAT)?.try_into().ok()
    }

    /// Interaction with air.
    fn air(&self) -> Option<GasSurface<Real>> {
        let &[drag, energy, normal, tangential, wall_temperature] = self.0.get(LIGHT_AND_HEAT..)? else {
            return None;
        };
        Some(GasSurface {
            drag_coefficient: drag,
            energy_accommodation: energy,
            normal_accommodation: normal,
            tangential_accommodation: tangential,
            wall_temperature_k: wall_temperature,
        })
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
        let ([specular, diffuse], heat) = (self.light().map(&read), self.heat());
        MaterialValues {
            specular,
            diffuse,
            emissivity: following(own.emissivity, heat.map(|[it, _]| it)),
            infrared_absorptivity: following(own.infrared_absorptivity, heat.map(|[_, it]| it)),
            gas_surface: self.air().map_or(own.gas_surface, |air| air.map(&read)),
        }
    }
}

impl OpticsVariables {
    /// Reflectivities.
    pub fn light(&self) -> Knowns {
        self.0.iter().flat_map(MaterialVariables::light).collect()
    }

    /// The parameters that act on light and heat.
    pub fn light_and_heat(&self) -> Knowns {
        self.0.iter().flat_map(|it| it.0.iter().take(LIGHT_AND_HEAT).copied()).collect()
    }

    /// Every parameter.
    pub fn each(&self) -> impl Iterator<Item = Real> + '_ {
        self.0.iter().flat_map(|it| it.0.iter().copied())
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
            let heat = material.heat().unwrap_or(material.light()).map(Into::into);
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
