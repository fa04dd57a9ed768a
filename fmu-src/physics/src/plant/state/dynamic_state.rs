//! State of a flight by torque: body, panels, disturbances, sensors, control, dumps and their schedule.

use crate::spacecraft::{MassProperties, Panel, Spacecraft};
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::disturbance_interval::DisturbanceInterval;
use super::momentum_dumps::MomentumDumps;
use crate::attitude::{BodyLoad, DipoleInField, GyrostatMotion};
use crate::loads::ForceTorque;
use crate::numerics::spacing::spacing;
use crate::plant::control::control_loop::ControlLoop;
use crate::plant::control::sensing::Sensing;
use crate::plant::events::LastEvents;
use crate::plant::motion::panel_motion::PanelMotion;
use crate::plant::sources::Dipoles;
use crate::plant::thrusters::reaction_control::Thrusters;

/// State of the attitude dynamics.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct DynamicState {
    pub motion: GyrostatMotion,
    pub mass: MassState,
    pub panels: PanelMotion,
    pub disturbance: DisturbanceInterval,
    pub sensing: Sensing,
    pub control: ControlLoop,
    pub dumps: MomentumDumps,
    /// The last event of each kind.
    pub last: LastEvents,
}

impl DynamicState {
    /// Rejects decoded states that no simulation of this spacecraft can produce.
    pub(crate) fn is_valid(&self, spacecraft: &Spacecraft) -> bool {
        // Panels without mass have no motion of their own.
        let has_mass = spacecraft.panels.iter().any(|panel| panel.mass.is_some());
        let panels = if has_mass { spacecraft.panels.len() } else { 0 };
        let wheels = spacecraft.wheels.len();
        self.motion.is_valid(wheels, spacecraft.oscillator_count())
            && self.mass.is_valid()
            && self.panels.is_valid(panels)
            && self.disturbance.is_valid()
            && self.sensing.is_valid()
            && self.control.is_valid(wheels)
            && self.dumps.is_valid()
    }

    /// Whether it has come to `time_s` and not beyond the segment there.
    pub(crate) fn covers(&self, time_s: f64) -> bool {
        let tolerance_s = tolerance_s(time_s);
        self.motion.start_s() <= time_s + tolerance_s && time_s <= self.motion.end_s() + tolerance_s
    }

    /// Something that acts changes at `time_s`, but neither light nor place.
    pub(crate) fn cut(&mut self, time_s: f64) {
        if time_s < self.motion.end_s() - tolerance_s(time_s) {
            self.motion.cut(time_s);
        }
    }

    /// Force, torque and mass flow on the body from `time_s` on.
    pub(crate) fn load(
        &self,
        [now, slope]: &[ForceTorque; 2],
        dipoles: &Dipoles,
        thrusters: &Thrusters,
        panels: &[Panel],
        time_s: f64,
    ) -> BodyLoad {
        let [[force, force_slope], [torque, torque_slope]] = self.disturbance.total_at(time_s);
        let dump = self.dumps.torque_body_n_m();
        let thrusters = &thrusters.load;
        let [thrust, thrust_slope] = thrusters.law.force_body_n;
        let [turn, turn_slope] = thrusters.law.torque_body_n_m;
        BodyLoad {
            torque_body_n_m: [
                torque + now.torque_body_n_m + dump + turn,
                torque_slope + slope.torque_body_n_m + turn_slope,
            ],
            force_body_n: [
                force + now.force_body_n + thrust,
                force_slope + slope.force_body_n + thrust_slope,
            ],
            mass_kg: thrusters.mass_kg,
            flow_kg_s: thrusters.law.flow_kg_s,
            mass_flow: (!thrusters.law.is_none()).then_some(thrusters.mass_flow),
            dipole: self.in_field(dipoles),
            internal: self.panels.internal(panels, &self.mass.now, time_s),
        }
    }

    /// The sum of these dipoles in the field from the end of the motion on, where there is one.
    pub(crate) fn in_field(&self, dipoles: &Dipoles) -> Option<DipoleInField> {
        let dipole_body_a_m2 = dipoles
            .iter()
            .flatten()
            .copied()
            .reduce(|[sum, sum_rate], [dipole, rate]| [sum + dipole, sum_rate + rate])?;
        let field_inertial_t = self.disturbance.field_at(self.motion.end_s());
        (dipole_body_a_m2 != [Vector3::zeros(); 2])
            .then_some(DipoleInField { dipole_body_a_m2, field_inertial_t })
    }
}

/// Times this close count as one.
pub(crate) fn tolerance_s(time_s: f64) -> f64 {
    4.0 * spacing(time_s)
}

/// Mass properties of a body that turns by its dynamics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct MassState {
    /// At the last edge of the grid, with the panels as they stood then: what the controller knows.
    pub known: MassProperties,
    /// At the start of the present segment of the motion: without the propellant that flowed since.
    pub now: MassProperties,
    /// At the last edge of the grid with every panel at angle 0; absent while no propellant is used.
    pub stowed: Option<MassProperties>,
}

impl MassState {
    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        [Some(self.known), Some(self.now), self.stowed].iter().flatten().all(|mass| mass.mass_kg > 0.0)
    }
}
