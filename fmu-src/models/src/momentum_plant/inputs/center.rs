//! Parameters that default by `orbit.center`: those that nobody gave take the centre's own value.

use fmi_export::{Failure, Values};
use physics::bodies::air::ExponentialAir;
use physics::bodies::surface::PlanetSurface;
use physics::bodies::{Body, BodyData, impossible_density_kg_m3};
use physics::enumeration::Enumerated;
use physics::environment::frames::Frame;
use physics::environment::orbit::Elements as KeplerElements;

use crate::common::ellipse::kepler_elements;
use crate::common::numbers::{Number, Numbers};
use crate::momentum_plant::setup::Read;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::OrbitFrame;

/// The centre and the orbit's elements about it, as the parameters act.
#[derive(Clone, Copy)]
pub(super) struct Center {
    /// The body in the centre.
    pub data: BodyData,
    /// The body that planet.* describe: that of the encounter, else the one in the centre.
    pub planet: BodyData,
    /// Its surface; Mercury's where it has none.
    pub surface: PlanetSurface,
    /// Its air by the exponential model.
    pub air: ExponentialAir,
    /// Elements of the spacecraft's orbit, which count unless position and velocity are inputs.
    pub elements: KeplerElements,
    /// Frame of those elements.
    pub frame: Frame,
}

/// Elements of the orbit.
fn elements(variables: &PlantVariables) -> Numbers<KeplerElements, 6> {
    let orbit = &variables.orbit;
    let shape = [orbit.semi_major_axis, orbit.eccentricity, orbit.inclination];
    kepler_elements(shape, [orbit.ascending_node, orbit.periapsis_argument, orbit.true_anomaly])
}

/// Gravity, figure, pole and rotation.
fn planet(variables: &PlantVariables) -> Numbers<BodyData, 8> {
    let planet = &variables.planet;
    let figure: [Number<BodyData>; 4] = [
        (planet.gravitational_parameter, |it| &mut it.gm_m3_s2),
        (planet.radius, |it| &mut it.radius_m),
        (planet.j2, |it| &mut it.j2),
        (planet.j2_radius, |it| &mut it.j2_radius_m),
    ];
    let ([a, b, c, d], [e, f, g, h]) = (figure, planet.rotation.numbers());
    Numbers([a, b, c, d, e, f, g, h])
}

/// The exponential model of the air.
fn air(variables: &PlantVariables) -> Numbers<ExponentialAir, 3> {
    let atmosphere = &variables.atmosphere;
    Numbers([
        (atmosphere.reference_density, |it| &mut it.reference_density_kg_m3),
        (atmosphere.reference_height, |it| &mut it.reference_height_m),
        (atmosphere.scale_height, |it| &mut it.scale_height_m),
    ])
}

impl Center {
    /// The centre that `orbit.center` names.
    pub(super) fn read(read: Read<'_>) -> Self {
        let variables = read.variables;
        let (orbit, surface) = (&variables.orbit, &variables.planet.surface);
        let body = read.setup.bodies.body(read.choice(orbit.center).0);
        let encounter = variables.encounter.body(orbit, read.values);
        let near = encounter.map_or(body, |encounter| read.setup.bodies.body(encounter));
        let numbers = planet(variables);
        let [a, b, c, d, e, f, g, h] = numbers.group();
        let [i, j, k, l, m] = surface.group();
        let given = read.given(&[a, b, c, d, e, f, g, h, i, j, k, l, m]);
        let planet = numbers.read_or(given, &near.data);
        let own = PlanetSurface { radius_m: planet.radius_m, ..near.surface() };
        let surface = surface.read_or(given, &own);
        let planet = BodyData { surface: Some(surface), ..planet };
        let numbers = air(variables);
        let air = numbers.read_or(read.given(&numbers.group()), &near.air());
        let elements = elements(variables);
        let [a, b, c, d, e, _] = elements.group();
        let given = read.given(&[a, b, c, d, e, orbit.frame.into()]);
        // The true anomaly follows no centre.
        let true_anomaly_rad = read.real(orbit.true_anomaly);
        let own = KeplerElements { true_anomaly_rad, ..body.elements() };
        Self {
            data: if encounter.is_some() { body.data } else { planet },
            planet,
            surface,
            air,
            elements: elements.read_or(given, &own),
            frame: given.choice_or(orbit.frame, OrbitFrame(body.frame())).0,
        }
    }

    /// Refuses gravity and radius that no body has together.
    ///
    /// # Errors
    /// The mean density that they come to.
    pub(super) fn check_density(&self) -> Result<(), Failure> {
        let BodyData { gm_m3_s2, radius_m, .. } = self.planet;
        let Some(density_kg_m3) = impossible_density_kg_m3(gm_m3_s2, [radius_m; 3]) else { return Ok(()) };
        Err(Failure::new(format!(
            "planet.gravitationalParameter, planet.radius: found {gm_m3_s2:?} m3/s2 and {radius_m:?} m, a mean density of \
             {density_kg_m3:.3e} kg/m3, allowed: 100 to 30000 kg/m3 (1 km3/s2 is 1e9 m3/s2)"
        )))
    }

    /// Writes the parameters as they act.
    pub(super) fn write(&self, variables: &PlantVariables, values: &mut Values) {
        planet(variables).write(values, self.planet);
        air(variables).write(values, self.air);
        variables.planet.surface.write(values, &self.surface);
        if !values.choice(variables.orbit.source).is_given() {
            elements(variables).write(values, self.elements);
            values.set_choice(variables.orbit.frame, OrbitFrame(self.frame));
        }
    }
}

/// Warns of elements that nobody gave and that default by another centre than that of the start values, before they are resolved.
pub(super) fn warn_defaulted(read: Read<'_>) {
    let orbit = &read.variables.orbit;
    let body = read.choice(orbit.center).0;
    if body == read.setup.center.data.body || read.choice(orbit.source).is_given() {
        return;
    }
    let center = Center::read(read);
    let (found, shown) = (&center.elements, |value: f64, unit: &str| format!("{value:.6e} {unit}"));
    let elements = [
        ("orbit.semiMajorAxis", orbit.semi_major_axis, found.semi_major_axis_m, "m"),
        ("orbit.eccentricity", orbit.eccentricity, found.eccentricity, ""),
        ("orbit.inclination", orbit.inclination, found.inclination_rad, "rad"),
        ("orbit.ascendingNode", orbit.ascending_node, found.ascending_node_rad, "rad"),
        ("orbit.periapsisArgument", orbit.periapsis_argument, found.periapsis_argument_rad, "rad"),
    ];
    let defaulted = elements.iter().filter(|(_, parameter, own, _)| read.real(*parameter) != *own);
    let mut reported: Vec<String> =
        defaulted.map(|(name, _, own, unit)| format!("{name} = {}", shown(*own, unit).trim_end())).collect();
    if read.choice(orbit.frame).0 != center.frame {
        reported.push(format!("orbit.frame = {}", center.frame.name()));
    }
    if reported.is_empty() {
        return;
    }
    let [from, to] = [read.setup.center.data.body, body].map(Body::name);
    read.log.warning(&format!(
        "orbit.center is {to}, and the start values of this FMU are those about {from}: what was not set is taken as {to}'s \
         own, {}; pack with --set orbit.center={to} for start values that are {to}'s",
        reported.join(", ")
    ));
}
