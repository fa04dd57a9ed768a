//! Direction of the Sun during a downlink, and in science that unloads momentum, chosen where either begins.

use serde::{Deserialize, Serialize};

use crate::attitude::SunAngles;
use crate::guidance::{DownlinkSunDirection, SelectedSunDirection};

/// The last choices; the slew after a downlink starts from its attitude, and that after science from its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SunDirectionSelection {
    /// Last choice for a downlink.
    pub chosen: Option<SelectedSunDirection>,
    /// Last choice for science that unloads.
    pub science: Option<SelectedSunDirection>,
    /// When the last of both was, in s.
    pub(crate) chosen_s: Option<f64>,
    /// Whether its downlink lasts.
    pub(crate) in_force: bool,
    /// The timeline's command, from 1, that the last downlink was of; 0 where it was a window's.
    pub(crate) row: usize,
}

impl SunDirectionSelection {
    /// Whether a simulation can produce it.
    pub fn is_valid(&self) -> bool {
        [self.chosen, self.science].into_iter().flatten().all(|chosen| chosen.place.is_valid())
    }

    /// The Sun's place in the downlink attitude; `None`: on -Y.
    pub fn place(&self) -> Option<DownlinkSunDirection> {
        self.chosen.map(|chosen| chosen.place)
    }

    /// Its place in science that unloads; `None`: on -Y.
    pub fn in_science(&self) -> Option<SunAngles> {
        self.science.map(|chosen| chosen.place.angles)
    }

    /// Whether the target of the present downlink is out of reach, or that of science that unloads.
    pub fn is_clamped(&self) -> bool {
        let present = if self.in_force { self.chosen } else { self.science };
        present.is_some_and(|chosen| chosen.clamped)
    }

    /// Whether something is due in a window of downlink or of science; each command of a downlink is one of its own.
    pub(crate) fn is_due(&self, downlink: bool, row: usize) -> bool {
        downlink != self.in_force || (downlink && row != self.row)
    }
}
