//! Work limit of a step of the plant, and the settings that ask for most of it.

use crate::momentum::WorkKind;
use crate::numerics;

/// Work of one step, in units of about a microsecond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    spent: numerics::work::Work<{ WorkKind::ALL.len() }>,
    /// Evaluations of the theory of the planets counted so far.
    evaluations: u64,
    /// Units of event functions, and of the attitude alone where a dump is sought, that are not counted yet.
    searched: [u32; 2],
}

/// A step that costs more than it may.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the flight came to {reached_s:?} s and then needed more work than the {limit} units a step may take"
)]
pub struct WorkExceeded {
    /// Limit of the work of a step.
    pub limit: u32,
    /// How far it came, in s.
    pub reached_s: f64,
    /// Kind of work that took most of it.
    pub most: WorkKind,
}

impl Work {
    /// One evaluation of VSOP87.
    const EVALUATION_UNITS: u64 = 200;

    /// Work of a step that begins, with `limit` units; the ephemeris counts this many evaluations of its theory so far.
    pub fn new(limit: u32, evaluations: u64) -> Self {
        Self { spent: numerics::work::Work::new(limit), evaluations, searched: [0; 2] }
    }

    /// A unit for an event function, or for the attitude alone by which a dump is sought, to be counted with the next that is spent.
    pub(crate) fn note_search(&mut self, of_dump: bool) {
        let searched = &mut self.searched[usize::from(of_dump)];
        *searched = searched.saturating_add(1);
    }

    /// Counts `units`, the flight having come to `time_s`, and what the ephemeris counts by now.
    ///
    /// # Errors
    /// More was spent than may be.
    pub fn spend(
        &mut self,
        cost: WorkKind,
        units: u32,
        evaluations: u64,
        time_s: f64,
    ) -> Result<(), WorkExceeded> {
        for (search, noted) in [WorkKind::Search, WorkKind::Dump].into_iter().zip(&mut self.searched) {
            self.spent.spend(search as usize, core::mem::take(noted));
        }
        self.spent.spend(cost as usize, units);
        let fitted = evaluations.saturating_sub(self.evaluations).saturating_mul(Self::EVALUATION_UNITS);
        self.evaluations = evaluations;
        self.spent.spend(WorkKind::Ephemeris as usize, u32::try_from(fitted).unwrap_or(u32::MAX));
        if !self.spent.is_exhausted() {
            return Ok(());
        }
        let most = WorkKind::ALL.get(self.spent.greatest()).copied().unwrap_or(WorkKind::Segment);
        Err(WorkExceeded { limit: self.spent.limit(), reached_s: time_s, most })
    }
}

#[cfg(test)]
mod tests {
    //! The error names what took most, the planets' theory among it.
    use super::*;

    #[test]
    fn what_took_most_is_named() {
        let mut work = Work::new(1000, 7);
        work.spend(WorkKind::Orbit, 300, 7, 10.0).unwrap();
        work.spend(WorkKind::Dump, 500, 7, 20.0).unwrap();
        let exceeded = work.spend(WorkKind::Segment, 201, 7, 30.0).unwrap_err();
        assert_eq!((exceeded.most, exceeded.reached_s, exceeded.limit), (WorkKind::Dump, 30.0, 1000));
        let theory = Work::new(1000, 7).spend(WorkKind::Segment, 1, 13, 5.0).unwrap_err();
        assert_eq!(theory.most, WorkKind::Ephemeris);
    }
}
