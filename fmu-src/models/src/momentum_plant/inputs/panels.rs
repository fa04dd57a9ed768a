//! Settings of the panels by parameters and inputs: angles, offsets from the Sun, steps of a timeline.

use std::sync::Arc;

use fmi_export::{Failure, InputsOverTime, Real};
use physics::guidance::timeline::Timeline;
use physics::plant::{PanelSetting, Ramp};
use physics::spacecraft::PanelControl;

use crate::momentum_plant::setup::Read;

/// The timeline in use, and its clock.
pub(super) struct ActiveTimeline<'a> {
    /// The timeline; `None` without one, or where `timeline.enabled` is false.
    pub law: Option<&'a Arc<Timeline>>,
    /// The timeline's clock minus the time of the simulation, in s; 0 without a timeline.
    pub clock_minus_time_s: f64,
}

impl<'a> ActiveTimeline<'a> {
    /// Reads whether the timeline of the setup is in use.
    pub(super) fn read(read: Read<'a>, epoch_minus_time_s: f64) -> Self {
        let enabled = read.boolean(read.variables.timeline.enabled);
        let law = read.setup.timeline.as_ref().filter(|_| enabled);
        Self { law, clock_minus_time_s: law.map_or(0.0, |it| it.clock_minus_time_s(epoch_minus_time_s)) }
    }
}

/// Inputs that move panels within a step.
pub(super) struct MovingPanels<'a> {
    /// The inputs over the step.
    pub over_time: InputsOverTime<'a>,
    /// Memory for the settings; its content is replaced.
    pub memory: Vec<PanelSetting>,
}

/// The setting of each panel; angles move as the inputs do.
///
/// # Errors
/// A corridor of the cells' light that is none.
pub(super) fn read(
    read: Read<'_>,
    moving: MovingPanels<'_>,
    timeline: &ActiveTimeline<'_>,
) -> Result<Vec<PanelSetting>, Failure> {
    let variables = read.variables;
    let corridor = variables.articulation.read(read.values)?;
    let MovingPanels { over_time, memory: mut panels } = moving;
    panels.clear();
    panels.extend(variables.panel.iter().enumerate().map(|(k, panel)| {
        if !read.boolean(panel.enabled) {
            return PanelSetting::Disabled;
        }
        let since_s = over_time.start_s();
        let ramp = |input: Real| Ramp::since(since_s, read.real(input), over_time.rate(input, since_s));
        let tilt = read.choice(panel.tilt).sign().into();
        let offset = |offset| PanelSetting::SunOffset { offset, tilt };
        let steps = || timeline.law.and_then(|_| read.setup.panel_steps.get(k).cloned());
        match read.choice(panel.control).0 {
            PanelControl::Angle => PanelSetting::Angle(ramp(panel.angle)),
            PanelControl::SunOffset => offset(Ramp::held(read.real(panel.sun_offset))),
            PanelControl::Timeline => PanelSetting::Timeline {
                steps: steps().unwrap_or_default(),
                clock_minus_time_s: timeline.clock_minus_time_s,
                before_rad: read.real(panel.sun_offset),
                tilt,
            },
            PanelControl::Command => offset(ramp(panel.sun_offset_command)),
            PanelControl::Distance => PanelSetting::Distance { suns: corridor.target_suns, tilt },
        }
        .biased(read.real(panel.angle_bias))
    }));
    Ok(panels)
}
