//! Outputs that the model writes when they are read.
//!
//! A step leaves all groups pending. A read has the groups of its outputs written, a saved state and derivatives those that are
//! still pending. They are written into the values of the last step, so that they belong to it whatever was set since.

use super::Instance;
use super::pending::not_finite;
use crate::fmi2::problem::Problem;
use crate::fmi2::references;
use crate::model::OutputGroups;
use model_description::BaseType;

impl Instance {
    /// Has the outputs written that are read.
    pub(super) fn write_read(&mut self, base: BaseType, references: &[u32]) -> Result<(), Problem> {
        let by_place = &self.deferred.by_place[base as usize];
        let groups = references.iter().filter_map(|&it| by_place.get(references::index(base, it)).copied());
        self.write_deferred(groups.fold(OutputGroups::NONE, OutputGroups::and))
    }

    /// Has all outputs written.
    pub(super) fn write_pending(&mut self) -> Result<(), Problem> {
        self.write_deferred(self.deferred.all)
    }

    fn write_deferred(&mut self, groups: OutputGroups) -> Result<(), Problem> {
        let groups = groups.within(self.deferred.pending);
        if groups.is_empty() {
            return Ok(());
        }
        let Self { state, deferred, runtime, logger, .. } = self;
        deferred.pending = deferred.pending.without(groups);
        let values = state.at_last_step.as_mut().unwrap_or(&mut state.values);
        runtime.write_outputs(values, groups, state.time_s, logger)?;
        let written = deferred.reals.iter().enumerate().filter(|(group, _)| groups.contains(*group));
        let failed = written.into_iter().find_map(|(_, places)| not_finite(places, values));
        if let Some(written) = &state.at_last_step {
            for (base, of_place) in BaseType::ALL.into_iter().zip(&deferred.by_place) {
                let places = of_place.iter().enumerate().filter(|(_, it)| !it.within(groups).is_empty());
                places.for_each(|(place, _)| state.values.copy_value(written, base, place));
            }
        }
        failed.map_or(Ok(()), |(reference, value)| Err(self.not_finite(reference, value, false)))
    }
}
