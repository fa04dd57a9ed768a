//! Looks at a run between its communication points, at times that the watcher names.

use crate::{
    Error, Instance,
    apart::{MAX_HALVINGS, step_apart},
};

/// Watches a run. For FMUs that take steps of any size.
pub trait Watcher {
    /// Looks at the instance where it has come, at `time_s`; gives the next time in s at which it looks, beside every communication
    /// point, infinite without one.
    ///
    /// # Errors
    /// A value that cannot be read.
    fn look(&mut self, instance: &mut Instance, time_s: f64) -> Result<f64, Error>;

    /// Reference of an Integer that counts events: a step in which it rises is taken again in halves, and looked at between them,
    /// down to a millionth of it. For FMUs with states.
    fn counter(&self) -> Option<u32> {
        None
    }
}

/// A watcher and when it looks next.
pub(crate) struct Watch<'a> {
    watcher: &'a mut dyn Watcher,
    next_s: f64,
    /// A time this near to a communication point is that point, in s.
    resolution_s: f64,
}

impl<'a> Watch<'a> {
    /// Looks at the start.
    pub(crate) fn begin(
        watcher: &'a mut dyn Watcher,
        instance: &mut Instance,
        [start_s, resolution_s]: [f64; 2],
    ) -> Result<Self, Error> {
        let next_s = watcher.look(instance, start_s)?;
        Ok(Self { watcher, next_s, resolution_s })
    }

    /// Takes a step in pieces that end where the watcher looks; the last one ends at the same number as the whole would.
    pub(crate) fn step(&mut self, instance: &mut Instance, time_s: f64, step_s: f64) -> Result<(), Error> {
        let end_s = time_s + step_s;
        let mut now_s = time_s;
        while self.next_s < end_s - self.resolution_s {
            if self.next_s > now_s {
                let piece_s = span_to(now_s, self.next_s);
                self.piece(instance, now_s, piece_s)?;
                now_s += piece_s;
            }
            let after_s = self.watcher.look(instance, now_s)?;
            // A watcher that names a time that is past looks at the end of the step.
            self.next_s = if after_s > now_s { after_s } else { f64::INFINITY };
        }
        self.piece(instance, now_s, span_to(now_s, end_s))?;
        self.next_s = self.watcher.look(instance, end_s)?;
        Ok(())
    }

    fn piece(&mut self, instance: &mut Instance, time_s: f64, step_s: f64) -> Result<(), Error> {
        let Some(counter) = self.watcher.counter() else { return instance.do_step(time_s, step_s, true) };
        let between = &mut |instance: &mut Instance, at_s: f64| self.watcher.look(instance, at_s).map(|_| ());
        step_apart(instance, (counter, 0), (time_s, step_s), MAX_HALVINGS, between)
    }
}

/// The span that added to a time gives another, later one to the last bit.
fn span_to(now_s: f64, end_s: f64) -> f64 {
    let mut span_s = end_s - now_s;
    while now_s + span_s < end_s {
        span_s = span_s.next_up();
    }
    while now_s + span_s > end_s && now_s + span_s.next_down() >= end_s {
        span_s = span_s.next_down();
    }
    span_s
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spans_end_at_the_number_asked_for() {
        for k in 0..2000 {
            let (now_s, end_s) = (f64::from(k) * 0.1, 1e3 + f64::from(k * k) * 0.007);
            assert!(
                now_s + span_to(now_s, end_s) >= end_s && now_s + span_to(now_s, end_s) <= end_s.next_up()
            );
            let near_s = now_s + 0.05;
            assert_eq!(now_s + span_to(now_s, near_s), near_s);
        }
    }
}
