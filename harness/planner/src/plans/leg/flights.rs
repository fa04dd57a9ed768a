//! Flights of a leg's mission through its FMU, with any velocity at the start.

use fmi::{Recording, Value};
use inputs::variables::elements;
use isolation::interrupt;
use nalgebra::Vector3;
use physics::{
    constants::{DAY_S, GM_SUN_M3_S2},
    environment::{CartesianState, frames::dcm_eme2000_from_ecliptic, orbit::BPlane},
};

use super::super::flights::SimulatedMission;
use crate::{
    Failure,
    leg::{Approach, ApproachRow, SimulatesLeg},
    simulation::Flight,
};

/// Distance of rows about the arrival, in s.
const ROW_S: f64 = 600.0;
/// How long a flight continues behind the arrival, in s.
const BEHIND_S: f64 = 3600.0;
/// Rows of a path, and the time of the first behind its start as a share of the leg.
const PATH_ROWS: u32 = 240;
const PATH: [&str; 2] = ["position", "encounter.position"];
/// Variables recorded at the encounter.
const ENCOUNTER: [&str; 8] = [
    "position",
    "velocity",
    "encounter.position",
    "encounter.velocity",
    "encounter.bT",
    "encounter.bR",
    "encounter.excessSpeed",
    "encounter.hyperbolic",
];
const PASSED: [&str; 3] = ["encounter.count", "encounter.lastTime", "encounter.lastAltitude"];
const PLANET: [&str; 2] = ["planet.gravitationalParameter", "planet.radius"];

/// The mission of a leg, ready to be simulated.
pub(super) struct LegFlights<'a> {
    mission: &'a SimulatedMission,
    /// The planet's name in variables.
    body: &'static str,
    /// Position at the departure, from the Sun, EME2000, m.
    position_m: Vector3<f64>,
    arrival_s: f64,
    /// Before the closest approach, of the hyperbola of B.
    pub lead_s: f64,
    pub mu_m3_s2: f64,
    pub radius_m: f64,
    /// The planet at the arrival, from the Sun, EME2000.
    pub at_arrival: CartesianState,
    /// Reports what is done.
    say: &'a dyn Fn(&str),
}

/// Paths of spacecraft and planet from the Sun, EME2000, in m.
pub(super) struct Paths {
    pub spacecraft_m: Vec<Vector3<f64>>,
    pub planet_m: Vec<Vector3<f64>>,
}

fn vector(recording: &Recording, name: &str, row: usize) -> Vector3<f64> {
    let part = |axis: usize| number(recording, &format!("{name}[{axis}]"), row);
    Vector3::new(part(1), part(2), part(3))
}

fn number(recording: &Recording, name: &str, row: usize) -> f64 {
    recording.column(name).map_or(f64::NAN, |column| column.number(row))
}

impl<'a> LegFlights<'a> {
    /// Simulates the mission once on a circle, which shows where the planet is and what it weighs.
    ///
    /// # Errors
    /// A flight that is refused.
    pub(super) fn begin(
        mission: &'a SimulatedMission,
        body: &'static str,
        (position_m, arrival_s): (Vector3<f64>, f64),
        say: &'a dyn Fn(&str),
    ) -> Result<Self, Failure> {
        let lead_s = mission.values().real("encounter.leadTime");
        let mut flights = Self {
            mission,
            body,
            position_m,
            arrival_s,
            lead_s: if lead_s.is_finite() { lead_s } else { LEAD_S },
            mu_m3_s2: f64::NAN,
            radius_m: f64::NAN,
            at_arrival: CartesianState::default(),
            say,
        };
        let north = dcm_eme2000_from_ecliptic() * Vector3::z();
        let distance_m = position_m.norm();
        let ahead = north.cross(&position_m).try_normalize(0.0).unwrap_or_else(Vector3::x);
        let circular_m_s = ahead * (GM_SUN_M3_S2 / distance_m).sqrt();
        let outputs = [&["encounter.position", "encounter.velocity"], &PLANET[..]].concat();
        let times = (&[arrival_s][..], arrival_s);
        let recording =
            flights.recorded(SimulatedMission::record, &circular_m_s, &outputs, times, Vec::new())?;
        [flights.mu_m3_s2, flights.radius_m] = PLANET.map(|name| number(&recording, name, 0));
        flights.at_arrival = CartesianState {
            position_m: vector(&recording, "encounter.position", 0),
            velocity_m_s: vector(&recording, "encounter.velocity", 0),
        };
        Ok(flights)
    }

