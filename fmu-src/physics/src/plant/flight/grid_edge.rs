//! Edges of the disturbance grid of a flight by torque, and its start: orbit, mass properties, panels and disturbances anew.

use nalgebra::Vector3;

use crate::attitude::{Attitude, BodyMotion, GyrostatMotion};
use crate::spacecraft::MassProperties;

use super::configured::ConfiguredFlight;
use crate::plant::control::control_loop::ControlLoop;
use crate::plant::control::sensing::Sensing;
use crate::plant::disturbances::disturbance_interval::{deviate, next_interval};
use crate::plant::disturbances::plant::Plant;
use crate::plant::events::LastEvents;
use crate::plant::motion::panel_motion::PanelMotion;
use crate::plant::settings::dynamics_settings::{DynamicsSettings, StartMotion, StartPointing};
use crate::plant::settings::error::PlantError;
use crate::plant::state::disturbance_interval::DisturbanceInterval;
use crate::plant::state::dynamic_state::{DynamicState, MassState};
use crate::plant::state::momentum_dumps::MomentumDumps;

/// Returns the state at the start of a flight in the attitude after `held`.
pub(super) fn begin(
    settings: &mut DynamicsSettings,
    flight: &mut ConfiguredFlight<'_>,
    time_s: f64,
    held: &Attitude,
) -> Result<DynamicState, PlantError> {
    let last = LastEvents::before(time_s);
    flight.configuration.thruster_events.check_for_dynamics(last.scheduled())?;
    let StartMotion { mut attitude, mut rate_body_rad_s, rate_is_pointed, .. } = settings.start;
    if let Some(pointing) = &settings.start.pointing {
        let frame = match pointing {
            StartPointing::Guidance(law) => flight.frame_by(law, time_s)?,
            StartPointing::Command(command) => command.frame_at(time_s),
        };
        attitude = Attitude::from_rotation(&frame.inertial_from_body);
        if rate_is_pointed {
            rate_body_rad_s = frame.rate_body_rad_s;
        }
    }
    attitude = attitude.continuing(&held.unit_quaternion());
    let unit = attitude.unit_quaternion();
    let [momentum_inertial_n_m_s, delta_v_inertial_m_s] = [Vector3::zeros(); 2];
    let body = BodyMotion { attitude: unit, rate_body_rad_s, momentum_inertial_n_m_s, delta_v_inertial_m_s };
    let mut mass = flight.configuration.wet_mass;
    if flight.given.prepared.has_panel_mass() {
        let still = BodyMotion { rate_body_rad_s: Vector3::zeros(), ..body };
        let mut plant = flight.plant_at(time_s, &still);
        let instant = plant.instant(time_s);
        mass = plant.mass_properties(&instant);
        settings.set_mass_properties(&mass);
    }
    let gyrostat = &settings.gyrostat;
    let wheel_n_m_s = |k: usize| settings.start.wheels_n_m_s.get(k).copied().unwrap_or(0.0);
    let mut begun = DynamicState {
        motion: GyrostatMotion::new(gyrostat, time_s, unit, &rate_body_rad_s, wheel_n_m_s),
        mass: MassState { known: mass, now: mass, stowed: None },
        panels: PanelMotion::default(),
        disturbance: DisturbanceInterval::default(),
        sensing: Sensing::new(settings, time_s, attitude, rate_body_rad_s),
        control: ControlLoop::new(gyrostat.wheels().len(), time_s, attitude, rate_body_rad_s),
        dumps: MomentumDumps::default(),
        last,
    };
    if flight.given.prepared.has_panel_mass() {
        let mut plant = flight.plant_at(time_s, &body);
        let instant = plant.instant(time_s);
        begun.panels = PanelMotion::at_start(plant.path.panel_laws(), &instant.moving_sun());
        let internal = begun.panels.internal(flight.given.prepared.panels, &mass, begun.motion.end_s());
        begun.motion.add_hinges(internal);
    }
    flight.propagator.panel_turns.restart();
    Ok(begun)
}

/// Begins an interval at an edge of the grid: orbit, mass properties and disturbances anew.
pub(super) fn begin_interval(
    state: &mut DynamicState,
    settings: &mut DynamicsSettings,
    flight: &mut ConfiguredFlight<'_>,
) -> Result<(), PlantError> {
    let panels_have_mass = flight.given.prepared.has_panel_mass();
    let time_s = state.motion.end_s();
    let body = state.motion.at(&settings.gyrostat, time_s);
    let stowed = flight.used_mass(&flight.configuration.wet_mass, time_s);
    state.mass.stowed = (flight.thrusters.propellant.total_used_kg(time_s) > 0.0).then_some(stowed);
    *flight.current_mass_panels_stowed = stowed;
    let begins = state.disturbance.is_before();
    if begins || !flight.configuration.uses_encke() {
        flight.propagator.cut(flight.configuration, time_s);
    } else {
        flight.propagator.sources.cut(time_s);
    }
    let rate_terms_body = predicted_rate_terms(state, settings, flight, &body);
    let has_thrusters = !flight.allocator.settings.thrusters.is_empty();
    let mut plant = flight.turning_plant(time_s, &body, rate_terms_body);
    if panels_have_mass && let Some(body) = track_panel_laws(state, settings, &mut plant) {
        plant = flight.turning_plant(time_s, &body, rate_terms_body);
    }
    let inverse_inertia = settings.gyrostat.inverse_carrier().filter(|_| settings.control.is_none());
    state.disturbance =
        next_interval(&state.disturbance, &mut plant, time_s, settings.grid_s, inverse_inertia)?;
    deviate(&state.disturbance, &mut plant)?;
    if panels_have_mass || state.mass.stowed.is_some() || has_thrusters {
        let instant = plant.instant(time_s);
        set_known_mass(state, settings, plant.mass_properties(&instant));
    }
    if panels_have_mass {
        let was_turning = state.panels.is_turning();
        let configuration = plant.path.configuration;
        let end_s = configuration.last_of_panels_s(time_s, state.disturbance.span.end_s);
        let [now, end] = [time_s, end_s].map(|at_s| plant.instant(at_s));
        state.panels.turn_until(plant.path.panel_laws(), &now.moving_sun(), &end.sun());
        if was_turning || state.panels.is_turning() {
            turn_mass(state, settings, flight);
            let internal = state.panels.internal(flight.given.prepared.panels, &state.mass.now, time_s);
            state.motion.reorient(&settings.gyrostat, state.motion.attitude_at(time_s), internal);
        }
    }
    Ok(())
}

