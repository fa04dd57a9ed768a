//! What must hold whatever the paper leaves open: looking ahead saves dumps, so do large wheels and small offsets.

use super::cases::{Case, DumpsTo, Simulated, Strategy};

/// Comparisons of two simulations that differ in one thing.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Trends {
    /// How many there are.
    pub compared: usize,
    /// Those that go the wrong way.
    pub exceptions: Vec<String>,
}

/// Whether a trend orders the first case before the second.
type Orders = fn(&Case, &Case) -> bool;

/// What a comparison is about.
const KINDS: [(&str, Orders); 4] = [
    ("strategy", has_next_strategy),
    ("optimum", is_the_optimum_of),
    ("threshold", |more, fewer| {
        more.threshold_n_m_s < fewer.threshold_n_m_s
            && *fewer == Case { threshold_n_m_s: fewer.threshold_n_m_s, ..*more }
    }),
    ("offset", is_an_inch_closer),
];

fn has_next_strategy(more: &Case, fewer: &Case) -> bool {
    let next = Strategy::ALL.windows(2).any(|pair| pair == [more.strategy, fewer.strategy]);
    next && *fewer == Case { strategy: fewer.strategy, ..*more }
}

fn is_the_optimum_of(more: &Case, fewer: &Case) -> bool {
    let optimum = Case { strategy: Strategy::Optimum, dumps_to: DumpsTo::Planned, ..*more };
    more.strategy != Strategy::Optimum && *fewer == optimum
}

fn is_an_inch_closer(more: &Case, fewer: &Case) -> bool {
    let ([_, _, far], [_, _, near]) = (more.offset_in, fewer.offset_in);
    let both_along_z = more.is_along_z() && fewer.is_along_z() && far != 0;
    both_along_z && near == far - far.signum() && *fewer == Case { offset_in: fewer.offset_in, ..*more }
}

/// The trends among `simulated`.
pub(super) fn trends(simulated: &[Simulated]) -> Trends {
    let mut found = Trends::default();
    for (kind, is_ordered) in KINDS {
        for more in simulated {
            for fewer in simulated.iter().filter(|fewer| is_ordered(&more.case, &fewer.case)) {
                found.compared += 1;
                if fewer.count > more.count {
                    found.exceptions.push(format!(
                        "{kind}: {} dumps with [{}], {} with [{}]",
                        more.count,
                        more.case.label(),
                        fewer.count,
                        fewer.case.label()
                    ));
                }
            }
        }
    }
    found
}

impl Trends {
    /// For a report.
    pub(super) fn text(&self) -> String {
        let exceptions: String = self.exceptions.iter().map(|exception| format!("\n  {exception}")).collect();
        format!(
            "Trends (dumps only >= reactive >= predictive, each >= optimum, fewer with the threshold, more with the offset along Z): {} of {} comparisons hold.{exceptions}",
            self.compared - self.exceptions.len(),
            self.compared
        )
    }
}

#[cfg(test)]
mod tests {
    //! Comparisons counted by hand.
    use super::super::cases::{Convention, DumpsTo, Shade};
    use super::super::lists::{ALL_OFFSETS, with_strategies};
    use super::*;

    fn with_counts(count: impl Fn(&Case) -> i64) -> Vec<Simulated> {
        let group = [(DumpsTo::OWN, Shade::Cylinder, Convention::BodyIntegral)];
        let cases = with_strategies(&Strategy::ALL, &group, &[4.0, 7.0], &ALL_OFFSETS);
        let simulated = |case: Case| Simulated {
            case,
            times_d: Vec::new(),
            momentum_x_n_m_s: Vec::new(),
            count: count(&case),
            dumps: Vec::new(),
        };
        cases.into_iter().map(simulated).collect()
    }

    #[test]
    fn every_pair_is_compared_once() {
        let found = trends(&with_counts(|_| 3));
        // Two steps of strategy in 14 columns, one of threshold in 21, four along Z in 6 rows.
        assert_eq!(found, Trends { compared: 28 + 21 + 24, exceptions: Vec::new() });
    }

    #[test]
    fn a_strategy_that_costs_dumps_is_named() {
        let simulated = with_counts(|case| i64::from(case.strategy == Strategy::Predictive));
        let found = trends(&simulated);
        assert_eq!(found.exceptions.len(), 14);
        assert!(found.exceptions[0].starts_with("strategy: 0 dumps with [reactive, 4 N.m.s"));
        assert!(found.text().contains("59 of 73"));
    }

    #[test]
    fn an_offset_on_the_other_side_is_not_compared() {
        let simulated = with_counts(|case| if case.offset_in[2] > 0 { 9 } else { 1 });
        assert!(trends(&simulated).exceptions.is_empty());
    }
}
