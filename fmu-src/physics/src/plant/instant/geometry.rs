//! Sun, planet and Earth at one time, as seen from the spacecraft.

use nalgebra::Vector3;

use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::environment::bodies_from_center::{BodiesFromCenter, fixed};
use crate::environment::ephemeris::Ephemeris;
use crate::environment::onboard::OnboardTarget;
use crate::environment::orbit::BodyEphemeris;
use crate::guidance::{EphemerisAtTime, LinesOfSight, Sight, TargetPlanet};

use crate::plant::settings::configuration::{Configuration, EphemerisSource, Motion};

/// Positions and velocities in EME2000.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Spacecraft about the orbit's centre.
    pub spacecraft: CartesianState,
    /// From the spacecraft to the Sun.
    pub to_sun: CartesianState,
    /// From the spacecraft to the planet, if it orbits or meets one.
    pub to_planet: Option<CartesianState>,
    /// From the spacecraft to the Earth.
    pub to_earth: CartesianState,
}

impl Geometry {
    /// Position about the Sun, EME2000, in m.
    pub fn heliocentric_position_m(&self) -> Vector3<f64> {
        -self.to_sun.position_m
    }

    /// The Sun from the orbit's centre.
    pub fn sun_from_center(&self) -> CartesianState {
        self.to_sun + self.spacecraft
    }

    /// The Earth from the orbit's centre.
    pub fn earth_from_center(&self) -> CartesianState {
        self.to_earth + self.spacecraft
    }

    /// The spacecraft from the planet, if there is one.
    pub fn from_planet(&self) -> Option<CartesianState> {
        self.to_planet.map(|planet| CartesianState::default() - planet)
    }

    /// Directions with their rates; a body at zero distance counts as lying toward +X.
    pub fn lines_of_sight(&self) -> LinesOfSight {
        LinesOfSight {
            sun_from_planet: self.to_planet.map(|to_planet| self.to_sun - to_planet),
            ..LinesOfSight::to([&self.to_sun, &self.to_earth], self.to_planet.as_ref())
        }
    }
}

/// Geometry as attitude laws read it.
pub(crate) struct GeometrySight {
    /// Positions and velocities of bodies and spacecraft.
    pub geometry: Geometry,
    /// In s past J2000 TDB.
    pub epoch_s: f64,
    /// The centre, and the acceleration by all gravity in m/s2, EME2000, where that is not the centre's point mass alone; `None` for a
    /// law that reads directions only.
    pub motion: Option<(TargetPlanet, Option<Vector3<f64>>)>,
}

impl Sight for GeometrySight {
    fn lines(&self) -> LinesOfSight {
        self.geometry.lines_of_sight()
    }

    fn ephemeris(&self) -> Option<EphemerisAtTime> {
        let (planet, acceleration_m_s2) = self.motion?;
        let (sun, earth) = (self.geometry.sun_from_center(), self.geometry.earth_from_center());
        let at = EphemerisAtTime::new(self.epoch_s, planet, &self.geometry.spacecraft, &sun, &earth);
        Some(acceleration_m_s2.map_or(at, |acceleration_m_s2| at.accelerated(&acceleration_m_s2)))
    }
}

/// Sun and Earth from the orbit's centre by this source.
pub fn sun_and_earth(
    center: Body,
    source: &EphemerisSource,
    ephemeris: &mut Ephemeris,
    epoch_s: f64,
) -> (CartesianState, CartesianState) {
    let ellipse = match source {
        EphemerisSource::Given { sun, earth } => return (*sun, *earth),
        EphemerisSource::Simulated(carried) => {
            let state =
                |body: Body| carried.state_carried_on(body.into(), center, epoch_s).unwrap_or_else(unplaced);
            return (state(Body::Sun), state(Body::Earth));
        }
        EphemerisSource::Vsop87 => None,
        EphemerisSource::Kepler(planet) => Some(*planet),
    };
    BodiesFromCenter { center, ellipse, custom: None }.sun_and_earth(ephemeris, epoch_s)
}

/// State of a body that no ephemeris places: no number.
fn unplaced() -> CartesianState {
    fixed(Vector3::repeat(f64::NAN))
}

