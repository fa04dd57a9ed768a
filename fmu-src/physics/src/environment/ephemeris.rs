//! Heliocentric positions of the planets in EME2000 from VSOP87 (Bretagnon and Francou 1988), looked up in
//! Chebyshev segments.
//!
//! One evaluation of VSOP87 sums thousands of cosines (0.1 to 0.2 ms). [`Ephemeris`] therefore keeps Chebyshev
//! segments with edges at whole multiples of their length past J2000. A segment is a pure function of its number:
//! what was requested before never changes a bit. All planets but the Earth are fitted in two layers: osculating elements,
//! which vary slowly, in segments of 32 days; positions computed from them fill 8 days at a time. Segments of elements have
//! 11 nodes, and at both ends values and rates that they share with their neighbours, each from 3 evaluations. The Earth, which
//! carries the Moon's monthly swing, is fitted directly, 17 evaluations for 16 days. The Sun stands still.
//! The Moon stands beyond the barycentre of Earth and Moon, as far as their masses say: the difference of two of VSOP87's
//! rectangular series, 24 evaluations for 16 days.
//! A last layer interpolates these segments by 6 Chebyshev terms for 3 hours; [`Ephemeris::state`] evaluates it.
//!
//! Error of the fit anywhere between 1900 and 2100 (tested): Mercury below 100 m, Venus below 10 m, Mars and Jupiter
//! below 20 m, Earth below 1 m. Segments meet to 0.1 m and 1e-5 m/s. VSOP87 itself is good to about 1 km for Mercury, a few for
//! Venus and the Earth, tens for Mars and hundreds for Jupiter in that time: so far apart are its own variants in elements
//! and in rectangular coordinates. The Moon from the Earth errs by some hundred kilometres, its segments by 2 km.
//!
//! A Julian date resolves 4e-5 s, in which Mercury moves by 2 m: what is evaluated is moved to the date itself.
//!
//! Two neighbouring segments of positions are kept, so that evaluations on both sides of an edge need no new fit. Segments for which
//! VSOP87 itself is evaluated are kept in an [`EphemerisCache`], which forecasts and repeated simulations of one instance share.

use core::f64::consts::TAU;
use std::sync::{Arc, Mutex, PoisonError};

use nalgebra::{Matrix3, SVector, Vector3};

mod segments;

use super::CartesianState;
use super::orbit::kepler::eccentric_anomaly;
use super::time::{julian_date, julian_date_rounding_s};
use crate::bodies::Body;
use crate::constants::{ASTRONOMICAL_UNIT_M, DAY_S, EARTH_TO_MOON_MASS};
use crate::math;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;
use segments::{SegmentCache, SegmentCounter};

/// Nodes within an element segment.
const ELEMENT_NODES: usize = 11;
/// Coefficients of an element segment: as many as it has nodes, and value and rate at both ends.
const ELEMENT_TERMS: usize = ELEMENT_NODES + 4;
/// Evaluations of VSOP87 for an element segment.
const ELEMENT_EVALUATIONS: u64 = ELEMENT_NODES as u64 + 6;
/// Coefficients of a position segment of all planets but the Earth.
const PLANET_TERMS: usize = 13;
/// Coefficients of a position segment of the Earth.
const EARTH_TERMS: usize = 17;
/// Number of the Moon, after those of the bodies.
const MOON: usize = Body::COUNT;
/// Coefficients of a position segment of the Moon from the Earth.
const MOON_TERMS: usize = 12;
/// Length of an element segment.
const LONG_S: f64 = 32.0 * DAY_S;
/// Length of a position segment of the Earth, and of the Moon.
const MIDDLE_S: f64 = 16.0 * DAY_S;
/// Length of a position segment of all other planets.
const SHORT_S: f64 = 8.0 * DAY_S;
/// Coefficients of an interpolation segment.
const INTERPOLATION_TERMS: usize = 6;
/// Length of an interpolation segment, a divisor of all other lengths.
const INTERPOLATION_S: f64 = 0.125 * DAY_S;
/// Span of the interpolation segments in memory, in s: an n-body step evaluates the same nodes several times.
const INTERPOLATED_S: f64 = 14.0 * INTERPOLATION_S;
/// How far from the end of an element segment its rate is taken.
const RATE_STEP_S: f64 = 0.1 * DAY_S;

