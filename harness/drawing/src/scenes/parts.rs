//! Parts of a picture: axes of rotation, directions of devices, entries of the legend.

use crate::{Finish, Surface, Vector, unit};

/// A line about which something turns, right-handed.
pub(crate) struct Axis {
    pub center_m: Vector,
    pub direction: Vector,
    /// Extent of the line to either side.
    pub half_length_m: f64,
}

impl Axis {
    /// The ends of the line.
    pub(crate) fn ends_m(&self) -> [Vector; 2] {
        [-1.0, 1.0].map(|end| self.center_m + end * self.half_length_m * self.direction)
    }
}

/// A direction that something on the body has: a wheel's axis, a boresight.
pub(crate) struct Arrow {
    pub from_m: Vector,
    pub to_m: Vector,
    pub colour: &'static str,
}

/// An entry of the legend.
pub struct Part {
    /// The short sign in the picture: `3`, `P1`, `T10`.
    pub sign: String,
    /// Name of the part.
    pub name: String,
    /// Area or force, and how it stands.
    pub what: String,
    /// Position of its sign if not on its surface.
    pub beside_m: Option<Vector>,
    /// Whether it is shown through the surfaces in front of it, by its sign.
    pub is_inside: bool,
}

/// A panel as texts name it: `panel +X`, whether or not its own name says that it is one.
pub fn panel_called(name: &str) -> String {
    called("panel", name)
}

/// A part as texts name it, whether or not its own name says what it is.
pub(super) fn called(kind: &str, name: &str) -> String {
    let says_so = name.get(..kind.len()).is_some_and(|start| start.eq_ignore_ascii_case(kind));
    if says_so { name.to_owned() } else { format!("{kind} {name}") }
}

impl Part {
    pub(super) fn new(sign: String, name: &str, what: String) -> Self {
        Self { sign, name: name.to_owned(), what, beside_m: None, is_inside: false }
    }
}

/// Colours of antennas, boresights, Sun sensors and wheels.
pub(super) const ANTENNA: &str = "#b5179e";
pub(super) const BORESIGHT: &str = "#0072b2";
pub(super) const SUN_SENSOR: &str = "#b35900";
pub(super) const WHEEL: &str = "#00795a";

/// Corners of the box around some surfaces.
pub(super) fn box_of<'s>(surfaces: impl Iterator<Item = &'s Surface>) -> Option<[Vector; 2]> {
    let mut corners = surfaces.flat_map(|surface| &surface.corners);
    let first = *corners.next()?;
    Some(corners.fold([first; 2], |[low, high], corner| [low.inf(corner), high.sup(corner)]))
}

/// To four digits.
pub(super) fn area(area_m2: f64) -> String {
    let decimals = (3.0 - area_m2.log10().floor()).clamp(0.0, 12.0) as usize;
    let rounded_m2 = format!("{area_m2:.decimals$}").parse().unwrap_or(area_m2);
    format!("{} m²", terminal::short(rounded_m2))
}

/// A cone from the throat to the exit.
pub(super) fn nozzle(throat_m: Vector, jet: Vector, length_m: f64, part: usize) -> Vec<Surface> {
    const SIDES: u32 = 10;
    let across = unit(jet.cross(&Vector::z())).or_else(|| unit(jet.cross(&Vector::x())));
    let Some(first) = across else { return Vec::new() };
    let second = jet.cross(&first);
    let exit_m = throat_m + length_m * jet;
    let rim = |k: u32| {
        let (sine, cosine) = (f64::from(k) * std::f64::consts::TAU / f64::from(SIDES)).sin_cos();
        exit_m + 0.32 * length_m * (cosine * first + sine * second)
    };
    let sides = (0..SIDES).map(|k| vec![throat_m, rim(k + 1), rim(k)]);
    let all = sides.chain([(0..SIDES).map(rim).collect()]);
    all.filter_map(|corners| Surface::facet(corners, Finish::Nozzle, part)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panel_is_called_one_once() {
        for (name, called) in [
            ("+X", "panel +X"),
            ("panel +X", "panel +X"),
            ("Panel", "Panel"),
            ("pan", "panel pan"),
            ("wing \u{e4}", "panel wing \u{e4}"),
        ] {
            assert_eq!(panel_called(name), called);
        }
    }
}
