//! The picture: torque by axis over all directions and over the keep-in zone, and what downlinks can undo.

use drawing::{Axes, BESIDE, Frame, HEADING, Pen, Pixel, TEXT, round_up};
use physics::constants::ASTRONOMICAL_UNIT_M as AU_M;

use super::{bands, colours::Bands, found::Found, spacecraft::MappedSpacecraft, verdict};
use crate::torque_map::Mapped;

const WIDTH: f64 = 1150.0;
const HEAD: f64 = 96.0;
/// Title, numbers and label of an axis, with the space around them.
const AROUND_PLOT: f64 = 80.0;
const HEIGHT_OF_PLOT: f64 = 264.0;
/// Without a zone beside it.
const HEIGHT_OF_ONLY_PLOT: f64 = 448.0;
const LEFT: f64 = 76.0;
const ZONE_LEFT: f64 = 766.0;
const ZONE_WIDTH: f64 = 310.0;
const LAST_ROW: f64 = 352.0;
const MICRO: f64 = 1e6;
const NAMES: [&str; 3] = ["X", "Y", "Z"];
const NONE: &str = "#c9ccd1";
const ZERO_LINE: &str = "stroke=\"#111418\" stroke-width=\"1.6\" class=\"zero\"";
const BALANCE: &str = "fill=\"#ffffff\" fill-opacity=\"0.6\" stroke=\"#0b6e4f\" stroke-width=\"2.2\"";
const LEAST: &str = "stroke=\"#0b6e4f\" stroke-width=\"2.4\"";
const ZONE: &str = "stroke=\"#262b33\" stroke-width=\"1.1\" stroke-dasharray=\"4 3\"";
const MISSION: &str = "fill=\"#b2182b\" stroke=\"#ffffff\" stroke-width=\"1.2\" class=\"mission\"";
const ATTAINABLE: &str = "fill=\"#cfe3d8\" stroke=\"#0b6e4f\" stroke-width=\"1.4\" class=\"attainable\"";
const MIDDLE: &str = "stroke=\"#5c6570\" stroke-width=\"0.8\" stroke-dasharray=\"2 3\"";
/// Distance of vertical labels from their axis.
const LABEL: f64 = 46.0;

/// The sheet.
pub(super) fn svg(spacecraft: &MappedSpacecraft, found: &Found) -> String {
    let title = format!(
        "{}: torque of sunlight at {} AU",
        spacecraft.name,
        terminal::short((spacecraft.lit.distance_m / AU_M * 1e4).round() / 1e4)
    );
    let height = if found.zone.is_some() { HEIGHT_OF_PLOT } else { HEIGHT_OF_ONLY_PLOT };
    let row = height + AROUND_PLOT;
    // Without a window nothing is undone.
    let has_downlinks = spacecraft.downlink.share() > 0.0;
    let last_row = if has_downlinks { LAST_ROW } else { 0.0 };
    let mut pen = Pen::new(WIDTH, HEAD + 3.0 * row + last_row, &title);
    pen.text((LEFT, 36.0), 20.0, "start", HEADING, &title);
    legend(&mut pen, found.zone.is_some());
    for (axis, name) in NAMES.into_iter().enumerate() {
        let top = HEAD + row * axis as f64;
        pen.text(
            (LEFT, top - 7.0),
            14.0,
            "start",
            HEADING,
            &format!("About {name}, all directions of the Sun"),
        );
        let sphere = frame(&found.sphere, (LEFT, top), [2.0 * height, height]);
        torque(&mut pen, &found.sphere, sphere, axis, [60.0, 30.0]);
        let (Some(limits_rad), Some(zone)) = (spacecraft.zone_rad, &found.zone) else {
            cross(&mut pen, sphere.at(found.least.0));
            continue;
        };
        outline(&mut pen, sphere, limits_rad);
        pen.text((ZONE_LEFT, top - 7.0), 14.0, "start", HEADING, &format!("About {name}, keep-in zone"));
        let in_zone = frame(zone, (ZONE_LEFT, top), [ZONE_WIDTH, height]);
        let steps = zone.grid.limits_deg.map(|limit_deg| round_up(limit_deg / 3.5));
        torque(&mut pen, zone, in_zone, axis, steps);
        cross(&mut pen, in_zone.at(found.least.0));
    }
    if has_downlinks {
        downlinks(&mut pen, HEAD + 3.0 * row, spacecraft, found);
    }
    pen.finish()
}

/// A plot as wide and as high as allowed, by its angles.
fn frame(mapped: &Mapped, (left, top): (f64, f64), [width, height]: [f64; 2]) -> Frame {
    let [azimuth_deg, elevation_deg] = mapped.grid.limits_deg;
    let scale = (width / azimuth_deg).min(height / elevation_deg);
    let (width, height) = (scale * azimuth_deg, scale * elevation_deg);
    Frame { left, top, width, height, x: [-azimuth_deg, azimuth_deg], y: [-elevation_deg, elevation_deg] }
}

/// Bands, lines of zero, balances, axes.
fn torque(pen: &mut Pen, mapped: &Mapped, frame: Frame, axis: usize, steps: [f64; 2]) {
    let grid = &mapped.grid;
    let scale = Bands::new(MICRO * grid.greatest_n_m(axis));
    let value_n_m = grid.component_n_m(axis);
    bands::draw(&frame, pen, grid.steps, &|column, row| MICRO * value_n_m(column, row), scale);
    let is_flat = grid.is_flat(axis);
    bands::area(&frame, pen, grid.steps, &is_flat, NONE);
    for line in &mapped.lines[axis] {
        frame.line(pen, &line.places_deg, ZERO_LINE);
    }
    for balance in &mapped.balances {
        pen.circle(frame.at(balance.place_deg), 5.0, BALANCE);
    }
    let labels = ["Sun azimuth [deg]", "Sun elevation [deg]"];
    let axes = Axes { labels, steps, label_px: LABEL, is_whole: false, named: [&[]; 2] };
    frame.axes(pen, &axes.beside(frame.y));
    bands::scale(&frame, pen, scale, "uN.m");
}

