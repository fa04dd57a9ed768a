//! Flights of a plan with dispersed state, centre of mass, sunlight and manoeuvres, on all cores.

use nalgebra::{Matrix6, Vector3};
use planner::flyby::{
    dispersion::{Dispersions, Draw, Outcome, miss_of},
    report::Campaign,
};
use rayon::prelude::*;

use loader::{Recording, Value};

use crate::{
    interrupt,
    plan::{
        flights::{Failure, Requested, SimulatedMission},
        momentum::{file::encounter::MonteCarlo, flyby_task::FlybyTask, planned::Planned},
    },
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
    let spread =
        Dispersions { state_root: None, center_of_mass_m: table.center_of_mass_m, scale: table.scale };
    let spread = match covariance {
        Some(covariance) => {
            spread.with_state(&covariance).ok_or("covariance: found none that is positive")?
        }
        None => spread,
    };
    let lead_s = flyby_task.force_model.lead_s;
    let times_s = rows_s([mission.start_s, mission.stop_s], arrival_s - lead_s);
    let starts = Starts::of(mission)?;
    let bar = terminal::progress(table.runs as u64, "runs", planned.options.quiet);
    let of = |run: u64| {
        let draw = spread.draw(table.seed, run);
        let sets = starts.dispersed(&draw, run);
        let outputs = OUTPUTS.map(str::to_owned);
        let recording = mission.record(&Requested {
            sets: &sets,
            outputs: &outputs,
            at_s: Some(&times_s),
            ..Requested::default()
        });
        bar.inc(1);
        let found = recording.map_err(|error| error.to_string());
        (run, found.and_then(|it| outcome(&it, lead_s, flyby_task.aimpoint.b_m)))
    };
    let found: Vec<(u64, Result<Outcome, String>)> =
        (1..=table.runs as u64).into_par_iter().map(of).collect();
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

/// Values of the mission that are dispersed.
struct Starts {
    position_m: [f64; 3],
    velocity_m_s: [f64; 3],
    center_of_mass_m: [f64; 3],
    scale: f64,
    is_cartesian: bool,
}

impl Starts {
    fn of(mission: &SimulatedMission) -> Result<Self, Failure> {
        let values = mission.values();
        let vector = |name: &str| -> [f64; 3] { values.vector(name).into() };
        Ok(Self {
            position_m: vector("orbit.position"),
            velocity_m_s: vector("orbit.velocity"),
            center_of_mass_m: vector("spacecraft.centerOfMass"),
            scale: values.real("solar.scale"),
            is_cartesian: values.item("orbit.source") == Some("inputs"),
        })
    }

    fn dispersed(&self, draw: &Draw, run: u64) -> Vec<(String, Value)> {
        let vector = |name: &str, at: [f64; 3], off: &Vector3<f64>| -> Vec<(String, Value)> {
            (0..3).map(|axis| (format!("{name}[{}]", axis + 1), Value::Real(at[axis] + off[axis]))).collect()
        };
        let mut sets = vector("spacecraft.centerOfMass", self.center_of_mass_m, &draw.center_of_mass_m);
        if self.is_cartesian {
            sets.extend(vector("orbit.position", self.position_m, &draw.position_m));
            sets.extend(vector("orbit.velocity", self.velocity_m_s, &draw.velocity_m_s));
        }
        sets.push(("solar.scale".to_owned(), Value::Real((self.scale + draw.scale).max(0.0))));
        sets.push(("noise.seed".to_owned(), Value::Integer(i32::try_from(run).unwrap_or(i32::MAX))));
        sets
    }
}

/// What a flight came to.
fn outcome(recording: &Recording, lead_s: f64, aimpoint_m: [f64; 2]) -> Result<Outcome, String> {
    let column = |name: &str| {
        recording
            .column(name)
            .map(|column| column.numbers())
            .ok_or_else(|| format!("the FMU has no output {name}"))
    };
    let last = |name: &str| -> Result<f64, String> { Ok(column(name)?.last().copied().unwrap_or(f64::NAN)) };
    if last(OUTPUTS[2])? < 1.0 {
        return Err("no closest approach".to_owned());
    }
    let arrival_s = last(OUTPUTS[3])?;
    let epoch_s = arrival_s - lead_s;
    let after = recording.times_s.partition_point(|time_s| *time_s <= epoch_s);
    let at = |name: &str| -> Result<f64, String> {
        let values = column(name)?;
        let (Some(to_s), Some(from_s)) =
            (recording.times_s.get(after), recording.times_s.get(after.wrapping_sub(1)))
        else {
            return Err("the hyperbola osculates outside of the flight".to_owned());
        };
        let share = (epoch_s - from_s) / (to_s - from_s);
        Ok(values[after - 1] + share * (values[after] - values[after - 1]))
    };
    let momentum: Vec<Vec<f64>> =
        (1..=3).map(|axis| column(&format!("{}[{axis}]", OUTPUTS[5]))).collect::<Result<_, _>>()?;
    let sizes = (0..recording.times_s.len())
        .map(|row| momentum.iter().map(|column| column[row].powi(2)).sum::<f64>().sqrt());
    Ok(Outcome {
        miss_m: [at(OUTPUTS[0])? - aimpoint_m[0], at(OUTPUTS[1])? - aimpoint_m[1]],
        arrival_s,
        altitude_m: last(OUTPUTS[4])?,
        momentum_n_m_s: sizes.fold(0.0, f64::max),
    })
}