/// Epochs VSOP87 is made for: 4000 years around J2000, s.
pub const VALID_EPOCH_S: f64 = 4000.0 * 365.25 * DAY_S;
/// The earliest of those epochs, in s.
pub const EARLIEST_EPOCH_S: f64 = -VALID_EPOCH_S;

/// A planet's osculating elements by VSOP87, and its mean motion there, in rad per 1000 Julian years.
pub(super) struct Theory {
    pub elements: fn(f64) -> vsop87::VSOP87Elements,
    pub mean_motion: f64,
}

/// Theory of a planet's orbit, the Earth's being that of its barycentre with the Moon; `None` for the Sun and the body of the
/// spacecraft's file.
pub(super) fn theory(body: Body) -> Option<Theory> {
    let (elements, mean_motion): (fn(f64) -> vsop87::VSOP87Elements, f64) = match body {
        Body::Sun | Body::Custom => return None,
        Body::Mercury => (vsop87::mercury, 26_087.903_141_574_2),
        Body::Venus => (vsop87::venus, 10_213.285_546_211),
        Body::Earth => (vsop87::earth_moon, 6_283.075_849_991_4),
        Body::Mars => (vsop87::mars, 3_340.612_434_14),
        Body::Jupiter => (vsop87::jupiter, 529.690_965_09),
    };
    Some(Theory { elements, mean_motion })
}

/// State of a body without a theory: the Sun in its centre; of others nothing is computed, so NaN.
pub(super) fn state_without_theory(body: Body, epoch_s: f64) -> CartesianState {
    let unknown = if body == Body::Sun { 0.0 } else { f64::NAN };
    CartesianState { position_m: Vector3::repeat(unknown * epoch_s), velocity_m_s: Vector3::repeat(unknown) }
}

impl Theory {
    /// Mean motion, in rad/s.
    pub(super) fn mean_motion_rad_s(&self) -> f64 {
        self.mean_motion / (365_250.0 * DAY_S)
    }
}

/// Span of time whose segments a cache keeps, in s.
const CACHED_S: f64 = 1000.0 * DAY_S;

/// Segments for which VSOP87 was evaluated, of each body up to a thousand days. A function of time alone, so no state.
#[derive(Clone, Debug, Default)]
pub struct EphemerisCache(Arc<Mutex<Segments>>);

/// Caches by body, allocated with the first segment.
#[derive(Debug, Default)]
struct Segments {
    elements: [Option<SegmentCache<6, ELEMENT_TERMS>>; Body::COUNT],
    earth: Option<SegmentCache<3, EARTH_TERMS>>,
    moon: Option<SegmentCache<3, MOON_TERMS>>,
}

impl EphemerisCache {
    /// Segment that contains `epoch_s`, of the body that `of` selects.
    fn segment<const D: usize, const N: usize>(
        &self,
        of: impl FnOnce(&mut Segments) -> &mut Option<SegmentCache<D, N>>,
        epoch_s: f64,
        length_s: f64,
        fit: impl FnOnce(f64, f64) -> Segment<D, N>,
    ) -> Segment<D, N> {
        // A panic leaves only whole segments.
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let slots = of(&mut all).get_or_insert_with(|| SegmentCache::spanning(CACHED_S, length_s));
        *slots.segment(epoch_s, length_s, fit)
    }

    /// Segment that contains `epoch_s`, held in `held` too, of a body whose position is a function of the Julian date.
    fn rectangular_segment<'s, const N: usize>(
        &self,
        held: &'s mut SegmentCache<3, N>,
        of: impl FnOnce(&mut Segments) -> &mut Option<SegmentCache<3, N>>,
        epoch_s: f64,
        position_m: impl Fn(f64) -> Vector3<f64>,
    ) -> &'s Segment<3, N> {
        held.segment(epoch_s, MIDDLE_S, |_, _| {
            self.segment(of, epoch_s, MIDDLE_S, |start_s, end_s| fit_rectangular(start_s, end_s, position_m))
        })
    }
}

