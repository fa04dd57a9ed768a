//! The sheet: views with one scale, headings, legend.

use super::{
    pane::{Extent, Pane, scale_bar},
    parts::{Axis, Part},
    scene::Scene,
};
use crate::{BESIDE, Camera, Finish, HEADING, Pen, TEXT, Vector, camera::bounds, width_px};

/// A way to look at the spacecraft.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// From above, +Z.
    Top,
    /// From a corner.
    Perspective,
    /// From -Y.
    Front,
    /// From +X.
    Side,
}

impl View {
    /// In the order of the sheet: the top above the front, the side to its right (third-angle projection).
    pub const ALL: [Self; 4] = [Self::Top, Self::Perspective, Self::Front, Self::Side];

    fn viewer(self, scene: &Scene) -> Vector {
        match self {
            Self::Top => Vector::z(),
            Self::Perspective => corner_of_view(scene),
            Self::Front => -Vector::y(),
            Self::Side => Vector::x(),
        }
    }

    fn camera(self, scene: &Scene, reach: &Extent) -> Option<Camera> {
        let ([low, high], viewer) = (reach.ends_m(), self.viewer(scene));
        Camera::new(viewer, reach.middle_m(), (high - low).norm(), self == Self::Perspective)
    }

    fn heading(self, scene: &Scene) -> [&'static str; 2] {
        match self {
            Self::Top => ["Top", "from +Z"],
            Self::Perspective if corner_of_view(scene)[2] < 0.0 => ["Perspective", "from below"],
            Self::Perspective => ["Perspective", "from above"],
            Self::Front if scene.has_sun => ["Front", "from \u{2212}Y, as the Sun sees it"],
            Self::Front => ["Front", "from \u{2212}Y"],
            Self::Side => ["Side", "from +X"],
        }
    }
}

/// From where the perspective looks: from above, unless panels show their edge there.
fn corner_of_view(scene: &Scene) -> Vector {
    let [above, below] = [0.42, -0.42].map(|z| {
        let viewer = Vector::new(0.52, -0.75, z);
        let cells = scene.surfaces.iter().filter(|surface| surface.finish == Finish::Cells);
        (viewer, cells.map(|surface| surface.normal.dot(&viewer).abs()).sum::<f64>())
    });
    if above.1 < 0.5 * below.1 { below.0 } else { above.0 }
}

const PANE_WIDTH: f64 = 460.0;
const PANE_HEIGHT: f64 = 360.0;
/// How much larger a view is that stands alone.
const ALONE: f64 = 1.5;
const TITLE_HEIGHT: f64 = 40.0;
const HEADING_HEIGHT: f64 = 26.0;
const FOOT_HEIGHT: f64 = 26.0;
const MARGIN: f64 = 22.0;
/// Height of a view beside what is drawn in it.
const AROUND: f64 = HEADING_HEIGHT + FOOT_HEIGHT + 2.0 * MARGIN;
/// Height of a view at least.
const MIN_HEIGHT: f64 = 190.0;
const ROW: f64 = 18.0;
const LEGEND_SIZE: f64 = 12.5;
/// Entries of the legend at most.
const MAX_ENTRIES: usize = 60;

