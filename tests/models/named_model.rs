//! Drives a model by its trait, with variables by name.

use client::short_or_long;
use fmi_export::fmi2::entry;
use fmi_export::model::Log;
use std::cell::{OnceCell, RefCell};
use std::collections::BTreeMap;

use fmi_export::fmi2::{references, scalar_variables};
use fmi_export::model::InputDerivative;
use fmi_export::model_description::{Causality, Description, Variability, VariableKind};
use fmi_export::{
    BaseType, Context, Declare, Failure, InputsOverTime, Library, Model, OutputGroups, Step, Values,
    Variables,
};
use models::{DisturbanceTorque, Guidance, MomentumPlant, SpinPlant};
use nalgebra::{Quaternion, UnitQuaternion};
use physics::numerics::intervals::next_multiple_s;

/// Every model: a file may give start values to another than the one that is described.
pub(crate) static LIBRARY: Library = Library {
    entries: &[
        entry::<MomentumPlant>(),
        entry::<SpinPlant>(),
        entry::<DisturbanceTorque>(),
        entry::<Guidance>(),
    ],
};

/// The description of a model with this setup.
pub(crate) fn described<M: Model>(file: &str, text: &str) -> Result<Description, String> {
    let entry = LIBRARY.find(M::NAME).unwrap();
    LIBRARY.describe(entry, Some(file), Some(text)).map_err(|error| error.to_string())
}

/// Keeps warnings.
#[derive(Default)]
struct Warnings(RefCell<Vec<String>>);

impl Log for Warnings {
    fn events_enabled(&self) -> bool {
        false
    }
    fn event(&self, _time_s: f64, _message: &str) {}
    fn warning(&self, message: &str) {
        self.0.borrow_mut().push(message.to_owned());
    }
}

/// A model with everything that does not change in flight.
pub(crate) struct NamedModel<M: Model> {
    setup: M::Setup,
    handles: M::Variables,
    names: Vec<Named>,
    by_name: BTreeMap<String, usize>,
    start: Values,
    warnings: Warnings,
}

struct Named {
    name: String,
    kind: NamedType,
    reference: usize,
    output: bool,
    /// Whether the master may set it, and within which limits.
    given: Option<(f64, f64)>,
    input: bool,
    /// Whether it may be set between steps.
    changes: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum NamedType {
    Real,
    Integer,
    Boolean,
    Text,
}

impl<M: Model> NamedModel<M> {
    /// With the compiled-in setup.
    pub(crate) fn shipped() -> Self {
        Self::with("default", M::DEFAULT_SETUP)
    }

    /// With a setup text.
    pub(crate) fn with(file: &str, text: &str) -> Self {
        let setup = M::parse_setup(file, text).unwrap();
        let mut scope = Declare::new();
        let handles = M::Variables::declare(&mut scope, &setup, 0).unwrap();
        let interface = scope.finish();
        let variables = scalar_variables(&interface);
        let names = variables.iter().map(|variable| {
            let (kind, base) = match variable.kind {
                VariableKind::Real { .. } => (NamedType::Real, BaseType::Real),
                VariableKind::Boolean { .. } => (NamedType::Boolean, BaseType::Boolean),
                VariableKind::String { .. } => (NamedType::Text, BaseType::String),
                _ => (NamedType::Integer, BaseType::Integer),
            };
            let items = |name: &str| {
                let found = interface.enumerations.iter().find(|it| it.name == name);
                let values = || found.unwrap().items.iter().map(|it| it.value);
                (values().min().unwrap(), values().max().unwrap())
            };
            let limits = match &variable.kind {
                VariableKind::Real { attributes, .. } => {
                    (attributes.min.unwrap_or(f64::MIN), attributes.max.unwrap_or(f64::MAX))
                }
                VariableKind::Integer { min, max, .. } => {
                    (f64::from(min.unwrap_or(i32::MIN)), f64::from(max.unwrap_or(i32::MAX)))
                }
                VariableKind::Enumeration { declared_type, .. } => {
                    let (least, most) = items(declared_type);
                    (f64::from(least), f64::from(most))
                }
                _ => (0.0, 1.0),
            };
            let given = kind != NamedType::Text
                && matches!(variable.causality, Causality::Input | Causality::Parameter);
            Named {
                given: given.then_some(limits),
                input: variable.causality == Causality::Input,
                changes: given
                    && (variable.causality == Causality::Input
                        || variable.variability == Variability::Tunable),
                name: variable.name.clone(),
                kind,
                reference: (variable.value_reference - references::first(base)) as usize,
                output: variable.causality == Causality::Output,
            }
        });
        let described = described::<M>(file, text).unwrap_or_else(|error| panic!("{error}"));
        let start = with_file_starts(&interface.start, &described);
        let names: Vec<Named> = names.collect();
        let start = marked::<M>(&start, &setup, &names);
        let by_name = names.iter().enumerate().map(|(at, named)| (named.name.clone(), at)).collect();
        Self { names, by_name, setup, handles, start, warnings: Warnings::default() }
    }

