//! Steps of a plan as they are written: stretches of its windows in one attitude, and positions of the arrays.
//!
//! Angles are written in deg to a ten-thousandth, momenta in N m s to a millionth, times of alternation to a minute, so that steps of a minute
//! meet them; what is simulated is what is written.

use nalgebra::Vector3;

use crate::momentum::{
    controls::{ARRAYS, Controls},
    windows::Window,
};

/// Angles are written so fine, as parts of a deg.
const PARTS_OF_DEG: f64 = 1e4;
/// And momenta, as parts of an N m s.
const PARTS_OF_N_M_S: f64 = 1e6;
const MINUTE_S: f64 = 60.0;
/// Share of a minute within which a time is a whole one.
const SAME_MINUTE: f64 = 1e-5;

/// Angle in deg as it is written.
pub(super) fn shown_deg(angle_rad: f64) -> f64 {
    let deg = (angle_rad.to_degrees() * PARTS_OF_DEG).round() / PARTS_OF_DEG;
    // No minus before zero.
    deg + 0.0
}

/// Momentum in N m s as it is written.
pub(super) fn shown_n_m_s(momentum_n_m_s: &Vector3<f64>) -> [f64; 3] {
    momentum_n_m_s.map(|it| (it * PARTS_OF_N_M_S).round() / PARTS_OF_N_M_S + 0.0).into()
}

/// One stretch of a window in one attitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Stretch {
    pub at_s: f64,
    pub alternate: bool,
}

/// The stretches of a free window.
pub(super) fn stretches(window: &Window) -> Vec<Stretch> {
    let mut all = vec![Stretch { at_s: window.start_s, alternate: false }];
    for [from_s, to_s] in window.alternate_spans_s() {
        // Inward, for a contact may be at either end.
        let [from_s, to_s] = [
            MINUTE_S * (from_s / MINUTE_S - SAME_MINUTE).ceil(),
            MINUTE_S * (to_s / MINUTE_S + SAME_MINUTE).floor(),
        ];
        if to_s <= from_s {
            continue;
        }
        if all.last().is_some_and(|last| (last.at_s - from_s).abs() < 0.5) {
            all.pop();
        }
        all.push(Stretch { at_s: from_s, alternate: true });
        if to_s < window.stop_s - 0.5 {
            all.push(Stretch { at_s: to_s, alternate: false });
        }
    }
    all
}

/// Settings of the arrays from a time on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct ArrayStep {
    pub at_s: f64,
    pub offset_deg: f64,
    pub windmill_deg: f64,
}

impl ArrayStep {
    /// The arrays as they are written, from a time on.
    pub(super) fn new(at_s: f64, controls: &Controls) -> Self {
        let [offset_deg, windmill_deg] = controls.each(ARRAYS).map(shown_deg);
        Self { at_s, offset_deg, windmill_deg }
    }
}

/// The steps of the arrays over the windows of a plan.
pub(super) fn array_steps(windows: &[Window]) -> Vec<ArrayStep> {
    let mut steps: Vec<ArrayStep> = Vec::new();
    for window in windows.iter().filter(|window| window.has_arrays()) {
        let step = ArrayStep::new(window.start_s, &window.controls);
        let stays = steps.last().is_some_and(|last| ArrayStep { at_s: step.at_s, ..*last } == step);
        if !stays {
            steps.push(step);
        }
    }
    steps
}
