//! Direction of the Sun during a downlink: selected at the sample where the downlink begins, held while it lasts.
//!
//! A downlink begins where the scenario becomes downlink without an azimuth of its own, with each entry of the timeline that
//! names it, and where a window of the orbit phase begins. Science of the orbit phase that unloads momentum is alike: chosen where it
//! or the scenario begins, held until the next downlink. In Operational alone: other modes have the Sun on -Y.

use serde::{Deserialize, Serialize};

use super::guided::Guided;
use super::schedule::Activity;
use crate::attitude::Attitude;
use crate::guidance::downlink::sun_direction::{SelectedSunDirection, SelectedSunDirections};
use crate::guidance::geometry::ephemeris_at_time::EphemerisAtTime;
use crate::guidance::pointing::command::Scenario;

/// Begin of a downlink, or of science that unloads.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WindowStart<'a> {
    /// Scenario that it belongs to: downlink or orbit phase.
    pub scenario: Scenario,
    /// Activity that begins.
    pub activity: Activity,
    /// Positions and motions at the begin.
    pub ephemeris: &'a EphemerisAtTime,
    /// The attitude as it is estimated.
    pub attitude: Attitude,
    /// Duration, in s.
    pub span_s: f64,
    /// Science and downlink from here on, in s past J2000 TDB; the scenario downlink counts on the windows of the orbit phase, of
    /// which one begins here. Places of the Sun are those of default attitudes.
    pub law: Guided,
}

/// Last selection.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct DownlinkSun {
    /// Directions that were selected last.
    pub selected: SelectedSunDirections,
    /// The scenario whose downlink lasts.
    lasts: Option<Scenario>,
    /// The timeline's entry that named the downlink, by when it begins on the timeline's clock, in s.
    entry: Option<f64>,
    /// Whether that science lasts.
    science_lasts: bool,
}

impl DownlinkSun {
    /// Whether a downlink lasts, or science that unloads, whose target is out of reach.
    pub fn is_clamped(&self) -> bool {
        let SelectedSunDirections { downlink, science } = self.selected;
        let present = if self.lasts.is_some() { downlink } else { science.filter(|_| self.science_lasts) };
        present.is_some_and(|chosen| chosen.clamped)
    }

    /// Ends the downlink or the science that lasts.
    pub fn end(&mut self) {
        (self.lasts, self.science_lasts) = (None, false);
    }

    /// Science lasts that unloads; where it begins `choose` gives its place. Whether it begins.
    pub fn last_in_science(&mut self, choose: impl FnOnce() -> Option<SelectedSunDirection>) -> bool {
        self.lasts = None;
        let begins = !self.science_lasts;
        if begins {
            (self.selected.science, self.science_lasts) = (choose(), true);
        }
        begins
    }

    /// A downlink of `scenario` lasts, by `entry` of the timeline where one names it; where it begins `choose` gives its place.
    /// Whether it begins.
    pub fn last(
        &mut self,
        scenario: Scenario,
        entry: Option<f64>,
        choose: impl FnOnce() -> Option<SelectedSunDirection>,
    ) -> bool {
        self.science_lasts = false;
        let is_new_entry = scenario == Scenario::Downlink && entry.is_some() && entry != self.entry;
        let begins = self.lasts != Some(scenario) || is_new_entry;
        if begins {
            (self.selected.downlink, self.lasts) = (choose(), Some(scenario));
        }
        self.entry = entry.or(self.entry);
        begins
    }
}

#[cfg(test)]
mod tests {
    //! One choice a downlink, whatever goes on meanwhile.
    use super::*;
    use crate::attitude::SunAngles;
    use crate::guidance::downlink::sun_direction::DownlinkSunDirection;
    use core::cell::Cell;

    #[test]
    fn a_downlink_is_chosen_once_and_a_new_one_anew() {
        let count = Cell::new(0);
        let mut sun = DownlinkSun::default();
        let mut last = |scenario, entry| {
            sun.last(scenario, entry, || {
                count.set(count.get() + 1);
                let place = DownlinkSunDirection { angles: SunAngles::default(), earth_ahead: false };
                Some(SelectedSunDirection { place, clamped: true })
            });
            assert!(sun.is_clamped());
            count.get()
        };
        assert_eq!(last(Scenario::Downlink, None), 1);
        assert_eq!(last(Scenario::Downlink, None), 1);
        assert_eq!(last(Scenario::Downlink, Some(4.0)), 2);
        assert_eq!(last(Scenario::Downlink, None), 2);
        assert_eq!(last(Scenario::Downlink, Some(4.0)), 2);
        assert_eq!(last(Scenario::OrbitPhase, Some(5.0)), 3);
        assert_eq!(last(Scenario::OrbitPhase, Some(6.0)), 3);
        sun.end();
        assert!(!sun.is_clamped() && sun.selected.in_downlink().is_some());
        sun.last(Scenario::OrbitPhase, Some(6.0), || None);
        assert!(!sun.is_clamped() && sun.selected.in_downlink().is_none());
        // Science is chosen once too, and a downlink keeps its place for the slew out of it.
        let angles = SunAngles { azimuth_rad: 0.1, elevation_rad: -0.2 };
        let place = DownlinkSunDirection { angles, earth_ahead: false };
        assert!(
            sun.last_in_science(|| Some(SelectedSunDirection { place, clamped: true })) && sun.is_clamped()
        );
        assert!(!sun.last_in_science(|| None) && sun.is_clamped());
        sun.last(Scenario::OrbitPhase, Some(6.0), || None);
        assert!(!sun.is_clamped() && sun.selected.in_science() == Some(angles));
        assert!(sun.last_in_science(|| None) && !sun.is_clamped() && sun.selected.in_science().is_none());
    }
}
