//! Questions that a flight in one step answers alike, be its attitude followed ideally or by torque.

use super::configured::ConfiguredFlight;
use crate::loads::ForceTorque;
use crate::momentum::Totals;
use crate::numerics::Span;
use crate::plant::disturbances::evaluation::Evaluation;
use crate::plant::events::Eventful;
use crate::plant::settings::attitude_source::AttitudeSource;
use crate::plant::settings::error::PlantError;

/// A flight in one step, whatever gives its attitude.
pub(super) trait Simulated<'f>: Eventful {
    /// The flight that advances.
    fn flight(&mut self) -> &mut ConfiguredFlight<'f>;

    /// Sets what follows from the state and is not saved.
    fn resume(&mut self) {}

    /// Computes the parts of the last sample that only a report needs.
    fn complete(&mut self) {}

    /// Advances until everything is known at `time_s`.
    ///
    /// # Errors
    /// What ends a flight.
    fn advance_to(&mut self, time_s: f64) -> Result<(), PlantError> {
        self.resume();
        let advanced = self.advance(time_s);
        self.complete();
        advanced
    }

    /// Applies the requests of a step.
    ///
    /// # Errors
    /// What ends a flight.
    fn apply_requests(&mut self, step: Span) -> Result<(), PlantError>;

    /// Attitude of a fork from `time_s` on; `None`: the flight's own.
    fn fork_attitude(&self, _time_s: f64) -> Option<AttitudeSource> {
        None
    }

    /// Geometry, attitude and mass at `time_s`, where the flight has come; its loads are zero. Whether a target of the attitude law has a
    /// substitute is that of the last sample, where it is sampled.
    fn frame(&mut self, time_s: f64) -> Evaluation;

    /// Momentum and velocity change at `time_s`, where the flight has come.
    fn totals(&mut self, time_s: f64) -> Totals;

    /// Writes force and torque of every row, under this load from outside.
    fn rows(&mut self, evaluation: &mut Evaluation, applied: ForceTorque);
}
