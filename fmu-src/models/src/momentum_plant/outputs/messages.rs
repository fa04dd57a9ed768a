//! Messages of a flight: why it ends, and the dumps and maneuvers that happen.

use fmi_export::Failure;
use physics::momentum::WorkKind;
use physics::plant::{PlantError, ThrusterEvent};

use crate::momentum_plant::setup::Plan;

/// The failure of a flight that ends, with the variables to look at.
pub(crate) fn failure(error: PlantError) -> Failure {
    let hint = match &error {
        PlantError::WithoutPosition { .. } | PlantError::Light { .. } => {
            "; see orbit.*, sun.position and planet.radius"
        }
        PlantError::Maneuver { .. } => "; see maneuver.request, maneuver.deltaV and maneuver.thrusters",
        PlantError::Dumps(_) => "; see dump.threshold, dump.reinitTo and torque.applied",
        PlantError::Work(exceeded) => {
            let most = match exceeded.most {
                WorkKind::Segment => {
                    "internal steps, which solver.step, orbit.step and solver.disturbanceStep keep short"
                }
                WorkKind::Refinement => {
                    "internal steps shortened for solver.tolerance, which is small for this torque and attitude rate"
                }
                WorkKind::Search => {
                    "searches for changes of attitude, light and eclipse: see orbit.*, guided.* and command.rate"
                }
                WorkKind::Dump => {
                    "dumps: dump.threshold is low for this torque; see torque.applied and spacecraft.centerOfMass"
                }
                WorkKind::Light => {
                    "light and heat: see solver.disturbanceStep, solver.disturbanceTolerance and planetLight.nodes"
                }
                WorkKind::Air => "air and magnetic field along the orbit; see atmosphere.tolerance",
                WorkKind::Orbit => "integrating the orbit in steps of orbit.step",
                WorkKind::Ephemeris => {
                    "the positions of planets far apart in time: see guided.slewRate and guided.downlinkEvery"
                }
            };
            return Failure::new(format!(
                "{error} (solver.workLimit = {}); most went into {most}. Take a shorter step or raise solver.workLimit",
                exceeded.limit
            ));
        }
        _ => "",
    };
    Failure::new(format!("{error}{hint}"))
}

/// Reports a dump or a maneuver.
pub(crate) fn log_event(context: &Plan<'_>, event: &ThrusterEvent) {
    if !context.log.events_enabled() {
        return;
    }
    let (time_s, message) = match event {
        ThrusterEvent::Dump(event) => (
            event.time_s,
            format!(
                "thruster dump: momentum {:?} -> {:?} N.m.s (body)",
                event.before_body_n_m_s.as_slice(),
                event.after_body_n_m_s.as_slice()
            ),
        ),
        ThrusterEvent::Maneuver { time_s, requested_m_s, executed_m_s } => (
            *time_s,
            format!(
                "maneuver: {:?} m/s requested, {:?} m/s executed (EME2000)",
                requested_m_s.as_slice(),
                executed_m_s.as_slice()
            ),
        ),
    };
    context.log.event(time_s, &message);
}
