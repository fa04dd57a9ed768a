//! Which momentum to leave a downlink with so that the greatest on the way through the coming ones is least: predictive
//! targets (paper 000, "Momentum management strategies").
//!
//! Of one component, left with h after this downlink: science k lets it swing by [low_k, high_k] and ends at h + change_k;
//! downlink k adds anything within its reach. A bound M holds along the way if h lies in
//! I_k = [-M - low_k, M - high_k] and a downlink can lead from h + change_k into I_(k+1). The intervals I_k follow backwards
//! in closed form; the least M for which I_1 meets what this downlink can reach is found by halving, and the target is the
//! middle of what is left there.

/// What a span of science does to one component, in N m s, from its start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Swing {
    /// At its end.
    pub change: f64,
    /// Lowest on the way, at most 0.
    pub lowest: f64,
    /// Highest on the way, at least 0.
    pub highest: f64,
}

impl Swing {
    /// Takes note of a momentum on the way, relative to the start.
    pub fn note(&mut self, since_start: f64) {
        self.change = since_start;
        self.lowest = self.lowest.min(since_start);
        self.highest = self.highest.max(since_start);
    }
}

/// What a downlink can add to one component, in N m s: least and most.
pub type Reach = [f64; 2];

/// Halvings of the bound.
const HALVINGS: usize = 60;

/// The momentum after this downlink, in N m s, from `now` within `reach`, that keeps the greatest magnitude least through the
/// science spans to come, between which every downlink has the same reach. Only as many spans count as can stay below
/// `threshold`, one at least.
pub fn best_target(now: f64, reach: Reach, swings: &[Swing], threshold: f64) -> f64 {
    let mut best = now + 0.0_f64.clamp(reach[0], reach[1]);
    for count in 1..=swings.len() {
        let Some((bound, target)) = least_bound(now, reach, swings.get(..count).unwrap_or_default()) else {
            return best;
        };
        if count > 1 && bound > threshold {
            return best;
        }
        best = target;
    }
    best
}

/// The least bound, and the middle of the targets that keep it.
fn least_bound(now: f64, reach: Reach, swings: &[Swing]) -> Option<(f64, f64)> {
    let ways = swings.iter().map(|swing| swing.highest - swing.lowest + swing.change.abs());
    let steps = reach[0].abs() + reach[1].abs();
    let mut most = now.abs() + ways.sum::<f64>() + steps * (swings.len() as f64 + 1.0) + f64::MIN_POSITIVE;
    let mut least = 0.0;
    let mut kept = admissible(now, reach, swings, most)?;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (least + most);
        match admissible(now, reach, swings, middle) {
            Some(interval) => (most, kept) = (middle, interval),
            None => least = middle,
        }
    }
    Some((most, 0.5 * (kept[0] + kept[1])))
}

/// Targets that this downlink can reach and that keep the bound; `None` where there are none.
fn admissible(now: f64, reach: Reach, swings: &[Swing], bound: f64) -> Option<[f64; 2]> {
    let mut next: Option<[f64; 2]> = None;
    for swing in swings.iter().rev() {
        let mut interval = [-bound - swing.lowest, bound - swing.highest];
        if let Some([low, high]) = next {
            interval[0] = interval[0].max(low - reach[1] - swing.change);
            interval[1] = interval[1].min(high - reach[0] - swing.change);
        }
        if interval[0] > interval[1] {
            return None;
        }
        next = Some(interval);
    }
    let [low, high] = next.unwrap_or([-bound, bound]);
    let interval = [low.max(now + reach[0]), high.min(now + reach[1])];
    (interval[0] <= interval[1]).then_some(interval)
}

#[cfg(test)]
mod tests {
    //! Against closed forms and a search over all targets.
    use super::*;
    use approx::assert_relative_eq;
    use proptest::prelude::*;

    fn drift(change: f64) -> Swing {
        let mut swing = Swing::default();
        swing.note(change);
        swing
    }

    #[test]
    fn a_drift_is_met_half_way() {
        assert_relative_eq!(best_target(0.3, [-5.0, 5.0], &[drift(2.0)], 4.0), -1.0, epsilon = 1e-12);
        assert_relative_eq!(best_target(0.3, [-5.0, 5.0], &[drift(-3.0)], 4.0), 1.5, epsilon = 1e-12);
    }

    #[test]
    fn what_later_downlinks_cannot_take_is_taken_now() {
        // Two spans of +2 with 1 in between: from h to h + 2, h + 1, h + 3.
        let swings = [drift(2.0); 2];
        assert_relative_eq!(best_target(0.0, [-1.0, 1.0], &swings, 4.0), -1.0, epsilon = 1e-9);
        assert_relative_eq!(best_target(0.0, [-5.0, 5.0], &swings, 4.0), -1.0, epsilon = 1e-9);
        let weak_later = [-1.0, 1.0].map(|it: f64| it * 0.5);
        assert_relative_eq!(best_target(-1.4, weak_later, &swings, 4.0), -1.75, epsilon = 0.15);
    }

    #[test]
    fn spans_beyond_the_threshold_do_not_count() {
        let swings = [drift(2.0), drift(40.0)];
        assert_relative_eq!(best_target(0.0, [-5.0, 5.0], &swings, 4.0), -1.0, epsilon = 1e-12);
    }

    /// The greatest magnitude under a target with the best later downlinks, by a grid over these.
    fn peak(target: f64, reach: Reach, swings: &[Swing]) -> f64 {
        let Some((first, rest)) = swings.split_first() else { return 0.0 };
        let here = (target + first.lowest).abs().max((target + first.highest).abs());
        if rest.is_empty() {
            return here;
        }
        let steps = (0..=60).map(|k| reach[0] + (reach[1] - reach[0]) * f64::from(k) / 60.0);
        here.max(steps.map(|u| peak(target + first.change + u, reach, rest)).fold(f64::INFINITY, f64::min))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(60))]
        #[test]
        fn no_other_target_has_a_lower_peak(
            now in -3.0..3.0_f64,
            width in 0.1..3.0_f64,
            changes in proptest::collection::vec((-3.0..3.0_f64, 0.0..1.0_f64, 0.0..1.0_f64), 1..3),
        ) {
            let swings: Vec<Swing> = changes
                .iter()
                .map(|(change, below, above)| Swing {
                    change: *change,
                    lowest: change.min(0.0) - below,
                    highest: change.max(0.0) + above,
                })
                .collect();
            let reach = [-width, 0.7 * width];
            let target = best_target(now, reach, &swings, f64::INFINITY);
            prop_assert!((now + reach[0] - 1e-9..=now + reach[1] + 1e-9).contains(&target));
            let found = peak(target, reach, &swings);
            for k in 0..=200 {
                let other = now + reach[0] + (reach[1] - reach[0]) * f64::from(k) / 200.0;
                prop_assert!(peak(other, reach, &swings) > found - 0.06, "{other} beats {target}");
            }
        }
    }
}
