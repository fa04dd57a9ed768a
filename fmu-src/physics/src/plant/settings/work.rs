//! Work limit of a step of the plant, and the settings that ask for most of it.

use crate::momentum::Effort;
use crate::numerics;

/// Kind of work.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Segments of momentum as long as their grid.
    Segment,
    /// Segments shortened for the tolerance of momentum.
    Refinement,
    /// Searches for abrupt changes of attitude, light and shadow.
    Search,
    /// Dumps.
    Dump,
    /// Segments of light and heat.
    Light,
    /// Integrated segments of the orbit.
    Orbit,
    /// Planets' positions fitted anew.
    Ephemeris,
    /// Segments of air and magnetic field.
    Air,
}

impl Cost {
    const ALL: [Self; 8] = [
        Self::Segment,
        Self::Refinement,
        Self::Search,
        Self::Dump,
        Self::Light,
        Self::Orbit,
        Self::Ephemeris,
        Self::Air,
    ];
}

impl From<Effort> for Cost {
    fn from(effort: Effort) -> Self {
        match effort {
            Effort::Segment => Self::Segment,
            Effort::Refinement => Self::Refinement,
            Effort::Search => Self::Search,
            Effort::Dump => Self::Dump,
        }
    }
}

/// Work of one step, in units of about a microsecond.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work {
    spent: numerics::work::Work<{ Cost::ALL.len() }>,
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
    /// What was allowed.
    pub limit: u32,
    /// How far it came, in s.
    pub reached_s: f64,
    /// What most of it went into.
    pub most: Cost,
}

impl Work {
    /// One evaluation of VSOP87.
    const EVALUATION_UNITS: u64 = 200;

    /// Work of a step that begins, with `limit` units; the ephemeris counts this many evaluations of its theory so far.
    pub fn new(limit: u32, evaluations: u64) -> Self {
        Self { spent: numerics::work::Work::new(limit), evaluations, searched: [0; 2] }
    }

    /// A unit for an event function, to be counted with the next that is spent.
    pub(crate) fn note_search(&mut self) {
        self.searched[0] = self.searched[0].saturating_add(1);
    }

    /// A unit for the attitude alone, by which a dump is sought, to be counted with the next that is spent.
    pub(crate) fn note_dump_search(&mut self) {
        self.searched[1] = self.searched[1].saturating_add(1);
    }

    /// Counts `units`, the flight having come to `time_s`, and what the ephemeris counts by now.
    ///
    /// # Errors
    /// More was spent than may be.
    pub fn spend(
        &mut self,
        cost: Cost,
        units: u32,
        evaluations: u64,
        time_s: f64,
    ) -> Result<(), WorkExceeded> {
        for (search, noted) in [Cost::Search, Cost::Dump].into_iter().zip(&mut self.searched) {
            self.spent.spend(search as usize, core::mem::take(noted));
        }
        self.spent.spend(cost as usize, units);
        let fitted = evaluations.saturating_sub(self.evaluations).saturating_mul(Self::EVALUATION_UNITS);
        self.evaluations = evaluations;
        self.spent.spend(Cost::Ephemeris as usize, u32::try_from(fitted).unwrap_or(u32::MAX));
        if !self.spent.is_exhausted() {
            return Ok(());
        }
        let most = Cost::ALL.get(self.spent.greatest()).copied().unwrap_or(Cost::Segment);
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
        work.spend(Cost::Orbit, 300, 7, 10.0).unwrap();
        work.spend(Cost::Dump, 500, 7, 20.0).unwrap();
        let exceeded = work.spend(Cost::Segment, 201, 7, 30.0).unwrap_err();
        assert_eq!((exceeded.most, exceeded.reached_s, exceeded.limit), (Cost::Dump, 30.0, 1000));
        let theory = Work::new(1000, 7).spend(Cost::Segment, 1, 13, 5.0).unwrap_err();
        assert_eq!(theory.most, Cost::Ephemeris);
    }
}
