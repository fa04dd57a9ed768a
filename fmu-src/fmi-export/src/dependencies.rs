//! What outputs and unknowns of initialization depend on, by handles: the lists of `ModelStructure` (FMI 2.0.5, 2.2.8).
//!
//! A model writes one row an unknown:
//!
//! ```ignore
//! let attitude = knowns![v.command.kind, v.command.q];
//! table.output(v.attitude.q, &attitude, knowns![&attitude, v.start.q]);
//! ```

use std::collections::{BTreeMap, BTreeSet};

use model_description::{
    BaseType, Causality, Initial, ModelStructure, ScalarVariable, Unknown, Variability, rules,
};

use crate::variables::{Boolean, Choice, Integer, Real, RealMatrix, RealVector, Text};

/// A scalar variable: base type and value reference.
type Key = (BaseType, u32);

/// A set of scalar variables of any base type.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Knowns(BTreeSet<Key>);

/// The union of any number of handles, vectors, matrices and sets as [`Knowns`].
#[macro_export]
macro_rules! knowns {
    ($($part:expr),* $(,)?) => {
        $crate::Knowns::default()$(.and($part))*
    };
}

impl Knowns {
    /// With `other` as well.
    #[must_use]
    pub fn and(mut self, other: impl Into<Self>) -> Self {
        self.0.extend(other.into().0);
        self
    }

    /// `self` where `condition` holds, else nothing.
    #[must_use]
    pub fn only_if(self, condition: bool) -> Self {
        if condition { self } else { Self::default() }
    }

    fn span(base: BaseType, first: u32, count: usize) -> Self {
        Self((first..).take(count).map(|reference| (base, reference)).collect())
    }
}

impl<T: Into<Knowns>> FromIterator<T> for Knowns {
    fn from_iter<I: IntoIterator<Item = T>>(parts: I) -> Self {
        parts.into_iter().fold(Self::default(), Self::and)
    }
}

impl From<&Knowns> for Knowns {
    fn from(set: &Knowns) -> Self {
        set.clone()
    }
}

macro_rules! from_scalar {
    ($($handle:ty: $base:ident),*) => { $(
        impl From<$handle> for Knowns {
            fn from(handle: $handle) -> Self {
                Self::span(BaseType::$base, handle.reference(), 1)
            }
        }
    )* };
}

from_scalar!(Real: Real, Integer: Integer, Boolean: Boolean, Text: String);

impl<E> From<Choice<E>> for Knowns {
    fn from(handle: Choice<E>) -> Self {
        Self::span(BaseType::Integer, handle.reference(), 1)
    }
}

impl<const N: usize> From<RealVector<N>> for Knowns {
    fn from(handle: RealVector<N>) -> Self {
        Self::span(BaseType::Real, handle.reference(), N)
    }
}

impl<const R: usize, const C: usize> From<RealMatrix<R, C>> for Knowns {
    fn from(handle: RealMatrix<R, C>) -> Self {
        Self::span(BaseType::Real, handle.reference(), R * C)
    }
}

/// The two lists of a model. Every output that is not constant has a row, and so has every calculated parameter.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Dependencies {
    at_steps: BTreeMap<Key, Knowns>,
    at_start: BTreeMap<Key, Knowns>,
}

impl Dependencies {
    /// An empty table.
    pub fn new() -> Self {
        Self::default()
    }

    /// An output, every element of it alike. `at_steps` are the inputs whose change at a communication point tc changes
    /// the output at tc + h by something that does not vanish as h goes to 0; what acts through an integrated state is
    /// left out. `at_start` are the inputs and the parameters with `initial="exact"` that change its value after
    /// initialization.
    pub fn output(
        &mut self,
        output: impl Into<Knowns>,
        at_steps: impl Into<Knowns>,
        at_start: impl Into<Knowns>,
    ) {
        let output = output.into();
        insert(&mut self.at_steps, &output, at_steps.into());
        insert(&mut self.at_start, &output, at_start.into());
    }

    /// A calculated parameter, every element of it alike; `at_start` as for an output.
    pub fn calculated(&mut self, parameter: impl Into<Knowns>, at_start: impl Into<Knowns>) {
        insert(&mut self.at_start, &parameter.into(), at_start.into());
    }

