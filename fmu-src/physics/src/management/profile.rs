//! Momentum at the end of a downlink from which no threshold is exceeded through the coming ones: predictive
//! targets (paper 000, "Momentum management strategies").
//!
//! Of one component, left with h after this downlink: science k lets it swing by [low_k, high_k] and ends at h + change_k; the
//! downlink after it adds anything within its own reach [least_k, most_k]. The threshold M is kept over the horizon if h lies in
//! I_1, computed backward from the end: I_k = [-M + a_k, M + b_k],
//!
//! a_k = max(-low_k, a_(k+1) - change_k - most_k), b_k = min(-high_k, b_(k+1) - change_k - least_k),
//!
//! without the second terms at the last science. The target is the middle of I_1, or what this downlink reaches nearest to it. A
//! horizon that cannot be kept, with a little of the threshold to spare, is shortened until it can. Where a dump cannot be
//! avoided in the science that follows, and would not stay the only one there, the nearest target within reach with fewer is taken.

/// Excursion of one component through a span of science, in N m s, from its start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Excursion {
    /// At its end.
    pub change: f64,
    /// Lowest on the way, at most 0.
    pub lowest: f64,
    /// Highest on the way, at least 0.
    pub highest: f64,
}

impl Excursion {
    /// Records a momentum on the way, relative to the start.
    pub fn record(&mut self, since_start: f64) {
        self.change = since_start;
        self.lowest = self.lowest.min(since_start);
        self.highest = self.highest.max(since_start);
    }
}

/// Least and greatest momentum that a downlink can add to one component, in N m s.
pub type ControlAuthority = [f64; 2];

/// Science to come and the downlink after it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Cycle {
    /// Excursion through the science.
    pub excursion: Excursion,
    /// Authority of the downlink.
    pub authority: ControlAuthority,
}

/// One component where a downlink begins.
#[derive(Clone, Copy, Debug)]
pub struct Component<'a, D: Fn(f64) -> f64> {
    /// Momentum, in N m s.
    pub momentum_n_m_s: f64,
    /// Authority of the downlink that begins.
    pub authority: ControlAuthority,
    /// Cycles after it.
    pub cycles: &'a [Cycle],
    /// Momentum through the first science, relative to its start, in N m s, in the order of time.
    pub path: &'a [f64],
    /// Magnitude that triggers a dump, in N m s.
    pub threshold: f64,
    /// Momentum after a dump at a momentum, in N m s.
    pub dumped: D,
}

/// Targets that are compared where a dump cannot be avoided.
const TARGETS: usize = 64;
/// Part of a threshold that a forecast may be off by: a horizon is kept with that much to spare, and a dump has to stay the only
/// one for targets off by it.
const MARGIN: f64 = 0.004;
/// Momenta that are looked at on either side of a target within that part: those from which a second dump follows lie close together.
const SPREAD: i32 = 4;

impl<D: Fn(f64) -> f64> Component<'_, D> {
    /// The momentum to leave this downlink with, in N m s.
    pub fn target(&self) -> f64 {
        let [low, high] = [self.momentum_n_m_s + self.authority[0], self.momentum_n_m_s + self.authority[1]];
        let nearest = middle(self.cycles, (1.0 - MARGIN) * self.threshold).max(low).min(high);
        let fewest = self.dumps_about(nearest);
        if fewest <= 1 {
            return nearest;
        }
        let targets = (0..=TARGETS).map(|k| low + (high - low) * k as f64 / TARGETS as f64);
        let kept = targets.filter(|target| target.abs() <= self.threshold);
        let best = kept.map(|target| (self.dumps_about(target), (target - nearest).abs(), target));
        let best = best.min_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        best.filter(|(dumps, ..)| *dumps < fewest).map_or(nearest, |(.., target)| target)
    }

    /// Most dumps through the first science about a momentum left with.
    fn dumps_about(&self, target: f64) -> usize {
        let margin = if self.threshold.is_finite() { MARGIN * self.threshold } else { 0.0 };
        let about = (-SPREAD..=SPREAD).map(|k| target + margin * f64::from(k) / f64::from(SPREAD));
        about.map(|it| self.dumps(it)).max().unwrap_or(0)
    }

    /// Dumps through the first science from this momentum.
    fn dumps(&self, start: f64) -> usize {
        let (mut dumps, mut given) = (0, 0.0);
        for since_start in self.path {
            let momentum = start + since_start + given;
            if momentum.abs() > self.threshold {
                dumps += 1;
                given += (self.dumped)(momentum) - momentum;
            }
        }
        dumps
    }
}

/// The middle of the momenta before the longest part of a horizon that can be kept; of one that no momentum keeps, the middle of
/// the first excursion.
fn middle(cycles: &[Cycle], threshold: f64) -> f64 {
    let parts = (1..=cycles.len()).map(|count| bounds(cycles.get(..count).unwrap_or_default()));
    // What a longer part keeps a shorter one keeps too.
    let kept = parts.take_while(|[least, most]| least - most <= 2.0 * threshold);
    let first = bounds(cycles.get(..1).unwrap_or_default());
    let [least, most] = kept.last().unwrap_or(first);
    0.5 * (least + most)
}

/// Momenta before the first science from which a horizon can be kept: the least beyond the negative threshold, the most beyond the
/// positive one.
fn bounds(cycles: &[Cycle]) -> [f64; 2] {
    let mut later: Option<[f64; 2]> = None;
    for Cycle { excursion, authority } in cycles.iter().rev() {
        let mut bounds = [-excursion.lowest, -excursion.highest];
        if let Some([least, most]) = later {
            bounds[0] = bounds[0].max(least - excursion.change - authority[1]);
            bounds[1] = bounds[1].min(most - excursion.change - authority[0]);
        }
        later = Some(bounds);
    }
    later.unwrap_or_default()
}

#[cfg(test)]
mod tests;
