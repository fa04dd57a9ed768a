//! Months of antenna pointing as text.

use std::fmt::Write;

use physics::{
    constants::DAY_S,
    spin::{geometry::L1Phases, spinner::Spinner},
};

use super::tables::narrow;
use crate::spin::{PlanError, Task, campaign, longest_interval_s, windows};

/// Longest campaign: ten years.
const MAX_DAYS: f64 = 3653.0;

/// How often to turn over `days`, and what it costs.
pub(super) fn months(spinner: &Spinner, task: &Task, days: f64) -> Result<String, PlanError> {
    if !(days > 0.0 && days <= MAX_DAYS) {
        let allowed = format!("above 0 to {MAX_DAYS} days");
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
    let mut table =
        narrow("every | turns | mean | most | Earth | Sun | kg | turning | lost | uniform | limits");
    for interval_s in intervals {
        let row = campaign(spinner, task, &phases, [duration_s, interval_s], &mut || bar.inc(1))?;
        let deg = |angle: f64| format!("{:.3}", angle.to_degrees());
        let hours = |time_s: f64| format!("{:.1}", time_s / 3600.0);
        table.add_row([
            format!("{:.2} d", interval_s / DAY_S),
            row.count.to_string(),
            deg(row.mean_rad),
            deg(row.largest_rad),
            deg(row.earth_angle_rad),
            deg(row.sun_angle_rad),
            format!("{:.3}", row.propellant_kg),
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
        spinner.limits.earth_angle_deg.0, spinner.limits.sun_angle_deg.0
    );
    let _ = writeln!(text, "{table}");
    let _ = writeln!(
        text,
        "mean, most: sizes of turns; Earth, Sun: greatest angles, all in deg; kg of propellant\n\
         turning, lost: time in turns and without science, uniform: that of the uniform plan, in h"
    );
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
