//! The planner's answer as text.

use std::{fmt::Write, path::Path};

use loader::Fmu;
use physics::spin::{geometry::L1Phases, spinner::Spinner};

use super::options::ACE;
use super::{
    Options, PlanError, Row, Task, Verification, best, campaign, frontier, longest_interval_s, paper_plan,
    timing_label, trade, verify, windows,
};

const DAY_S: f64 = 86_400.0;
/// Ratios simulated through the FMU.
const RATIOS: u32 = 24;
/// Plans that are simulated before the search is given up.
const MOST_SIMULATED: usize = 5;
/// Longest campaign: ten years.
const MOST_DAYS: f64 = 3653.0;
/// What the best plan is simulated through unless another is named.
const SHIPPED_FMU: &str = "dist/SpinPlant.fmu";

/// Plans by the options; the answer, ready to print.
///
/// # Errors
/// Options out of range, a spacecraft that cannot be read, limits that no plan keeps, an FMU that does not simulate.
pub fn plan(options: &Options) -> Result<String, PlanError> {
    let spinner = spacecraft(options)?;
    let task = Task::new(options, &spinner)?;
    match options.campaign {
        Some(days) => months(&spinner, &task, days),
        None => one_manoeuvre(options, &task),
    }
}

fn spacecraft(options: &Options) -> Result<Spinner, PlanError> {
    let setup = |text: String| PlanError::Setup(text);
    let Some(path) = &options.spacecraft else {
        return Spinner::parse("ace.toml", ACE).map_err(|error| setup(error.to_string()));
    };
    let name = path.display().to_string();
    let text =
        std::fs::read_to_string(path).map_err(|error| setup(format!("cannot read {name}: {error}")))?;
    Spinner::parse(&name, &text).map_err(|error| setup(error.to_string()))
}

fn one_manoeuvre(options: &Options, task: &Task) -> Result<String, PlanError> {
    let rows = trade(task)?;
    best(&rows)?;
    let (chosen, simulations) = simulated_again(options, task, &rows)?;
    let mut text = String::new();
    let spin = &task.case.spin;
    let mut line = |line: String| {
        let _ = writeln!(text, "{line}");
    };
    line(format!(
        "Turn by {:.4} deg with {} ({:.3} N m), pulses by {}, ratio {:.4} +- {:.4}, {:.3} +- {:.3} rpm",
        task.angle_rad.to_degrees(),
        options.thruster,
        task.case.torque_n_m,
        timing_label(task.case.timing),
        spin.ratio,
        task.range.ratio,
        options.rate_rpm,
        options.rate_uncertainty_rpm,
    ));
    line(format!(
        "Science bears {:.5} deg of nutation at a Sun angle of {} deg",
        task.allowed_nutation_rad.to_degrees(),
        options.sun_angle_deg
    ));
    let mut table = terminal::table(&[
        "train",
        "pulses",
        "unit",
        "plateau",
        "time",
        "worst final",
        "worst peak",
        "moved",
        "propellant",
        "damping saved",
        "science lost",
        "limits",
    ]);
    let paper = paper_plan(task)?;
    table.add_row(cells(&paper));
    let shown = frontier(&rows);
    for row in shown.iter().take(options.rows.max(1)) {
        table.add_row(cells(row));
    }
    line(table.to_string());
    line(format!(
        "The first row is the paper's plan. Of {} trains {} are not beaten in final nutation, peak and time at once.",
        rows.len(),
        shown.len()
    ));
    line(format!(
        "Least final nutation within the limits: {}, {} pulses, {:.2} min; moves {:.4} of {:.4} deg ({:+.1} %), peak nutation \
         {:.5} deg ({:.1} times the paper's plan's)",
        chosen.label(),
        chosen.train.count(),
        chosen.duration_s / 60.0,
        chosen.moved_rad.to_degrees(),
        task.angle_rad.to_degrees(),
        100.0 * (chosen.moved_rad / task.angle_rad - 1.0),
        chosen.peak_rad.to_degrees(),
        chosen.peak_rad / paper.peak_rad,
    ));
    simulations.into_iter().for_each(line);
    Ok(text)
}

/// The plan to take and what the FMU computes for it: the best that keeps in simulation what it promised, or the best if none is
/// simulated, with the reason.
fn simulated_again<'a>(
    options: &Options,
    task: &Task,
    rows: &'a [Row],
) -> Result<(&'a Row, Vec<String>), PlanError> {
    let not_simulated = |why: String| Ok((best(rows)?, vec![format!("Not re-simulated: {why}")]));
    let named = options.fmu.as_deref();
    let path = match named {
        Some(path) => path,
        None if options.spacecraft.is_some() => {
            return not_simulated(format!(
                "{SHIPPED_FMU} may be of another spacecraft; give this one's FMU by --fmu"
            ));
        }
        None => Path::new(SHIPPED_FMU),
    };
    if named.is_none() && !path.exists() {
        return not_simulated(format!("no {SHIPPED_FMU} (cargo xtask dist packs it, --fmu names another)"));
    }
    let fmu = match Fmu::open(path) {
        Ok(fmu) => fmu,
        Err(error) if named.is_some() => return Err(PlanError::Verify(error.to_string())),
        Err(error) => return not_simulated(error.to_string()),
    };
    let mut lines = Vec::new();
    for row in rows.iter().filter(|row| row.fits).take(MOST_SIMULATED) {
        let simulated = verify(&fmu, task, row, RATIOS)?;
        let broken = simulated.broken(task);
        if broken.is_empty() {
            lines.push(format!("Re-simulated through {}: {}", path.display(), kept(task, row, &simulated)));
            return Ok((row, lines));
        }
        lines.push(format!("Passed over, as simulated: {}: {}", row.label(), broken.join(", ")));
    }
    Err(PlanError::Broken(lines.join("\n  ")))
}