    /// The same with a file beside the setup.
    pub(crate) fn with_schedule(mut self, schedule: &str, text: &str) -> Self {
        M::parse_schedule(&mut self.setup, schedule, schedule, text).unwrap();
        self
    }

    /// The error of an initialization that refuses these start values.
    pub(crate) fn refusal(&self, sets: &[(&str, f64)]) -> String {
        self.initialize(0.0, sets)
            .err()
            .unwrap_or_else(|| panic!("it is initialized with {sets:?}"))
            .to_string()
    }

    /// Value that a master may set, with its limits and whether it is a whole number.
    pub(crate) fn given(&self) -> Vec<(&str, (f64, f64), bool)> {
        let given = |it: &Named| it.given.is_some();
        let shown = |it: &'_ Named| (it.given.unwrap_or_default(), it.kind != NamedType::Real);
        self.names
            .iter()
            .filter(|it| given(it))
            .map(|it| (it.name.as_str(), shown(it).0, shown(it).1))
            .collect()
    }

    /// All inputs.
    pub(crate) fn inputs(&self) -> Vec<&str> {
        self.names
            .iter()
            .filter(|it| it.input && it.kind != NamedType::Text)
            .map(|it| it.name.as_str())
            .collect()
    }

    /// Inputs and tunable parameters, each with other values than the present one: the other items of an enumeration, a number
    /// far off, in the long extent one near by too.
    pub(crate) fn changes(&self, values: &NamedInstance<'_, M>) -> Vec<(&str, f64)> {
        let others = |it: &Named, (least, most): (f64, f64)| -> Vec<f64> {
            let value = match it.kind {
                NamedType::Real => values.real(&it.name),
                NamedType::Boolean => f64::from(u8::from(values.boolean(&it.name))),
                _ => f64::from(values.integer(&it.name)),
            };
            let tried = match it.kind {
                NamedType::Real => {
                    let far = if value == 0.0 { 1.0 } else { -0.5 * value };
                    let nearby = if 1.01 * value > most { 0.99 * value } else { 1.01 * value };
                    let nearby = if value == 0.0 { 1e-3 } else { nearby };
                    short_or_long(vec![far], vec![far, nearby])
                }
                _ if most - least > 20.0 => vec![value + 1.0],
                _ => (least as i32..=most as i32).map(f64::from).collect(),
            };
            tried.into_iter().map(|it| it.clamp(least, most)).filter(|it| *it != value).collect()
        };
        let changing = self.names.iter().filter(|it| it.changes);
        let all = changing.filter_map(|it| Some((it.name.as_str(), others(it, it.given?))));
        all.flat_map(|(name, others)| others.into_iter().map(move |value| (name, value))).collect()
    }

    /// The warnings of all flights so far.
    pub(crate) fn warnings(&self) -> Vec<String> {
        self.warnings.0.borrow().clone()
    }

    fn named(&self, name: &str) -> &Named {
        let at = self.by_name.get(name).unwrap_or_else(|| panic!("no variable {name}"));
        &self.names[*at]
    }

    fn find(&self, name: &str, kind: NamedType) -> usize {
        let found = self.named(name);
        assert_eq!(found.kind, kind, "{name}");
        found.reference
    }

    fn context(&self) -> Context<'_, M> {
        Context {
            setup: &self.setup,
            variables: &self.handles,
            start: &self.start,
            sets_all_parameters: false,
            log: &self.warnings,
        }
    }

