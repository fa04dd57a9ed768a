//! Measures what outputs and unknowns of initialization depend on, by changing every known at many states.

use std::collections::{BTreeMap, BTreeSet};

use fmi_export::fmi2::description_of;
use fmi_export::model::Log;
use fmi_export::model_description::{Description, Unknown};
use fmi_export::{Context, Declare, InputsOverTime, Model, Step, Values, Variables};

use super::super::named_model::{Tables, with_file_starts};
use super::random::RandomNumbers;
use super::variable::{Base, Variable, natural, variables};

/// Lengths of the two steps from which the limit of a step without length is taken, in s.
const STEPS_S: [f64; 2] = [1e-3, 1e-6];
/// A step so short that no event comes within it by chance; what was found must be there too.
const SHORTEST_S: f64 = 1e-9;
/// What counts as a change, relative to the greatest component of the vector or its nominal value. Less is rounding: of
/// epochs to 4e-9 s, through which the spacecraft moves, and what is left of cells of light 0.01 s long.
const CHANGE: f64 = 1e-8;
/// Halvings between two values of a flag.
const HALVINGS: u32 = 34;
/// Values a known is changed to, of those there are.
const CHANGES: usize = 2;

struct Silent;

impl Log for Silent {
    fn events_enabled(&self) -> bool {
        false
    }
    fn event(&self, _time_s: f64, _message: &str) {}
    fn warning(&self, _message: &str) {}
}

/// A pair (unknown, known), by places among the variables.
type Pairs = BTreeSet<(usize, usize)>;

/// The first two states at which a pair was seen.
type Sightings = BTreeMap<(usize, usize), (u32, Option<u32>)>;

/// Whether a pair need not be looked for at this state.
fn is_settled(seen: &Sightings, left: &Pairs, pair: &(usize, usize), look: u32) -> bool {
    seen.get(pair).is_some_and(|(first, second)| !left.contains(pair) && (second.is_some() || *first == look))
}

fn note(seen: &mut Sightings, left: &mut Pairs, pair: (usize, usize), look: u32) {
    left.remove(&pair);
    let (first, second) = seen.entry(pair).or_insert((look, None));
    if *first != look {
        *second = Some(look);
    }
}

/// A model with everything that does not change in flight, and what was seen so far.
pub struct Bench<M: Model> {
    setup: M::Setup,
    handles: M::Variables,
    start: Values,
    description: Description,
    variables: Vec<Variable>,
    carriers: Vec<(&'static str, &'static str)>,
    by_name: BTreeMap<String, usize>,
    texts: Vec<&'static str>,
    /// Values that some Reals can take.
    admitted: Vec<(&'static str, &'static [f64])>,
    seen_in_steps: Sightings,
    seen_at_start: Sightings,
    /// Declared and not seen yet.
    left_in_steps: Pairs,
    left_at_start: Pairs,
    /// Number of the state looked at.
    look: u32,
    random: RandomNumbers,
    refused: usize,
    taken: usize,
    /// Whether surfaces have outlines, so that they can shadow one another.
    pub outlined: bool,
}

/// A flight at a communication point.
pub struct Simulation<M: Model> {
    pub values: Tables,
    pub state: M::State,
    pub time_s: f64,
    pub changed: bool,
}

impl<M: Model> Clone for Simulation<M> {
    fn clone(&self) -> Self {
        Self {
            values: self.values.clone(),
            state: self.state.clone(),
            time_s: self.time_s,
            changed: self.changed,
        }
    }
}

impl<M: Model> Bench<M> {
    pub fn new(text: &str) -> Self {
        let setup = M::parse_setup("spacecraft.toml", text).unwrap();
        let mut scope = Declare::new();
        let handles = M::Variables::declare(&mut scope, &setup, 0).unwrap();
        let description = description_of::<M>("spacecraft.toml", text).unwrap();
        let start = with_file_starts(&scope.finish().start, &description);
        let variables = variables(&description);
        let by_name = variables.iter().enumerate().map(|(at, v)| (v.name.clone(), at)).collect();
        let structure = &description.structure;
        let [left_in_steps, left_at_start] =
            [&structure.outputs, &structure.initial_unknowns].map(|list| declared(list));
        Self {
            left_in_steps,
            left_at_start,
            setup,
            handles,
            start,
            description,
            variables,
            by_name,
            carriers: Vec::new(),
            texts: Vec::new(),
            admitted: Vec::new(),
            seen_in_steps: Sightings::new(),
            seen_at_start: Sightings::new(),
            look: 0,
            random: RandomNumbers(1),
            refused: 0,
            taken: 0,
            outlined: text.contains("polygon_m"),
        }
    }

