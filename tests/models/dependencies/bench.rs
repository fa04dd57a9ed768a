//! Changes knowns at random states and sees which unknowns follow.

use std::collections::{BTreeMap, BTreeSet};

use fmi_export::model::Log;
use fmi_export::model_description::{Description, Unknown};
use fmi_export::{Context, Declare, InputsOverTime, Model, OutputGroups, Step, Values, Variables};

use super::super::named_model::{Tables, described, with_file_starts};
use super::super::random::RandomNumbers;
use super::variable::{Base, Variable, natural, variables};

/// Lengths of the two steps, in s: what falls by ten from the first to the second acts through a state.
const STEPS_S: [f64; 2] = [1e-3, 1e-4];
/// Least ratio of the change after the shorter step to that after the longer.
const DIRECT: f64 = 0.5;
/// Smallest change that counts, relative to the greatest component of the vector or its nominal value. Less is rounding: of
/// epochs to 4e-9 s, through which the spacecraft moves, and of forces and torques fitted to 1e-10.
const CHANGE: f64 = 1e-8;
/// Values a known is changed to at a state.
const CHANGES: usize = 2;
/// Fraction of the parameters that is changed at a state.
const SHARE: f64 = 0.3;

struct Silent;

impl Log for Silent {
    fn events_enabled(&self) -> bool {
        false
    }
    fn event(&self, _time_s: f64, _message: &str) {}
    fn warning(&self, _message: &str) {}
}

/// At how many states a pair (unknown, known) was seen.
type Sightings = BTreeMap<(usize, usize), u32>;

fn note(seen: &mut Sightings, pairs: BTreeSet<(usize, usize)>) {
    for pair in pairs {
        *seen.entry(pair).or_default() += 1;
    }
}

/// A model with everything that does not change in flight, and what was seen so far.
pub(super) struct Bench<M: Model> {
    setup: M::Setup,
    handles: M::Variables,
    start: Values,
    description: Description,
    pub variables: Vec<Variable>,
    by_name: BTreeMap<String, usize>,
    seen_in_steps: Sightings,
    seen_at_start: Sightings,
    pub random: RandomNumbers,
    /// States looked at: at the start, at a communication point.
    pub looks: [usize; 2],
}

/// A flight at a communication point.
pub(super) struct Simulation<M: Model> {
    pub values: Tables,
    state: M::State,
    time_s: f64,
    changed: bool,
}

impl<M: Model> Bench<M> {
    pub(super) fn new(text: &str, seed: u64) -> Self {
        let setup = M::parse_setup("spacecraft.toml", text).unwrap();
        let mut scope = Declare::new();
        let handles = M::Variables::declare(&mut scope, &setup, 0).unwrap();
        let description = described::<M>("spacecraft.toml", text).unwrap();
        let start = with_file_starts(&scope.finish().start, &description);
        let variables = variables(&description);
        let by_name = variables.iter().enumerate().map(|(at, v)| (v.name.clone(), at)).collect();
        Self {
            setup,
            handles,
            start,
            description,
            variables,
            by_name,
            seen_in_steps: Sightings::new(),
            seen_at_start: Sightings::new(),
            random: RandomNumbers(seed),
            looks: [0; 2],
        }
    }

    /// A file beside the setup.
    pub(super) fn with_schedule(mut self, schedule: &str, text: &str) -> Self {
        M::parse_schedule(&mut self.setup, schedule, schedule, text).unwrap();
        self
    }

