//! Dumps of a flight by torque: by pulses of thrusters, or by a constant torque of a spacecraft without thrusters that give
//! torque both ways about each axis; and momentum by effect since the last one.

use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::disturbance_interval::DisturbanceInterval;
use crate::attitude::{GyrostatMotion, MotionAt};
use crate::loads::{ByEffect, Effect, ForceTorque, Linear, Writer};
use crate::momentum::{DumpEvent, DumpSpacing, Dumps, SourceMomenta};
use crate::plant::sources::Dipoles;
use crate::plant::sources::applied::APPLIED;
use crate::plant::thrusters::allocation::{ThrusterAllocator, Unserved};
use crate::plant::thrusters::reaction_control::Thrusters;
use crate::spacecraft::MassProperties;

/// A dump by a constant torque.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
struct ConstantDump {
    torque_body_n_m: Vector3<f64>,
    until_s: f64,
}

/// Dumps so far, and the one that lasts.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct MomentumDumps {
    constant: Option<ConstantDump>,
    /// Dumps so far.
    pub dumps: Dumps,
    /// Time between dumps.
    pub spacing: DumpSpacing,
    /// Momentum by effect from the last dump up to the present segment of the motion.
    by_source: SourceMomenta,
    /// Torque by effect from the start of that segment on.
    torques: ByEffect<Option<Linear>>,
    /// Dipoles by row in the magnetic field from there on.
    pub dipoles: Dipoles,
}

impl MomentumDumps {
    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        self.dumps.is_valid() && self.spacing.is_valid()
    }

    /// When a constant torque ends, in s; infinite where none acts.
    pub(crate) fn until_s(&self) -> f64 {
        self.constant.map_or(f64::INFINITY, |dump| dump.until_s)
    }

    /// Constant torque of a dump that lasts, in N m.
    pub(crate) fn torque_body_n_m(&self) -> Vector3<f64> {
        self.constant.map_or(Vector3::zeros(), |dump| dump.torque_body_n_m)
    }

    /// Ends a constant torque whose time has come.
    pub(crate) fn end(&mut self, due_s: f64) {
        self.constant = self.constant.filter(|dump| dump.until_s > due_s);
    }

    /// Adds what the effects did in the segment that ends; nothing of a dump's time counts.
    pub(crate) fn accumulate(&mut self, motion: &GyrostatMotion, end: &MotionAt, is_dumping: bool) {
        if is_dumping {
            self.by_source = SourceMomenta::default();
        } else {
            add_impulses(&mut self.by_source, &self.torques, &self.dipoles, motion, end);
        }
        self.torques.clear();
        self.dipoles = Dipoles::default();
    }

    /// Returns the momentum by effect since the end of the last dump.
    pub(crate) fn by_source(&self, motion: &GyrostatMotion, until: &MotionAt) -> SourceMomenta {
        let mut sum = self.by_source;
        add_impulses(&mut sum, &self.torques, &self.dipoles, motion, until);
        sum
    }

    /// Sets torque and dipoles by row from `time_s`, where a segment begins, on.
    pub(crate) fn begin_segment(
        &mut self,
        disturbance: &DisturbanceInterval,
        external: &[ForceTorque; 2],
        dipoles: Dipoles,
        time_s: f64,
    ) {
        self.torques.clear();
        for (effect, _) in disturbance.loads.present().filter(|(effect, _)| effect.row().momentum_apart) {
            self.torques[effect] = disturbance.torque_at(effect, time_s);
        }
        self.torques[APPLIED] = Some(external.map(|load| load.torque_body_n_m));
        self.dipoles = dipoles;
    }

    /// Begins a dump at the end of the motion: by thrusters that give torque both ways about each axis, or by a constant
    /// torque; false where those thrusters are not fed.
    pub(crate) fn begin(
        &mut self,
        event: DumpEvent,
        thrusters: &mut Thrusters,
        allocator: &mut ThrusterAllocator,
        motion: &GyrostatMotion,
        mass: &MassProperties,
    ) -> bool {
        let target = motion.attitude_at(event.time_s).inertial_from_body(&event.after_body_n_m_s);
        let has_thrusters = !allocator.settings.thrusters.is_empty();
        let by_thrusters = has_thrusters.then(|| {
            let center_of_mass_body_m = &mass.center_of_mass_body_m;
            thrusters.begin_dump(allocator, motion, target, center_of_mass_body_m)
        });
        if by_thrusters == Some(Err(Unserved::Unfed)) {
            return false;
        }
        self.dumps = self.dumps.with(event);
        self.spacing.dumped(&event);
        self.by_source = SourceMomenta::default();
        if by_thrusters == Some(Ok(())) {
            return true;
        }
        let impulse_body_n_m_s = event.impulse_body_n_m_s();
        let duration_s = impulse_body_n_m_s.amax() / allocator.settings.dump_torque_n_m;
        if duration_s > 0.0 {
            let torque_body_n_m = impulse_body_n_m_s / duration_s;
            self.constant = Some(ConstantDump { torque_body_n_m, until_s: event.time_s + duration_s });
        }
        true
    }

    /// Whether one lasts at `time_s`.
    pub(crate) fn is_dumping(&self, thrusters: &Thrusters, time_s: f64) -> bool {
        self.constant.is_some_and(|dump| time_s < dump.until_s) || thrusters.is_dumping()
    }

    /// Whether another may begin.
    pub(crate) fn are_over(&self, thrusters: &Thrusters) -> bool {
        self.constant.is_none() && !thrusters.is_dumping()
    }
}

/// Adds the change of momentum by effect since the start of the motion's segment, EME2000, in N m s.
fn add_impulses(
    sum: &mut SourceMomenta,
    torques: &ByEffect<Option<Linear>>,
    dipoles: &Dipoles,
    motion: &GyrostatMotion,
    until: &MotionAt,
) {
    let mut impulses = [Vector3::zeros(); Effect::COUNT];
    for (row, torque) in torques.present() {
        impulses[row as usize] = until.linear_impulse_inertial_n_m_s(torque);
    }
    for (row, dipole) in Effect::FIELD.into_iter().zip(dipoles) {
        let impulse = dipole.and_then(|dipole| motion.dipole_impulse_inertial_n_m_s(&dipole, until));
        impulses[row as usize] += impulse.unwrap_or_default();
    }
    let by_parts = [
        (Writer::Rotors, motion.imbalance_impulse_inertial_n_m_s(until)),
        (Writer::Propellant, motion.swing_impulse_inertial_n_m_s(until)),
    ];
    for (writer, impulse) in by_parts.into_iter().filter_map(|(writer, impulse)| Some((writer, impulse?))) {
        let written = Effect::ALL.into_iter().filter(|row| row.row().writer == writer);
        written.for_each(|row| impulses[row as usize] += impulse);
    }
    sum.add(&impulses);
}
