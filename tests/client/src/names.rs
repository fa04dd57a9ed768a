//! Value references of a model's variables by name and base type.

use std::collections::BTreeMap;

use model_description::{BaseType, Description};

/// Value references by name.
#[derive(Clone, Debug)]
pub struct Names(BTreeMap<String, (BaseType, u32)>);

impl Names {
    /// The references of a description.
    pub fn new(description: &Description) -> Self {
        let variables = description.variables.iter();
        Self(variables.map(|it| (it.name.clone(), (it.kind.base_type(), it.value_reference))).collect())
    }

    /// The reference of a variable that may be missing.
    pub fn find(&self, name: &str) -> Option<u32> {
        self.0.get(name).map(|(_, reference)| *reference)
    }

    /// The reference of a variable of this type.
    #[track_caller]
    pub fn typed(&self, base: BaseType, name: &str) -> u32 {
        match self.0.get(name) {
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
    pub fn all(&self, base: BaseType) -> Vec<u32> {
        let mut all: Vec<u32> = self.0.values().filter(|(of, _)| *of == base).map(|(_, it)| *it).collect();
        all.sort_unstable();
        all.dedup();
        all
    }
}
