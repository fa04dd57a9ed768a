//! The spacecraft's thrusters: impulses where the attitude is followed ideally, else forces that act exactly, valve edge by valve edge.

use super::source::Source;
use crate::loads::Effect;

/// The row of thrusters.
pub const THRUSTERS: Effect = Effect::Thrusters;

/// Thrusters, whose valves and tanks the flight owns.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct OwnThrusters;

impl Source for OwnThrusters {
    const ROWS: &'static [Effect] = &[THRUSTERS];
    type Settings = ();
    type State = ();
}