/// The zone's border among all directions.
fn outline(pen: &mut Pen, frame: Frame, limits_rad: [f64; 2]) {
    let [a, e] = limits_rad.map(f64::to_degrees);
    frame.line(pen, &[[-a, -e], [a, -e], [a, e], [-a, e], [-a, -e]], ZONE);
}

/// A cross where the whole torque is least.
fn cross(pen: &mut Pen, (x, y): Pixel) {
    let strokes = [[(x - 5.0, y - 5.0), (x + 5.0, y + 5.0)], [(x - 5.0, y + 5.0), (x + 5.0, y - 5.0)]];
    pen.lines(strokes.iter().map(|stroke| &stroke[..]), LEAST);
}

fn legend(pen: &mut Pen, has_zone: bool) {
    let y = 60.0;
    pen.lines([&[(LEFT, y), (LEFT + 26.0, y)][..]], ZERO_LINE);
    pen.text((LEFT + 33.0, y + 4.0), 12.0, "start", BESIDE, "component is zero");
    pen.circle((LEFT + 166.0, y), 5.0, BALANCE);
    pen.text((LEFT + 178.0, y + 4.0), 12.0, "start", BESIDE, "X and Z are zero");
    cross(pen, (LEFT + 308.0, y));
    let least = if has_zone { "whole torque is least in the zone" } else { "whole torque is least" };
    pen.text((LEFT + 321.0, y + 4.0), 12.0, "start", BESIDE, least);
    if has_zone {
        pen.lines([&[(LEFT + 540.0, y), (LEFT + 566.0, y)][..]], ZONE);
        pen.text((LEFT + 573.0, y + 4.0), 12.0, "start", BESIDE, "Sun keep-in zone");
    }
    pen.rect((LEFT + 706.0, y - 5.0), (LEFT + 726.0, y + 5.0), &format!("fill=\"{NONE}\""));
    pen.text((LEFT + 733.0, y + 4.0), 12.0, "start", BESIDE, "no torque about the axis");
}

/// Disturbances that downlinks can undo, the mission's mean among them.
fn downlinks(pen: &mut Pen, top: f64, spacecraft: &MappedSpacecraft, found: &Found) {
    let attainable = &found.attainable;
    // A disturbance is undone by its opposite.
    let undone = attainable.mean_added_n_m.scaled(-MICRO, [0.0; 2]);
    let mean = attainable.mission.as_ref().map(|(mission, _)| mission.mean_torque_n_m().map(|x| MICRO * x));
    pen.text((LEFT, top - 7.0), 14.0, "start", HEADING, "Mean disturbance that downlinks can undo");
    let range = |axis: usize| {
        let [low, high] = undone.extent(axis);
        let (low, high) = mean.map_or((low, high), |mean| (low.min(mean[axis]), high.max(mean[axis])));
        let (low, high) = (low.min(0.0), high.max(0.0));
        let rim = 0.1 * (high - low);
        if rim > 0.0 { [low - rim, high + rim] } else { [-1.0, 1.0] }
    };
    let (x, y) = (range(0), range(1));
    let frame = Frame { left: LEFT, top, width: 1.6 * HEIGHT_OF_PLOT, height: 1.1 * HEIGHT_OF_PLOT, x, y };
    let corners: Vec<_> = undone.corners.iter().map(|corner| frame.at(*corner)).collect();
    pen.polygon(&corners, ATTAINABLE);
    for middle in [[[x[0], 0.0], [x[1], 0.0]], [[0.0, y[0]], [0.0, y[1]]]] {
        frame.line(pen, &middle, MIDDLE);
    }
    let steps = [x, y].map(|[low, high]| round_up((high - low) / 7.0));
    let labels = ["mean torque about X [uN.m]", "mean torque about Z [uN.m]"];
    let axes = Axes { labels, steps, label_px: LABEL, is_whole: false, named: [&[]; 2] };
    frame.axes(pen, &axes.beside(frame.y));
    if let Some(mean) = mean.filter(|mean| frame.holds(*mean)) {
        pen.circle(frame.at(mean), 5.0, MISSION);
    }
    let left = LEFT + frame.width + 40.0;
    let anywhere = if found.zone.is_some() { "anywhere in the zone" } else { "anywhere" };
    let mut lines = vec![verdict::share(spacecraft), format!("with the Sun {anywhere} instead of on -Y")];
    if mean.is_some() {
        pen.circle((left + 5.0, top + 78.0), 5.0, "fill=\"#b2182b\" stroke=\"#ffffff\" stroke-width=\"1.2\"");
        lines.push(String::new());
        lines.push("    the mission's mean disturbance; inside the area it can be held for ever".to_owned());
        lines.push(String::new());
        lines.extend(verdict::on_mission(spacecraft, attainable));
    }
    for (k, line) in lines.iter().enumerate() {
        let indent = if line.starts_with(' ') { 16.0 } else { 0.0 };
        let at = (left + indent, top + 22.0 + 20.0 * k as f64);
        pen.text(at, 13.0, "start", TEXT, line.trim_start());
    }
}
