//! Orbit of the spacecraft: in closed form, or integrated with the states that have to be kept of it.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::bodies::Body;
use crate::environment::CartesianState;
use crate::environment::orbit::{
    BodyEphemeris, DisturbedOrbit, OrbitError, OrbitIntegrationError, OrbitMethod, TwoBodyOrbit,
};
use crate::guidance::Window;
use crate::numerics::Span;
use crate::numerics::spacing::spacing;

use super::approaches::ClosestApproaches;
use super::periapses::Periapses;
use crate::plant::settings::configuration::{Configuration, Encounter, Motion};

/// Two beginnings of a window closer together than this part of a revolution are one, computed twice.
const SAME_WINDOW: f64 = 1e-7;
/// No decoded orbit goes round faster, in s, or begins later, in s: passages are counted in whole numbers.
const SHORTEST_PERIOD_S: f64 = 1e-3;
/// See [`SHORTEST_PERIOD_S`].
const LATEST_S: f64 = 1e15;
/// The state of motion. Empty for two-body motion without maneuvers, which needs none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Trajectory {
    orbit: Option<DisturbedOrbit>,
    /// The two-body orbit after the last maneuver; its periapses up to there are in `periapses`.
    coast: Option<Coast>,
    periapses: Periapses,
    /// Closest approaches to the encounter's body.
    pub approaches: ClosestApproaches,
    /// Time and state at the start of the present science or downlink window, once that time lies before the
    /// current segment: a slew starts from the attitude there.
    window_start: Option<(f64, CartesianState)>,
}

/// A two-body orbit that a maneuver began.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct Coast {
    since_s: f64,
    orbit: TwoBodyOrbit,
}

/// Position and velocity where no orbit is integrated.
fn closed_form(configuration: &Configuration, time_s: f64) -> CartesianState {
    match configuration.motion {
        Motion::Held { state, .. } => state,
        _ => configuration.orbit.state_at(time_s + configuration.epoch_minus_time_s),
    }
}

/// Whether two times at which a window begins are one.
fn is_same_window(configuration: &Configuration, since_s: f64, time_s: f64) -> bool {
    let rounding_s = 8.0 * spacing(time_s.abs().max((time_s + configuration.epoch_minus_time_s).abs()));
    (since_s - time_s).abs() <= SAME_WINDOW * configuration.orbit.period_s() + rounding_s
}

impl Trajectory {
    /// At the start of a flight or where position and velocity are given anew.
    ///
    /// # Errors
    /// A start below the surface.
    pub fn new(configuration: &Configuration, time_s: f64) -> Result<Self, OrbitIntegrationError> {
        let epoch_s = time_s + configuration.epoch_minus_time_s;
        let start = || configuration.orbit.state_at(epoch_s);
        let orbit = match &configuration.motion {
            Motion::Disturbed { segment_length_s, radius_m, .. } => {
                DisturbedOrbit::new(&start(), time_s, *segment_length_s, *radius_m)?
            }
            Motion::NBody { gravity, .. } => DisturbedOrbit::between_bodies(&start(), time_s, gravity)?,
            Motion::TwoBody | Motion::Held { .. } => return Ok(Self::default()),
        };
        Ok(Self {
            orbit: Some(orbit),
            periapses: Periapses::before(configuration, epoch_s),
            ..Self::default()
        })
    }

    /// Whether a simulation can produce it.
    pub fn is_valid(&self) -> bool {
        self.orbit.as_ref().is_none_or(DisturbedOrbit::is_valid)
            && self.coast.as_ref().is_none_or(|Coast { orbit, since_s }| {
                orbit.is_valid() && orbit.period_s() > SHORTEST_PERIOD_S && since_s.abs() < LATEST_S
            })
            && self.periapses.is_valid()
            && self.approaches.is_valid()
    }

