//! Every sensible train for a task, forecast over the whole range of what may be wrong, and the best of them.

use core::f64::consts::PI;

use physics::spin::{
    forecast::Timing,
    sizing::sized,
    train::{Pulses, Shape, Train},
};

use super::{PlanError, Task};

/// Widths of the outermost pulse that are tried, in steps of the thruster's resolution.
const UNITS: [u32; 9] = [1, 2, 3, 4, 6, 8, 12, 16, 32];

/// One train and what it does.
#[derive(Clone, Debug)]
pub struct TrainForecast {
    /// The train.
    pub train: Train,
    /// Worst nutation after the last pulse, in rad.
    pub final_rad: f64,
    /// Worst nutation at any time, in rad.
    pub peak_rad: f64,
    /// Momentum moved if everything is as assumed, in rad.
    pub moved_rad: f64,
    /// Least and most of it, in rad.
    pub moved_range_rad: (f64, f64),
    /// From first to last edge, in s.
    pub duration_s: f64,
    /// The same for the slowest spin of the range, in s.
    pub longest_s: f64,
    /// In kg.
    pub propellant_kg: f64,
    /// Damping that the uniform plan (equal pulses of one step, once a turn) would need to come down to this one's final
    /// nutation, in s; negative if this one is worse.
    pub damping_saved_s: f64,
    /// Time without science: damping, and the manoeuvre itself where its peak is more than science bears, in s.
    pub science_lost_s: f64,
    /// Whether it keeps the task's limits.
    pub fits: bool,
}

impl TrainForecast {
    /// The same in a few letters, for a table.
    pub fn short_label(&self) -> String {
        let shape = match self.train.shape {
            Shape::Uniform => "uniform".to_owned(),
            Shape::Tapered { order } => format!("taper {order}"),
            Shape::Split => "split".to_owned(),
        };
        format!("{shape} /{}", self.train.turns_per_pulse())
    }

    /// Name of the train, in words.
    pub fn label(&self) -> String {
        let shape = match self.train.shape {
            Shape::Uniform => "uniform".to_owned(),
            Shape::Tapered { order: 1 } => "1 2 2 ... 2 1".to_owned(),
            Shape::Tapered { order: 2 } => "1 3 4 ... 4 3 1".to_owned(),
            Shape::Tapered { order } => format!("binomial of order {order}"),
            Shape::Split => "split, delayed".to_owned(),
        };
        format!("{shape}, every {} turns", self.train.turns_per_pulse())
    }
}

/// All trains for the task, best first: those that keep the limits before those that do not, then by worst final
/// nutation.
///
/// # Errors
/// A thruster too coarse or too weak for the angle.
pub fn trade(task: &Task) -> Result<Vec<TrainForecast>, PlanError> {
    let reference = uniform_plan(task)?;
    let mut rows = Vec::new();
    for turns in [0.5_f64, 1.0, 1.5, 2.0] {
        if !task.actuator.has_opposite && turns.fract() != 0.0 {
            continue;
        }
        for unit in UNITS {
            let shapes = [Shape::Uniform, Shape::Split].into_iter();
            for shape in shapes.chain((1..=4).map(|order| Shape::Tapered { order })) {
                rows.extend(evaluate(task, shape, unit, turns));
            }
        }
    }
    if rows.is_empty() {
        let spin = &task.case.spin;
        return Err(PlanError::Infeasible(format!(
            "--angle is {} deg; no train comes within {} % of it (--angle-tolerance): the shortest pulse of {}, {} ms, moves \
             {:.6} deg",
            task.angle_rad.to_degrees(),
            100.0 * task.angle_tolerance,
            task.actuator.name,
            1e3 * task.resolution_s,
            spin.manoeuvre_rad(task.case.torque_n_m, task.resolution_s).to_degrees(),
        )));
    }
    for row in &mut rows {
        row.damping_saved_s = task.damper_time_constant_s * (reference.final_rad / row.final_rad).ln();
    }
    rows.sort_by(|a, b| (!a.fits).cmp(&!b.fits).then(a.final_rad.total_cmp(&b.final_rad)));
    Ok(rows)
}

/// Returns the rows that no other beats in final nutation, peak and duration at once, in their order.
pub fn frontier(rows: &[TrainForecast]) -> Vec<&TrainForecast> {
    let beats = |a: &TrainForecast, b: &TrainForecast| {
        let no_worse = a.final_rad <= b.final_rad && a.peak_rad <= b.peak_rad && a.duration_s <= b.duration_s;
        no_worse && (a.final_rad < b.final_rad || a.peak_rad < b.peak_rad || a.duration_s < b.duration_s)
    };
    rows.iter().filter(|row| !rows.iter().any(|other| beats(other, row))).collect()
}