/// Planet positions, a cache over VSOP87: the same epoch always gives the same bits. It is no state: skip it when serialising and
/// start from the default.
#[derive(Clone, Debug)]
pub struct Ephemeris {
    fitted: FittedSegments,
    /// By body, the Moon last.
    interpolated: [SegmentCache<3, INTERPOLATION_TERMS>; MOON + 1],
    entered: [SegmentCounter; MOON + 1],
}

/// Segments of positions fitted to VSOP87.
#[derive(Clone, Debug, Default)]
struct FittedSegments {
    planets: [SegmentCache<3, PLANET_TERMS>; Body::COUNT],
    earth: SegmentCache<3, EARTH_TERMS>,
    moon: SegmentCache<3, MOON_TERMS>,
    cache: EphemerisCache,
}

impl Default for Ephemeris {
    fn default() -> Self {
        Self {
            fitted: FittedSegments::default(),
            interpolated: core::array::from_fn(|_| SegmentCache::spanning(INTERPOLATED_S, INTERPOLATION_S)),
            entered: Default::default(),
        }
    }
}

impl Ephemeris {
    /// Ephemeris that shares a cache with others.
    pub fn with_cache(cache: &EphemerisCache) -> Self {
        let fitted = FittedSegments { cache: cache.clone(), ..FittedSegments::default() };
        Self { fitted, ..Self::default() }
    }

    /// Heliocentric position and velocity in EME2000 at `epoch_s` past J2000 TDB, geometric (no light time).
    ///
    /// The velocity is the derivative of the position, within 0.01 m/s. Beyond [`VALID_EPOCH_S`] the series loses its meaning;
    /// an epoch that is not finite gives NaN, as does a body that it does not know.
    pub fn state(&mut self, body: Body, epoch_s: f64) -> CartesianState {
        let Some(theory) = theory(body) else { return state_without_theory(body, epoch_s) };
        self.entered[body as usize].enter(epoch_s, FittedSegments::length_s(body));
        self.interpolated_state(body as usize, epoch_s, |fitted, span| match body {
            Body::Earth => interpolation(fitted.earth(epoch_s), span),
            _ => interpolation(fitted.planet(body, &theory, epoch_s), span),
        })
    }

    /// State by the interpolation of this number that contains an epoch, computed from the fitted segments if it is not held.
    fn interpolated_state(
        &mut self,
        number: usize,
        epoch_s: f64,
        part: impl FnOnce(&mut FittedSegments, Span) -> Segment<3, INTERPOLATION_TERMS>,
    ) -> CartesianState {
        let segment = self.interpolated[number].segment(epoch_s, INTERPOLATION_S, |start_s, end_s| {
            part(&mut self.fitted, Span::new(start_s, end_s))
        });
        let (position_m, velocity_m_s) = segment.value_and_derivative(epoch_s);
        CartesianState { position_m, velocity_m_s }
    }

    /// The first end of a segment after an epoch; within a microsecond of one, the one behind it.
    pub fn smooth_until_s(epoch_s: f64) -> f64 {
        (((epoch_s + 1e-6) / SHORT_S).floor() + 1.0) * SHORT_S
    }

    /// Position and velocity of the Moon from the Earth in EME2000 at `epoch_s`, geometric; see [`Ephemeris::state`].
    pub fn moon_from_earth(&mut self, epoch_s: f64) -> CartesianState {
        self.entered[MOON].enter(epoch_s, MIDDLE_S);
        self.interpolated_state(MOON, epoch_s, |fitted, span| interpolation(fitted.moon(epoch_s), span))
    }

    /// Begins a count of work: of each body the segment that is requested first counts as held.
    pub fn count_from_here(&mut self) {
        self.entered.iter_mut().for_each(SegmentCounter::restart);
    }

