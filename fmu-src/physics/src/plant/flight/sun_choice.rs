//! Where the Sun stands during a downlink, chosen where the downlink begins.

use serde::{Deserialize, Serialize};

use crate::guidance::{ChosenPlace, SunPlace};
use crate::numerics::chebyshev::GREATEST_IN_STATE;

/// The last choice; the slew after a downlink starts from its attitude.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SunChoice {
    /// What was chosen.
    pub chosen: Option<ChosenPlace>,
    /// When, in s.
    pub(crate) chosen_s: Option<f64>,
    /// Whether its downlink lasts.
    pub(crate) in_force: bool,
}

impl SunChoice {
    /// Whether its numbers can come from a flight; bytes from elsewhere may hold anything.
    pub fn is_sound(&self) -> bool {
        self.chosen.is_none_or(|chosen| chosen.place.is_sound())
            && self.chosen_s.is_none_or(|at_s| at_s.abs() <= GREATEST_IN_STATE)
    }

    /// The Sun's place in the downlink attitude; `None`: on -Y.
    pub fn place(&self) -> Option<SunPlace> {
        self.chosen.map(|chosen| chosen.place)
    }

    /// Whether a downlink lasts whose target is out of reach.
    pub fn is_clamped(&self) -> bool {
        self.in_force && self.chosen.is_some_and(|chosen| chosen.clamped)
    }

    /// Whether something is due in a window of downlink or of science.
    pub(crate) fn is_due(&self, downlink: bool) -> bool {
        downlink != self.in_force
    }
}