/// The train of least worst final nutation that keeps the limits, of a [`trade`].
pub fn best(rows: &[TrainForecast]) -> Result<&TrainForecast, PlanError> {
    let least = |value: fn(&TrainForecast) -> f64| rows.iter().map(value).fold(f64::INFINITY, f64::min);
    rows.iter().find(|row| row.fits).ok_or_else(|| {
        PlanError::Infeasible(format!(
            "no plan keeps the limits: over all plans the least peak nutation is {:.5} deg, the least final nutation {:.6} deg, \
             the shortest time {:.2} min, the least propellant {:.6} kg; widen --max-nutation, --max-final or --max-duration, \
             or see --propellant",
            least(|row| row.peak_rad).to_degrees(),
            least(|row| row.final_rad).to_degrees(),
            least(|row| row.duration_s) / 60.0,
            least(|row| row.propellant_kg),
        ))
    })
}

/// The uniform plan, the paper's: equal pulses of one step, once a turn, as near to the angle as whole pulses come.
///
/// # Errors
/// A step of the thruster that is longer than half a turn, or too weak.
pub fn uniform_plan(task: &Task) -> Result<TrainForecast, PlanError> {
    let (pulse_s, half_turn_s) = (task.resolution_s, 0.5 * task.case.spin.period_s());
    evaluate(&task.with_angle(task.angle_rad), Shape::Uniform, 1, 1.0)
        .map(|row| TrainForecast { fits: row.fits && task.meets_angle(row.moved_rad), ..row })
        .ok_or_else(|| {
            let why = if pulse_s > half_turn_s {
                format!(
                    "its shortest pulse is {pulse_s} s, longer than half a turn ({half_turn_s:.3e} s at --rate): beyond \
                     that a pulse works against itself"
                )
            } else {
                format!("no train of pulses of {pulse_s} s turns by {} deg", task.angle_rad.to_degrees())
            };
            PlanError::Infeasible(format!("--thruster {} has no train: {why}", task.actuator.name))
        })
}

/// One train for the task; `None` where there is none of this kind.
pub fn evaluate(task: &Task, shape: Shape, unit: u32, turns: f64) -> Option<TrainForecast> {
    let spin = &task.case.spin;
    let width_s = f64::from(unit) * task.resolution_s;
    let pulses =
        Pulses { shape, unit_width_s: width_s, turns_per_pulse: turns, resolution_s: task.resolution_s };
    let train = sized(&pulses, &task.case, task.angle_rad).ok()?;
    // A pulse beyond half a turn works against itself.
    if train.widest_s() > 0.5 * spin.period_s() {
        return None;
    }
    let nominal = task.case.forecast(&train);
    if !task.meets_angle(nominal.moved_rad) {
        return None;
    }
    let worst = task.range.worst(&task.case, &train);
    let duration_s = train.duration_s(spin.period_s());
    let longest_s = match task.case.timing {
        Timing::Clock => duration_s,
        // A slow spinner takes longer.
        Timing::SunCrossing | Timing::TruePhase => {
            train.duration_s(2.0 * PI / (spin.rate_rad_s - task.range.rate_rad_s))
        }
    };
    let propellant_kg = train.on_time_s() * task.actuator.flow_kg_s;
    let limits = &task.limits;
    let damping_s = damping_s(task, worst.final_nutation_rad);
    let disturbed = worst.peak_nutation_rad > task.allowed_nutation_rad;
    Some(TrainForecast {
        train,
        final_rad: worst.final_nutation_rad,
        peak_rad: worst.peak_nutation_rad,
        moved_rad: nominal.moved_rad,
        moved_range_rad: (worst.least_moved_rad, worst.most_moved_rad),
        duration_s,
        longest_s,
        propellant_kg,
        damping_saved_s: 0.0,
        science_lost_s: damping_s + if disturbed { duration_s } else { 0.0 },
        fits: worst.peak_nutation_rad <= limits.peak_rad
            && worst.final_nutation_rad <= limits.final_rad
            && longest_s <= limits.duration_s
            && propellant_kg <= task.body.propellant_kg,
    })
}

/// Time the damper takes from `nutation_rad` to what science bears; endless without one.
fn damping_s(task: &Task, nutation_rad: f64) -> f64 {
    let excess = nutation_rad / task.allowed_nutation_rad;
    if excess <= 1.0 {
        0.0
    } else if task.damper_time_constant_s > 0.0 {
        task.damper_time_constant_s * excess.ln()
    } else {
        f64::INFINITY
    }
}

/// Name of a timing.
pub fn timing_label(timing: Timing) -> &'static str {
    match timing {
        Timing::Clock => "clock",
        Timing::SunCrossing => "Sun crossing",
        Timing::TruePhase => "true phase",
    }
}