/// What came out of a simulation that kept everything, beside what was foreseen.
fn kept(task: &Task, row: &Row, simulated: &Verification) -> String {
    let rates =
        if simulated.rates > 1 { format!(" at {} spin rates", simulated.rates) } else { String::new() };
    let limits = &task.limits;
    let limited =
        [limits.peak_rad, limits.final_rad, limits.duration_s].iter().any(|limit| limit.is_finite());
    format!(
        "{} ratios{rates}, worst final {:.6} deg (foreseen {:.6}), worst peak {:.5} deg (foreseen {:.5}), moved {:.4} to \
         {:.4} deg (foreseen {:.4} to {:.4}), at most {:.2} min: {}",
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
        if limited { "limits kept" } else { "turned as required, no limits given" },
    )
}

fn cells(row: &Row) -> Vec<String> {
    let hours =
        |time_s: f64| if time_s.is_finite() { format!("{:.2} h", time_s / 3600.0) } else { "endless".into() };
    vec![
        row.label(),
        row.train.count().to_string(),
        format!("{:.0} ms", 1e3 * row.train.width_s(0)),
        format!("{:.0} ms", 1e3 * row.train.plateau_width_s()),
        format!("{:.2} min", row.duration_s / 60.0),
        format!("{:.6} deg", row.final_rad.to_degrees()),
        format!("{:.5} deg", row.peak_rad.to_degrees()),
        format!(
            "{:.4} deg ({:.4} to {:.4})",
            row.moved_rad.to_degrees(),
            row.moved_range_rad.0.to_degrees(),
            row.moved_range_rad.1.to_degrees()
        ),
        format!("{:.2} g", 1e3 * row.propellant_kg),
        hours(row.damping_saved_s),
        hours(row.science_lost_s),
        if row.fits { "kept".into() } else { "broken".into() },
    ]
}

fn months(spinner: &Spinner, task: &Task, days: f64) -> Result<String, PlanError> {
    if !(days > 0.0 && days <= MOST_DAYS) {
        let allowed = format!("above 0 to {MOST_DAYS} days");
        return Err(PlanError::Flag { flag: "--campaign", found: days, allowed });
    }
    let (phases, duration_s) = (L1Phases::default(), days * DAY_S);
    let longest = longest_interval_s(spinner, &phases, duration_s);
    let whole = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0].iter().map(|d| d * DAY_S);
    let mut intervals: Vec<f64> = whole.filter(|interval_s| *interval_s < duration_s).collect();
    intervals.extend(longest);
    intervals.sort_by(f64::total_cmp);
    let turns = intervals.iter().map(|interval_s| u64::from(windows(duration_s, *interval_s)));
    let bar = terminal::progress(turns.sum(), "turns", false);
    let mut table = terminal::table(&[
        "every",
        "turns",
        "mean",
        "largest",
        "Earth angle",
        "Sun angle",
        "propellant",
        "manoeuvring",
        "science lost",
        "lost, uniform",
        "limits",
    ]);
    for interval_s in intervals {
        let row = campaign(spinner, task, &phases, duration_s, interval_s, &mut || bar.inc(1))?;
        let deg = |angle: f64| format!("{:.3} deg", angle.to_degrees());
        let hours = |time_s: f64| format!("{:.1} h", time_s / 3600.0);
        table.add_row([
            format!("{:.2} d", interval_s / DAY_S),
            row.count.to_string(),
            deg(row.mean_rad),
            deg(row.largest_rad),
            deg(row.earth_angle_rad),
            deg(row.sun_angle_rad),
            format!("{:.3} kg", row.propellant_kg),
            hours(row.manoeuvring_s),
            hours(row.science_lost_s),
            hours(row.science_lost_uniform_s),
            if row.holds { "kept".to_owned() } else { "broken".to_owned() },
        ]);
    }
    bar.finish_and_clear();
    let mut text = String::new();
    let _ = writeln!(
        text,
        "Antenna pointing for {days} days: Earth within {} deg, Sun within {} deg; each turn with the train that costs science the least",
        spinner.limits.earth_angle_deg, spinner.limits.sun_angle_deg
    );
    let _ = writeln!(text, "{table}");
    let _ = match longest {
        Some(interval_s) if interval_s >= duration_s => {
            writeln!(text, "No turn is needed: the Earth stays in the deadband for {days} days")
        }
        Some(interval_s) => {
            writeln!(text, "Longest interval that keeps the deadband: {:.2} d", interval_s / DAY_S)
        }
        None => writeln!(text, "No interval keeps the deadband: the Earth leaves it within a tenth of a day"),
    };
    Ok(text)
}