/// First and second term of the rate's series at the end of the motion, body frame, in rad/s2 and rad/s3: by what acts there,
/// the disturbances as the interval that ends has them.
fn predicted_rate_terms(
    state: &DynamicState,
    settings: &DynamicsSettings,
    flight: &ConfiguredFlight<'_>,
    body: &BodyMotion,
) -> [Vector3<f64>; 2] {
    // A controller's torque lasts for a sample, and holds the rate.
    if settings.control.is_some() {
        return [Vector3::zeros(); 2];
    }
    let (time_s, rate) = (state.motion.end_s(), &body.rate_body_rad_s);
    let [_, [mut torque, mut slope]] = state.disturbance.total_at(time_s);
    let [now, per_s] = (flight.given.external)(time_s);
    torque += now.torque_body_n_m;
    slope += per_s.torque_body_n_m;
    // A pulse that ends before the interval says little of it.
    let edge_s = flight.thrusters.next_edge_s(&flight.allocator.settings);
    let steady_until_s = edge_s.min(state.dumps.until_s());
    if steady_until_s >= time_s + settings.grid_s {
        let [turn, turn_slope] = flight.thrusters.load.law.torque_body_n_m;
        torque += state.dumps.torque_body_n_m() + turn;
        slope += turn_slope;
    }
    let dipole = state.in_field(&flight.dipoles(time_s)).filter(|_| !state.disturbance.is_before());
    if let Some(dipole) = dipole {
        let [now, per_s] = dipole.torque_with_slope_n_m(&body.attitude, rate);
        torque += now;
        slope += per_s;
    }
    let gyrostat = &settings.gyrostat;
    let motor_n_m = |k: usize| {
        if gyrostat.wheels()[k].locked { 0.0 } else { state.control.wheels.motors[k].torque_n_m }
    };
    let momentum_body = body.attitude.body_from_inertial(&body.momentum_inertial_n_m_s);
    gyrostat.rate_terms(rate, &momentum_body, [torque, slope], &gyrostat.along_axes(motor_n_m))
}

/// The panels go where their laws have them at the end of the motion; the body after that, where they were elsewhere.
fn track_panel_laws(
    state: &mut DynamicState,
    settings: &mut DynamicsSettings,
    plant: &mut Plant<'_>,
) -> Option<BodyMotion> {
    let time_s = state.motion.end_s();
    let to_sun_m = plant.instant(time_s).geometry.to_sun.position_m;
    let kinematics = &plant.path;
    let attitude =
        state.panels.track_law(kinematics.panel_laws(), &mut settings.gyrostat, &state.motion, &to_sun_m)?;
    let panels = kinematics.spacecraft.panels;
    let mass = state.panels.mass_properties(&kinematics.current_mass_panels_stowed, panels, time_s);
    set_known_mass(state, settings, mass);
    let internal = state.panels.internal(panels, &mass, time_s);
    state.motion.reorient(&settings.gyrostat, attitude, internal);
    Some(state.motion.at(&settings.gyrostat, time_s))
}

/// Panels that turn have the body with the mass properties of the end of the motion.
pub(super) fn turn_mass(
    state: &mut DynamicState,
    settings: &mut DynamicsSettings,
    flight: &ConfiguredFlight<'_>,
) {
    if !state.panels.is_turning() {
        return;
    }
    let time_s = state.motion.end_s();
    let loaded = flight.configuration.wet_mass;
    let left = state.mass.stowed.map_or(loaded, |_| flight.used_mass(&loaded, time_s));
    set_mass(state, settings, state.panels.mass_properties(&left, flight.given.prepared.panels, time_s));
}

/// The body has these mass properties from the end of the motion on.
pub(super) fn set_mass(state: &mut DynamicState, settings: &mut DynamicsSettings, mass: MassProperties) {
    state.mass.now = mass;
    settings.set_mass_properties(&mass);
}

fn set_known_mass(state: &mut DynamicState, settings: &mut DynamicsSettings, mass: MassProperties) {
    state.mass.known = mass;
    set_mass(state, settings, mass);
}
