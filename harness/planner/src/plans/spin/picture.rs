//! A planned burn as a picture: the axis on the celestial sphere, and nutation over time.

use core::f64::consts::{PI, TAU};

use drawing::{Chart, DrawingError, Panel, PlaneChart, PlanePanel, Series};
use nalgebra::Vector3;

use crate::spin::{PlannedBurn, right_ascension_declination};

/// Points of a curve.
const POINTS: u32 = 180;
/// Half the side of the panel that shows the whole sphere, in deg.
const WHOLE_DEG: f64 = 186.0;
/// Neighbours on a curve are no farther apart on the map, in deg, unless they are nearer than this on the sphere, in rad: there the
/// curve goes through the rim.
const FAR_DEG: f64 = 8.0;
const THROUGH_RAD: f64 = 1e-3;
/// Width of the close view in angles of the turn, and at least, in deg.
const CLOSE: f64 = 0.75;
const MIN_CLOSE_DEG: f64 = 0.05;

/// The picture as SVG text.
///
/// # Errors
/// Nothing to draw.
pub(super) fn svg(burn: &PlannedBurn) -> Result<String, DrawingError> {
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

    /// A curve, so fine that it follows the rim, which is one point of the sphere; it ends there and begins anew across it where it
    /// goes through that point.
    fn curve(&self, points: impl IntoIterator<Item = Vector3<f64>>) -> Vec<(f64, f64)> {
        let mut curve: Vec<(f64, f64)> = Vec::new();
        let mut before: Option<Vector3<f64>> = None;
        for point in points {
            if let Some(before) = before {
                self.between(&mut curve, &before, &point);
            }
            curve.push(self.place(&point));
            before = Some(point);
        }
        curve
    }

    /// Points between two neighbours of a curve, until none is far from the next.
    fn between(&self, curve: &mut Vec<(f64, f64)>, from: &Vector3<f64>, to: &Vector3<f64>) {
        let (from_place, to_place) = (self.place(from), self.place(to));
        if (from_place.0 - to_place.0).hypot(from_place.1 - to_place.1) <= FAR_DEG {
            return;
        }
        if (from - to).norm() < THROUGH_RAD {
            curve.extend([self.on_rim(from), (f64::NAN, f64::NAN), self.on_rim(to)]);
            return;
        }
        let middle = (from + to).normalize();
        self.between(curve, from, &middle);
        curve.push(self.place(&middle));
        self.between(curve, &middle, to);
    }

    /// Point at which a direction near the rim meets it.
    fn on_rim(&self, direction: &Vector3<f64>) -> (f64, f64) {
        let (x, y) = (self.east.dot(direction), self.north.dot(direction));
        let scale = 180.0 / x.hypot(y).max(f64::MIN_POSITIVE);
        (x * scale, y * scale)
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
    let rim = shares().map(|share| (TAU * share).sin_cos());
    let mut lines: Vec<_> = rim.map(|(sine, cosine)| (180.0 * cosine, 180.0 * sine)).collect();
    lines.push((f64::NAN, f64::NAN));
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
    let geometry = &burn.task.geometry;
    let angle_rad = burn.task.angle_rad;
    let map = Map::about(geometry.on_great_circle(0.5 * angle_rad));
    let limit = |name: &str| {
        let check = burn.checks.iter().find(|check| check.limit == name);
        check.map_or(f64::NAN, |check| check.allowed.1)
    };
    let (sun_limit_deg, earth_limit_deg) = (limit("Sun angle"), limit("Earth angle"));
    let axes = std::iter::once(burn.flight.start_axis_inertial)
        .chain(burn.flight.pulses.iter().map(|pulse| pulse.axis_inertial));
    let rhumb: Vec<Vector3<f64>> = shares().filter_map(|share| geometry.on_rhumb_line(share)).collect();
    let mut bodies = vec![map.place(&geometry.sun_inertial)];
    bodies.extend(geometry.earth_inertial.map(|earth| map.place(&earth)));
    let anti_earth = geometry.earth_inertial.map(|earth| -earth);
    let series = vec![
        Series::dots("axis after each pulse", axes.map(|axis| map.place(&axis)).collect()),
        Series::line(
            "great circle",
            map.curve(shares().map(|share| geometry.on_great_circle(share * angle_rad))),
        ),
        Series::dashed("rhumb line about the Sun", map.curve(rhumb)),
        Series::line(
            format!("axis {} deg from the Sun", terminal::short(sun_limit_deg)),
            map.curve(circle(&geometry.sun_inertial, sun_limit_deg.to_radians())),
        ),
        Series::line(
            anti_earth.map_or_else(String::new, |_| {
                format!("antenna {} deg from the Earth", terminal::short(earth_limit_deg))
            }),
            anti_earth.map_or_else(Vec::new, |axis| map.curve(circle(&axis, earth_limit_deg.to_radians()))),
        ),
        Series::rings("", bodies),
    ];
    let close_deg = (CLOSE * angle_rad.to_degrees()).max(MIN_CLOSE_DEG);
    let panel = |title: &str, half_width: f64, named: Vec<(&str, Vector3<f64>)>| {
        let named = named.into_iter().map(|(name, direction)| (map.place(&direction), name.to_owned()));
        PlanePanel {
            title: title.to_owned(),
            grid: graticule(&map),
            series: series.clone(),
            names: named.collect(),
            half_width,
            ..PlanePanel::default()
        }
    };
    let mut bodies = vec![("Sun", geometry.sun_inertial)];
    bodies.extend(geometry.earth_inertial.map(|earth| ("Earth", earth)));
    let ends = [("start", geometry.axis_inertial), ("target", geometry.target_inertial)];
    let middle = right_ascension_declination(&map.middle);
    let whole = panel("the whole sphere", WHOLE_DEG, bodies.clone());
    let near = panel("the turn", close_deg, ends.into_iter().chain(bodies).collect());
    let title = format!(
        "{}: spin axis, about right ascension {:.2} deg, declination {:.2} deg",
        burn.name, middle.right_ascension_deg, middle.declination_deg
    );
    PlaneChart::new(title, ["east [deg]", "north [deg]"], vec![whole, near])
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
        Series::line("simulated", simulated.collect()),
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

#[cfg(test)]
mod tests {
    //! Curves reach the rim of the map and follow it.
    use super::*;

    #[test]
    fn a_curve_has_no_gap_before_the_rim() {
        let map = Map::about(Vector3::new(0.3, -0.5, 0.8).normalize());
        // A great circle through the middle's antipode, one past it by a deg, and one far from it.
        for off_deg in [0.0, 1.0, 40.0_f64] {
            let (sine, cosine) = off_deg.to_radians().sin_cos();
            let pole = map.east * cosine + map.middle * sine;
            let circle = Map::about(pole);
            let points = shares().map(|share| {
                let (sine, cosine) = (TAU * share + 0.1).sin_cos();
                circle.east * cosine + circle.north * sine
            });
            let curve = map.curve(points);
            let gap = |(a, b): (&(f64, f64), &(f64, f64))| (a.0 - b.0).hypot(a.1 - b.1);
            let widest =
                curve.iter().zip(&curve[1..]).map(gap).filter(|gap| gap.is_finite()).fold(0.0, f64::max);
            assert!(widest <= FAR_DEG, "{off_deg} deg: {widest} deg");
            let breaks = curve.iter().filter(|(x, _)| x.is_nan()).count();
            assert_eq!(breaks, usize::from(off_deg == 0.0), "{off_deg} deg");
            let farthest =
                curve.iter().map(|(x, y)| x.hypot(*y)).filter(|it| it.is_finite()).fold(0.0, f64::max);
            let expected_deg = 180.0 - off_deg;
            assert!((farthest - expected_deg).abs() < 0.2, "{off_deg} deg: {farthest} deg");
        }
    }
}
