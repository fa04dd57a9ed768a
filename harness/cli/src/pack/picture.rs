//! `model.png`: the spacecraft's plates and panels, seen from sunward, below and aside.
//!
//! The TOML gives areas, centres and normals; every surface is drawn as a square of its area.

use std::fmt::Write;

use resvg::{tiny_skia, usvg};
use toml::{Table, Value};

const WIDTH: f64 = 480.0;
const HEIGHT: f64 = 320.0;
const MARGIN: f64 = 28.0;

/// From the spacecraft to the viewer, body frame; -Y points to the Sun and -Z is drawn upwards.
const VIEW: [f64; 3] = [0.52, -0.78, -0.35];
const UP: [f64; 3] = [0.0, 0.0, -1.0];
/// Where the light comes from in the picture.
const LIGHT: [f64; 3] = [-0.25, -0.85, -0.46];

type Vector = [f64; 3];

/// A square in space.
struct Surface {
    corners: [Vector; 4],
    center: Vector,
    normal: Vector,
    cells: bool,
}

/// Draws the spacecraft; `None` if the text describes no surface.
pub fn png(spacecraft_toml: &str) -> Option<Vec<u8>> {
    let spacecraft: Table = spacecraft_toml.parse().ok()?;
    let svg = svg(&surfaces(&spacecraft))?;
    let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).ok()?;
    let mut pixels = tiny_skia::Pixmap::new(WIDTH as u32, HEIGHT as u32)?;
    resvg::render(&tree, tiny_skia::Transform::default(), &mut pixels.as_mut());
    pixels.encode_png().ok()
}

fn surfaces(spacecraft: &Table) -> Vec<Surface> {
    let mut surfaces = Vec::new();
    let shade = spacecraft.get("sunshade").and_then(|shade| shade.get("plates"));
    for plate in rows(shade).chain(rows(spacecraft.get("plates"))) {
        surfaces.extend(surface(plate, "normal", false));
    }
    for panel in rows(spacecraft.get("panels")) {
        surfaces.extend(surface(panel, "zero_normal", true));
    }
    surfaces
}

fn rows(array: Option<&Value>) -> impl Iterator<Item = &Value> {
    array.and_then(Value::as_array).into_iter().flatten()
}

fn surface(row: &Value, normal_key: &str, cells: bool) -> Option<Surface> {
    let area_m2 = number(row.get("area_m2")?)?;
    let center = vector(row.get("center_m")?)?;
    let normal = unit(vector(row.get(normal_key)?)?)?;
    // One edge lies along the panel's axis, or across the plane of normal and Z.
    let along = row.get("axis").and_then(vector).or_else(|| Some(cross(normal, UP)));
    let along = along.and_then(unit).or_else(|| unit(cross(normal, [1.0, 0.0, 0.0])))?;
    let across = unit(cross(normal, along))?;
    let half = area_m2.sqrt() / 2.0;
    let corner = |a: f64, b: f64| -> Vector {
        std::array::from_fn(|i| center[i] + half * (a * along[i] + b * across[i]))
    };
    let corners = [corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)];
    (half.is_finite() && half > 0.0).then_some(Surface { corners, center, normal, cells })
}

fn svg(surfaces: &[Surface]) -> Option<String> {
    let view = unit(VIEW)?;
    let right = unit(cross(UP, view))?;
    let up = cross(view, right);
    let flat = |point: Vector| (dot(point, right), -dot(point, up));
    let all: Vec<(f64, f64)> = surfaces.iter().flat_map(|surface| surface.corners).map(flat).collect();
    let (&first, rest) = all.split_first()?;
    let (mut low, mut high) = (first, first);
    for point in rest {
        low = (low.0.min(point.0), low.1.min(point.1));
        high = (high.0.max(point.0), high.1.max(point.1));
    }
    let scale = ((WIDTH - 2.0 * MARGIN) / (high.0 - low.0)).min((HEIGHT - 2.0 * MARGIN) / (high.1 - low.1));
    if !scale.is_finite() {
        return None;
    }
    let shift = ((WIDTH - scale * (low.0 + high.0)) / 2.0, (HEIGHT - scale * (low.1 + high.1)) / 2.0);
    let screen = |point: Vector| {
        let (x, y) = flat(point);
        (scale * x + shift.0, scale * y + shift.1)
    };
    let mut order: Vec<&Surface> = surfaces.iter().collect();
    order.sort_by(|a, b| dot(a.center, view).total_cmp(&dot(b.center, view)));

    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{WIDTH}\" height=\"{HEIGHT}\">\
         <rect width=\"{WIDTH}\" height=\"{HEIGHT}\" fill=\"#ffffff\"/>"
    );
    for surface in order {
        let path: Vec<String> = surface
            .corners
            .iter()
            .map(|corner| {
                let (x, y) = screen(*corner);
                format!("{x:.2},{y:.2}")
            })
            .collect();
        let fill = colour(surface, view);
        let _ = write!(
            svg,
            "<polygon points=\"{}\" fill=\"{fill}\" stroke=\"#2b3440\" stroke-width=\"1.4\" \
             stroke-linejoin=\"round\"/>",
            path.join(" ")
        );
        if surface.cells {
            svg.push_str(&cell_lines(surface, &screen));
        }
    }
    svg.push_str("</svg>");
    Some(svg)
}

