//! The planner's answer as text.

use std::path::Path;

use fmi::Fmu;
use physics::{
    constants::{DAY_S, RPM_RAD_S},
    spin::spinner::Spinner,
};

use super::{months::months, tables};
use crate::spin::{
    PlanError, PlannedBurn, Task, TrainForecast, TurnRequest, Verification, Way, best,
    choice::{broken_limits, by_all_limits},
    flight::simulated,
    frontier,
    limit_checks::{broken, check_limits},
    options::ACE,
    right_ascension_declination, start_values, timing_label, trade, uniform_plan, verify,
};

/// Ratios simulated through the FMU.
const RATIOS: u32 = 24;
/// Plans that are simulated before the search is given up.
const MAX_SIMULATED: usize = 5;
/// FMU through which the best plan is simulated unless another is named.
const SHIPPED_FMU: &str = "dist/SpinPlant.fmu";

/// The planner's answer.
#[derive(Clone, Debug)]
pub(crate) struct Answer {
    /// Ready to print.
    pub text: String,
    /// The burn, where one was planned.
    pub burn: Option<PlannedBurn>,
    /// Limits that it breaks, by name.
    pub broken: Vec<&'static str>,
}

/// Plans a turn, or a campaign of them.
///
/// # Errors
/// Options out of range, a spacecraft that cannot be read, limits that no plan keeps, an FMU that does not simulate.
pub(crate) fn plan(request: &TurnRequest) -> Result<Answer, PlanError> {
    let spinner = spacecraft(request)?;
    let task = Task::new(request, &spinner)?;
    match request.campaign_s.map(|it| it / DAY_S) {
        Some(days) => Ok(Answer { text: months(&spinner, &task, days)?, burn: None, broken: Vec::new() }),
        None => one_manoeuvre(request, &spinner, task),
    }
}

fn spacecraft(request: &TurnRequest) -> Result<Spinner, PlanError> {
    let Some(path) = &request.spacecraft else {
        return Spinner::parse("ace.toml", ACE).map_err(|error| PlanError::Refused(error.to_string()));
    };
    let name = path.display().to_string();
    let text = std::fs::read_to_string(path)
        .map_err(|error| PlanError::Refused(format!("cannot read {name}: {error}")))?;
    Spinner::parse(&name, &text).map_err(|error| PlanError::Refused(error.to_string()))
}

fn one_manoeuvre(request: &TurnRequest, spinner: &Spinner, task: Task) -> Result<Answer, PlanError> {
    let rows = trade(&task)?;
    best(&rows)?;
    let candidates = by_all_limits(spinner, &task, &rows, MAX_SIMULATED)?;
    let (chosen, simulations) = simulated_again(request, &task, &candidates)?;
    let flight = simulated(spinner, &task, chosen)?;
    let checks = check_limits(spinner, &task, chosen, &flight);
    let broken = broken(&checks);
    let mut lines = head(&task);
    let uniform = uniform_plan(&task)?;
    let beaten_by_none = frontier(&rows);
    let others = beaten_by_none.iter().copied().filter(|row| row.train != chosen.train);
    let shown: Vec<&TrainForecast> = std::iter::once(chosen).chain(others).collect();
    let keeps = |row: &TrainForecast| {
        row.fits && broken_limits(spinner, &task, row).is_ok_and(|broken| broken.is_empty())
    };
    lines.extend(tables::trade(&shown, &uniform, request.rows, &checks, keeps));
    lines.push(format!(
        "Of {} trains {} are not beaten in final nutation, peak and time at once.",
        rows.len(),
        beaten_by_none.len()
    ));
    lines.push(format!(
        "Least final nutation{}: {}, {} pulses, {:.2} min; moves {:.4} of {:.4} deg ({:+.1} %), peak nutation \
         {:.5} deg ({:.1} times the uniform plan's)",
        if broken.is_empty() { " within the limits" } else { ", with the fewest limits broken" },
        chosen.label(),
        chosen.train.count,
        chosen.duration_s / 60.0,
        chosen.moved_rad.to_degrees(),
        task.angle_rad.to_degrees(),
        100.0 * (chosen.moved_rad / task.angle_rad - 1.0),
        chosen.peak_rad.to_degrees(),
        chosen.peak_rad / uniform.peak_rad,
    ));
    if !broken.is_empty() {
        let broken = broken.join(", ");
        lines.push(format!("No train keeps every limit of the spacecraft's file; this one breaks: {broken}"));
    }
    lines.extend(simulations);
    let (name, row) = (spinner.name.clone(), chosen.clone());
    let burn = PlannedBurn { name, epoch_s: request.date, task, row, flight, checks };
    lines.extend(ways(&burn));
    lines.push(
        "Limits of the spacecraft's file, as simulated, and of the flags, at their worst over the range:"
            .into(),
    );
    lines.push(tables::limits(&burn.checks));
    if request.output.is_none() {
        lines.push(
            "--output FOLDER writes the burn pulse by pulse, the start values as [start], and a picture"
                .into(),
        );
    }
    lines.push(
        "Start values, for `heliotorque run` of the spacecraft's SpinPlant and for `heliotorque pack`:"
            .into(),
    );
    lines.push(start_values::options(&burn.start_values()));
    Ok(Answer { text: lines.join("\n"), burn: Some(burn), broken })
}