    /// Whether it has come to `time_s` and no segment further; so in every flight, not in every sequence of bytes.
    pub fn covers(&self, time_s: f64) -> bool {
        self.orbit.as_ref().is_none_or(|orbit| {
            let (start_s, end_s) = (orbit.start_s(), orbit.end_s());
            orbit.segment_length_s() >= 1e-3
                && start_s <= time_s + 8.0 * f64::EPSILON * time_s.abs()
                && time_s <= end_s
        })
    }

    /// Position and velocity about the centre at `time_s`, in EME2000.
    pub fn state_at(&self, configuration: &Configuration, time_s: f64) -> CartesianState {
        match (&self.orbit, self.coasting(configuration)) {
            (Some(orbit), _) => orbit.state_at(time_s),
            (None, Some(coast)) => coast.orbit.state_at(time_s + configuration.epoch_minus_time_s),
            (None, None) => closed_form(configuration, time_s),
        }
    }

    /// The two-body orbit since the last maneuver, if there was one.
    fn coasting(&self, configuration: &Configuration) -> Option<&Coast> {
        self.coast.as_ref().filter(|_| matches!(configuration.motion, Motion::TwoBody))
    }

    /// The orbit of two-body motion.
    pub(crate) fn two_body<'a>(&'a self, configuration: &'a Configuration) -> &'a TwoBodyOrbit {
        self.coasting(configuration).map_or(&configuration.orbit, |coast| &coast.orbit)
    }

    /// Time since the last periapsis, in s.
    pub fn time_since_periapsis_s(&self, configuration: &Configuration, time_s: f64) -> f64 {
        if let Some(coast) = self.coasting(configuration) {
            let epoch_s = time_s + configuration.epoch_minus_time_s;
            return match coast.orbit.period_s().is_finite() {
                true => time_s - self.passed(configuration, coast, time_s).last_s(),
                false => coast.orbit.time_since_periapsis_s(epoch_s),
            };
        }
        if self.orbit.is_none() || !configuration.orbit.period_s().is_finite() {
            let epoch_s = match configuration.motion {
                Motion::Held { since_epoch_s, .. } => since_epoch_s,
                _ => time_s + configuration.epoch_minus_time_s,
            };
            return configuration.orbit.time_since_periapsis_s(epoch_s);
        }
        time_s - self.periapses.last_until_s(time_s)
    }

    /// The body that the path is integrated about at present; the centre where that never changes.
    pub fn integration_center(&self, configuration: &Configuration) -> Body {
        self.orbit.as_ref().and_then(DisturbedOrbit::integration_center).unwrap_or(configuration.center)
    }

    /// Position and velocity from that body at `time_s`, EME2000, where it may change; `None` where it is the centre throughout.
    pub(crate) fn state_from_integration_center(&self, time_s: f64) -> Option<CartesianState> {
        let orbit = self.orbit.as_ref().filter(|orbit| orbit.integration_center().is_some());
        orbit.map(|orbit| orbit.own_state_at(time_s))
    }

    /// Up to where the orbit is known; infinite in closed form.
    pub(crate) fn end_s(&self) -> f64 {
        self.orbit.as_ref().map_or(f64::INFINITY, DisturbedOrbit::end_s)
    }

    /// The schedule's window at `time_s` where it follows an integrated orbit or one that a maneuver began, in the schedule's
    /// time scale.
    pub(crate) fn window(&self, configuration: &Configuration, time_s: f64) -> Option<Window> {
        let guided = configuration.attitude.guided()?;
        if !guided.schedule.period_s.is_finite() {
            return None;
        }
        let periapses = match (&self.orbit, self.coasting(configuration)) {
            (Some(_), _) => self.periapses,
            (None, Some(coast)) => self.passed(configuration, coast, time_s),
            (None, None) => return None,
        };
        let epoch_s = time_s + configuration.epoch_minus_time_s;
        let met_s = periapses.scheduled_s().map(|at_s| at_s + configuration.epoch_minus_time_s);
        Some(guided.schedule.window_after(&met_s, epoch_s))
    }

