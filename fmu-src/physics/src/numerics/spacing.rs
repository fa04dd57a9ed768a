//! How far neighbouring doubles are apart: what a time, and all that is compared with it, is known to.

/// Distance from `x` to the next double away from 0; at most one double lies nearer to any number of this size.
#[inline]
pub fn spacing(x: f64) -> f64 {
    let size = x.abs();
    size.next_up() - size
}

#[cfg(test)]
mod tests {
    //! Neighbours are neighbours.
    use super::*;

    #[test]
    fn nothing_lies_between_a_number_and_its_neighbour() {
        for x in [1e-300, 0.1, 1.0, 12.0, 1e6, 8e6, 1e9, -1e9, 1e15] {
            let step = spacing(x);
            assert_eq!(x + 0.25 * step, x);
            assert_ne!(x + step, x);
        }
        assert_eq!(spacing(1.0), f64::EPSILON);
        assert_eq!(spacing(1e9), 2.0_f64.powi(-23));
    }
}
