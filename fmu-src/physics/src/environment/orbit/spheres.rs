//! Spheres of influence that a path between bodies enters and leaves, and surfaces that it meets.
//!
//! Equation: |r - p| = a (m / M)^(2/5), the radius of the sphere of a body of mass m at p on an orbit of semi-major axis a about its
//! parent of mass M; |r - p| = R on the surface.
//! Method: changes of sign of |r - p|^2 less the radius squared on the dense output of a segment; a body farther away than the path can
//! come over the segment is passed over.
//! Reference: Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 8.5.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::gravity_model::{BodyEphemeris, GravityModel};
use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::numerics::Span;
use crate::numerics::events::first_crossing;

/// Tolerance of an edge, m: a segment that begins this near to it and goes over it counts as beyond it, because light moves the path
/// by centimetres after the edge was sought.
const SPHERE_TOLERANCE_M: f64 = 1.0;
/// Spacing of the clocks of ephemerides, s, by which positions over time are rounded.
const CLOCK_SPACING_S: f64 = 1.2e-7;

/// Spacecraft inside a body.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum Collision {
    /// Its path begins, or goes on after a cut, inside the body.
    #[error(
        "at {at_s} s the spacecraft is {distance_m} m from the centre of {name}, allowed is more than its radius of {radius_m} m"
    )]
    Inside {
        /// Time, s.
        at_s: f64,
        /// Name of the body.
        name: &'static str,
        /// Distance from its centre, m.
        distance_m: f64,
        /// Its radius, m.
        radius_m: f64,
    },
    /// Its path meets the surface.
    #[error("at {at_s} s the spacecraft hits {name}, radius {radius_m} m, at {speed_m_s} m/s")]
    Impact {
        /// Time, s.
        at_s: f64,
        /// Name of the body.
        name: &'static str,
        /// Its radius, m.
        radius_m: f64,
        /// Speed relative to its centre, m/s.
        speed_m_s: f64,
    },
}

/// Crossing of the edge of a sphere of influence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct SphereCrossing {
    /// Time, s.
    pub at_s: f64,
    /// Body that the path counts from after it.
    pub body: Body,
}

/// Attracting bodies relative to the centre of integration.
pub(super) struct BodiesAbout<'a, E> {
    /// List of the bodies.
    pub model: &'a GravityModel,
    /// Whether the centre changes with the sphere of influence.
    pub changes_center: bool,
    /// Body that the path counts from.
    pub about: Body,
    /// Ephemeris of the bodies.
    pub ephemeris: &'a mut E,
}

