//! Outputs of an encounter: the planet, closest approaches to it, and the last prediction.

use fmi_export::Values;
use physics::environment::time;
use physics::plant::Report;

use crate::momentum_plant::variables::motion::{EncounterVariables, PredictionVariables};

/// The encounter's planet and closest approaches to it.
pub(super) fn write(v: &EncounterVariables, values: &mut Values, report: &Report<'_>) {
    let Some(encounter) = report.encounter() else {
        values.set_real(v.last_time, -1.0);
        return;
    };
    values.set_vector(v.position, encounter.body.position_m.into());
    values.set_vector(v.velocity, encounter.body.velocity_m_s.into());
    values.set_real(v.distance, encounter.distance_m);
    let (b_plane, (count, last)) =
        (encounter.b_plane, report.propagator.trajectory.approaches.until(report.time_s));
    values.set_boolean(v.hyperbolic, b_plane.is_some());
    values.set_real(v.b_t, b_plane.map_or(0.0, |it| it.b_t_m));
    values.set_real(v.b_r, b_plane.map_or(0.0, |it| it.b_r_m));
    values.set_real(v.excess_speed, b_plane.map_or(0.0, |it| it.excess_speed_m_s));
    values.set_integer(v.count, count);
    values.set_real(v.last_time, last.map_or(-1.0, |it| it.at_s));
    values.set_real(v.last_altitude, last.map_or(0.0, |it| it.altitude_m));
}

/// The last prediction of the encounter.
pub(super) fn write_prediction(v: &PredictionVariables, values: &mut Values, report: &Report<'_>) {
    let (prediction, arrival) = (report.prediction, report.prediction.and_then(|it| it.arrival));
    let epoch_minus_time_s = report.configuration.epoch_minus_time_s;
    values.set_real(v.since, prediction.map_or(-1.0, |it| it.since_s));
    values.set_boolean(v.valid, arrival.is_some());
    values.set_real(v.arrival, arrival.map_or(-1.0, |it| it.at_s));
    values.set_real(v.altitude, arrival.map_or(0.0, |it| it.altitude_m));
    values.set_real(v.excess_speed, arrival.map_or(0.0, |it| it.b_plane.excess_speed_m_s));
    values.set_real(v.b_t, arrival.map_or(0.0, |it| it.b_plane.b_t_m));
    values.set_real(v.b_r, arrival.map_or(0.0, |it| it.b_plane.b_r_m));
    let epoch_s = arrival.map_or(0.0, |it| time::epoch_at_s(it.osculates_s, epoch_minus_time_s));
    values.set_real(v.epoch, epoch_s);
}
