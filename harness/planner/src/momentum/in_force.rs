//! Controls of the plan that a mission has so far, from which a new one begins.
//!
//! A window of the new plan takes the mean over its time: that of the places of the Sun and of the arrays, and of the alternate attitude
//! the share.

use super::{
    controls::{ALL, Controls},
    simulated::SAME_S,
};

/// Controls from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ActiveControls {
    /// In s of the flight.
    pub at_s: f64,
    /// Up to the next one.
    pub controls: Controls,
}

/// Mean over a span of time; `None` where nothing is in force at its beginning. The controls are in the order of time.
pub(super) fn mean(all: &[ActiveControls], [from_s, to_s]: [f64; 2]) -> Option<Controls> {
    all.first().filter(|first| first.at_s <= from_s + SAME_S)?;
    let mut mean = Controls::default();
    for (index, it) in all.iter().enumerate() {
        let until_s = all.get(index + 1).map_or(f64::INFINITY, |next| next.at_s);
        let start_s = if index == 0 { from_s } else { it.at_s.max(from_s) };
        let share = ((until_s.min(to_s) - start_s) / (to_s - from_s)).max(0.0);
        for control in ALL {
            mean = mean.with(control, mean.get(control) + share * it.controls.get(control));
        }
    }
    Some(mean)
}

#[cfg(test)]
mod tests {
    //! Means over spans that begin and end between controls.
    use super::*;
    use crate::momentum::controls::Control;

    fn in_force() -> Vec<ActiveControls> {
        let of = |at_s, azimuth_rad, alternate| ActiveControls {
            at_s,
            controls: Controls::default()
                .with(Control::Azimuth, azimuth_rad)
                .with(Control::Alternate, alternate),
        };
        vec![of(0.0, 0.1, 0.0), of(10.0, 0.2, 1.0), of(20.0, -0.1, 0.0)]
    }

    #[test]
    fn means_are_weighted_by_time() {
        let found = mean(&in_force(), [5.0, 25.0]).unwrap();
        // 5 s, 10 s and 5 s.
        assert!((found.get(Control::Azimuth) - (0.25 * 0.1 + 0.5 * 0.2 - 0.25 * 0.1)).abs() < 1e-15);
        assert!((found.get(Control::Alternate) - 0.5).abs() < 1e-15);
        assert_eq!(mean(&in_force(), [30.0, 40.0]).unwrap().get(Control::Azimuth), -0.1);
    }

    #[test]
    fn nothing_is_in_force_before_the_first() {
        assert_eq!(mean(&in_force(), [-1.0, 5.0]), None);
        assert_eq!(mean(&[], [0.0, 5.0]), None);
    }
}