/// The turn and what is known of the spacecraft.
fn head(task: &Task) -> Vec<String> {
    let (spin, geometry) = (&task.case.spin, &task.geometry);
    let earth = geometry.earth_inertial.map(|earth| format!(", Earth at {}", place(&earth)));
    vec![
        format!(
            "Turn by {:.4} deg with {} ({:.3} N m), pulses by {}, ratio {:.4} +- {:.4}, {:.3} +- {:.3} rpm",
            task.angle_rad.to_degrees(),
            task.actuator.name,
            task.case.torque_n_m,
            timing_label(task.case.timing),
            spin.ratio,
            task.range.ratio,
            spin.rate_rad_s / RPM_RAD_S,
            task.range.rate_rad_s / RPM_RAD_S,
        ),
        format!(
            "From {} to {}, Sun at {}{}: {}",
            place(&geometry.axis_inertial),
            place(&geometry.target_inertial),
            place(&geometry.sun_inertial),
            earth.unwrap_or_default(),
            geometry.origin,
        ),
        format!(
            "Science bears {:.5} deg of nutation at a Sun angle of {:.4} deg",
            task.allowed_nutation_rad.to_degrees(),
            task.sun_angle_rad.to_degrees(),
        ),
    ]
}

/// The end of the turn as simulated, and the two ways to it.
fn ways(PlannedBurn { task, flight, .. }: &PlannedBurn) -> Vec<String> {
    let great_circle = task.geometry.great_circle();
    vec![
        format!(
            "Simulated pulse by pulse it ends at {}, {:.4} deg from the target, with {:.5} deg of nutation",
            place(&flight.end_axis_inertial()),
            flight.miss_rad(task).to_degrees(),
            flight.samples.last().map_or(f64::NAN, |sample| sample.nutation_rad).to_degrees(),
        ),
        format!("Great circle, as simulated: {}", way(&great_circle)),
        match task.geometry.rhumb_line() {
            Some(rhumb_line) => format!(
                "Rhumb line about the Sun, with one delay after each Sun crossing: {}, {:+.2} % of way and propellant",
                way(&rhumb_line),
                100.0 * (rhumb_line.length_rad / great_circle.length_rad - 1.0),
            ),
            None => "No rhumb line: the Sun stands on the spin axis".to_owned(),
        },
    ]
}

/// Right ascension and declination of a direction.
fn place(direction: &nalgebra::Vector3<f64>) -> String {
    let place = right_ascension_declination(direction);
    format!("{:.4}, {:.4} deg", place.right_ascension_deg, place.declination_deg)
}

fn way(way: &Way) -> String {
    let (least, most) = way.sun_angle_rad;
    let (from, to) = way.heading_rad;
    format!(
        "{:.4} deg, Sun angle {:.3} to {:.3} deg, {} deg from the way to the Sun",
        way.length_rad.to_degrees(),
        least.to_degrees(),
        most.to_degrees(),
        if from == to {
            format!("{:.2}", from.to_degrees())
        } else {
            format!("{:.2} to {:.2}", from.to_degrees(), to.to_degrees())
        },
    )
}

/// The plan to take and what the FMU computes for it: the first that keeps in simulation what it promised, or the first if none
/// is simulated, with the reason.
fn simulated_again<'a>(
    request: &TurnRequest,
    task: &Task,
    rows: &[&'a TrainForecast],
) -> Result<(&'a TrainForecast, Vec<String>), PlanError> {
    let first =
        || rows.first().copied().ok_or_else(|| PlanError::Flight("no train was simulated".to_owned()));
    let not_simulated = |why: String| Ok((first()?, vec![format!("Not re-simulated: {why}")]));
    let named = request.template.as_deref();
    let path = match named {
        Some(path) => path,
        None if request.spacecraft.is_some() => {
            return not_simulated(format!(
                "{SHIPPED_FMU} may be of another spacecraft; give this one's FMU by --template"
            ));
        }
        None => Path::new(SHIPPED_FMU),
    };
    if named.is_none() && !path.exists() {
        return not_simulated(format!(
            "no {SHIPPED_FMU} (cargo xtask dist packs it, --template names another)"
        ));
    }
    let fmu = match Fmu::open(path) {
        Ok(fmu) => fmu,
        Err(error) if named.is_some() => return Err(PlanError::Verify(error.to_string())),
        Err(error) => return not_simulated(error.to_string()),
    };
    let mut lines = Vec::new();
    for row in rows.iter().copied().take(MAX_SIMULATED) {
        let simulated = verify(&fmu, task, row, RATIOS)?;
        let broken = simulated.broken(task);
        if broken.is_empty() {
            lines.push(format!("Re-simulated through {}: {}", path.display(), kept(task, row, &simulated)));
            return Ok((row, lines));
        }
        lines.push(format!("Passed over, as simulated: {}: {}", row.label(), broken.join(", ")));
    }
    Err(PlanError::Infeasible(format!(
        "no plan keeps its limits when it is simulated through the FMU: {}",
        lines.join("\n  ")
    )))
}

/// Text on a simulation that kept all limits, beside the prediction.
fn kept(task: &Task, row: &TrainForecast, simulated: &Verification) -> String {
    let rates =
        if simulated.rates > 1 { format!(" at {} spin rates", simulated.rates) } else { String::new() };
    format!(
        "{} ratios{rates}, worst final {:.6} deg (predicted {:.6}), worst peak {:.5} deg (predicted {:.5}), moved {:.4} to \
         {:.4} deg (predicted {:.4} to {:.4}), at most {:.2} min: {}",
        simulated.ratios,
        simulated.final_rad.to_degrees(),
        row.final_rad.to_degrees(),
        simulated.peak_rad.to_degrees(),
        row.peak_rad.to_degrees(),
        simulated.moved_rad.0.to_degrees(),
        simulated.moved_rad.1.to_degrees(),
        row.moved_range_rad.0.to_degrees(),
        row.moved_range_rad.1.to_degrees(),
        simulated.longest_s / 60.0,
        if task.is_limited() { "the flags' limits kept" } else { "turned as required" },
    )
}
