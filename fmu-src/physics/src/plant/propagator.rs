//! Propagator: the segment of time on which the orbit is known and attitude law and shadow keep their branch.
//!
//! An orbit that light and heat act on has to be known before they can be computed, and they before it. A segment begins
//! with the orbit under gravity alone. Within a segment it is off by centimetres, which changes light and heat by less than
//! 1e-7 of themselves; with their acceleration the orbit is then integrated anew, up to the segment's end.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::environment::orbit::OrbitIntegrationError;
use crate::momentum::{TooManyDumps, TorqueModel};
use crate::numerics::chebyshev::Segment;
use crate::radiation::disturbance::GeometryError;

use super::configuration::{Configuration, Motion};
use super::evaluation::{ExternalLoad, Plant};
use super::radiation_segment::RadiationSegment;
use super::trajectory::Trajectory;
use super::work::{Cost, WorkExceeded};

/// Nodes at which the acceleration of a segment is taken.
const NODES: usize = 8;

/// Why a flight ends.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum PlantError {
    /// The orbit.
    #[error(transparent)]
    Orbit(#[from] OrbitIntegrationError),
    /// Light and heat have no meaning where the spacecraft is.
    #[error(
        "at {time_s} s, the spacecraft being at {position_m:?} m about the orbit's centre, light has no meaning: {source}"
    )]
    Light {
        /// When, in s.
        time_s: f64,
        /// Position about the orbit's centre, EME2000, in m.
        position_m: [f64; 3],
        /// Why.
        source: GeometryError,
    },
    /// Restored bytes of another spacecraft.
    #[error("the state holds {found} temperatures, allowed: {allowed}, one for each face")]
    Temperatures {
        /// How many there are.
        found: usize,
        /// How many there should be.
        allowed: usize,
    },
    /// Restored bytes that are no flight's.
    #[error("the state holds a temperature of {found_k} K, allowed: 0 to 1e5 K")]
    Temperature {
        /// What was found.
        found_k: f64,
    },
    /// Dumps without end.
    #[error(transparent)]
    Dumps(#[from] TooManyDumps),
    /// More work than a step may take.
    #[error(transparent)]
    Work(#[from] WorkExceeded),
    /// An orbit that goes no further: restored bytes that belong to another kind of motion.
    #[error(
        "the orbit ends at {end_s:?} s and does not go on from {start_s:?} s: the state belongs to another orbit.dynamics"
    )]
    Stuck {
        /// Where it should go on, in s.
        start_s: f64,
        /// Where it ends, in s.
        end_s: f64,
    },
}

/// State of the propagator, beside the totals of the momentum integrator. Serialisable and complete: together with the
/// configuration it fixes everything that follows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PropagatorState {
    /// Where the spacecraft is.
    pub trajectory: Trajectory,
    /// Light and heat of the present segment; absent before the first one.
    pub light: Option<RadiationSegment>,
}

impl PropagatorState {
    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub fn is_sound(&self) -> bool {
        self.trajectory.is_sound() && self.light.as_ref().is_none_or(RadiationSegment::is_sound)
    }

    /// At the start of a flight.
    ///
    /// # Errors
    /// A start below the surface.
    pub fn new(configuration: &Configuration, time_s: f64) -> Result<Self, PlantError> {
        Ok(Self { trajectory: Trajectory::new(configuration, time_s)?, light: None })
    }

    /// Goes on from another place; the heat stored in the surfaces comes along.
    ///
    /// # Errors
    /// A place below the surface.
    pub fn move_to(&mut self, configuration: &Configuration, time_s: f64) -> Result<(), PlantError> {
        self.trajectory = Trajectory::new(configuration, time_s)?;
        if let Some(light) = &mut self.light {
            light.cut(time_s);
        }
        Ok(())
    }

    /// Forgets what was computed ahead of `time_s`: the flight changes there. `configuration` is the one flown so far;
    /// `light_changes` tells whether attitude, panels, mass centre or the Sun do, on which light and heat depend.
    pub fn cut(&mut self, configuration: &Configuration, time_s: f64, light_changes: bool) {
        self.trajectory.cut(configuration, time_s);
        // An orbit that light and forces act on goes elsewhere from here.
        let orbit_changes = matches!(configuration.motion, Motion::Disturbed { feedback: true, .. });
        if let Some(light) = self.light.as_mut().filter(|_| light_changes || orbit_changes) {
            light.cut(time_s);
        }
    }
}

impl<L: Fn(f64) -> ExternalLoad> Plant<'_, L> {
    /// Makes sure that `start_s` lies in the present segment, and tells where that ends.
    pub(super) fn reach(&mut self, start_s: f64) -> Result<f64, PlantError> {
        let known_s = self.orbit_and_light(start_s)?;
        let instant = self.instant(start_s);
        Ok(self.attitude_until_s(start_s, &instant, known_s))
    }

    fn orbit_and_light(&mut self, start_s: f64) -> Result<f64, PlantError> {
        if self.propagator.trajectory.end_s() > start_s {
            return self.extend_radiation(start_s, self.propagator.trajectory.end_s());
        }
        // Two integrations of some 40 evaluations, and the search for changes in between.
        self.spend_units(Cost::Orbit, 60, start_s)?;
        self.propagator.trajectory.leave(self.configuration, start_s);
        let before = self.propagator.trajectory;
        self.integrate(f64::INFINITY, |_| Vector3::zeros())?;
        if let Motion::Disturbed { feedback: true, .. } = self.configuration.motion {
            let lit_s = self.extend_radiation(start_s, self.propagator.trajectory.end_s())?;
            let end_s = self.smooth_until(start_s, lit_s);
            let acceleration_m_s2 =
                Segment::<3, NODES>::fit(start_s, end_s, |at_s| self.sample(at_s).acceleration_inertial_m_s2);
            let predicted = core::mem::replace(&mut self.propagator.trajectory, before);
            self.propagator.trajectory.take_passages(&predicted, end_s);
            self.integrate(end_s, |at_s| acceleration_m_s2.value(at_s))?;
        }
        let end_s = self.propagator.trajectory.end_s();
        // Written so that a NaN is stuck too.
        if end_s > start_s {
            self.extend_radiation(start_s, end_s)
        } else {
            Err(PlantError::Stuck { start_s, end_s })
        }
    }

    fn integrate(
        &mut self,
        limit_s: f64,
        extra_m_s2: impl FnMut(f64) -> Vector3<f64>,
    ) -> Result<(), PlantError> {
        let (configuration, method) = (self.configuration, self.prepared.orbit_method);
        let trajectory = &mut self.propagator.trajectory;
        Ok(trajectory.advance(configuration, self.ephemeris, method, limit_s, extra_m_s2)?)
    }
}