    /// Position and velocity at the beginning of a window, which may be past.
    pub(crate) fn state_at_window_start(&self, configuration: &Configuration, time_s: f64) -> CartesianState {
        let is_same = |(since_s, _): &(f64, _)| is_same_window(configuration, *since_s, time_s);
        let stored = self.window_start.filter(is_same).map(|(_, state)| state);
        let coast = self.coasting(configuration).filter(|_| self.orbit.is_none());
        if coast.is_some_and(|coast| time_s >= coast.since_s) {
            return self.state_at(configuration, time_s);
        }
        match &self.orbit {
            // With a deviation the present segment holds the path of its last interval only.
            Some(orbit) if time_s >= orbit.start_s() && !(orbit.is_deviated() && stored.is_some()) => {
                orbit.state_at(time_s)
            }
            None if coast.is_none() => closed_form(configuration, time_s),
            // Before the flight began the spacecraft was on its two-body orbit.
            _ => stored.unwrap_or_else(|| closed_form(configuration, time_s)),
        }
    }

    /// Leaves the present segment, which ends at `time_s`: remembers what the next one cannot know.
    pub(crate) fn close_segment(&mut self, configuration: &Configuration, time_s: f64) {
        // With a deviation the window is stored at each interval.
        if let Some(orbit) = self.orbit.filter(|orbit| !orbit.is_deviated()) {
            self.store_window_start(configuration, Span::new(orbit.start_s(), time_s));
        }
    }

    /// Keeps where the present window began, if it did within this span.
    fn store_window_start(&mut self, configuration: &Configuration, span: Span) {
        if let (Some(orbit), Some(window)) = (&self.orbit, self.window(configuration, span.end_s)) {
            let since_s = window.since_s - configuration.epoch_minus_time_s;
            if span.contains(since_s) {
                self.window_start = Some((since_s, orbit.state_at(since_s)));
            }
        }
    }

    /// Whether the deviation from the reference orbit is integrated up to `time_s`.
    pub(crate) fn is_deviated_until(&self, time_s: f64) -> bool {
        self.orbit.as_ref().is_some_and(|orbit| orbit.deviated_until_s() >= time_s)
    }

    /// Integrates the deviation under the perturbing acceleration `extra_m_s2(t)`, EME2000, over `span` of the present segment;
    /// `None`: none acts. Without `orbit.radiationFeedback` nothing changes.
    ///
    /// # Errors
    /// See [`OrbitIntegrationError`].
    pub(crate) fn accelerate(
        &mut self,
        configuration: &Configuration,
        span: Span,
        extra_m_s2: Option<impl Fn(f64) -> Vector3<f64>>,
    ) -> Result<(), OrbitIntegrationError> {
        let gravity =
            configuration.motion.gravity().filter(|_| configuration.motion.has_nongravitational_forces());
        let Some((orbit, gravity)) = self.orbit.as_ref().zip(gravity) else { return Ok(()) };
        if !orbit.is_deviated() {
            if extra_m_s2.is_none() {
                return Ok(());
            }
            self.store_window_start(configuration, Span::new(orbit.start_s(), span.start_s));
        }
        let Some(orbit) = &mut self.orbit else { return Ok(()) };
        orbit.accelerate(gravity, span, extra_m_s2)?;
        if configuration.uses_encke() {
            self.periapses.truncate(span.start_s);
            self.periapses.detect(configuration, orbit, span);
        }
        self.store_window_start(configuration, span);
        Ok(())
    }

    /// Forgets the orbit beyond `time_s`: what acts on the spacecraft changes there, or its velocity by `jump_m_s`, EME2000.
    pub fn cut(&mut self, configuration: &Configuration, time_s: f64, jump_m_s: &Vector3<f64>) {
        self.close_segment(configuration, time_s);
        let Some(orbit) = &mut self.orbit else { return };
        orbit.cut(time_s, jump_m_s);
        self.approaches.truncate(time_s);
        self.periapses.truncate(time_s);
    }

