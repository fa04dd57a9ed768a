//! State of a flight, saved whole; what parameters and inputs set, and caches, stand apart from it.

use crate::environment::orbit::BPlane;
use serde::{Deserialize, Serialize};

use super::dynamic_state::DynamicState;
use super::ideal_state::IdealState;
use super::propagator_state::PropagatorState;
use crate::plant::thrusters::reaction_control::Thrusters;
use crate::spacecraft::Spacecraft;

/// State of a flight.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct FlightState {
    /// Place, light, air and field, and what events chose and placed.
    pub propagator: PropagatorState,
    /// Thrusters and tanks.
    pub thrusters: Thrusters,
    /// Attitude and momentum.
    pub mode: Mode,
    /// The last prediction of the encounter; none before any.
    pub prediction: Option<EncounterPrediction>,
}

/// Mode of the flight by the source of its attitude, with the state of that mode.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) enum Mode {
    /// Flight that waits for its inputs: no loads, the attitude held.
    Waiting,
    /// Attitude that is followed ideally.
    Ideal(Box<IdealState>),
    /// Attitude by torque.
    Dynamic(Box<DynamicState>),
}

impl FlightState {
    /// Rejects decoded states that no flight of this spacecraft can produce.
    pub(crate) fn is_valid(&self, spacecraft: &Spacecraft) -> bool {
        self.propagator.is_valid(spacecraft)
            && self.prediction.as_ref().is_none_or(EncounterPrediction::is_valid)
            && self.thrusters.is_valid(spacecraft)
            && match &self.mode {
                Mode::Waiting => true,
                Mode::Ideal(ideal) => ideal.is_valid(),
                Mode::Dynamic(dynamics) => dynamics.is_valid(spacecraft),
            }
    }

    /// Names a part of the flight that was not computed at `time_s`, if any.
    pub(crate) fn first_uncovered(&self, time_s: f64) -> Option<&'static str> {
        let PropagatorState { sources, trajectory, air_and_field, .. } = &self.propagator;
        let of_sources = sources.first_uncovered(time_s);
        let (is_covered, what) = match &self.mode {
            _ if of_sources.is_some() => return of_sources,
            _ if !air_and_field.covers(time_s) => (false, "air and magnetic field were computed"),
            _ if !trajectory.covers(time_s) => (false, "the orbit was integrated"),
            Mode::Waiting => (true, ""),
            Mode::Ideal(ideal) => (ideal.integrator.covers(time_s), "the momentum was accumulated"),
            Mode::Dynamic(dynamics) => (dynamics.covers(time_s), "the attitude was computed"),
        };
        (!is_covered).then_some(what)
    }
}

/// A prediction.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct EncounterPrediction {
    /// Time at which the prediction was made, in s.
    pub since_s: f64,
    /// Predicted arrival; `None`: no closest approach before the horizon, or no hyperbola.
    pub arrival: Option<PredictedArrival>,
}

/// The next closest approach.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct PredictedArrival {
    /// When, in s; on a path into the planet where it ends.
    pub at_s: f64,
    /// Height above the planet's radius, in m; 0 on a path into it.
    pub altitude_m: f64,
    /// The hyperbola that osculates at `osculates_s`.
    pub b_plane: BPlane,
    /// So long before the closest approach as is set, or when the prediction was made if that is later, in s.
    pub osculates_s: f64,
}

impl EncounterPrediction {
    /// Whether a simulation can produce it.
    pub(crate) fn is_valid(&self) -> bool {
        self.arrival.is_none_or(|it| it.at_s >= self.since_s && it.osculates_s >= self.since_s)
    }
}
