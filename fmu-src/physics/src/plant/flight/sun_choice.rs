//! Where the Sun stands during a downlink, and in science that unloads momentum, chosen where either begins.

use serde::{Deserialize, Serialize};

use crate::attitude::SunAngles;
use crate::guidance::{ChosenPlace, SunPlace};

/// The last choices; the slew after a downlink starts from its attitude, and that after science from its own.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SunChoice {
    /// What was chosen for a downlink.
    pub chosen: Option<ChosenPlace>,
    /// And for science that unloads.
    pub science: Option<ChosenPlace>,
    /// When the last of both was, in s.
    pub(crate) chosen_s: Option<f64>,
    /// Whether its downlink lasts.
    pub(crate) in_force: bool,
}

impl SunChoice {
    /// Whether a simulation can produce it.
    pub fn is_valid(&self) -> bool {
        [self.chosen, self.science].into_iter().flatten().all(|chosen| chosen.place.is_valid())
    }

    /// The Sun's place in the downlink attitude; `None`: on -Y.
    pub fn place(&self) -> Option<SunPlace> {
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

    /// Whether something is due in a window of downlink or of science.
    pub(crate) fn is_due(&self, downlink: bool) -> bool {
        downlink != self.in_force
    }
}
