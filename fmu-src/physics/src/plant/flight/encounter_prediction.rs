//! Prediction of the next closest approach to the encounter's planet, and its B-plane.
//!
//! Method: a fork of the flight is propagated, without momentum and dumps, to the closest approach within the sphere of influence, and
//! anew from its last waypoint to the time at which the hyperbola osculates, which is known only then. Where the fork stands in the
//! flight's own attitude it has the flight's own segments, to the bit.

use super::configured::ConfiguredFlight;
use super::fork::Fork;
use crate::environment::orbit::{BPlane, Collision, OrbitIntegrationError};
use crate::loads::ForceTorque;
use crate::momentum::{Totals, WorkKind};
use crate::plant::settings::attitude_source::AttitudeSource;
use crate::plant::settings::configuration::Encounter;
use crate::plant::settings::error::PlantError;
use crate::plant::state::flight_state::{EncounterPrediction, PredictedArrival};

/// Units of work of a prediction beside its orbit.
const UNITS: u32 = 10;

/// Predicts the next encounter from the flight at `time_s` in the attitude of `attitude`, or in the flight's. The Sun stays in
/// the direction that was selected for downlinks.
///
/// # Errors
/// More work than a step may take.
pub(super) fn predict_encounter(
    flight: &mut ConfiguredFlight<'_>,
    attitude: Option<AttitudeSource>,
    time_s: f64,
) -> Result<EncounterPrediction, PlantError> {
    flight.models.spend(WorkKind::Search, UNITS, time_s)?;
    let Some(encounter) = flight.configuration.encounter else {
        return Ok(EncounterPrediction { since_s: time_s, arrival: None });
    };
    let [applied, slope] = (flight.given.external)(time_s);
    let held = |_: f64| [applied, ForceTorque::zero()];
    let is_another = attitude.is_some();
    let mut attitude = attitude.unwrap_or(flight.configuration.attitude);
    if let AttitudeSource::Guided(law) = &mut attitude {
        law.managed = false;
    }
    let mut fork = Fork::new(flight, &held, attitude, Totals::default(), time_s)?;
    if is_another || slope != ForceTorque::zero() {
        fork.cut(time_s);
    }
    match arrival(&mut fork, &encounter, time_s) {
        Err(PlantError::Work(exceeded)) => Err(exceeded.into()),
        // What ends the fork ends the flight where that comes there, if it does.
        other => Ok(EncounterPrediction { since_s: time_s, arrival: other.ok().flatten() }),
    }
}

/// Arrival of a fork that begins at `time_s`.
fn arrival(
    fork: &mut Fork<'_>,
    encounter: &Encounter,
    time_s: f64,
) -> Result<Option<PredictedArrival>, PlantError> {
    let lead_s = encounter.prediction.lead_s;
    let mut now_s = time_s;
    let limit_s = time_s + encounter.prediction.horizon_s;
    let epoch_minus_time_s = fork.ideal.flight.configuration.epoch_minus_time_s;
    let limit_s = limit_s.min(encounter.prediction.last_epoch_s - epoch_minus_time_s);
    let (at_s, altitude_m) = loop {
        if now_s >= limit_s {
            return Ok(None);
        }
        // Where the last one is too late the one before is not.
        fork.checkpoint(now_s, lead_s);
        let advanced = fork.advance_orbit(now_s, limit_s);
        if let Err(PlantError::Orbit(OrbitIntegrationError::Collision(Collision::Impact {
            at_s, name, ..
        }))) = &advanced
            && *name == encounter.body.data().name
        {
            break (*at_s, 0.0);
        }
        now_s = advanced?;
        let approaches = &fork.ideal.flight.propagator.trajectory.approaches;
        if let Some(approach) = approaches.after(time_s).filter(|it| it.at_s <= now_s) {
            break (approach.at_s, approach.altitude_m);
        }
    };
    let osculates_s = (at_s - lead_s).max(time_s);
    let Some(mut now_s) = fork.restore(osculates_s) else { return Ok(None) };
    while now_s < osculates_s {
        now_s = fork.advance_orbit(now_s, osculates_s)?;
    }
    let from_planet = fork.ideal.flight.plant().path.geometry(osculates_s).from_planet();
    let b_plane = from_planet.and_then(|state| BPlane::from_state(&state, encounter.gm_m3_s2));
    Ok(b_plane.map(|b_plane| PredictedArrival { at_s, altitude_m, b_plane, osculates_s }))
}
