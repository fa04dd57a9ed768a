//! Torque model: what the momentum integrator asks of a spacecraft at any time.

use nalgebra::{Rotation3, SVector, Vector3};

use super::by_source::SourceTorques;
use super::dump::TooManyDumps;
use crate::numerics::spacing::spacing;

/// An event this soon after the start of a segment is the one that it starts with, in s: an orbit computed anew moves it.
const EVENT_GAP_S: f64 = 1e-4;

/// Returns the earliest time at which an event is a new one and not the one at `start_s`, in s.
pub fn after_event_s(start_s: f64) -> f64 {
    start_s + EVENT_GAP_S.max(4.0 * spacing(start_s))
}

/// Attitude, torque and acceleration of a flight at one time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TorqueSample {
    /// Matrix that takes body components to inertial components.
    pub inertial_from_body: Rotation3<f64>,
    /// Angular rate of the body in the inertial frame, body components, in rad/s.
    pub rate_body_rad_s: Vector3<f64>,
    /// Momentum of the body and its panels without the wheels, body frame, in N m s; absent where no panel has a mass, as the
    /// inertia is constant there.
    pub structure_body_n_m_s: Option<Vector3<f64>>,
    /// Total external torque about the centre of mass, body frame, in N m.
    pub torque_body_n_m: Vector3<f64>,
    /// The same of the effects that act.
    pub by_source_body_n_m: SourceTorques,
    /// Acceleration by non-gravitational forces, inertial frame, in m/s2.
    pub acceleration_inertial_m_s2: Vector3<f64>,
    /// Event functions: between two of their roots the sample is a smooth function of time. Infinite where there is nothing
    /// to watch.
    pub events: EventValues,
}

/// Values of the event functions of a flight.
pub type EventValues = SVector<f64, 4>;

/// Kind of work of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WorkKind {
    /// Segments of momentum as long as their grid.
    Segment,
    /// Segments shortened for the tolerance of momentum.
    Refinement,
    /// Searches for abrupt changes of attitude, light and shadow.
    Search,
    /// Dumps.
    Dump,
    /// Segments of light and heat.
    Light,
    /// Integrated segments of the orbit.
    Orbit,
    /// Planets' positions fitted anew.
    Ephemeris,
    /// Segments of air and magnetic field.
    Air,
}

impl WorkKind {
    /// Every kind.
    pub const ALL: [Self; 8] = [
        Self::Segment,
        Self::Refinement,
        Self::Search,
        Self::Dump,
        Self::Light,
        Self::Orbit,
        Self::Ephemeris,
        Self::Air,
    ];
}

/// Model of attitude, torque and acceleration over time.
pub trait TorqueModel {
    /// Why a flight cannot continue.
    type Failure: From<TooManyDumps>;

    /// Makes the flight ready for samples from `start_s` on, and tells up to where, at most to `limit_s` and to the next change
    /// whose time is known: a segment that starts there ends at that time or before. With it the matrix of the sample at `start_s`
    /// that takes body components to inertial components. Called with rising times, and again with the same one.
    ///
    /// # Errors
    /// Whatever ends a flight.
    fn prepare(&mut self, start_s: f64, limit_s: f64) -> Result<(f64, Rotation3<f64>), Self::Failure>;

    /// Sample at `time_s`; a pure function of time within what was prepared.
    fn sample(&mut self, time_s: f64) -> TorqueSample;

    /// Matrix of the sample alone that takes body components to inertial components.
    fn inertial_from_body(&mut self, time_s: f64) -> Rotation3<f64>;

    /// The event functions of the sample alone.
    fn events(&mut self, time_s: f64) -> EventValues;

    /// Resolution of `time_s` in the flight, in s: samples and event functions are constant over less.
    fn time_rounding_s(&self, time_s: f64) -> f64 {
        spacing(time_s)
    }

    /// Counts what is about to be done, the flight having come to `time_s`.
    ///
    /// # Errors
    /// More was spent than may be.
    fn spend(&mut self, _effort: WorkKind, _time_s: f64) -> Result<(), Self::Failure> {
        Ok(())
    }
}
