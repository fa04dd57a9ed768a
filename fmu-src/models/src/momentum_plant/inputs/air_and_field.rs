//! Figure, rotation, atmosphere and magnetic field of the planet from parameters and inputs; rejects by name what no model covers.

use fmi_export::{Boolean, Elements, Failure, Values};
use physics::bodies::{Body, BodyData};
use physics::environment::atmosphere::{Air, AtmosphereModel, SpaceWeather};
use physics::environment::geodetic::Ellipsoid;
use physics::environment::magnetic_field::{self, MagneticField};
use physics::environment::orientation::Orientation;
use physics::loads::{Active, Switch};
use physics::plant::{AirAndFieldSettings, AirSettings, AirSource, FieldSource, PlanetFigure};

use super::center::Center;
use crate::common::choices::PlanetOrientation;
use crate::common::effects::PLANET_SWITCHES;
use crate::momentum_plant::setup::Read;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::air_and_field::{AtmosphereMethod, MagneticFieldMethod};

/// The planet as it acts on the spacecraft.
pub(super) struct PlanetEnvironment {
    /// Effects that are on, with those that default by the planet.
    pub effects: Active,
    /// Air and field where one of them acts.
    pub air_and_field: Option<AirAndFieldSettings>,
    /// Figure and rotation of the planet; `None` without one.
    pub figure: Option<PlanetFigure>,
    /// Rotation of the body in the centre; `None` for the Sun.
    pub rotation: Option<Orientation>,
    /// The centre, with the poles of the start epoch as axes of oblateness.
    pub center: Center,
}

/// Effects, rotation, air and field by parameters.
///
/// # Errors
/// The Earth's orientation or models requested of another body.
pub(super) fn read(read: Read<'_>, center: &Center) -> Result<PlanetEnvironment, Failure> {
    let (v, planet) = (read.variables, &center.planet);
    let defaults = BodyDefaults::read(read, planet.body);
    let switches = [v.planet_light.enabled, v.thermal.enabled];
    let effects = v.laws.active(switches, |switch| defaults.is_on(read.values, switch));
    let [rotation, of_planet] = [&center.data, planet].map(|body| orientation(read, body));
    let (rotation, of_planet) = (rotation?, of_planet?);
    let ellipsoid =
        Ellipsoid { equatorial_radius_m: planet.equatorial_radius_m, flattening: planet.flattening };
    let air_and_field = if planet.body.is_planet() {
        let air = if effects.is_on(Switch::Aerodynamics) { Some(air(read, center)?) } else { None };
        let field = if effects.is_on(Switch::Magnetics) { Some(field(read, planet)?) } else { None };
        let tolerance = read.real(v.atmosphere.tolerance);
        (air.is_some() || field.is_some()).then_some(AirAndFieldSettings { air, field, tolerance })
    } else {
        None
    };
    let epoch_s = read.real(v.start.epoch);
    let turned = |body: &BodyData, rotation: Option<&Orientation>| match rotation {
        Some(rotation @ Orientation::Iau { .. }) => body.with_pole(&rotation.pole_eme2000(epoch_s)),
        _ => *body,
    };
    let center = Center {
        data: turned(&center.data, rotation.as_ref()),
        planet: turned(planet, of_planet.as_ref()),
        ..*center
    };
    let figure = of_planet.map(|orientation| PlanetFigure { orientation, ellipsoid });
    Ok(PlanetEnvironment { effects, air_and_field, figure, rotation, center })
}

/// Rotation of a planet; `None` for the Sun.
fn orientation(read: Read<'_>, planet: &BodyData) -> Result<Option<Orientation>, Failure> {
    if !planet.body.is_planet() {
        return Ok(None);
    }
    let orientation = BodyDefaults::read(read, planet.body).orientation;
    orientation.about(planet, read.real(read.variables.earth.ut1_offset)).map(Some)
}

fn air(read: Read<'_>, center: &Center) -> Result<AirSettings, Failure> {
    let v = read.variables;
    let (atmosphere, weather) = (&v.atmosphere, &v.space_weather);
    let source = match read.choice(atmosphere.method) {
        AtmosphereMethod::Exponential => AirSource::Model(AtmosphereModel::Exponential(center.air)),
        AtmosphereMethod::Nrlmsise00 if center.planet.body == Body::Earth => {
            AirSource::Model(AtmosphereModel::Nrlmsise00)
        }
        AtmosphereMethod::Nrlmsise00 => {
            return Err(Failure::new(format!(
                "atmosphere.method: found nrlmsise00 about {}, allowed: exponential (1), given (3); the model is the Earth's",
                center.planet.name
            )));
        }
        AtmosphereMethod::Given => AirSource::Given(Air {
            density_kg_m3: read.real(atmosphere.given_density),
            temperature_k: read.real(atmosphere.given_temperature),
            molar_mass_kg_mol: read.real(atmosphere.given_molar_mass),
        }),
    };
    Ok(AirSettings {
        source,
        weather: SpaceWeather {
            f107: read.real(weather.f107),
            f107_average: read.real(weather.f107_average),
            ap: read.real(weather.ap),
        },
        density_factor: read.real(atmosphere.density_factor),
        wind_m_s: read.vector(atmosphere.wind),
    })
}

