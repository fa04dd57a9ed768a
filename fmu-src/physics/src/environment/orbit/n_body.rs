//! Gravity of Sun, planets and Moon on a spacecraft between them, and the body that its path is integrated about.
//!
//! Equation: about a body at c, (r - c)'' is what every body of the list does to the spacecraft less what it does to that body: a
//! point mass at p, mu [(p - r) / |p - r|^3 - (p - c) / |p - c|^3], the body itself -mu (r - c) / |r - c|^3. No acceleration is taken
//! from an ephemeris, whose bodies are pulled by others than those of the list. One body may be flattened; the Sun's
//! relativity is Schwarzschild's in harmonic coordinates, mu / (c^2 r^3) ((4 mu / r - v^2) r + 4 (r . v) v), likewise less that of the
//! body.
//! Method: the path is integrated about the planet within whose sphere of influence it is, of radius a (m / M)^(2/5), else about
//! the Sun: near a planet positions from it are as exact as their size says. Edges of spheres are roots on the dense output; over them
//! the path goes on as the ephemeris places the planet.
//! Error measure: the last Chebyshev term of a segment's position.
//! Reference: Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 8.4 and 8.5; Petit and Luzum, IERS
//! Conventions 2010, 10.12.

use nalgebra::{Matrix3, SVector, Vector3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::first_fall::{EDGE_M, first_fall};
use super::gravity::{Flattening, Gravity, gradient_per_s2, tide_m_s2};
use super::orbit_method::TERMS;
use crate::{
    bodies::{Body, BodyData, sphere_of_influence_m},
    constants::{GM_MOON_M3_S2, SPEED_OF_LIGHT_M_S},
    environment::CartesianState,
    numerics::chebyshev::Segment,
};

/// No segment is shortened below this for what light does, in s.
const SHORTEST_LIT_S: f64 = 60.0;

/// Ephemeris of bodies, EME2000, by the simulation's clock.
pub trait BodyEphemeris {
    /// Position and velocity from the Sun.
    fn heliocentric(&mut self, body: Body, at_s: f64) -> CartesianState;

    /// When the first segment of an ephemeris ends after `at_s`: until there positions are smooth.
    fn smooth_until_s(&self, at_s: f64) -> f64;

    /// Position of the Moon from the Earth, in m.
    fn moon_from_earth_m(&mut self, at_s: f64) -> Vector3<f64>;
}

/// A spacecraft inside a body.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Collision {
    /// Where its path begins or is cut.
    #[error(
        "at {at_s} s the spacecraft is {distance_m} m from the centre of {name}, allowed is more than its radius of {radius_m} m"
    )]
    Inside {
        /// When, s.
        at_s: f64,
        /// The body.
        name: &'static str,
        /// Distance from its centre, m.
        distance_m: f64,
        /// Its radius, m.
        radius_m: f64,
    },
    /// On its path.
    #[error("at {at_s} s the spacecraft hits {name}, radius {radius_m} m, at {speed_m_s} m/s")]
    Impact {
        /// When, s.
        at_s: f64,
        /// The body.
        name: &'static str,
        /// Its radius, m.
        radius_m: f64,
        /// Speed relative to its centre, m/s.
        speed_m_s: f64,
    },
}

/// How a path between bodies is integrated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NBodySettings {
    /// Whether the Sun's relativity counts.
    pub relativity: bool,
    /// Whether the path is integrated about the planet whose sphere of influence it is in. A body that the spacecraft's file places,
    /// which may move by the Sun alone, is never left.
    pub changes_center: bool,
    /// Whether the Moon attracts.
    pub moon: bool,
    /// Longest segment, s.
    pub cell_s: f64,
    /// Greatest last term of a segment's position, m.
    pub tolerance_m: f64,
}

/// What pulls on a spacecraft between several bodies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NBodyGravity {
    /// From where positions are given.
    pub center: Body,
    /// Longest segment, s.
    pub cell_s: f64,
    settings: NBodySettings,
    /// Of each body: gravitational parameter in m3/s2 (0: attracts nothing), radius in m, radius of the sphere of influence in m.
    bodies: [[f64; 3]; Body::COUNT],
    flattened: Option<(Body, Flattening)>,
}

