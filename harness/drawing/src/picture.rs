//! Common parts of charts: width, head, several charts below each other in one SVG.

use super::pen::{HEADING, Pen};

/// Width of every chart in px.
pub(super) const WIDTH: f64 = 960.0;
/// Left edge of what is plotted.
pub(super) const PLOT_LEFT: f64 = 106.0;
/// Distance of the vertical labels from it.
pub(super) const LABEL: f64 = 76.0;
pub(super) const RIGHT: f64 = 24.0;
pub(super) const TITLE_HEIGHT: f64 = 44.0;
/// Height of one of several panels.
pub(super) const PANEL_HEIGHT: f64 = 210.0;
/// Numbers and label of the horizontal axis.
pub(super) const X_AXIS_HEIGHT: f64 = 52.0;
/// Ground of spans and areas that are marked.
pub(super) const SHADE: &str = "fill=\"#e9ebee\"";

/// A chart.
pub trait Picture {
    /// Title; empty for none.
    fn title(&self) -> &str;
    /// Height in px; `None` where there is nothing to draw.
    fn height(&self) -> Option<f64>;
    /// Draws it from this height down.
    fn draw(&self, pen: &mut Pen, top: f64);
}

/// A chart that cannot be drawn.
#[derive(Debug, thiserror::Error)]
#[error("the chart {0:?} has no finite point to draw")]
pub struct DrawingError(String);

/// Charts below each other as SVG text.
///
/// # Errors
/// A chart without anything to draw.
pub fn svg(pictures: &[&dyn Picture]) -> Result<String, DrawingError> {
    let height =
        |picture: &&dyn Picture| picture.height().ok_or_else(|| DrawingError(picture.title().to_owned()));
    let heights = pictures.iter().map(height).collect::<Result<Vec<f64>, _>>()?;
    let mut pen = Pen::new(WIDTH, heights.iter().sum(), pictures.first().map_or("", |first| first.title()));
    let mut top = 0.0;
    for (picture, height) in pictures.iter().zip(heights) {
        if !picture.title().is_empty() {
            let at = (PLOT_LEFT, top + 0.5 * TITLE_HEIGHT + 7.0);
            pen.text(at, 17.0, "start", HEADING, picture.title());
        }
        picture.draw(&mut pen, top);
        top += height;
    }
    Ok(pen.finish())
}

/// Whether a text begins as the charts do that are drawn here, or were drawn by earlier versions.
pub fn is_chart(text: &str) -> bool {
    let head = text.lines().next().unwrap_or_default();
    let has_view = ["960", "3840"].iter().any(|width| head.contains(&format!("viewBox=\"0 0 {width} ")));
    head.starts_with("<svg ") && head.contains(&format!(" width=\"{WIDTH}\" height=\"")) && has_view
}
