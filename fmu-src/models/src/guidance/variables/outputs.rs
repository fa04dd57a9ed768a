//! The command and what stands behind it.

use fmi_export::{Boolean, Choice, RealVector, Variables};

use crate::common::choices::CommandKind;

/// The command: of the last sample, propagated by its rate.
#[derive(Variables)]
pub struct CommandVariables {
    /// What the command gives.
    #[output]
    pub kind: Choice<CommandKind>,
    /// Commanded attitude quaternion, scalar last, from EME2000 to the body frame, of continuous sign.
    #[output(unit = "1", nominal = 1.0)]
    pub q: RealVector<4>,
    /// Commanded angular rate in body components.
    #[output(discrete, unit = "rad/s", display = "deg/s", nominal = 1e-3)]
    pub rate: RealVector<3>,
    /// Error quaternion, scalar last: from the commanded to the actual body frame (paper 001, eq 25).
    #[output(discrete, unit = "1", nominal = 1.0)]
    pub error: RealVector<4>,
}

/// Constraints in force.
#[derive(Variables)]
pub struct ConstraintVariables {
    /// Whether the keep-in zone changed the command: the Sun stands on its boundary.
    #[output]
    pub sun_keep_in: Boolean,
    /// Whether the hot-pole keep-out changed the command.
    #[output]
    pub hot_pole: Boolean,
    /// Whether something requested was clamped: an angle out of its range, or a constraint that cannot be met whole.
    #[output]
    pub clamped: Boolean,
}