    /// Leaves aside what another craft declares too, where its own search shows it.
    pub fn with_shown(mut self, other: &Self) -> Self {
        let names = |bench: &Self, pair: &(usize, usize)| {
            let name = |at: usize| bench.variables[at].name.clone();
            (name(pair.0), name(pair.1))
        };
        let theirs = &other.description.structure;
        let shown = |left: &Pairs, by: &[Unknown]| -> Pairs {
            let declared_there: BTreeSet<_> = declared(by).iter().map(|pair| names(other, pair)).collect();
            left.iter().filter(|pair| !declared_there.contains(&names(&self, pair))).copied().collect()
        };
        let in_steps = shown(&self.left_in_steps, &theirs.outputs);
        let at_start = shown(&self.left_at_start, &theirs.initial_unknowns);
        (self.left_in_steps, self.left_at_start) = (in_steps, at_start);
        self
    }

    /// Unknowns that change seldom, by the beginning of their names, each with a quantity it is computed from: a known that
    /// was seen to move the quantity counts as seen to move the unknown, once the unknown was seen to move at all.
    pub fn with_carriers(mut self, carriers: &[(&'static str, &'static str)]) -> Self {
        self.carriers = carriers.to_vec();
        self
    }

    /// A file beside the setup.
    pub fn with_schedule(mut self, schedule: &str, text: &str) -> Self {
        M::parse_schedule(&mut self.setup, schedule, schedule, text).unwrap();
        self
    }

    /// What String parameters are set to.
    pub fn with_texts(mut self, texts: &[&'static str]) -> Self {
        self.texts = texts.to_vec();
        self
    }

    /// What Reals are set to that cannot take any value.
    pub fn with_values(mut self, admitted: &[(&'static str, &'static [f64])]) -> Self {
        self.admitted = admitted.to_vec();
        self
    }

    fn context(&self) -> Context<'_, M> {
        Context { setup: &self.setup, variables: &self.handles, start: &self.start, log: &Silent }
    }

    fn at(&self, name: &str) -> usize {
        *self.by_name.get(name).unwrap_or_else(|| panic!("no variable {name}"))
    }

    pub fn has(&self, name: &str) -> bool {
        self.by_name.contains_key(name)
    }

    pub fn defaults(&self) -> Tables {
        Tables::of(&self.start)
    }

    pub fn put(&self, tables: &mut Tables, name: &str, value: f64) {
        self.write(tables, self.at(name), value);
    }

    /// Takes over variables of some names.
    pub fn copy(&self, tables: &mut Tables, other: &Tables, named: impl Fn(&str) -> bool) {
        for at in (0..self.variables.len()).filter(|at| named(&self.variables[*at].name)) {
            self.write(tables, at, self.read(other, at));
        }
    }

    pub fn put_text(&self, tables: &mut Tables, name: &str, value: &str) {
        value.clone_into(&mut tables.strings[self.variables[self.at(name)].slot]);
    }

    pub fn put_vector(&self, tables: &mut Tables, name: &str, value: &[f64]) {
        for (i, value) in value.iter().enumerate() {
            self.put(tables, &format!("{name}[{}]", i + 1), *value);
        }
    }

    pub fn real(&self, tables: &Tables, name: &str) -> f64 {
        self.read(tables, self.at(name))
    }

    fn read(&self, tables: &Tables, at: usize) -> f64 {
        let variable = &self.variables[at];
        match variable.base {
            Base::Real => tables.reals[variable.slot],
            Base::Integer => f64::from(tables.integers[variable.slot]),
            Base::Boolean => f64::from(u8::from(tables.booleans[variable.slot])),
            Base::Text => {
                self.texts.iter().position(|t| *t == tables.strings[variable.slot]).unwrap_or(0) as f64
            }
        }
    }

    fn write(&self, tables: &mut Tables, at: usize, value: f64) {
        let variable = &self.variables[at];
        match variable.base {
            Base::Real => tables.reals[variable.slot] = value,
            Base::Integer => tables.integers[variable.slot] = value as i32,
            Base::Boolean => tables.booleans[variable.slot] = value != 0.0,
            Base::Text => self.texts[value as usize].clone_into(&mut tables.strings[variable.slot]),
        }
    }

