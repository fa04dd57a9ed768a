//! A plan simulated again through the FMU, over the range of what may be wrong.

use core::f64::consts::FRAC_PI_2;

use fmi::{Column, Fmu, Value};
use model_description::labels;
use physics::spin::{
    forecast::{ForecastCase, Timing},
    nutation::Spin,
};

use super::{
    Firing, PlanError, Task, TrainForecast,
    start_values::{plan_item, timing_item},
};

/// Results of the FMU for a plan.
#[derive(Clone, Copy, Debug)]
pub struct Verification {
    /// Inertia ratios and spin rates; each with each is a simulation.
    pub ratios: u32,
    /// See `ratios`.
    pub rates: u32,
    /// Worst nutation after the last pulse, in rad.
    pub final_rad: f64,
    /// Worst nutation at a communication point, in rad.
    pub peak_rad: f64,
    /// Least and greatest move of the momentum in the plane of the turn, in rad.
    pub moved_rad: (f64, f64),
    /// Longest time from the first edge to the last, in s.
    pub longest_s: f64,
    /// Greatest part by which a move misses what it should be: the task's angle at the assumed spin rate, and off it what
    /// the linear theory foresees, but for a clock that runs wrong, which turns the burn away.
    pub miss: f64,
}

impl Verification {
    /// Returns the limits of `task` that it breaks, in words; empty if it keeps all.
    pub fn broken(&self, task: &Task) -> Vec<String> {
        let mut broken = Vec::new();
        let mut compare = |what: &str, found: f64, limit: f64, unit: &str| {
            if found > limit || found.is_nan() {
                broken.push(format!("{what} {found:.6} {unit} beyond {limit:.6} {unit}"));
            }
        };
        let limits = &task.limits;
        compare("peak nutation", self.peak_rad.to_degrees(), limits.peak_rad.to_degrees(), "deg");
        compare("final nutation", self.final_rad.to_degrees(), limits.final_rad.to_degrees(), "deg");
        compare("time", self.longest_s / 60.0, limits.duration_s / 60.0, "min");
        compare("the move misses by", 100.0 * self.miss, 100.0 * task.angle_tolerance, "%");
        broken
    }
}

/// One simulation.
struct Simulated {
    final_rad: f64,
    peak_rad: f64,
    moved_rad: f64,
    duration_s: f64,
}

/// Runs `row` with `ratios` inertia ratios over the task's range, each at the assumed spin rate and at the ends of its
/// range, the damper off.
///
/// # Errors
/// An FMU that refuses the simulation, has other thrusters, or does not end the burn.
pub fn verify(fmu: &Fmu, task: &Task, row: &TrainForecast, ratios: u32) -> Result<Verification, PlanError> {
    let ratios = ratios.max(1);
    let rates: &[f64] = if task.range.rate_rad_s > 0.0 { &[-1.0, 0.0, 1.0] } else { &[0.0] };
    let mut seen = Verification {
        ratios,
        rates: rates.len() as u32,
        final_rad: 0.0,
        peak_rad: 0.0,
        moved_rad: (f64::INFINITY, 0.0),
        longest_s: 0.0,
        miss: 0.0,
    };
    let assumed = &task.case.spin;
    for &rate_share in rates {
        for i in 0..ratios {
            let share = if ratios > 1 { 2.0 * f64::from(i) / f64::from(ratios - 1) - 1.0 } else { 0.0 };
            let spin = Spin {
                rate_rad_s: assumed.rate_rad_s + rate_share * task.range.rate_rad_s,
                ratio: assumed.ratio + share * task.range.ratio,
                ..*assumed
            };
            let simulated = simulate(fmu, task, row, &spin)?;
            seen.final_rad = seen.final_rad.max(simulated.final_rad);
            seen.peak_rad = seen.peak_rad.max(simulated.peak_rad);
            seen.moved_rad =
                (seen.moved_rad.0.min(simulated.moved_rad), seen.moved_rad.1.max(simulated.moved_rad));
            seen.longest_s = seen.longest_s.max(simulated.duration_s);
            let meant_rad = if rate_share == 0.0 {
                task.angle_rad
            } else if task.case.timing == Timing::Clock {
                continue;
            } else {
                ForecastCase { spin, ..task.case }.forecast(&row.train).moved_rad
            };
            seen.miss = seen.miss.max((simulated.moved_rad / meant_rad - 1.0).abs());
        }
    }
    Ok(seen)
}