/// The sheet with these views; `None` where nothing has an extent.
pub fn svg(scene: &Scene, views: &[View]) -> Option<String> {
    let reach = Extent::new(scene)?;
    let columns = if views.len() == 1 { 1 } else { 2 };
    let grow = if views.len() == 1 { ALONE } else { 1.0 };
    let (pane_width, most_height) = (grow * PANE_WIDTH, grow * PANE_HEIGHT);
    let inside = (pane_width - 2.0 * MARGIN, most_height - AROUND);
    let cameras: Vec<Camera> = views.iter().map(|view| view.camera(scene, &reach)).collect::<Option<_>>()?;
    // Of each view the extent, and how far its middle lies off the target.
    let drawn_m: Vec<Vector> = drawn_m(scene, &reach);
    let frames: Vec<Frame> = views
        .iter()
        .zip(&cameras)
        .map(|(view, camera)| match view {
            View::Perspective => Frame::new(camera, &drawn_m),
            // One box for all, so that views line up.
            _ => Frame::new(camera, &reach.corners_m()),
        })
        .collect();
    let fit = |frame: &Frame| (inside.0 / frame.size.0).min(inside.1 / frame.size.1);
    let is_parallel = |view: &View| *view != View::Perspective;
    let shared = views.iter().zip(&frames).filter(|(view, _)| is_parallel(view)).map(|(_, frame)| fit(frame));
    let shared = shared.fold(f64::INFINITY, f64::min);
    let scales: Vec<f64> = views
        .iter()
        .zip(&frames)
        .map(|(view, frame)| if is_parallel(view) { shared } else { fit(frame) })
        .collect();
    let heights: Vec<f64> =
        frames.iter().zip(&scales).map(|(frame, scale)| frame.size.1 * scale + AROUND).collect();
    let row_heights: Vec<f64> =
        heights.chunks(columns).map(|row| row.iter().copied().fold(MIN_HEIGHT, f64::max)).collect();
    let width = pane_width * columns as f64;
    let legend_top = TITLE_HEIGHT + row_heights.iter().sum::<f64>();
    let legend = Legend::new(scene, width);
    let mut pen = Pen::new(width, legend_top + legend.height(), &scene.name);
    pen.text((MARGIN, 27.0), 18.0, "start", HEADING, &scene.name);
    for (index, ((view, camera), frame)) in views.iter().zip(&cameras).zip(&frames).enumerate() {
        let (row, pixels_per_m) = (index / columns, scales[index]);
        let left = (index % columns) as f64 * pane_width;
        let top = TITLE_HEIGHT + row_heights[..row].iter().sum::<f64>();
        let pane_height = row_heights[row];
        let inner_height = pane_height - HEADING_HEIGHT - FOOT_HEIGHT;
        let center = (left + pane_width / 2.0, top + HEADING_HEIGHT + inner_height / 2.0);
        let middle = (center.0 - pixels_per_m * frame.middle.0, center.1 + pixels_per_m * frame.middle.1);
        let [heading, from] = view.heading(scene);
        pen.text((left + MARGIN, top + 17.0), 14.0, "start", HEADING, heading);
        let beside = left + MARGIN + 1.15 * width_px(heading, 14.0) + 10.0;
        pen.text((beside, top + 17.0), 13.0, "start", BESIDE, from);
        Pane { scene, camera, middle, pixels_per_m, reach_m: &reach }.draw(&mut pen);
        if is_parallel(view) {
            scale_bar(&mut pen, (left + MARGIN, top + pane_height - 14.0), pixels_per_m, 0.25 * pane_width);
        }
    }
    legend.draw(&mut pen, scene, legend_top);
    Some(pen.finish())
}

/// The perspective alone, of this size and without any text.
pub(super) fn picture(scene: &Scene, (width, height): (f64, f64)) -> Option<String> {
    let reach = Extent::new(scene)?;
    let camera = View::Perspective.camera(scene, &reach)?;
    let frame = Frame::new(&camera, &drawn_m(scene, &reach));
    let pixels_per_m = ((width - 2.0 * MARGIN) / frame.size.0).min((height - 2.0 * MARGIN) / frame.size.1);
    let middle = (0.5 * width - pixels_per_m * frame.middle.0, 0.5 * height + pixels_per_m * frame.middle.1);
    let mut pen = Pen::new(width, height, &scene.name);
    Pane { scene, camera: &camera, middle, pixels_per_m, reach_m: &reach }.draw(&mut pen);
    Some(pen.finish())
}

/// Corners of surfaces, tips of axes, the Sun.
fn drawn_m(scene: &Scene, reach: &Extent) -> Vec<Vector> {
    let [low, high] = reach.ends_m();
    let tips = [0, 1, 2].map(|i| high[i] * Vector::ith(i, 1.0)).into_iter().chain([low.y * Vector::y()]);
    let ends = scene.axes.iter().flat_map(Axis::ends_m);
    let corners = scene.surfaces.iter().flat_map(|surface| surface.corners.iter().copied());
    let arrows = scene.arrows.iter().map(|arrow| arrow.to_m);
    corners.chain(ends).chain(tips).chain(arrows).collect()
}

/// Extent of some points in a camera's picture, in m.
struct Frame {
    size: (f64, f64),
    middle: (f64, f64),
}