    /// The structure of a co-simulation FMU with these variables.
    ///
    /// The error names an unknown without a row, a row without an unknown, or a known that the standard does not admit.
    pub(crate) fn structure(&self, variables: &[ScalarVariable]) -> Result<ModelStructure, String> {
        let keys: Vec<Key> = variables.iter().map(|v| (v.kind.base_type(), v.value_reference)).collect();
        let index_of: BTreeMap<Key, u32> = keys.iter().copied().zip(1..).collect();
        let lists = Lists { variables, keys: &keys, index_of: &index_of };
        let mut structure = rules::structure(variables);
        let input = |v: &ScalarVariable| v.causality == Causality::Input;
        let exact = |v: &ScalarVariable| {
            input(v)
                || v.causality == Causality::Parameter && rules::effective_initial(v) == Some(Initial::Exact)
        };
        lists.fill(&mut structure.outputs, &self.at_steps, &input, "an input")?;
        lists.fill(
            &mut structure.initial_unknowns,
            &self.at_start,
            &exact,
            "an input or a parameter with initial exact",
        )?;
        Ok(structure)
    }
}

/// Rows given twice add up: an element may have more than its vector.
fn insert(rows: &mut BTreeMap<Key, Knowns>, unknowns: &Knowns, knowns: Knowns) {
    for unknown in &unknowns.0 {
        rows.entry(*unknown).or_default().0.extend(&knowns.0);
    }
}

/// The variables, to write lists of their indices.
struct Lists<'a> {
    variables: &'a [ScalarVariable],
    keys: &'a [Key],
    index_of: &'a BTreeMap<Key, u32>,
}

