//! `model.png`: the spacecraft's plates and panels, seen from sunward, below and aside; or a spinner's thrusters.
//!
//! A surface given by its outline is drawn as that polygon, any other as a square of its area; panels stand at angle 0.

mod canvas;
mod spinner;

use std::fmt::Write;

use physics::{
    spacecraft::{Polygon, Spacecraft, SunshadeModel},
    spin::spinner::Spinner,
};
use resvg::{tiny_skia, usvg};

use canvas::{HEIGHT, MARGIN, Vector, WIDTH, cross, dot, unit};

/// From the spacecraft to the viewer, body frame; -Y points to the Sun and -Z is drawn upwards.
const VIEW: [f64; 3] = [0.52, -0.78, -0.35];
const UP: [f64; 3] = [0.0, 0.0, -1.0];
/// Where the light comes from in the picture.
const LIGHT: [f64; 3] = [-0.25, -0.85, -0.46];

/// A flat polygon in space.
struct Surface {
    corners: Vec<Vector>,
    center: Vector,
    normal: Vector,
    /// Two directions in the plane that the grid of a solar panel follows.
    grid: [Vector; 2],
    cells: bool,
}

/// Draws the spacecraft; `None` if the text describes no surface and no thruster.
pub fn png(spacecraft_toml: &str) -> Option<Vec<u8>> {
    // A file that no reader takes has no picture; the library that packs it reports what is wrong.
    let svg = match Spacecraft::from_toml("", spacecraft_toml) {
        Ok(spacecraft) => svg(&surfaces(&spacecraft)),
        Err(_) => spinner::svg(&Spinner::parse("", spacecraft_toml).ok()?.thrusters),
    }?;
    let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).ok()?;
    let mut pixels = tiny_skia::Pixmap::new(WIDTH as u32, HEIGHT as u32)?;
    resvg::render(&tree, tiny_skia::Transform::default(), &mut pixels.as_mut());
    pixels.encode_png().ok()
}

fn surfaces(spacecraft: &Spacecraft) -> Vec<Surface> {
    let outline = |polygon: &Option<Polygon>| {
        let polygon = polygon.as_ref()?;
        Some(polygon.vertices_m().iter().map(|vertex| (*vertex).into()).collect())
    };
    let plates = spacecraft.plates_body(SunshadeModel::Plates);
    let plates = plates.iter().filter_map(|plate| {
        let square = (plate.area_m2, plate.center_m.into());
        Surface::new(outline(&plate.polygon), square, plate.normal.into(), None)
    });
    let panels = spacecraft.panels.iter().filter_map(|panel| {
        let square = (panel.area_m2, panel.center_body_m.into());
        let (normal, axis) = (panel.zero_normal_body.into(), panel.axis_body.into());
        Surface::new(outline(&panel.polygon), square, normal, Some(axis))
    });
    plates.chain(panels).collect()
}

impl Surface {
    /// With its outline, else a square of this area about this centre. Only a panel has an axis, and solar cells.
    fn new(
        outline: Option<Vec<Vector>>,
        (area_m2, center_m): (f64, Vector),
        normal: Vector,
        axis: Option<Vector>,
    ) -> Option<Self> {
        // One edge of a square lies along the panel's axis, or across the plane of normal and Z.
        let along =
            axis.or_else(|| unit(cross(normal, UP))).or_else(|| unit(cross(normal, [1.0, 0.0, 0.0])))?;
        let across = unit(cross(normal, along))?;
        let corners = match outline {
            Some(outline) => outline,
            None => square(area_m2, center_m, along, across)?,
        };
        let share = 1.0 / corners.len() as f64;
        let center = std::array::from_fn(|i| corners.iter().map(|corner| corner[i] * share).sum());
        Some(Self { corners, center, normal, grid: [along, across], cells: axis.is_some() })
    }
}

fn square(area_m2: f64, center: Vector, along: Vector, across: Vector) -> Option<Vec<Vector>> {
    let half = area_m2.sqrt() / 2.0;
    let corner = |(a, b): (f64, f64)| -> Vector {
        std::array::from_fn(|i| center[i] + half * (a * along[i] + b * across[i]))
    };
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(corner);
    (half.is_finite() && half > 0.0).then(|| corners.to_vec())
}

fn svg(surfaces: &[Surface]) -> Option<String> {
    let view = unit(VIEW)?;
    let right = unit(cross(UP, view))?;
    let up = cross(view, right);
    let flat = |point: Vector| (dot(point, right), -dot(point, up));
    let all: Vec<(f64, f64)> =
        surfaces.iter().flat_map(|surface| &surface.corners).map(|corner| flat(*corner)).collect();
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
    for (number, surface) in order.into_iter().enumerate() {
        let path: Vec<String> = surface
            .corners
            .iter()
            .map(|corner| {
                let (x, y) = screen(*corner);
                format!("{x:.2},{y:.2}")
            })
            .collect();
        let fill = colour(surface, view);
        let path = path.join(" ");
        let _ = write!(
            svg,
            "<polygon points=\"{path}\" fill=\"{fill}\" stroke=\"#2b3440\" stroke-width=\"1.4\" \
             stroke-linejoin=\"round\"/>"
        );
        if surface.cells {
            let _ = write!(
                svg,
                "<clipPath id=\"panel{number}\"><polygon points=\"{path}\"/></clipPath>\
                 <g clip-path=\"url(#panel{number})\">{}</g>",
                cell_lines(surface, &screen)
            );
        }
    }
    svg.push_str("</svg>");
    Some(svg)
}

