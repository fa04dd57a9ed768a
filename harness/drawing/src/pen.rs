//! SVG elements in pixels.

use std::fmt::Write;

use model_description::escape;
use resvg::{tiny_skia, usvg};

const FONTS: &str = "'Source Sans 3','Segoe UI','Helvetica Neue',Arial,sans-serif";
/// Colour of text.
pub const INK: &str = "#262b33";
/// Colour of what is said beside.
pub const GREY: &str = "#5c6570";
/// Attributes of text.
pub const TEXT: &str = "fill=\"#262b33\"";
/// Attributes of a heading.
pub const HEADING: &str = "fill=\"#262b33\" font-weight=\"bold\"";
/// Attributes of what is said beside.
pub const BESIDE: &str = "fill=\"#5c6570\"";
/// Colours of lines in their order; distinguishable with any colour vision (Okabe and Ito).
pub const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#6b6b6b"];

/// A point in pixels.
pub type Pixel = (f64, f64);

/// Width of a text, estimated on the safe side: the font is the viewer's.
pub fn width_px(text: &str, size: f64) -> f64 {
    let part = |c| match c {
        'i' | 'j' | 'l' | '.' | ',' | '[' | ']' | '(' | ')' | ' ' | 't' | 'f' => 0.36,
        'm' | 'w' | 'M' | 'W' => 0.92,
        _ => 0.6,
    };
    size * text.chars().map(part).sum::<f64>()
}

/// An SVG as PNG, without its texts; `None` for what is no SVG.
pub fn png(svg: &str) -> Option<Vec<u8>> {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).ok()?;
    let size = tree.size().to_int_size();
    let mut pixels = tiny_skia::Pixmap::new(size.width(), size.height())?;
    resvg::render(&tree, tiny_skia::Transform::default(), &mut pixels.as_mut());
    pixels.encode_png().ok()
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

    /// A rectangle between two corners.
    pub fn rect(&mut self, (left, top): Pixel, (right, bottom): Pixel, attributes: &str) {
        let (width, height) = (right - left, bottom - top);
        let _ = writeln!(
            self.0,
            "<rect x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" {attributes}/>"
        );
    }

    /// Draws what is seen through a rectangle between two corners only.
    pub fn within(&mut self, (left, top): Pixel, (right, bottom): Pixel, draw: impl FnOnce(&mut Self)) {
        let (width, height) = (right - left, bottom - top);
        let at = format!("{left:.1} {top:.1} {width:.1} {height:.1}");
        let _ = writeln!(
            self.0,
            "<svg x=\"{left:.1}\" y=\"{top:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" viewBox=\"{at}\">"
        );
        draw(self);
        self.0.push_str("</svg>\n");
    }

    /// Lines through points, each with its own beginning.
    pub fn lines(&mut self, lines: impl IntoIterator<Item: AsRef<[Pixel]>>, attributes: &str) {
        self.path(lines, "", &format!("fill=\"none\" {attributes}"));
    }

    /// The area between closed lines, each by its corners: what an odd number of them encloses.
    pub fn area(&mut self, lines: impl IntoIterator<Item: AsRef<[Pixel]>>, fill: &str) {
        self.path(lines, "z", &format!("fill=\"{fill}\" fill-rule=\"evenodd\""));
    }

    /// Closed outlines filled as one, each by its corners, with a thin rim of their own colour.
    pub fn filled(&mut self, outlines: impl IntoIterator<Item: AsRef<[Pixel]>>, colour: &str) {
        self.path(outlines, "z", &format!("fill=\"{colour}\" stroke=\"{colour}\" stroke-width=\"0.6\""));
    }

    fn path(&mut self, lines: impl IntoIterator<Item: AsRef<[Pixel]>>, end: &str, attributes: &str) {
        let mut path = String::new();
        for line in lines {
            for (index, (x, y)) in line.as_ref().iter().enumerate() {
                let _ = write!(path, "{}{x:.1},{y:.1}", if index == 0 { 'M' } else { 'L' });
            }
            path.push_str(end);
        }
        if !path.is_empty() {
            let _ = writeln!(self.0, "<path d=\"{path}\" {attributes}/>");
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
        self.lines((0..8).map(ray), "stroke=\"#e69f00\" stroke-width=\"1.6\"");
        self.circle((x, y), 4.5, "fill=\"#ffd24d\" stroke=\"#e69f00\" stroke-width=\"1.4\"");
    }
}

fn points(corners: &[Pixel]) -> String {
    let pairs: Vec<String> = corners.iter().map(|(x, y)| format!("{x:.2},{y:.2}")).collect();
    pairs.join(" ")
}
