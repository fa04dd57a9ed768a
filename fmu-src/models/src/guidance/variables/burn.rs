//! The burn of the scenario burn: the velocity to add, its steering, and what it tells the thrusters.

use fmi_export::{Boolean, Choice, Real, RealMatrix, RealVector, Variables};
use physics::guidance::burn::delta_v;

use crate::common::choices::ThrustRequest;
use crate::guidance::setup::GuidanceSetup as Setup;

/// A burn. It begins where the scenario burn is commanded, by the input or by a command of the timeline without a table `burn`,
/// and its time has come; a demotion of the mode or another scenario ends it.
#[derive(Variables)]
pub struct BurnVariables {
    /// Velocity to add, without gravity, EME2000; with zero, and no profile, there is no direction: the last command stays.
    #[parameter(unit = "m/s", min = -1e6, max = 1e6, start = [0.0; 3])]
    pub delta_v: RealVector<3>,
    /// Powered turn: component i of the velocity is the sum of profile[i,j] times the j-th power of the progress, which goes
    /// from 0 to 1. All zero: straight along burn.deltaV; otherwise the sums have to be burn.deltaV, or that zero.
    #[parameter(unit = "m/s", min = -1e6, max = 1e6, start = [[0.0; 3]; 3])]
    pub profile: RealMatrix<3, 3>,
    /// Time at which thrust begins, at the first sample at or after it that points the thrust; from when the scenario is
    /// commanded the spacecraft turns to the burn's first direction.
    #[parameter(unit = "s", min = -1e12, max = 1e12, start = 0.0)]
    pub start: Real,
    /// Thrusters that are requested; the first set of the spacecraft file unless its start table says another.
    #[parameter(
        start = ThrustRequest::first(&setup.spacecraft),
        items = ThrustRequest::sets(&setup.spacecraft)
    )]
    pub thrusters: Choice<ThrustRequest>,
    /// Nominal direction of the thrust in the body frame, of any length. Zero: along the sum of the forces of the thrusters
    /// in the spacecraft file, or +Z where they have none.
    #[parameter(unit = "1", start = [0.0; 3])]
    pub thrust_direction: RealVector<3>,
    /// Acceleration that is expected until one is measured. 0: by those thrusters and the mass in the file.
    #[parameter(unit = "m/s2", min = 0.0, max = 1e3, start = 0.0)]
    pub acceleration: Real,
    /// How far ahead the path is aimed at, at the measured acceleration: an offset decays over this time (assumed; paper 001
    /// names no time).
    #[parameter(unit = "s", min = 1.0, max = 1e6, start = delta_v::LOOK_AHEAD_S)]
    pub look_ahead: Real,
    /// Share of each second's measured thrust direction that the estimated one takes over (assumed; paper 001 adds the whole
    /// angle, which takes over all noise as well).
    #[parameter(unit = "1", min = 0.0, max = 1.0, start = delta_v::GAIN)]
    pub gain: Real,
    /// Whether the boresight is the estimated thrust direction (theta in paper 001); otherwise it stays the nominal one.
    #[parameter(start = true)]
    pub predictive: Boolean,
    /// Whether the thrust is aimed back at the path (beta in paper 001).
    #[parameter(start = true)]
    pub reactive: Boolean,
    /// Longest time that thrust may last, and that a burn which is due may wait until the constraints let it point.
    #[parameter(unit = "s", min = 1.0, max = 1e9, start = 3600.0)]
    pub timeout: Real,
    /// Estimated thrust direction, a unit vector in the body frame; for the design of burns to come.
    #[output(discrete, unit = "1", nominal = 1.0)]
    pub thrust_estimate: RealVector<3>,
    /// Velocity that the present or last burn added by the accelerometers, EME2000.
    #[output(discrete, unit = "m/s")]
    pub velocity: RealVector<3>,
    /// How far that is off the path at the magnitude reached, EME2000.
    #[output(discrete, unit = "m/s", nominal = 1e-3)]
    pub velocity_error: RealVector<3>,
    /// Whether the last burn was missed: its time was up, constraints keep its thrust off the aim when it is due, or it ended
    /// before it began.
    #[output]
    pub timed_out: Boolean,
}

/// Requests of Guidance to the thrusters.
#[derive(Variables)]
pub struct ThrustVariables {
    /// Thrusters that are requested, from when the scenario burn is commanded until the burn is over.
    #[output(items = ThrustRequest::sets(&setup.spacecraft))]
    pub request: Choice<ThrustRequest>,
    /// Whether they are to thrust.
    #[output]
    pub command: Boolean,
    /// Time at which thrust is to end, predicted anew at each sample; -1 without thrust.
    #[output(discrete, unit = "s", nominal = 1e3)]
    pub stop: Real,
}