    /// How often VSOP87 itself, which takes some 100 to 200 microseconds each time, would have been evaluated so far by an
    /// ephemeris that held nothing but the first segment of each count: by what is requested alone, so that an ephemeris with a
    /// past and a new one count alike.
    pub fn evaluations(&self) -> u64 {
        let terms = |body| match body {
            Body::Sun | Body::Custom => 0,
            Body::Earth => EARTH_TERMS as u64,
            _ => ELEMENT_EVALUATIONS,
        };
        let planets: u64 =
            Body::ALL.iter().map(|&body| terms(body) * self.entered[body as usize].count).sum();
        planets + 2 * MOON_TERMS as u64 * self.entered[MOON].count
    }
}

impl FittedSegments {
    /// Length of the segments of a planet for which VSOP87 is evaluated, in s.
    fn length_s(body: Body) -> f64 {
        if body == Body::Earth { MIDDLE_S } else { LONG_S }
    }

    fn earth(&mut self, epoch_s: f64) -> &Segment<3, EARTH_TERMS> {
        let position_m = |date| from_rectangular(vsop87::vsop87a::earth(date));
        self.cache.rectangular_segment(&mut self.earth, |all| &mut all.earth, epoch_s, position_m)
    }

    fn moon(&mut self, epoch_s: f64) -> &Segment<3, MOON_TERMS> {
        let position_m = |date| {
            let barycentre_m = from_rectangular(vsop87::vsop87a::earth_moon(date));
            let earth_m = from_rectangular(vsop87::vsop87a::earth(date));
            (barycentre_m - earth_m) * (1.0 + EARTH_TO_MOON_MASS)
        };
        self.cache.rectangular_segment(&mut self.moon, |all| &mut all.moon, epoch_s, position_m)
    }

    /// Segment of positions that contains `epoch_s`, computed from slowly varying elements.
    fn planet(&mut self, body: Body, theory: &Theory, epoch_s: f64) -> &Segment<3, PLANET_TERMS> {
        let mean_motion_rad_s = theory.mean_motion_rad_s();
        let cache = &self.cache;
        self.planets[body as usize].segment(epoch_s, SHORT_S, |start_s, end_s| {
            // Nodes lie inside the segment that `epoch_s` chose, and that inside one segment of elements.
            let middle_s = ((epoch_s / LONG_S).floor() + 0.5) * LONG_S;
            let fit = |start_s, end_s| fit_elements(theory, [start_s, middle_s, end_s]);
            let slow = cache.segment(|all| &mut all.elements[body as usize], epoch_s, LONG_S, fit);
            Segment::fit(start_s, end_s, |node_s| {
                let [[a, longitude_rad, k, h, q, p]] = slow.value(node_s).data.0;
                let mean_longitude_rad = longitude_rad + mean_motion_rad_s * (node_s - middle_s);
                from_elements([a, mean_longitude_rad, k, h, q, p])
            })
        })
    }
}

/// Interpolates a part of a fitted segment.
fn interpolation<const N: usize>(fitted: &Segment<3, N>, span: Span) -> Segment<3, INTERPOLATION_TERMS> {
    fitted.part::<{ INTERPOLATION_TERMS - 1 }, INTERPOLATION_TERMS>(span.start_s, span.end_s)
}

