//! One view of a scene: surfaces, axes, the Sun, centre of mass, rotations, names.

use super::{
    parts::{Arrow, Axis},
    scene::Scene,
    surface::TO_SUN,
};
use crate::{
    Camera, Finish, GREY, INK, Labels, NAME_SIZE, Pen, Pixel, Surface, TEXT, Vector, camera::bounds,
    contains, unit,
};

/// Direction of the picture's light, beside that of the viewer.
const LIGHT: Vector = Vector::new(-0.25, -0.85, 0.46);
/// Colours of X, Y, Z and of rotations.
const AXIS_COLOURS: [&str; 3] = ["#c0392b", "#1e8449", "#1f5fbf"];
const ROTATION_COLOUR: &str = "#8e44ad";
/// Radius of a tank's sign.
const TANK_RADIUS_PX: f64 = 5.0;
/// More names than this would not be readable.
const MAX_NAMES: usize = 200;

/// How a scene stands in a rectangle.
pub(super) struct Pane<'a> {
    pub scene: &'a Scene,
    pub camera: &'a Camera,
    /// Pixel of the target.
    pub middle: Pixel,
    pub pixels_per_m: f64,
    /// How far axes reach.
    pub reach_m: &'a Extent,
}

/// The box around all that is drawn, body frame.
pub(super) struct Extent {
    pub low_m: Vector,
    pub high_m: Vector,
    /// How far arrows stand out of it.
    pub arrow_m: f64,
}

impl Extent {
    /// Pane of a scene with its axes of rotation, origin and centre of mass.
    pub(super) fn new(scene: &Scene) -> Option<Self> {
        let [mut low_m, mut high_m] = scene.bounds_m()?;
        let ends = scene.axes.iter().flat_map(Axis::ends_m);
        let tips = scene.arrows.iter().map(|arrow| arrow.to_m);
        for point in ends.chain(tips).chain([Vector::zeros(), scene.center_of_mass_m]) {
            (low_m, high_m) = (low_m.inf(&point), high_m.sup(&point));
        }
        let size_m = (high_m - low_m).max();
        (size_m.is_finite() && size_m > 0.0).then_some(Self { low_m, high_m, arrow_m: 0.09 * size_m })
    }

    /// Middle of the box with its arrows.
    pub(super) fn middle_m(&self) -> Vector {
        let [low, high] = self.ends_m();
        low.lerp(&high, 0.5)
    }

    /// The box with its arrows.
    pub(super) fn ends_m(&self) -> [Vector; 2] {
        let arrow = self.arrow_m;
        [self.low_m - 1.4 * arrow * Vector::y(), self.high_m.add_scalar(arrow)]
    }

    /// Corners of the box with its arrows.
    pub(super) fn corners_m(&self) -> [Vector; 8] {
        let ends = self.ends_m();
        std::array::from_fn(|k| Vector::from_fn(|i, _| ends[k >> i & 1][i]))
    }
}