impl Lists<'_> {
    /// Gives every unknown its `dependencies`; `dependenciesKind` stays absent, which stands for `dependent`.
    fn fill(
        &self,
        unknowns: &mut [Unknown],
        rows: &BTreeMap<Key, Knowns>,
        admitted: &dyn Fn(&ScalarVariable) -> bool,
        rule: &str,
    ) -> Result<(), String> {
        let mut left: BTreeSet<Key> = rows.keys().copied().collect();
        for unknown in unknowns {
            let at = unknown.index as usize - 1;
            let (variable, key) = (&self.variables[at], &self.keys[at]);
            left.remove(key);
            let knowns = match rows.get(key) {
                Some(knowns) => &knowns.0,
                None if variable.variability == Variability::Constant => &BTreeSet::new(),
                None => {
                    return Err(format!("`{}` has no row in the model's dependencies", variable.name));
                }
            };
            let mut indices = Vec::with_capacity(knowns.len());
            for known in knowns {
                let index = self.index(known)?;
                let found = &self.variables[index as usize - 1];
                if !admitted(found) {
                    let (unknown, known) = (&variable.name, &found.name);
                    return Err(format!("`{unknown}` depends on `{known}`, allowed: {rule}"));
                }
                indices.push(index);
            }
            indices.sort_unstable();
            unknown.dependencies = Some(indices);
        }
        // An exact output is no unknown of initialization; its row says so by an empty list.
        left.retain(|key| rows.get(key).is_some_and(|knowns| !knowns.0.is_empty()));
        let Some(stranger) = left.first() else { return Ok(()) };
        let name = &self.variables[self.index(stranger)? as usize - 1].name;
        Err(format!("the model's dependencies have a row for `{name}`, which is no unknown there"))
    }

    fn index(&self, key: &Key) -> Result<u32, String> {
        let (base, reference) = key;
        self.index_of.get(key).copied().ok_or_else(|| {
            format!(
                "the model's dependencies name a {} of value reference {reference}, which is none",
                base.name()
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use model_description::{Causality, Initial, ScalarVariable, Variability};

    use super::Dependencies;
    use crate::variables::{Boolean, Declare, Integer, Real, RealSpec, RealVector, Role, ScalarSpec, Text};

    struct Handles {
        parameter: Text,
        flag: Boolean,
        force: RealVector<3>,
        count: Integer,
        size: Real,
        exact: Integer,
    }

    const PARAMETER: Role =
        Role { causality: Causality::Parameter, variability: Variability::Fixed, initial: None };
    const INPUT: Role =
        Role { causality: Causality::Input, variability: Variability::Discrete, initial: None };
    const OUTPUT: Role =
        Role { causality: Causality::Output, variability: Variability::Discrete, initial: None };

    /// A String parameter, a Boolean input, a vector input, a constant, an Integer and a Real output, an exact output.
    fn declared() -> (Vec<ScalarVariable>, Handles) {
        let mut declare = Declare::new();
        let scalar = |name, role| ScalarSpec { name, description: "For the test.", role };
        let real = |name, role| RealSpec {
            name,
            description: "For the test.",
            role,
            unit: "N",
            display_unit: None,
            min: None,
            max: None,
            nominal: None,
        };
        let constant = Role { variability: Variability::Constant, ..OUTPUT };
        let exact = Role { initial: Some(Initial::Exact), ..OUTPUT };
        let handles = Handles {
            parameter: declare.text(&scalar("label", PARAMETER), Some("x")).unwrap(),
            flag: declare.boolean(&scalar("flag", INPUT), Some(false)).unwrap(),
            force: declare.real_vector(&real("force", INPUT), Some([0.0; 3])).unwrap(),
            count: {
                declare.real(&real("one", constant), Some(1.0)).unwrap();
                declare.integer(&scalar("count", OUTPUT), None, None, None).unwrap()
            },
            size: declare.real(&real("size", OUTPUT), None).unwrap(),
            exact: declare.integer(&scalar("exact", exact), Some(7), None, None).unwrap(),
        };
        (declare.finish().variables, handles)
    }

    fn table(v: &Handles) -> Dependencies {
        let mut table = Dependencies::new();
        let force = &knowns![v.force];
        table.output(v.count, v.flag, knowns![v.force.element(1), v.parameter]);
        table.output(
            v.size,
            force,
            knowns![force, knowns![v.flag].only_if(true), knowns![v.count].only_if(false), v.parameter],
        );
        table.output(v.exact, v.flag, knowns![]);
        table
    }

    fn refusal(change: impl FnOnce(&mut Dependencies, &Handles)) -> String {
        let (variables, handles) = declared();
        let mut table = table(&handles);
        change(&mut table, &handles);
        table.structure(&variables).unwrap_err()
    }

    #[test]
    fn rows_of_every_base_type_become_ascending_indices() {
        let (variables, handles) = declared();
        let structure = table(&handles).structure(&variables).unwrap();
        let lists = |unknowns: &[model_description::Unknown]| -> Vec<(u32, Vec<u32>)> {
            unknowns.iter().map(|it| (it.index, it.dependencies.clone().unwrap())).collect()
        };
        // label 1, flag 2, force 3 to 5, one 6, count 7, size 8, exact 9
        let outputs = [(6, vec![]), (7, vec![2]), (8, vec![3, 4, 5]), (9, vec![2])];
        assert_eq!(lists(&structure.outputs), outputs);
        assert_eq!(lists(&structure.initial_unknowns), [(7, vec![1, 4]), (8, vec![1, 2, 3, 4, 5])]);
    }

    #[test]
    fn rows_add_up() {
        let (variables, handles) = declared();
        let mut table = table(&handles);
        table.output(handles.count, handles.force.element(2), knowns![]);
        let structure = table.structure(&variables).unwrap();
        assert_eq!(structure.outputs[1].dependencies, Some(vec![2, 5]));
    }

    #[test]
    fn an_unknown_without_a_row_is_named() {
        let (variables, _) = declared();
        let error = Dependencies::new().structure(&variables).unwrap_err();
        assert_eq!(error, "`count` has no row in the model's dependencies");
    }

    #[test]
    fn what_no_list_admits_is_named() {
        let found = refusal(|table, v| table.output(v.size, v.parameter, knowns![]));
        assert_eq!(found, "`size` depends on `label`, allowed: an input");
        let found = refusal(|table, v| table.output(v.size, knowns![], v.count));
        assert_eq!(found, "`size` depends on `count`, allowed: an input or a parameter with initial exact");
        let found = refusal(|table, v| table.output(v.flag, v.force, knowns![]));
        assert_eq!(found, "the model's dependencies have a row for `flag`, which is no unknown there");
        let found = refusal(|table, v| table.calculated(v.exact, v.force));
        assert_eq!(found, "the model's dependencies have a row for `exact`, which is no unknown there");
        let found = refusal(|table, v| table.output(v.size, Real::from_reference(77), v.force));
        assert_eq!(found, "the model's dependencies name a Real of value reference 77, which is none");
    }
}
