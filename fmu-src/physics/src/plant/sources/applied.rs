//! Force and torque from outside, which act exactly.

use super::source::{Results, Source};
use crate::loads::Effect;
use crate::plant::instant::conditions::Conditions;

/// The row of what is applied.
pub(crate) const APPLIED: Effect = Effect::Applied;

/// Load from outside.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Applied;

impl Source for Applied {
    const ROWS: &'static [Effect] = &[APPLIED];
    type Settings = ();
    type State = ();

    fn load(&mut self, (): &(), (): &(), at: &Conditions<'_>, results: &mut Results<'_>) {
        results.loads[APPLIED] = at.applied;
    }
}
