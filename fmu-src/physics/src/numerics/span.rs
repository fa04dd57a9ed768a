//! Span of time from a start to an end.

use serde::{Deserialize, Serialize};

/// Closed span of time; both ends count from the same origin.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Span {
    /// Start, s.
    pub start_s: f64,
    /// End, s.
    pub end_s: f64,
}

impl Span {
    /// Returns the span from `start_s` to `end_s`.
    pub const fn new(start_s: f64, end_s: f64) -> Self {
        Self { start_s, end_s }
    }

    /// Returns the time from start to end, s; negative where the end comes first.
    pub fn length_s(&self) -> f64 {
        self.end_s - self.start_s
    }

    /// Tells whether `time_s` lies in the span, its ends included.
    pub fn contains(&self, time_s: f64) -> bool {
        self.start_s <= time_s && time_s <= self.end_s
    }
}

#[cfg(test)]
mod tests {
    //! Ends belong to a span.
    use super::*;

    #[test]
    fn ends_belong_to_a_span() {
        let span = Span::new(1.0, 3.0);
        assert_eq!(span.length_s(), 2.0);
        assert!(span.contains(1.0) && span.contains(3.0) && !span.contains(3.1) && !span.contains(f64::NAN));
    }
}
