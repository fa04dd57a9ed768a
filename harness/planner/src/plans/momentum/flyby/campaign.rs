//! Flights of a plan with dispersed state, centre of mass, sunlight and manoeuvres, on all cores.

use fmi::{Recording, Value};
use inputs::{
    plan::keys::MonteCarlo,
    variables::{elements, numbers, vectors},
};
use isolation::interrupt;
use nalgebra::{Matrix6, Vector3};
use rayon::prelude::*;

use crate::{
    Failure,
    flyby::{
        FlybyTask,
        dispersion::{Dispersions, Draw, Outcome, miss_of},
        report::Campaign,
    },
    momentum::plant::StartValues,
    plans::{flights::SimulatedMission, momentum::planned::Planned},
    simulation::Flight,
};

/// Recorded: B of the hyperbola that osculates now, closest approach, momentum.
const OUTPUTS: [&str; 6] = [
    "encounter.bT",
    "encounter.bR",
    "encounter.count",
    "encounter.lastTime",
    "encounter.lastAltitude",
    "momentum.inertial",
];
/// Rows around the epoch of osculation: how far apart, and how far before and behind, in s. Between two of them B is linear to 5 m.
const FINE_S: f64 = 600.0;
const AROUND_S: f64 = 6.0 * 3600.0;
/// And of the momentum otherwise.
const COARSE_S: f64 = 6.0 * 3600.0;

/// Simulates all runs of a plan's mission.
pub(super) fn simulated(
    mission: &SimulatedMission,
    (table, covariance): (MonteCarlo, Option<Matrix6<f64>>),
    (flyby_task, arrival_s): (&FlybyTask, f64),
    planned: &Planned<'_>,
) -> Result<Campaign, Failure> {
    let spread = Dispersions::new(covariance.as_ref(), table.center_of_mass_m, table.scale)
        .ok_or("covariance: found none that is positive")?;
    let lead_s = flyby_task.force_model.lead_s;
    let times_s = rows_s([mission.start_s, mission.stop_s], arrival_s - lead_s);
    let bar = terminal::progress(table.runs, "runs", planned.options.quiet);
    let of = |run: u64| {
        let draw = spread.draw(table.seed, run);
        let sets = dispersed(&mission.values(), &draw, run);
        let flight = Flight { sets: &sets, outputs: &OUTPUTS, at_s: Some(&times_s), ..Flight::default() };
        let recording = mission.record(&flight);
        bar.inc(1);
        let found = recording.map_err(|error| error.to_string());
        (run, found.and_then(|it| outcome(&it, lead_s, flyby_task.aimpoint.b_m)))
    };
    let found: Vec<(u64, Result<Outcome, String>)> = (1..=table.runs).into_par_iter().map(of).collect();
    bar.finish_and_clear();
    if interrupt::raised() {
        return Err("interrupted".into());
    }
    let mut outcomes = Vec::with_capacity(found.len());
    let mut failed = Vec::new();
    for (run, found) in found {
        match found {
            Ok(outcome) => outcomes.push(outcome),
            Err(why) => failed.push((run, why)),
        }
    }
    let (mean_m, covariance_m2) = miss_of(&outcomes);
    Ok(Campaign { outcomes, failed, mean_m, covariance_m2 })
}

/// Times at which rows are recorded, in s.
fn rows_s([start_s, stop_s]: [f64; 2], epoch_s: f64) -> Vec<f64> {
    let grid = |from_s: f64, to_s: f64, step_s: f64| {
        let (first, last) = ((from_s / step_s).ceil() as i64, (to_s / step_s).floor() as i64);
        (first..=last).map(move |k| k as f64 * step_s)
    };
    let mut all: Vec<f64> = grid(start_s, stop_s, COARSE_S)
        .chain(grid((epoch_s - AROUND_S).max(start_s), (epoch_s + AROUND_S).min(stop_s), FINE_S))
        .chain([start_s, stop_s])
        .collect();
    all.sort_by(f64::total_cmp);
    all.dedup();
    all
}

/// Values of a run.
fn dispersed(values: &StartValues<'_>, draw: &Draw, run: u64) -> Vec<(String, Value)> {
    let moved = |name: &'static str, off: &Vector3<f64>| elements(name, values.vector(name) + off);
    let mut sets: Vec<(String, Value)> = moved("spacecraft.centerOfMass", &draw.center_of_mass_m).collect();
    if values.item("orbit.source") == Some("inputs") {
        sets.extend(moved("orbit.position", &draw.position_m));
        sets.extend(moved("orbit.velocity", &draw.velocity_m_s));
    }
    let scale = (values.real("solar.scale") + draw.scale).max(0.0);
    sets.push(("solar.scale".to_owned(), Value::Real(scale)));
    sets.push(("noise.seed".to_owned(), Value::Integer(i32::try_from(run).unwrap_or(i32::MAX))));
    sets
}

/// Outcome of a flight.
fn outcome(recording: &Recording, lead_s: f64, aimpoint_m: [f64; 2]) -> Result<Outcome, String> {
    let last = |name: &str| -> Result<f64, String> {
        Ok(numbers(recording, name)?.last().copied().unwrap_or(f64::NAN))
    };
    if last(OUTPUTS[2])? < 1.0 {
        return Err("no closest approach".to_owned());
    }
    let arrival_s = last(OUTPUTS[3])?;
    let epoch_s = arrival_s - lead_s;
    let after = recording.times_s.partition_point(|time_s| *time_s <= epoch_s);
    let at = |name: &str| -> Result<f64, String> {
        let values = numbers(recording, name)?;
        let (Some(to_s), Some(from_s)) =
            (recording.times_s.get(after), recording.times_s.get(after.wrapping_sub(1)))
        else {
            return Err("the hyperbola osculates outside of the flight".to_owned());
        };
        let share = (epoch_s - from_s) / (to_s - from_s);
        Ok(values[after - 1] + share * (values[after] - values[after - 1]))
    };
    let momentum_n_m_s = vectors(recording, OUTPUTS[5])?;
    let sizes = momentum_n_m_s.iter().map(Vector3::norm);
    Ok(Outcome {
        miss_m: [at(OUTPUTS[0])? - aimpoint_m[0], at(OUTPUTS[1])? - aimpoint_m[1]],
        arrival_s,
        altitude_m: last(OUTPUTS[4])?,
        momentum_n_m_s: sizes.fold(0.0, f64::max),
    })
}