/// Elements with the slow remainder of the longitude, in segments that continue smoothly: their ends have values, and rates by
/// differences, that are functions of the end alone.
fn fit_elements(theory: &Theory, [start_s, middle_s, end_s]: [f64; 3]) -> Segment<6, ELEMENT_TERMS> {
    let mean_motion_rad_s = theory.mean_motion_rad_s();
    let mut first_rad = None;
    let mut slow = |at_s: f64| {
        let e = (theory.elements)(julian_date(at_s));
        let mut longitude_rad = e.l - mean_motion_rad_s * (at_s - julian_date_rounding_s(at_s) - middle_s);
        // The crate cuts longitudes at a full turn, which may fall inside the segment.
        let near_rad = *first_rad.get_or_insert(longitude_rad);
        longitude_rad -= ((longitude_rad - near_rad) / TAU).round() * TAU;
        SVector::from([e.a, longitude_rad, e.k, e.h, e.q, e.p])
    };
    let within = Segment::<6, ELEMENT_NODES>::fit(start_s, end_s, &mut slow);
    let ends = [start_s, end_s].map(|at_s| {
        let [before, after] = [at_s - RATE_STEP_S, at_s + RATE_STEP_S].map(&mut slow);
        [slow(at_s), (after - before) / (2.0 * RATE_STEP_S)]
    });
    within.with_ends(&ends)
}

/// A fit of rectangular coordinates by Julian date, in m; the rounding of the date is corrected by the velocity.
fn fit_rectangular<const N: usize>(
    start_s: f64,
    end_s: f64,
    position_m: impl Fn(f64) -> Vector3<f64>,
) -> Segment<3, N> {
    let nodes_s = Segment::<3, N>::nodes(start_s, end_s);
    let rounded_m = nodes_s.map(|at_s| position_m(julian_date(at_s)));
    let rounded = Segment::<3, N>::from_samples(start_s, end_s, &rounded_m);
    let samples_m: [Vector3<f64>; N] = core::array::from_fn(|j| {
        rounded_m[j] + rounded.value_and_derivative(nodes_s[j]).1 * julian_date_rounding_s(nodes_s[j])
    });
    Segment::from_samples(start_s, end_s, &samples_m)
}

/// EME2000 position of VSOP87's rectangular coordinates in AU.
fn from_rectangular(p: vsop87::RectangularCoordinates) -> Vector3<f64> {
    eme2000_from_vsop87() * Vector3::new(p.x, p.y, p.z) * ASTRONOMICAL_UNIT_M
}

/// EME2000 position of VSOP87's elements: semi-major axis in AU, mean longitude, k + ih = e exp(i periapsis longitude),
/// q + ip = sin(inclination / 2) exp(i node).
fn from_elements([a, mean_longitude_rad, k, h, q, p]: [f64; 6]) -> Vector3<f64> {
    let e = math::hypot(k, h);
    let periapsis_longitude_rad = math::atan2(h, k);
    let anomaly = eccentric_anomaly(mean_longitude_rad - periapsis_longitude_rad, e, 1.0 - e);
    // In the orbital plane, first axis toward periapsis, then toward the origin of longitudes.
    let along = anomaly.cos - e;
    let across = ((1.0 - e) * (1.0 + e)).sqrt() * anomaly.sin;
    let (sin, cos) = math::sin_cos(periapsis_longitude_rad);
    let (x, y) = (along * cos - across * sin, along * sin + across * cos);
    let cos_half_inclination = (1.0 - q * q - p * p).sqrt();
    let tilt = 2.0 * (p * x - q * y);
    let ecliptic = Vector3::new(x - p * tilt, y + q * tilt, -tilt * cos_half_inclination);
    eme2000_from_vsop87() * ecliptic * (a * ASTRONOMICAL_UNIT_M)
}

/// From VSOP87's ecliptic and dynamical equinox of J2000 to the FK5 equator and equinox: Rz(-0.0990") Rx(23 deg 26'
/// 21.4091"), the matrix of the authors' `vsop87.doc` with its last digits made orthonormal.
pub(super) fn eme2000_from_vsop87() -> Matrix3<f64> {
    const EQUINOX: f64 = 4.799_66e-7;
    const COS: f64 = 0.917_482_137_086_841;
    const SIN: f64 = 0.397_776_982_901_931;
    // sqrt(1 - EQUINOX^2)
    const ONE: f64 = 0.999_999_999_999_884_8;
    Matrix3::new(ONE, EQUINOX * COS, -EQUINOX * SIN, -EQUINOX, ONE * COS, -ONE * SIN, 0.0, SIN, COS)
}

#[cfg(test)]
mod tests;
