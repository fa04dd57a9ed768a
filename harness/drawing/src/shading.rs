//! Shading of a quantity: colours from its least to its greatest value, and their scale.

use super::{
    axes::{round_up, tick_text, ticks},
    frame::Frame,
    pen::{BESIDE, Pen, Pixel},
};

/// Width of a scale with its numbers, in px.
pub(super) const SCALE_WIDTH: f64 = 50.0;
/// Shades that are distinguished.
const SHADES: usize = 32;
/// From the least to the greatest, equally apart: of ever less luminance, so that order shows without colour too (ColorBrewer's YlGnBu).
const SCALE: [[f64; 3]; 9] = [
    [255.0, 255.0, 217.0],
    [237.0, 248.0, 177.0],
    [199.0, 233.0, 180.0],
    [127.0, 205.0, 187.0],
    [65.0, 182.0, 196.0],
    [29.0, 145.0, 192.0],
    [34.0, 94.0, 168.0],
    [37.0, 52.0, 148.0],
    [8.0, 29.0, 88.0],
];

/// Colours for values from a least to a greatest one.
#[derive(Clone, Debug, PartialEq)]
pub struct Shading {
    /// Value of the first colour, 0 of what is not negative.
    pub least: f64,
    /// Value of the last colour.
    pub greatest: f64,
    /// Unit, above the scale.
    pub unit: String,
}

impl Shading {
    /// Number of the shade of a value.
    fn shade(&self, value: f64) -> usize {
        let share = if self.span() > 0.0 { (value - self.least) / self.span() } else { 0.0 };
        ((share * SHADES as f64) as usize).min(SHADES - 1)
    }

    fn span(&self) -> f64 {
        self.greatest - self.least
    }

    /// Fills cells by their values, those of a shade at once.
    pub(super) fn draw(&self, pen: &mut Pen, cells: &[(Vec<Pixel>, f64)]) {
        for number in 0..SHADES {
            let of_shade = cells.iter().filter(|(_, value)| self.shade(*value) == number);
            let colour = colour(number);
            // With a stroke, for without one the ground shows between neighbours.
            pen.filled(of_shade.map(|(corners, _)| corners.as_slice()), &colour);
        }
    }

    /// The scale, to the right of a frame.
    pub(super) fn draw_scale(&self, pen: &mut Pen, frame: &Frame) {
        let (left, width) = (frame.left + frame.width + 10.0, 12.0);
        let y = |share: f64| frame.top + frame.height * (1.0 - share);
        for number in 0..SHADES {
            let [low, high] = [number, number + 1].map(|at| y(at as f64 / SHADES as f64));
            pen.rect((left, high), (left + width, low), &format!("fill=\"{}\"", colour(number)));
        }
        if self.span() > 0.0 {
            let step = round_up(self.span() / 7.0);
            for value in ticks([self.least, self.greatest], step) {
                let at = (left + width + 4.0, y((value - self.least) / self.span()) + 4.0);
                pen.text(at, 11.0, "start", BESIDE, &tick_text(value, step));
            }
        }
        pen.text((left, frame.top - 8.0), 11.0, "start", BESIDE, &self.unit);
    }
}

fn colour(number: usize) -> String {
    mixed(&SCALE, (number as f64 + 0.5) / SHADES as f64)
}

/// The colour at a share of the way through colours that are equally apart.
pub fn mixed(scale: &[[f64; 3]], share: f64) -> String {
    let at = share.clamp(0.0, 1.0) * (scale.len() - 1) as f64;
    let below = (at.floor() as usize).min(scale.len().saturating_sub(2));
    let part = at - below as f64;
    let [red, green, blue] =
        [0, 1, 2].map(|k| (scale[below][k] + part * (scale[below + 1][k] - scale[below][k])).round() as u8);
    format!("#{red:02x}{green:02x}{blue:02x}")
}

#[cfg(test)]
mod tests {
    //! More of a quantity is darker.
    use super::*;

    #[test]
    fn shades_grow_ever_darker_from_the_least_to_the_greatest() {
        for (least, greatest) in [(0.0, 4.0), (-3.0, 1.0), (10.0, 14.0)] {
            let shading = Shading { least, greatest, unit: String::new() };
            let shades = [0.0, 1.999, 4.0].map(|above| shading.shade(least + above));
            assert_eq!(shades, [0, SHADES / 2 - 1, SHADES - 1]);
        }
        // Relative luminance by its weights of red, green and blue (ITU-R BT.709).
        let luminance = |number: usize| {
            let text = colour(number);
            let part = |at: usize| f64::from(u8::from_str_radix(&text[at..at + 2], 16).unwrap());
            0.2126 * part(1) + 0.7152 * part(3) + 0.0722 * part(5)
        };
        assert!((1..SHADES).all(|number| luminance(number) < luminance(number - 1)));
    }

    #[test]
    fn nothing_at_all_has_the_first_shade() {
        for value in [0.0, -2.0] {
            let shading = Shading { least: value, greatest: value, unit: String::new() };
            assert_eq!(shading.shade(value), 0);
        }
    }
}
