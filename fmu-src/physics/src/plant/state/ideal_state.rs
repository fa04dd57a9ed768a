//! State of a flight whose attitude is followed ideally: momentum, dumps and maneuvers.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use crate::attitude::Attitude;
use crate::momentum::{DumpSpacing, MomentumIntegrator, Totals};
use crate::plant::events::LastEvents;

/// Maneuvers so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Maneuvers {
    /// Number of maneuvers.
    pub count: i32,
    /// Time of the last one, in s, and the delta-v that it executed, EME2000, in m/s.
    pub last: Option<(f64, Vector3<f64>)>,
}

/// Momentum, dumps and maneuvers of a flight in an attitude that is followed ideally.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct IdealState {
    /// Momentum and velocity change so far.
    pub integrator: MomentumIntegrator,
    /// Time between dumps.
    pub spacing: DumpSpacing,
    /// Velocity change of the last dump, EME2000, in m/s.
    pub dump_delta_v_inertial_m_s: Vector3<f64>,
    /// Maneuvers so far.
    pub maneuvers: Maneuvers,
    /// The last event of each kind.
    pub last: LastEvents,
}

impl IdealState {
    /// Begins at `time_s` with these totals, the quaternion continuing that of `attitude`; what the schedule has before is over.
    pub(crate) fn new(time_s: f64, attitude: &Attitude, totals: Totals) -> Self {
        Self {
            integrator: MomentumIntegrator::after(time_s, attitude.unit_quaternion(), totals),
            spacing: DumpSpacing::default(),
            dump_delta_v_inertial_m_s: Vector3::zeros(),
            maneuvers: Maneuvers::default(),
            last: LastEvents::before(time_s),
        }
    }

    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        self.integrator.is_valid() && self.spacing.is_valid() && self.maneuvers.count >= 0
    }
}