    /// A flight from `start_s` with these start values.
    pub(crate) fn initialize(
        &self,
        start_s: f64,
        sets: &[(&str, f64)],
    ) -> Result<NamedInstance<'_, M>, Failure> {
        let mut tables = Tables::new(&self.start);
        tables.set.iter_mut().flatten().for_each(|word| *word = 0);
        sets.iter().for_each(|(name, value)| self.set(&mut tables, name, *value));
        let mut values = tables.back();
        let state = M::initialize(&self.context(), &mut values, start_s)?;
        M::resolve_parameters(&self.context(), &mut values);
        let (tables, before) = (OnceCell::new(), None);
        Ok(NamedInstance { named: self, values, tables, state, time_s: start_s, before, moved: false })
    }

    fn set(&self, tables: &mut Tables, name: &str, value: f64) {
        let found = self.named(name);
        match found.kind {
            NamedType::Real => tables.reals[found.reference] = value,
            NamedType::Integer => tables.integers[found.reference] = value as i32,
            NamedType::Boolean => tables.booleans[found.reference] = value != 0.0,
            NamedType::Text => panic!("{name} is text"),
        }
        tables.mark(found);
    }
}

/// Start values, those of the setup's file marked as given.
fn marked<M: Model>(start: &Values, setup: &M::Setup, names: &[Named]) -> Values {
    let mut tables = Tables::new(start);
    let given: Vec<_> = M::start_values(setup);
    let for_this = given.iter().filter(|it| it.model.as_ref().is_none_or(|model| model == M::NAME));
    for entry in for_this {
        let is_meant =
            |it: &&Named| it.name == entry.name || it.name.starts_with(&format!("{}[", entry.name));
        names.iter().filter(is_meant).for_each(|it| tables.mark(it));
    }
    tables.back()
}

/// Start values with those of the setup's file.
pub(crate) fn with_file_starts(start: &Values, description: &Description) -> Values {
    let mut tables = Tables::new(start);
    for variable in &description.variables {
        let slot = |base| (variable.value_reference - references::first(base)) as usize;
        match &variable.kind {
            VariableKind::Real { start: Some(start), .. } => tables.reals[slot(BaseType::Real)] = *start,
            VariableKind::Integer { start: Some(start), .. }
            | VariableKind::Enumeration { start: Some(start), .. } => {
                tables.integers[slot(BaseType::Integer)] = *start;
            }
            VariableKind::Boolean { start: Some(start), .. } => {
                tables.booleans[slot(BaseType::Boolean)] = *start
            }
            _ => {}
        }
    }
    tables.back()
}

/// The value tables, reached through their serialised form: no author of a model can write them by reference.
#[derive(Clone, PartialEq, serde::Serialize, serde::Deserialize)]
pub(crate) struct Tables {
    pub reals: Vec<f64>,
    pub integers: Vec<i32>,
    pub booleans: Vec<bool>,
    pub strings: Vec<String>,
    /// One bit a place of each table: whether its value was set.
    pub set: [Vec<u64>; 4],
}

impl Tables {
    pub(crate) fn new(values: &Values) -> Self {
        postcard::from_bytes(&postcard::to_stdvec(values).unwrap()).unwrap()
    }

    /// The same, set by an importer that sets what is other than the start values.
    pub(crate) fn marked_where_other_than(&self, start: &Values) -> Self {
        fn mark<T: PartialEq>(bits: &mut [u64], values: &[T], start: &[T]) {
            bits.fill(0);
            for (at, _) in values.iter().zip(start).enumerate().filter(|(_, (value, start))| value != start) {
                bits[at / 64] |= 1 << (at % 64);
            }
        }
        let (mut marked, start) = (self.clone(), Self::new(start));
        let [reals, integers, booleans, strings] = &mut marked.set;
        mark(reals, &self.reals, &start.reals);
        mark(integers, &self.integers, &start.integers);
        mark(booleans, &self.booleans, &start.booleans);
        mark(strings, &self.strings, &start.strings);
        marked
    }

    fn mark(&mut self, variable: &Named) {
        self.set[variable.kind as usize][variable.reference / 64] |= 1 << (variable.reference % 64);
    }

    pub(crate) fn back(&self) -> Values {
        postcard::from_bytes(&postcard::to_stdvec(self).unwrap()).unwrap()
    }
}

/// One flight.
pub(crate) struct NamedInstance<'a, M: Model> {
    named: &'a NamedModel<M>,
    values: Values,
    /// The same, once read.
    tables: OnceCell<Tables>,
    state: M::State,
    time_s: f64,
    /// Once something was set: the values as the last step left them. What is set back is no change.
    before: Option<Values>,
    /// Whether inputs moved in the last step.
    moved: bool,
}