impl<E: BodyEphemeris> BodiesAbout<'_, E> {
    /// Position and velocity of a body from `about`.
    fn state(&mut self, body: Body, at_s: f64) -> CartesianState {
        if body == self.about {
            return CartesianState::default();
        }
        self.ephemeris.heliocentric(body, at_s) - self.ephemeris.heliocentric(self.about, at_s)
    }

    /// Distance of a body from a position that counts from `about`, m.
    fn distance_m(&mut self, body: Body, position_m: &Vector3<f64>, at_s: f64) -> f64 {
        (position_m - self.state(body, at_s).position_m).norm()
    }

    /// Bodies whose spheres of influence a path integrated about `about` can enter or leave.
    fn spheres(&self, about: Body) -> impl Iterator<Item = Body> + use<E> {
        let (model, changes_center) = (*self.model, self.changes_center);
        let all = model.planets().filter(move |body| changes_center && model.sphere_m(*body) > 0.0);
        all.filter(move |body| [Body::Sun, *body].contains(&about))
    }

    /// Body within whose sphere of influence a position is, else the Sun.
    pub(super) fn body_about(&mut self, state: &CartesianState, at_s: f64) -> Body {
        let ratios = self.spheres(Body::Sun).map(|body| {
            let ratio = self.distance_m(body, &state.position_m, at_s) / self.model.sphere_m(body);
            (ratio, body)
        });
        let nearest = ratios.min_by(|one, other| one.0.total_cmp(&other.0));
        nearest.filter(|(ratio, _)| *ratio < 1.0).map_or(Body::Sun, |(_, body)| body)
    }

    /// Body beyond the edge that a path from `about` is just about to go over, else `about`.
    pub(super) fn body_at_edge(&mut self, state: &CartesianState, at_s: f64) -> Body {
        let about = self.about;
        let crossing = self.spheres(about);
        let Self { model, ephemeris, .. } = self;
        let from_sun = *state + ephemeris.heliocentric(about, at_s);
        let crossed = { crossing }.find(|body| {
            let from_body =
                if *body == about { *state } else { from_sun - ephemeris.heliocentric(*body, at_s) };
            let outward = if *body == about { 1.0 } else { -1.0 };
            let beyond_m = outward * (from_body.position_m.norm() - model.sphere_m(*body));
            beyond_m > -SPHERE_TOLERANCE_M && outward * from_body.radial_m2_s() > 0.0
        });
        crossed.map_or(about, |body| if body == about { Body::Sun } else { body })
    }

    /// First time at which a path from `about` crosses the sphere of this radius about a body, entering it in the `sense` 1, leaving it in
    /// the sense -1.
    fn first_crossing(
        &mut self,
        body: Body,
        radius_m: f64,
        sense: f64,
        span: Span,
        path: &impl Fn(f64) -> CartesianState,
    ) -> Option<f64> {
        let (from_s, closing_m) = (span.start_s, max_closing_distance_m(&path(span.start_s), span));
        if sense * (self.distance_m(body, &path(from_s).position_m, from_s) - radius_m) > closing_m {
            return None;
        }
        first_crossing(span, CLOCK_SPACING_S, |at_s| {
            let distance_m = self.distance_m(body, &path(at_s).position_m, at_s);
            sense * (distance_m - radius_m) * (distance_m + radius_m)
        })
    }

    /// First edge of a sphere of influence that a path from `about` crosses, into that of another body or out of its own.
    pub(super) fn sphere_reached(
        &mut self,
        span: Span,
        path: impl Fn(f64) -> CartesianState,
    ) -> Option<SphereCrossing> {
        let about = self.about;
        // On so short a span a crossing is a rounding error; the next segment's start decides (`body_at_edge`).
        let is_short = max_closing_distance_m(&path(span.start_s), span) < SPHERE_TOLERANCE_M;
        if is_short {
            return None;
        }
        let crossings = self.spheres(about).filter_map(|body| {
            let (sense, beyond) = if body == about { (-1.0, Body::Sun) } else { (1.0, body) };
            let at_s = self.first_crossing(body, self.model.sphere_m(body), sense, span, &path)?;
            Some(SphereCrossing { at_s, body: beyond })
        });
        crossings.min_by(|one, other| one.at_s.total_cmp(&other.at_s))
    }

    /// Refuses a path from `about` that goes through a body.
    pub(super) fn check_above(
        &mut self,
        span: Span,
        path: impl Fn(f64) -> CartesianState,
    ) -> Result<(), Collision> {
        let (model, about) = (self.model, self.about);
        for body in model.planets().chain([Body::Sun]) {
            if body != about && self.changes_center {
                continue;
            }
            let radius_m = model.radius_m(body);
            if let Some(at_s) = self.first_crossing(body, radius_m, 1.0, span, &path) {
                let speed_m_s = (path(at_s) - self.state(body, at_s)).velocity_m_s.norm();
                return Err(Collision::Impact { at_s, name: body.data().name, radius_m, speed_m_s });
            }
        }
        Ok(())
    }

    /// Refuses a position inside a body.
    pub(super) fn check_outside(&mut self, state: &CartesianState, at_s: f64) -> Result<(), Collision> {
        for body in self.model.planets().chain([Body::Sun]) {
            let radius_m = self.model.radius_m(body);
            let distance_m = self.distance_m(body, &state.position_m, at_s);
            if distance_m < radius_m || distance_m.is_nan() {
                return Err(Collision::Inside { at_s, name: body.data().name, distance_m, radius_m });
            }
        }
        Ok(())
    }
}

/// Greatest distance by which spacecraft and body come toward each other, m: both fall, and no planet is faster than 100 km/s.
fn max_closing_distance_m(state: &CartesianState, span: Span) -> f64 {
    2.0 * (state.velocity_m_s.norm() + 1e5) * span.length_s()
}
