//! An orbit integrated under gravity with its disturbances: the planet's flattening, and whatever acceleration the caller adds: tides,
//! forces known in advance, or forces that depend on the simulated attitude (`deviation`).

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::deviation::Deviation;
use super::elements::{OrbitError, check, check_mu};
use super::gravity_model::{BodyEphemeris, GravityModel};
use super::integration_center::{IntegrationCenter, pack, unpack};
use super::n_body::NBodyGravity;
use super::orbit_method::{OrbitMethod, TERMS};
use super::spheres::{BodiesAbout, Collision, SphereCrossing};
use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::numerics::Span;
use crate::numerics::collocation::{IntegrationError, SegmentChain, edge_after_s};

/// Why an integrated orbit ends.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum OrbitIntegrationError {
    /// The start or a parameter cannot be.
    #[error(transparent)]
    Start(#[from] OrbitError),
    /// A segment could not be integrated.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
    /// The spacecraft is inside a body, or hits one.
    #[error(transparent)]
    Collision(#[from] Collision),
    /// The spacecraft reached the surface.
    #[error(
        "at {at_s} s the spacecraft is {distance_m} m from the planet's centre, inside the planet of radius {radius_m} m"
    )]
    Impact {
        /// When, s.
        at_s: f64,
        /// Distance from the centre, m.
        distance_m: f64,
        /// Radius of the planet, m.
        radius_m: f64,
    },
}

/// A spacecraft's orbit as a chain of integrated segments with edges at whole multiples of their length: serialisable
/// state with dense output. Positions relative to the central body, in EME2000; times on the caller's clock.
///
/// Order 16 at the edges, degree 8 between them. With paper 004's orbit (periapsis 206 km above Mercury) segments of
/// 300 s keep a revolution to 1e-4 m, of 600 s to 1 m (tested).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DisturbedOrbit {
    chain: SegmentChain<6, TERMS>,
    radius_m: f64,
    /// By forces that depend on the simulated attitude, within the present segment.
    deviation: Option<Deviation>,
    /// The body that the segments count from, between several of them; absent where that never changes.
    center: Option<IntegrationCenter>,
}

impl DisturbedOrbit {
    /// A spacecraft at `state` at `start_s` about a body of `radius_m`, integrated in segments of `segment_length_s`.
    ///
    /// # Errors
    /// A length or time that cannot be, or a start below the surface.
    pub fn new(
        state: &CartesianState,
        start_s: f64,
        segment_length_s: f64,
        radius_m: f64,
    ) -> Result<Self, OrbitIntegrationError> {
        for (what, found, is_in_range, allowed) in [
            ("start time in s", start_s, true, "a finite number"),
            ("segment length in s", segment_length_s, segment_length_s > 0.0, "a finite number above 0"),
            ("radius in m", radius_m, radius_m >= 0.0, "a finite number, 0 or more"),
        ] {
            check(what, found, found.is_finite() && is_in_range, allowed)?;
        }
        let start = pack(state);
        start.iter().try_for_each(|x| check("position or velocity", *x, x.is_finite(), "finite numbers"))?;
        check_above(state.position_m.norm(), start_s, radius_m)?;
        let chain = SegmentChain::new(segment_length_s, start_s, start);
        Ok(Self { chain, radius_m, deviation: None, center: None })
    }

    /// A spacecraft at `state` at `start_s` from the body that positions count from, between all bodies of `gravity`.
    ///
    /// # Errors
    /// A length or time that cannot be; a start inside a body shows where the orbit is advanced.
    pub fn between_bodies(
        state: &CartesianState,
        start_s: f64,
        gravity: &NBodyGravity,
    ) -> Result<Self, OrbitIntegrationError> {
        let center = Some(IntegrationCenter::new(gravity.model.center));
        Ok(Self { center, ..Self::new(state, start_s, gravity.settings.cell_s, 0.0)? })
    }

    /// The body that the present segment counts from, where that may change.
    pub fn integration_center(&self) -> Option<Body> {
        self.center.as_ref().map(|center| center.body)
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.chain.is_valid()
            && self.radius_m >= 0.0
            && self.deviation.as_ref().is_none_or(Deviation::is_valid)
            && self.center.as_ref().is_none_or(IntegrationCenter::is_valid)
    }

    /// How far the integration has come, s.
    pub fn end_s(&self) -> f64 {
        self.chain.end_s
    }

    /// Start of the present segment, s.
    pub fn start_s(&self) -> f64 {
        self.chain.start_s
    }

