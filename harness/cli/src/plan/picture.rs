//! A planned burn as a picture: the axis on the celestial sphere, and nutation over time.

use core::f64::consts::{PI, TAU};

use drawing::{Chart, DrawingError, Panel, PlaneChart, PlanePanel, Series};
use nalgebra::Vector3;
use planner::spin::{PlannedBurn, right_ascension_declination_deg};

/// Points of a curve.
const POINTS: u32 = 180;
/// Half the side of the panel that shows the whole sphere, in deg.
const WHOLE_DEG: f64 = 186.0;
/// The close view is so many times the turn's angle wide, and at least so many deg.
const CLOSE: f64 = 0.75;
const LEAST_CLOSE_DEG: f64 = 0.05;

/// The picture as SVG text.
///
/// # Errors
/// Nothing to draw.
pub fn svg(burn: &PlannedBurn) -> Result<String, DrawingError> {
    drawing::svg(&[&sphere(burn), &nutation(burn)])
}

/// An azimuthal equidistant map: every direction at its angle and azimuth from the middle, north up, seen from outside.
struct Map {
    middle: Vector3<f64>,
    east: Vector3<f64>,
    north: Vector3<f64>,
}

impl Map {
    fn about(middle: Vector3<f64>) -> Self {
        let east = Vector3::z().cross(&middle).try_normalize(1e-9).unwrap_or_else(Vector3::y);
        Self { middle, east, north: middle.cross(&east) }
    }

    /// In deg.
    fn place(&self, direction: &Vector3<f64>) -> (f64, f64) {
        let (x, y) = (self.east.dot(direction), self.north.dot(direction));
        let across = x.hypot(y);
        let angle_deg = across.atan2(self.middle.dot(direction)).to_degrees();
        if across > 0.0 { (angle_deg * x / across, angle_deg * y / across) } else { (angle_deg, 0.0) }
    }

    /// A curve; broken where it jumps over the rim, which is one point of the sphere.
    fn curve(&self, points: impl IntoIterator<Item = Vector3<f64>>) -> Vec<(f64, f64)> {
        let mut curve: Vec<(f64, f64)> = Vec::new();
        for (x, y) in points.into_iter().map(|point| self.place(&point)) {
            if curve.last().is_some_and(|last| (last.0 - x).hypot(last.1 - y) > 60.0) {
                curve.push((f64::NAN, f64::NAN));
            }
            curve.push((x, y));
        }
        curve
    }
}

fn shares() -> impl Iterator<Item = f64> {
    (0..=POINTS).map(|k| f64::from(k) / f64::from(POINTS))
}

/// Directions at an angle from one.
fn circle(about: &Vector3<f64>, radius_rad: f64) -> impl Iterator<Item = Vector3<f64>> {
    let map = Map::about(*about);
    shares().map(move |share| {
        let (sine, cosine) = (TAU * share).sin_cos();
        map.middle * radius_rad.cos() + (map.east * cosine + map.north * sine) * radius_rad.sin()
    })
}

/// Meridians and parallels every 30 deg.
fn graticule(map: &Map) -> Vec<(f64, f64)> {
    let mut lines = Vec::new();
    let direction = |right_ascension_rad: f64, declination_rad: f64| {
        let (sine, cosine) = right_ascension_rad.sin_cos();
        Vector3::new(cosine * declination_rad.cos(), sine * declination_rad.cos(), declination_rad.sin())
    };
    let mut add = |points: Vec<Vector3<f64>>| {
        lines.extend(map.curve(points));
        lines.push((f64::NAN, f64::NAN));
    };
    for k in 0..12 {
        let right_ascension_rad = f64::from(k) * PI / 6.0;
        add(shares().map(|share| direction(right_ascension_rad, PI * (share - 0.5))).collect());
    }
    for k in -2..=2 {
        let declination_rad = f64::from(k) * PI / 6.0;
        add(shares().map(|share| direction(TAU * share, declination_rad)).collect());
    }
    lines
}