impl<M: Model> NamedInstance<'_, M> {
    /// Now, in s.
    pub(crate) fn time_s(&self) -> f64 {
        self.time_s
    }

    /// One step.
    pub(crate) fn step_to(&mut self, end_s: f64) -> Result<(), Failure> {
        self.step_moving(end_s, &[])
    }

    /// One step in which these inputs move, per second.
    pub(crate) fn step_moving(&mut self, end_s: f64, rates: &[(&str, f64)]) -> Result<(), Failure> {
        let moved = std::mem::replace(&mut self.moved, !rates.is_empty());
        // Who set a value is no matter.
        let unmarked = |values: &Values| Tables { set: Default::default(), ..Tables::new(values) };
        let set = self.before.as_ref().is_some_and(|before| unmarked(before) != unmarked(&self.values));
        let derivatives: Vec<InputDerivative> = rates
            .iter()
            .map(|(name, value)| {
                let bytes =
                    postcard::to_stdvec(&(self.named.find(name, NamedType::Real) as u32, 1_u32, value))
                        .unwrap();
                postcard::from_bytes(&bytes).unwrap()
            })
            .collect();
        let inputs = InputsOverTime::new(self.time_s, &derivatives);
        let changed = set || moved || !rates.is_empty();
        let step = Step { start_s: self.time_s, end_s, changed, parameters_changed: changed, inputs };
        self.tables.take();
        let context = self.named.context();
        M::step(&context, &mut self.values, &mut self.state, &step)?;
        let all = OutputGroups::ALL;
        M::EXTENSIONS.write_outputs(&context, &mut self.values, &mut self.state, all, end_s)?;
        self.time_s = end_s;
        self.before = None;
        Ok(())
    }

    /// Steps of equal length.
    pub(crate) fn simulate_to(&mut self, end_s: f64, step_s: f64) -> Result<(), Failure> {
        while self.time_s < end_s {
            self.step_to(next_multiple_s(self.time_s, step_s).min(end_s))?;
        }
        Ok(())
    }

    /// Sets an input or tunable.
    pub(crate) fn set(&mut self, name: &str, value: f64) {
        self.before.get_or_insert_with(|| self.values.clone());
        let mut tables = self.tables.take().unwrap_or_else(|| Tables::new(&self.values));
        self.named.set(&mut tables, name, value);
        self.values = tables.back();
        self.tables = OnceCell::from(tables);
    }

    /// Sets the elements of an array.
    pub(crate) fn set_elements<'v>(&mut self, name: &str, values: impl IntoIterator<Item = &'v f64>) {
        for (i, value) in (1..).zip(values) {
            self.set(&format!("{name}[{i}]"), *value);
        }
    }

    fn tables(&self) -> &Tables {
        self.tables.get_or_init(|| Tables::new(&self.values))
    }

    /// A Real.
    pub(crate) fn real(&self, name: &str) -> f64 {
        self.tables().reals[self.named.find(name, NamedType::Real)]
    }

    /// An Integer.
    pub(crate) fn integer(&self, name: &str) -> i32 {
        self.tables().integers[self.named.find(name, NamedType::Integer)]
    }

    /// A Boolean.
    pub(crate) fn boolean(&self, name: &str) -> bool {
        self.tables().booleans[self.named.find(name, NamedType::Boolean)]
    }

    /// `name[1]`..`name[3]`.
    pub(crate) fn vector(&self, name: &str) -> nalgebra::Vector3<f64> {
        nalgebra::Vector3::from_fn(|i, _| self.real(&format!("{name}[{}]", i + 1)))
    }

    /// `name[1]`..`name[4]`.
    pub(crate) fn quaternion(&self, name: &str) -> [f64; 4] {
        [1, 2, 3, 4].map(|i| self.real(&format!("{name}[{i}]")))
    }

    /// From body to inertial components, by a quaternion.
    pub(crate) fn to_inertial(&self, name: &str) -> UnitQuaternion<f64> {
        UnitQuaternion::from_quaternion(Quaternion::from(self.quaternion(name)))
    }

    /// The bits of every output but texts.
    pub(crate) fn output_bits(&self) -> Vec<(&str, u64)> {
        let tables = self.tables();
        let bits = |it: &Named| match it.kind {
            NamedType::Real => Some(tables.reals[it.reference].to_bits()),
            NamedType::Integer => Some(tables.integers[it.reference] as u64),
            NamedType::Boolean => Some(u64::from(tables.booleans[it.reference])),
            NamedType::Text => None,
        };
        let outputs = self.named.names.iter().filter(|it| it.output);
        outputs.filter_map(|it| Some((it.name.as_str(), bits(it)?))).collect()
    }

    /// The first output that is no finite number.
    pub(crate) fn not_finite(&self) -> Option<String> {
        let tables = self.tables();
        let outputs = self.named.names.iter().filter(|it| it.kind == NamedType::Real && it.output);
        let bad = outputs.into_iter().find(|it| !tables.reals[it.reference].is_finite());
        bad.map(|it| format!("{} = {}", it.name, tables.reals[it.reference]))
    }

    /// The same flight once more, with all that is not serialised.
    pub(crate) fn copied(&self) -> Self {
        Self {
            named: self.named,
            values: self.values.clone(),
            tables: OnceCell::new(),
            state: self.state.clone(),
            time_s: self.time_s,
            before: self.before.clone(),
            moved: self.moved,
        }
    }

    /// Another flight that knows nothing but what is serialised.
    pub(crate) fn restored(&self) -> Self {
        let values = postcard::from_bytes(&postcard::to_stdvec(&self.values).unwrap()).unwrap();
        let restored = self.with_state(&self.state_bytes()).expect("the state of a simulation");
        Self { values, before: self.before.clone(), moved: self.moved, ..restored }
    }

    /// The same flight by another model, as where a file beside the setup was exchanged.
    pub(crate) fn restored_by<'b>(&self, named: &'b NamedModel<M>) -> NamedInstance<'b, M> {
        let NamedInstance { values, tables, state, time_s, before, moved, .. } = self.restored();
        NamedInstance { named, values, tables, state, time_s, before, moved }
    }

    /// The state's bytes.
    pub(crate) fn state_bytes(&self) -> Vec<u8> {
        postcard::to_stdvec(&self.state).unwrap()
    }

    /// Another flight with the state of these bytes; `None` where they are refused.
    pub(crate) fn with_state(&self, bytes: &[u8]) -> Option<Self> {
        let state = postcard::from_bytes(bytes).ok()?;
        fmi_export::check_finite(&state).ok()?;
        M::check_state(&self.named.setup, &state).ok()?;
        M::check_time(&state, self.time_s).ok()?;
        Some(Self {
            named: self.named,
            values: self.values.clone(),
            tables: OnceCell::new(),
            state,
            time_s: self.time_s,
            before: None,
            moved: false,
        })
    }
}

