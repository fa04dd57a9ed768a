//! Outputs that the model writes when they are read.
//!
//! A step leaves all groups pending. A read has the groups of its outputs written, a saved state and derivatives those that are
//! still pending. They are written into the values of the last step, so that they belong to it whatever was set since.

use super::Instance;
use crate::dependencies::Knowns;
use crate::fmi2::access::{AccessTable, OUTPUT, SET_BY_IMPORTER};
use crate::fmi2::problem::Problem;
use crate::fmi2::references;
use crate::model::OutputGroups;
use crate::variables::{Element, Values};
use model_description::BaseType;

/// The groups of a model, and those that were not written since the last step.
#[derive(Default)]
pub(super) struct Deferred {
    /// The group of each output; no group of any other variable.
    by_place: [Vec<OutputGroups>; Element::TABLES],
    /// Places of the Real outputs of each group.
    reals: Vec<Vec<u32>>,
    /// Places of the Reals that the model writes in a step.
    of_step: Vec<u32>,
    all: OutputGroups,
    pending: OutputGroups,
}

impl Deferred {
    pub(super) fn new(groups: &[Knowns], access: &AccessTable) -> Self {
        debug_assert!(groups.len() <= OutputGroups::MOST);
        let flags = BaseType::ALL.map(|base| access.flags(base));
        let mut by_place = flags.map(|flags| vec![OutputGroups::NONE; flags.len()]);
        let mut reals = vec![Vec::new(); groups.len()];
        for (group, elements) in groups.iter().enumerate() {
            for Element { base, place } in elements.elements() {
                if flags[base as usize][place as usize] & OUTPUT == 0 {
                    continue;
                }
                debug_assert!(by_place[base as usize][place as usize].is_empty());
                by_place[base as usize][place as usize] = OutputGroups::only(group);
                if base == BaseType::Real {
                    reals[group].push(place);
                }
            }
        }
        let of_reals = flags[BaseType::Real as usize].iter().zip(&by_place[BaseType::Real as usize]);
        let of_step = (0..).zip(of_reals);
        let of_step =
            of_step.filter(|(_, (flags, group))| **flags & SET_BY_IMPORTER == 0 && group.is_empty());
        Self {
            of_step: of_step.map(|(place, _)| place).collect(),
            by_place,
            reals,
            all: if groups.is_empty() { OutputGroups::NONE } else { OutputGroups::ALL },
            pending: OutputGroups::NONE,
        }
    }

    /// After a step.
    pub(super) fn mark_all(&mut self) {
        self.pending = self.all;
    }

    /// All outputs are written, or none will be.
    pub(super) fn mark_none(&mut self) {
        self.pending = OutputGroups::NONE;
    }

    #[inline]
    pub(super) fn is_pending(&self) -> bool {
        !self.pending.is_empty()
    }

    /// The first Real that a step wrote and that is no finite number, with its reference.
    #[inline]
    pub(super) fn first_not_finite(&self, access: &AccessTable, values: &Values) -> Option<(u32, f64)> {
        if self.all.is_empty() { access.first_not_finite(values) } else { not_finite(&self.of_step, values) }
    }
}

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

/// The first of these Reals that is no finite number, with its reference.
fn not_finite(places: &[u32], values: &Values) -> Option<(u32, f64)> {
    let found = places.iter().map(|&place| (place, values.reals[place as usize]));
    let mut found = found.filter(|(_, value)| !value.is_finite());
    found.next().map(|(place, value)| (references::first(BaseType::Real) + place, value))
}