impl NBodyGravity {
    /// That of the Sun, of `center`, from which positions are given, and of other `attracting` bodies; one of them may be
    /// `flattened`.
    pub fn new(
        settings: NBodySettings,
        center: &BodyData,
        attracting: impl Iterator<Item = BodyData>,
        flattened: Option<&BodyData>,
    ) -> Self {
        let mut bodies = [[0.0; 3]; Body::COUNT];
        for data in [*Body::Sun.data()].into_iter().chain(attracting).chain([*center]) {
            let sphere_m = sphere_of_influence_m(data.gm_m3_s2, data.orbit_semi_major_axis_m);
            bodies[data.body as usize] = [data.gm_m3_s2, data.radius_m, sphere_m];
        }
        let flattened = flattened.filter(|data| data.j2 != 0.0).map(|data| (data.body, Flattening::of(data)));
        let changes_center = settings.changes_center && center.body != Body::Custom;
        let settings = NBodySettings { changes_center, ..settings };
        Self { center: center.body, cell_s: settings.cell_s, settings, bodies, flattened }
    }

    /// Radius of a body's sphere of influence, m; 0 of one that does not attract.
    pub fn sphere_m(&self, body: Body) -> f64 {
        self.bodies[body as usize][2]
    }

    /// Radius of a body that attracts, m.
    pub fn radius_m(&self, body: Body) -> f64 {
        self.bodies[body as usize][1]
    }

    /// Those that attract, but for the Sun and the Moon.
    fn planets(&self) -> impl Iterator<Item = Body> + use<> {
        let bodies = self.bodies;
        let all = Body::ALL.into_iter().chain([Body::Custom]);
        all.filter(move |body| body.is_planet() && bodies[*body as usize][0] > 0.0)
    }

    /// Bodies whose spheres of influence a path integrated about `about` can enter or leave.
    fn spheres(&self, about: Body) -> impl Iterator<Item = Body> + use<> {
        let Self { settings, bodies, .. } = *self;
        let all =
            self.planets().filter(move |body| settings.changes_center && bodies[*body as usize][2] > 0.0);
        all.filter(move |body| [Body::Sun, *body].contains(&about))
    }

    /// The gravity of a body alone, with its flattening; of none that of the one that positions count from.
    pub fn near(&self, body: Option<Body>) -> Gravity {
        let body = body.unwrap_or(self.center);
        let flattening = self.flattened.filter(|(of, _)| *of == body).map(|(_, flattening)| flattening);
        Gravity { flattening, ..Gravity::point_mass(self.bodies[body as usize][0]) }
    }

    /// Acceleration of a spacecraft at `state` from where positions are given, relative to that, in EME2000, m/s2.
    pub fn acceleration_m_s2(
        &self,
        at_s: f64,
        state: &CartesianState,
        ephemeris: &mut impl BodyEphemeris,
    ) -> Vector3<f64> {
        BodiesAbout { gravity: self, about: self.center, ephemeris }.acceleration_m_s2(at_s, state)
    }

    /// Gradient of a spacecraft's acceleration by the position from `about`, 1/s2: of all that attract as point masses. Flattening, up to some 1e-4 of the
    /// gradient near Mercury's surface, and relativity, 1e-7, are left out.
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
        let mut sum = gradient_per_s2(&from_sun_m, self.bodies[Body::Sun as usize][0]);
        for body in self.planets() {
            let from_body_m = match body == about {
                true => *position_m,
                false => from_sun_m - ephemeris.heliocentric(body, at_s).position_m,
            };
            sum += gradient_per_s2(&from_body_m, self.bodies[body as usize][0]);
        }
        if self.settings.moon {
            let moon_m =
                ephemeris.heliocentric(Body::Earth, at_s).position_m + ephemeris.moon_from_earth_m(at_s);
            sum += gradient_per_s2(&(from_sun_m - moon_m), GM_MOON_M3_S2);
        }
        sum
    }

    /// Whether a segment's position is as good as the settings say, or as its rounding allows.
    pub(super) fn is_resolved(&self, segment: &Segment<6, TERMS>) -> bool {
        let rows = segment.coefficients().fixed_rows::<3>(0);
        let rounding_m = 8.0 * f64::EPSILON * rows.column(0).norm();
        rows.column(TERMS - 1).norm() <= self.settings.tolerance_m.max(rounding_m)
    }

    /// Whether an acceleration over a segment is: what its last term would do to the position, were it constant, is the measure.
    pub fn resolves<const N: usize>(&self, acceleration_m_s2: &Segment<3, N>) -> bool {
        let length_s = acceleration_m_s2.end() - acceleration_m_s2.start();
        let last_m_s2 = acceleration_m_s2.coefficients().column(N - 1).norm();
        let off_m = 0.5 * last_m_s2 * length_s * length_s;
        // Of what is not a number no shorter segment is better.
        length_s <= SHORTEST_LIT_S || off_m.is_nan() || off_m <= self.settings.tolerance_m
    }
}

