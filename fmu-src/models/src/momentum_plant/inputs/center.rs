//! What follows `orbit.center`: a parameter that nobody gave takes the centre's own value.

use fmi_export::{Elements, Values};
use physics::bodies::air::ExponentialAir;
use physics::bodies::surface::PlanetSurface;
use physics::bodies::{Body, BodyData};
use physics::enumeration::Enumerated;
use physics::environment::frames::Frame;
use physics::environment::orbit::Elements as KeplerElements;

use crate::common::center::CenterBody;
use crate::common::elements::ElementHandles;
use crate::momentum_plant::setup::Plan;
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

fn handles(variables: &PlantVariables) -> ElementHandles {
    let orbit = &variables.orbit;
    ElementHandles([
        orbit.semi_major_axis,
        orbit.eccentricity,
        orbit.inclination,
        orbit.ascending_node,
        orbit.periapsis_argument,
        orbit.true_anomaly,
    ])
}

/// Values of the exponential model: what is given of `atmosphere.reference*` and `scaleHeight`, else the body's own.
fn exponential(context: &Plan<'_>, values: &Values, body: &CenterBody) -> ExponentialAir {
    let v = &context.variables.atmosphere;
    let own = body.air();
    let group = [v.reference_density, v.reference_height, v.scale_height].map(Elements::from);
    let given = context.given(values, &group);
    ExponentialAir {
        reference_density_kg_m3: given.real_or(v.reference_density, own.reference_density_kg_m3),
        reference_height_m: given.real_or(v.reference_height, own.reference_height_m),
        scale_height_m: given.real_or(v.scale_height, own.scale_height_m),
        ..own
    }
}

impl Center {
    /// The centre that `orbit.center` names.
    pub(super) fn read(context: &Plan<'_>, values: &Values) -> Self {
        let (planet, orbit) = (&context.variables.planet, &context.variables.orbit);
        let body = context.setup.bodies.body(values.choice(orbit.center).0);
        let encounter = context.variables.encounter.body(orbit, values);
        let near = encounter.map_or(body, |encounter| context.setup.bodies.body(encounter));
        let (own, own_surface) = (near.data, near.surface());
        let numbers = [
            planet.gravitational_parameter,
            planet.radius,
            planet.j2,
            planet.j2_radius,
            planet.pole_right_ascension,
            planet.pole_declination,
            planet.rotation.prime_meridian,
            planet.rotation.rotation_rate,
        ];
        let [a, b, c, d, e, f, g, h] = numbers.map(Elements::from);
        let [i, j, k, l, m] = planet.surface.group();
        let given = context.given(values, &[a, b, c, d, e, f, g, h, i, j, k, l, m]);
        let radius_m = given.real_or(planet.radius, own_surface.radius_m);
        let surface = planet.surface.read_or(values, given, radius_m, &own_surface);
        let planet = BodyData {
            gm_m3_s2: given.real_or(planet.gravitational_parameter, own.gm_m3_s2),
            radius_m: given.real_or(planet.radius, own.radius_m),
            j2: given.real_or(planet.j2, own.j2),
            j2_radius_m: given.real_or(planet.j2_radius, own.j2_radius_m),
            pole_right_ascension_rad: given
                .real_or(planet.pole_right_ascension, own.pole_right_ascension_rad),
            pole_declination_rad: given.real_or(planet.pole_declination, own.pole_declination_rad),
            prime_meridian_rad: given.real_or(planet.rotation.prime_meridian, own.prime_meridian_rad),
            rotation_rate_rad_s: given.real_or(planet.rotation.rotation_rate, own.rotation_rate_rad_s),
            surface: Some(surface),
            ..own
        };
        let air = exponential(context, values, &near);
        let handles = handles(context.variables);
        let [a, b, c, d, e, _] = handles.group();
        let given = context.given(values, &[a, b, c, d, e, orbit.frame.into()]);
        let has_frame = given.has(orbit.frame);
        // The true anomaly follows no centre.
        let true_anomaly_rad = values.real(orbit.true_anomaly);
        let own = KeplerElements { true_anomaly_rad, ..body.elements() };
        Self {
            data: if encounter.is_some() { body.data } else { planet },
            planet,
            surface,
            air,
            elements: handles.read_or(given, &own),
            frame: if has_frame { values.choice(orbit.frame).0 } else { body.frame() },
        }
    }

    /// Writes the parameters as they act.
    pub(super) fn write(&self, variables: &PlantVariables, values: &mut Values) {
        let (planet, data) = (&variables.planet, &self.planet);
        values.set_real(planet.gravitational_parameter, data.gm_m3_s2);
        values.set_real(planet.radius, data.radius_m);
        values.set_real(planet.j2, data.j2);
        values.set_real(planet.j2_radius, data.j2_radius_m);
        values.set_real(planet.pole_right_ascension, data.pole_right_ascension_rad);
        values.set_real(planet.pole_declination, data.pole_declination_rad);
        values.set_real(planet.rotation.prime_meridian, data.prime_meridian_rad);
        values.set_real(planet.rotation.rotation_rate, data.rotation_rate_rad_s);
        let atmosphere = &variables.atmosphere;
        values.set_real(atmosphere.reference_density, self.air.reference_density_kg_m3);
        values.set_real(atmosphere.reference_height, self.air.reference_height_m);
        values.set_real(atmosphere.scale_height, self.air.scale_height_m);
        planet.surface.write(values, &self.surface);
        if !values.choice(variables.orbit.source).is_given() {
            handles(variables).write(values, &self.elements);
            values.set_choice(variables.orbit.frame, OrbitFrame(self.frame));
        }
    }
}

/// Warns of elements that nobody gave and that are another's than the centre of the start values, before they are resolved.
pub(super) fn say_followed(context: &Plan<'_>, values: &Values) {
    let orbit = &context.variables.orbit;
    let body = values.choice(orbit.center).0;
    if body == context.setup.center.data.body || values.choice(orbit.source).is_given() {
        return;
    }
    let center = Center::read(context, values);
    let (found, shown) = (&center.elements, |value: f64, unit: &str| format!("{value:.6e} {unit}"));
    let elements = [
        ("orbit.semiMajorAxis", orbit.semi_major_axis, found.semi_major_axis_m, "m"),
        ("orbit.eccentricity", orbit.eccentricity, found.eccentricity, ""),
        ("orbit.inclination", orbit.inclination, found.inclination_rad, "rad"),
        ("orbit.ascendingNode", orbit.ascending_node, found.ascending_node_rad, "rad"),
        ("orbit.periapsisArgument", orbit.periapsis_argument, found.periapsis_argument_rad, "rad"),
    ];
    let followed = elements.iter().filter(|(_, parameter, own, _)| values.real(*parameter) != *own);
    let mut reported: Vec<String> =
        followed.map(|(name, _, own, unit)| format!("{name} = {}", shown(*own, unit).trim_end())).collect();
    if values.choice(orbit.frame).0 != center.frame {
        reported.push(format!("orbit.frame = {}", center.frame.name()));
    }
    if reported.is_empty() {
        return;
    }
    let [from, to] = [context.setup.center.data.body, body].map(Body::name);
    context.log.warning(&format!(
        "orbit.center is {to}, and the start values of this FMU are those about {from}: what was not set is taken as {to}'s \
         own, {}; pack with --set orbit.center={to} for start values that are {to}'s",
        reported.join(", ")
    ));
}
