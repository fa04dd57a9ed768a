//! Coarse ephemerides of the planets by VSOP87, for a spacecraft that carries none of its own.
//!
//! Classical elements of VSOP87 are averaged over windows of ten Julian years with edges fixed past J2000: polynomials of
//! fourth degree, as in [`super::onboard::CoarseElements`]. A window is a pure function of its number: what was requested before never changes a
//! bit. The Earth is its barycentre with the Moon.
//!
//! Error against [`Ephemeris`](super::ephemeris::Ephemeris) between 1950 and 2050 (tested): as a direction from the Sun
//! below 3e-4 rad (Mars; the others 1.3e-4), as a velocity below 16 m/s (Earth; the others 8 m/s).

use core::f64::consts::TAU;

use nalgebra::Vector3;

use super::CartesianState;
use super::bodies_from_center::BodiesFromCenter;
use super::ephemeris::{Theory, eme2000_from_vsop87, state_without_theory, theory};
use super::onboard::{CoarseElements, KeplerianElements, OnboardEphemeris};
use super::time::julian_date;
use crate::bodies::Body;
use crate::constants::{ASTRONOMICAL_UNIT_M, DAY_S};
use crate::math;
use crate::numerics::Span;
use crate::numerics::chebyshev::Segment;

/// Length of a window.
const WINDOW_S: f64 = 3_652.5 * DAY_S;

/// Elements that a window is made of.
const SAMPLES: usize = 64;

/// Planets by coarse elements, a cache of fixed size. It is no state: skip it when serialising and start from the default.
#[derive(Clone, Debug, Default)]
pub struct CoarseEphemeris {
    held: [Option<(i64, CoarseElements)>; Body::COUNT],
}

impl CoarseEphemeris {
    /// Heliocentric position and velocity in EME2000 at `epoch_s` past J2000 TDB.
    pub fn state(&mut self, body: Body, epoch_s: f64) -> CartesianState {
        let Some(theory) = theory(body) else { return state_without_theory(body, epoch_s) };
        let number = (epoch_s / WINDOW_S).floor() as i64;
        let slot = &mut self.held[body as usize];
        let fitted = match slot {
            Some((held, fitted)) if *held == number => fitted,
            _ => {
                let start_s = number as f64 * WINDOW_S;
                &mut slot.insert((number, averaged(&theory, Span::new(start_s, start_s + WINDOW_S)))).1
            }
        };
        fitted.state(epoch_s).unwrap_or_else(|| state_without_theory(body, epoch_s))
    }

    /// Position and velocity of a body from the centre, by the coarse models that a spacecraft carries where it has them.
    pub fn from_center(
        &mut self,
        carried: Option<&OnboardEphemeris>,
        body: Body,
        bodies: &BodiesFromCenter,
        epoch_s: f64,
    ) -> CartesianState {
        if body == bodies.center {
            return CartesianState::default();
        }
        let [body, center] = [body, bodies.center].map(|body| {
            let own = carried.and_then(|carried| carried.coarse_state(body.into(), epoch_s));
            let custom = || bodies.custom.filter(|_| body == Body::Custom).map(|it| it.state(epoch_s));
            own.or_else(custom).unwrap_or_else(|| self.state(body, epoch_s))
        });
        body - center
    }
}

/// The elements averaged over a span.
fn averaged(theory: &Theory, span: Span) -> CoarseElements {
    let motion_rad_s = theory.mean_motion_rad_s();
    let middle_s = 0.5 * (span.start_s + span.end_s);
    let mut first: Option<KeplerianElements> = None;
    let elements = Segment::<6, SAMPLES>::nodes(span.start_s, span.end_s).map(|at_s| {
        let turned_rad = motion_rad_s * (at_s - middle_s);
        let mut found = classical(&(theory.elements)(julian_date(at_s)));
        found[5] -= turned_rad;
        // Angles are cut at full turns anywhere: all are taken near the first, the mean anomaly's slow part too.
        let near = *first.get_or_insert(found);
        for angle in 3..6 {
            found[angle] -= ((found[angle] - near[angle]) / TAU).round() * TAU;
        }
        found[5] += turned_rad;
        found
    });
    CoarseElements::from_elements(Body::Sun, span, &elements)
}

/// VSOP87's elements as classical ones in EME2000.
fn classical(e: &vsop87::VSOP87Elements) -> KeplerianElements {
    let half_cos = (1.0 - e.q * e.q - e.p * e.p).sqrt();
    let normal =
        Vector3::new(2.0 * e.p * half_cos, -2.0 * e.q * half_cos, 1.0 - 2.0 * (e.q * e.q + e.p * e.p));
    let longitude_rad = math::atan2(e.h, e.k);
    let (sin, cos) = math::sin_cos(longitude_rad);
    let tilt = 2.0 * (e.p * cos - e.q * sin);
    let toward_periapsis = Vector3::new(cos - e.p * tilt, sin + e.q * tilt, -tilt * half_cos);
    let turn = eme2000_from_vsop87();
    let (normal, toward_periapsis) = (turn * normal, turn * toward_periapsis);
    let node_rad = math::atan2(normal.x, -normal.y);
    let toward_node = Vector3::new(math::cos(node_rad), math::sin(node_rad), 0.0);
    let across_node = normal.cross(&toward_node);
    KeplerianElements::from([
        e.a * ASTRONOMICAL_UNIT_M,
        math::hypot(e.k, e.h),
        math::atan2(math::hypot(normal.x, normal.y), normal.z),
        node_rad,
        math::atan2(toward_periapsis.dot(&across_node), toward_periapsis.dot(&toward_node)),
        e.l - longitude_rad,
    ])
}
