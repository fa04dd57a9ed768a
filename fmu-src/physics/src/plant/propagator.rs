//! Propagator: the segment of time on which the orbit is known and attitude law and shadow keep their branch.
//!
//! An orbit that light and heat act on has to be known before they can be computed, and they before it. A segment begins
//! with the orbit under gravity alone. Within a segment it is off by centimetres, which changes light and heat by less than
//! 1e-7 of themselves; with their acceleration the orbit is then integrated anew, up to the segment's end.

use nalgebra::Vector3;

use crate::momentum::TorqueModel;
use crate::numerics::chebyshev::Segment;

use super::configuration::Motion;
use super::error::PlantError;
use super::evaluation::{ExternalLoad, Plant};
use super::work::Cost;

/// Nodes at which the acceleration of a segment is taken.
const NODES: usize = 8;

impl<L: Fn(f64) -> ExternalLoad> Plant<'_, L> {
    /// Makes sure that `start_s` lies in the present segment, and tells where that ends, `limit_s` at the latest.
    pub(super) fn reach(&mut self, start_s: f64, limit_s: f64) -> Result<f64, PlantError> {
        let known_s = self.orbit_and_light(start_s)?.min(limit_s);
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
