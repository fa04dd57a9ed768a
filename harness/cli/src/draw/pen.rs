//! SVG elements in pixels.

use std::fmt::Write;

use model_description::escape;

/// Fonts, as in charts.
const FONTS: &str = "'Source Sans 3','Segoe UI','Helvetica Neue',Arial,sans-serif";
/// Width of a character as a part of the font size, on the safe side.
const CHARACTER: f64 = 0.56;
/// Colour of text.
pub const INK: &str = "#262b33";
/// Colour of what is said beside.
pub const GREY: &str = "#5c6570";

/// A point in pixels.
pub type Pixel = (f64, f64);

/// Width of a text, estimated.
pub fn width_px(text: &str, size: f64) -> f64 {
    CHARACTER * size * text.chars().count() as f64
}

/// An SVG in progress.
pub struct Pen(String);

impl Pen {
    /// A white sheet.
    pub fn new(width: f64, height: f64, title: &str) -> Self {
        let title = escape(title);
        Self(format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width:.0}\" height=\"{height:.0}\" \
             viewBox=\"0 0 {width:.0} {height:.0}\" font-family=\"{FONTS}\" role=\"img\">\n<title>{title}</title>\n\
             <rect width=\"{width:.0}\" height=\"{height:.0}\" fill=\"#ffffff\"/>\n"
        ))
    }

    /// The SVG.
    pub fn finish(mut self) -> String {
        self.0.push_str("</svg>\n");
        self.0
    }

    /// A closed outline with these attributes.
    pub fn polygon(&mut self, corners: &[Pixel], attributes: &str) {
        let _ = writeln!(self.0, "<polygon points=\"{}\" {attributes}/>", points(corners));
    }

    /// Lines through points, each with its own beginning.
    pub fn lines<'a>(&mut self, lines: impl IntoIterator<Item = &'a [Pixel]>, attributes: &str) {
        let mut path = String::new();
        for line in lines {
            for (index, (x, y)) in line.iter().enumerate() {
                let _ = write!(path, "{}{x:.1},{y:.1}", if index == 0 { 'M' } else { 'L' });
            }
        }
        if !path.is_empty() {
            let _ = writeln!(self.0, "<path d=\"{path}\" fill=\"none\" {attributes}/>");
        }
    }

    /// The area between closed lines, each by its corners: what an odd number of them encloses.
    pub fn area<'a>(&mut self, lines: impl IntoIterator<Item = &'a [Pixel]>, fill: &str) {
        let mut path = String::new();
        for line in lines {
            for (index, (x, y)) in line.iter().enumerate() {
                let _ = write!(path, "{}{x:.1},{y:.1}", if index == 0 { 'M' } else { 'L' });
            }
            path.push('z');
        }
        if !path.is_empty() {
            let _ = writeln!(self.0, "<path d=\"{path}\" fill=\"{fill}\" fill-rule=\"evenodd\"/>");
        }
    }

    /// A circle with these attributes.
    pub fn circle(&mut self, (x, y): Pixel, radius: f64, attributes: &str) {
        let _ = writeln!(self.0, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{radius}\" {attributes}/>");
    }

    /// Text; `anchor` is start, middle or end.
    pub fn text(&mut self, (x, y): Pixel, size: f64, anchor: &str, attributes: &str, text: &str) {
        let _ = writeln!(
            self.0,
            "<text x=\"{x:.1}\" y=\"{y:.1}\" font-size=\"{size}\" text-anchor=\"{anchor}\" {attributes}>{}</text>",
            escape(text)
        );
    }

    /// Text on a picture, readable on any ground.
    pub fn label(&mut self, at: Pixel, size: f64, colour: &str, text: &str) {
        let attributes = format!(
            "fill=\"{colour}\" stroke=\"#ffffff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\""
        );
        self.text((at.0, at.1 + 0.35 * size), size, "middle", &attributes, text);
    }

    /// A head at the end of a line that comes from another point.
    pub fn arrow_head(&mut self, from: Pixel, tip: Pixel, colour: &str) {
        let (x, y) = (tip.0 - from.0, tip.1 - from.1);
        let length = (x * x + y * y).sqrt();
        if length > 0.5 {
            let (x, y) = (x / length, y / length);
            let at = |back: f64, side: f64| (tip.0 - back * x - side * y, tip.1 - back * y + side * x);
            self.polygon(&[at(0.0, 0.0), at(9.0, 3.6), at(9.0, -3.6)], &format!("fill=\"{colour}\""));
        }
    }

    /// The quartered circle of a centre of mass.
    pub fn center_of_mass(&mut self, (x, y): Pixel) {
        const RADIUS: f64 = 6.0;
        self.circle((x, y), RADIUS, &format!("fill=\"#ffffff\" stroke=\"{INK}\" stroke-width=\"1.2\""));
        let quarter = |sx: f64, sy: f64| {
            format!(
                "M{x:.1},{y:.1}h{:.1}A{RADIUS},{RADIUS} 0 0 0 {x:.1},{:.1}z",
                sx * RADIUS,
                y + sy * RADIUS
            )
        };
        let path = quarter(1.0, -1.0) + &quarter(-1.0, 1.0);
        let _ = writeln!(self.0, "<path class=\"center-of-mass\" d=\"{path}\" fill=\"{INK}\"/>");
    }

    /// A disc with rays.
    pub fn sun(&mut self, (x, y): Pixel) {
        let ray = |k: u32| {
            let (sine, cosine) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
            [(x + 6.5 * cosine, y + 6.5 * sine), (x + 9.5 * cosine, y + 9.5 * sine)]
        };
        let rays: Vec<[Pixel; 2]> = (0..8).map(ray).collect();
        self.lines(rays.iter().map(|ray| &ray[..]), "stroke=\"#e69f00\" stroke-width=\"1.6\"");
        self.circle((x, y), 4.5, "fill=\"#ffd24d\" stroke=\"#e69f00\" stroke-width=\"1.4\"");
    }
}

fn points(corners: &[Pixel]) -> String {
    let pairs: Vec<String> = corners.iter().map(|(x, y)| format!("{x:.2},{y:.2}")).collect();
    pairs.join(" ")
}
