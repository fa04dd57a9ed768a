//! A plan flown again through the FMU, over the range of what may be wrong.

use loader::{Fmu, Value};
use physics::spin::{forecast::Timing, train::Shape};

use super::{PlanError, Row, Task};

/// What the FMU says of a plan.
#[derive(Clone, Copy, Debug, Default)]
pub struct Reflight {
    /// Flights.
    pub flights: u32,
    /// Worst nutation after the last pulse, in rad.
    pub final_rad: f64,
    /// Worst nutation at a communication point, in rad.
    pub peak_rad: f64,
    /// Least and greatest move of the momentum, in rad.
    pub moved_rad: (f64, f64),
}

/// Flies `row` with `ratios` inertia ratios over the task's range, the damper off.
pub fn refly(fmu: &Fmu, task: &Task, row: &Row, thruster: &str, ratios: u32) -> Result<Reflight, PlanError> {
    let mut seen = Reflight { moved_rad: (f64::INFINITY, 0.0), ..Reflight::default() };
    let spin = &task.flight.spin;
    for i in 0..ratios.max(1) {
        let share = if ratios > 1 { 2.0 * f64::from(i) / f64::from(ratios - 1) - 1.0 } else { 0.0 };
        let ratio = spin.ratio + share * task.range.ratio;
        let transverse = spin.inertia_kg_m2 / ratio;
        let (plan, order) = match row.train.shape() {
            Shape::Uniform => (1, 1),
            Shape::Tapered { order } => (2, order as i32),
            Shape::Split => (3, 1),
        };
        let timing = match task.flight.timing {
            Timing::Clock => 1,
            Timing::SunCrossing => 2,
            Timing::TruePhase => 3,
        };
        let mut sets = vec![
            ("inertia[1]".to_owned(), Value::Real(transverse)),
            ("inertia[2]".to_owned(), Value::Real(transverse)),
            ("inertia[3]".to_owned(), Value::Real(spin.inertia_kg_m2)),
            ("spin.initialRate".to_owned(), Value::Real(spin.rate_rad_s)),
            ("damper.timeConstant".to_owned(), Value::Real(0.0)),
            ("burn.plan".to_owned(), Value::Integer(plan)),
            ("burn.taperOrder".to_owned(), Value::Integer(order)),
            ("burn.timing".to_owned(), Value::Integer(timing)),
            ("burn.count".to_owned(), Value::Integer(row.train.count() as i32)),
            ("burn.turnsPerPulse".to_owned(), Value::Real(row.train.turns_per_pulse())),
            ("burn.pulseWidth".to_owned(), Value::Real(row.train.width_s(0))),
        ];
        if !row.train.alternates() {
            sets.push(("burn.group".to_owned(), Value::Text(thruster.to_owned())));
        }
        let names = ["nutation.angle", "momentum.displacement", "burn.done"];
        let record = names
            .iter()
            .map(|name| fmu.position(name).ok_or_else(|| PlanError::Refly(format!("no variable {name}"))))
            .collect::<Result<Vec<_>, _>>()?;
        let stop_s = row.duration_s + 3.0 * spin.period_s();
        let options = loader::Options {
            stop_s: Some(stop_s),
            step_s: Some(spin.period_s() / 4.0),
            sets,
            record: Some(record),
            ..loader::Options::default()
        };
        let flight =
            loader::simulate(fmu, options).map_err(|stopped| PlanError::Refly(stopped.to_string()))?;
        let numbers = |name: &str| {
            let column = flight.recording.column(name).map(loader::Column::numbers);
            column.ok_or_else(|| PlanError::Refly(format!("{name} was not recorded")))
        };
        let (nutation, moved, done) = (numbers(names[0])?, numbers(names[1])?, numbers(names[2])?);
        if done.last() != Some(&1.0) {
            return Err(PlanError::Refly(format!("the burn did not end within {stop_s} s")));
        }
        seen.flights += 1;
        seen.final_rad = seen.final_rad.max(nutation.last().copied().unwrap_or(f64::NAN));
        seen.peak_rad = nutation.iter().copied().fold(seen.peak_rad, f64::max);
        let end = moved.last().copied().unwrap_or(f64::NAN);
        seen.moved_rad = (seen.moved_rad.0.min(end), seen.moved_rad.1.max(end));
    }
    Ok(seen)
}
