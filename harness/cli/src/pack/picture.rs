//! `model.png`: the spacecraft's plates and panels, seen from sunward, above and aside; or a spinner's thrusters.
//!
//! A surface given by its outline is drawn as that polygon, any other as a square of its area; panels stand at angle 0.

mod canvas;
mod spinner;

use std::fmt::Write;

use physics::{spacecraft::Spacecraft, spin::spinner::Spinner};
use resvg::{tiny_skia, usvg};

use crate::draw::{
    surface::{Finish, Surface, cell_lines, colour, surfaces},
    vector::{Vector, cross, dot, unit},
};
use canvas::{HEIGHT, MARGIN, WIDTH};

/// From the spacecraft to the viewer, body frame; -Y points to the Sun and +Z is drawn upwards.
const VIEW: [f64; 3] = [0.52, -0.78, 0.35];
const UP: [f64; 3] = [0.0, 0.0, 1.0];
/// Where the light comes from in the picture.
const LIGHT: [f64; 3] = [-0.25, -0.85, 0.46];

/// Draws the spacecraft; `None` if the text describes no surface and no thruster.
pub fn png(spacecraft_toml: &str) -> Option<Vec<u8>> {
    // A file that no reader takes has no picture; the library that packs it reports what is wrong.
    let svg = match Spacecraft::from_toml("", spacecraft_toml) {
        Ok(spacecraft) => svg(&surfaces(&spacecraft, |_| 0.0)),
        Err(_) => spinner::svg(&Spinner::parse("", spacecraft_toml).ok()?.thrusters),
    }?;
    let tree = usvg::Tree::from_str(&svg, &usvg::Options::default()).ok()?;
    let mut pixels = tiny_skia::Pixmap::new(WIDTH as u32, HEIGHT as u32)?;
    resvg::render(&tree, tiny_skia::Transform::default(), &mut pixels.as_mut());
    pixels.encode_png().ok()
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
        let fill = colour(surface, dot(surface.normal, view) > 0.0, LIGHT);
        let path = path.join(" ");
        let _ = write!(
            svg,
            "<polygon points=\"{path}\" fill=\"{fill}\" stroke=\"#2b3440\" stroke-width=\"1.4\" \
             stroke-linejoin=\"round\"/>"
        );
        if surface.finish == Finish::Cells {
            let _ = write!(
                svg,
                "<clipPath id=\"panel{number}\"><polygon points=\"{path}\"/></clipPath>\
                 <g clip-path=\"url(#panel{number})\">{}</g>",
                grid(surface, &screen)
            );
        }
    }
    svg.push_str("</svg>");
    Some(svg)
}

/// The lines of a panel's grid.
fn grid(surface: &Surface, screen: &dyn Fn(Vector) -> (f64, f64)) -> String {
    let mut path = String::new();
    for [from, to] in cell_lines(surface).into_iter().map(|line| line.map(screen)) {
        let _ = write!(path, "M{:.2},{:.2}L{:.2},{:.2}", from.0, from.1, to.0, to.1);
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
        let drawn = surfaces(&file, |_| 0.0);
        assert_eq!(
            drawn.len(),
            file.plates_body(physics::spacecraft::SunshadeModel::Plates).len() + file.panels.len()
        );
        for (surface, panel) in drawn[drawn.len() - file.panels.len()..].iter().zip(&file.panels) {
            let vertices = panel.polygon.as_ref().unwrap().vertices_m();
            assert!(
                surface
                    .corners
                    .iter()
                    .zip(vertices)
                    .all(|(corner, vertex)| *corner == [vertex.x, vertex.y, vertex.z])
            );
            assert!(
                surface.finish == Finish::Cells && surface.corners.len() == vertices.len(),
                "{}",
                panel.name
            );
        }
    }

    #[test]
    fn anything_else_gives_no_picture() {
        for text in ["", "plates = 3", "not toml [", "[[plates]]\narea_m2 = -1", "[[thruster]]"] {
            assert!(png(text).is_none(), "{text}");
        }
    }
}