fn field(read: Read<'_>, planet: &BodyData) -> Result<FieldSource, Failure> {
    let v = read.variables;
    let refused = |found: &str, allowed: &str| {
        Err(Failure::new(format!(
            "magneticField.method: found {found} about {}, allowed: {allowed}",
            planet.name
        )))
    };
    match read.choice(v.magnetic_field.method) {
        MagneticFieldMethod::Dipole => match planet.dipole {
            Some(dipole) => Ok(FieldSource::Model(MagneticField::Dipole(dipole))),
            None => {
                refused("dipole", "given (3), as no dipole is known; Earth, Mercury and Jupiter have one")
            }
        },
        MagneticFieldMethod::Igrf14 if planet.body == Body::Earth => {
            let epoch_s = read.real(v.start.epoch);
            magnetic_field::check_igrf14(epoch_s)
                .map_err(|error| Failure::new(format!("magneticField.method, start.epoch: {error}")))?;
            Ok(FieldSource::Model(MagneticField::Igrf14))
        }
        MagneticFieldMethod::Igrf14 => refused("igrf14", "dipole (1), given (3); the model is the Earth's"),
        MagneticFieldMethod::Given => Ok(FieldSource::Given(read.vector(v.magnetic_field.given))),
    }
}

/// Orientation and effects that default by the planet unless they are set.
#[derive(Clone, Copy)]
pub(super) struct BodyDefaults {
    /// Rotation model.
    pub orientation: PlanetOrientation,
    /// Switches of effects, whether each is on, and whether it was set.
    switches: [(Boolean, bool, bool); PLANET_SWITCHES],
}

impl BodyDefaults {
    /// Values set for a body; the defaults are true and iau for the Earth only.
    pub(super) fn read(read: Read<'_>, body: Body) -> Self {
        let (laws, planet) = (&read.variables.laws, &read.variables.planet);
        let rotation = &planet.rotation;
        // Importers that write every start value write the planet too; the others set alone are a user's choice.
        let [gm, radius] = [planet.gravitational_parameter, planet.radius].map(Elements::from);
        let [air, field] = laws.planet_switches().map(|(_, switch)| Elements::from(switch));
        let given = read.given(&[rotation.orientation.into(), gm, radius, air, field]);
        let switches = laws.planet_switches().map(|(_, switch)| {
            let is_set = given.has(switch);
            (switch, if is_set { read.boolean(switch) } else { body == Body::Earth }, is_set)
        });
        let orientation = given.choice_or(rotation.orientation, PlanetOrientation::for_body(body));
        Self { orientation, switches }
    }

    /// Value of a switch, including the default by the planet.
    pub(super) fn is_on(&self, values: &Values, switch: Boolean) -> bool {
        let own = self.switches.iter().find(|(it, ..)| *it == switch);
        own.map_or_else(|| values.boolean(switch), |(_, is_on, _)| *is_on)
    }

    /// Writes orientation and switches as they act.
    pub(super) fn write(self, variables: &PlantVariables, values: &mut Values) {
        values.set_choice(variables.planet.rotation.orientation, self.orientation);
        for (switch, is_on, _) in self.switches {
            values.set_boolean(switch, is_on);
        }
    }
}

/// Reports air and field that act by default, and warns where they are switched on without a planet.
pub(super) fn report(read: Read<'_>, start_s: f64) {
    let planet = Center::read(read).planet.body;
    let defaults = BodyDefaults::read(read, planet);
    let names = read.variables.laws.planet_switches().map(|(name, _)| name);
    for (name, (_, is_on, is_set)) in names.into_iter().zip(defaults.switches) {
        if is_on && !planet.is_planet() {
            read.log.warning(&format!(
                "{name} = true is without effect: there is no planet about which it could act"
            ));
        } else if is_on && !is_set {
            read.log.event(start_s, &format!("{name} = true, as about the Earth unless it is set"));
        }
    }
}
