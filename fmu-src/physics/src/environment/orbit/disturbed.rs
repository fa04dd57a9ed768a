//! An orbit integrated under gravity with its disturbances: the planet's flattening, the Sun's tide, and whatever
//! acceleration the caller adds: of light and heat ahead, of thrust while it acts (`deviation`).

use nalgebra::{SVector, Vector3};
use serde::{Deserialize, Serialize};
use thiserror::Error;

use super::deviation::{Deviation, NODES, TERMS};
use super::elements::{OrbitError, check, check_mu};
use crate::{
    bodies::BodyData,
    constants::GM_SUN_M3_S2,
    environment::CartesianState,
    numerics::{
        chebyshev::Segment,
        collocation::{Collocation, IntegrationError, SegmentChain},
    },
};

/// Flattening of the central body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flattening {
    /// Second zonal harmonic J2, unnormalised.
    pub j2: f64,
    /// Radius to which J2 refers, m.
    pub reference_radius_m: f64,
    /// North pole, unit vector in EME2000.
    pub pole: Vector3<f64>,
}

impl Flattening {
    /// That of a body.
    pub fn of(body: &BodyData) -> Self {
        Self { j2: body.j2, reference_radius_m: body.j2_radius_m, pole: body.pole() }
    }
}

/// What pulls on a spacecraft about a body.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Gravity {
    /// Gravitational parameter of the central body, m3/s2.
    pub mu_m3_s2: f64,
    /// Its flattening, if that counts.
    pub flattening: Option<Flattening>,
    /// Gravitational parameter of a distant body (the Sun) whose tide counts, m3/s2.
    pub tide_mu_m3_s2: Option<f64>,
}

impl Gravity {
    /// A point mass and nothing else.
    pub fn point_mass(mu_m3_s2: f64) -> Self {
        Self { mu_m3_s2, flattening: None, tide_mu_m3_s2: None }
    }

    /// A planet with its flattening and the Sun's tide.
    pub fn of(planet: &BodyData) -> Self {
        Self {
            mu_m3_s2: planet.gm_m3_s2,
            flattening: Some(Flattening::of(planet)),
            tide_mu_m3_s2: Some(GM_SUN_M3_S2),
        }
    }

    /// Acceleration in EME2000, m/s2, at a position relative to the central body; `tide_body_m` is the position of the
    /// distant body relative to the central one.
    pub fn acceleration_m_s2(&self, position_m: &Vector3<f64>, tide_body_m: &Vector3<f64>) -> Vector3<f64> {
        let distance_squared = position_m.norm_squared();
        let inverse = 1.0 / distance_squared.sqrt();
        let point = self.mu_m3_s2 * inverse * inverse * inverse;
        let mut sum = position_m * -point;
        if let Some(Flattening { j2, reference_radius_m, pole }) = self.flattening {
            // Gradient of -(mu / r) J2 (R / r)^2 (3 sin^2(latitude) - 1) / 2.
            let sin_latitude = position_m.dot(&pole) * inverse;
            let ratio = reference_radius_m * inverse;
            let factor = 1.5 * j2 * ratio * ratio * point;
            sum += position_m * (factor * (5.0 * sin_latitude * sin_latitude - 1.0));
            sum -= pole * (2.0 * factor * sin_latitude / inverse);
        }
        if let Some(mu) = self.tide_mu_m3_s2 {
            sum += tide_m_s2(position_m, tide_body_m, mu);
        }
        sum
    }
}

/// Acceleration by a distant body relative to the centre's own fall toward it, m/s2:
/// `mu (d / |d|^3 - s / |s|^3)` with `d = s - r`, in Battin's form that does not cancel.
pub fn tide_m_s2(position_m: &Vector3<f64>, tide_body_m: &Vector3<f64>, mu_m3_s2: f64) -> Vector3<f64> {
    let to_body = tide_body_m - position_m;
    let distance = to_body.norm();
    let q = position_m.dot(&(position_m - tide_body_m * 2.0)) / tide_body_m.norm_squared();
    // (1 + q)^(3/2) - 1
    let f = q * (3.0 + q * (3.0 + q)) / (1.0 + (1.0 + q) * (1.0 + q).sqrt());
    (position_m + tide_body_m * f) * (-mu_m3_s2 / (distance * distance * distance))
}

