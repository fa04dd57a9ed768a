//! Golden-section search for the minimum of a function of one variable.
//!
//! Equation: f(x) is least, for a function with one local minimum in a bracket.
//! Method: two inner points divide the bracket by the golden ratio; the outer part beyond the greater value goes, and the
//! other inner point is kept.
//! Order: linear, a factor of 0.618 a step at one evaluation.
//! Error measure: the width of the bracket; below the square root of rounding the values at both points are equal.
//! Reference: Kiefer, Proceedings of the American Mathematical Society 4, 1953; Press et al., Numerical Recipes, sec. 10.2.

/// The golden ratio less one.
const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;

/// Interval that holds a minimum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bracket {
    /// Lower end.
    pub low: f64,
    /// Upper end.
    pub high: f64,
}

impl Bracket {
    /// Returns the middle.
    pub fn middle(&self) -> f64 {
        0.5 * (self.low + self.high)
    }
}

/// Shrinks a bracket about the minimum of `function` by `steps` golden sections; of equal values the left one is kept.
pub fn golden_section(bracket: Bracket, steps: usize, mut function: impl FnMut(f64) -> f64) -> Bracket {
    let Bracket { mut low, mut high } = bracket;
    let (mut left, mut right) = (high - GOLDEN_RATIO * (high - low), low + GOLDEN_RATIO * (high - low));
    let (mut at_left, mut at_right) = (function(left), function(right));
    for _ in 0..steps {
        if at_left <= at_right {
            (high, right, at_right) = (right, left, at_left);
            left = high - GOLDEN_RATIO * (high - low);
            at_left = function(left);
        } else {
            (low, left, at_left) = (left, right, at_right);
            right = low + GOLDEN_RATIO * (high - low);
            at_right = function(right);
        }
    }
    Bracket { low, high }
}

#[cfg(test)]
mod tests {
    //! The bracket keeps a minimum, one at its end too.
    use super::*;

    #[test]
    fn the_bracket_keeps_the_minimum() {
        for lowest in [-1.0, -0.3, 0.0, 0.77, 2.0] {
            let bracket =
                golden_section(Bracket { low: -1.0, high: 2.0 }, 30, |x| (x - lowest) * (x - lowest));
            assert!(bracket.high - bracket.low < 2e-6, "{bracket:?}");
            assert!((bracket.middle() - lowest).abs() < 2e-6, "{bracket:?} {lowest}");
        }
    }
}
