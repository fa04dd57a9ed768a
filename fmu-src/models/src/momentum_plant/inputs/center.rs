//! What follows `orbit.center`: a parameter that nobody gave takes the centre's own value.

use fmi_export::{Elements, Given, Values};
use physics::bodies::surface::PlanetSurface;
use physics::bodies::{Body, BodyData};
use physics::enumeration::Enumerated;
use physics::environment::frames::Frame;
use physics::environment::orbit::Elements as KeplerElements;

use super::given::is_given;
use crate::common::center;
use crate::momentum_plant::setup::Plan;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::choices::OrbitFrame;

/// The parameters about the centre, as they count.
pub struct Center<'a> {
    context: &'a Plan<'a>,
    values: &'a Values,
    /// The body in the centre.
    pub body: Body,
}

/// Parameters about the centre as they act; no orbit where position and velocity are inputs.
pub struct Settled {
    data: BodyData,
    surface: PlanetSurface,
    orbit: Option<(KeplerElements, Frame)>,
}

impl<'a> Center<'a> {
    /// The centre that `orbit.center` names.
    pub fn of(context: &'a Plan<'_>, values: &'a Values) -> Self {
        let body = values.choice(context.variables.orbit.center).0;
        Self { context, values, body }
    }

    /// Who gave what of `planet.*`.
    fn planet(&self) -> Given<'_> {
        let planet = &self.context.variables.planet;
        let numbers = [
            planet.gravitational_parameter,
            planet.radius,
            planet.j2,
            planet.j2_radius,
            planet.pole_right_ascension,
            planet.pole_declination,
        ];
        let [a, b, c, d, e, f] = numbers.map(Elements::from);
        let [g, h, i, j, k] = planet.surface.group();
        self.context.given(self.values, &[a, b, c, d, e, f, g, h, i, j, k])
    }

    /// Who gave what of the orbit's elements.
    fn orbit(&self) -> Given<'_> {
        let orbit = &self.context.variables.orbit;
        let elements = [
            orbit.semi_major_axis,
            orbit.eccentricity,
            orbit.inclination,
            orbit.ascending_node,
            orbit.periapsis_argument,
        ];
        let [a, b, c, d, e] = elements.map(Elements::from);
        self.context.given(self.values, &[a, b, c, d, e, orbit.frame.into()])
    }

    /// The centre's data.
    pub fn data(&self) -> BodyData {
        let (planet, given) = (&self.context.variables.planet, self.planet());
        let own = *self.body.data();
        BodyData {
            gm_m3_s2: given.real_or(planet.gravitational_parameter, own.gm_m3_s2),
            radius_m: given.real_or(planet.radius, own.radius_m),
            j2: given.real_or(planet.j2, own.j2),
            j2_radius_m: given.real_or(planet.j2_radius, own.j2_radius_m),
            pole_right_ascension_rad: given
                .real_or(planet.pole_right_ascension, own.pole_right_ascension_rad),
            pole_declination_rad: given.real_or(planet.pole_declination, own.pole_declination_rad),
            surface: Some(self.surface()),
            ..own
        }
    }

    /// The centre's surface; Mercury's where there is none.
    pub fn surface(&self) -> PlanetSurface {
        let (planet, given, own) =
            (&self.context.variables.planet, self.planet(), center::surface(self.body));
        let radius_m = given.real_or(planet.radius, own.radius_m);
        planet.surface.read_or(self.values, given, radius_m, &own)
    }

    /// Elements of the spacecraft's orbit.
    pub fn elements(&self) -> KeplerElements {
        let (orbit, given, own) = (&self.context.variables.orbit, self.orbit(), center::elements(self.body));
        KeplerElements {
            semi_major_axis_m: given.real_or(orbit.semi_major_axis, own.semi_major_axis_m),
            eccentricity: given.real_or(orbit.eccentricity, own.eccentricity),
            inclination_rad: given.real_or(orbit.inclination, own.inclination_rad),
            ascending_node_rad: given.real_or(orbit.ascending_node, own.ascending_node_rad),
            periapsis_argument_rad: given.real_or(orbit.periapsis_argument, own.periapsis_argument_rad),
            true_anomaly_rad: self.values.real(orbit.true_anomaly),
        }
    }

    /// Frame of those elements.
    pub fn frame(&self) -> Frame {
        let frame = self.context.variables.orbit.frame;
        if self.orbit().has(frame) { self.values.choice(frame).0 } else { center::frame(self.body) }
    }

    /// All of it, as it acts.
    pub fn settled(&self) -> Settled {
        let has_elements = !is_given(self.context.variables, self.values);
        Settled {
            data: self.data(),
            surface: self.surface(),
            orbit: has_elements.then(|| (self.elements(), self.frame())),
        }
    }
}

impl Settled {
    /// Writes it into the parameters.
    pub fn write(&self, variables: &PlantVariables, values: &mut Values) {
        let (planet, data) = (&variables.planet, &self.data);
        values.set_real(planet.gravitational_parameter, data.gm_m3_s2);
        values.set_real(planet.radius, data.radius_m);
        values.set_real(planet.j2, data.j2);
        values.set_real(planet.j2_radius, data.j2_radius_m);
        values.set_real(planet.pole_right_ascension, data.pole_right_ascension_rad);
        values.set_real(planet.pole_declination, data.pole_declination_rad);
        planet.surface.write(values, &self.surface);
        let Some((elements, frame)) = &self.orbit else { return };
        let orbit = &variables.orbit;
        values.set_real(orbit.semi_major_axis, elements.semi_major_axis_m);
        values.set_real(orbit.eccentricity, elements.eccentricity);
        values.set_real(orbit.inclination, elements.inclination_rad);
        values.set_real(orbit.ascending_node, elements.ascending_node_rad);
        values.set_real(orbit.periapsis_argument, elements.periapsis_argument_rad);
        values.set_choice(orbit.frame, OrbitFrame(*frame));
    }
}

/// Warns of elements that nobody gave and that are another's than the centre of the start values, before they are settled.
pub fn say_followed(context: &Plan<'_>, values: &Values) {
    let center = Center::of(context, values);
    if center.body == context.setup.center || is_given(context.variables, values) {
        return;
    }
    let orbit = &context.variables.orbit;
    let (found, shown) = (center.elements(), |value: f64, unit: &str| format!("{value:.6e} {unit}"));
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
    let frame = center.frame();
    if values.choice(orbit.frame).0 != frame {
        reported.push(format!("orbit.frame = {}", frame.name()));
    }
    if reported.is_empty() {
        return;
    }
    let [from, to] = [context.setup.center, center.body].map(Body::name);
    context.log.warning(&format!(
        "orbit.center is {to}, and the start values of this FMU are those about {from}: what was not set is taken as {to}'s \
         own, {}; pack with --set orbit.center={to} for start values that are {to}'s",
        reported.join(", ")
    ));
}