impl Pane<'_> {
    fn screen(&self, point_m: Vector) -> Pixel {
        let (x, y) = self.camera.flat(point_m);
        (self.middle.0 + self.pixels_per_m * x, self.middle.1 - self.pixels_per_m * y)
    }

    /// Draws everything.
    pub(super) fn draw(&self, pen: &mut Pen) {
        let surfaces = &self.scene.surfaces;
        let order = self.camera.painting_order(surfaces);
        let outlines: Vec<Vec<Pixel>> = surfaces.iter().map(|surface| self.outline(surface)).collect();
        for &index in &order {
            self.surface(pen, &surfaces[index], &outlines[index]);
        }
        let mut labels = Labels::default();
        for axis in &self.scene.axes {
            self.rotation(pen, &mut labels, axis, &outlines);
        }
        for arrow in &self.scene.arrows {
            self.arrow(pen, &mut labels, arrow, &outlines);
        }
        for tank_m in &self.scene.tanks_m {
            let at = self.screen(*tank_m);
            pen.circle(at, TANK_RADIUS_PX, "fill=\"none\" stroke=\"#262b33\" stroke-width=\"1.3\"");
            labels.keep_off_sign(at, 2.0 * TANK_RADIUS_PX);
        }
        self.axes(pen, &mut labels, &outlines);
        let center = self.screen(self.scene.center_of_mass_m);
        pen.center_of_mass(center);
        labels.keep_off_sign(center, 15.0);
        if self.scene.parts.len() <= MAX_NAMES {
            self.names(pen, &mut labels, &order, &outlines);
        }
    }

    fn outline(&self, surface: &Surface) -> Vec<Pixel> {
        surface.corners.iter().map(|corner| self.screen(*corner)).collect()
    }

    fn surface(&self, pen: &mut Pen, surface: &Surface, outline: &[Pixel]) {
        let fill = surface.colour(self.camera.sees_front(surface), self.camera.viewer + 0.6 * LIGHT);
        let (edge, width) = match surface.finish {
            Finish::Facet | Finish::Nozzle => (fill.as_str(), 0.6),
            Finish::Plate | Finish::Cells => ("#2b3440", 1.1),
        };
        pen.polygon(
            outline,
            &format!("fill=\"{fill}\" stroke=\"{edge}\" stroke-width=\"{width}\" stroke-linejoin=\"round\""),
        );
        if surface.finish == Finish::Cells && self.camera.sees_front(surface) && outline.len() == 4 {
            let lines = surface.cell_lines().into_iter().map(|line| line.map(|end| self.screen(end)));
            pen.lines(lines, "stroke=\"#c9d8f0\" stroke-opacity=\"0.5\" stroke-width=\"0.7\"");
        }
    }

    /// Whether a surface stands before a point.
    fn is_hidden(&self, point_m: Vector, outlines: &[Vec<Pixel>]) -> bool {
        let at = self.screen(point_m);
        let mut all = self.scene.surfaces.iter().zip(outlines);
        all.any(|(surface, outline)| contains(outline, at) && self.camera.hides(surface, point_m))
    }

    /// A line in space, faint where it is hidden.
    fn line(&self, pen: &mut Pen, ends_m: [Vector; 2], outlines: &[Vec<Pixel>], attributes: &str) {
        const STEPS: u32 = 80;
        let at = |k: u32| ends_m[0].lerp(&ends_m[1], f64::from(k) / f64::from(STEPS));
        let mut runs: [Vec<Vec<Pixel>>; 2] = [Vec::new(), Vec::new()];
        let mut last = None;
        for k in 0..STEPS {
            let hidden = self.is_hidden(at(k).lerp(&at(k + 1), 0.5), outlines);
            let of_kind = &mut runs[usize::from(hidden)];
            if last != Some(hidden) {
                of_kind.push(vec![self.screen(at(k))]);
            }
            if let Some(run) = of_kind.last_mut() {
                run.push(self.screen(at(k + 1)));
            }
            last = Some(hidden);
        }
        for (runs, opacity) in runs.iter().zip(["", " stroke-opacity=\"0.35\""]) {
            let ends = runs.iter().filter_map(|run| Some([*run.first()?, *run.last()?]));
            pen.lines(ends, &format!("{attributes}{opacity}"));
        }
    }

    /// The body axes out of the origin, and the Sun.
    fn axes(&self, pen: &mut Pen, labels: &mut Labels, outlines: &[Vec<Pixel>]) {
        let [_, tips] = self.reach_m.ends_m();
        for (i, name) in ["X", "Y", "Z"].into_iter().enumerate() {
            let tip_m = tips[i] * Vector::ith(i, 1.0);
            let (origin, tip) = (self.screen(Vector::zeros()), self.screen(tip_m));
            // One that points at the viewer or away has no length: the heading names it.
            if let Some((x, y)) = direction(origin, tip) {
                let stroke = AXIS_COLOURS[i];
                self.line(
                    pen,
                    [Vector::zeros(), tip_m],
                    outlines,
                    &format!("stroke=\"{stroke}\" stroke-width=\"1.5\""),
                );
                pen.arrow_head(origin, tip, stroke);
                let at = (tip.0 + 11.0 * x, tip.1 + 11.0 * y);
                pen.label(at, 14.0, stroke, name);
                labels.keep_off(&[origin, tip]);
                labels.keep_off_sign(at, 16.0);
            }
        }
        let from_m = (-self.reach_m.low_m[1] + 0.25 * self.reach_m.arrow_m) * TO_SUN;
        let tip_m = from_m + 0.9 * self.reach_m.arrow_m * TO_SUN;
        let (from, tip) = (self.screen(from_m), self.screen(tip_m));
        if let Some((x, y)) = direction(from, tip).filter(|_| self.scene.has_sun) {
            pen.lines([[from, tip]], "stroke=\"#e69f00\" stroke-width=\"2\"");
            pen.arrow_head(from, tip, "#e69f00");
            let sun = (tip.0 + 13.0 * x, tip.1 + 13.0 * y);
            pen.sun(sun);
            let beside = (sun.0 + 26.0 * x, sun.1 + 19.0 * y);
            pen.label(beside, NAME_SIZE, GREY, "Sun");
            labels.keep_off(&[from, sun]);
            labels.keep_off_sign(beside, 24.0);
        }
    }

    /// A direction that something on the body has.
    fn arrow(&self, pen: &mut Pen, labels: &mut Labels, arrow: &Arrow, outlines: &[Vec<Pixel>]) {
        let (from, tip) = (self.screen(arrow.from_m), self.screen(arrow.to_m));
        // One that points at the viewer or away has no length.
        if direction(from, tip).is_some() {
            let stroke = format!("stroke=\"{}\" stroke-width=\"1.4\"", arrow.colour);
            self.line(pen, [arrow.from_m, arrow.to_m], outlines, &stroke);
            pen.arrow_head(from, tip, arrow.colour);
            labels.keep_off(&[from, tip]);
        }
    }

    /// A dash-dotted axis and an arrow about it.
    fn rotation(&self, pen: &mut Pen, labels: &mut Labels, axis: &Axis, outlines: &[Vec<Pixel>]) {
        let ends = axis.ends_m();
        let stroke = format!("stroke=\"{ROTATION_COLOUR}\" stroke-width=\"1.3\"");
        self.line(pen, ends, outlines, &format!("{stroke} stroke-dasharray=\"9 3 2 3\""));
        labels.keep_off(&ends.map(|end| self.screen(end)));
        let arc = self.arc(axis);
        if let [.., before, tip] = arc[..] {
            pen.lines([&arc], &stroke);
            pen.arrow_head(before, tip, ROTATION_COLOUR);
            labels.keep_off(&arc);
        }
    }

    /// The arrow's line: the side of a circle about the axis that one sees. A circle seen from its edge is opened a little.
    fn arc(&self, axis: &Axis) -> Vec<Pixel> {
        const STEPS: u32 = 24;
        const RADIUS_PX: f64 = 13.0;
        let viewer = self.camera.viewer;
        let toward = axis.direction.dot(&viewer);
        // At the end that is farther out, a little before it.
        let outward = if axis.center_m.dot(&axis.direction) < -1e-9 { -1.0 } else { 1.0 };
        let center_m = axis.center_m + 0.93 * outward * axis.half_length_m * axis.direction;
        let Some(side) = unit(axis.direction.cross(&viewer)) else {
            return self.circle_arc(self.screen(axis.center_m), toward);
        };
        if toward.abs() > 0.97 {
            return self.circle_arc(self.screen(axis.center_m), toward);
        }
        let center = self.screen(center_m);
        let step_m = RADIUS_PX / self.pixels_per_m;
        let pixel = |direction: Vector| {
            let to = self.screen(center_m + step_m * direction);
            (to.0 - center.0, to.1 - center.1)
        };
        let (across, along_axis) = (pixel(side), pixel(axis.direction));
        let length = (along_axis.0 * along_axis.0 + along_axis.1 * along_axis.1).sqrt().max(1e-9);
        let open = toward.abs().max(0.35) * RADIUS_PX / length * if toward < 0.0 { 1.0 } else { -1.0 };
        // Right-handed about the axis, `side` goes over the viewer's side: from -`side` to `side`.
        (0..=STEPS)
            .map(|k| {
                let (sine, cosine) =
                    ((f64::from(k) / f64::from(STEPS) * 1.3 - 0.15) * std::f64::consts::PI).sin_cos();
                let (a, b) = (-cosine, sine * open);
                (center.0 + a * across.0 + b * along_axis.0, center.1 + a * across.1 + b * along_axis.1)
            })
            .collect()
    }

    /// About an axis that points at the viewer, or away.
    fn circle_arc(&self, center: Pixel, toward: f64) -> Vec<Pixel> {
        const RADIUS_PX: f64 = 20.0;
        (0..=30u32)
            .map(|k| {
                let turn = f64::from(k) / 30.0 * 1.5 * std::f64::consts::PI * toward.signum();
                (center.0 + RADIUS_PX * turn.cos(), center.1 - RADIUS_PX * turn.sin())
            })
            .collect()
    }

    /// Names where they fit on what they name, else signs.
    fn names(&self, pen: &mut Pen, labels: &mut Labels, order: &[usize], outlines: &[Vec<Pixel>]) {
        let surfaces = &self.scene.surfaces;
        for (number, part) in self.scene.parts.iter().enumerate() {
            if let Some(beside_m) = part.beside_m {
                if part.is_inside || !self.is_hidden(beside_m, outlines) {
                    let name = if part.is_inside { &part.sign } else { &part.name };
                    let at = self.screen(beside_m);
                    // Beside all surfaces if there is room.
                    let is_bare = |at: Pixel| !outlines.iter().any(|outline| contains(outline, at));
                    let placed = labels
                        .place(name, rings(at), is_bare)
                        .or_else(|| labels.place(name, rings(at), |_| true));
                    if let Some(at) = placed {
                        pen.label(at, NAME_SIZE, INK, name);
                    }
                }
                continue;
            }
            let own = surfaces.iter().zip(outlines).filter(|(surface, _)| surface.part == number);
            let corners: Vec<Pixel> = own.flat_map(|(_, outline)| outline.iter().copied()).collect();
            let candidates = grid(&corners);
            let top = |at: Pixel| order.iter().rev().find(|index| contains(&outlines[**index], at));
            let is_own = |at: Pixel| top(at).is_some_and(|index| surfaces[*index].part == number);
            let fits = [&part.name, &part.sign];
            let placed = fits.iter().find_map(|text| {
                labels.place(text, candidates.iter().copied(), is_own).map(|at| (at, text.as_str()))
            });
            if let Some((at, text)) = placed {
                pen.label(at, NAME_SIZE, INK, text);
            }
        }
    }
}

