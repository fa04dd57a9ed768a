//! Value references of a model's variables by name and base type.

use std::collections::{BTreeMap, BTreeSet};

use model_description::{BaseType, Description};

/// Value references by name, and each type's in order.
#[derive(Clone, Debug)]
pub struct Names {
    by_name: BTreeMap<String, (BaseType, u32)>,
    by_type: BTreeMap<BaseType, Vec<u32>>,
}

impl Names {
    /// The references of a description.
    pub fn new(description: &Description) -> Self {
        let typed = || description.variables.iter().map(|it| (it.kind.base_type(), it.value_reference));
        let names = description.variables.iter().map(|it| it.name.clone());
        let mut by_type: BTreeMap<BaseType, BTreeSet<u32>> = BTreeMap::new();
        for (base, reference) in typed() {
            by_type.entry(base).or_default().insert(reference);
        }
        let by_type = by_type.into_iter().map(|(base, all)| (base, all.into_iter().collect())).collect();
        Self { by_name: names.zip(typed()).collect(), by_type }
    }

    /// The reference of a variable that may be missing.
    pub fn find(&self, name: &str) -> Option<u32> {
        self.by_name.get(name).map(|(_, reference)| *reference)
    }

    /// The reference of a variable of this type.
    #[track_caller]
    pub fn typed(&self, base: BaseType, name: &str) -> u32 {
        match self.by_name.get(name) {
            Some((found, reference)) if *found == base => *reference,
            found => panic!("{name}: found {found:?}, expected {base:?}"),
        }
    }

    /// The reference of a Real.
    #[track_caller]
    pub fn real(&self, name: &str) -> u32 {
        self.typed(BaseType::Real, name)
    }

    /// The references of the Reals `name[1]` to `name[N]`.
    #[track_caller]
    pub fn vector<const N: usize>(&self, name: &str) -> [u32; N] {
        core::array::from_fn(|i| self.real(&format!("{name}[{}]", i + 1)))
    }

    /// Every reference of a type once, in order.
    pub fn all(&self, base: BaseType) -> &[u32] {
        self.by_type.get(&base).map_or(&[], Vec::as_slice)
    }
}