    pub fn initialize(&self, tables: &Tables, start_s: f64) -> Option<Simulation<M>> {
        let mut values = tables.marked_where_other_than(&self.start).back();
        let state = M::initialize(&self.context(), &mut values, start_s).ok()?;
        Some(Simulation { values: Tables::of(&values), state, time_s: start_s, changed: false })
    }

    /// Why a start is refused.
    pub fn refusal(&self, tables: &Tables, start_s: f64) -> String {
        M::initialize(&self.context(), &mut tables.marked_where_other_than(&self.start).back(), start_s)
            .err()
            .map_or_else(String::new, |e| e.to_string())
    }

    pub fn step(&self, flight: &mut Simulation<M>, length_s: f64) -> Option<()> {
        let end_s = flight.time_s + length_s;
        let step =
            Step { start_s: flight.time_s, end_s, changed: flight.changed, inputs: InputsOverTime::held() };
        let mut values = flight.values.back();
        M::step(&self.context(), &mut values, &mut flight.state, &step).ok()?;
        flight.values = Tables::of(&values);
        flight.time_s = end_s;
        flight.changed = false;
        Some(())
    }

    /// Whether a flight whose inputs have changed takes the steps that are looked at; says why not.
    pub fn goes_on(&self, flight: &Simulation<M>) -> bool {
        [STEPS_S[0], STEPS_S[1], SHORTEST_S].into_iter().all(|length_s| {
            let mut state = flight.state.clone();
            let (start_s, end_s) = (flight.time_s, flight.time_s + length_s);
            let step = Step { start_s, end_s, changed: true, inputs: InputsOverTime::held() };
            let ended = M::step(&self.context(), &mut flight.values.back(), &mut state, &step);
            if let Err(error) = &ended {
                println!("a step of {length_s} s from {start_s} s: {error}");
            }
            ended.is_ok()
        })
    }

