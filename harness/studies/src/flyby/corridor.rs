//! Paper 003, Figure 4: the corridor of the arrays' offset by distance from the Sun, with the offsets of baseline and plan.

use drawing::{Chart, Panel, Series};
use planner::momentum::{
    baseline::allowed_rad,
    torque::Control,
    windows::{ControlBounds, Window},
};

use super::early::WHOLE_S;
use super::steps::{Step, steps};
use crate::cells::row;
use crate::report::{Outcome, Run};
use crate::verdict::verdict;

const AU_M: f64 = 149_597_870_700.0;
/// Distances of the corridor: from, between, in AU, and how many.
const FROM_AU: f64 = 0.30;
const EVERY_AU: f64 = 0.005;
const COUNT: u32 = 82;
/// Of a schedule every such row is shown: a day's.
const ROWS: usize = 4;

/// Distances in AU with offsets in deg.
type Schedule = Vec<(f64, f64)>;

fn schedule(step: &Step<'_>, of: &dyn Fn(&Window) -> f64) -> Schedule {
    let rows = step.met.flight.rows.iter().step_by(ROWS);
    let at = |time_s: f64| step.windows.iter().rfind(|window| window.start_s <= time_s);
    rows.filter_map(|row| Some((row.to_sun_m.norm() / AU_M, of(at(row.time_s)?).to_degrees()))).collect()
}

/// Figure 4.
pub(crate) fn figure4(run: &mut Run<'_>) -> Outcome {
    let (corridor, schedules) = steps(run, 1, |steps| {
        let corridor = steps.led.leg.layout(WHOLE_S, ControlBounds::default()).corridor;
        let allowed = move |au: f64| allowed_rad(&corridor, au * AU_M).map(|rad| rad.map(f64::to_degrees));
        let offset = |window: &Window| window.controls.get(Control::Offset);
        let last = steps.corrected.last().map_or(&steps.departed, |it| &it.after);
        let schedules = [
            ("baseline", schedule(&steps.led, &|window| window.baseline_rad)),
            ("plan of 17 June 2008", schedule(last, &offset)),
        ];
        Ok((allowed, schedules))
    })?;
    let bounds: Vec<(f64, [f64; 2])> = (0..=COUNT)
        .map(|k| FROM_AU + EVERY_AU * f64::from(k))
        .filter_map(|au| Some((au, corridor(au)?)))
        .collect();
    let margin_deg = |(au, offset_deg): &(f64, f64)| {
        corridor(*au).map_or(f64::NAN, |[least, most]| (offset_deg - least).min(most - offset_deg))
    };
    let summary = |(label, schedule): &(&str, Schedule)| {
        let margin = schedule.iter().map(margin_deg).fold(f64::INFINITY, f64::min);
        let steps = schedule.windows(2).filter(|pair| pair[0].1 != pair[1].1).count();
        let holds = verdict(margin >= 0.0).to_owned();
        vec![(*label).to_owned(), steps.to_string(), format!("{margin:.2}"), holds]
    };
    run.line("Offsets of the arrays from the Sun in their corridor (paper 003, Figure 4)\n");
    let rows: Vec<_> = schedules.iter().map(summary).collect();
    run.table("schedule | changes | least margin [deg] | within the corridor", &rows);
    run.line(
        "The paper prints no number of its corridor. Assumed: 2.0 to 4.2 suns on the cells, cos(offset)/D^2 with D in AU \
         ([articulation] of messenger.toml). Both schedules are of the leg to flyby 2; windmilling is beside them.",
    );
    let bound = |index: usize| bounds.iter().map(|(au, deg)| (*au, deg[index])).collect();
    let mut series =
        vec![Series::dashed("least, thermal", bound(0)), Series::dashed("greatest, power", bound(1))];
    series.extend(schedules.iter().map(|(label, schedule)| {
        let mut points = schedule.clone();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        Series::dots(*label, points)
    }));
    let chart = Chart::new("Offset of the arrays by distance", "distance from the Sun [AU]")
        .with([Panel::new("offset from the Sun [deg]").with(series)]);
    run.picture("figure4.svg", &chart)?;
    let of_bounds = bounds
        .iter()
        .flat_map(|(au, [least, most])| [row!["least", *au, *least], row!["greatest", *au, *most]]);
    let of_schedules = schedules
        .iter()
        .flat_map(|(label, schedule)| schedule.iter().map(|(au, deg)| row![*label, *au, *deg]));
    run.csv("figure4.csv", "what | distance_au | offset_deg", of_bounds.chain(of_schedules))
}