/// Attracting bodies relative to the centre of integration.
pub(super) struct BodiesAbout<'a, E> {
    /// Which they are.
    pub gravity: &'a NBodyGravity,
    /// The one that the path counts from.
    pub about: Body,
    /// Where they are.
    pub ephemeris: &'a mut E,
}

impl<E: BodyEphemeris> BodiesAbout<'_, E> {
    /// A body's position and velocity from `about`.
    fn state(&mut self, body: Body, at_s: f64) -> CartesianState {
        if body == self.about {
            return CartesianState::default();
        }
        self.ephemeris.heliocentric(body, at_s) - self.ephemeris.heliocentric(self.about, at_s)
    }

    /// Distance of a body from a place that counts from `about`.
    fn distance_m(&mut self, body: Body, position_m: &Vector3<f64>, at_s: f64) -> f64 {
        (position_m - self.state(body, at_s).position_m).norm()
    }

    /// Acceleration in EME2000, m/s2, of a spacecraft at `state` from `about`, relative to that.
    pub(super) fn acceleration_m_s2(&mut self, at_s: f64, state: &CartesianState) -> Vector3<f64> {
        let Self { gravity, about, ephemeris } = self;
        let about = *about;
        let sun_m3_s2 = gravity.bodies[Body::Sun as usize][0];
        let mut center = CartesianState::default();
        let mut sum = Vector3::zeros();
        if about.is_planet() {
            center = ephemeris.heliocentric(about, at_s);
            sum += tide_m_s2(&state.position_m, &-center.position_m, sun_m3_s2);
        } else {
            sum += fall_m_s2(&state.position_m, sun_m3_s2);
        }
        let mut earth_m = None;
        for body in gravity.planets() {
            let gm_m3_s2 = gravity.bodies[body as usize][0];
            let mut from_about_m = Vector3::zeros();
            if body == about {
                sum += fall_m_s2(&state.position_m, gm_m3_s2);
            } else {
                from_about_m = ephemeris.heliocentric(body, at_s).position_m - center.position_m;
                sum += tide_m_s2(&state.position_m, &from_about_m, gm_m3_s2);
            }
            if body == Body::Earth {
                earth_m = Some(from_about_m);
            }
            if let Some((_, flattening)) = gravity.flattened.filter(|(of, _)| *of == body) {
                let from_body_m = state.position_m - from_about_m;
                let inverse = 1.0 / from_body_m.norm();
                flattening.add_to(&mut sum, &from_body_m, inverse, gm_m3_s2 * inverse * inverse * inverse);
            }
        }
        if gravity.settings.moon {
            let earth_m = earth_m
                .unwrap_or_else(|| ephemeris.heliocentric(Body::Earth, at_s).position_m - center.position_m);
            let moon_m = earth_m + ephemeris.moon_from_earth_m(at_s);
            sum += tide_m_s2(&state.position_m, &moon_m, GM_MOON_M3_S2);
        }
        if gravity.settings.relativity {
            sum += relativity_m_s2(&(*state + center), sun_m3_s2);
            if about.is_planet() {
                sum -= relativity_m_s2(&center, sun_m3_s2);
            }
        }
        sum
    }

    /// The body within whose sphere of influence a place is, else the Sun.
    fn body_about(&mut self, state: &CartesianState, at_s: f64) -> Body {
        let gravity = self.gravity;
        let shares = gravity.spheres(Body::Sun).map(|body| {
            let share = self.distance_m(body, &state.position_m, at_s) / gravity.sphere_m(body);
            (share, body)
        });
        let nearest = shares.min_by(|one, other| one.0.total_cmp(&other.0));
        nearest.filter(|(share, _)| *share < 1.0).map_or(Body::Sun, |(_, body)| body)
    }

    /// The body beyond the edge that a path from `about` is just about to go over, else `about`.
    fn body_at_edge(&mut self, state: &CartesianState, at_s: f64) -> Body {
        let Self { gravity, about, ephemeris } = self;
        let about = *about;
        let from_sun = *state + ephemeris.heliocentric(about, at_s);
        let crossed = gravity.spheres(about).find(|body| {
            let from_body =
                if *body == about { *state } else { from_sun - ephemeris.heliocentric(*body, at_s) };
            let outward = if *body == about { 1.0 } else { -1.0 };
            let beyond_m = outward * (from_body.position_m.norm() - gravity.sphere_m(*body));
            beyond_m > -EDGE_M && outward * from_body.position_m.dot(&from_body.velocity_m_s) > 0.0
        });
        crossed.map_or(about, |body| if body == about { Body::Sun } else { body })
    }

    /// The first time at which a path from `about` comes nearer to a body than a radius, in m; with a negative sense, farther.
    fn first_crossing(
        &mut self,
        body: Body,
        (radius_m, sense): (f64, f64),
        span_s: [f64; 2],
        path: &impl Fn(f64) -> CartesianState,
    ) -> Option<f64> {
        let mut gap_m = |at_s: f64| sense * (self.distance_m(body, &path(at_s).position_m, at_s) - radius_m);
        let reach_m = farthest_m(&path(span_s[0]), span_s);
        if gap_m(span_s[0]) > reach_m {
            return None;
        }
        first_fall(span_s, reach_m, &mut gap_m)
    }

    /// Where a path from `about` first comes into the sphere of influence of another body or leaves its own, and the body whose
    /// sphere it is in from there on.
    pub(super) fn sphere_reached(
        &mut self,
        span_s: [f64; 2],
        path: impl Fn(f64) -> CartesianState,
    ) -> Option<Reached> {
        let Self { gravity, about, .. } = *self;
        // On so short a span a crossing is a rounding error; the next segment's start decides (`body_at_edge`).
        let is_short = farthest_m(&path(span_s[0]), span_s) < EDGE_M;
        if is_short {
            return None;
        }
        let mut first: Option<Reached> = None;
        for body in gravity.spheres(about) {
            // Positive outside; a path about a planet is within its sphere.
            let sense = if body == about { -1.0 } else { 1.0 };
            let at_s = self.first_crossing(body, (gravity.sphere_m(body), sense), span_s, &path);
            if let Some(at_s) = at_s.filter(|at_s| first.is_none_or(|first| *at_s < first.at_s)) {
                let into = if body == about { Body::Sun } else { body };
                first = Some(Reached { at_s, body: into });
            }
        }
        first
    }

    /// Refuses a path from `about` that goes through a body.
    pub(super) fn check_above(
        &mut self,
        span_s: [f64; 2],
        path: impl Fn(f64) -> CartesianState,
    ) -> Result<(), Collision> {
        let Self { gravity, about, .. } = *self;
        let bodies = gravity.planets().chain([Body::Sun]);
        for body in bodies.filter(|body| *body == about || !gravity.settings.changes_center) {
            let radius_m = gravity.bodies[body as usize][1];
            if let Some(at_s) = self.first_crossing(body, (radius_m, 1.0), span_s, &path) {
                let speed_m_s = (path(at_s) - self.state(body, at_s)).velocity_m_s.norm();
                return Err(Collision::Impact { at_s, name: body.data().name, radius_m, speed_m_s });
            }
        }
        Ok(())
    }

    /// Refuses a place inside a body.
    fn check_outside(&mut self, state: &CartesianState, at_s: f64) -> Result<(), Collision> {
        for body in self.gravity.planets().chain([Body::Sun]) {
            let radius_m = self.gravity.bodies[body as usize][1];
            let distance_m = self.distance_m(body, &state.position_m, at_s);
            if distance_m < radius_m || distance_m.is_nan() {
                return Err(Collision::Inside { at_s, name: body.data().name, distance_m, radius_m });
            }
        }
        Ok(())
    }
}

