//! Sets of groups of outputs.

/// A set of groups of outputs, by their places in `DeferredOutputs::output_groups`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct OutputGroups(u32);

impl OutputGroups {
    /// The greatest number of groups.
    pub const MOST: usize = u32::BITS as usize;
    /// Every group.
    pub const ALL: Self = Self(u32::MAX);
    /// No group.
    pub(crate) const NONE: Self = Self(0);

    /// One group.
    pub(crate) fn only(group: usize) -> Self {
        Self(1 << group)
    }

    /// Whether a group is among them.
    pub fn contains(self, group: usize) -> bool {
        self.0 >> group & 1 == 1
    }

    /// The groups in either set.
    pub(crate) fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// The groups in both sets.
    pub(crate) fn within(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// The groups that are not in `other`.
    pub(crate) fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether it has none.
    pub(crate) fn is_empty(self) -> bool {
        self.0 == 0
    }
}