/// Why an integrated orbit ends.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
pub enum OrbitIntegrationError {
    /// The start or a parameter cannot be.
    #[error(transparent)]
    Start(#[from] OrbitError),
    /// A segment could not be integrated.
    #[error(transparent)]
    Integration(#[from] IntegrationError),
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

/// The integration method of a [`DisturbedOrbit`]: computed once, shared, no state.
#[derive(Clone, Debug, Default)]
pub struct OrbitMethod(Collocation<NODES, TERMS>);

/// A spacecraft's orbit as a chain of integrated segments with edges at whole multiples of their length: serialisable
/// state with dense output. Positions relative to the central body, in EME2000; times on the caller's clock.
///
/// Order 16 at the edges, degree 8 between them. With paper 004's orbit (periapsis 206 km above Mercury) segments of
/// 300 s keep a revolution to 1e-4 m, of 600 s to 1 m (tested).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DisturbedOrbit {
    chain: SegmentChain<6, TERMS>,
    radius_m: f64,
    /// By thrust within the present segment; absent without.
    deviation: Option<Deviation>,
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
        check("start time in s", start_s, start_s.is_finite(), "a finite number")?;
        check(
            "segment length in s",
            segment_length_s,
            segment_length_s.is_finite() && segment_length_s > 0.0,
            "a finite number above 0",
        )?;
        check(
            "radius in m",
            radius_m,
            radius_m.is_finite() && radius_m >= 0.0,
            "a finite number, 0 or more",
        )?;
        let start = pack(state);
        start.iter().try_for_each(|x| check("position or velocity", *x, x.is_finite(), "finite numbers"))?;
        check_above(state.position_m.norm(), start_s, radius_m)?;
        Ok(Self { chain: SegmentChain::new(segment_length_s, start_s, start), radius_m, deviation: None })
    }

    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self) -> bool {
        self.chain.is_valid()
            && self.radius_m >= 0.0
            && self.deviation.as_ref().is_none_or(Deviation::is_valid)
    }

    /// How far the integration has come, s.
    pub fn end_s(&self) -> f64 {
        self.chain.end_s()
    }

    /// Where the present segment starts, s.
    pub fn start_s(&self) -> f64 {
        self.chain.start_s()
    }

    /// Length of the segments, s.
    pub fn segment_length_s(&self) -> f64 {
        self.chain.length_s()
    }

    /// Position and velocity at a time of the present segment.
    pub fn state_at(&self, at_s: f64) -> CartesianState {
        let reference = self.chain.value(at_s);
        unpack(&self.deviation.map_or(reference, |deviation| reference + deviation.value(at_s)))
    }

    /// Whether thrust has acted within the present segment.
    pub fn is_deviated(&self) -> bool {
        self.deviation.is_some()
    }

    /// Thrust accelerates the spacecraft by `thrust_m_s2(t)`, EME2000, smooth from `start_s` to `end_s`, within the present
    /// segment and from where the last thrust ended or later; none = it coasts on. The Sun's tide is that of the segment.
    ///
    /// # Errors
    /// [`OrbitIntegrationError`]; the orbit stays as it was.
    pub fn accelerate(
        &mut self,
        method: &OrbitMethod,
        gravity: &Gravity,
        [start_s, end_s]: [f64; 2],
        thrust_m_s2: Option<impl Fn(f64) -> Vector3<f64>>,
    ) -> Result<(), OrbitIntegrationError> {
        if end_s <= start_s || (thrust_m_s2.is_none() && self.deviation.is_none()) {
            return Ok(());
        }
        // Over a deviation the tide changes by less than 1e-10 m/s2 a kilometre.
        let gravity = Gravity { tide_mu_m3_s2: None, ..*gravity };
        let near_m_s2 = |position_m: &Vector3<f64>| gravity.acceleration_m_s2(position_m, &Vector3::zeros());
        let thrust_m_s2 = thrust_m_s2.map(|thrust| Segment::<3, NODES>::fit(start_s, end_s, thrust));
        let before = self.deviation.map_or(SVector::zeros(), |deviation| deviation.value(start_s));
        let next = Deviation::integrate(&method.0, &before, [start_s, end_s], |at_s, off_m| {
            let reference_m = unpack(&self.chain.value(at_s)).position_m;
            let fall = near_m_s2(&(reference_m + off_m)) - near_m_s2(&reference_m);
            thrust_m_s2.as_ref().map_or(fall, |thrust| fall + thrust.value(at_s))
        })?;
        let distance_m =
            (unpack(&self.chain.value(end_s)).position_m + unpack(&next.value(end_s)).position_m).norm();
        check_above(distance_m, end_s, self.radius_m)?;
        self.deviation = Some(next);
        Ok(())
    }

