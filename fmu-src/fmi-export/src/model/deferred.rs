//! Outputs that a model writes when they are read, in groups.

use super::{Context, Failure, Model};
use crate::dependencies::Knowns;
use crate::variables::Values;

/// A model that writes groups of outputs when one of them is read: an output that nobody reads costs nothing.
pub trait DeferredOutputs: Model {
    /// Outputs of each group, at most [`OutputGroups::MOST`] groups. No output belongs to two of them. What belongs to none, and
    /// what a set has that is no output, is written as in any model.
    fn output_groups(variables: &Self::Variables) -> Vec<Knowns>;

    /// Writes the outputs of these groups at the last communication point, `time_s`; `values` are those of the step that ended
    /// there. Called after [`Model::step`], at most once for each group, before the next step and before the state is saved.
    /// [`Model::initialize`] writes every output itself. An error ends the instance, as an error of the step does.
    fn write_outputs(
        context: &Context<'_, Self>,
        values: &mut Values,
        state: &mut Self::State,
        groups: OutputGroups,
        time_s: f64,
    ) -> Result<(), Failure>;
}

/// A set of groups of outputs, by their places in [`DeferredOutputs::output_groups`].
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

    /// Those that are in either.
    pub(crate) fn and(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    /// Those that are in both.
    pub(crate) fn within(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }

    /// Those that are not in `other`.
    pub(crate) fn without(self, other: Self) -> Self {
        Self(self.0 & !other.0)
    }

    /// Whether it has none.
    pub(crate) fn is_empty(self) -> bool {
        self.0 == 0
    }
}

type Groups<M> = fn(&<M as Model>::Variables) -> Vec<Knowns>;
type Write<M> =
    fn(&Context<'_, M>, &mut Values, &mut <M as Model>::State, OutputGroups, f64) -> Result<(), Failure>;

/// The functions of [`DeferredOutputs`].
pub(crate) struct DeferredFunctions<M: Model> {
    pub(crate) groups: Groups<M>,
    pub(crate) write: Write<M>,
}

impl<M: DeferredOutputs> DeferredFunctions<M> {
    pub(crate) const OF_MODEL: Self = Self { groups: M::output_groups, write: M::write_outputs };
}
