//! What follows `orbit.center`: a parameter left at its start value, which is that of the body the file names, takes the
//! centre's own value.

use fmi_export::{Enumeration, Real, Values};
use physics::bodies::surface::PlanetSurface;
use physics::bodies::{Body, BodyData};
use physics::environment::frames::Frame;
use physics::environment::orbit::Elements;

use super::given::is_given;
use crate::common::center;
use crate::common::choices::OrbitCenter;
use crate::common::variables::followed;
use crate::momentum_plant::setup::Plan;
use crate::momentum_plant::variables::PlantVariables;

/// The parameters about the centre, as they count.
pub struct Center<'a> {
    variables: &'a PlantVariables,
    values: &'a Values,
    /// The body that the start values are of.
    described: Body,
    /// The body in the centre.
    pub body: Body,
}

impl<'a> Center<'a> {
    /// The centre that `orbit.center` names.
    pub fn of(context: &'a Plan<'_>, values: &'a Values) -> Self {
        let (variables, described) = (context.variables, context.setup.center);
        let body = values.choice(variables.orbit.center).map_or(described, |it| it.0);
        Self { variables, values, described, body }
    }

    /// The value of a parameter, or the centre's own where it was left at its start value.
    fn followed<D>(&self, parameter: Real, [described, own]: &[D; 2], of: fn(&D) -> f64) -> f64 {
        followed(self.values, parameter, of(described), of(own))
    }

    /// The centre's data.
    pub fn data(&self) -> BodyData {
        let planet = &self.variables.planet;
        let own = *self.body.data();
        let both = [*self.described.data(), own];
        let followed = |parameter, of| self.followed(parameter, &both, of);
        BodyData {
            gm_m3_s2: followed(planet.gravitational_parameter, |it| it.gm_m3_s2),
            radius_m: followed(planet.radius, |it| it.radius_m),
            j2: followed(planet.j2, |it| it.j2),
            j2_radius_m: followed(planet.j2_radius, |it| it.j2_radius_m),
            pole_right_ascension_rad: followed(planet.pole_right_ascension, |it| it.pole_right_ascension_rad),
            pole_declination_rad: followed(planet.pole_declination, |it| it.pole_declination_rad),
            surface: Some(self.surface()),
            ..own
        }
    }

    /// The centre's surface; Mercury's where there is none.
    pub fn surface(&self) -> PlanetSurface {
        let (planet, own) = (&self.variables.planet, center::surface(self.body));
        let asked = planet.surface.read(self.values, planet.radius);
        let described = center::surface(self.described);
        let both = [described, own];
        let followed = |parameter, of| self.followed(parameter, &both, of);
        let surface = &planet.surface;
        let untouched = asked.day_temperature == described.day_temperature;
        PlanetSurface {
            radius_m: followed(planet.radius, |it| it.radius_m),
            absorptivity: followed(surface.absorptivity, |it| it.absorptivity),
            diffuse_reflectivity: followed(surface.diffuse_reflectivity, |it| it.diffuse_reflectivity),
            emissivity: followed(surface.emissivity, |it| it.emissivity),
            night_temperature_k: followed(surface.night_temperature, |it| it.night_temperature_k),
            day_temperature: if untouched { own.day_temperature } else { asked.day_temperature },
        }
    }

    /// Elements of the spacecraft's orbit.
    pub fn elements(&self) -> Elements {
        let orbit = &self.variables.orbit;
        let both = [self.described, self.body].map(center::elements);
        let followed = |parameter, of| self.followed(parameter, &both, of);
        Elements {
            semi_major_axis_m: followed(orbit.semi_major_axis, |it| it.semi_major_axis_m),
            eccentricity: followed(orbit.eccentricity, |it| it.eccentricity),
            inclination_rad: followed(orbit.inclination, |it| it.inclination_rad),
            ascending_node_rad: followed(orbit.ascending_node, |it| it.ascending_node_rad),
            periapsis_argument_rad: followed(orbit.periapsis_argument, |it| it.periapsis_argument_rad),
            true_anomaly_rad: self.values.real(orbit.true_anomaly),
        }
    }

    /// Frame of those elements.
    pub fn frame(&self) -> Frame {
        let asked = self.values.choice(self.variables.orbit.frame).map(|it| it.0);
        asked.filter(|it| *it != center::frame(self.described)).unwrap_or(center::frame(self.body))
    }

    /// The body of the start values and the one in the centre.
    pub fn described_and_own(&self) -> [Body; 2] {
        [self.described, self.body]
    }
}

/// Warns of elements that were left at the start values of another centre and now are the centre's own.
pub fn say_followed(context: &Plan<'_>, values: &Values) {
    let center = Center::of(context, values);
    if center.body == center.described || is_given(context.variables, values) {
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
    let mut told: Vec<String> =
        followed.map(|(name, _, own, unit)| format!("{name} = {}", shown(*own, unit).trim_end())).collect();
    let frame = center.frame();
    if values.choice(orbit.frame).is_some_and(|it| it.0 != frame) {
        told.push(format!(
            "orbit.frame = {}",
            if frame == Frame::Ecliptic { "ecliptic" } else { "planetEquator" }
        ));
    }
    if told.is_empty() {
        return;
    }
    let [from, to] = center.described_and_own().map(|body| item_name(OrbitCenter(body)));
    context.log.warning(&format!(
        "orbit.center is {to}, and the start values of this FMU are those about {from}: what was left at them is taken as {to}'s \
         own, {}; pack with --set orbit.center={to} for start values that are {to}'s",
        told.join(", ")
    ));
}

fn item_name(center: OrbitCenter) -> &'static str {
    let items = OrbitCenter::TYPE.items.iter();
    items.clone().find(|item| item.value == center.value()).map_or("", |item| item.name)
}
