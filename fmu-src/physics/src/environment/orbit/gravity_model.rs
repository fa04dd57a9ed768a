//! List of what attracts a spacecraft, and its acceleration relative to the body that its path counts from.
//!
//! Equation: about a body at c, (r - c)'' is what every row does to the spacecraft less what it does to that body: a point mass at
//! p, mu [(p - r) / |p - r|^3 - (p - c) / |p - c|^3], the body itself -mu (r - c) / |r - c|^3 with its flattening; the Sun's relativity
//! likewise less that of the body. No acceleration is taken from an ephemeris, whose bodies are pulled by others than the list's.
//! Orbits in two-body, disturbed and n-body motion differ in their lists: the centre alone; with its flattening, its parent and its
//! moon; all bodies.
//! Error measure: rounding; the centre's term, the greatest, is added last.
//! Reference: Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 8.4.

use nalgebra::{Matrix3, Vector3};

use super::gravity::{Gravity, gradient_per_s2, relativity_m_s2, tide_m_s2};
use crate::bodies::{Body, BodyData};
use crate::constants::GM_MOON_M3_S2;
use crate::environment::CartesianState;

/// Rows of a list: the bodies and the Moon.
const ROWS: usize = Body::COUNT + 1;

/// Ephemeris of bodies, EME2000, by the simulation's clock.
pub trait BodyEphemeris {
    /// Position and velocity from the Sun.
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState;

    /// End of the first ephemeris segment after `at_s`: until there positions are smooth.
    fn smooth_until_s(&self, at_s: f64) -> f64;

    /// Position of the Moon from the Earth, in m.
    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64>;
}

/// Body that attracts: a row of the list.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Attractor {
    /// The body; absent for the Moon, which an ephemeris places from its parent.
    body: Option<Body>,
    gravity: Gravity,
    /// Radius, m.
    radius_m: f64,
    /// Radius of the sphere of influence, m; 0 for a body that is no centre of integration.
    sphere_m: f64,
}

impl Attractor {
    /// The Moon, a point mass.
    pub const MOON: Self = Self {
        body: None,
        gravity: Gravity { mu_m3_s2: GM_MOON_M3_S2, flattening: None },
        radius_m: 0.0,
        sphere_m: 0.0,
    };
    /// Parent of the Moon.
    pub const MOON_PARENT: Body = Body::Earth;

    /// Returns the row with another gravity.
    #[must_use]
    pub fn with_gravity(self, gravity: Gravity) -> Self {
        Self { gravity, ..self }
    }

    /// Returns the row of a body as a point mass.
    pub fn point_mass(data: &BodyData) -> Self {
        let gravity = Gravity::point_mass(data.gm_m3_s2);
        let (radius_m, sphere_m) = (data.radius_m, data.sphere_of_influence_m());
        Self { body: Some(data.body), gravity, radius_m, sphere_m }
    }

    /// Returns the row of a body with its flattening.
    pub fn flattened(data: &BodyData) -> Self {
        Self::point_mass(data).with_gravity(Gravity::from_body(data))
    }

    fn index(&self) -> usize {
        self.body.map_or(Body::COUNT, |body| body as usize)
    }
}

/// All that attracts a spacecraft.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GravityModel {
    /// Body that positions count from.
    pub center: Body,
    /// Rows in the order of the bodies, the Moon last.
    rows: [Option<Attractor>; ROWS],
    /// Whether the Sun's relativity counts.
    relativity: bool,
}

impl GravityModel {
    /// Returns the list of these bodies, positions counting from `center`, which is one of them; of two rows of one body the later
    /// counts.
    pub fn new(center: Body, attractors: impl IntoIterator<Item = Attractor>, relativity: bool) -> Self {
        let mut rows = [None; ROWS];
        for attractor in attractors {
            rows[attractor.index()] = Some(attractor);
        }
        Self { center, rows, relativity }
    }

    fn row(&self, body: Body) -> Option<&Attractor> {
        self.rows[body as usize].as_ref()
    }

    /// Gravitational parameter of a body, m3/s2; 0 for one that does not attract.
    pub fn gm_m3_s2(&self, body: Body) -> f64 {
        self.row(body).map_or(0.0, |row| row.gravity.mu_m3_s2)
    }

    /// Radius of a body's sphere of influence, m; 0 for one that does not attract.
    pub fn sphere_m(&self, body: Body) -> f64 {
        self.row(body).map_or(0.0, |row| row.sphere_m)
    }

    /// Radius of a body that attracts, m.
    pub fn radius_m(&self, body: Body) -> f64 {
        self.row(body).map_or(0.0, |row| row.radius_m)
    }