/// Acceleration toward a point mass, m/s2, at this position from it.
fn fall_m_s2(position_m: &Vector3<f64>, gm_m3_s2: f64) -> Vector3<f64> {
    let inverse = 1.0 / position_m.norm();
    position_m * (-gm_m3_s2 * inverse * inverse * inverse)
}

/// What relativity adds near a body, m/s2.
fn relativity_m_s2(state: &CartesianState, gm_m3_s2: f64) -> Vector3<f64> {
    let (r, v) = (state.position_m, state.velocity_m_s);
    let distance_m = r.norm();
    let factor = gm_m3_s2 / (SPEED_OF_LIGHT_M_S * SPEED_OF_LIGHT_M_S * distance_m * distance_m * distance_m);
    (r * (4.0 * gm_m3_s2 / distance_m - v.norm_squared()) + v * (4.0 * r.dot(&v))) * factor
}

/// How far spacecraft and body come toward each other at most, m: both fall, and no planet is faster than 100 km/s.
fn farthest_m(state: &CartesianState, [start_s, end_s]: [f64; 2]) -> f64 {
    2.0 * (state.velocity_m_s.norm() + 1e5) * (end_s - start_s)
}

/// Where a path comes into a sphere of influence or leaves it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Reached {
    /// When, s.
    pub at_s: f64,
    /// The body that the path counts from after it.
    pub body: Body,
}