/// Two flights have every output alike, to the bit.
pub(crate) fn assert_same<M: Model>(a: &NamedInstance<'_, M>, b: &NamedInstance<'_, M>) {
    for ((name, x), (_, y)) in a.output_bits().into_iter().zip(b.output_bits()) {
        assert_eq!(x, y, "{name} at {} s: {} {}", a.time_s(), f64::from_bits(x), f64::from_bits(y));
    }
}

/// How a master cuts a flight changes no bit of any output: in one step to each of `ends_s`, or in steps of each of `steps_s`,
/// saved and restored before each of the first. `each` sees all of them there, and may set what it sets in all alike.
pub(crate) fn assert_cuts_change_nothing<'a, M: Model>(
    initialize: impl Fn() -> NamedInstance<'a, M>,
    ends_s: impl IntoIterator<Item = f64>,
    steps_s: &[f64],
    mut each: impl FnMut(&mut NamedInstance<'a, M>),
) {
    let mut whole = initialize();
    let mut cut: Vec<_> = steps_s.iter().map(|_| initialize()).collect();
    for end_s in ends_s {
        whole.step_to(end_s).unwrap();
        each(&mut whole);
        for (number, (flight, step_s)) in cut.iter_mut().zip(steps_s).enumerate() {
            while flight.time_s() < end_s {
                if number == 0 {
                    *flight = flight.restored();
                }
                // Accumulated, as masters do.
                let next_s = flight.time_s() + step_s;
                flight.step_to(if next_s < end_s { next_s } else { end_s }).unwrap();
            }
            each(flight);
            assert_same(&whole, flight);
        }
    }
}
