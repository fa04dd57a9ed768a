//! From the command in force to the output variables.

use fmi_export::{OutputRates, Real, Values};

use physics::guidance::burn::delta_v::{BurnSettings, BurnState};

use super::inputs::Fixed;
use super::setup::{Guidance, Plan};
use super::state::State;
use super::variables::choices::{ActiveMode, AntennaSelect, EphemerisModel, EphemerisSource, ModeReason};
use crate::common::choices::{CommandKind, ThrustRequest};

/// Value of `thrust.stop` without thrust, in s, and of `timeline.until` without an edge to come.
const NEVER_S: f64 = -1.0;

/// Writes every output at the communication point reached, the epoch there being `epoch_s`.
pub(super) fn write(context: &Plan<'_>, values: &mut Values, state: &State, fixed: &Fixed, epoch_s: f64) {
    let burn = state.burn_settings(context, &fixed.burn);
    let v = context.variables;
    let (State { system: state, dumps, epoch_minus_time_s, .. }, time_s) = (state, state.time_s);
    let command = &state.command;
    let attitude = command.attitude_at(time_s);
    values.set_choice(v.command.kind, CommandKind(command.kind));
    values.set_vector(v.command.q, attitude.unit_quaternion().0);
    values.set_vector(v.command.rate, command.rate_body_rad_s.into());
    values.set_vector(v.command.error, command.error);
    values.set_choice(v.mode.active, ActiveMode(state.modes.mode));
    values.set_choice(v.mode.reason, ModeReason(state.modes.reason));
    values.set_real(v.epoch, epoch_s);
    let slot = context
        .setup
        .timeline
        .as_ref()
        .map(|timeline| timeline.slot(time_s, timeline.clock_minus_time_s(*epoch_minus_time_s)));
    let until_s = slot.map(|slot| slot.until_s).filter(|until_s| until_s.is_finite());
    values.set_real(v.timeline_until, until_s.unwrap_or(NEVER_S));
    values.set_boolean(v.ephemeris.valid, state.modes.ephemeris.is_valid());
    let is_coarse = match values.choice(v.ephemeris.source) {
        EphemerisSource::Chebyshev => state.modes.ephemeris.uses_coarse(state.modes.mode),
        EphemerisSource::Coarse => true,
        _ => false,
    };
    let active = if is_coarse { EphemerisModel::Coarse } else { EphemerisModel::Precise };
    values.set_choice(v.ephemeris.active, active);

    let sun = state.sun_line.angles_at(&attitude, time_s);
    values.set_real(v.sun.azimuth, sun.azimuth_rad);
    values.set_real(v.sun.elevation, sun.elevation_rad);
    let status = &state.status;
    values.set_real(v.gimbal.angle, status.gimbal.angle_rad);
    values.set_boolean(v.gimbal.in_range, status.gimbal.in_range);
    values.set_choice(v.antenna.select, AntennaSelect(status.antenna));
    values.set_real(v.antenna.azimuth, status.antenna_azimuth_rad);
    values.set_real(v.earth.sun_separation, status.sun_separation_rad);
    values.set_boolean(v.link.available, status.link_available);
    values.set_boolean(v.target.reachable, status.reachable);
    values.set_boolean(v.geometry_degenerate, status.degenerate);
    values.set_boolean(v.scan.active, status.scan_active);
    values.set_boolean(v.constraint.sun_keep_in, status.sun_keep_in);
    values.set_boolean(v.constraint.hot_pole, status.hot_pole);
    values.set_boolean(v.constraint.clamped, status.clamped);
    values.set_boolean(v.downlink.active, status.downlink.active);
    values.set_boolean(v.downlink.clamped, status.downlink.clamped);
    self::burn(context, values, &state.burn, &burn);
    for panel in &v.panel {
        values.set_real(panel.sun_offset, values.real(panel.nominal_sun_offset));
    }
    values.set_boolean(v.momentum.target_clamped, state.downlink_sun.is_clamped());
    values.set_boolean(v.dump.request, dumps.is_requested);
    values.set_vector(v.dump.target, dumps.target_body_n_m_s.into());
}

/// Writes what a burn tells the thrusters and what it found.
fn burn(context: &Plan<'_>, values: &mut Values, state: &BurnState, settings: &BurnSettings) {
    let (burn, thrust) = (&context.variables.burn, &context.variables.thrust);
    let thrusters = settings.thrusters.filter(|_| state.is_requested());
    values.set_choice(thrust.request, ThrustRequest(thrusters));
    let stop_s = state.stop_s();
    values.set_boolean(thrust.command, stop_s.is_some());
    values.set_real(thrust.stop, stop_s.unwrap_or(NEVER_S));
    values.set_vector(burn.thrust_estimate, state.thrust_body(settings).into());
    values.set_vector(burn.velocity, state.velocity_m_s.into());
    values.set_vector(burn.velocity_error, state.velocity_error_m_s(settings).into());
    values.set_boolean(burn.timed_out, state.is_missed());
}

impl OutputRates for Guidance {
    /// Time derivative of an output at the last communication point.
    fn output_rate(context: &Plan<'_>, _values: &Values, state: &State, output: Real) -> Option<f64> {
        let (v, State { system, time_s, .. }) = (context.variables, state);
        if output == v.epoch {
            return Some(1.0);
        }
        if let Some(index) = v.command.q.index_of(output) {
            return Some(system.command.quaternion_rate_at(*time_s)[index]);
        }
        let rates = system.sun_line.angle_rates_at(&system.command, *time_s);
        [v.sun.azimuth, v.sun.elevation]
            .into_iter()
            .zip(rates)
            .find(|(angle, _)| *angle == output)
            .map(|(_, rate)| rate)
    }
}