    /// Values to change a known to.
    fn others(&mut self, tables: &Tables, at: usize) -> Vec<f64> {
        let variable = &self.variables[at];
        let now = self.read(tables, at);
        let given = self.admitted.iter().find(|(name, _)| *name == variable.name);
        let candidates: Vec<f64> = match variable.base {
            _ if given.is_some() => given.map_or_else(Vec::new, |(_, values)| values.to_vec()),
            Base::Boolean => vec![1.0 - now],
            Base::Text => (0..self.texts.len()).map(|i| i as f64).collect(),
            Base::Integer if !variable.items.is_empty() => {
                variable.items.iter().map(|i| f64::from(*i)).collect()
            }
            Base::Integer => vec![now + 1.0, now - 1.0, now + 2.0, 2.0 * now],
            Base::Real => {
                let group = variable.group.iter().map(|k| self.read(tables, *k).powi(2)).sum::<f64>().sqrt();
                let natural = natural(&variable.unit);
                if group == 0.0 {
                    // What is not set yet; places in two sizes.
                    let places = if variable.unit == "m" { &[1e7, 6e10][..] } else { &[] };
                    [&[now + natural, now - natural, now + 3e-4 * natural], places].concat()
                } else {
                    let small = 3e-4 * group;
                    vec![now + small, now - small, now - 0.4 * group, now + natural, now - natural]
                }
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

    /// Changes every input and exact parameter before the start at `start_s` and records which unknowns follow.
    pub fn look_at_start(&mut self, tables: &Tables, start_s: f64) {
        self.start_looks(tables, start_s, false, |_| true);
    }

    /// The same where a flag is about to change.
    pub fn look_at_start_edge(&mut self, tables: &Tables, start_s: f64) {
        self.start_looks(tables, start_s, true, |_| true);
    }

    /// The same for the knowns of some names.
    pub fn look_at_start_by(&mut self, tables: &Tables, start_s: f64, named: impl Fn(&str) -> bool) {
        self.start_looks(tables, start_s, false, named);
    }

    fn start_looks(&mut self, tables: &Tables, start_s: f64, edge: bool, named: impl Fn(&str) -> bool) {
        let Some(base) = self.initialize(tables, start_s) else {
            panic!("refused: {}", self.refusal(tables, start_s))
        };
        self.look += 1;
        let unknowns = indices(&self.description.structure.initial_unknowns);
        for known in 0..self.variables.len() {
            let variable = &self.variables[known];
            if !(variable.exact && named(&variable.name))
                || Self::is_known(&mut self.random, &self.left_at_start, known, edge)
            {
                continue;
            }
            for value in self.others(tables, known) {
                let Some(found) = self.initialize(&self.changed(tables, known, value), start_s) else {
                    self.refused += 1;
                    continue;
                };
                self.taken += 1;
                for &unknown in &unknowns {
                    let pair = (unknown, known);
                    if !is_settled(&self.seen_at_start, &self.left_at_start, &pair, self.look)
                        && self.differs_at_start(&base.values, &found.values, unknown)
                    {
                        note(&mut self.seen_at_start, &mut self.left_at_start, pair, self.look);
                    }
                }
            }
        }
    }

    fn differs_at_start(&self, base: &Tables, found: &Tables, unknown: usize) -> bool {
        let variable = &self.variables[unknown];
        if variable.base == Base::Text {
            return base.strings[variable.slot] != found.strings[variable.slot];
        }
        let change = self.read(found, unknown) - self.read(base, unknown);
        let least = if variable.base == Base::Real { CHANGE * self.size(base, found, unknown) } else { 0.0 };
        change.abs() > least
    }

    /// The greatest component of an unknown's vector, or its nominal value.
    fn size(&self, base: &Tables, found: &Tables, unknown: usize) -> f64 {
        let variable = &self.variables[unknown];
        let both = variable.group.iter().flat_map(|k| [self.read(base, *k), self.read(found, *k)]);
        // Angles are read off vectors, to the rounding of these.
        let least = if variable.unit == "rad" { 1.0 } else { variable.nominal };
        both.fold(least, |size, value| size.max(value.abs()))
    }

    /// Changes every input at the flight's communication point and records which outputs follow at once.
    pub fn look_at_step(&mut self, flight: &Simulation<M>) {
        self.step_looks(flight, false);
    }

    /// The same where a flag is about to change.
    pub fn look_at_step_edge(&mut self, flight: &Simulation<M>) {
        self.step_looks(flight, true);
    }

    fn step_looks(&mut self, flight: &Simulation<M>, edge: bool) {
        self.look += 1;
        let outputs = indices(&self.description.structure.outputs);
        let after = |bench: &Self, values: &Tables| {
            let ended = |length_s: f64| {
                let mut flight = Simulation { values: values.clone(), changed: true, ..flight.clone() };
                bench.step(&mut flight, length_s)?;
                Some(flight.values)
            };
            Some([ended(STEPS_S[0])?, ended(STEPS_S[1])?, ended(SHORTEST_S)?])
        };
        let Some(base) = after(self, &flight.values) else { panic!("the flight does not go on") };
        for known in 0..self.variables.len() {
            if !self.variables[known].input
                || Self::is_known(&mut self.random, &self.left_in_steps, known, edge)
            {
                continue;
            }
            for value in self.others(&flight.values, known) {
                let Some(found) = after(self, &self.changed(&flight.values, known, value)) else {
                    self.refused += 1;
                    continue;
                };
                self.taken += 1;
                for &unknown in &outputs {
                    let pair = (unknown, known);
                    if !is_settled(&self.seen_in_steps, &self.left_in_steps, &pair, self.look)
                        && self.jumps(&base, &found, unknown)
                    {
                        note(&mut self.seen_in_steps, &mut self.left_in_steps, pair, self.look);
                    }
                }
            }
        }
    }

    /// Between a configuration and others with the same options: where a flag or count is about to change for which not
    /// all has been seen yet, once for each such flag.
    pub fn edges_at_start(&self, one: &Tables, others: &[Tables], start_s: f64) -> Vec<Tables> {
        let value = |tables: &Tables| self.initialize(tables, start_s).map(|flight| flight.values);
        let list = &self.description.structure.initial_unknowns;
        self.edges(list, &self.left_at_start, one, others, &value)
    }

    /// The same for a flight at its communication point, between its inputs and tunable parameters and others.
    pub fn edges_at_step(&self, flight: &Simulation<M>, others: &[Tables]) -> Vec<Simulation<M>> {
        let with = |tables: Tables| Simulation { values: tables, changed: true, ..flight.clone() };
        let value = |tables: &Tables| {
            let mut flight = with(tables.clone());
            self.step(&mut flight, STEPS_S[1])?;
            Some(flight.values)
        };
        let set = |other: &Tables| {
            let mut aside = flight.values.clone();
            for at in (0..self.variables.len()).filter(|at| self.variables[*at].settable) {
                self.write(&mut aside, at, self.read(other, at));
            }
            aside
        };
        let others: Vec<Tables> = others.iter().map(set).collect();
        let list = &self.description.structure.outputs;
        let edges = self.edges(list, &self.left_in_steps, &flight.values, &others, &value);
        edges.into_iter().map(with).collect()
    }

    fn edges(
        &self,
        list: &[Unknown],
        left: &Pairs,
        one: &Tables,
        others: &[Tables],
        value: &dyn Fn(&Tables) -> Option<Tables>,
    ) -> Vec<Tables> {
        let Some(low) = value(one) else { return Vec::new() };
        let (mut found, mut taken) = (Vec::new(), BTreeSet::new());
        for other in others {
            let Some(high) = value(other) else { continue };
            for flag in self.flags(list, left, &low, &high) {
                let as_low =
                    |tables: &Tables| Some(self.read(&value(tables)?, flag) == self.read(&low, flag));
                if !taken.contains(&flag)
                    && let Some(edge) = self.halve(one, other, as_low)
                {
                    taken.insert(flag);
                    found.push(edge);
                }
            }
        }
        found
    }

    /// Which flags and counts of a list differ.
    fn flags(&self, list: &[Unknown], left: &Pairs, low: &Tables, high: &Tables) -> Vec<usize> {
        let differs = |at: &usize| {
            let base = self.variables[*at].base;
            (base == Base::Boolean || base == Base::Integer) && self.read(low, *at) != self.read(high, *at)
        };
        let open = |at: &usize| left.iter().any(|pair| pair.0 == *at);
        indices(list).into_iter().filter(differs).filter(open).collect()
    }

    /// The Reals between two tables, all by the same share, where `as_first` is about to change.
    fn halve(
        &self,
        first: &Tables,
        last: &Tables,
        as_first: impl Fn(&Tables) -> Option<bool>,
    ) -> Option<Tables> {
        let between = |share: f64| {
            let mut tables = first.clone();
            for (real, other) in tables.reals.iter_mut().zip(&last.reals) {
                *real += share * (other - *real);
            }
            tables
        };
        if as_first(&between(1.0))? {
            return None;
        }
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            *(if as_first(&between(middle))? { &mut low } else { &mut high }) = middle;
        }
        Some(between(low))
    }

    /// Whether an output differs after a step however short.
    fn jumps(&self, base: &[Tables; 3], found: &[Tables; 3], unknown: usize) -> bool {
        let variable = &self.variables[unknown];
        if variable.base == Base::Text {
            return base[2].strings[variable.slot] != found[2].strings[variable.slot];
        }
        let [long, short, shortest] =
            [0, 1, 2].map(|i| self.read(&found[i], unknown) - self.read(&base[i], unknown));
        if variable.base != Base::Real {
            return short != 0.0 && shortest != 0.0;
        }
        // What grows with the step is taken off.
        let limit = (short * STEPS_S[0] - long * STEPS_S[1]) / (STEPS_S[0] - STEPS_S[1]);
        limit.abs() > CHANGE * self.size(&base[1], &found[1], unknown)
            && (shortest - limit).abs() < 0.7 * limit.abs()
    }

    /// Whether all that is declared of a known was seen; it is then changed only now and then, to find what is not declared,
    /// and not where a flag is about to change.
    fn is_known(random: &mut RandomNumbers, left: &Pairs, known: usize, at_edge: bool) -> bool {
        !left.iter().any(|pair| pair.1 == known) && (at_edge || random.next() < 0.85)
    }

    /// Whether nothing declared is left to be seen.
    pub fn is_done(&self) -> bool {
        let structure = &self.description.structure;
        self.never(&structure.outputs, &self.left_in_steps).is_empty()
            && self.never(&structure.initial_unknowns, &self.left_at_start).is_empty()
    }

    /// What is declared and was seen neither itself, nor of an element that is alike, nor through its carrier.
    fn never(&self, unknowns: &[Unknown], left: &Pairs) -> Vec<(usize, usize)> {
        let declared = declared(unknowns);
        let seen: Vec<&(usize, usize)> = declared.iter().filter(|pair| !left.contains(pair)).collect();
        let alike: BTreeSet<(String, String)> = seen.iter().map(|pair| self.alike(pair)).collect();
        let moved: BTreeSet<usize> = seen.iter().map(|pair| pair.0).collect();
        let by_vector: BTreeSet<(String, usize)> =
            seen.iter().map(|pair| (without_indices(&self.variables[pair.0].name), pair.1)).collect();
        let carried = |pair: &(usize, usize)| {
            let name = &self.variables[pair.0].name;
            let mut carriers = self.carriers.iter().filter(|(beginning, _)| name.starts_with(beginning));
            moved.contains(&pair.0)
                && carriers.any(|(_, carrier)| by_vector.contains(&((*carrier).to_owned(), pair.1)))
        };
        left.iter().filter(|pair| !alike.contains(&self.alike(pair)) && !carried(pair)).copied().collect()
    }

    /// Holds the declared lists against what was seen, both ways. What is not declared counts from the second state on at
    /// which it was seen: an event may fall right on a communication point, but not twice.
    pub fn judge(&self) {
        let structure = &self.description.structure;
        let lists = [
            ("Outputs", &structure.outputs, &self.seen_in_steps, &self.left_in_steps),
            ("InitialUnknowns", &structure.initial_unknowns, &self.seen_at_start, &self.left_at_start),
        ];
        let mut faults = String::new();
        for (list, unknowns, seen, left) in lists {
            let declared = declared(unknowns);
            let twice = seen.iter().filter(|(_, (_, second))| second.is_some()).map(|(pair, _)| pair);
            let missing = twice.filter(|pair| !declared.contains(pair));
            self.tell(&mut faults, &format!("{list}: not declared"), missing);
            self.tell(&mut faults, &format!("{list}: never seen"), self.never(unknowns, left).iter());
        }
        println!("{} changes at {} states tried, {} refused", self.taken, self.look, self.refused);
        assert!(faults.is_empty(), "{faults}");
    }

    /// A pair by names in which thrusters have no number: they are alike, and what one of them moves any of them does.
    fn alike(&self, pair: &(usize, usize)) -> (String, String) {
        let name = |at: usize| {
            let name = &self.variables[at].name;
            match name.strip_prefix("thruster[").and_then(|rest| rest.split_once("].")) {
                Some((_, quantity)) => format!("thruster.{quantity}"),
                None => name.clone(),
            }
        };
        (name(pair.0), name(pair.1))
    }

    /// One line for all unknowns with the same knowns; `x[*]` is a vector with all its elements.
    fn tell<'a>(&self, text: &mut String, what: &str, pairs: impl Iterator<Item = &'a (usize, usize)>) {
        let mut by_unknown: BTreeMap<usize, BTreeSet<usize>> = BTreeMap::new();
        for (unknown, known) in pairs {
            by_unknown.entry(*unknown).or_default().insert(*known);
        }
        let mut by_knowns: BTreeMap<BTreeSet<usize>, BTreeSet<usize>> = BTreeMap::new();
        for (unknown, knowns) in by_unknown {
            by_knowns.entry(knowns).or_default().insert(unknown);
        }
        for (knowns, unknowns) in by_knowns {
            let [unknowns, knowns] = [unknowns, knowns].map(|set| self.named(&set).join(" "));
            text.push_str(&format!("{what}: {unknowns} on {knowns}\n"));
        }
    }

    fn named(&self, set: &BTreeSet<usize>) -> Vec<String> {
        let mut names: Vec<String> = Vec::new();
        for at in set {
            let variable = &self.variables[*at];
            let whole = variable.group.len() > 1 && variable.group.iter().all(|k| set.contains(k));
            let vector = variable.name.rsplit_once('[').map(|(name, _)| format!("{name}[*]"));
            match vector.filter(|_| whole) {
                Some(vector) if variable.group[0] == *at => names.push(vector),
                Some(_) => {}
                None => names.push(variable.name.clone()),
            }
        }
        names
    }
}

/// `wheel.speed` of `wheel[2].speed`.
fn without_indices(name: &str) -> String {
    let parts = name.split('[').map(|part| part.split_once(']').map_or(part, |(_, rest)| rest));
    parts.collect()
}

fn declared(unknowns: &[Unknown]) -> Pairs {
    let pairs = unknowns.iter().flat_map(|unknown| {
        let knowns = unknown.dependencies.as_ref().unwrap().iter();
        knowns.map(|known| (unknown.index as usize - 1, *known as usize - 1))
    });
    pairs.collect()
}

fn indices(unknowns: &[Unknown]) -> Vec<usize> {
    unknowns.iter().map(|unknown| unknown.index as usize - 1).collect()
}