    /// Planets that attract.
    pub(super) fn planets(&self) -> impl Iterator<Item = Body> + use<> {
        let model = *self;
        let all = Body::ALL.into_iter().chain([Body::Custom]);
        all.filter(move |body| model.gm_m3_s2(*body) > 0.0 && body.is_planet())
    }

    /// Acceleration toward `about` alone, m/s2, EME2000, at a position from it.
    pub(super) fn central_m_s2(&self, about: Body, position_m: &Vector3<f64>) -> Vector3<f64> {
        self.row(about).map_or_else(Vector3::zeros, |row| row.gravity.acceleration_m_s2(position_m))
    }

    /// Adds the acceleration by all other rows and relativity, m/s2, EME2000, of a spacecraft at `state` from `about`, relative to that.
    fn add_others_m_s2(
        &self,
        sum: &mut Vector3<f64>,
        about: Body,
        at_s: f64,
        state: &CartesianState,
        ephemeris: &mut impl BodyEphemeris,
    ) {
        let others = || self.rows.iter().flatten().filter(|row| row.body != Some(about));
        if others().next().is_none() && !self.relativity {
            return;
        }
        let center = match about {
            Body::Sun => CartesianState::default(),
            _ => ephemeris.heliocentric(about, at_s),
        };
        let mut parent_m = (about == Attractor::MOON_PARENT).then(Vector3::zeros);
        for row in others() {
            let from_about_m = match row.body {
                Some(Body::Sun) => -center.position_m,
                Some(body) => ephemeris.heliocentric(body, at_s).position_m - center.position_m,
                None => {
                    let parent_m = parent_m.unwrap_or_else(|| {
                        ephemeris.heliocentric(Attractor::MOON_PARENT, at_s).position_m - center.position_m
                    });
                    parent_m + ephemeris.moon_from_earth_m(at_s)
                }
            };
            if row.body == Some(Attractor::MOON_PARENT) {
                parent_m = Some(from_about_m);
            }
            *sum += tide_m_s2(&state.position_m, &from_about_m, row.gravity.mu_m3_s2);
            row.gravity.add_flattening_m_s2(sum, &(state.position_m - from_about_m));
        }
        if self.relativity {
            let sun_m3_s2 = self.gm_m3_s2(Body::Sun);
            *sum += relativity_m_s2(&(*state + center), sun_m3_s2);
            if about.is_planet() {
                *sum -= relativity_m_s2(&center, sun_m3_s2);
            }
        }
    }

    /// Acceleration of a spacecraft at `state` from `about`, relative to that, with a further one, m/s2, EME2000.
    pub(super) fn total_m_s2(
        &self,
        about: Body,
        at_s: f64,
        state: &CartesianState,
        ephemeris: &mut impl BodyEphemeris,
        further_m_s2: Vector3<f64>,
    ) -> Vector3<f64> {
        let mut sum = further_m_s2;
        self.add_others_m_s2(&mut sum, about, at_s, state, ephemeris);
        self.central_m_s2(about, &state.position_m) + sum
    }

    /// Acceleration of a spacecraft at `state` from the centre, relative to that, m/s2, EME2000.
    pub fn acceleration_m_s2(
        &self,
        at_s: f64,
        state: &CartesianState,
        ephemeris: &mut impl BodyEphemeris,
    ) -> Vector3<f64> {
        let mut sum = self.central_m_s2(self.center, &state.position_m);
        self.add_others_m_s2(&mut sum, self.center, at_s, state, ephemeris);
        sum
    }

    /// Gradient of a spacecraft's acceleration by its position from `about`, 1/s2, every row a point mass. Flattening, up to some 1e-4 of
    /// the gradient near Mercury's surface, and relativity, 1e-7, are left out.
    pub fn gradient_per_s2(
        &self,
        about: Body,
        at_s: f64,
        position_m: &Vector3<f64>,
        ephemeris: &mut impl BodyEphemeris,
    ) -> Matrix3<f64> {
        let mut center_m = Vector3::zeros();
        if about.is_planet() {
            center_m = ephemeris.heliocentric(about, at_s).position_m;
        }
        let from_sun_m = position_m + center_m;
        let gradients = self.rows.iter().flatten().map(|row| {
            let from_body_m = match row.body {
                Some(body) if body == about => *position_m,
                Some(Body::Sun) => from_sun_m,
                Some(body) => from_sun_m - ephemeris.heliocentric(body, at_s).position_m,
                None => {
                    let earth_m = ephemeris.heliocentric(Attractor::MOON_PARENT, at_s).position_m;
                    from_sun_m - (earth_m + ephemeris.moon_from_earth_m(at_s))
                }
            };
            gradient_per_s2(&from_body_m, row.gravity.mu_m3_s2)
        });
        gradients.sum()
    }
}