/// Front sides in the light are bright; cells are blue, cloth is yellowish white, backs are grey.
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

/// The grid of a solar panel: nearly square cells over the rectangle around the outline.
fn cell_lines(surface: &Surface, screen: &dyn Fn(Vector) -> (f64, f64)) -> String {
    const CELLS: f64 = 25.0;
    let [low, high] = [f64::min, f64::max].map(|pick| {
        surface.grid.map(|direction| {
            let along = surface.corners.iter().map(|corner| dot(*corner, direction));
            along.reduce(pick).unwrap_or_default()
        })
    });
    let size = [high[0] - low[0], high[1] - low[1]];
    let cell = (size[0] * size[1] / CELLS).sqrt();
    let offset = dot(surface.center, surface.normal);
    let point = |a: f64, b: f64| -> Vector {
        std::array::from_fn(|i| a * surface.grid[0][i] + b * surface.grid[1][i] + offset * surface.normal[i])
    };
    let mut path = String::new();
    for axis in 0..2 {
        let count = (size[axis] / cell).round().clamp(1.0, CELLS) as u32;
        for k in 1..count {
            let at = low[axis] + size[axis] * f64::from(k) / f64::from(count);
            let ends = [low[1 - axis], high[1 - axis]];
            let [from, to] = ends.map(|end| screen(if axis == 0 { point(at, end) } else { point(end, at) }));
            let _ = write!(path, "M{:.2},{:.2}L{:.2},{:.2}", from.0, from.1, to.0, to.1);
        }
    }
    format!(
        "<path d=\"{path}\" stroke=\"#c9d8f0\" stroke-opacity=\"0.55\" stroke-width=\"0.8\" fill=\"none\"/>"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn plates_and_panels_become_a_picture() {
        let outlines = include_str!("../../../../fmu-src/resources/examples/mercury-orbiter.toml");
        for (name, text) in [
            ("squares", include_str!("../../../../fmu-src/resources/messenger.toml")),
            ("outlines", outlines),
            ("spinner", include_str!("../../../../fmu-src/resources/ace.toml")),
        ] {
            let png = png(text).unwrap();
            assert_eq!(&png[1..4], b"PNG");
            if let Ok(folder) = std::env::var("PICTURE_SAMPLES") {
                std::fs::write(format!("{folder}/{name}.png"), png).unwrap();
            }
        }
    }

    #[test]
    fn a_square_has_its_area_and_faces_its_normal() {
        let surface = Surface::new(None, (2.25, [1.0, 2.0, 3.0]), [0.0, 0.6, 0.8], None).unwrap();
        let [a, b, c, d] = surface.corners[..] else { panic!("four corners") };
        let edge = |from: Vector, to: Vector| -> Vector { std::array::from_fn(|i| to[i] - from[i]) };
        let normal = cross(edge(a, b), edge(a, d));
        assert!((dot(normal, normal).sqrt() - 2.25).abs() < 1e-12);
        assert!((dot(normal, [0.0, 0.6, 0.8]).abs() - 2.25).abs() < 1e-12);
        for i in 0..3 {
            assert!(((a[i] + c[i]) / 2.0 - [1.0, 2.0, 3.0][i]).abs() < 1e-12);
        }
    }

    #[test]
    fn an_outline_is_drawn_as_it_is() {
        let text = include_str!("../../../../fmu-src/resources/examples/mercury-orbiter.toml");
        let file = physics::spacecraft::Spacecraft::from_toml("", text).unwrap();
        let drawn = surfaces(&file);
        assert_eq!(drawn.len(), file.plates_body(SunshadeModel::Plates).len() + file.panels.len());
        for (surface, panel) in drawn[drawn.len() - file.panels.len()..].iter().zip(&file.panels) {
            let vertices = panel.polygon.as_ref().unwrap().vertices_m();
            assert!(
                surface
                    .corners
                    .iter()
                    .zip(vertices)
                    .all(|(corner, vertex)| *corner == [vertex.x, vertex.y, vertex.z])
            );
            assert!(surface.cells && surface.corners.len() == vertices.len(), "{}", panel.name);
        }
    }

    #[test]
    fn anything_else_gives_no_picture() {
        for text in ["", "plates = 3", "not toml [", "[[plates]]\narea_m2 = -1", "[[thruster]]"] {
            assert!(png(text).is_none(), "{text}");
        }
    }
}
