//! The planet's ellipse about the Sun as parameters.

use fmi_export::{Failure, Model, Real, Values, Variables};
use physics::bodies::Body;
use physics::environment::kepler_planet::KeplerPlanet;
use physics::environment::orbit::Elements as KeplerElements;

use super::center::CenterBody;
use super::ephemeris;
use super::numbers::Numbers;
use super::value_reader::ValueReader;

/// The planet's ellipse about the Sun when `ephemeris.source` is kepler.
#[derive(Variables)]
#[variables(setup = CenterBody)]
pub struct EllipseVariables {
    /// Semi-major axis of the planet's orbit about the Sun when source is kepler; elements are in the ecliptic and
    /// equinox of J2000, of Mercury those of paper 004's Table 4 (whose axis is printed a digit short).
    #[parameter(unit = "m", display = "AU", min = 1e9, max = 1e13, start = setup.ellipse().semi_major_axis_m)]
    pub semi_major_axis: Real,
    /// Its eccentricity.
    #[parameter(unit = "1", min = 0.0, max = 0.99, start = setup.ellipse().eccentricity)]
    pub eccentricity: Real,
    /// Its inclination.
    #[parameter(unit = "rad", display = "deg", min = 0.0, max = core::f64::consts::PI, start = setup.ellipse().inclination_rad)]
    pub inclination: Real,
    /// Longitude of its ascending node.
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = setup.ellipse().ascending_node_rad)]
    pub ascending_node: Real,
    /// Its argument of perihelion; paper 004 uses Mercury's longitude of perihelion, 77.46 deg, in its place.
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = setup.ellipse().periapsis_argument_rad)]
    pub periapsis_argument: Real,
    /// The planet's true anomaly at start.epoch; paper 004's cases 1 to 4 are 10, 98, 189 and 279 deg.
    #[parameter(unit = "rad", display = "deg", min = -1e3, max = 1e3, start = setup.ellipse().true_anomaly_rad)]
    pub true_anomaly: Real,
}

/// Parameters of an orbit: semi-major axis, eccentricity, inclination; ascending node, argument of periapsis, true anomaly.
pub(crate) fn kepler_elements(
    [axis, eccentricity, inclination]: [Real; 3],
    [node, argument, anomaly]: [Real; 3],
) -> Numbers<KeplerElements, 6> {
    Numbers([
        (axis, |it| &mut it.semi_major_axis_m),
        (eccentricity, |it| &mut it.eccentricity),
        (inclination, |it| &mut it.inclination_rad),
        (node, |it| &mut it.ascending_node_rad),
        (argument, |it| &mut it.periapsis_argument_rad),
        (anomaly, |it| &mut it.true_anomaly_rad),
    ])
}

impl EllipseVariables {
    fn numbers(&self) -> Numbers<KeplerElements, 6> {
        let shape = [self.semi_major_axis, self.eccentricity, self.inclination];
        kepler_elements(shape, [self.ascending_node, self.periapsis_argument, self.true_anomaly])
    }

    /// Elements of the planet's ellipse about the Sun, in the ecliptic of J2000: those that are given, else the body's own.
    pub fn read(&self, read: ValueReader<'_, impl Model>, body: &CenterBody) -> KeplerElements {
        let numbers = self.numbers();
        numbers.read_or(read.given(&numbers.group()), &body.ellipse())
    }

    /// The planet on the ellipse of `ephemeris.source` kepler; the file's own body without parameters here is placed by
    /// that file.
    ///
    /// # Errors
    /// Elements that are none, a body that its file does not place.
    pub fn planet(
        &self,
        read: ValueReader<'_, impl Model>,
        body: &CenterBody,
        epoch_s: f64,
    ) -> Result<KeplerPlanet, Failure> {
        let handles = self.numbers().group();
        let given = read.given(&handles);
        if body.data.body == Body::Custom && !handles.iter().any(|handle| given.has(*handle)) {
            return ephemeris::custom(body, "kepler");
        }
        ephemeris::kepler(self.read(read, body), epoch_s)
    }

    /// Writes these elements.
    pub fn write(&self, values: &mut Values, elements: &KeplerElements) {
        self.numbers().write(values, *elements);
    }
}
