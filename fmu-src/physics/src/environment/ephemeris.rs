//! Heliocentric positions of the planets in EME2000 from VSOP87 (Bretagnon and Francou 1988), looked up in
//! Chebyshev segments.
//!
//! One evaluation of VSOP87 sums thousands of cosines (0.1 to 0.2 ms). [`Ephemeris`] therefore keeps Chebyshev
//! segments with edges at whole multiples of their length past J2000. A segment is a pure function of its number:
//! what was asked before never changes a bit. All planets but the Earth are fitted in two layers: 12 evaluations of the
//! osculating elements, which vary slowly, cover 32 days; positions computed from them fill 8 days at a time. The
//! Earth, which carries the Moon's monthly swing, is fitted directly, 13 evaluations for 32 days. The Sun stands still.
//!
//! Error of the fit anywhere between 1900 and 2100 (tested): Mercury below 100 m, Venus below 10 m, Mars and Jupiter
//! below 100 m, Earth below 5 km (3e-8 rad as a direction). VSOP87 itself is good to about 1 km for Mercury, a few for
//! Venus and the Earth, tens for Mars and hundreds for Jupiter in that time: so far apart are its own variants in elements
//! and in rectangular coordinates.
//!
//! Two neighbouring segments of each layer are held, so that looking back and forth over an edge costs no refill.

use core::f64::consts::TAU;

use nalgebra::{Matrix3, SVector, Vector3};

use super::{CartesianState, orbit::kepler::eccentric_anomaly_rad, time::julian_date};
use crate::{
    bodies::Body,
    constants::{ASTRONOMICAL_UNIT_M, DAY_S},
    numerics::chebyshev::Segment,
};

/// Coefficients of an element segment.
const ELEMENT_TERMS: usize = 12;
/// Coefficients of a position segment of Mercury and Venus.
const PLANET_TERMS: usize = 12;
/// Coefficients of a position segment of the Earth.
const EARTH_TERMS: usize = 13;
/// Length of an element segment and of the Earth's position segment.
const LONG_S: f64 = 32.0 * DAY_S;
/// Length of the position segments of Mercury and Venus.
const SHORT_S: f64 = 8.0 * DAY_S;

/// Epochs VSOP87 is made for: 4000 years around J2000, s.
pub const VALID_EPOCH_S: f64 = 4000.0 * 365.25 * DAY_S;
/// The earliest of those epochs, in s.
pub const EARLIEST_EPOCH_S: f64 = -VALID_EPOCH_S;

/// A planet's osculating elements by VSOP87, and its mean motion there, in rad per 1000 Julian years.
pub(super) struct Theory {
    pub elements: fn(f64) -> vsop87::VSOP87Elements,
    pub mean_motion: f64,
}

const MERCURY: Theory = Theory { elements: vsop87::mercury, mean_motion: 26_087.903_141_574_2 };
const VENUS: Theory = Theory { elements: vsop87::venus, mean_motion: 10_213.285_546_211 };
const EARTH_MOON: Theory = Theory { elements: vsop87::earth_moon, mean_motion: 6_283.075_849_991_4 };
const MARS: Theory = Theory { elements: vsop87::mars, mean_motion: 3_340.612_434_14 };
const JUPITER: Theory = Theory { elements: vsop87::jupiter, mean_motion: 529.690_965_09 };

/// The theory of a planet's orbit, the Earth's being that of its barycentre with the Moon; `None` for the Sun.
pub(super) fn theory(body: Body) -> Option<&'static Theory> {
    Some(match body {
        Body::Sun => return None,
        Body::Mercury => &MERCURY,
        Body::Venus => &VENUS,
        Body::Earth => &EARTH_MOON,
        Body::Mars => &MARS,
        Body::Jupiter => &JUPITER,
    })
}

impl Theory {
    /// In rad/s.
    pub fn mean_motion_rad_s(&self) -> f64 {
        self.mean_motion / (365_250.0 * DAY_S)
    }
}

/// Planet positions, a cache over VSOP87 of fixed size: looking up never allocates, and the same epoch always gives
/// the same bits. It is no state: skip it when serialising and start from the default.
#[derive(Clone, Debug, Default)]
pub struct Ephemeris {
    planets: [TwoLayers; Body::ALL.len()],
    earth: Slots<3, EARTH_TERMS>,
    entered: [Entered; Body::ALL.len()],
}