    /// Records a flight from a velocity at the start on, by `record` of the mission or `record_until`.
    fn recorded<T>(
        &self,
        record: fn(&SimulatedMission, &Flight<'_>) -> Result<T, Failure>,
        velocity_m_s: &Vector3<f64>,
        outputs: &[&str],
        (at_s, stop_s): (&[f64], f64),
        more: Vec<(String, Value)>,
    ) -> Result<T, Failure> {
        let position = elements("orbit.position", self.position_m);
        let sets: Vec<_> = position.chain(elements("orbit.velocity", *velocity_m_s)).chain(more).collect();
        // Inputs change at the mission's steps alone; without any, a flight does not depend on them.
        let step_s = if self.mission.inputs.is_some() { self.mission.step_s } else { DAY_S };
        let (step_s, at_s, stop_s) = (Some(step_s), Some(at_s), Some(stop_s));
        record(self.mission, &Flight { sets: &sets, outputs, step_s, at_s, stop_s, ..Flight::default() })
    }

    /// Paths from departure to arrival.
    ///
    /// # Errors
    /// A flight that is refused.
    pub(super) fn paths(&self, velocity_m_s: &Vector3<f64>) -> Result<Paths, Failure> {
        let (start_s, length_s) = (self.mission.start_s, self.arrival_s - self.mission.start_s);
        let times_s = (0..=PATH_ROWS).map(|k| start_s + length_s * f64::from(k) / f64::from(PATH_ROWS));
        let times_s: Vec<f64> = times_s.collect();
        let times = (&times_s[..], self.arrival_s);
        let recording = self.recorded(SimulatedMission::record, velocity_m_s, &PATH, times, Vec::new())?;
        let rows = 0..recording.times_s.len();
        let [spacecraft_m, planet_m] =
            PATH.map(|name| rows.clone().map(|row| vector(&recording, name, row)).collect());
        Ok(Paths { spacecraft_m, planet_m })
    }
}

/// Lead time where the FMU has no encounter.leadTime, in s.
const LEAD_S: f64 = 21_600.0;

impl SimulatesLeg for LegFlights<'_> {
    fn unattracted_m(&mut self, velocity_m_s: &Vector3<f64>) -> Result<Vector3<f64>, Failure> {
        let description = self.mission.fmu.description();
        let mut more = fmi::parse_assignment(description, "encounter.body=none")?;
        let attracts = format!("orbit.attraction.{}", self.body);
        if description.variables.iter().any(|it| it.name == attracts) {
            more.push((attracts, Value::Boolean(false)));
        }
        let times = (&[self.arrival_s][..], self.arrival_s);
        let recording = self.recorded(SimulatedMission::record, velocity_m_s, &["position"], times, more)?;
        Ok(vector(&recording, "position", 0))
    }

    fn approach(&mut self, velocity_m_s: &Vector3<f64>) -> Result<Approach, Failure> {
        let first_s = (self.arrival_s - self.lead_s - BEHIND_S).max(self.mission.start_s);
        let stop_s = self.arrival_s + BEHIND_S;
        let count = ((stop_s - first_s) / ROW_S).floor() as u32;
        let mut times_s: Vec<f64> = (0..=count).map(|k| first_s + ROW_S * f64::from(k)).collect();
        times_s.push(stop_s);
        times_s.dedup();
        let outputs = [&ENCOUNTER[..], &PASSED].concat();
        let times = (&times_s[..], stop_s);
        let (recording, error) =
            self.recorded(SimulatedMission::record_until, velocity_m_s, &outputs, times, Vec::new())?;
        let rows = (0..recording.times_s.len()).map(|row| ApproachRow {
            time_s: recording.times_s[row],
            state: CartesianState {
                position_m: vector(&recording, "position", row)
                    - vector(&recording, "encounter.position", row),
                velocity_m_s: vector(&recording, "velocity", row)
                    - vector(&recording, "encounter.velocity", row),
            },
            b_plane: BPlane {
                b_t_m: number(&recording, "encounter.bT", row),
                b_r_m: number(&recording, "encounter.bR", row),
                excess_speed_m_s: number(&recording, "encounter.excessSpeed", row),
            },
        });
        let rows: Vec<ApproachRow> = rows.collect();
        // A flight that ends in the planet says by what it reports before where it would have passed.
        let Some(last) = rows.len().checked_sub(1) else {
            return Err(error.unwrap_or_else(|| "found no row of a flight".to_owned()).into());
        };
        if let Some(row) = (0..=last).find(|row| number(&recording, "encounter.hyperbolic", *row) == 0.0) {
            let after_s = rows[row].time_s;
            return Err(format!("the path about {} is no hyperbola at {after_s} s", self.body).into());
        }
        let [count, time_s, altitude_m] = PASSED.map(|name| number(&recording, name, last));
        // One near the departure may be counted as well.
        let closest = (count > 0.0 && time_s >= first_s).then_some((time_s, altitude_m));
        Ok(Approach { rows, closest, mu_m3_s2: self.mu_m3_s2, radius_m: self.radius_m })
    }

    fn progress(&mut self, doing: &str) {
        if !interrupt::raised() {
            (self.say)(doing);
        }
    }
}
