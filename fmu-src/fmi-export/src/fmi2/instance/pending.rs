//! The groups of outputs that a step left to be written, and the variables of each.

use crate::dependencies::Knowns;
use crate::fmi2::access::{AccessTable, OUTPUT, SET_BY_IMPORTER};
use crate::fmi2::references;
use crate::model::OutputGroups;
use crate::variables::{Element, Values};
use model_description::BaseType;

/// The groups of a model, and those that were not written since the last step.
#[derive(Default)]
pub(super) struct Deferred {
    /// The group of each output; no group of any other variable.
    pub(super) by_place: [Vec<OutputGroups>; Element::TABLES],
    /// Places of the Real outputs of each group.
    pub(super) reals: Vec<Vec<u32>>,
    /// Places of the Reals that the model writes in a step.
    of_step: Vec<u32>,
    pub(super) all: OutputGroups,
    pub(super) pending: OutputGroups,
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

    /// Marks no group as pending: all outputs are written, or none will be.
    pub(super) fn mark_none(&mut self) {
        self.pending = OutputGroups::NONE;
    }

    /// The first Real that a step wrote and that is no finite number, with its reference.
    #[inline]
    pub(super) fn first_not_finite(&self, access: &AccessTable, values: &Values) -> Option<(u32, f64)> {
        if self.all.is_empty() { access.first_not_finite(values) } else { not_finite(&self.of_step, values) }
    }
}

/// The first of these Reals that is no finite number, with its reference.
pub(super) fn not_finite(places: &[u32], values: &Values) -> Option<(u32, f64)> {
    let found = places.iter().map(|&place| (place, values.reals[place as usize]));
    let mut found = found.filter(|(_, value)| !value.is_finite());
    found.next().map(|(place, value)| (references::first(BaseType::Real) + place, value))
}