/// The body that a path is integrated about, a part of its state.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct IntegrationCenter {
    /// That of the present segment.
    pub body: Body,
    /// How often the longest segment was halved for the present one.
    pub level: u32,
    /// The edge of a sphere of influence at which the present segment ends.
    pub reaches: Option<Reached>,
    /// The body over the present segment, from where positions are given; absent while that is itself.
    offset: Option<Segment<6, TERMS>>,
    /// Whether a segment was integrated.
    is_begun: bool,
}

impl IntegrationCenter {
    /// How often a segment is halved at most.
    pub(super) const FINEST: u32 = 24;

    /// Before the first segment of a path that is given from `body`.
    pub(super) fn new(body: Body) -> Self {
        Self { body, level: 0, reaches: None, offset: None, is_begun: false }
    }

    /// Rejects decoded states that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        self.level <= Self::FINEST && self.offset.as_ref().is_none_or(Segment::is_valid)
    }

    /// Position and velocity of the body at a time of the present segment, from where positions are given.
    pub(super) fn offset_at(&self, at_s: f64) -> Option<CartesianState> {
        self.offset.as_ref().map(|offset| unpack(&offset.value(at_s)))
    }

    /// The body that the next segment counts from, the spacecraft being at `state` from that of the present one.
    pub(super) fn next_body(
        &self,
        bodies: &mut BodiesAbout<'_, impl BodyEphemeris>,
        state: &CartesianState,
        at_s: f64,
    ) -> Result<Body, Collision> {
        if self.is_begun {
            return Ok(self.reaches.map_or_else(|| bodies.body_at_edge(state, at_s), |reached| reached.body));
        }
        bodies.check_outside(state, at_s)?;
        let changes = bodies.gravity.settings.changes_center;
        Ok(if changes { bodies.body_about(state, at_s) } else { self.body })
    }

    /// The present segment, from where positions are given.
    pub(super) fn set_offset(&mut self, span_s: [f64; 2], bodies: &mut BodiesAbout<'_, impl BodyEphemeris>) {
        let from = bodies.gravity.center;
        self.is_begun = true;
        self.offset = (self.body != from).then(|| {
            Segment::fit(span_s[0], span_s[1], |at_s| {
                let [body, from] = [self.body, from].map(|body| bodies.ephemeris.heliocentric(body, at_s));
                pack(&(body - from))
            })
        });
    }

    /// The present segment ends at `at_s`, before the sphere's edge that it would come to.
    pub(super) fn cut(&mut self, at_s: f64) {
        self.reaches = self.reaches.filter(|reached| reached.at_s <= at_s);
    }
}

pub(super) fn pack(state: &CartesianState) -> SVector<f64, 6> {
    let (r, v) = (state.position_m, state.velocity_m_s);
    SVector::from([r.x, r.y, r.z, v.x, v.y, v.z])
}

pub(super) fn unpack(y: &SVector<f64, 6>) -> CartesianState {
    CartesianState {
        position_m: Vector3::new(y[0], y[1], y[2]),
        velocity_m_s: Vector3::new(y[3], y[4], y[5]),
    }
}