    /// Integrates one more segment, to `limit_s` if that comes first: because an acceleration changes there. Later segments end at
    /// whole multiples again. `tide_body_m(t)` is the Sun's position relative to the central body, `extra(t, state)` any further
    /// acceleration, m/s2, smooth within the segment; both in EME2000. Called 20 to 40 times a segment.
    ///
    /// # Errors
    /// [`OrbitIntegrationError`]; the orbit stays as it was.
    pub fn advance_to(
        &mut self,
        limit_s: f64,
        method: &OrbitMethod,
        gravity: &Gravity,
        mut tide_body_m: impl FnMut(f64) -> Vector3<f64>,
        mut extra: impl FnMut(f64, &CartesianState) -> Vector3<f64>,
    ) -> Result<(), OrbitIntegrationError> {
        check_mu(gravity.mu_m3_s2)?;
        let mut next = self.chain;
        if self.deviation.is_some() {
            next.cut(next.end_s(), pack(&self.state_at(next.end_s())));
        }
        next.advance_to(&method.0, limit_s, |at_s, y| {
            let state = unpack(y);
            let tide_body_m =
                if gravity.tide_mu_m3_s2.is_some() { tide_body_m(at_s) } else { Vector3::zeros() };
            let acceleration =
                gravity.acceleration_m_s2(&state.position_m, &tide_body_m) + extra(at_s, &state);
            pack(&CartesianState { position_m: state.velocity_m_s, velocity_m_s: acceleration })
        })?;
        // The lowest point of a segment is near an end or where the radial speed changes sign: look at nine points.
        for i in 0..=8 {
            let at_s = next.start_s() + (next.end_s() - next.start_s()) * f64::from(i) / 8.0;
            check_above(unpack(&next.value(at_s)).position_m.norm(), at_s, self.radius_m)?;
        }
        (self.chain, self.deviation) = (next, None);
        Ok(())
    }

    /// Ends the present segment at `at_s`, within it: what was computed beyond is void, because an acceleration changes
    /// there, or the velocity jumps by `delta_v_m_s`.
    pub fn cut(&mut self, at_s: f64, delta_v_m_s: &Vector3<f64>) {
        let mut state = self.state_at(at_s);
        state.velocity_m_s += delta_v_m_s;
        self.chain.cut(at_s, pack(&state));
        self.deviation = None;
    }
}

fn check_above(distance_m: f64, at_s: f64, radius_m: f64) -> Result<(), OrbitIntegrationError> {
    if distance_m < radius_m {
        Err(OrbitIntegrationError::Impact { at_s, distance_m, radius_m })
    } else {
        Ok(())
    }
}

fn pack(state: &CartesianState) -> SVector<f64, 6> {
    let (r, v) = (state.position_m, state.velocity_m_s);
    SVector::from([r.x, r.y, r.z, v.x, v.y, v.z])
}

fn unpack(y: &SVector<f64, 6>) -> CartesianState {
    CartesianState {
        position_m: Vector3::new(y[0], y[1], y[2]),
        velocity_m_s: Vector3::new(y[3], y[4], y[5]),
    }
}
