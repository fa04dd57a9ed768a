//! Measures, colours and types of the drawing.

use plotters::{coord::Shift, prelude::*};

/// Drawing units per pixel at which the picture shows: the library rounds coordinates to whole units, and a curve drawn
/// in whole pixels is a staircase.
pub(super) const FINE: u32 = 4;

pub(super) const WIDTH: u32 = 960 * FINE;
pub(super) const PANEL_HEIGHT: u32 = 210 * FINE;
pub(super) const SINGLE_HEIGHT: u32 = 420 * FINE;
pub(super) const TITLE_HEIGHT: u32 = 44 * FINE;
pub(super) const TOP: u32 = 14 * FINE;
pub(super) const X_AXIS_HEIGHT: u32 = 52 * FINE;
pub(super) const Y_AXIS_WIDTH: u32 = 92 * FINE;
pub(super) const LEFT: u32 = 14 * FINE;
pub(super) const BOTTOM: u32 = 12 * FINE;
pub(super) const RIGHT: u32 = 24 * FINE;

pub(super) const FONT: &str = "'Source Sans 3','Segoe UI','Helvetica Neue',Arial,sans-serif";
pub(super) const INK: RGBColor = RGBColor(0x26, 0x2b, 0x33);
pub(super) const QUIET: RGBColor = RGBColor(0x5c, 0x65, 0x70);
pub(super) const GRID: RGBColor = RGBColor(0xe3, 0xe6, 0xea);
pub(super) const SHADE: RGBColor = RGBColor(0xe9, 0xeb, 0xee);
pub(super) const FRAME: RGBColor = RGBColor(0x9a, 0xa2, 0xac);

/// Colours of a panel's lines in their order; distinguishable with any colour vision (Okabe and Ito).
pub const COLOURS: [RGBColor; 7] = [
    RGBColor(0x00, 0x72, 0xb2),
    RGBColor(0xd5, 0x5e, 0x00),
    RGBColor(0x00, 0x9e, 0x73),
    RGBColor(0xcc, 0x79, 0xa7),
    RGBColor(0xe6, 0x9f, 0x00),
    RGBColor(0x56, 0xb4, 0xe9),
    RGBColor(0x6b, 0x6b, 0x6b),
];

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type Drawn = Result<(), Box<dyn std::error::Error>>;

pub(super) fn pixel(length: u32) -> i32 {
    i32::try_from(length).unwrap_or(i32::MAX)
}
