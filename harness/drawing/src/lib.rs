//! One drawing kit: SVG elements, axes, charts, a camera; what is drawn is SVG text, or PNG without texts.
#![cfg_attr(test, allow(clippy::disallowed_methods, reason = "tests make their own files"))]

mod axes;
mod camera;
mod chart;
mod envelope;
mod frame;
mod labels;
mod legend;
mod pen;
mod picture;
mod plane;
pub mod scenes;
mod series;
mod shading;
mod surface;
#[cfg(test)]
mod tests;
mod tornado;

pub use axes::{is_drawable, round_up, tick_text, ticks};
pub use camera::{Camera, contains};
pub use chart::Chart;
pub use envelope::Envelope;
pub use frame::{Axes, Frame, thinned};
pub use labels::{Labels, NAME_SIZE};
pub use pen::{BESIDE, COLOURS, GREY, HEADING, INK, Pen, Pixel, TEXT, png, width_px};
pub use picture::{DrawingError, Picture, is_chart, svg};
pub use plane::{PlaneChart, PlanePanel, ellipse};
pub use series::{Band, Mark, Panel, Series};
pub use shading::{Shading, mixed};
pub use surface::{Finish, Surface, Vector, unit};
pub use tornado::TornadoChart;
