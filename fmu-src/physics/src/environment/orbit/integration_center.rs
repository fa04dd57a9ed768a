//! Body that a path between several bodies is integrated about: a part of the state of an orbit.
//!
//! Method: the path is integrated about the planet within whose sphere of influence it is, else about the Sun: near a planet positions
//! from it are as exact as their size says. Over an edge of a sphere the path goes on as the ephemeris places the planet.
//! Error measure: the last Chebyshev term of a segment's position.
//! Reference: Battin, An Introduction to the Mathematics and Methods of Astrodynamics, 8.5.

use nalgebra::{SVector, Vector3};
use serde::{Deserialize, Serialize};

use super::gravity_model::BodyEphemeris;
use super::orbit_method::TERMS;
use super::spheres::{BodiesAbout, Collision, SphereCrossing};
use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;

/// Body of integration, and how the present segment ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct IntegrationCenter {
    /// Body that the present segment counts from.
    pub body: Body,
    /// How often the longest segment was halved for the present one.
    pub level: u32,
    /// Edge of a sphere of influence at which the present segment ends.
    pub reaches: Option<SphereCrossing>,
    /// State of the body over the present segment, from the body that positions count from; absent where they are one.
    offset: Option<Segment<6, TERMS>>,
    /// Whether a segment was integrated.
    is_begun: bool,
}

impl IntegrationCenter {
    /// Greatest number of halvings of a segment.
    pub(super) const FINEST: u32 = 24;

    /// Returns the centre before the first segment of a path whose positions count from `body`.
    pub(super) fn new(body: Body) -> Self {
        Self { body, level: 0, reaches: None, offset: None, is_begun: false }
    }

    /// Rejects decoded states that no simulation can produce.
    pub(super) fn is_valid(&self) -> bool {
        self.level <= Self::FINEST && self.offset.as_ref().is_none_or(Segment::is_valid)
    }

    /// Position and velocity of the body at a time of the present segment, from the body that positions count from.
    pub(super) fn offset_at(&self, at_s: f64) -> Option<CartesianState> {
        self.offset.as_ref().map(|offset| unpack(&offset.value(at_s)))
    }

    /// Body that the next segment counts from, the spacecraft being at `state` from that of the present one.
    ///
    /// # Errors
    /// A start inside a body.
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
        Ok(if bodies.changes_center { bodies.body_about(state, at_s) } else { self.body })
    }

    /// Fits the body's state over the present segment, from `origin`, the body that positions count from.
    pub(super) fn set_offset(&mut self, span: Span, origin: Body, ephemeris: &mut impl BodyEphemeris) {
        self.is_begun = true;
        self.offset = (self.body != origin).then(|| {
            Segment::fit(span.start_s, span.end_s, |at_s| {
                let [body, origin] = [self.body, origin].map(|body| ephemeris.heliocentric(body, at_s));
                pack(&(body - origin))
            })
        });
    }

    /// Ends the present segment at `at_s`, before the edge of a sphere that it would come to.
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