/// Sun, planets and Moon by the simulation's ephemeris and clock.
pub(crate) struct SimulationEphemeris<'a> {
    pub configuration: &'a Configuration,
    pub ephemeris: &'a mut Ephemeris,
}

impl SimulationEphemeris<'_> {
    fn epoch_s(&self, at_s: f64) -> f64 {
        at_s + self.configuration.epoch_minus_time_s
    }

    /// Geometry at `time_s` of the flight, the spacecraft being there about the orbit's centre.
    pub(crate) fn geometry(&mut self, time_s: f64, spacecraft: CartesianState) -> Geometry {
        let Configuration { center, ephemeris: source, .. } = self.configuration;
        let (sun, earth) = sun_and_earth(*center, source, self.ephemeris, self.epoch_s(time_s));
        let planet = self.configuration.planet().map(|planet| match planet == *center {
            true => CartesianState::default(),
            false => self.body(planet, time_s),
        });
        Geometry {
            spacecraft,
            to_sun: sun - spacecraft,
            to_planet: planet.map(|planet| planet - spacecraft),
            to_earth: earth - spacecraft,
        }
    }

    /// A body from the orbit's centre at `time_s`.
    pub(crate) fn body(&mut self, body: Body, time_s: f64) -> CartesianState {
        let (Configuration { center, ephemeris: source, .. }, epoch_s) =
            (self.configuration, self.epoch_s(time_s));
        let ellipse = match source {
            EphemerisSource::Given { sun, .. } if body == Body::Sun => return *sun,
            EphemerisSource::Given { earth, .. } if body == Body::Earth => return *earth,
            EphemerisSource::Simulated(carried) => {
                if let Some(found) = carried.state_carried_on(body.into(), *center, epoch_s) {
                    return found;
                }
                None
            }
            EphemerisSource::Kepler(planet) => Some(*planet),
            EphemerisSource::Given { .. } | EphemerisSource::Vsop87 => None,
        };
        BodiesFromCenter { center: *center, ellipse, custom: None }.body(body, self.ephemeris, epoch_s)
    }

    /// Acceleration by all gravity of the flight, without other forces, in m/s2, EME2000, of a spacecraft there about the orbit's centre at
    /// `at_s`; `None` where the centre's point mass alone attracts.
    pub(super) fn gravity_m_s2(&mut self, at_s: f64, spacecraft: &CartesianState) -> Option<Vector3<f64>> {
        let gravity = self.configuration.motion.gravity();
        gravity.map(|gravity| gravity.acceleration_m_s2(at_s, spacecraft, self))
    }
}

impl BodyEphemeris for SimulationEphemeris<'_> {
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState {
        let epoch_s = self.epoch_s(at_s);
        match &self.configuration.ephemeris {
            _ if body == Body::Sun => CartesianState::default(),
            // About one body the Sun is where the centre's source says.
            _ if matches!(self.configuration.motion, Motion::Disturbed { .. }) => {
                let sun = self.body(Body::Sun, at_s);
                let is_center = body == self.configuration.center;
                let from_center = if is_center { CartesianState::default() } else { self.body(body, at_s) };
                from_center - sun
            }
            EphemerisSource::Simulated(carried) => {
                carried.state_carried_on(body.into(), Body::Sun, epoch_s).unwrap_or_else(unplaced)
            }
            EphemerisSource::Kepler(planet) if body == Body::Custom => planet.state(epoch_s),
            _ => self.ephemeris.state(body, epoch_s),
        }
    }

    fn smooth_until_s(&self, at_s: f64) -> f64 {
        let epoch_s = self.epoch_s(at_s);
        let until_epoch_s = match &self.configuration.ephemeris {
            EphemerisSource::Simulated(carried) => carried.smooth_until_s(epoch_s),
            _ => Ephemeris::smooth_until_s(epoch_s),
        };
        until_epoch_s - self.configuration.epoch_minus_time_s
    }

    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64> {
        let epoch_s = self.epoch_s(at_s);
        let carried = match &self.configuration.ephemeris {
            EphemerisSource::Simulated(carried) => carried.state(OnboardTarget::Moon, Body::Earth, epoch_s),
            _ => None,
        };
        carried.unwrap_or_else(|| self.ephemeris.moon_from_earth(epoch_s)).position_m
    }
}
