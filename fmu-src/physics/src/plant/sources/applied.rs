//! Force and torque from outside, which act exactly.

use super::source::{Source, Workspace};
use crate::loads::{Effect, Loads};
use crate::plant::instant::conditions::Conditions;
use crate::plant::settings::configuration::Configuration;

/// The row of what is applied.
pub(crate) const APPLIED: Effect = Effect::Applied;

/// Load from outside.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Applied;

impl Source for Applied {
    const ROWS: &'static [Effect] = &[APPLIED];
    type Settings = ();
    type State = ();

    fn settings(_: &Configuration) -> &() {
        &()
    }

    fn load(&mut self, (): &(), (): &(), at: &Conditions<'_>, _: &mut Workspace, loads: &mut Loads) {
        loads[APPLIED] = at.applied;
    }
}