/// Front sides in the light are bright; cells are blue, cloth is warm white, backs are grey.
fn colour(surface: &Surface, view: Vector) -> String {
    let front = dot(surface.normal, view) > 0.0;
    let light = unit(LIGHT).map_or(0.0, |light| dot(surface.normal, light)).max(0.0);
    let (dark, bright) = match (surface.cells, front) {
        (true, true) => ([0x16, 0x2c, 0x5c], [0x3f, 0x74, 0xc4]),
        (false, true) => ([0xb0, 0xa5, 0x8c], [0xff, 0xf6, 0xe2]),
        (_, false) => ([0x6f, 0x75, 0x7d], [0x8e, 0x95, 0x9e]),
    };
    let mix = |low: u8, high: u8| (f64::from(low) + (f64::from(high) - f64::from(low)) * light).round() as u8;
    let [r, g, b]: [u8; 3] = std::array::from_fn(|i| mix(dark[i], bright[i]));
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// The grid that makes a solar panel look like one.
fn cell_lines(surface: &Surface, screen: &dyn Fn(Vector) -> (f64, f64)) -> String {
    const CELLS: u32 = 5;
    let [a, b, c, d] = surface.corners;
    let between = |from: Vector, to: Vector, t: f64| -> Vector {
        std::array::from_fn(|i| from[i] + (to[i] - from[i]) * t)
    };
    let mut path = String::new();
    for k in 1..CELLS {
        let t = f64::from(k) / f64::from(CELLS);
        for (from, to) in [(between(a, b, t), between(d, c, t)), (between(a, d, t), between(b, c, t))] {
            let ((x1, y1), (x2, y2)) = (screen(from), screen(to));
            let _ = write!(path, "M{x1:.2},{y1:.2}L{x2:.2},{y2:.2}");
        }
    }
    format!(
        "<path d=\"{path}\" stroke=\"#c9d8f0\" stroke-opacity=\"0.55\" stroke-width=\"0.8\" fill=\"none\"/>"
    )
}

fn number(value: &Value) -> Option<f64> {
    value.as_float().or_else(|| value.as_integer().map(|integer| integer as f64)).filter(|x| x.is_finite())
}

fn vector(value: &Value) -> Option<Vector> {
    let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(number).collect();
    numbers?.try_into().ok()
}

fn dot(a: Vector, b: Vector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn cross(a: Vector, b: Vector) -> Vector {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: Vector) -> Option<Vector> {
    let length = dot(a, a).sqrt();
    (length.is_finite() && length > 1e-9).then(|| a.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plates_and_panels_become_a_picture() {
        let text = include_str!("../../../../fmu-src/resources/messenger.toml");
        let png = png(text).unwrap();
        assert_eq!(&png[1..4], b"PNG");
        if let Ok(path) = std::env::var("PICTURE_SAMPLE") {
            std::fs::write(path, png).unwrap();
        }
    }

    #[test]
    fn a_square_has_its_area_and_faces_its_normal() {
        let row: Table = "area_m2 = 2.25\ncenter_m = [1, 2, 3]\nnormal = [0.0, 3.0, 4.0]".parse().unwrap();
        let surface = surface(&Value::Table(row), "normal", false).unwrap();
        let [a, b, c, d] = surface.corners;
        let edge = |from: Vector, to: Vector| -> Vector { std::array::from_fn(|i| to[i] - from[i]) };
        let normal = cross(edge(a, b), edge(a, d));
        assert!((dot(normal, normal).sqrt() - 2.25).abs() < 1e-12);
        assert!((dot(normal, [0.0, 0.6, 0.8]).abs() - 2.25).abs() < 1e-12);
        for i in 0..3 {
            assert!(((a[i] + c[i]) / 2.0 - [1.0, 2.0, 3.0][i]).abs() < 1e-12);
        }
    }

    #[test]
    fn anything_else_gives_no_picture() {
        for text in ["", "plates = 3", "[[plates]]\narea_m2 = -1", "not toml [", "[[plates]]\narea_m2 = nan"]
        {
            assert!(png(text).is_none(), "{text}");
        }
    }
}