/// The long segments that a count of work has seen, whatever is held of them.
#[derive(Clone, Copy, Debug, Default)]
struct Entered {
    /// One of even and one of odd number, as [`Slots`] hold them.
    numbers: [Option<i64>; 2],
    /// How many were entered after the first one.
    count: u64,
}

impl Entered {
    fn enter(&mut self, number: i64) {
        let is_first = self.numbers == [None; 2];
        let slot = &mut self.numbers[(number & 1) as usize];
        if *slot != Some(number) {
            *slot = Some(number);
            self.count += u64::from(!is_first);
        }
    }
}

impl Ephemeris {
    /// Heliocentric position and velocity in EME2000 at `epoch_s` past J2000 TDB, geometric (no light time).
    ///
    /// The velocity is the derivative of the position, within 0.01 m/s, or 0.5 m/s for the Earth. Beyond
    /// [`VALID_EPOCH_S`] the series loses its meaning; an epoch that is not finite gives NaN.
    pub fn state(&mut self, body: Body, epoch_s: f64) -> CartesianState {
        self.entered[body as usize].enter((epoch_s / LONG_S).floor() as i64);
        let (position_m, velocity_m_s) = match theory(body) {
            None => (Vector3::repeat(0.0 * epoch_s), Vector3::zeros()),
            Some(theory) if body != Body::Earth => self.planets[body as usize].state(epoch_s, theory),
            Some(_) => {
                let position = |epoch_s| from_rectangular(vsop87::vsop87a::earth(julian_date(epoch_s)));
                self.earth.segment(epoch_s, LONG_S, position).value_and_derivative(epoch_s)
            }
        };
        CartesianState { position_m, velocity_m_s }
    }

    /// Begins a count of work: of each body the segment that is requested first counts as held.
    pub fn count_from_here(&mut self) {
        for entered in &mut self.entered {
            entered.numbers = [None; 2];
        }
    }

    /// How often VSOP87 itself, which takes some 100 to 200 microseconds each time, would have been evaluated so far by an
    /// ephemeris that held nothing but the first segment of each count: by what is requested alone, so that an ephemeris with a
    /// past and a new one count alike.
    pub fn evaluations(&self) -> u64 {
        let terms = |body| match body {
            Body::Sun => 0,
            Body::Earth => EARTH_TERMS as u64,
            _ => ELEMENT_TERMS as u64,
        };
        Body::ALL.iter().map(|&body| terms(body) * self.entered[body as usize].count).sum()
    }

    /// The position alone, see [`Ephemeris::state`].
    pub fn position_m(&mut self, body: Body, epoch_s: f64) -> Vector3<f64> {
        self.state(body, epoch_s).position_m
    }
}

/// Two segments, one for even and one for odd numbers.
#[derive(Clone, Debug, Default)]
struct Slots<const D: usize, const N: usize> {
    held: [Option<(i64, Segment<D, N>)>; 2],
}

impl<const D: usize, const N: usize> Slots<D, N> {
    fn segment(
        &mut self,
        epoch_s: f64,
        length_s: f64,
        function: impl FnMut(f64) -> SVector<f64, D>,
    ) -> &Segment<D, N> {
        let number = (epoch_s / length_s).floor() as i64;
        let slot = &mut self.held[(number & 1) as usize];
        if slot.as_ref().is_some_and(|(held, _)| *held != number) {
            *slot = None;
        }
        let (_, segment) = slot.get_or_insert_with(|| {
            let start_s = number as f64 * length_s;
            (number, Segment::fit(start_s, start_s + length_s, function))
        });
        segment
    }
}

/// Slowly varying elements, and positions computed from them.
#[derive(Clone, Debug, Default)]
struct TwoLayers {
    elements: Slots<6, ELEMENT_TERMS>,
    position: Slots<3, PLANET_TERMS>,
}

