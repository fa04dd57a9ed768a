//! From the command in force to the output variables.

use fmi_export::{Real, Values};

use physics::guidance::antenna::Antenna;
use physics::guidance::system::{CommandKind as Kind, GuidanceState, Judgement};

use super::setup::Plan;
use super::variables::choices::{ActiveMode, AntennaSelect};
use crate::common::choices::CommandKind;

/// Writes every output at `time_s`, the epoch there being `epoch_s`.
pub fn write(context: &Plan<'_>, values: &mut Values, state: &GuidanceState, time_s: f64, epoch_s: f64) {
    let v = context.variables;
    let command = state.command();
    let attitude = command.attitude_at(time_s);
    let kind = match command.kind {
        Kind::None => CommandKind::None,
        Kind::Attitude => CommandKind::Attitude,
        Kind::ErrorQuaternion => CommandKind::ErrorQuaternion,
        Kind::RateOnly => CommandKind::RateOnly,
    };
    values.set_choice(v.command.kind, kind);
    values.set_vector(v.command.q, command.quaternion_of(&attitude));
    values.set_vector(v.command.rate, command.rate_body_rad_s.into());
    values.set_vector(v.command.error, command.error);
    values.set_choice(v.mode.active, ActiveMode(state.mode()));
    values.set_real(v.epoch, epoch_s);

    let sun = state.sun_angles_at(&attitude, time_s);
    values.set_real(v.sun.azimuth, sun.azimuth_rad);
    values.set_real(v.sun.elevation, sun.elevation_rad);
    let Judgement { mdis, antenna, antenna_azimuth_rad, .. } = *state.judgement();
    let judged = state.judgement();
    values.set_real(v.mdis.angle, mdis.angle_rad);
    values.set_boolean(v.mdis.in_range, mdis.in_range);
    let select = match antenna {
        Antenna::None => AntennaSelect::None,
        Antenna::Sunshade => AntennaSelect::Sunshade,
        Antenna::Back => AntennaSelect::Back,
    };
    values.set_choice(v.antenna.select, select);
    values.set_real(v.antenna.azimuth, antenna_azimuth_rad);
    values.set_real(v.earth.sun_separation, judged.sun_separation_rad);
    values.set_boolean(v.link.available, judged.link_available);
    values.set_boolean(v.target.reachable, judged.reachable);
    values.set_boolean(v.geometry.degenerate, judged.degenerate);
    values.set_boolean(v.scan.active, judged.scan_active);
    values.set_boolean(v.constraint.sun_keep_in, judged.sun_keep_in);
    values.set_boolean(v.constraint.hot_pole, judged.hot_pole);
    values.set_boolean(v.constraint.clamped, judged.clamped);
}

/// Time derivative of an output at the last communication point.
pub fn derivative(context: &Plan<'_>, state: &GuidanceState, time_s: f64, output: Real) -> Option<f64> {
    let v = context.variables;
    if output == v.epoch {
        return Some(1.0);
    }
    if let Some(index) = v.command.q.index_of(output) {
        return Some(state.command().quaternion_rate_at(time_s)[index]);
    }
    let rates = state.sun_angle_rates_at(time_s);
    [v.sun.azimuth, v.sun.elevation]
        .into_iter()
        .zip(rates)
        .find(|(angle, _)| *angle == output)
        .map(|(_, rate)| rate)
}