fn sphere(burn: &PlannedBurn) -> PlaneChart {
    let aim = &burn.task.aim;
    let angle_rad = burn.task.angle_rad;
    let map = Map::about(aim.on_great_circle(0.5 * angle_rad));
    let limit = |name: &str| {
        let judged = burn.judged.iter().find(|judged| judged.limit == name);
        judged.map_or(f64::NAN, |judged| judged.allowed.1)
    };
    let (sun_limit_deg, earth_limit_deg) = (limit("Sun angle"), limit("Earth angle"));
    let axes = std::iter::once(burn.flight.start_axis_inertial)
        .chain(burn.flight.pulses.iter().map(|pulse| pulse.axis_inertial));
    let rhumb: Vec<Vector3<f64>> = shares().filter_map(|share| aim.on_rhumb_line(share)).collect();
    let mut bodies = vec![map.place(&aim.sun_inertial)];
    bodies.extend(aim.earth_inertial.map(|earth| map.place(&earth)));
    let anti_earth = aim.earth_inertial.map(|earth| -earth);
    let series = vec![
        Series::dots("axis after each pulse", axes.map(|axis| map.place(&axis)).collect()),
        Series::line("great circle", map.curve(shares().map(|share| aim.on_great_circle(share * angle_rad)))),
        Series::dashed("rhumb line about the Sun", map.curve(rhumb)),
        Series::line(
            format!("axis {} deg from the Sun", terminal::short(sun_limit_deg)),
            map.curve(circle(&aim.sun_inertial, sun_limit_deg.to_radians())),
        ),
        Series::line(
            anti_earth.map_or_else(String::new, |_| {
                format!("antenna {} deg from the Earth", terminal::short(earth_limit_deg))
            }),
            anti_earth.map_or_else(Vec::new, |axis| map.curve(circle(&axis, earth_limit_deg.to_radians()))),
        ),
        Series::rings("", bodies),
    ];
    let close_deg = (CLOSE * angle_rad.to_degrees()).max(LEAST_CLOSE_DEG);
    let panel = |title: &str, half_width: f64, named: Vec<(&str, Vector3<f64>)>| {
        let above = |direction: Vector3<f64>| {
            let (x, y) = map.place(&direction);
            (x, y + 0.055 * half_width)
        };
        let named = named.into_iter().map(|(name, direction)| (above(direction), name.to_owned()));
        PlanePanel {
            title: title.to_owned(),
            grid: graticule(&map),
            series: series.clone(),
            texts: named.collect(),
            half_width,
            ..PlanePanel::default()
        }
    };
    let mut bodies = vec![("Sun", aim.sun_inertial)];
    bodies.extend(aim.earth_inertial.map(|earth| ("Earth", earth)));
    let ends = [("start", aim.axis_inertial), ("target", aim.target_inertial)];
    let (right_ascension_deg, declination_deg) = right_ascension_declination_deg(&map.middle);
    let whole = panel("the whole sphere", WHOLE_DEG, bodies.clone());
    let near = panel("the turn", close_deg, ends.into_iter().chain(bodies).collect());
    PlaneChart {
        title: format!(
            "{}: spin axis, about right ascension {right_ascension_deg:.2} deg, declination {declination_deg:.2} deg",
            burn.name
        ),
        x_label: "east [deg]".to_owned(),
        y_label: "north [deg]".to_owned(),
        panels: vec![whole, near],
    }
}

fn nutation(burn: &PlannedBurn) -> Chart {
    let samples = &burn.flight.samples;
    let minutes = |time_s: f64| time_s / 60.0;
    let end_min = samples.last().map_or(0.0, |sample| minutes(sample.time_s));
    let last_min = burn.flight.pulses.last().map_or(0.0, |pulse| minutes(pulse.time_s + pulse.on_time_s));
    let level = |label: &str, angle_rad: f64, from_min: f64| {
        let angle_deg = angle_rad.to_degrees();
        Series::dashed(label, vec![(from_min, angle_deg), (end_min, angle_deg)])
    };
    let simulated = samples.iter().map(|sample| (minutes(sample.time_s), sample.nutation_rad.to_degrees()));
    let mut series = vec![
        Series::line("as flown", simulated.collect()),
        level("worst at any time", burn.row.peak_rad, 0.0),
        level("worst after the last pulse", burn.row.final_rad, last_min),
        level("science bears", burn.task.allowed_nutation_rad, 0.0),
    ];
    if burn.task.limits.peak_rad.is_finite() {
        series.push(level("--max-nutation", burn.task.limits.peak_rad, 0.0));
    }
    let highest = series
        .iter()
        .flat_map(|series| &series.points)
        .fold(0.0_f64, |highest, (_, angle_deg)| highest.max(*angle_deg));
    let panel = Panel::new("nutation [deg]").range(0.0, 1.08 * highest.max(1e-9)).with(series);
    Chart::new(String::new(), "time [min]").with([panel])
}