impl TwoLayers {
    /// Position and velocity at `epoch_s`. Only the slow remainder of the longitude is fitted: any value near gives the
    /// same positions.
    fn state(&mut self, epoch_s: f64, theory: &Theory) -> (Vector3<f64>, Vector3<f64>) {
        let mean_motion_rad_s = theory.mean_motion_rad_s();
        let elements = &mut self.elements;
        let segment = self.position.segment(epoch_s, SHORT_S, |node_s| {
            // Nodes lie inside the segment that `epoch_s` chose, and that inside one segment of elements.
            let number = (epoch_s / LONG_S).floor();
            let middle_s = (number + 0.5) * LONG_S;
            let mut first_rad = None;
            let slow = elements.segment(epoch_s, LONG_S, |at_s| {
                let e = (theory.elements)(julian_date(at_s));
                let mut longitude_rad = e.l - mean_motion_rad_s * (at_s - middle_s);
                // The crate cuts longitudes at a full turn, which may fall inside the segment.
                let near_rad = *first_rad.get_or_insert(longitude_rad);
                longitude_rad -= ((longitude_rad - near_rad) / TAU).round() * TAU;
                SVector::from([e.a, longitude_rad, e.k, e.h, e.q, e.p])
            });
            let [[a, longitude_rad, k, h, q, p]] = slow.value(node_s).data.0;
            let mean_longitude_rad = longitude_rad + mean_motion_rad_s * (node_s - middle_s);
            from_elements([a, mean_longitude_rad, k, h, q, p])
        });
        segment.value_and_derivative(epoch_s)
    }
}

/// EME2000 position of VSOP87's rectangular coordinates in AU.
fn from_rectangular(p: vsop87::RectangularCoordinates) -> Vector3<f64> {
    eme2000_from_vsop87() * Vector3::new(p.x, p.y, p.z) * ASTRONOMICAL_UNIT_M
}