    fn context(&self) -> Context<'_, M> {
        Context {
            setup: &self.setup,
            variables: &self.handles,
            start: &self.start,
            sets_all_parameters: false,
            log: &Silent,
        }
    }

    pub(super) fn defaults(&self) -> Tables {
        Tables::new(&self.start)
    }

    /// Writes a variable, if the spacecraft has it and a master may set it.
    pub(super) fn put(&self, tables: &mut Tables, name: &str, value: f64) {
        if let Some(&at) = self.by_name.get(name).filter(|at| self.variables[**at].exact) {
            self.write(tables, at, value);
        }
    }

    pub(super) fn read(&self, tables: &Tables, at: usize) -> f64 {
        let variable = &self.variables[at];
        match variable.base {
            Base::Real => tables.reals[variable.slot],
            Base::Integer => f64::from(tables.integers[variable.slot]),
            Base::Boolean => f64::from(u8::from(tables.booleans[variable.slot])),
            Base::Text => 0.0,
        }
    }

    pub(super) fn write(&self, tables: &mut Tables, at: usize, value: f64) {
        let variable = &self.variables[at];
        match variable.base {
            Base::Real => tables.reals[variable.slot] = value,
            Base::Integer => tables.integers[variable.slot] = value as i32,
            Base::Boolean => tables.booleans[variable.slot] = value != 0.0,
            Base::Text => {}
        }
    }

    pub(super) fn initialize(&self, tables: &Tables, start_s: f64) -> Option<Simulation<M>> {
        let mut values = tables.marked_where_other_than(&self.start).back();
        let state = M::initialize(&self.context(), &mut values, start_s).ok()?;
        Some(Simulation { values: Tables::new(&values), state, time_s: start_s, changed: false })
    }

    pub(super) fn step(&self, flight: &mut Simulation<M>, length_s: f64) -> Option<()> {
        let end_s = flight.time_s + length_s;
        let step = Step {
            start_s: flight.time_s,
            end_s,
            changed: flight.changed,
            parameters_changed: flight.changed,
            inputs: InputsOverTime::held(),
        };
        let mut values = flight.values.back();
        M::step(&self.context(), &mut values, &mut flight.state, &step).ok()?;
        let (context, all) = (self.context(), OutputGroups::ALL);
        M::EXTENSIONS.write_outputs(&context, &mut values, &mut flight.state, all, end_s).ok()?;
        flight.values = Tables::new(&values);
        flight.time_s = end_s;
        flight.changed = false;
        Some(())
    }

    /// Values to change a known to.
    fn others(&mut self, tables: &Tables, at: usize) -> Vec<f64> {
        let variable = &self.variables[at];
        let now = self.read(tables, at);
        let candidates: Vec<f64> = match variable.base {
            Base::Boolean => vec![1.0 - now],
            Base::Text => Vec::new(),
            Base::Integer if !variable.items.is_empty() => {
                variable.items.iter().map(|i| f64::from(*i)).collect()
            }
            Base::Integer => vec![now + 1.0, now - 1.0, 2.0 * now],
            Base::Real => {
                let group = variable.group.iter().map(|k| self.read(tables, *k).powi(2)).sum::<f64>().sqrt();
                let natural = natural(&variable.unit);
                vec![now + 3e-4 * group, now - 0.4 * group, now + natural, now - natural]
            }
        };
        let admitted = |value: &f64| (variable.min..=variable.max).contains(value) && *value != now;
        let mut left: Vec<f64> = candidates.into_iter().filter(admitted).collect();
        while left.len() > CHANGES {
            let k = (self.random.next() * left.len() as f64) as usize;
            left.swap_remove(k.min(left.len() - 1));
        }
        left
    }

    /// Changes a known; a component of a symmetric matrix with its mirror image.
    fn changed(&self, tables: &Tables, at: usize, value: f64) -> Tables {
        let mut changed = tables.clone();
        self.write(&mut changed, at, value);
        if let Some((name, indices)) =
            self.variables[at].name.strip_suffix(']').and_then(|n| n.rsplit_once('['))
            && let Some((row, column)) = indices.split_once(',')
            && let Some(mirror) = self.by_name.get(&format!("{name}[{column},{row}]"))
        {
            self.write(&mut changed, *mirror, value);
        }
        changed
    }

    /// Changes inputs and exact parameters before the start at `start_s` and records which unknowns follow.
    pub(super) fn look_at_start(&mut self, tables: &Tables, start_s: f64) -> Option<()> {
        let base = self.initialize(tables, start_s)?;
        self.looks[0] += 1;
        let unknowns = indices(&self.description.structure.initial_unknowns);
        let mut pairs = BTreeSet::new();
        for known in 0..self.variables.len() {
            if !self.variables[known].exact || self.random.next() > SHARE {
                continue;
            }
            for value in self.others(tables, known) {
                let found = self.initialize(&self.changed(tables, known, value), start_s);
                let Some(found) = found else { continue };
                let differs =
                    |unknown: &usize| self.change(&base.values, &found.values, *unknown).abs() > 1.0;
                let followed = unknowns.iter().filter(|at| differs(at)).map(|at| (*at, known));
                pairs.extend(followed);
            }
        }
        note(&mut self.seen_at_start, pairs);
        Some(())
    }

    /// Changes every input at the flight's communication point and records which outputs follow directly.
    pub(super) fn look_at_step(&mut self, flight: &Simulation<M>) -> Option<()> {
        let outputs = indices(&self.description.structure.outputs);
        let after = |bench: &Self, values: &Tables, length_s: f64| {
            let (state, time_s) = (flight.state.clone(), flight.time_s);
            let mut flight = Simulation { values: values.clone(), changed: true, state, time_s };
            bench.step(&mut flight, length_s)?;
            Some(flight.values)
        };
        let both = |bench: &Self, values: &Tables| {
            Some([after(bench, values, STEPS_S[0])?, after(bench, values, STEPS_S[1])?])
        };
        let base = both(self, &flight.values)?;
        self.looks[1] += 1;
        let mut pairs = BTreeSet::new();
        for known in 0..self.variables.len() {
            if !self.variables[known].input {
                continue;
            }
            for value in self.others(&flight.values, known) {
                let Some(found) = both(self, &self.changed(&flight.values, known, value)) else { continue };
                let direct = |unknown: &usize| {
                    let [long, short] = [0, 1].map(|i| self.change(&base[i], &found[i], *unknown).abs());
                    short > 1.0 && short > DIRECT * long
                };
                let followed = outputs.iter().filter(|at| direct(at)).map(|at| (*at, known));
                pairs.extend(followed);
            }
        }
        note(&mut self.seen_in_steps, pairs);
        Some(())
    }

    /// The change of an unknown, in units of what counts as one; text has none.
    fn change(&self, base: &Tables, found: &Tables, unknown: usize) -> f64 {
        let variable = &self.variables[unknown];
        let change = self.read(found, unknown) - self.read(base, unknown);
        if variable.base != Base::Real {
            return 2.0 * change;
        }
        let both = variable.group.iter().flat_map(|k| [self.read(base, *k), self.read(found, *k)]);
        // Angles are read off vectors, to the rounding of these.
        let least = if variable.unit == "rad" { 1.0 } else { variable.nominal };
        change / (CHANGE * both.fold(least, |size, value| size.max(value.abs())))
    }

    /// Dependencies seen and not declared, a line an unknown. They count from the second state on: an event may fall right on a
    /// communication point, but not twice.
    pub(super) fn undeclared(&self) -> String {
        let structure = &self.description.structure;
        let lists = [
            ("Outputs", &structure.outputs, &self.seen_in_steps),
            ("InitialUnknowns", &structure.initial_unknowns, &self.seen_at_start),
        ];
        let mut faults = String::new();
        for (list, unknowns, seen) in lists {
            let declared = declared(unknowns);
            let mut missing: BTreeMap<usize, Vec<&str>> = BTreeMap::new();
            let twice = seen.iter().filter(|(_, states)| **states > 1).map(|(pair, _)| pair);
            for (unknown, known) in twice.filter(|pair| !declared.contains(pair)) {
                missing.entry(*unknown).or_default().push(&self.variables[*known].name);
            }
            for (unknown, knowns) in missing {
                let name = &self.variables[unknown].name;
                faults.push_str(&format!("{list}: {name} follows {}\n", knowns.join(" ")));
            }
        }
        faults
    }

    /// How many pairs were seen in each list.
    pub(super) fn seen(&self) -> [usize; 2] {
        [self.seen_in_steps.len(), self.seen_at_start.len()]
    }
}

fn declared(unknowns: &[Unknown]) -> BTreeSet<(usize, usize)> {
    let pairs = unknowns.iter().flat_map(|unknown| {
        let knowns = unknown.dependencies.as_ref().unwrap().iter();
        knowns.map(|known| (unknown.index as usize - 1, *known as usize - 1))
    });
    pairs.collect()
}

fn indices(unknowns: &[Unknown]) -> Vec<usize> {
    unknowns.iter().map(|unknown| unknown.index as usize - 1).collect()
}