    /// Span of the present segment.
    pub fn span(&self) -> Span {
        Span::new(self.start_s(), self.end_s())
    }

    /// Length of the segments, s.
    pub fn segment_length_s(&self) -> f64 {
        self.chain.length_s
    }

    /// Position and velocity at a time of the present segment.
    pub fn state_at(&self, at_s: f64) -> CartesianState {
        let own = self.own_state_at(at_s);
        let away = self.center.as_ref().and_then(|center| center.offset_at(at_s));
        away.map_or(own, |away| own + away)
    }

    /// The same from the body that the present segment counts from.
    pub fn own_state_at(&self, at_s: f64) -> CartesianState {
        let reference = unpack(&self.chain.value(at_s));
        self.deviation.as_ref().map_or(reference, |deviation| reference + deviation.value(at_s))
    }

    /// Whether the present segment has a deviation.
    pub fn is_deviated(&self) -> bool {
        self.deviation.is_some()
    }

    /// End of the deviation, s.
    pub fn deviated_until_s(&self) -> f64 {
        self.deviation.as_ref().map_or(f64::NEG_INFINITY, |it| it.end_s)
    }

    /// Integrates the deviation under the perturbing acceleration `extra_m_s2(t)`, EME2000, smooth over `span`, within the
    /// present segment and not before the last such interval; `None`: none acts. Tides are those of the segment.
    ///
    /// # Errors
    /// [`OrbitIntegrationError`]; the orbit stays as it was.
    pub fn accelerate(
        &mut self,
        gravity: &GravityModel,
        span: Span,
        extra_m_s2: Option<impl Fn(f64) -> Vector3<f64>>,
    ) -> Result<(), OrbitIntegrationError> {
        let Span { start_s, end_s } = span;
        if end_s <= start_s || (extra_m_s2.is_none() && self.deviation.is_none()) {
            return Ok(());
        }
        // Over a deviation tides change by less than 1e-10 m/s2 a kilometre.
        let about = self.integration_center().unwrap_or(gravity.center);
        let near_m_s2 = |position_m: &Vector3<f64>| gravity.central_m_s2(about, position_m);
        let before = self.deviation.as_ref().map_or_else(CartesianState::default, |it| it.value(start_s));
        let reference_m = |at_s: f64| unpack(&self.chain.value(at_s)).position_m;
        let next = Deviation::integrate(&before, span, reference_m, near_m_s2, extra_m_s2)?;
        let distance_m = (reference_m(end_s) + next.value(end_s).position_m).norm();
        check_above(distance_m, end_s, self.radius_m)?;
        self.deviation = Some(next);
        Ok(())
    }

    /// Integrates one more segment, to `limit_s` if that comes first: because an acceleration changes there. Later segments end at
    /// whole multiples again. `extra_m_s2(t)` is any further acceleration, EME2000, smooth within the segment, called 20 to 40
    /// times a segment.
    ///
    /// # Errors
    /// [`OrbitIntegrationError`]; the orbit stays as it was.
    pub fn advance_to(
        &mut self,
        limit_s: f64,
        method: &OrbitMethod,
        gravity: &GravityModel,
        ephemeris: &mut impl BodyEphemeris,
        mut extra_m_s2: impl FnMut(f64) -> Vector3<f64>,
    ) -> Result<(), OrbitIntegrationError> {
        check_mu(gravity.gm_m3_s2(gravity.center))?;
        let mut next = self.chain;
        if self.deviation.is_some() {
            next.cut(next.end_s, pack(&self.own_state_at(next.end_s)));
        }
        next.advance_to(method, limit_s, |at_s, y| {
            let state = unpack(y);
            let total_m_s2 = gravity.total_m_s2(gravity.center, at_s, &state, ephemeris, extra_m_s2(at_s));
            pack(&CartesianState { position_m: state.velocity_m_s, velocity_m_s: total_m_s2 })
        })?;
        // The lowest point of a segment is near an end or where the radial speed changes sign: look at nine points.
        for i in 0..=8 {
            let at_s = next.start_s + (next.end_s - next.start_s) * f64::from(i) / 8.0;
            check_above(unpack(&next.value(at_s)).position_m.norm(), at_s, self.radius_m)?;
        }
        (self.chain, self.deviation) = (next, None);
        Ok(())
    }

