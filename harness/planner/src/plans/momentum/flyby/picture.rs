//! Pictures of a flyby plan: its B-plane with what can be reached, and the velocity changes that would do the same.

use drawing::{Chart, Panel, PlaneChart, PlanePanel, Series, ellipse};
use physics::constants::DAY_S;

use crate::flyby::{
    aimpoint::b_of_periapsis_m,
    maneuvers,
    report::{Campaign, FlybyReport},
};

/// Deviations of the ellipse that is drawn.
const SIGMAS: f64 = 3.0;

/// The B-plane, in km from the planet's centre; the picture has T to the right and R down, as seen along the asymptote.
pub(crate) fn plane(report: &FlybyReport<'_>) -> PlaneChart {
    let km = |[t_m, r_m]: [f64; 2]| (t_m / 1e3, -r_m / 1e3);
    let task = report.task;
    let aimpoint = task.aimpoint.b_m;
    let place = |miss: &Option<nalgebra::Vector3<f64>>| {
        miss.map(|miss| km([aimpoint[0] + miss.x, aimpoint[1] + miss.y])).into_iter().collect::<Vec<_>>()
    };
    let excess_m_s = report.encounter.plane.excess_speed_m_s;
    let impact_m = b_of_periapsis_m(task.radius_m, task.force_model.gm_m3_s2, excess_m_s);
    let before = report.miss[0].unwrap_or_default();
    let mut reach: Vec<(f64, f64)> = report
        .reach
        .region_m
        .corners
        .iter()
        .map(|[t_m, r_m]| km([aimpoint[0] + before.x + t_m, aimpoint[1] + before.y + r_m]))
        .collect();
    reach.extend(reach.first().copied());
    let circle = |radius_m: f64| ellipse((0.0, 0.0), [radius_m / 1e3; 2], 0.0);
    // Both panels have the same series, because colours are assigned by index.
    let mut series = vec![
        Series::rings("aim", vec![km(aimpoint)]),
        Series::dots("mission as it is", place(&report.miss[0])),
        Series::dots("plan", place(&report.miss[1])),
        Series::line("reach", reach.clone()),
        Series::line("planet", circle(task.radius_m)),
        Series::dashed("impact", circle(impact_m)),
    ];
    if let Some(campaign) = &report.campaign {
        series.push(Series::dashed("three deviations", ring(campaign, aimpoint)));
    }
    let farthest = reach
        .iter()
        .chain(&place(&report.miss[0]))
        .fold(0.0_f64, |far, (x, y)| far.max(x.abs()).max(y.abs()));
    let near = |(x, y): (f64, f64)| (x - km(aimpoint).0).abs().max((y - km(aimpoint).1).abs());
    let close = reach.iter().copied().chain(place(&report.miss[0])).map(near).fold(1.0, f64::max);
    let hours = terminal::short(task.force_model.lead_s / 3600.0);
    let body = task.body();
    let panel = |title: &str, centre: (f64, f64), half_width: f64| PlanePanel {
        title: title.to_owned(),
        series: series.clone(),
        centre,
        half_width: 1.15 * half_width,
        ..PlanePanel::default()
    };
    let whole = panel(body, (0.0, 0.0), farthest.max(impact_m / 1e3));
    let title = format!("B-plane at {body}, hyperbola osculating {hours} h before closest approach");
    let labels = ["B.T [km]", "-B.R [km]"];
    PlaneChart::new(title, labels, vec![whole, panel("about the aim", km(aimpoint), close)])
}

fn ring(campaign: &Campaign, aimpoint_m: [f64; 2]) -> Vec<(f64, f64)> {
    let (axes_m, angle_rad) = maneuvers::ellipse(&campaign.covariance_m2);
    let middle = ((aimpoint_m[0] + campaign.mean_m.x) / 1e3, -(aimpoint_m[1] + campaign.mean_m.y) / 1e3);
    ellipse(middle, axes_m.map(|axis_m| SIGMAS * axis_m / 1e3), -angle_rad)
}

/// Desired velocity changes, where there are any.
pub(crate) fn desired(report: &FlybyReport<'_>) -> Option<Chart> {
    let day = |at_s: f64| (at_s - report.encounter.time_s) / DAY_S;
    let first = report.desired.first()?;
    let of = |value: &dyn Fn(&crate::flyby::sensitivity::DesiredDeltaV) -> f64| {
        report.desired.iter().map(|(at_s, it)| (day(*at_s), value(it))).collect::<Vec<_>>()
    };
    if first.1.size_m_s() == 0.0 {
        return None;
    }
    let size = Panel::new("log10 of m/s")
        .with([Series::curve("desired velocity change", of(&|it| it.size_m_s().log10()))]);
    let angles = Panel::new("direction [deg]").with([
        Series::line("right ascension", of(&|it| it.right_ascension_rad().to_degrees())),
        Series::line("declination", of(&|it| it.declination_rad().to_degrees())),
    ]);
    Some(
        Chart::new("velocity change that would do the same", "day from closest approach")
            .with([size, angles]),
    )
}
