//! Segments of ephemerides by their numbers: a cache of them, and a counter of those requested.

use crate::math;
use crate::numerics::chebyshev::Segment;

/// Cache of segments, each at the remainder of its number: two, one for even and one for odd numbers, or more.
#[derive(Clone, Debug)]
pub(super) struct SegmentCache<const D: usize, const N: usize> {
    pub(super) held: Box<[Option<(i64, Segment<D, N>)>]>,
}

impl<const D: usize, const N: usize> Default for SegmentCache<D, N> {
    fn default() -> Self {
        Self { held: Box::new([None; 2]) }
    }
}

impl<const D: usize, const N: usize> SegmentCache<D, N> {
    /// Returns an empty cache for all segments of this length that a span touches, wherever it begins, and a neighbour.
    pub(super) fn spanning(span_s: f64, length_s: f64) -> Self {
        let count = (span_s / length_s).ceil() as usize + 2;
        Self { held: vec![None; count].into_boxed_slice() }
    }

    fn index(&self, number: i64) -> usize {
        let count = self.held.len() as i64;
        // An integer division is slow.
        let index = if count & (count - 1) == 0 { number & (count - 1) } else { number.rem_euclid(count) };
        index as usize
    }

    /// Segment of length `length_s` that contains an epoch, fitted from its start to its end if it is not held.
    pub(super) fn segment(
        &mut self,
        epoch_s: f64,
        length_s: f64,
        fit: impl FnOnce(f64, f64) -> Segment<D, N>,
    ) -> &Segment<D, N> {
        let number = math::floor(epoch_s / length_s);
        let index = self.index(number);
        let slot = &mut self.held[index];
        if slot.as_ref().is_some_and(|(held, _)| *held != number) {
            *slot = None;
        }
        let (_, segment) = slot.get_or_insert_with(|| {
            let start_s = number as f64 * length_s;
            (number, fit(start_s, start_s + length_s))
        });
        segment
    }
}

/// Counter of the long segments that a count of work has requested, whatever is held of them.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SegmentCounter {
    /// One of even and one of odd number, as a [`SegmentCache`] of two holds them.
    numbers: [Option<i64>; 2],
    /// Number of segments requested after the first one.
    pub(super) count: u64,
}

impl SegmentCounter {
    /// Begins a count: the segment that is requested first is free.
    pub(super) fn restart(&mut self) {
        self.numbers = [None; 2];
    }

    /// Counts the segment of length `length_s` that contains an epoch.
    pub(super) fn enter(&mut self, epoch_s: f64, length_s: f64) {
        let number = math::floor(epoch_s / length_s);
        let is_first = self.numbers == [None; 2];
        let slot = &mut self.numbers[(number & 1) as usize];
        if *slot != Some(number) {
            *slot = Some(number);
            self.count += u64::from(!is_first);
        }
    }
}
