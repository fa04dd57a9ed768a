//! Limits of a plan, its values, and whether it keeps them.

use physics::{
    attitude::angle_between_rad,
    constants::RPM_RAD_S,
    spin::{nutation::period_variation_s, spinner::Spinner},
};

use super::{Task, TrainForecast, flight::SimulatedPlan};

/// One limit.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
pub struct LimitCheck {
    /// Name of the limited quantity.
    pub limit: &'static str,
    /// The key or flag that gives it.
    pub given_by: &'static str,
    /// Value of the plan, in the unit.
    pub found: f64,
    /// Allowed range, in the unit: at least and at most.
    pub allowed: (f64, f64),
    /// Unit.
    pub unit: &'static str,
    /// Whether it is kept; `None` where that cannot be reported.
    pub kept: Option<bool>,
    /// When it is first broken, in s, or why it is not checked.
    pub remark: String,
}

impl LimitCheck {
    /// In words.
    pub fn verdict(&self) -> String {
        let verdict = match self.kept {
            Some(true) => "kept",
            Some(false) => "BROKEN",
            None => "not checked",
        };
        if self.remark.is_empty() { verdict.to_owned() } else { format!("{verdict}: {}", self.remark) }
    }
}

/// The limits that the spacecraft's file and the flags give, each checked on the flight, and on the worst of the range where
/// the plan knows it.
pub(crate) fn check_limits(
    spinner: &Spinner,
    task: &Task,
    row: &TrainForecast,
    flight: &SimulatedPlan,
) -> Vec<LimitCheck> {
    let (limits, sun, earth) = (&spinner.limits, task.geometry.sun_inertial, task.geometry.earth_inertial);
    let of_earth = over_time(
        flight,
        ("Earth angle", "limits.earth_angle_deg", "deg"),
        (0.0, limits.earth_angle_deg.0),
        |axis, _| earth.map_or(f64::NAN, |earth| angle_between_rad(&-axis, &earth).to_degrees()),
    );
    let mut checks = vec![
        over_time(
            flight,
            ("Sun angle", "limits.sun_angle_deg", "deg"),
            (0.0, limits.sun_angle_deg.0),
            |axis, _| angle_between_rad(axis, &sun).to_degrees(),
        ),
        match earth {
            Some(_) => of_earth,
            None => LimitCheck { kept: None, remark: "no --date, no --earth".to_owned(), ..of_earth },
        },
        over_time(
            flight,
            ("spin rate", "limits.spin_rate_rpm", "rpm"),
            (
                limits.spin_rate_rpm.0 - limits.spin_rate_tolerance_rpm.0,
                limits.spin_rate_rpm.0 + limits.spin_rate_tolerance_rpm.0,
            ),
            |_, sample| sample.spin_rate_rad_s / RPM_RAD_S,
        ),
        over_time(
            flight,
            ("spin period varies", "limits.period_variation_s", "ms"),
            (0.0, 1e3 * limits.period_variation_s.0),
            |axis, sample| {
                let sun_angle_rad = angle_between_rad(axis, &sun);
                1e3 * period_variation_s(sample.nutation_rad, sample.spin_rate_rad_s, sun_angle_rad).abs()
            },
        ),
    ];
    let degrees = |found_rad: f64, most_rad: f64| [found_rad, most_rad].map(f64::to_degrees);
    let given = &task.limits;
    for (limit, given_by, [found, most], unit) in [
        ("worst nutation", "--max-nutation", degrees(row.peak_rad, given.peak_rad), "deg"),
        ("worst nutation left", "--max-final", degrees(row.final_rad, given.final_rad), "deg"),
        ("time", "--max-duration", [row.longest_s / 60.0, given.duration_s / 60.0], "min"),
        ("propellant", "on board", [1e3 * row.propellant_kg, 1e3 * task.body.propellant_kg], "g"),
    ] {
        if most.is_finite() {
            let (allowed, kept, remark) = ((0.0, most), Some(found <= most), String::new());
            checks.push(LimitCheck { limit, given_by, found, allowed, unit, kept, remark });
        }
    }
    checks
}

/// Names of the limits that are broken.
pub(crate) fn broken(checks: &[LimitCheck]) -> Vec<&'static str> {
    checks.iter().filter(|check| check.kept == Some(false)).map(|check| check.limit).collect()
}

/// A limit that holds all the time.
fn over_time(
    flight: &SimulatedPlan,
    (limit, given_by, unit): (&'static str, &'static str, &'static str),
    allowed: (f64, f64),
    value: impl Fn(&nalgebra::Vector3<f64>, &super::flight::SpinSample) -> f64,
) -> LimitCheck {
    // None of these is below 0.
    let least = if allowed.0 > 0.0 { allowed.0 } else { f64::NEG_INFINITY };
    let excess = |found: f64| (found - allowed.1).max(least - found);
    let mut worst = f64::NAN;
    let mut first_s = None;
    let mut last_s = 0.0;
    for sample in &flight.samples {
        let found = value(&sample.spin_axis_inertial, sample);
        if worst.is_nan() || excess(found) > excess(worst) {
            worst = found;
        }
        if excess(found) > 0.0 {
            first_s = first_s.or(Some(sample.time_s));
            last_s = sample.time_s;
        }
    }
    let end_s = flight.samples.last().map_or(0.0, |sample| sample.time_s);
    let remark = match first_s {
        Some(first_s) if last_s >= end_s => format!("from {first_s:.0} s on"),
        Some(first_s) => format!("from {first_s:.0} to {last_s:.0} s"),
        None => String::new(),
    };
    LimitCheck { limit, given_by, found: worst, allowed, unit, kept: Some(first_s.is_none()), remark }
}
