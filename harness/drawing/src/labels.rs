//! Positions of names in a picture, so that none covers another.

use super::pen::{Pixel, width_px};

/// Size of names, in px.
pub const NAME_SIZE: f64 = 12.0;

/// A rectangle in pixels.
#[derive(Clone, Copy)]
struct Area {
    low: Pixel,
    high: Pixel,
}

impl Area {
    fn about((x, y): Pixel, width: f64, height: f64) -> Self {
        Self { low: (x - width / 2.0, y - height / 2.0), high: (x + width / 2.0, y + height / 2.0) }
    }

    fn meets(&self, other: &Self) -> bool {
        self.low.0 < other.high.0
            && other.low.0 < self.high.0
            && self.low.1 < other.high.1
            && other.low.1 < self.high.1
    }

    /// Corners and points between.
    fn samples(&self) -> impl Iterator<Item = Pixel> {
        let (low, high) = (self.low, self.high);
        let at = move |a: f64, b: f64| (low.0 + a * (high.0 - low.0), low.1 + b * (high.1 - low.1));
        [0.0, 0.25, 0.5, 0.75, 1.0].into_iter().flat_map(move |a| [0.0, 0.5, 1.0].map(|b| at(a, b)))
    }
}

/// Areas that are occupied.
#[derive(Default)]
pub struct Labels(Vec<Area>);

impl Labels {
    /// Keeps names off a line.
    pub fn keep_off(&mut self, line: &[Pixel]) {
        for pair in line.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            let length = ((b.0 - a.0) * (b.0 - a.0) + (b.1 - a.1) * (b.1 - a.1)).sqrt();
            let steps = (length / 5.0).ceil().clamp(1.0, 500.0);
            for k in 0..=steps as u32 {
                let part = f64::from(k) / steps;
                self.0.push(Area::about((a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1)), 4.0, 4.0));
            }
        }
    }

    /// Keeps names off a sign.
    pub fn keep_off_sign(&mut self, at: Pixel, size: f64) {
        self.0.push(Area::about(at, size, size));
    }

    /// Takes the first place at which a text is wholly where `may_stand` allows and meets nothing.
    pub fn place(
        &mut self,
        text: &str,
        candidates: impl IntoIterator<Item = Pixel>,
        may_stand: impl Fn(Pixel) -> bool,
    ) -> Option<Pixel> {
        let area_at = |at| Area::about(at, width_px(text, NAME_SIZE) + 4.0, NAME_SIZE + 2.0);
        let is_free = |at: &Pixel| {
            let area = area_at(*at);
            !self.0.iter().any(|taken| taken.meets(&area)) && area.samples().all(&may_stand)
        };
        let at = candidates.into_iter().find(is_free)?;
        self.0.push(area_at(at));
        Some(at)
    }
}
