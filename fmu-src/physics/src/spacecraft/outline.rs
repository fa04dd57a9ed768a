//! Area, centre and normal of a surface: as the file gives them, or those of its outline.

use nalgebra::Vector3;

use super::part_reader::PartReader;
use super::polygon::Polygon;
use crate::math;
use crate::refusal::Refusal;
use crate::toml::{Point, Positive, Written};

/// How far area, centre and normal may be off the polygon's, relative to its size: printed tables are rounded ...
const OUTLINE_TOLERANCE: f64 = 1e-3;

/// ... and corners stand in whole millimetres, ...
const ROUNDING_M: f64 = 1e-3;

/// ... which on the smallest polygons is no excuse for more than this.
const GREATEST_TOLERANCE: f64 = 0.02;

/// How far a value may be off what the outline gives, relative to its size.
fn tolerance(outline: &Polygon) -> f64 {
    (ROUNDING_M / outline.area_m2().sqrt()).clamp(OUTLINE_TOLERANCE, GREATEST_TOLERANCE)
}

fn short(tolerance: f64) -> String {
    if tolerance > OUTLINE_TOLERANCE { format!("{tolerance:.1e}") } else { "1e-3".to_owned() }
}

/// The outline with its front where the normal is, if both are given.
pub(super) fn checked_outline(
    part: &PartReader<'_>,
    vertices_m: Option<&[Point]>,
    normal: Option<&Vector3<f64>>,
) -> Option<Polygon> {
    let vertices_m = vertices_m?;
    let report = |error: Refusal| part.key("polygon_m").report(error.found, error.allowed);
    let polygon = Polygon::new(vertices_m.iter().map(|v| v.value()).collect()).map_err(report).ok()?;
    let along = normal.map_or(1.0, |normal| polygon.normal().dot(normal));
    let off = tolerance(&polygon);
    if let (Some(normal), true) = (normal, along.abs() < (1.0 - math::powi(off, 2) / 2.0)) {
        let found = format!("an outline with the normal {:?}", polygon.normal().as_slice());
        let (normal, within) = (normal.as_slice(), short(off));
        let allowed = format!("one with the normal {normal:?} or its opposite, within {within}");
        part.key("polygon_m").report_across(found, allowed);
    }
    Some(if along < 0.0 { polygon.reversed() } else { polygon })
}

pub(super) fn checked_area(
    part: &PartReader<'_>,
    given_m2: Option<Positive>,
    outline: Option<&Polygon>,
) -> f64 {
    match (given_m2.value(), outline) {
        (Some(area_m2), None) => area_m2,
        (None, None) => missing(part, "area_m2", 1.0),
        (given_m2, Some(outline)) => {
            let area_m2 = outline.area_m2();
            if let Some(given_m2) = given_m2
                && (given_m2 / area_m2 - 1.0).abs() > tolerance(outline)
            {
                let allowed = format!("the polygon's {area_m2} within {}", short(tolerance(outline)));
                part.key("area_m2").report_across(given_m2, allowed);
            }
            area_m2
        }
    }
}

pub(super) fn checked_center(
    part: &PartReader<'_>,
    given_m: Option<Point>,
    outline: Option<&Polygon>,
) -> Vector3<f64> {
    match (given_m.value(), outline) {
        (Some(center_m), None) => center_m,
        (None, None) => missing(part, "center_m", Vector3::zeros()),
        (given_m, Some(outline)) => {
            let center_m = outline.centroid_m();
            if let Some(given_m) = given_m
                && (given_m - center_m).norm() > tolerance(outline) * outline.area_m2().sqrt()
            {
                let found = format!("{:?}", given_m.as_slice());
                let allowed = format!(
                    "the polygon's {:?} within {} of its size",
                    center_m.as_slice(),
                    short(tolerance(outline))
                );
                part.key("center_m").report_across(found, allowed);
            }
            center_m
        }
    }
}

pub(super) fn checked_normal(
    part: &PartReader<'_>,
    given: Option<Vector3<f64>>,
    outline: Option<&Polygon>,
) -> Vector3<f64> {
    match (given, outline) {
        (_, Some(outline)) => outline.normal(),
        (Some(normal), None) => normal,
        (None, None) => missing(part, "normal", Vector3::x()),
    }
}

fn missing<V>(part: &PartReader<'_>, key: &str, stand_in: V) -> V {
    // An outline that was refused would have given it.
    if part.key("polygon_m").has_reported() || part.key("polygon_m").is_stand_in() {
        return stand_in;
    }
    part.report_lack(key, format_args!("a value for `{key}`, or an outline `polygon_m`"));
    stand_in
}
