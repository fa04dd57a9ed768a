//! A look at a flight ahead and around, by which nothing of it changes: how it stands along its orbit, and what hides its Sun.

use nalgebra::Vector3;

use super::configured::StepContext;
use crate::attitude::angle_between_rad;
use crate::bodies::Body;
use crate::constants::{RADIUS_MOON_M, RADIUS_SUN_M};
use crate::environment::eclipse::{Shadow, ShadowModel};
use crate::environment::orbit::BodyEphemeris;
use crate::plant::disturbances::simulation_context::SimulationContext;
use crate::plant::instant::at_time::Instant;
use crate::plant::instant::geometry::{Geometry, SimulationEphemeris};
use crate::plant::motion::command_slews::CommandSlews;
use crate::plant::settings::attitude_source::{AttitudeSource, Turning};
use crate::plant::settings::configuration::{Configuration, EphemerisSource, Motion};
use crate::plant::state::propagator_state::PropagatorState;

/// The Moon's rate against the Sun as seen from the Earth is at most that, in rad/s.
const MOON_RATE_RAD_S: f64 = 3.3e-6;
/// Perigee of the Moon, below all of them, in m.
const MOON_NEAREST_M: f64 = 3.5e8;

/// Shorter than the transit of a planet, in s.
const TRANSIT_S: f64 = 600.0;

/// Least share of the disc that is told of: planets far away hide less.
const LEAST_SHARE: f64 = 1e-3;

/// A body that stands before the Sun's disc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Occultation {
    /// Its name.
    pub name: &'static str,
    /// The part of the disc that it hides.
    pub share: f64,
}

/// Shows how the spacecraft stands at these times by its own guidance, followed ideally on the orbit under the centre's gravity alone;
/// nothing where something else gives the attitude.
pub fn survey(
    context: &SimulationContext,
    given: StepContext<'_>,
    times_s: impl IntoIterator<Item = f64>,
    mut see: impl FnMut(&Configuration, f64, &Instant),
) {
    let Some(guided) = context.configuration.attitude.guided().copied() else { return };
    let configuration = Configuration {
        attitude: AttitudeSource::Guided(guided),
        motion: match context.configuration.motion {
            held @ Motion::Held { .. } => held,
            _ => Motion::TwoBody,
        },
        ..context.configuration.clone()
    };
    let mut context = SimulationContext { configuration, ..context.clone() };
    // Commands are taken at once.
    let command_slews = CommandSlews::beginning(f64::INFINITY);
    let mut propagator = PropagatorState { command_slews, ..PropagatorState::default() };
    let mut plant = context.plant(given.prepared, Turning::still(), &mut propagator, given.external);
    for time_s in times_s {
        let instant = plant.instant(time_s);
        see(plant.path.configuration, time_s, &instant);
    }
}

/// The body before the Sun's disc at `time_s`, where the flight was reported, which its shadow does not know: the Earth, about it
/// the Moon, and in motion between bodies every planet. `quiet_until_s` becomes the time of the next look.
pub(super) fn occultation(
    context: &mut SimulationContext,
    geometry: &Geometry,
    time_s: f64,
    quiet_until_s: &mut Option<f64>,
) -> Option<Occultation> {
    let configuration = &context.configuration;
    let mut bodies = SimulationEphemeris { configuration, ephemeris: &mut context.models.ephemeris };
    let planet = configuration.planet();
    let known = |body: Body| Some(body) != planet && body != configuration.center;
    // An Earth that no input placed stands in the centre.
    let is_placed = geometry.earth_from_center().position_m != Vector3::zeros();
    let by_body = |body: Body, to_body_m: &Vector3<f64>| {
        hidden(geometry, to_body_m, (body.data().name, body.data().radius_m))
    };
    let earth = Some(Body::Earth).filter(|earth| is_placed && known(*earth));
    let earth = earth.and_then(|earth| by_body(earth, &geometry.to_earth.position_m));
    let is_given = matches!(configuration.ephemeris, EphemerisSource::Given { .. });
    if configuration.center == Body::Earth && !is_given {
        let moon_m = bodies.moon_from_earth_m(time_s);
        let sun_m = geometry.sun_from_center().position_m;
        let away_m = geometry.spacecraft.position_m.norm();
        // By which the spacecraft's place moves Moon and Sun against one another, both discs included.
        let margin_rad = (away_m / MOON_NEAREST_M).min(1.0) * core::f64::consts::FRAC_PI_2 + 0.02;
        let apart_rad = angle_between_rad(&moon_m, &sun_m);
        *quiet_until_s = Some(time_s + (apart_rad - margin_rad).max(0.0) / MOON_RATE_RAD_S);
        let found = hidden(geometry, &(moon_m - geometry.spacecraft.position_m), ("the Moon", RADIUS_MOON_M));
        return found.or(earth);
    }
    *quiet_until_s = Some(time_s + TRANSIT_S);
    let others = Body::ALL.into_iter().filter(|body| *body != Body::Earth && body.is_planet());
    let others = others.filter(|_| matches!(configuration.motion, Motion::NBody { .. }) && !is_given);
    let found = others.filter(|it| known(*it)).find_map(|other| {
        by_body(other, &(bodies.body(other, time_s).position_m - geometry.spacecraft.position_m))
    });
    found.or(earth)
}

/// Returns what a body there, seen from the spacecraft, with a name and a radius in m hides of the Sun's disc.
fn hidden(
    geometry: &Geometry,
    to_body_m: &Vector3<f64>,
    (name, radius_m): (&'static str, f64),
) -> Option<Occultation> {
    let to_sun_m = &geometry.to_sun.position_m;
    let limbs_m2 = radius_m * to_sun_m.norm() + RADIUS_SUN_M * to_body_m.norm();
    // Discs whose centres are farther apart than both radii together, by their sines.
    if to_body_m.dot(to_sun_m) <= 0.0 || to_body_m.cross(to_sun_m).norm() > limbs_m2 {
        return None;
    }
    let shadow = Shadow::new(ShadowModel::DiscOverlap, radius_m).ok()?;
    let from_body_m = [-to_body_m, to_sun_m - to_body_m];
    let (lit, _) = shadow.fraction_and_gaps(&from_body_m[0], &from_body_m[1]);
    (1.0 - lit > LEAST_SHARE).then_some(Occultation { name, share: 1.0 - lit })
}
