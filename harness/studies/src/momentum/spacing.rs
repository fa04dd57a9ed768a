//! Statistics of the time between dumps.

use std::fmt;

/// Gaps between consecutive dumps, in days.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Spacing {
    /// How many dumps.
    pub dumps: i64,
    /// Shortest and longest gap, unless there is none.
    pub extremes_d: Option<(f64, f64)>,
    /// Where the middle half of the gaps lies, or what a paper states as typical.
    pub typical_d: Option<(f64, f64)>,
}

impl Spacing {
    /// Whether the mission's five days are violated.
    pub(super) fn is_closer_than_five_days(&self) -> bool {
        self.extremes_d.is_some_and(|(closest_d, _)| closest_d < 5.0)
    }

    /// Whether the mission's five days are kept, for tables.
    pub(super) fn five_days(&self) -> &'static str {
        if self.is_closer_than_five_days() { "broken" } else { "kept" }
    }

    /// How this compares with what a paper states, whose "typical" is not defined.
    pub(super) fn against(&self, stated: &Self) -> &'static str {
        let Some((stated_closest_d, _)) = stated.extremes_d else {
            return if self.extremes_d.is_none() { "no gap, as in the paper" } else { "off" };
        };
        let closest_is_near =
            self.extremes_d.is_some_and(|(closest_d, _)| (closest_d / stated_closest_d - 1.0).abs() <= 0.25);
        if self.has_one_gap() && stated.has_one_gap() {
            return if closest_is_near { "gap within 25 %" } else { "off" };
        }
        let Some((stated_low, stated_high)) = stated.typical_d else {
            return if closest_is_near { "closest within 25 %" } else { "closest off" };
        };
        let Some((low, high)) = self.typical_d else { return "off" };
        match (low <= stated_high && stated_low <= high, closest_is_near) {
            (true, true) => "typical gaps overlap, closest within 25 %",
            (true, false) => "typical gaps overlap, closest off",
            (false, true) => "typical gaps off, closest within 25 %",
            (false, false) => "off",
        }
    }

    fn has_one_gap(&self) -> bool {
        self.dumps == 2
    }

    /// Of rising dump times, in days.
    pub(super) fn of(dumps_d: &[f64]) -> Self {
        let mut gaps_d: Vec<f64> = dumps_d.windows(2).map(|pair| pair[1] - pair[0]).collect();
        gaps_d.sort_by(f64::total_cmp);
        let quantile = |fraction: f64| {
            let last = gaps_d.len().checked_sub(1)?;
            let at = fraction * last as f64;
            let below = gaps_d[at.floor() as usize];
            Some(below + (gaps_d[at.ceil() as usize] - below) * at.fract())
        };
        Self {
            dumps: dumps_d.len() as i64,
            extremes_d: gaps_d.first().copied().zip(gaps_d.last().copied()),
            typical_d: quantile(0.25).zip(quantile(0.75)),
        }
    }
}

impl fmt::Display for Spacing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Some((closest, farthest)) = self.extremes_d else { return write!(f, "{} in 90 d", self.dumps) };
        if self.dumps <= 2 {
            return write!(f, "2, {closest:.1} d apart");
        }
        write!(f, "closest {closest:.1} d, farthest {farthest:.1} d")?;
        self.typical_d.map_or(Ok(()), |(low, high)| write!(f, ", typical {low:.0}-{high:.0} d"))
    }
}

#[cfg(test)]
mod tests {
    //! Quartiles of gaps written out by hand.
    use super::*;

    #[test]
    fn gaps_of_a_known_list() {
        let spacing = Spacing::of(&[1.0, 5.0, 15.0, 17.0, 37.0, 43.0]);
        assert_eq!(spacing.extremes_d, Some((2.0, 20.0)));
        assert_eq!(spacing.typical_d, Some((4.0, 10.0)));
        assert!(spacing.is_closer_than_five_days());
        assert_eq!(spacing.to_string(), "closest 2.0 d, farthest 20.0 d, typical 4-10 d");
        let stated = |closest_d, typical_d| Spacing {
            dumps: 9,
            extremes_d: Some((closest_d, 30.0)),
            typical_d: Some(typical_d),
        };
        let overlapping = "typical gaps overlap, closest within 25 %";
        assert_eq!(spacing.against(&stated(2.5, (9.0, 30.0))), overlapping);
        assert_eq!(spacing.against(&stated(2.7, (9.0, 30.0))), "typical gaps overlap, closest off");
        assert_eq!(spacing.against(&stated(2.0, (11.0, 30.0))), "typical gaps off, closest within 25 %");
        assert_eq!(spacing.against(&stated(9.0, (1.0, 3.0))), "off");
        assert_eq!(Spacing::of(&[1.0]).against(&stated(2.0, (1.0, 3.0))), "off");
    }

    #[test]
    fn a_single_gap_is_compared_with_a_single_gap() {
        let stated = Spacing { dumps: 2, extremes_d: Some((55.0, 55.0)), typical_d: None };
        assert_eq!(Spacing::of(&[3.0, 59.0]).against(&stated), "gap within 25 %");
        assert_eq!(Spacing::of(&[3.0, 33.0]).against(&stated), "off");
        // Three dumps have a closest and a typical gap of their own.
        assert_eq!(Spacing::of(&[3.0, 59.0, 119.0]).against(&stated), "closest within 25 %");
    }

    #[test]
    fn one_or_no_dump_has_no_gap() {
        assert_eq!(Spacing::of(&[]).to_string(), "0 in 90 d");
        assert_eq!(Spacing::of(&[3.0]).to_string(), "1 in 90 d");
        assert_eq!(Spacing::of(&[3.0, 58.0]).to_string(), "2, 55.0 d apart");
        let none = Spacing { dumps: 1, extremes_d: None, typical_d: None };
        assert_eq!(Spacing::of(&[3.0]).against(&none), "no gap, as in the paper");
        assert_eq!(Spacing::of(&[3.0, 58.0]).against(&none), "off");
        assert_eq!(Spacing::of(&[3.0, 58.0, 62.0]).against(&none), "off");
        assert_eq!(none.five_days(), "kept");
    }
}
