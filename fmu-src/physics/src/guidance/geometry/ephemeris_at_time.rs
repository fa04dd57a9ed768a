//! Targets of the pointing options: spacecraft, Sun, Earth and bodies about the target planet, with their motion.

use nalgebra::Vector3;

use super::moving::{Moving, MovingMatrix, MovingVector, fixed, moving, state, value};
use crate::bodies::{Body, BodyData};
use crate::environment::CartesianState;
use crate::environment::orientation::{Equator, Orientation};
use crate::math;

/// Shape, pole and rotation of the planet that is observed (paper 001: triaxial ellipsoid).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TargetPlanet {
    /// Radii of the ellipsoid along the planet's x, y and z, in m.
    pub radii_m: Vector3<f64>,
    /// Its rotation.
    pub orientation: Orientation,
    /// Gravitational parameter, in m3/s2: the spacecraft's acceleration, which the rate of a frame tied to its velocity needs.
    pub gm_m3_s2: f64,
}

impl TargetPlanet {
    /// A sphere of the mean radius with the body's uniform rotation.
    pub fn from_body(data: &BodyData) -> Self {
        Self {
            radii_m: Vector3::repeat(data.radius_m),
            orientation: Orientation::uniform(data),
            gm_m3_s2: data.gm_m3_s2,
        }
    }

    /// From components in EME2000 to components along the planet's axes at `epoch_s` past J2000 TDB; the equator's motion is left out of the rate.
    pub fn planet_from_inertial(&self, epoch_s: f64) -> MovingMatrix {
        let Equator { equator_from_eme2000, rotation_angle_rad, rate_rad_s } =
            self.orientation.equator(epoch_s);
        let (sine, cosine) = math::sin_cos(rotation_angle_rad);
        let sine = Moving::new(sine, rate_rad_s * cosine);
        let cosine = Moving::new(cosine, -rate_rad_s * sine.re);
        let [x, y, z] = [0, 1, 2].map(|row| equator_from_eme2000.row(row).into_owned());
        let turned = |a: Moving, b: Moving| x.zip_map(&y, |x, y| a * x + b * y);
        MovingMatrix::from_rows(&[turned(cosine, sine), turned(-sine, cosine), z.map(Moving::from_re)])
    }
}

/// Everything an option may look at, in EME2000 from the target planet's centre.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EphemerisAtTime {
    /// Time, in s past J2000 TDB.
    pub epoch_s: f64,
    /// The planet at the origin.
    pub planet: TargetPlanet,
    /// The spacecraft, in m.
    pub position: MovingVector,
    /// Its velocity in m/s, with its acceleration by the planet's gravity.
    pub velocity: MovingVector,
    /// The Sun, in m.
    pub sun: MovingVector,
    /// The Earth, in m.
    pub earth: MovingVector,
    /// Other bodies by [`Body`], in m, where a command looks at them.
    pub bodies: [Option<MovingVector>; Body::COUNT],
}

impl EphemerisAtTime {
    /// Positions of spacecraft, Sun and Earth about the planet.
    pub fn new(
        epoch_s: f64,
        planet: TargetPlanet,
        spacecraft: &CartesianState,
        sun: &CartesianState,
        earth: &CartesianState,
    ) -> Self {
        let distance_m = spacecraft.position_m.norm();
        let acceleration_m_s2 = if distance_m > 0.0 {
            spacecraft.position_m * (-planet.gm_m3_s2 / (distance_m * distance_m * distance_m))
        } else {
            Vector3::zeros()
        };
        let of = |state: &CartesianState| moving(state.position_m, state.velocity_m_s);
        Self {
            epoch_s,
            planet,
            position: of(spacecraft),
            velocity: moving(spacecraft.velocity_m_s, acceleration_m_s2),
            sun: of(sun),
            earth: of(earth),
            bodies: [None; Body::COUNT],
        }
    }

    /// The same with this acceleration of the spacecraft by gravity, EME2000, where more than the planet's point mass is known.
    #[must_use]
    pub fn accelerated(self, acceleration_m_s2: &Vector3<f64>) -> Self {
        Self { velocity: moving(value(&self.velocity), *acceleration_m_s2), ..self }
    }

    /// Sets position and velocity of a body.
    pub fn place_body(&mut self, body: Body, place: &CartesianState) {
        self.bodies[body as usize] = Some(moving(place.position_m, place.velocity_m_s));
    }

    /// Whether spacecraft, Sun and Earth are somewhere else than the centre, where only `center` may be.
    pub fn is_connected(&self, center: Body) -> bool {
        let away = |vector: &MovingVector| value(vector) != Vector3::zeros();
        away(&self.position)
            && (center == Body::Sun || away(&self.sun))
            && (center == Body::Earth || away(&self.earth))
    }

    /// At another epoch with the spacecraft in `spacecraft`; Sun and Earth moved evenly.
    pub fn moved_to(&self, epoch_s: f64, spacecraft: &CartesianState) -> Self {
        let evenly = |vector: &MovingVector| state(vector).moved_evenly(epoch_s - self.epoch_s);
        Self::new(epoch_s, self.planet, spacecraft, &evenly(&self.sun), &evenly(&self.earth))
    }

    /// From the spacecraft to the planet's centre, in m.
    pub fn to_planet(&self) -> MovingVector {
        -self.position
    }

    /// Position x velocity about the planet, in m2/s.
    pub fn orbit_normal(&self) -> MovingVector {
        self.position.cross(&self.velocity)
    }

    /// From the spacecraft to the Sun, in m.
    pub fn to_sun(&self) -> MovingVector {
        self.sun - self.position
    }

    /// From the spacecraft to the Earth, in m.
    pub fn to_earth(&self) -> MovingVector {
        self.earth - self.position
    }

    /// From the spacecraft to a body, in m; zero where its place is not known.
    pub fn to_body(&self, body: Body) -> MovingVector {
        self.bodies[body as usize].map_or(fixed(Vector3::zeros()), |place| place - self.position)
    }
}
