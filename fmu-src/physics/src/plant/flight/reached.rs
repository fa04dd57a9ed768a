//! How far a flight by torque has come in a step: the motion there, and parts of the last sample that only a report needs.

use crate::attitude::control::ControlTarget;
use crate::attitude::{Attitude, MotionAt};
use crate::plant::events::EventKind;
use crate::plant::settings::dynamics_settings::{DynamicsInputs, DynamicsSettings};
use crate::plant::state::dynamic_state::DynamicState;

/// End of the motion so far; none of it is saved.
#[derive(Default)]
pub(super) struct Reached {
    /// The motion where it was evaluated last.
    pub at: Option<MotionAt>,
    /// The last kind applied there of those that every segment ends with.
    pub applied: Option<EventKind>,
    /// Number of the last sample, where its Sun sensors are not sampled yet.
    pub number: Option<i64>,
    /// Target and estimate of the controller's last sample, where its error is not measured yet.
    pub tracked: Option<(ControlTarget, Attitude)>,
}

impl Reached {
    /// Whether this kind is the next one of those that every segment ends with.
    pub(super) fn is_next(&self, kind: EventKind) -> bool {
        match self.applied {
            None => kind == EventKind::Accounts,
            Some(EventKind::Accounts) => kind == EventKind::Valves,
            Some(EventKind::Valves) => kind == EventKind::Load,
            _ => false,
        }
    }

    /// The motion at `time_s`, where it has come.
    pub(super) fn at(&mut self, state: &DynamicState, settings: &DynamicsSettings, time_s: f64) -> &MotionAt {
        if self.at.as_ref().is_none_or(|at| at.time_s != time_s) {
            self.at = None;
        }
        self.at.get_or_insert_with(|| state.motion.evaluated_at(&settings.gyrostat, time_s))
    }

    /// The Sun sensors are sampled and the controller's error is measured where the flight was sampled last.
    pub(super) fn complete(
        &mut self,
        state: &mut DynamicState,
        settings: &DynamicsSettings,
        inputs: &DynamicsInputs,
    ) {
        if let Some(number) = self.number.take() {
            let sun = state.disturbance.sun_at(state.sensing.sampled_s);
            state.sensing.sample_sun(settings, inputs, sun, number);
        }
        if let Some((target, estimated)) = self.tracked.take() {
            state.control.controller.measure_error(&target, &estimated);
        }
    }
}
