//! What follows `orbit.center`: a parameter left at its default, which is Mercury's, takes the centre's own value.

use fmi_export::{Real, Values};
use physics::bodies::surface::{DayTemperature, PlanetSurface};
use physics::bodies::{Body, BodyData};
use physics::environment::frames::Frame;
use physics::environment::orbit::Elements;

use crate::common::variables::followed;
use crate::momentum_plant::variables::PlantVariables;
use crate::momentum_plant::variables::defaults;

/// The parameters about the centre, as they count.
pub struct Center<'a> {
    variables: &'a PlantVariables,
    values: &'a Values,
    /// The body in the centre.
    pub body: Body,
}

impl<'a> Center<'a> {
    /// The centre that `orbit.center` names.
    pub fn of(variables: &'a PlantVariables, values: &'a Values) -> Self {
        let body = values.choice(variables.orbit.center).map_or(Body::Mercury, |it| it.0);
        Self { variables, values, body }
    }

    /// The value of a parameter, or the centre's own where it was left at `default`.
    fn followed(&self, parameter: Real, default: f64, own: f64) -> f64 {
        followed(self.values, self.body, parameter, default, own)
    }

    /// The centre's data.
    pub fn data(&self) -> BodyData {
        let (planet, mercury, own) = (&self.variables.planet, Body::Mercury.data(), self.body.data());
        BodyData {
            gm_m3_s2: self.followed(planet.gravitational_parameter, mercury.gm_m3_s2, own.gm_m3_s2),
            radius_m: self.followed(planet.radius, mercury.radius_m, own.radius_m),
            j2: self.followed(planet.j2, mercury.j2, own.j2),
            j2_radius_m: self.followed(planet.j2_radius, mercury.j2_radius_m, own.j2_radius_m),
            pole_right_ascension_rad: self.followed(
                planet.pole_right_ascension,
                mercury.pole_right_ascension_rad,
                own.pole_right_ascension_rad,
            ),
            pole_declination_rad: self.followed(
                planet.pole_declination,
                mercury.pole_declination_rad,
                own.pole_declination_rad,
            ),
            surface: Some(self.surface()),
            ..*own
        }
    }

    /// The centre's surface; Mercury's where there is none.
    fn surface(&self) -> PlanetSurface {
        use physics::bodies::surface::MERCURY;
        let (planet, own) = (&self.variables.planet, self.body.data().surface.unwrap_or(MERCURY));
        let asked = planet.surface.read(self.values, planet.radius);
        let followed = |parameter, default, own| self.followed(parameter, default, own);
        let surface = &planet.surface;
        let untouched = asked.day_temperature == DayTemperature::Uniform && self.body != Body::Mercury;
        PlanetSurface {
            radius_m: followed(planet.radius, MERCURY.radius_m, own.radius_m),
            absorptivity: followed(surface.absorptivity, MERCURY.absorptivity, own.absorptivity),
            diffuse_reflectivity: followed(
                surface.diffuse_reflectivity,
                MERCURY.diffuse_reflectivity,
                own.diffuse_reflectivity,
            ),
            emissivity: followed(surface.emissivity, MERCURY.emissivity, own.emissivity),
            night_temperature_k: followed(
                surface.night_temperature,
                MERCURY.night_temperature_k,
                own.night_temperature_k,
            ),
            day_temperature: if untouched { own.day_temperature } else { asked.day_temperature },
        }
    }

    /// Elements of the spacecraft's orbit. About another centre than Mercury the defaults are a circle of three radii over
    /// the poles, about the Sun one of 1 AU.
    pub fn elements(&self) -> Elements {
        let orbit = &self.variables.orbit;
        let own = Elements::simple_about(self.body);
        Elements {
            semi_major_axis_m: self.followed(
                orbit.semi_major_axis,
                defaults::semi_major_axis_m(),
                own.semi_major_axis_m,
            ),
            eccentricity: self.followed(orbit.eccentricity, defaults::ECCENTRICITY, own.eccentricity),
            inclination_rad: self.followed(orbit.inclination, defaults::INCLINATION_RAD, own.inclination_rad),
            ascending_node_rad: self.followed(
                orbit.ascending_node,
                defaults::ASCENDING_NODE_RAD,
                own.ascending_node_rad,
            ),
            periapsis_argument_rad: self.followed(
                orbit.periapsis_argument,
                defaults::PERIAPSIS_ARGUMENT_RAD,
                own.periapsis_argument_rad,
            ),
            true_anomaly_rad: self.values.real(orbit.true_anomaly),
        }
    }

    /// Frame of those elements; about the Sun the default is the ecliptic.
    pub fn frame(&self) -> Frame {
        match self.values.choice(self.variables.orbit.frame).map_or(Frame::PlanetOrbit, |it| it.0) {
            Frame::PlanetEquator if self.body == Body::Sun => Frame::Ecliptic,
            frame => frame,
        }
    }
}