/// EME2000 position of VSOP87's elements: semi-major axis in AU, mean longitude, k + ih = e exp(i periapsis longitude),
/// q + ip = sin(inclination / 2) exp(i node).
fn from_elements([a, mean_longitude_rad, k, h, q, p]: [f64; 6]) -> Vector3<f64> {
    let e = libm::hypot(k, h);
    let periapsis_longitude_rad = h.atan2(k);
    let (sin_anomaly, cos_anomaly) =
        eccentric_anomaly_rad(mean_longitude_rad - periapsis_longitude_rad, e).sin_cos();
    // In the orbital plane, first axis toward periapsis, then toward the origin of longitudes.
    let along = cos_anomaly - e;
    let across = ((1.0 - e) * (1.0 + e)).sqrt() * sin_anomaly;
    let (sin, cos) = periapsis_longitude_rad.sin_cos();
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
mod tests {
    //! The planets stand where VSOP87's authors, the observed transits and Kepler's laws put them.

    use super::*;
    use crate::{constants::GM_SUN_M3_S2, environment::time::MOMENTUM_STUDY_START_S};

    const CENTURY_S: f64 = 36_525.0 * DAY_S;

    fn epoch_s(text: &str) -> f64 {
        text.parse::<hifitime::Epoch>().unwrap().to_tdb_seconds()
    }

    /// Scattered epochs between 1900 and 2100, the same every run.
    fn scattered(count: u32) -> impl Iterator<Item = f64> {
        (0..count).map(|i| ((f64::from(i) * 0.618_033_988_75).fract() * 2.0 - 1.0) * CENTURY_S)
    }

    #[test]
    fn rotation_is_the_published_one() {
        let dcm = eme2000_from_vsop87();
        let published = Matrix3::new(
            1.0,
            0.000_000_440_360,
            -0.000_000_190_919,
            -0.000_000_479_966,
            0.917_482_137_087,
            -0.397_776_982_902,
            0.0,
            0.397_776_982_902,
            0.917_482_137_087,
        );
        assert!((dcm - published).abs().max() < 1.1e-12);
        assert!((dcm * dcm.transpose() - Matrix3::identity()).norm() < 1e-14);
    }

    #[test]
    fn check_values_of_the_authors() {
        // vsop87.chk, VSOP87A at JD 2451545.0 and 2415020.0, AU.
        let mut ephemeris = Ephemeris::default();
        for (body, day, x, y) in [
            (Body::Mercury, 0.0, -0.130_093_411_5, -0.447_287_671_6),
            (Body::Mercury, -36_525.0, -0.389_724_693_1, -0.150_224_219_9),
            (Body::Venus, 0.0, -0.718_302_279_7, -0.032_654_601_7),
            (Body::Earth, 0.0, -0.177_135_458_6, 0.967_241_623_7),
            (Body::Mars, 0.0, 1.390_715_926_4, -0.013_415_704_3),
            (Body::Jupiter, 0.0, 4.001_174_026_8, 2.938_581_007_7),
        ] {
            let position = ephemeris.position_m(body, day * DAY_S);
            let ecliptic = eme2000_from_vsop87().transpose() * position / ASTRONOMICAL_UNIT_M;
            let tolerance = match body {
                Body::Mercury => 2e-9,
                Body::Mars => 1e-7,
                Body::Jupiter => 1e-6,
                _ => 3e-8,
            };
            assert!((ecliptic.x - x).abs() < tolerance, "{body:?} {ecliptic}");
            assert!((ecliptic.y - y).abs() < tolerance, "{body:?} {ecliptic}");
        }
    }

    #[test]
    fn fit_error_stays_below_the_stated() {
        // What is fitted, and the authors' rectangular series, which they cut off elsewhere.
        let elements = |body, jd| match body {
            Body::Mercury => Some(vsop87::mercury(jd)),
            Body::Venus => Some(vsop87::venus(jd)),
            Body::Mars => Some(vsop87::mars(jd)),
            Body::Jupiter => Some(vsop87::jupiter(jd)),
            Body::Sun | Body::Earth => None,
        };
        let rectangular = |body, jd| match body {
            Body::Mercury => vsop87::vsop87a::mercury(jd),
            Body::Venus => vsop87::vsop87a::venus(jd),
            Body::Mars => vsop87::vsop87a::mars(jd),
            Body::Jupiter => vsop87::vsop87a::jupiter(jd),
            Body::Sun | Body::Earth => vsop87::vsop87a::earth(jd),
        };
        let mut ephemeris = Ephemeris::default();
        for (body, fit_m, apart_m) in [
            (Body::Mercury, 100.0, 300.0),
            (Body::Venus, 10.0, 2500.0),
            (Body::Mars, 100.0, 30_000.0),
            (Body::Jupiter, 100.0, 300_000.0),
            (Body::Earth, 5000.0, 5000.0),
        ] {
            for epoch_s in scattered(200) {
                let found = ephemeris.position_m(body, epoch_s);
                let jd = julian_date(epoch_s);
                if let Some(e) = elements(body, jd) {
                    let error_m = (found - from_elements([e.a, e.l, e.k, e.h, e.q, e.p])).norm();
                    assert!(error_m < fit_m, "{body:?}: {error_m} m");
                }
                let error_m = (found - from_rectangular(rectangular(body, jd))).norm();
                assert!(error_m < apart_m, "{body:?}: {error_m} m from VSOP87A");
            }
        }
    }

    #[test]
    fn segments_meet_at_their_edges() {
        let mut ephemeris = Ephemeris::default();
        for (body, length_s, gap_m, gap_m_s) in [
            (Body::Mercury, SHORT_S, 200.0, 0.02),
            (Body::Venus, SHORT_S, 20.0, 0.02),
            (Body::Earth, LONG_S, 10_000.0, 1.0),
        ] {
            for number in 400..430 {
                let edge_s = f64::from(number) * length_s;
                let before = ephemeris.state(body, edge_s.next_down());
                let after = ephemeris.state(body, edge_s);
                let step_m = (after.position_m - before.position_m).norm();
                let step_m_s = (after.velocity_m_s - before.velocity_m_s).norm();
                assert!(step_m < gap_m && step_m_s < gap_m_s, "{body:?} {number}: {step_m} m {step_m_s} m/s");
            }
        }
    }

    #[test]
    fn observed_transits_across_the_sun() {
        // NASA's catalogue of transits: time of greatest transit (UT) and least distance of the planet from the Sun's
        // centre in arc seconds. Light from the planet left earlier by its light time.
        for (body, text, published_arcsec) in [
            (Body::Mercury, "2003-05-07T07:52", 708.3),
            (Body::Mercury, "2006-11-08T21:41", 422.9),
            (Body::Mercury, "2016-05-09T14:57", 318.5),
            (Body::Mercury, "2019-11-11T15:20", 75.9),
            (Body::Venus, "2004-06-08T08:20", 626.9),
            (Body::Venus, "2012-06-06T01:29", 554.4),
        ] {
            let mut ephemeris = Ephemeris::default();
            let mut separation_arcsec = |epoch_s: f64| {
                let earth = ephemeris.position_m(Body::Earth, epoch_s);
                let mut planet = ephemeris.position_m(body, epoch_s);
                for _ in 0..3 {
                    let light_time_s = (planet - earth).norm() / crate::constants::SPEED_OF_LIGHT_M_S;
                    planet = ephemeris.position_m(body, epoch_s - light_time_s);
                }
                (planet - earth).angle(&-earth).to_degrees() * 3600.0
            };
            let greatest_s = epoch_s(text);
            let (mut least, mut at_minute) = (f64::INFINITY, 0_i32);
            for minute in -20_i32..=20 {
                let separation = separation_arcsec(greatest_s + f64::from(minute) * 60.0);
                if separation < least {
                    (least, at_minute) = (separation, minute);
                }
            }
            assert!((least - published_arcsec).abs() < 0.5, "{text}: {least} arc seconds");
            assert!(at_minute.abs() <= 1, "{text}: {at_minute} min");
        }
    }

    #[test]
    fn keplers_laws() {
        // Semi-major axes 0.38710 and 0.72333 AU: vis-viva energy, within what other planets do to it.
        let mut ephemeris = Ephemeris::default();
        let semi_major_axis_au = |state: CartesianState| {
            let inverse = 2.0 / state.position_m.norm() - state.velocity_m_s.norm_squared() / GM_SUN_M3_S2;
            1.0 / (inverse * ASTRONOMICAL_UNIT_M)
        };
        let (mut nearest, mut farthest) = (f64::INFINITY, 0.0_f64);
        for day in 0..200 {
            let at_s = MOMENTUM_STUDY_START_S + f64::from(day) * DAY_S;
            let mercury = ephemeris.state(Body::Mercury, at_s);
            assert!((semi_major_axis_au(mercury) - 0.387_098).abs() < 5e-6);
            assert!((semi_major_axis_au(ephemeris.state(Body::Venus, at_s)) - 0.723_330).abs() < 2e-5);
            let distance = mercury.position_m.norm() / ASTRONOMICAL_UNIT_M;
            (nearest, farthest) = (nearest.min(distance), farthest.max(distance));
        }
        assert!((nearest - 0.307_5).abs() < 1e-4 && (farthest - 0.466_7).abs() < 1e-4);
    }

    #[test]
    fn work_is_counted_by_what_is_asked_for_alone() {
        let epochs: Vec<f64> = (0..60).map(|i| f64::from(i * 7919 % 60) * 5.3 * DAY_S - 1e8).collect();
        let mut used = Ephemeris::default();
        for &epoch_s in &epochs {
            let mut fresh = Ephemeris::default();
            used.count_from_here();
            let before = used.evaluations();
            for days in [0.0, 3.0, 40.0, 0.0, 71.0, 40.0] {
                for body in Body::ALL {
                    let at_s = epoch_s + days * DAY_S;
                    assert_eq!(used.state(body, at_s), fresh.state(body, at_s));
                }
                assert_eq!(used.evaluations() - before, fresh.evaluations());
            }
            // 40 and 71 days later are other segments than the first, for five planets; each time may be another segment than
            // the one before it.
            let planets = 4 * ELEMENT_TERMS as u64 + EARTH_TERMS as u64;
            assert!((2 * planets..=5 * planets).contains(&fresh.evaluations()), "{}", fresh.evaluations());
        }
    }

    #[test]
    fn history_leaves_no_trace() {
        let epochs: Vec<f64> = (0..40).map(|i| f64::from(i * 7919 % 40) * 5.3 * DAY_S - 1e8).collect();
        let mut used = Ephemeris::default();
        for &epoch_s in &epochs {
            for body in Body::ALL {
                assert_eq!(used.state(body, epoch_s), Ephemeris::default().state(body, epoch_s));
            }
        }
        assert!(used.position_m(Body::Mercury, f64::NAN).x.is_nan());
    }
}