/// The unit vector from one pixel to another; `None` where they are nearly one.
fn direction(from: Pixel, to: Pixel) -> Option<Pixel> {
    let (x, y) = (to.0 - from.0, to.1 - from.1);
    let length = (x * x + y * y).sqrt();
    (length > 6.0).then(|| (x / length, y / length))
}

/// A point and others around it, the near ones first.
fn rings(at: Pixel) -> impl Iterator<Item = Pixel> {
    let around = move |radius: f64| {
        (0..16).map(move |k| {
            let (sine, cosine) = (f64::from(k) * std::f64::consts::FRAC_PI_8).sin_cos();
            (at.0 + 1.3 * radius * cosine, at.1 - radius * sine)
        })
    };
    [0.0, 9.0, 17.0, 25.0].into_iter().flat_map(around)
}

/// Points of the rectangle around some, those near its middle first.
fn grid(corners: &[Pixel]) -> Vec<Pixel> {
    const HALF: i32 = 8;
    let [low, high] = bounds(corners.iter().copied());
    if corners.is_empty() {
        return Vec::new();
    }
    let mut steps: Vec<(i32, i32)> =
        (-HALF..=HALF).flat_map(|a| (-HALF..=HALF).map(move |b| (a, b))).collect();
    steps.sort_by_key(|(a, b)| a * a + b * b);
    let at = |low: f64, high: f64, k: i32| {
        (low + high) / 2.0 + (high - low) / 2.0 * f64::from(k) / f64::from(HALF)
    };
    steps.into_iter().map(|(a, b)| (at(low.0, high.0, a), at(low.1, high.1, b))).collect()
}

/// A bar of a round length, at most so wide, from a pixel to the right.
pub(super) fn scale_bar(pen: &mut Pen, at: Pixel, pixels_per_m: f64, most_px: f64) {
    let most_m = most_px / pixels_per_m;
    let decade = 10f64.powf(most_m.log10().floor());
    let length_m =
        [5.0, 2.0, 1.0].into_iter().map(|k| k * decade).find(|length| *length <= most_m).unwrap_or(decade);
    let end = (at.0 + length_m * pixels_per_m, at.1);
    let tick = |x: f64| [(x, at.1 - 4.0), (x, at.1 + 4.0)];
    pen.lines(
        [[at, end], tick(at.0), tick(end.0)],
        &format!("class=\"scale\" stroke=\"{INK}\" stroke-width=\"1.3\""),
    );
    let text = format!("{} m", terminal::short(length_m));
    pen.text((end.0 + 8.0, at.1 + 4.0), 12.0, "start", TEXT, &text);
}
