//! Direction of the Sun during a downlink, and in science that unloads momentum, chosen where either begins.

use serde::{Deserialize, Serialize};

use crate::guidance::SelectedSunDirections;

/// Last selections, and the window that they are of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SunDirectionSelection {
    /// Last selections.
    pub selected: SelectedSunDirections,
    /// Time of the last of both, in s.
    pub(crate) chosen_s: Option<f64>,
    /// Whether its downlink lasts.
    pub(crate) in_force: bool,
    /// The timeline's command, from 1, that the last downlink was of; 0 where it was a window's.
    pub(crate) row: usize,
}

impl SunDirectionSelection {
    /// Whether the target of the present downlink is out of reach, or that of science that unloads.
    pub fn is_clamped(&self) -> bool {
        let present = if self.in_force { self.selected.downlink } else { self.selected.science };
        present.is_some_and(|chosen| chosen.clamped)
    }

    /// Whether something is due in a window of downlink or of science; each command of a downlink is one of its own.
    pub(crate) fn is_due(&self, downlink: bool, row: usize) -> bool {
        downlink != self.in_force || (downlink && row != self.row)
    }
}
