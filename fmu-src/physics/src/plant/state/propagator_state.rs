//! State of the propagator: trajectory and the present segment of light and heat.

use crate::guidance::SelectedSunDirections;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::center_of_mass::CenterOfMass;
use crate::environment::orbit::OrbitError;
use crate::plant::instant::air_and_field_segment::AirAndFieldSegment;
use crate::plant::motion::command_slews::CommandSlews;
use crate::plant::motion::panel_turns::PanelTurns;
use crate::plant::motion::trajectory::Trajectory;
use crate::plant::settings::configuration::Configuration;
use crate::plant::settings::error::PlantError;
use crate::plant::sources::SourceStates;
use crate::spacecraft::Spacecraft;

/// State of the propagator, beside the totals of the momentum integrator. Serialisable and complete: together with the
/// configuration it fixes everything that follows.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct PropagatorState {
    /// Orbit of the spacecraft.
    pub trajectory: Trajectory,
    /// States of the sources.
    pub sources: SourceStates,
    /// Air and magnetic field of the present segment.
    pub air_and_field: AirAndFieldSegment,
    /// Direction of the Sun during downlinks.
    pub sun_choice: SunDirectionSelection,
    /// Centre of mass as events have moved it.
    pub center_of_mass: CenterOfMass,
    /// Whole turns of the panels.
    pub panel_turns: PanelTurns,
    /// Slews into the timeline's commands.
    pub command_slews: CommandSlews,
}

impl PropagatorState {
    /// Rejects decoded states that no simulation can produce.
    pub fn is_valid(&self, spacecraft: &Spacecraft) -> bool {
        self.trajectory.is_valid()
            && self.air_and_field.is_valid()
            && self.sun_choice.selected.is_valid()
            && self.command_slews.is_valid()
            && self.sources.is_valid(spacecraft)
    }

    /// At the start of a flight.
    ///
    /// # Errors
    /// A start below the surface.
    pub fn new(configuration: &Configuration, time_s: f64) -> Result<Self, PlantError> {
        Ok(Self {
            trajectory: Trajectory::new(configuration, time_s)?,
            command_slews: CommandSlews::beginning(time_s),
            ..Self::default()
        })
    }

    /// Becomes another one; allocates nothing where it held as much before.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        // Nobody asks for the turns of a fork's panels.
        let Self { mut sources, panel_turns, .. } = core::mem::take(self);
        sources.copy_from(&other.sources);
        *self = Self { sources, panel_turns, ..*other };
    }

    /// Continues from another place; the heat stored in the surfaces comes along.
    ///
    /// # Errors
    /// A place below the surface.
    pub fn move_to(&mut self, configuration: &Configuration, time_s: f64) -> Result<(), PlantError> {
        self.trajectory = Trajectory::new(configuration, time_s)?;
        self.cut_along(time_s);
        Ok(())
    }

    /// Forgets what was computed ahead of `time_s`: attitude, panels, mass centre or the Sun change there, on which light and heat
    /// depend. `configuration` is the one simulated so far.
    pub fn cut(&mut self, configuration: &Configuration, time_s: f64) {
        self.cut_with_jump(configuration, time_s, &Vector3::zeros());
        self.sources.cut(time_s);
    }

    /// The same but for sources in the same light, where forces have changed the velocity by `jump_m_s`, EME2000, since the last
    /// time: an orbit that forces act on takes it.
    pub fn cut_with_jump(&mut self, configuration: &Configuration, time_s: f64, jump_m_s: &Vector3<f64>) {
        self.command_slews.cut(time_s);
        // An orbit that light and forces act on goes elsewhere from here.
        let orbit_changes = configuration.motion.has_nongravitational_forces();
        let taken_m_s = if orbit_changes { *jump_m_s } else { Vector3::zeros() };
        self.trajectory.cut(configuration, time_s, &taken_m_s);
        if orbit_changes {
            self.sources.cut(time_s);
        }
    }

    /// The velocity jumps by `jump_m_s`, EME2000, at `time_s` in a maneuver, whatever else acts on the orbit.
    ///
    /// # Errors
    /// A velocity without an orbit.
    pub(crate) fn maneuver(
        &mut self,
        configuration: &Configuration,
        time_s: f64,
        jump_m_s: &Vector3<f64>,
    ) -> Result<(), OrbitError> {
        self.trajectory.maneuver(configuration, time_s, jump_m_s)?;
        self.cut_along(time_s);
        Ok(())
    }

    /// Forgets what was computed along the trajectory ahead of `time_s`.
    fn cut_along(&mut self, time_s: f64) {
        self.command_slews.cut(time_s);
        self.air_and_field.span.cut(time_s);
        self.sources.cut(time_s);
    }
}

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
