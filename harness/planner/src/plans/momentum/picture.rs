//! The picture of a plan over its days: |H| planned and simulated under its limit, arrays, tilt, alternation, contacts.

use drawing::{Chart, Panel, Series};
use physics::constants::DAY_S;

use super::steps::shown_deg;
use crate::momentum::{
    controls::Control,
    plan::{MomentumPlan, PlanTask},
    windows::Window,
};

/// All of it, one below the other.
pub(super) fn chart(name: &str, plan: &MomentumPlan, task: &PlanTask) -> Chart {
    let start_s = plan.rows.first().map_or(0.0, |row| row.time_s);
    let day = |time_s: f64| (time_s - start_s) / DAY_S;
    let of_rows = |value: &dyn Fn(&crate::momentum::plan::PlannedRow) -> f64| {
        plan.rows.iter().map(|row| (day(row.time_s), value(row))).collect::<Vec<_>>()
    };
    let end_d = plan.rows.last().map_or(0.0, |row| day(row.time_s));
    let limit = task.limit.momentum_n_m_s;
    let most = plan.greatest_n_m_s().into_iter().fold(limit, f64::max);
    let mut lines = vec![
        Series::curve("planned", of_rows(&|row| row.planned_n_m_s)),
        Series::curve("simulated", of_rows(&|row| row.simulated_n_m_s)),
        Series::dashed("limit", vec![(0.0, limit), (end_d, limit)]),
    ];
    if plan.rows.iter().any(|row| row.allowed_n_m_s < limit) {
        lines.push(Series::dashed("with margin", of_rows(&|row| row.allowed_n_m_s)));
    }
    if !plan.dumps.is_empty() {
        lines.push(Series::dots("dump", plan.dumps.iter().map(|dump| (day(dump.at_s), limit)).collect()));
    }
    let momentum = Panel::new("|H| [N·m·s]").with(lines).range(0.0, 1.08 * most);
    let steps = |label: &str, value: &dyn Fn(&Window) -> f64| {
        let mut points: Vec<(f64, f64)> =
            plan.windows.iter().map(|window| (day(window.start_s), value(window))).collect();
        if let Some(last) = plan.windows.last() {
            points.push((day(last.stop_s), value(last)));
        }
        Series::steps(label, points)
    };
    // As it is simulated.
    let deg = |control: Control| move |window: &Window| shown_deg(window.controls.get(control));
    let around = |controls: &[Control], least_deg: f64| {
        let of = |window: &Window| controls.iter().map(|it| deg(*it)(window).abs()).fold(0.0, f64::max);
        1.08 * plan.windows.iter().map(of).fold(least_deg, f64::max)
    };
    let arrays = Panel::new("offset [deg]").with(vec![steps("offset", &deg(Control::Offset))]);
    let turned_deg = around(&[Control::Windmill], 0.1);
    let windmill = Panel::new("windmill [deg]")
        .with(vec![steps("windmill", &deg(Control::Windmill))])
        .range(-turned_deg, turned_deg);
    let tilted_deg = around(&[Control::Azimuth, Control::Elevation], 0.1);
    let tilt = Panel::new("Sun off -Y [deg]")
        .with(vec![steps("azimuth", &deg(Control::Azimuth)), steps("elevation", &deg(Control::Elevation))])
        .range(-tilted_deg, tilted_deg);
    let contacts = task.layout.contacts_s.iter().flat_map(|[from_s, to_s]| {
        [(day(*from_s), 0.0), (day(*from_s), 1.0), (day(*to_s), 1.0), (day(*to_s), 0.0), (f64::NAN, f64::NAN)]
    });
    let contacts: Vec<(f64, f64)> = contacts.collect();
    let mut shares = vec![steps("alternate share", &|window| window.controls.get(Control::Alternate))];
    if !contacts.is_empty() {
        shares.push(Series::line("contact", contacts));
    }
    let shares = Panel::new("share").with(shares).range(0.0, 1.05);
    let title = format!("{name}: momentum plan");
    Chart::new(title, "day").with([momentum, arrays, windmill, tilt, shares])
}
