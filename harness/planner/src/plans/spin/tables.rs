//! The planner's tables, no wider than a terminal of 80 columns.

use terminal::Table;

use crate::{
    spin::{LimitCheck, TrainForecast},
    text_table::headed,
};

/// A table whose columns stand one space apart.
pub(super) fn narrow(header: &str) -> Table {
    headed(header).narrow()
}

/// `count` rows of a trade: the best trains, and the uniform plan as the last; `None` for no rows. `keeps` says which keep the
/// limits of the flags and those of the file in `checks`.
pub(super) fn trade(
    rows: &[&TrainForecast],
    uniform: &TrainForecast,
    count: usize,
    checks: &[LimitCheck],
    keeps: impl Fn(&TrainForecast) -> bool,
) -> Option<String> {
    let with_uniform = count > 1;
    let trains = if with_uniform { count - 1 } else { count };
    if trains == 0 {
        return None;
    }
    let mut table =
        narrow("train | n | ms | min | left deg | peak deg | moved | g | saved h | lost h | limits");
    let is_uniform = |row: &TrainForecast| row.train == uniform.train;
    let others: Vec<&TrainForecast> =
        rows.iter().copied().filter(|row| !(with_uniform && is_uniform(row))).collect();
    for row in others.iter().take(trains) {
        table.add_row(cells(row, keeps(row), ""));
    }
    if with_uniform {
        table.add_row(cells(uniform, keeps(uniform), " *"));
    }
    let mut text = table.to_string();
    text.push_str(
        "\ntrain: shape, turns from pulse to pulse; n pulses, the first of so many ms\n\
         left, peak: worst nutation after the last pulse, at any time\n\
         saved, lost: damping time against the uniform plan, time without science",
    );
    let names = checks.iter().filter(|check| check.kept.is_some()).map(|check| check.limit);
    text.push_str("\nlimits: ");
    text.push_str(&names.collect::<Vec<_>>().join(", "));
    if with_uniform {
        text.push_str("\n* the uniform plan: equal pulses of one step, once a turn");
    }
    Some(text)
}

fn cells(row: &TrainForecast, keeps: bool, mark: &str) -> Vec<String> {
    let hours =
        |time_s: f64| if time_s.is_finite() { format!("{:.2}", time_s / 3600.0) } else { "endless".into() };
    vec![
        format!("{}{mark}", row.short_label()),
        row.train.count.to_string(),
        format!("{:.0}", 1e3 * row.train.width_s(0)),
        format!("{:.2}", row.duration_s / 60.0),
        format!("{:.6}", row.final_rad.to_degrees()),
        format!("{:.5}", row.peak_rad.to_degrees()),
        format!("{:.4}", row.moved_rad.to_degrees()),
        format!("{:.2}", 1e3 * row.propellant_kg),
        hours(row.damping_saved_s),
        hours(row.science_lost_s),
        if keeps { "kept".into() } else { "broken".into() },
    ]
}

/// Table of every limit with the plan's value.
pub(super) fn limits(checks: &[LimitCheck]) -> String {
    let mut table = narrow("limit | found | allowed | verdict");
    for one in checks {
        let (least, most) = one.allowed;
        let allowed = if least > 0.0 {
            format!("{} to {} {}", terminal::short(least), terminal::short(most), one.unit)
        } else {
            format!("up to {} {}", terminal::short(most), one.unit)
        };
        let found =
            if one.found.is_finite() { format!("{:.4} {}", one.found, one.unit) } else { "-".to_owned() };
        table.add_row([one.limit.to_owned(), found, allowed, one.verdict()]);
    }
    table.to_string()
}