impl Frame {
    fn new(camera: &Camera, points_m: &[Vector]) -> Self {
        let [low, high] = bounds(points_m.iter().map(|point| camera.flat(*point)));
        Self {
            size: (high.0 - low.0, high.1 - low.1),
            middle: ((low.0 + high.0) / 2.0, (low.1 + high.1) / 2.0),
        }
    }
}

/// Names with their signs in columns, then what lines and signs mean.
struct Legend {
    columns: usize,
    column_width: f64,
    sign_width: f64,
    name_width: f64,
    entries: usize,
    left_out: usize,
    notes: Vec<String>,
}

impl Legend {
    fn new(scene: &Scene, width: f64) -> Self {
        let entries = scene.parts.len().min(MAX_ENTRIES);
        let widest = |get: fn(&Part) -> &str| {
            let shown = scene.parts.iter().take(entries);
            shown.map(|part| width_px(get(part), LEGEND_SIZE)).fold(0.0, f64::max)
        };
        let (sign_width, name_width) = (widest(|it| &it.sign) + 8.0, widest(|it| &it.name) + 10.0);
        let column_width = sign_width + name_width + widest(|it| &it.what) + 18.0;
        let columns = ((width - 2.0 * MARGIN) / column_width).floor().clamp(1.0, 4.0) as usize;
        let [x, y, z] =
            <[f64; 3]>::from(scene.center_of_mass_m).map(|x| terminal::short((x * 1e4).round() / 1e4 + 0.0));
        let mut notes = vec![format!("centre of mass, at ({x}, {y}, {z}) m")];
        if !scene.axes.is_empty() {
            notes.push("axis of rotation; the arrow is the positive sense".to_owned());
        }
        let wide = ((width - 2.0 * MARGIN) / width_px("n", LEGEND_SIZE)) as usize;
        notes.extend(scene.remarks.iter().flat_map(|remark| wrapped(remark, wide)));
        let left_out = scene.parts.len() - entries;
        Self { columns, column_width, sign_width, name_width, entries, left_out, notes }
    }

    fn rows(&self) -> usize {
        self.entries.div_ceil(self.columns)
    }

    fn height(&self) -> f64 {
        let rows = self.rows() + self.notes.len() + usize::from(self.left_out > 0);
        ROW * rows as f64 + 2.0 * MARGIN
    }

    fn draw(&self, pen: &mut Pen, scene: &Scene, top: f64) {
        let mut y = top + MARGIN;
        let rows = self.rows().max(1);
        for (index, part) in scene.parts.iter().take(self.entries).enumerate() {
            let x = MARGIN + self.column_width * (index / rows) as f64;
            let y = y + ROW * (index % rows) as f64;
            pen.text((x, y), LEGEND_SIZE, "start", HEADING, &part.sign);
            pen.text((x + self.sign_width, y), LEGEND_SIZE, "start", TEXT, &part.name);
            pen.text((x + self.sign_width + self.name_width, y), LEGEND_SIZE, "start", BESIDE, &part.what);
        }
        y += ROW * self.rows() as f64;
        if self.left_out > 0 {
            pen.text((MARGIN, y), LEGEND_SIZE, "start", BESIDE, &format!("and {} more", self.left_out));
            y += ROW;
        }
        y += 6.0;
        for (index, note) in self.notes.iter().enumerate() {
            let has_sign = index == 0 || index == 1 && !scene.axes.is_empty();
            if index == 0 {
                pen.center_of_mass((MARGIN + 12.0, y - 4.0));
            } else if has_sign {
                pen.lines(
                    [[(MARGIN, y - 4.0), (MARGIN + 25.0, y - 4.0)]],
                    "stroke=\"#8e44ad\" stroke-width=\"1.3\" stroke-dasharray=\"9 3 2 3\"",
                );
            }
            let x = if has_sign { MARGIN + 34.0 } else { MARGIN };
            pen.text((x, y), LEGEND_SIZE, "start", BESIDE, note);
            y += ROW;
        }
    }
}

/// Breaks words into lines of at most `most` characters.
fn wrapped(text: &str, most: usize) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let has_room =
            lines.last().is_some_and(|line| line.is_empty() || line.len() + 1 + word.len() <= most);
        if !has_room {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            if !line.is_empty() {
                line.push(' ');
            }
            line.push_str(word);
        }
    }
    lines
}