    /// The velocity jumps by `delta_v_m_s`, EME2000, at `time_s`: an integrated orbit continues from there, two-body motion on
    /// another orbit; a place that is held stays.
    ///
    /// # Errors
    /// A velocity without an orbit.
    pub(crate) fn maneuver(
        &mut self,
        configuration: &Configuration,
        time_s: f64,
        delta_v_m_s: &Vector3<f64>,
    ) -> Result<(), OrbitError> {
        if self.orbit.is_some() {
            self.cut(configuration, time_s, delta_v_m_s);
            return Ok(());
        }
        if !matches!(configuration.motion, Motion::TwoBody) {
            return Ok(());
        }
        let epoch_s = time_s + configuration.epoch_minus_time_s;
        let mut state = self.state_at(configuration, time_s);
        state.velocity_m_s += delta_v_m_s;
        let orbit = TwoBodyOrbit::from_state(&state, configuration.orbit.mu_m3_s2(), epoch_s)?;
        let guided = configuration.attitude.guided();
        let window = self.window(configuration, time_s).or(guided.map(|law| law.schedule.window(epoch_s)));
        let since_s = window.map(|window| window.since_s - configuration.epoch_minus_time_s);
        self.window_start = since_s
            .filter(|since_s| since_s.is_finite())
            .map(|since_s| (since_s, self.state_at_window_start(configuration, since_s)));
        self.periapses = match self.coast {
            Some(coast) => self.passed(configuration, &coast, time_s).without_next(),
            None => Periapses::before(configuration, epoch_s),
        };
        self.coast = Some(Coast { since_s: time_s, orbit });
        Ok(())
    }

    /// Periapses up to `time_s` on the orbit that a maneuver began; of those of the schedule the next one too.
    fn passed(&self, configuration: &Configuration, coast: &Coast, time_s: f64) -> Periapses {
        self.periapses.continued(configuration, &coast.orbit, Span::new(coast.since_s, time_s))
    }

    /// Integrates one more segment, at most to `limit_s`, under gravity and `extra_m_s2(t)`, an acceleration in EME2000. Gives
    /// how often a segment between bodies was tried, 0 of others.
    ///
    /// # Errors
    /// See [`OrbitIntegrationError`].
    pub(crate) fn advance(
        &mut self,
        configuration: &Configuration,
        bodies: &mut impl BodyEphemeris,
        method: &OrbitMethod,
        limit_s: f64,
        extra_m_s2: impl FnMut(f64) -> Vector3<f64>,
    ) -> Result<u32, OrbitIntegrationError> {
        let Some(mut orbit) = self.orbit else { return Ok(0) };
        let shortened = match &configuration.motion {
            Motion::Disturbed { gravity, .. } => {
                orbit.advance_to(limit_s, method, gravity, bodies, extra_m_s2)?;
                0
            }
            Motion::NBody { gravity, .. } => {
                let count = orbit.advance_between_bodies(limit_s, method, gravity, bodies, extra_m_s2)?;
                if let Some(Encounter { body, radius_m, .. }) = configuration.encounter {
                    let sizes_m = [radius_m, gravity.model.sphere_m(body)];
                    self.approaches.detect(orbit.span(), sizes_m, |at_s| {
                        let [center, body] =
                            [configuration.center, body].map(|body| bodies.heliocentric(body, at_s));
                        orbit.state_at(at_s) + (center - body)
                    });
                }
                count
            }
            Motion::TwoBody | Motion::Held { .. } => return Ok(0),
        };
        if !configuration.uses_encke() {
            self.periapses.detect(configuration, &orbit, orbit.span());
        }
        self.orbit = Some(orbit);
        Ok(shortened)
    }
}
