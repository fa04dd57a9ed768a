//! Whole turns of panels: their angles continued along the flight, where laws and inputs give them within a turn.
//!
//! Method: at the start of each segment the angle of the law is taken with the whole turns that bring it nearest to the angle of the
//! segment before, continued at its rate; within a segment likewise from its start. Communication points only read.

use core::f64::consts::{PI, TAU};

use serde::{Deserialize, Serialize};

use crate::numerics::scalar::Dual64;
use crate::plant::settings::panel_setting::{PanelSetting, SunAt};
use crate::spacecraft::Panel;

/// Angles of all panels where the present segment began; empty before the first one.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PanelTurns {
    since_s: f64,
    /// Angle in rad and its rate in rad/s; 0 of panels that are left out.
    turns: Vec<[f64; 2]>,
}

impl PanelTurns {
    /// Counts from the next segment on anew.
    pub(crate) fn restart(&mut self) {
        self.turns.clear();
    }

    /// A segment begins where the Sun moves like this.
    pub(crate) fn begin(&mut self, settings: &[PanelSetting], panels: &[Panel], sun: &SunAt<Dual64>) {
        if self.turns.len() != panels.len() {
            self.turns.clear();
        }
        for (index, (setting, panel)) in settings.iter().zip(panels).enumerate() {
            let [angle_rad, rate_rad_s] = setting.turn_rad(panel, sun);
            let begun = [self.continued_rad(index, angle_rad, sun.time_s.re), rate_rad_s];
            match self.turns.get_mut(index) {
                Some(turn) => *turn = begun,
                None => self.turns.push(begun),
            }
        }
        self.since_s = sun.time_s.re;
    }

    /// The angle of panel `index` that is `angle_rad` but for whole turns, at `time_s` within the present segment, in rad.
    pub fn continued_rad(&self, index: usize, angle_rad: f64, time_s: f64) -> f64 {
        let Some([start_rad, rate_rad_s]) = self.turns.get(index) else { return angle_rad };
        let expected_rad = start_rad + rate_rad_s * (time_s - self.since_s);
        angle_rad + nearest_turns_rad(expected_rad - angle_rad)
    }
}

/// Whole turns that are nearest to `travel_rad`, in rad.
pub(crate) fn nearest_turns_rad(travel_rad: f64) -> f64 {
    if travel_rad.abs() < PI { 0.0 } else { TAU * (travel_rad / TAU).round() }
}
