//! The picture of a leg: its path in the ecliptic, and the B-plane.

use core::f64::consts::TAU;

use drawing::{DrawingError, PlaneChart, PlanePanel, Series};
use nalgebra::Vector3;
use physics::{constants::ASTRONOMICAL_UNIT_M, environment::frames::dcm_eme2000_from_ecliptic};

use super::flights::Paths;
use crate::leg::{Leg, LegTask, impact_parameter_m};

/// Points of a circle.
const POINTS: u32 = 180;

/// As SVG text; `body` is the planet's name, `name` the spacecraft's.
///
/// # Errors
/// Nothing to draw.
pub(super) fn svg(
    [name, body]: [&str; 2],
    (task, leg): (&LegTask, &Leg),
    paths: &Paths,
) -> Result<String, DrawingError> {
    drawing::svg(&[&ecliptic(name, body, paths), &b_plane(body, task, leg)])
}

fn circle(radius: f64) -> Vec<(f64, f64)> {
    let angles = (0..=POINTS).map(|k| TAU * f64::from(k) / f64::from(POINTS));
    angles.map(|angle_rad| (radius * angle_rad.cos(), radius * angle_rad.sin())).collect()
}

fn ecliptic(name: &str, body: &str, paths: &Paths) -> PlaneChart {
    let ecliptic_from_eme2000 = dcm_eme2000_from_ecliptic().transpose();
    let place = |position_m: &Vector3<f64>| {
        let position = ecliptic_from_eme2000 * position_m / ASTRONOMICAL_UNIT_M;
        (position.x, position.y)
    };
    let curve = |path: &[Vector3<f64>]| -> Vec<(f64, f64)> { path.iter().map(place).collect() };
    let (spacecraft, planet) = (curve(&paths.spacecraft_m), curve(&paths.planet_m));
    let farthest = spacecraft.iter().chain(&planet).map(|(x, y)| x.hypot(*y)).fold(0.0, f64::max);
    let ends = |path: &[(f64, f64)]| -> Vec<(f64, f64)> {
        path.first().into_iter().chain(path.last()).copied().collect()
    };
    let mut names = vec![((0.0, 0.0), "Sun".to_owned())];
    names.extend(ends(&spacecraft).into_iter().zip(["departure", "arrival"].map(str::to_owned)));
    let panel = PlanePanel {
        title: "in the ecliptic of J2000".to_owned(),
        series: vec![
            Series::line(name, spacecraft.clone()),
            Series::line(body, planet),
            Series::dots("", ends(&spacecraft)),
            Series::rings("", vec![(0.0, 0.0)]),
        ],
        names,
        half_width: 1.1 * farthest,
        ..PlanePanel::default()
    };
    PlaneChart::new(format!("{name}: leg to {body}"), ["x [AU]", "y [AU]"], vec![panel])
}

fn b_plane(body: &str, task: &LegTask, leg: &Leg) -> PlaneChart {
    let km = |length_m: f64| 1e-3 * length_m;
    let found = &leg.encounter;
    let impact_m = impact_parameter_m(task.radius_m, found.excess_speed_m_s, task.mu_m3_s2);
    let aimpoint = (km(found.b_m.x - leg.miss_m[0]), km(found.b_m.y - leg.miss_m[1]));
    let simulated = (km(found.b_m.x), km(found.b_m.y));
    let hours = terminal::short(task.lead_s / 3600.0);
    let panel = PlanePanel {
        title: format!("B-plane, {hours} h before the closest approach"),
        areas: vec![circle(km(task.radius_m))],
        series: vec![
            Series::line(body, circle(km(task.radius_m))),
            Series::dashed("paths within end in it", circle(km(impact_m))),
            Series::rings("aim", vec![aimpoint]),
            Series::dots("simulated", vec![simulated]),
        ],
        half_width: 1.3 * km(impact_m.max(found.b_m.norm())),
        ..PlanePanel::default()
    };
    PlaneChart::new("", ["B·T [km]", "B·R [km]"], vec![panel])
}
