//! Months of antenna pointing: how often to turn, how far, and what it costs.

use nalgebra::Vector3;
use physics::{
    attitude::angle_between_rad,
    constants::DAY_S,
    spin::{geometry::L1Phases, nutation::allowed_nutation_rad, spinner::Spinner, train::Shape},
};

use super::{PlanError, Task, TrainForecast, best, evaluate, uniform_plan};

/// Samples of Sun and Earth between two manoeuvres.
const SAMPLES: u32 = 25;

/// One cadence and what it costs.
#[derive(Clone, Debug, Default)]
pub struct Cadence {
    /// Manoeuvres in the campaign.
    pub count: u32,
    /// Mean and greatest size, in rad.
    pub mean_rad: f64,
    /// See `mean_rad`.
    pub largest_rad: f64,
    /// Greatest angle from the antenna to the Earth, in rad.
    pub earth_angle_rad: f64,
    /// Greatest angle from the spin axis to the Sun, in rad.
    pub sun_angle_rad: f64,
    /// In kg.
    pub propellant_kg: f64,
    /// Time in manoeuvres, each with the train that costs science the least, in s.
    pub manoeuvring_s: f64,
    /// Science lost with those trains, in s.
    pub science_lost_s: f64,
    /// Science lost with the uniform plan, in s.
    pub science_lost_uniform_s: f64,
    /// Whether Earth and Sun stay within their limits.
    pub holds: bool,
}

/// Direction of the antenna between two turns, and how far Earth and Sun stray from it and from the spin axis.
struct Pointing {
    antenna_inertial: Vector3<f64>,
    sun_at_start_inertial: Vector3<f64>,
    earth_angle_rad: f64,
    sun_angle_rad: f64,
}

/// Stretches of `interval_s` that make `duration_s`; the last may be shorter.
pub fn windows(duration_s: f64, interval_s: f64) -> u32 {
    (duration_s / interval_s).ceil().clamp(1.0, 1e6) as u32
}

/// The antenna over the interval from `start_s` to `end_s`.
fn point(spinner: &Spinner, phases: &L1Phases, start_s: f64, end_s: f64) -> Pointing {
    let at = |share: f64| spinner.l1_orbit.sun_earth(phases, start_s + share * (end_s - start_s));
    let (first, last) = (at(0.0), at(1.0));
    // The antenna points midway between where the Earth is at both ends: neither is farther than half the way.
    let antenna = (first.earth_inertial + last.earth_inertial).normalize();
    let samples = (0..=SAMPLES).map(|k| at(f64::from(k) / f64::from(SAMPLES)));
    let [earth_angle_rad, sun_angle_rad] = samples.fold([0.0_f64; 2], |[earth_rad, sun_rad], now| {
        [
            earth_rad.max(angle_between_rad(&antenna, &now.earth_inertial)),
            sun_rad.max(angle_between_rad(&-antenna, &now.sun_inertial)),
        ]
    });
    let sun_at_start_inertial = first.sun_inertial;
    Pointing { antenna_inertial: antenna, sun_at_start_inertial, earth_angle_rad, sun_angle_rad }
}

/// All stretches of a campaign.
fn pointings<'a>(
    spinner: &'a Spinner,
    phases: &'a L1Phases,
    duration_s: f64,
    interval_s: f64,
) -> impl Iterator<Item = Pointing> + 'a {
    (0..windows(duration_s, interval_s)).map(move |window| {
        let start_s = f64::from(window) * interval_s;
        point(spinner, phases, start_s, (start_s + interval_s).min(duration_s))
    })
}

/// Runs the geometry for `duration_s` and turns every `interval_s`, each time with the train of least nutation that keeps the task's
/// limits; `passed` is called for every interval.
///
/// # Errors
/// A turn that no train makes within the limits.
pub fn campaign(
    spinner: &Spinner,
    task: &Task,
    phases: &L1Phases,
    [duration_s, interval_s]: [f64; 2],
    passed: &mut dyn FnMut(),
) -> Result<Cadence, PlanError> {
    let mut seen = Cadence::default();
    let mut before: Option<Vector3<f64>> = None;
    for pointing in pointings(spinner, phases, duration_s, interval_s) {
        passed();
        let antenna = pointing.antenna_inertial;
        seen.earth_angle_rad = seen.earth_angle_rad.max(pointing.earth_angle_rad);
        seen.sun_angle_rad = seen.sun_angle_rad.max(pointing.sun_angle_rad);
        if let Some(before) = before.replace(antenna) {
            let size_rad = angle_between_rad(&before, &antenna);
            let mut sized = task.with_angle(size_rad);
            let sun_angle_rad = angle_between_rad(&-antenna, &pointing.sun_at_start_inertial);
            sized.allowed_nutation_rad = allowed_nutation_rad(
                spinner.limits.period_variation_s.0,
                sized.case.spin.rate_rad_s,
                sun_angle_rad,
            );
            let uniform = uniform_plan(&sized)?;
            let plan = least_nutation(&sized, &uniform)?;
            seen.count += 1;
            seen.mean_rad += size_rad;
            seen.largest_rad = seen.largest_rad.max(size_rad);
            seen.propellant_kg += plan.propellant_kg;
            seen.manoeuvring_s += plan.duration_s;
            seen.science_lost_s += plan.science_lost_s;
            seen.science_lost_uniform_s += uniform.science_lost_s;
        }
    }
    if seen.count > 0 {
        seen.mean_rad /= f64::from(seen.count);
    }
    seen.holds = seen.earth_angle_rad <= spinner.limits.earth_angle_rad()
        && seen.sun_angle_rad <= spinner.limits.sun_angle_rad();
    Ok(seen)
}

/// The train of 32 ms units, once a turn, that keeps the limits and costs science the least; of equals the one that ends
/// the quietest.
fn least_nutation(task: &Task, uniform: &TrainForecast) -> Result<TrainForecast, PlanError> {
    let tapered = (1..=3).filter_map(|order| evaluate(task, Shape::Tapered { order }, 1, 1.0));
    let mut rows: Vec<TrainForecast> = core::iter::once(uniform.clone()).chain(tapered).collect();
    rows.sort_by(|a, b| {
        a.science_lost_s.total_cmp(&b.science_lost_s).then(a.final_rad.total_cmp(&b.final_rad))
    });
    best(&rows).cloned()
}

/// Longest interval, to a hundredth of a day and no longer than `duration_s`, at which the Earth stays in the deadband;
/// `None` if a tenth of a day does not do.
pub fn longest_interval_s(spinner: &Spinner, phases: &L1Phases, duration_s: f64) -> Option<f64> {
    let deadband_rad = spinner.limits.earth_angle_rad();
    let holds = |interval_s: f64| {
        pointings(spinner, phases, duration_s, interval_s).all(|seen| seen.earth_angle_rad <= deadband_rad)
    };
    let (mut low_s, mut high_s) = ((0.1 * DAY_S).min(duration_s), (30.0 * DAY_S).min(duration_s));
    if !holds(low_s) {
        return None;
    }
    if holds(high_s) {
        return Some(high_s);
    }
    while high_s - low_s > 0.01 * DAY_S {
        let middle_s = 0.5 * (low_s + high_s);
        if holds(middle_s) { low_s = middle_s } else { high_s = middle_s }
    }
    Some(low_s)
}
