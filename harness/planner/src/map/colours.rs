//! Bands of a signed quantity: their edges at round values, and their colours from blue over white to red.

use drawing::{mixed, round_up};

/// Bands on each side of zero, about.
const BANDS: f64 = 7.0;
/// From the most negative to the most positive, equally apart.
const SCALE: [[f64; 3]; 9] = [
    [33.0, 74.0, 141.0],
    [67.0, 127.0, 186.0],
    [128.0, 176.0, 214.0],
    [200.0, 220.0, 236.0],
    [248.0, 248.0, 246.0],
    [248.0, 214.0, 196.0],
    [236.0, 150.0, 120.0],
    [206.0, 83.0, 70.0],
    [150.0, 22.0, 40.0],
];

/// Bands for values up to a greatest size.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bands {
    pub step: f64,
    /// On each side of zero.
    pub count: i32,
}

impl Bands {
    /// For values within plus and minus `greatest`; one band on each side where it is 0.
    pub(super) fn new(greatest: f64) -> Self {
        if greatest <= 0.0 || !greatest.is_finite() {
            return Self { step: 1.0, count: 1 };
        }
        let step = round_up(greatest / BANDS);
        Self { step, count: ((greatest / step) * (1.0 - 1e-9)).ceil().max(1.0) as i32 }
    }

    /// Numbers of the bands, upward; a band begins at its number of steps.
    pub(super) fn numbers(&self) -> std::ops::Range<i32> {
        -self.count..self.count
    }

    /// The colour of a band.
    pub(super) fn colour(&self, number: i32) -> String {
        let place = (f64::from(number) + 0.5) / f64::from(self.count);
        mixed(&SCALE, 0.5 * (place + 1.0))
    }
}

#[cfg(test)]
mod tests {
    //! Bands cover the values with round steps; colours are opposite on both sides.
    use super::*;

    #[test]
    fn bands_cover_the_values_with_round_edges() {
        for greatest in [0.37, 1.0, 6.9, 7.0, 7.1, 123.0, 3e-8] {
            let bands = Bands::new(greatest);
            let reach = bands.step * f64::from(bands.count);
            assert!(
                reach >= greatest * (1.0 - 1e-9) && reach - bands.step < greatest,
                "{greatest}: {bands:?}"
            );
            assert!((3..=8).contains(&bands.count), "{greatest}: {bands:?}");
        }
        assert_eq!((round_up(0.013), round_up(2.0), round_up(51.0)), (0.02, 2.0, 100.0));
        let bands = Bands::new(7.0);
        assert!(
            bands.colour(-bands.count).starts_with("#2") && bands.colour(bands.count - 1).starts_with("#a")
        );
    }
}
