//! Work of a step against its limit: counted, never measured, so that equal steps end alike.

/// Work of one step in units of about a microsecond, by kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Work<const KINDS: usize> {
    limit: u32,
    total: u64,
    spent: [u64; KINDS],
}

impl<const KINDS: usize> Work<KINDS> {
    /// Returns a count of 0 under this limit.
    pub fn new(limit: u32) -> Self {
        Self { limit, total: 0, spent: [0; KINDS] }
    }

    /// Greatest work that is allowed.
    pub fn limit(&self) -> u32 {
        self.limit
    }

    /// Counts `units` of `kind`. Past the limit this continues: loops check [`Work::is_exhausted`].
    #[inline]
    pub fn spend(&mut self, kind: usize, units: u32) {
        self.total = self.total.saturating_add(u64::from(units));
        if let Some(spent) = self.spent.get_mut(kind) {
            *spent = spent.saturating_add(u64::from(units));
        }
    }

    /// Whether more was spent than may be.
    #[inline]
    pub fn is_exhausted(&self) -> bool {
        self.total > u64::from(self.limit)
    }

    /// The kind that took most.
    pub fn greatest(&self) -> usize {
        (0..KINDS).max_by_key(|&kind| self.spent[kind]).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    //! The limit itself may be spent, and no more; the costliest kind is named.
    use super::*;

    #[test]
    fn the_limit_may_be_spent_and_no_more() {
        let mut work = Work::<2>::new(10);
        work.spend(0, 4);
        work.spend(1, 6);
        assert!(!work.is_exhausted());
        work.spend(0, 1);
        assert!(work.is_exhausted());
        assert_eq!(work.greatest(), 1);
        work.spend(0, u32::MAX);
        assert_eq!((work.greatest(), work.limit()), (0, 10));
    }
}