    /// Integrates one more segment between several bodies, to `limit_s` if that comes first, or to where the spacecraft comes
    /// into a sphere of influence or leaves it: there the next one counts from another body. The segment's length is halved until
    /// its position is as good as `gravity` says, so that it ends at a multiple of that. `extra_m_s2(t)` is any further
    /// acceleration, EME2000. Gives how often a segment was integrated.
    ///
    /// # Errors
    /// [`OrbitIntegrationError`]; the orbit stays as it was.
    pub fn advance_between_bodies<E: BodyEphemeris>(
        &mut self,
        limit_s: f64,
        method: &OrbitMethod,
        gravity: &NBodyGravity,
        ephemeris: &mut E,
        mut extra_m_s2: impl FnMut(f64) -> Vector3<f64>,
    ) -> Result<u32, OrbitIntegrationError> {
        let mut chain = self.chain;
        let start_s = chain.end_s;
        let limit_s = limit_s.min(ephemeris.smooth_until_s(start_s));
        let mut state = self.own_state_at(start_s);
        let mut center = self.center.unwrap_or(IntegrationCenter::new(gravity.model.center));
        let changes_center = gravity.settings.changes_center;
        let mut bodies = BodiesAbout { model: &gravity.model, changes_center, about: center.body, ephemeris };
        let body = center.next_body(&mut bodies, &state, start_s)?;
        if body != center.body {
            let [before, after] =
                [center.body, body].map(|body| bodies.ephemeris.heliocentric(body, start_s));
            state = state + (before - after);
            (center.body, bodies.about) = (body, body);
        }
        if self.deviation.is_some() || self.center.is_none_or(|before| before.body != body) {
            chain.cut(start_s, pack(&state));
        }
        let mut integrate = |to_s: f64, bodies: &mut BodiesAbout<'_, E>| {
            let mut next = chain;
            next.advance_to(method, to_s, |at_s, y| {
                let state = unpack(y);
                let (about, further_m_s2) = (bodies.about, extra_m_s2(at_s));
                let total_m_s2 =
                    gravity.model.total_m_s2(about, at_s, &state, bodies.ephemeris, further_m_s2);
                pack(&CartesianState { position_m: state.velocity_m_s, velocity_m_s: total_m_s2 })
            })?;
            Ok::<_, IntegrationError>(next)
        };
        center.level = center.level.saturating_sub(1);
        let mut count = 0;
        let mut next = loop {
            let length_s = gravity.settings.cell_s / f64::from(1_u32 << center.level);
            let to_s = edge_after_s(start_s, length_s).min(limit_s);
            count += 1;
            let may_halve = center.level < IntegrationCenter::FINEST;
            match integrate(to_s, &mut bodies) {
                Ok(next) if !may_halve || gravity.is_resolved(&next.segment) => break next,
                Err(error) if !may_halve => return Err(error.into()),
                Ok(_) | Err(IntegrationError::NotConverged { .. }) => center.level += 1,
                Err(error) => return Err(error.into()),
            }
        };
        center.reaches = None;
        let path = |next: &SegmentChain<6, TERMS>, at_s: f64| unpack(&next.value(at_s));
        let span = Span::new(start_s, next.end_s);
        if let Some(reached) = bodies.sphere_reached(span, |at_s| path(&next, at_s))
            && reached.at_s > start_s
        {
            count += 1;
            next = integrate(reached.at_s, &mut bodies)?;
            center.reaches = Some(SphereCrossing { at_s: next.end_s, ..reached });
        }
        let span = Span::new(start_s, next.end_s);
        bodies.check_above(span, |at_s| path(&next, at_s))?;
        center.set_offset(span, gravity.model.center, bodies.ephemeris);
        (self.chain, self.deviation, self.center) = (next, None, Some(center));
        Ok(count)
    }

    /// Ends the present segment at `at_s`, within it: what was computed beyond is void, because an acceleration changes
    /// there, or the velocity jumps by `delta_v_m_s`.
    pub fn cut(&mut self, at_s: f64, delta_v_m_s: &Vector3<f64>) {
        let mut state = self.own_state_at(at_s);
        state.velocity_m_s += delta_v_m_s;
        self.chain.cut(at_s, pack(&state));
        self.deviation = None;
        if let Some(center) = &mut self.center {
            center.cut(at_s);
        }
    }
}

fn check_above(distance_m: f64, at_s: f64, radius_m: f64) -> Result<(), OrbitIntegrationError> {
    if distance_m < radius_m {
        Err(OrbitIntegrationError::Impact { at_s, distance_m, radius_m })
    } else {
        Ok(())
    }
}