/// Runs `row` once with the body `spin`; the burn is timed by what the task assumes.
fn simulate(fmu: &Fmu, task: &Task, row: &TrainForecast, spin: &Spin) -> Result<Simulated, PlanError> {
    let stop_s = row.train.duration_s(spin.period_s()) + 4.0 * spin.period_s();
    let names = [
        "nutation.angle",
        "momentum.inertial[1]",
        "burn.done",
        "burn.pulsesFired",
        "burn.nextEdge",
        "torque.thruster[1]",
        "torque.thruster[2]",
        "momentum.inertial[3]",
    ];
    let record = names
        .iter()
        .map(|name| fmu.position(name).ok_or_else(|| failed(format_args!("no variable {name}"))))
        .collect::<Result<Vec<_>, _>>()?;
    let options = fmi::Options {
        stop_s: Some(stop_s),
        step_s: Some(spin.period_s() / 4.0),
        sets: sets(fmu, task, row, spin)?,
        record: Some(record),
        ..fmi::Options::default()
    };
    let simulation = fmi::simulate(fmu, options).map_err(failed)?;
    let numbers = |name: &str| {
        let column = simulation.recording.column(name).map(Column::numbers);
        column.ok_or_else(|| failed(format_args!("{name} was not recorded")))
    };
    let columns = names.iter().map(|name| numbers(name)).collect::<Result<Vec<_>, _>>()?;
    let last = |column: usize| columns[column].last().copied().unwrap_or(f64::NAN);
    if last(2) != 1.0 {
        return Err(failed(format_args!("the burn did not end within {stop_s} s")));
    }
    // The edges are read where the first and the last pulse are still to come, or on.
    let count = row.train.count;
    let (mut first_s, mut last_s) = (f64::NAN, f64::NAN);
    for (i, &edge_s) in columns[4].iter().enumerate().filter(|(_, edge_s)| **edge_s >= 0.0) {
        let firing = columns[5][i] != 0.0 || columns[6][i] != 0.0;
        if columns[3][i] == 0.0 {
            first_s = if firing { edge_s - row.train.width_s(0) } else { edge_s };
        }
        if columns[3][i] == f64::from(count - 1) {
            last_s = if firing { edge_s } else { edge_s + row.train.width_s(count - 1) };
        }
    }
    Ok(Simulated {
        final_rad: last(0),
        peak_rad: columns[0].iter().copied().fold(0.0, f64::max),
        // Within the plane of the turn, as it is predicted: a clock that runs wrong also moves it aside.
        moved_rad: last(1).atan2(last(7)),
        duration_s: last_s - first_s,
    })
}

/// Everything the simulation depends on, whatever the FMU's own start values are: the momentum starts along +Z and turns toward
/// +X, the Sun stands across that plane.
fn sets(fmu: &Fmu, task: &Task, row: &TrainForecast, spin: &Spin) -> Result<Vec<(String, Value)>, PlanError> {
    let (plan, order) = plan_item(row.train.shape);
    let (assumed, transverse) = (&task.case.spin, spin.inertia_kg_m2 / spin.ratio);
    let real = |name: &str, value: f64| (name.to_owned(), Value::Real(value));
    let integer = |name: &str, value: i32| (name.to_owned(), Value::Integer(value));
    let text = |name: &str, value: &str| (name.to_owned(), Value::Text(value.to_owned()));
    let mut sets = vec![
        real("spin.initialRate", spin.rate_rad_s),
        real("start.nutation", 0.0),
        real("damper.timeConstant", 0.0),
        real("propellant.loaded", task.body.propellant_kg),
        real("pulse.resolution", task.resolution_s),
        real("burn.start", 0.0),
        real("burn.angle", 0.0),
        real("burn.maxNutation", 0.0),
        real("burn.maxDuration", 0.0),
        real("burn.spinRateError", assumed.rate_rad_s / spin.rate_rad_s - 1.0),
        real("burn.ratioError", assumed.ratio / spin.ratio - 1.0),
        real("burn.turnsPerPulse", row.train.turns_per_pulse()),
        real("burn.pulseWidth", row.train.width_s(0)),
        integer("massProperties.source", 1),
        integer("geometry.source", 1),
        text("burn.plan", plan),
        integer("burn.taperOrder", order.unwrap_or(1) as i32),
        text("burn.timing", timing_item(task.case.timing)),
        integer("burn.count", row.train.count as i32),
    ];
    // A burn goes no farther than its target, and steers best with the target well away: it stands as far beyond the end of
    // the turn as the turn's beginning is from its opposite.
    let beyond = FRAC_PI_2 + 0.5 * task.angle_rad;
    for (name, vector) in [
        ("inertia", [transverse, transverse, spin.inertia_kg_m2]),
        ("burn.targetDirection", [beyond.sin(), 0.0, beyond.cos()]),
        ("sun.direction", [0.0, task.sun_angle_rad.sin(), task.sun_angle_rad.cos()]),
    ] {
        sets.extend((1..).zip(vector).map(|(axis, value)| real(&format!("{name}[{axis}]"), value)));
    }
    sets.extend((1..).zip([0.0, 0.0, 0.0, 1.0]).map(|(i, value)| real(&format!("start.q[{i}]"), value)));
    match &task.actuator.firing {
        Firing::Group(name) => sets.push(text("burn.group", name)),
        Firing::Thruster { number, opposite } => {
            check_name(fmu, task, *number)?;
            sets.push(text("burn.group", ""));
            sets.push(integer("burn.thruster", *number));
            sets.push(integer("burn.oppositeThruster", opposite.unwrap_or(0)));
        }
    }
    Ok(sets)
}

fn failed(error: impl core::fmt::Display) -> PlanError {
    PlanError::Verify(error.to_string())
}

/// The FMU's thruster of that number must be the one the plan is for.
fn check_name(fmu: &Fmu, task: &Task, number: i32) -> Result<(), PlanError> {
    let thruster = format!("thruster[{number}]");
    let found = match labels::of_groups(fmu.description()).get(thruster.as_str()) {
        Some(name) if *name == task.actuator.name => return Ok(()),
        Some(name) => format!("\"{name}\""),
        None => "missing".to_owned(),
    };
    Err(failed(format_args!(
        "its {thruster} is {found}, the plan is for \"{}\": it was packed for another spacecraft",
        task.actuator.name
    )))
}
